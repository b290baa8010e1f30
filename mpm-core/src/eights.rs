//! Columns of particles, eight entries at a time: as numbers side by side, and back.

use crate::number::{EIGHT, Eight};
use nalgebra::SMatrix;

/// A column in blocks of eight; what the last block lacks is the column's last entry, again.
#[derive(Debug, Clone, Copy)]
pub struct Eights<'a, T> {
    blocks: &'a [[T; EIGHT]],
    /// Remaining entries, if any.
    last: Option<[T; EIGHT]>,
}

impl<'a, T: Copy> Eights<'a, T> {
    /// Those of a column.
    #[inline(always)]
    #[must_use]
    pub fn of(column: &'a [T]) -> Self {
        let (blocks, rest) = column.as_chunks();
        let last = rest.last().map(|last| {
            let mut block = [*last; EIGHT];
            block[..rest.len()].copy_from_slice(rest);
            block
        });
        Self { blocks, last }
    }

    /// The `k`-th block.
    #[inline(always)]
    pub fn at(&self, k: usize) -> &[T; EIGHT] {
        match &self.last {
            Some(last) if k == self.blocks.len() => last,
            _ => &self.blocks[k],
        }
    }

    /// Asks the processor, if it can be asked, for what the `k`-th block holds, if there is one: without it the first
    /// use of a block waits for memory.
    #[inline(always)]
    pub fn fetch(&self, k: usize) {
        fetch(self.blocks.as_flattened(), k);
    }
}

/// Asks the processor for the `k`-th block of a column, if there is one.
#[inline(always)]
pub fn fetch<T>(column: &[T], k: usize) {
    fetch_rows(column, k, 1);
}

/// The same of a column of rows that have `width` entries each.
#[inline(always)]
pub fn fetch_rows<T>(column: &[T], k: usize, width: usize) {
    let size = width * EIGHT;
    #[cfg(target_arch = "x86_64")]
    if let Some(block) = column.get(k * size..(k + 1) * size) {
        for entry in block.iter().step_by((LINE / size_of::<T>()).max(1)) {
            safe_arch::prefetch_t0(entry);
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (column, k, size);
}

/// Bytes that memory gives at once.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;
/// How many blocks ahead a kernel asks for what it will need. From one to four are as good.
pub const AHEAD: usize = 2;

/// How many blocks `n` entries make.
#[inline(always)]
pub fn blocks(n: usize) -> usize {
    n.div_ceil(EIGHT)
}

/// How many of `n` entries the `k`-th block has.
#[inline(always)]
pub fn entries(n: usize, k: usize) -> usize {
    (n - k * EIGHT).min(EIGHT)
}

/// The `k`-th block of a column that changes. An incomplete last block is filled with the column's last entry, in
/// `spare`.
#[inline(always)]
pub fn block<'a, T: Copy>(column: &'a [T], k: usize, spare: &'a mut Option<[T; EIGHT]>) -> &'a [T; EIGHT] {
    let rest = &column[k * EIGHT..];
    match rest.first_chunk() {
        Some(whole) => whole,
        None => spare.insert(std::array::from_fn(|l| rest[l.min(rest.len() - 1)])),
    }
}

/// The numbers of the `k`-th block of a column that changes.
#[inline(always)]
pub fn numbers(column: &[f64], k: usize) -> Eight {
    Eight::new(*block(column, k, &mut None))
}

/// Writes the `k`-th block of a column, as far as the column goes; in place, as what is made first is then copied.
#[inline(always)]
pub fn store<T>(column: &mut [T], k: usize, of: impl Fn(usize) -> T) {
    let rest = &mut column[k * EIGHT..];
    match rest.first_chunk_mut::<EIGHT>() {
        Some(whole) => {
            for l in 0..EIGHT {
                whole[l] = of(l);
            }
        }
        None => {
            for (l, entry) in rest.iter_mut().enumerate() {
                *entry = of(l);
            }
        }
    }
}

/// Writes the numbers of the `k`-th block of a column.
#[inline(always)]
pub fn store_numbers(column: &mut [f64], k: usize, numbers: Eight) {
    let numbers = numbers.to_array();
    store(column, k, |l| numbers[l]);
}

/// Writes the vectors of the `k`-th block of a column.
#[inline(always)]
pub fn store_vectors<const D: usize>(column: &mut [[f64; D]], k: usize, components: &[Eight; D]) {
    store(column, k, |l| {
        let mut vector = [0.0; D];
        for a in 0..D {
            vector[a] = components[a].as_array()[l];
        }
        vector
    });
}

/// Eight vectors, component by component.
#[inline(always)]
pub fn components<const D: usize>(vectors: &[[f64; D]; EIGHT]) -> [Eight; D] {
    let mut components = [Eight::ZERO; D];
    for a in 0..D {
        components[a] = Eight::new(std::array::from_fn(|l| vectors[l][a]));
    }
    components
}

/// Eight matrices, entry by entry: `[a][b]` is that of row `a` and column `b`.
#[inline(always)]
pub fn matrix_entries<const D: usize>(matrices: &[SMatrix<f64, D, D>; EIGHT]) -> [[Eight; D]; D] {
    let mut entries = [[Eight::ZERO; D]; D];
    for a in 0..D {
        for b in 0..D {
            entries[a][b] = Eight::new(std::array::from_fn(|l| matrices[l][(a, b)]));
        }
    }
    entries
}
