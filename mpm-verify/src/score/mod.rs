//! Results of other codes, judged as our runs are: their tables are measured by the functions that measure ours, and the
//! record that comes of it goes through the checks of the case.
//!
//! The format: `docs/reference/score.md`.

pub mod board;
mod columns;
pub mod export;
pub mod gate;
mod legacy;
mod manifest;
mod vtk;
mod vtu;

use crate::case::{Case, find_level};
use crate::cases::find_scored;
use crate::error::Error;
use crate::files::{TABLE, read as read_file, require_inside};
use crate::foreign::{Asked, Foreign, Gap, Given, Group, Part};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::problem::measured;
use crate::record::{Discretisation, Failure, Record, Status};
use crate::scheme::BasisName;
use crate::spec::RunSpec;
use crate::study::convergence::convergence;
use crate::study::summary::{CaseStudy, Summary};
use crate::table::Table;
use crate::verdict::{Kind, Outcome, Verdict};
use crate::wanted::settled;
use manifest::{Ending, FILE, Manifest, Positive};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Relative difference up to which cells are of the same size.
const SAME: f64 = 0.01;

/// Runs of another code for one case, judged.
pub struct Scores {
    /// The case.
    pub case: &'static Case,
    pub(crate) code: String,
    /// The runs.
    pub runs: Vec<Scored>,
    /// Names of runs of one scheme, basis and `repeat`, with verdicts on them together and observed orders.
    pub(crate) together: Vec<(String, CaseStudy)>,
}

/// Verdicts on a run, or on runs together: their name, and whether they are together.
pub(crate) type Judged<'a> = (String, &'a [Verdict], bool);

impl Scores {
    /// Reads and judges the runs in a folder.
    ///
    /// # Errors
    /// The manifest is refused, names what there isn't, has a run or a table twice, or a table can't be read or measured:
    /// the error names file, run and key or column.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let tables = |of: &Manifest| [&of.particles, &of.series].map(Clone::clone).into_iter().flatten();
        let whole = |run: &Scored| {
            let (scheme, basis, repeat) = run.method();
            (scheme.clone(), basis, repeat.cloned(), run.record.level.clone(), run.record.parameters.clone())
        };
        let mut runs = Vec::<Scored>::new();
        for manifest in Manifest::read(folder)? {
            let shares = |run: &&Scored| tables(&run.manifest).any(|name| tables(&manifest).any(|own| own == name));
            if let Some(other) = runs.iter().find(shares) {
                return Err(manifest.refuse(folder, "tables", format!("{} names one of them too", other.name())));
            }
            let run = Scored::of(folder, manifest)?;
            if let Some(other) = runs.iter().find(|other| whole(other) == whole(&run)) {
                let said = format!("{} is the same run; allowed: another scheme or `repeat`", other.name());
                return Err(run.manifest.refuse(folder, "level", said));
            }
            runs.push(run);
        }
        let Some(first) = runs.first() else { return Err(Error::file(&folder.join(FILE), "no run")) };
        let (case, code) = (first.case, first.manifest.code.name.0.clone());
        let together = crate::distinct(runs.iter().map(Scored::method)).into_iter().map(|own| {
            let own: Vec<&Scored> = runs.iter().filter(|run| run.method() == own).collect();
            let names: Vec<String> = own.iter().map(|run| run.name()).collect();
            (names.join(", "), together(case, &own))
        });
        Ok(Self { case, code, together: together.collect(), runs })
    }

    /// Counts and verdicts of all runs, as for our own.
    pub(crate) fn summary(&self) -> Summary {
        Summary::new("score", self.together.iter().map(|(_, study)| study.clone()).collect())
    }

    /// Whether the manifest has a list of runs.
    pub(crate) fn is_list(&self) -> bool {
        self.runs.iter().any(|run| run.manifest.run > 0)
    }

    /// The verdicts on each run, then those on runs together.
    pub(crate) fn judged(&self) -> Vec<Judged<'_>> {
        let runs = self.runs.iter().map(|run| (run.name(), &run.record.verdicts[..], false));
        let together = self.together.iter().map(|(runs, s)| (format!("{runs} together"), &s.verdicts[..], true));
        runs.chain(together).collect()
    }
}

/// Runs of one method with the verdicts of the case's own checks on runs together, and the orders that show.
fn together(case: &Case, runs: &[&Scored]) -> CaseStudy {
    let mut study = CaseStudy::new(case.name, runs.iter().map(|run| run.record.clone()).collect());
    let missing = crate::distinct(runs.iter().flat_map(|run| &run.missing).map(Asked::place)).join(", ");
    let is_asked = |check: &str| find_scored(case.name).is_ok_and(|(_, foreign)| foreign.asks(check));
    let why = |v: &Verdict| match [v.value, v.reference, v.tolerance].into_iter().flatten().any(f64::is_nan) {
        _ if !is_asked(&v.check) => Some("against the discrete equations of our scheme".to_owned()),
        true => Some(format!("the runs do not give all that it compares (missing: {missing})")),
        false => runs.iter().find_map(|run| open(&run.gaps, v)),
    };
    if runs.len() > 1 {
        study.verdicts = demands(case.judge_study(&study.records), why).collect();
        study.convergence = convergence(case, &study.records);
    }
    study
}

/// A run of another code, judged.
pub struct Scored {
    /// Manifest of the result.
    pub(crate) manifest: Manifest,
    /// The case.
    pub case: &'static Case,
    /// The record, as of a run of the scheme as which it is judged.
    pub record: Record,
    /// Columns that the case asks for and that are not there.
    pub missing: Vec<Asked>,
    /// Columns that are there and that the case knows nothing of.
    pub(crate) unknown: Vec<String>,
    /// Metrics that the rows leave open.
    gaps: Vec<(Metric, Gap)>,
}

impl Scored {
    /// Its name among the runs.
    pub(crate) fn name(&self) -> String {
        match self.manifest.run {
            0 => self.record.level.clone(),
            run => format!("run {run} ({})", self.record.level),
        }
    }

    /// Scheme, basis and `repeat`: runs that share these differ in level and parameters.
    fn method(&self) -> (&manifest::Line, BasisName, Option<&manifest::Line>) {
        (&self.manifest.scheme, self.manifest.basis, self.manifest.repeat.as_ref())
    }

    fn of(folder: &Path, manifest: Manifest) -> Result<Self, Error> {
        let refuse = |key: &str, e: Error| manifest.refuse(folder, key, e);
        let (case, foreign) = find_scored(&manifest.case.0).map_err(|e| refuse("case", e))?;
        let level = find_level(case, &manifest.level.0).map_err(|e| refuse("level", e))?;
        if let Some(Positive(size)) = manifest.cell_size_m.filter(|size| (size.0 / level.h - 1.0).abs() > SAME) {
            let said = format!("{size}; allowed: {}, that of the level {}", level.h, level.name);
            return Err(manifest.refuse(folder, "cell_size_m", said));
        }
        let set = manifest.parameters.clone();
        let parameters = Parameters::new(&case.parameters, &set).map_err(|e| refuse("parameters", e.into()))?;
        let spec = RunSpec { scheme: (foreign.judged_as)(manifest.basis), level, set, perturbed: false };
        let dt = manifest.time_step_s.map_or(f64::NAN, |dt| dt.0);
        let (tables, lines) = match manifest.status {
            Ending::Finished => tables(folder, &manifest, foreign)?,
            _ => Default::default(),
        };
        let own = (foreign.discretisation)(&spec, &parameters).map_err(|e| refuse("parameters", e))?;
        let (discretisation, steps) = (Discretisation { dt, ..own }, manifest.cost.steps);
        let given = Given { discretisation, spec, parameters, steps, tables };
        let asked = foreign.columns();
        let unknown = given.require_heads(&asked)?;
        if let Some(abscissa) = &foreign.abscissa {
            given.require_order(abscissa, &lines)?;
        }
        given.require_whole_body(|| (foreign.start)(&given.spec, &given.parameters))?;
        let gaps = (foreign.gaps)(&given)?;
        let missing = asked.into_iter().filter(|a| !given.has(a)).collect();
        let mut record = Record::blank(case.name, &given.spec, &given.parameters, given.discretisation.clone(), 0);
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
                    record.metrics.extend([measured((*metric, own.unwrap_or(f64::NAN)))]);
                }
            }
        }
        record.verdicts = judge(case, foreign, &given, &gaps, &record);
        if manifest.status != Ending::Finished {
            let message = manifest.said.as_ref().map_or("it gives no reason", |said| &said.0).to_owned();
            record.status = Status::Failed;
            record.error = Some(Failure::told(message));
        }
        Ok(Self { manifest, case, record, missing, unknown, gaps })
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
        let Some(name) = name.as_ref().filter(|_| asked.contains(&part)) else { continue };
        require_inside(folder, Path::new(&name.0))?;
        let path = folder.join(&name.0);
        let table = match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => {
                let (table, own) = columns::read(&path)?;
                if part == Part::Series {
                    lines = own;
                }
                table
            }
            Some(kind @ ("vtk" | "vtp" | "vtu")) if part == Part::Particles => {
                let read = if kind == "vtk" { legacy::table } else { vtu::table };
                let table = read(&read_file(&path, TABLE)?).map_err(|said| Error::file(&path, said))?;
                // Arrays for ParaView have plain names, without units.
                let known = foreign.columns();
                let head = |name: &str| known.iter().find(|a| a.part == part && a.name == name).map(Asked::header);
                let column = |(name, values): (&str, &[f64])| (head(name).unwrap_or(name.to_owned()), values.to_vec());
                Table::of_columns(table.iter().map(column))
            }
            _ => {
                let allowed = match part {
                    Part::Particles => "a .csv, .vtu, .vtp or .vtk file",
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
    let why = |v: &Verdict| {
        let lacking =
            group_of(foreign, v).into_iter().flat_map(|g| g.columns).filter(|c| !given.has(c)).map(Asked::place);
        let lacking: Vec<String> = lacking.collect();
        if lacking.is_empty() { open(gaps, v) } else { Some(format!("missing: {}", lacking.join(", "))) }
    };
    let judged =
        demands(case.verdicts(record), why).filter(|v| foreign.asks(&v.check) && group_of(foreign, v).is_some());
    settled(&case.wanted, judged.collect())
}

/// The group that measures what a verdict is on.
fn group_of<'a>(foreign: &'a Foreign, v: &Verdict) -> Option<&'a Group> {
    foreign.groups.iter().find(|g| g.metrics.iter().any(|m| m.name == v.metric))
}

/// The demands on every code among verdicts, without known limits of our schemes. One with a reason is not judged.
fn demands(all: Vec<Verdict>, why: impl Fn(&Verdict) -> Option<String>) -> impl Iterator<Item = Verdict> {
    all.into_iter().filter(|v| matches!(v.kind, Kind::Truth | Kind::Bookkeeping)).map(move |v| match why(&v) {
        Some(why) => Verdict { outcome: Outcome::NotJudged, value: None, source: why, ..v },
        None => v,
    })
}

/// Why the rows leave a verdict open, if they do.
fn open(gaps: &[(Metric, Gap)], v: &Verdict) -> Option<String> {
    let mut own = gaps.iter().filter(|(metric, _)| metric.name == v.metric);
    own.find_map(|(_, gap)| gap.refusal(v.tolerance))
}

#[cfg(test)]
mod tests;
