//! A night of runs: its date and the commit that ran.

use crate::error::Error;
use jiff::civil::Date;
use serde::{Deserialize, Serialize};

/// A night and the commit that ran.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Night {
    /// Date.
    pub date: Date,
    /// Commit.
    pub commit: String,
}

impl Night {
    /// From a date of the form YYYY-MM-DD and a commit.
    ///
    /// # Errors
    /// The date is not of that form, or the commit is empty.
    pub fn new(date: &str, commit: &str) -> Result<Self, Error> {
        let refuse = |what: String| Err(Error::Input(what));
        match date.parse() {
            Err(e) => refuse(format!("--night \"{date}\": {e}; allowed: YYYY-MM-DD")),
            Ok(_) if commit.trim().is_empty() => refuse("--commit is empty".to_owned()),
            Ok(date) => Ok(Self {
                date,
                commit: commit.to_owned(),
            }),
        }
    }
}
