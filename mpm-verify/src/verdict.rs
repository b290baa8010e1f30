//! Verdicts.

use serde::{Deserialize, Serialize};

/// Kind of a check's statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Against an exact value, an independent reference or a law of physics.
    Truth,
    /// A known limit of the scheme is still there; red when it vanishes.
    KnownLimit,
    /// That what was once observed, and no theory demands, is observed still.
    Regression,
    /// Against the blessed golden.
    Drift,
    /// That nothing was lost on the way: mass, counts, completion. It holds of a wrong solution as well, so it does
    /// not make a run judged.
    Bookkeeping,
    /// A quantity for which the case is run, judged by its truths together. Only runs with all of these right are right.
    Wanted,
}

/// Outcome of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// It holds.
    Right,
    /// A known limit is there, as it is known to be.
    WrongAsKnown,
    /// The check does not apply.
    NotJudged,
    /// It does not hold; of a known limit: it has vanished.
    Failed,
}

/// Verdict on one value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the check.
    pub check: String,
    /// Kind.
    pub kind: Kind,
    /// The metric that is judged.
    pub metric: String,
    /// Its value.
    pub value: Option<f64>,
    /// Reference value.
    pub reference: Option<f64>,
    /// Largest admissible distance from the reference (for a bound: the bound itself).
    pub tolerance: Option<f64>,
    /// Outcome.
    pub outcome: Outcome,
    /// Where reference and tolerance come from; why a check is not applicable.
    pub source: String,
}

impl Verdict {
    /// Whether the check says of a result that it is right or wrong: one against the truth or of a known limit.
    #[must_use]
    pub fn judges(&self) -> bool {
        matches!(self.kind, Kind::Truth | Kind::KnownLimit)
    }

    /// Whether it is on a wanted quantity.
    #[must_use]
    pub fn is_wanted(&self) -> bool {
        self.kind == Kind::Wanted
    }

    /// Share of its tolerance, or of its bound, that a value uses.
    pub(crate) fn used(&self) -> Option<f64> {
        let (value, tolerance) = (self.value?, self.tolerance.filter(|t| *t > 0.0)?);
        match self.reference {
            Some(reference) => Some((value - reference).abs() / tolerance),
            None if value > tolerance => Some(tolerance / value),
            None => Some(value.max(0.0) / tolerance),
        }
    }

    /// Whether it may decide the outcome of a run.
    pub(crate) fn decides(&self) -> bool {
        self.judges() || self.failed() || (self.is_wanted() && self.outcome == Outcome::NotJudged)
    }

    /// The verdict on a run that no tier plans. Known limits are established for planned runs, and some references are
    /// known for their parameters only: such a failure becomes *not judged*.
    pub(crate) fn unplanned(self) -> Self {
        let is_nan = |number: Option<f64>| number.is_some_and(f64::is_nan);
        let why = match self.kind {
            Kind::KnownLimit => "the limit does not show in this run, which no tier plans",
            _ if is_nan(self.reference) || is_nan(self.tolerance) => "no reference for these parameters",
            _ => return self,
        };
        match self.failed() {
            true => Self { outcome: Outcome::NotJudged, source: format!("{why}: {}", self.source), ..self },
            false => self,
        }
    }

    /// Whether what the check states is so, a known limit included; nothing where it was not judged.
    #[must_use]
    pub fn holds(&self) -> Option<bool> {
        match self.outcome {
            Outcome::Right | Outcome::WrongAsKnown => Some(true),
            Outcome::Failed => Some(false),
            Outcome::NotJudged => None,
        }
    }

    /// Whether the check was applied and does not hold.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.outcome == Outcome::Failed
    }

    /// Whether the check was applied, is not one of drift, and does not hold. A wanted quantity repeats what its truths say.
    pub(crate) fn misses_the_truth(&self) -> bool {
        self.failed() && !matches!(self.kind, Kind::Drift | Kind::Wanted)
    }

    /// Whether the result has drifted from its golden.
    #[must_use]
    pub fn drifts(&self) -> bool {
        self.failed() && self.kind == Kind::Drift
    }
}
