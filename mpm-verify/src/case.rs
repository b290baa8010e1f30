//! What a problem must say of itself.

use crate::error::Error;
use crate::parameter::{Parameter, Parameters};
use crate::record::{Discretisation, Metric, Record, WorkDone};
use crate::scheme::Scheme;
use crate::sketch::Sketch;
use crate::verdict::{Kind, Verdict};
use mpm_core::Memory;
use std::collections::BTreeMap;
use std::fmt;

/// When a run is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// Within ten seconds.
    Quick,
    /// On every pull request.
    Pr,
    /// Every night.
    Nightly,
    /// By hand: a night's, and what takes days.
    Long,
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Quick => "quick",
            Self::Pr => "pr",
            Self::Nightly => "nightly",
            Self::Long => "long",
        })
    }
}

/// A level of refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Name.
    pub name: &'static str,
    /// Cell size (m).
    pub h: f64,
}

/// A metric.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MetricInfo {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// What it measures.
    pub meaning: &'static str,
}

/// A check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CheckInfo {
    /// Name.
    pub name: &'static str,
    /// Kind.
    pub kind: Kind,
    /// What it demands, of which schemes, and where the tolerance comes from.
    pub statement: &'static str,
}

/// A quantity whose convergence over the levels is studied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quantity {
    /// The metric.
    pub metric: &'static str,
    /// What it is, as an axis is labelled.
    pub label: &'static str,
    /// Whether the metric is an error, whose exact value is zero; if not, Richardson's extrapolation
    /// stands in for the exact value.
    pub is_error: bool,
}

/// A parameter over whose values the errors are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// The parameter, a number.
    pub parameter: &'static str,
    /// What is drawn of it, as an axis is labelled.
    pub label: &'static str,
    /// What is drawn of a value, such as its distance from a limit; positive if drawn by its logarithm.
    pub abscissa: fn(f64) -> f64,
    /// Whether it is drawn by its logarithm.
    pub logarithmic: bool,
}

/// A column of the table of results.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Headline {
    /// The metric.
    pub metric: &'static str,
    /// Heading, with unit.
    pub heading: &'static str,
    /// Factor from the metric's unit to that of the heading.
    pub factor: f64,
    /// Decimals shown.
    pub decimals: usize,
}

/// A metric by name, unit and meaning.
pub(crate) const fn metric(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
) -> MetricInfo {
    MetricInfo {
        name,
        unit,
        meaning,
    }
}

/// What a run has measured, by name, with the units of `known`; what is not finite has no value.
pub(crate) fn observed<N: Into<String>>(
    known: &[MetricInfo],
    values: Vec<(N, f64)>,
) -> BTreeMap<String, Metric> {
    let metric = |(name, value): (N, f64)| {
        let name = name.into();
        let unit = known
            .iter()
            .find(|m| m.name == name)
            .map_or("-", |m| m.unit);
        let metric = Metric {
            value: value.is_finite().then_some(value),
            unit: unit.to_owned(),
        };
        (name, metric)
    };
    values.into_iter().map(metric).collect()
}

/// A check by name, kind and statement.
pub(crate) const fn check(name: &'static str, kind: Kind, statement: &'static str) -> CheckInfo {
    CheckInfo {
        name,
        kind,
        statement,
    }
}

/// An error whose convergence is studied, by metric and label.
pub(crate) const fn error(metric: &'static str, label: &'static str) -> Quantity {
    Quantity {
        metric,
        label,
        is_error: true,
    }
}

/// A column of the table of results by metric, heading, factor to the heading's unit and decimals.
pub(crate) const fn headline(
    metric: &'static str,
    heading: &'static str,
    factor: f64,
    decimals: usize,
) -> Headline {
    Headline {
        metric,
        heading,
        factor,
        decimals,
    }
}

/// One run of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSpec {
    /// Scheme.
    pub scheme: Scheme,
    /// Level.
    pub level: Level,
    /// Parameters changed from the defaults, as `name=value`.
    pub set: Vec<String>,
    /// Whether every particle starts a last bit beside its place: what such a twin differs in is how far
    /// results can be trusted to the digit.
    pub perturbed: bool,
}

impl RunSpec {
    /// Folder of the run below that of its case.
    #[must_use]
    pub fn folder(&self) -> String {
        let mut folder = run_folder(self.scheme, self.level.name, &self.set);
        if self.perturbed {
            folder.push_str("/twin");
        }
        folder
    }

    /// Where particles seeded at `positions` (m) start: there, or, in a twin, at the next floating-point
    /// number above or below, in turn.
    #[must_use]
    pub fn start_at<const D: usize>(&self, mut positions: Vec<[f64; D]>) -> Vec<[f64; D]> {
        if self.perturbed {
            for (k, x) in positions.iter_mut().flatten().enumerate() {
                *x = if k % 3 == 0 {
                    x.next_up()
                } else {
                    x.next_down()
                };
            }
        }
        positions
    }
}

/// Runs of schemes at a level with the same parameters changed, `name=value` each.
pub(crate) fn runs(level: Level, schemes: &[Scheme], set: &[&str]) -> Vec<RunSpec> {
    let spec = |&scheme: &Scheme| RunSpec {
        scheme,
        level,
        set: set.iter().map(|s| (*s).to_owned()).collect(),
        perturbed: false,
    };
    schemes.iter().map(spec).collect()
}

/// Name of a run, which is also its folder below that of its case.
#[must_use]
pub fn run_folder(scheme: Scheme, level: &str, set: &[String]) -> String {
    let mut folder = format!("{scheme}/{level}");
    for assignment in set {
        folder.push('+');
        folder.push_str(assignment);
    }
    folder
}

/// A named particle column with its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Values in seeding order.
    pub values: Vec<f64>,
}

/// The particles at one time, as columns in seeding order: positions first (x, y, …).
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Time (s).
    pub time: f64,
    /// What is kept of them.
    pub columns: Vec<Column>,
}

/// A running simulation of a case. Its memory is all that it gathers from row to row, with that of what it
/// simulates: a run goes on from a checkpoint by it.
pub trait Job: Memory + Send {
    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// Names (with units) of the columns of the time series.
    fn series_columns(&self) -> Vec<&'static str>;
    /// Runs to the next time of observation and returns that row of the series.
    ///
    /// # Errors
    /// The computation broke down.
    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error>;
    /// Whether the run is complete.
    fn finished(&self) -> bool;
    /// Share of the longest possible run that is done, 0 to 1.
    fn progress(&self) -> f64;
    /// What is kept of the state after the last row, if it is time to keep something.
    fn snapshot(&mut self) -> Option<Snapshot> {
        None
    }
    /// The particles as columns in seeding order: positions first (x, y, …).
    fn particles(&mut self) -> Vec<Column>;
    /// The metrics at the end.
    fn metrics(&mut self) -> BTreeMap<String, Metric>;
    /// Work so far.
    fn work(&self) -> WorkDone;
}

/// A problem.
pub trait Case: Sync {
    /// Name on the command line.
    fn name(&self) -> &'static str;
    /// Title.
    fn title(&self) -> &'static str;
    /// What it is, in a few lines.
    fn description(&self) -> &'static str;
    /// References with their uncertainty.
    fn references(&self) -> Vec<String>;
    /// What it does not show.
    fn limits(&self) -> &'static [&'static str];
    /// Parameters.
    fn parameters(&self) -> &[Parameter];
    /// Schemes that it compares.
    fn schemes(&self) -> Vec<Scheme>;
    /// Levels, coarsest first.
    fn levels(&self) -> &[Level];
    /// Metrics.
    fn metrics(&self) -> &'static [MetricInfo];
    /// Checks.
    fn checks(&self) -> &'static [CheckInfo];
    /// What the table of results shows.
    fn headlines(&self) -> &'static [Headline];
    /// Quantities whose convergence is studied.
    fn quantities(&self) -> &'static [Quantity];
    /// Parameters over whose values the errors are drawn.
    fn sweeps(&self) -> &'static [Sweep];
    /// Columns of the time series, without units, that a reader should see first.
    fn watched(&self) -> &'static [&'static str];
    /// The geometry.
    fn sketch(&self) -> Sketch;
    /// The runs of a tier; of [`Tier::Long`] those that a night does not have.
    fn plan(&self, tier: Tier) -> Vec<RunSpec>;
    /// All runs of a tier: a long one has those of a night too, so that levels stand side by side.
    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = if tier == Tier::Long {
            self.plan(Tier::Nightly)
        } else {
            Vec::new()
        };
        for spec in self.plan(tier) {
            if runs.iter().all(|other| other.folder() != spec.folder()) {
                runs.push(spec);
            }
        }
        runs
    }
    /// Relative cost of a run, to start the longest first.
    fn cost(&self, spec: &RunSpec) -> f64;
    /// The parameters, as `name=value`, at which schemes are run at the most levels: those of its convergence and trends.
    fn ladder(&self) -> &'static [&'static str] {
        &[]
    }
    /// Whether its runs end in a state of rest, which hardly depends on the time step: one with another step then
    /// stands in for a level that has none with the case's own.
    fn settles(&self) -> bool {
        false
    }
    /// Begins a run.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    fn start(&self, spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error>;
    /// Why a run of this kind is known to break down before its end, if it is.
    fn breaks_down(&self, _record: &Record) -> Option<&'static str> {
        None
    }
    /// Verdicts on one run.
    fn judge(&self, record: &Record) -> Vec<Verdict>;
    /// Verdicts on runs together.
    fn judge_study(&self, records: &[Record]) -> Vec<Verdict>;
}

/// Finds a level of a case by name.
///
/// # Errors
/// No level of this name; the error lists those there are.
pub fn find_level(case: &dyn Case, name: &str) -> Result<Level, Error> {
    let levels = case.levels();
    levels
        .iter()
        .find(|l| l.name == name)
        .copied()
        .ok_or_else(|| Error::unknown("level", name, levels.iter().map(|l| l.name)))
}
