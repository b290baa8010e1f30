//! A night of runs: its date and the commit that ran.

use crate::error::Error;
use jiff::civil::Date;
use serde::{Deserialize, Serialize};

/// A night and the commit that ran.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Night {
    pub(crate) date: Date,
    pub(crate) commit: String,
}

/// Whether a text can name a commit: it is shown in pages and stands in cells of tables.
fn is_commit(text: &str) -> bool {
    let fits = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
    let first = text.chars().next().is_some_and(|c| c.is_ascii_alphanumeric());
    first && text.len() <= 100 && text.chars().all(fits)
}

impl Night {
    /// From a date of the form YYYY-MM-DD and a commit.
    ///
    /// # Errors
    /// The date is not of that form, or the commit is empty, long or of other characters than commits have.
    pub fn new(date: &str, commit: &str) -> Result<Self, Error> {
        let refuse = |what: String| Err(Error::Input(what));
        match date.parse() {
            Err(e) => refuse(format!("--night \"{date}\": {e}; allowed: YYYY-MM-DD")),
            Ok(_) if date.len() != "2026-01-01".len() => {
                refuse(format!("--night \"{date}\" is not allowed; allowed: YYYY-MM-DD"))
            }
            Ok(_) if !is_commit(commit) => refuse(format!(
                "--commit \"{commit}\" is not allowed; allowed: 1 to 100 letters, digits, -, _, . and /, no sign first"
            )),
            Ok(date) => Ok(Self { date, commit: commit.to_owned() }),
        }
    }
}
