//! The problems, one file each.

mod cook;

use crate::case::Case;
use crate::error::Error;

/// All problems.
#[must_use]
pub fn all() -> Vec<&'static dyn Case> {
    vec![&cook::Cook]
}

/// The problem of a name.
///
/// # Errors
/// There is none; the error lists those there are.
pub fn find(name: &str) -> Result<&'static dyn Case, Error> {
    let cases = all();
    cases
        .iter()
        .find(|c| c.name() == name)
        .copied()
        .ok_or_else(|| Error::unknown("case", name, cases.iter().map(|c| c.name())))
}
