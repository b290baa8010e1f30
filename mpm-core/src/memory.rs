//! Memory of a run: the state that the next step needs and the scene does not define.
//!
//! A run that is saved, rebuilt from its scene and restored continues bit for bit as an uninterrupted one. So every
//! part of a run declares the state that it carries from one step to the next: by [`Memory`], or, without any, by
//! [`Memoryless`]. Construction data (moduli, limits, walls) are not saved, nor are work arrays, which each step
//! overwrites.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The memory of a part, as bytes in a format private to that part.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Saved(#[serde(with = "serde_bytes")] Vec<u8>);

/// Why a memory cannot be saved or restored.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MemoryError {
    /// A value that cannot be written as bytes.
    #[error("state cannot be saved: {0}")]
    Write(postcard::Error),
    /// Bytes that are not the memory of this part.
    #[error("saved state does not match {part}: {cause}")]
    Read {
        /// The part.
        part: &'static str,
        /// Cause.
        cause: postcard::Error,
    },
    /// More bytes than this part's memory has.
    #[error("saved state does not match {part}: {surplus} unexpected bytes")]
    Surplus {
        /// The part.
        part: &'static str,
        /// Number of unexpected bytes.
        surplus: usize,
    },
    /// The memory asks for a scene that cannot be built.
    #[error("the scene cannot be built: {0}")]
    Scene(String),
    /// A size that is not that of the scene.
    #[error("{what}: {saved} in the saved state, {expected} in the scene")]
    Size {
        /// Name of the count.
        what: &'static str,
        /// The memory's.
        saved: usize,
        /// The scene's.
        expected: usize,
    },
    /// A value that the scene does not allow.
    #[error("{what} = {value} in the saved state is not allowed: {allowed}")]
    Value {
        /// The field.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
}

impl MemoryError {
    /// Checks that a size in the memory is that of the scene.
    ///
    /// # Errors
    /// [`MemoryError::Size`] if it is not.
    pub fn unless_equal(what: &'static str, saved: usize, expected: usize) -> Result<(), Self> {
        if saved == expected {
            return Ok(());
        }
        Err(Self::Size { what, saved, expected })
    }
}

impl Saved {
    /// The bytes of `value`, often a tuple of references to the state.
    ///
    /// # Errors
    /// A value that has no bytes, such as a sequence of unknown length.
    pub fn of(value: &impl Serialize) -> Result<Self, MemoryError> {
        // Counted first: a vector that grows holds up to three times as much while it does.
        let size = postcard::experimental::serialized_size(value);
        let bytes = size.and_then(|size| postcard::to_extend(value, Vec::with_capacity(size)));
        bytes.map(Self).map_err(MemoryError::Write)
    }

    /// From bytes that were [saved](Self::bytes).
    #[must_use]
    pub fn from_bytes(bytes: Vec<u8>) -> Self {
        Self(bytes)
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }

    /// The value whose bytes these are; `part` names it in errors.
    ///
    /// # Errors
    /// The bytes are not those of one such value.
    pub fn read<T: DeserializeOwned>(&self, part: &'static str) -> Result<T, MemoryError> {
        let (value, rest) = postcard::take_from_bytes(&self.0).map_err(|cause| MemoryError::Read { part, cause })?;
        if rest.is_empty() {
            return Ok(value);
        }
        Err(MemoryError::Surplus { part, surplus: rest.len() })
    }
}

/// A part with a state from one step to the next.
pub trait Memory {
    /// Present memory.
    ///
    /// # Errors
    /// A value that has no bytes.
    fn save(&self) -> Result<Saved, MemoryError>;

    /// Restores the state saved from a part built in the same way.
    ///
    /// # Errors
    /// The memory of another part. This one may then be partly restored and must not be used any more.
    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError>;
}

/// A part without a state: its actions depend on its construction and its arguments alone.
pub trait Memoryless {}

impl<T: Memoryless + ?Sized> Memory for T {
    fn save(&self) -> Result<Saved, MemoryError> {
        Ok(Saved::default())
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        saved.read("a part without a state")
    }
}

/// Checks that a value in a memory is allowed.
pub(crate) fn require(ok: bool, what: &'static str, value: f64, allowed: &'static str) -> Result<(), MemoryError> {
    if ok {
        return Ok(());
    }
    Err(MemoryError::Value { what, value, allowed })
}

/// Memories of the parts of a list.
///
/// # Errors
/// A value that has no bytes.
pub fn save_all<T: Memory + ?Sized>(parts: &[Box<T>]) -> Result<Vec<Saved>, MemoryError> {
    parts.iter().map(|part| part.save()).collect()
}

/// Restores the memory of each part of a list; `what` names the list in errors.
///
/// # Errors
/// A list of another length, or the memory of another part.
pub fn restore_all<T: Memory + ?Sized>(
    what: &'static str,
    parts: &mut [Box<T>],
    saved: &[Saved],
) -> Result<(), MemoryError> {
    MemoryError::unless_equal(what, saved.len(), parts.len())?;
    let mut pairs = parts.iter_mut().zip(saved);
    pairs.try_for_each(|(part, saved)| part.restore(saved))
}

/// Columns of vectors as one run of numbers: serde has no arrays of a general length `D`.
pub(crate) mod rows {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    pub(crate) fn serialize<const D: usize, S: Serializer>(
        column: &[[f64; D]],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        column.as_flattened().serialize(serializer)
    }

    pub(crate) fn deserialize<'de, const D: usize, R: Deserializer<'de>>(
        deserializer: R,
    ) -> Result<Vec<[f64; D]>, R::Error> {
        let numbers = Vec::<f64>::deserialize(deserializer)?;
        match numbers.as_chunks() {
            (rows, []) => Ok(rows.to_vec()),
            _ => Err(R::Error::invalid_length(numbers.len(), &"whole vectors")),
        }
    }
}

/// One vector, for the same reason.
pub(crate) mod row {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    pub(crate) fn serialize<const D: usize, S: Serializer>(
        vector: &[f64; D],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        vector.as_slice().serialize(serializer)
    }

    pub(crate) fn deserialize<'de, const D: usize, R: Deserializer<'de>>(
        deserializer: R,
    ) -> Result<[f64; D], R::Error> {
        let numbers = Vec::<f64>::deserialize(deserializer)?;
        let length = numbers.len();
        let vector = numbers.try_into();
        vector.map_err(|_| R::Error::invalid_length(length, &"a vector"))
    }
}
