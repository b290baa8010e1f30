//! The file of a case's goldens: JSON, with a line per quantity.

use super::*;
use crate::files::{OTHER_LAYOUT, read_text, read_versioned, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Version of the format.
const SCHEMA: u32 = 3;
/// Number of blessings that a file keeps, the last ones.
const BLESSINGS: usize = 5;
/// Largest response of a count, and the same over the count: more than a few rows, sorts or iterations say nothing.
const LOOSE: f64 = 10.0;
const LOOSE_SHARE: f64 = 0.1;
/// Most curves of a picture.
const SHOWN: usize = 6;
/// Prefixes of the name of a column of the series, and of a count of work.
pub(super) const SERIES: &str = "series/";
pub(super) const WORK: &str = "work/";

/// A golden number; in a file the array `[time, value, response]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "Cells", into = "Cells")]
pub struct Point {
    /// Time of its row in the series (s).
    pub time: Option<f64>,
    /// Value, in the unit of its quantity.
    pub value: f64,
    /// Difference of the perturbed twin, at most until then.
    pub response: f64,
}

type Cells = (Option<f64>, f64, f64);

impl From<Cells> for Point {
    fn from((time, value, response): Cells) -> Self {
        Self { time, value, response }
    }
}

impl From<Point> for Cells {
    fn from(point: Point) -> Self {
        (point.time, point.value, point.response)
    }
}

/// The golden numbers of one quantity of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// `metric/NAME (UNIT)`, `series/NAME (UNIT)` or `work/NAME`.
    pub quantity: String,
    /// A row of a series each; of a metric or count one without a time.
    pub points: Vec<Point>,
}

impl Column {
    /// A quantity of one number.
    pub(crate) fn single(quantity: String, value: f64, response: f64) -> Self {
        Self { quantity, points: vec![Point { time: None, value, response }] }
    }

    /// The largest of its numbers.
    pub(crate) fn scale(&self) -> f64 {
        self.points.iter().map(|p| p.value.abs()).fold(0.0, f64::max)
    }

    /// Whether it counts work.
    pub(crate) fn is_count(&self) -> bool {
        self.quantity.starts_with(WORK)
    }

    /// Largest admissible difference from a point.
    pub(crate) fn tolerance(&self, point: &Point) -> f64 {
        match self.is_count() {
            true => MARGIN * point.response,
            // Above ten times any response that is allowed.
            false => FLOOR * self.scale(),
        }
    }

    /// Whether a number answers rounding so strongly that another order of sums would pass for drift.
    pub(crate) fn is_blunt(&self) -> bool {
        !self.is_count() && self.response() > BLUNT * self.scale()
    }

    /// The largest response that a count may have, if it answers rounding more strongly: then it says nothing.
    pub(super) fn is_loose(&self) -> Option<f64> {
        let most = f64::max(LOOSE, LOOSE_SHARE * self.scale());
        (self.is_count() && self.response() > most).then_some(most)
    }

    /// The largest response of its numbers.
    pub(crate) fn response(&self) -> f64 {
        self.points.iter().map(|p| p.response).fold(0.0, f64::max)
    }
}

/// The golden numbers of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Its folder below that of its case.
    pub name: String,
    /// Its quantities.
    pub columns: Vec<Column>,
}

impl Run {
    /// Whether a watched column is among its quantities, so that there is something to draw.
    pub(crate) fn has_series(&self) -> bool {
        self.columns.iter().any(|c| c.quantity.starts_with(SERIES))
    }
}

/// The goldens of a case.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
pub struct Golden {
    /// When, why and by which program the file was blessed, the last time at the end.
    pub blessings: Vec<String>,
    /// Runs, in the order of the plan.
    pub runs: Vec<Run>,
}

impl Golden {
    /// Reads a file of goldens.
    ///
    /// # Errors
    /// It is missing, damaged, of another schema or layout, or without a blessing; a quantity is there twice or has no
    /// number; or a response is larger than that of a golden.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let golden: Self = read_versioned(path, SCHEMA)?;
        golden.check().map_err(|cause| Error::file(path, cause))?;
        match golden.text() {
            Ok(own) if own == read_text(path)? => Ok(golden),
            _ => Err(Error::file(path, OTHER_LAYOUT)),
        }
    }

    /// Checks the content of a file.
    fn check(&self) -> Result<(), String> {
        if self.blessings.is_empty() {
            return Err("no line of a blessing".to_owned());
        }
        let mut seen = BTreeSet::new();
        for (run, column) in self.columns() {
            let name = format!("{run} {}", column.quantity);
            let rises = |p: &[Point]| p[0].time < p[1].time && p[0].response <= p[1].response;
            if !seen.insert(name.clone()) || !column.points.windows(2).all(rises) {
                return Err(format!("{name} is there twice or not in order"));
            }
            if column.points.is_empty() {
                return Err(format!("{name}: no number"));
            }
            if let Some(most) = column.is_loose() {
                return Err(format!("{name}: a count responds by 0 to {most}"));
            }
            if column.is_blunt() || column.points.iter().any(|p| p.response < 0.0) {
                let scale = column.scale();
                return Err(format!("{name}: a golden responds by 0 to {BLUNT:.0e} of its scale, {scale:e}"));
            }
        }
        Ok(())
    }

    fn columns(&self) -> impl Iterator<Item = (&str, &Column)> {
        self.runs.iter().flat_map(|run| run.columns.iter().map(move |c| (&*run.name, c)))
    }

    pub(crate) fn run(&self, name: &str) -> Option<&Run> {
        self.runs.iter().find(|run| run.name == name)
    }

    /// Those that the picture of the case shows: a run of each of the first schemes that have a series, with the level and
    /// parameters that most of them have.
    pub(crate) fn shown(&self) -> Vec<Run> {
        let all = || self.runs.iter().filter(|run| run.has_series());
        let setting = |run: &Run| run.name.split_once('/').map(|(_, setting)| setting.to_owned());
        let count = |run: &&Run| all().filter(|r| setting(r) == setting(run)).count();
        // The first among equally frequent settings.
        let most = all().rev().max_by_key(count).and_then(setting);
        all().filter(|run| setting(run) == most).take(SHOWN).cloned().collect()
    }

    /// Replaces runs of the same name and keeps the others that are among `planned`, in its order.
    pub fn bless(&mut self, new: Vec<Run>, planned: &[String], record: &Record, reason: &str) {
        self.runs.retain(|old| new.iter().all(|r| r.name != old.name));
        self.runs.extend(new);
        self.runs.retain(|run| planned.contains(&run.name));
        self.runs.sort_by_key(|run| planned.iter().position(|name| *name == run.name));
        let now = jiff::Timestamp::now().to_string();
        let words: Vec<&str> = reason.split_whitespace().collect();
        self.blessings.push(format!(
            "{}: {} (source {}, {} {})",
            &now[..now.len().min("2026-01-01".len())],
            words.join(" "),
            record.version.source,
            record.machine.os,
            record.machine.arch
        ));
        let surplus = self.blessings.len().saturating_sub(BLESSINGS);
        self.blessings.drain(..surplus);
    }

    fn text(&self) -> serde_json::Result<String> {
        let blessings = lines(&self.blessings)?;
        let runs = self.runs.iter().map(|run| {
            let (name, columns) = (serde_json::to_string(&run.name)?, lines(&run.columns)?);
            Ok(format!("{{\"name\":{name},\"columns\":[\n{columns}\n]}}"))
        });
        let runs = runs.collect::<serde_json::Result<Vec<String>>>()?;
        Ok(format!("{{\"schema\":{SCHEMA},\"blessings\":[\n{blessings}\n],\"runs\":[\n{}\n]}}\n", runs.join(",\n")))
    }

    /// Writes the file, whole.
    ///
    /// # Errors
    /// It can't be written.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        write_whole(path, self.text().map_err(|e| Error::file(path, e))?.as_bytes())
    }
}

/// JSON values, a line each.
fn lines<T: Serialize>(values: &[T]) -> serde_json::Result<String> {
    let lines: serde_json::Result<Vec<String>> = values.iter().map(serde_json::to_string).collect();
    Ok(lines?.join(",\n"))
}

#[cfg(test)]
mod tests;
