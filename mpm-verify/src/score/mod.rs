//! Results of other codes, judged as our runs are: their tables are measured by the functions that measure ours, and the
//! record that comes of it goes through the checks of the case.
//!
//! The format: `docs/reference/score.md`.

mod columns;
pub mod export;
pub mod gate;
pub mod manifest;
mod vtu;

use crate::case::{Case, find_level};
use crate::cases::find_scored;
use crate::error::Error;
use crate::files::require_inside;
use crate::foreign::{Asked, Foreign, Gap, Given, Part};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::{Discretisation, Measured, Record};
use crate::spec::RunSpec;
use crate::table::Table;
use crate::verdict::{Kind, Outcome, Verdict};
use crate::wanted::settled;
use manifest::{FILE, Manifest, Positive};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A result of another code, judged.
pub struct Scored {
    /// Manifest of the result.
    pub manifest: Manifest,
    /// The case.
    pub case: &'static Case,
    /// The record, as of a run of the scheme as which it is judged.
    pub record: Record,
    /// Columns that the case asks for and that are not there.
    pub missing: Vec<Asked>,
    /// Columns that are there and that the case knows nothing of.
    pub unknown: Vec<String>,
}

impl Scored {
    /// Reads and judges the result in a folder.
    ///
    /// # Errors
    /// The manifest is refused, names what there isn't, or a table can't be read or measured: the error names file and
    /// key or column.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let manifest = Manifest::read(folder)?;
        let refuse = |key: &'static str| move |e: Error| Manifest::refuse(folder, key, &e);
        let (case, foreign) = find_scored(&manifest.case.0).map_err(refuse("case"))?;
        let level = find_level(case, &manifest.level.0).map_err(refuse("level"))?;
        let set = manifest.parameters.clone();
        let parameters = Parameters::new(&case.parameters, &set).map_err(|e| refuse("parameters")(e.into()))?;
        let spec = RunSpec { scheme: (foreign.judged_as)(manifest.basis), level, set, perturbed: false };
        let dt = manifest.time_step_s.map_or(f64::NAN, |dt| dt.0);
        let (tables, lines) = tables(folder, &manifest, foreign)?;
        let own = (foreign.discretisation)(&spec, &parameters).map_err(refuse("parameters"))?;
        let (discretisation, steps) = (Discretisation { dt, ..own }, manifest.cost.steps);
        let given = Given { discretisation, spec, parameters, steps, tables };
        let asked = foreign.columns();
        let unknown = given.require_heads(&asked)?;
        if let Some(abscissa) = &foreign.abscissa {
            given.require_order(abscissa, &lines)?;
        }
        let gaps = (foreign.gaps)(&given)?;
        let missing = asked.into_iter().filter(|a| !given.has(a)).collect();
        let discretisation = given.discretisation.clone();
        let (spec, parameters) = (&given.spec, &given.parameters);
        let mut record = Record::blank(case.name, spec, parameters, discretisation, 0);
        let seconds = |of: Option<Positive>| of.map_or(f64::NAN, |s| s.0);
        let cost = &manifest.cost;
        (record.time.wall_s, record.time.cpu_s) = (seconds(cost.wall_s), seconds(cost.cpu_s));
        record.work.steps = cost.steps.unwrap_or_default();
        record.work.particles = given.rows(Part::Particles) as u64;
        for group in &foreign.groups {
            if group.columns.iter().all(|c| given.has(c)) {
                let values = (group.measure)(&given)?;
                let mut values: BTreeMap<&str, f64> = values.into_iter().map(|(m, value)| (m.name, value)).collect();
                for metric in &group.metrics {
                    // What should have been measured and was not is no number, which no check passes.
                    let own = values.remove(metric.name);
                    let own = gaps.iter().filter(|(of, _)| of == metric).fold(own, |own, (_, gap)| gap.value(own));
                    let value = own.filter(|v| v.is_finite());
                    let unit = metric.unit.to_owned();
                    record.metrics.insert(metric.name.to_owned(), Measured { value, unit });
                }
            }
        }
        record.verdicts = judge(case, foreign, &given, &gaps, &record);
        Ok(Self { manifest, case, record, missing, unknown })
    }
}

/// Tables with their files.
type Tables = Vec<(Part, PathBuf, Table)>;

/// The tables that a manifest names, and the lines of the series' rows.
fn tables(folder: &Path, manifest: &Manifest, foreign: &Foreign) -> Result<(Tables, Vec<u64>), Error> {
    let named = [(Part::Particles, &manifest.particles), (Part::Series, &manifest.series)];
    let asked = foreign.parts();
    let (mut tables, mut lines) = (Vec::new(), Vec::new());
    for (part, name) in named {
        let Some(name) = name.as_ref().filter(|_| asked.contains(&part)) else {
            continue;
        };
        require_inside(folder, Path::new(&name.0))?;
        let path = Manifest::beside(folder, name);
        let table = match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => {
                let (table, own) = columns::read(&path)?;
                if part == Part::Series {
                    lines = own;
                }
                table
            }
            Some("vtu" | "vtp") if part == Part::Particles => vtu::read(&path)?,
            _ => {
                let allowed = match part {
                    Part::Particles => "a .csv, .vtu or .vtp file",
                    Part::Series => "a .csv file",
                };
                let said = format!("{} {:?}; allowed: {allowed}", part.name(), name.0);
                return Err(Error::file(&folder.join(FILE), said));
            }
        };
        tables.push((part, path, table));
    }
    if tables.is_empty() {
        let names: Vec<&str> = asked.iter().map(|p| p.name()).collect();
        let said = format!("no table; this case is scored by: {}", names.join(", "));
        return Err(Error::file(&folder.join(FILE), said));
    }
    Ok((tables, lines))
}

/// The verdicts of the case's own checks on what another code can give: a known limit of our schemes excuses nobody, their
/// discrete equations bind nobody, and what is measured from a column that is missing, or left open by the rows of the
/// series, is not judged.
fn judge(case: &Case, foreign: &Foreign, given: &Given, gaps: &[(Metric, Gap)], record: &Record) -> Vec<Verdict> {
    let unjudged = |v: Verdict, why: String| Verdict { outcome: Outcome::NotJudged, value: None, source: why, ..v };
    let of_code = |v: &Verdict| matches!(v.kind, Kind::Truth | Kind::Bookkeeping) && foreign.asks(&v.check);
    let group_of = |v: &Verdict| foreign.groups.iter().find(|g| g.metrics.iter().any(|m| m.name == v.metric));
    let judged = case.verdicts(record).into_iter().filter(of_code).filter_map(|v| {
        let group = group_of(&v)?;
        let mut lacking = group.columns.iter().filter(|c| !given.has(c)).peekable();
        if lacking.peek().is_none() {
            let mut open = gaps.iter().filter(|(metric, _)| metric.name == v.metric);
            return match open.find_map(|(_, gap)| gap.refusal(v.tolerance)) {
                Some(why) => Some(unjudged(v, why)),
                None => Some(v),
            };
        }
        let lacking = lacking.map(|c| format!("{} of the {}", c.header(), c.part.name()));
        let why = format!("missing: {}", lacking.collect::<Vec<_>>().join(", "));
        Some(unjudged(v, why))
    });
    settled(&case.wanted, judged.collect())
}

#[cfg(test)]
mod tests;
