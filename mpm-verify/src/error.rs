//! Errors of the harness and the exit codes of the command line.

use std::path::{Path, PathBuf};
use thiserror::Error;

/// Most characters of a message.
const LONGEST: usize = 3000;

/// Whether a character has no place in a line of text: it moves the cursor, turns the direction of reading or is not seen.
#[must_use]
pub fn is_unfit(c: char) -> bool {
    let unseen = matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}');
    c.is_control() || unseen || matches!(c, '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

/// A message as one line: what has no place in it escaped, and its middle left out if it is very long.
#[must_use]
pub fn one_line(message: &str) -> String {
    let mut line = String::new();
    for c in message.chars() {
        if is_unfit(c) { line.extend(c.escape_default()) } else { line.push(c) }
    }
    let ends: Vec<usize> = line.char_indices().map(|(place, _)| place).collect();
    if ends.len() > LONGEST {
        let middle = ends[LONGEST / 2]..ends[ends.len() - LONGEST / 2];
        line.replace_range(middle, " … ");
    }
    line
}

/// The name that an unknown one in the message of serde is nearest to: the message has the names between backticks, the
/// unknown one first.
pub(crate) fn nearest(said: &str) -> Option<&str> {
    if !said.starts_with("unknown ") {
        return None;
    }
    let mut names = said.split('`').skip(1).step_by(2);
    let given = names.next()?;
    let distance = |name: &&str| strsim::damerau_levenshtein(given, name);
    let name = names.min_by_key(distance)?;
    (distance(&name) <= 1 + given.len() / 3).then_some(name)
}

/// How the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum ExitCode {
    /// All good.
    Good = 0,
    /// A TRUTH check failed.
    TruthFailed = 1,
    /// Usage or input.
    Input = 2,
    /// Results differ from the goldens, and no check against the truth failed.
    Drift = 3,
    /// A run failed numerically.
    RunFailed = 4,
}

/// An error that ends the program.
#[derive(Debug, Error)]
pub enum Error {
    /// Invalid request; the text names the valid values.
    #[error("{0}")]
    Input(String),
    /// The scene could not be built from the parameters.
    #[error("{0}")]
    Scene(#[from] mpm_core::Error),
    /// A scheme or a part of one is not known by this name.
    #[error(transparent)]
    Name(#[from] mpm_solvers::scheme::NameError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Picture(Box<dyn std::error::Error + Send + Sync>),
    /// The run cannot resume from a checkpoint.
    #[error("{}: {refusal}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// Why not.
        refusal: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A file or folder could not be read or written.
    #[error("{}: {cause}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The cause.
        cause: String,
    },
}

impl Error {
    /// A file error.
    pub fn file(path: &Path, cause: impl ToString) -> Self {
        Self::File { path: path.to_path_buf(), cause: cause.to_string() }
    }

    /// "unknown {kind} "{given}"; allowed: …".
    #[must_use]
    pub fn unknown<'a>(kind: &str, given: &str, allowed: impl IntoIterator<Item = &'a str>) -> Self {
        mpm_exact::Error::unknown(kind, given, allowed).into()
    }
}

impl From<mpm_exact::Error> for Error {
    fn from(refusal: mpm_exact::Error) -> Self {
        Self::Input(refusal.to_string())
    }
}
