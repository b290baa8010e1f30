//! The verification bench of the material point method.
//!
//! A [`case::Case`] is a problem with its parameters, schemes, levels and checks. Running one gives a
//! [`record::Record`] with metrics; checks turn metrics into verdicts ([`verdict::Verdict`]); a study
//! runs many side by side; the report draws. Every hand-off is a plain file, so each later stage runs
//! again without simulating.

pub(crate) mod accuracy;
pub mod bench;
pub mod bless;
pub mod case;
pub mod cases;
pub(crate) mod check;
#[cfg(test)]
mod crash;
pub(crate) mod demand;
pub(crate) mod draw;
pub mod error;
pub mod factor;
pub(crate) mod figure;
pub mod files;
pub(crate) mod foreign;
pub(crate) mod gallery;
pub mod golden;
pub mod job;
pub(crate) mod metric;
pub mod night;
pub(crate) mod prelude;
pub(crate) mod probe;
pub(crate) mod problem;
pub mod record;
pub mod report;
pub(crate) mod results;
pub mod run;
pub(crate) mod sampled;
pub mod score;
pub(crate) mod setup;
pub mod size;
pub(crate) mod sketch;
pub mod spec;
pub(crate) mod statistics;
pub mod study;
pub mod table;
pub mod verdict;
pub(crate) mod wanted;

pub use mpm_exact::{self as exact, parameter};
pub use mpm_solvers::scheme;

/// Each value once, in order of appearance.
pub(crate) fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut seen = Vec::new();
    for value in values {
        if !seen.contains(&value) {
            seen.push(value);
        }
    }
    seen
}
