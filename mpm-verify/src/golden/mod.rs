//! Goldens: blessed results, so that drift is seen. They never stand in for the truth.
//!
//! `golden/<case>.json` holds, run by run, the metrics, a few rows of the watched columns of the time series and the
//! counts of work, each with its measured response to a last-bit perturbation of the starting positions, below the
//! lines of the blessings. `golden/<case>.png` shows the watched columns of a run of each scheme, and
//! `golden/<case>-field.csv` and `.png` of some cases the particles of the first run. A number may move by [`FLOOR`] of
//! its column's scale, which leaves room for another order of the same sums; one that responds by more than
//! [`BLUNT`] of it is no golden and is left out. A count may not move, unless the perturbation moves it.

mod compare;
mod field;
mod format;
mod measure;
mod picture;

pub use compare::Goldens;
pub use format::{Column, Golden, Point, Run};

use crate::case::{Case, Tier};
use crate::cases;
use crate::check::Finding;
use crate::error::Error;
use crate::record::Record;
use crate::run::series;
use crate::spec::RunSpec;
use crate::table::Table;
use crate::verdict::{Kind, Outcome, Verdict};
use image::RgbImage;
use std::path::{Path, PathBuf};

/// The tier whose runs carry goldens.
pub const TIER: Tier = Tier::Pr;
/// Tolerance of a number over the scale of its column.
pub const FLOOR: f64 = 1e-7;
/// Largest response of a golden number over the scale of its column.
pub const BLUNT: f64 = FLOOR / 100.0;
/// Tolerance of a count over its response.
pub const MARGIN: f64 = 10.0;
/// Name of the check.
const CHECK: &str = "golden";
/// The count that stands for the cost of a run, and that is reported where no count has changed.
const PAIRS: &str = "work/particle_node_pairs";
/// The count that stands for the cost of a run by Newton's method.
const NONZEROS: &str = "work/nonzeros";

pub(crate) fn file(root: &Path, case: &str) -> PathBuf {
    root.join(format!("{case}.json"))
}

/// The folder of the goldens: `asked`, or that of the working directory, or else of the checkout that the program was
/// built from.
#[must_use]
pub fn place(asked: Option<PathBuf>) -> PathBuf {
    let here = PathBuf::from("golden");
    let built = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../golden");
    asked.unwrap_or_else(|| if here.is_dir() { here } else { built() })
}

/// Picture of a case: of the runs that [`Golden::shown`] names.
pub(crate) fn picture_file(root: &Path, case: &str) -> PathBuf {
    root.join(format!("{case}.png"))
}

/// The runs of a case that carry goldens, in the order of the plan.
#[must_use]
pub fn runs(case: &Case) -> Vec<String> {
    case.runs(TIER).iter().map(RunSpec::folder).collect()
}

/// Why no golden is kept of a run, if none is.
pub(crate) fn why_none(case: &Case, record: &Record) -> Option<String> {
    if (case.breaks_down)(record).is_some() {
        Some("the run breaks down as it is known to: nothing to compare".to_owned())
    } else if !runs(case).contains(&record.folder()) {
        Some(format!("goldens are kept of the runs of tier {TIER} only"))
    } else {
        None
    }
}

/// The table from which the golden field of a case is taken, if it is one of the run in `folder`.
pub(crate) fn field_table(case: &Case, record: &Record, folder: &Path) -> Option<PathBuf> {
    let view = case.field.filter(|_| runs(case).first() == Some(&record.folder()))?;
    Some(field::table(&view, folder))
}

/// Particle–node pairs of all golden runs of a case whose count does not answer rounding.
///
/// # Errors
/// The case is not known, or a run has no golden.
pub fn pairs(root: &Path, case: &str) -> Result<u64, Error> {
    count(root, case, PAIRS)
}

/// Entries of the matrices that all golden runs of a case factorise, over all factorisations; of runs without any none.
///
/// # Errors
/// The case is not known, or a run has no golden.
pub fn nonzeros(root: &Path, case: &str) -> Result<u64, Error> {
    count(root, case, NONZEROS)
}

/// The sum of a count over all golden runs of a case that have it.
fn count(root: &Path, case: &str, count: &str) -> Result<u64, Error> {
    let path = file(root, case);
    let golden = Golden::read(&path)?;
    let of_run = |run: String| {
        let found = golden.run(&run);
        let found = found.ok_or_else(|| Error::file(&path, format!("no golden of {run}")))?;
        Ok(found.columns.iter().find(|c| c.quantity == count).map_or(0, |c| c.points[0].value as u64))
    };
    runs(cases::find(case)?).into_iter().map(of_run).sum()
}

fn of_drift(found: Finding) -> Verdict {
    found.verdict(CHECK, Kind::Drift)
}

/// A failed comparison that has no numbers.
fn mismatch(metric: &str, why: &str) -> Verdict {
    Verdict { outcome: Outcome::Failed, ..of_drift(Finding::not_applicable(metric, why)) }
}

/// The name of a column without its unit.
fn bare(column: &str) -> &str {
    column.split(" (").next().unwrap_or(column)
}

#[cfg(test)]
mod tests;
