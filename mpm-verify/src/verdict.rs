//! Verdicts.

use serde::{Deserialize, Serialize};

/// What kind of statement a check makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Against an exact value, an independent reference or a law of physics.
    Truth,
    /// A known limit of the scheme is still there; red when it vanishes.
    KnownLimit,
    /// Against the blessed golden.
    Drift,
    /// That nothing was lost on the way: mass, counts, completion. It holds of a wrong solution as well, so it does
    /// not make a run judged.
    Bookkeeping,
}

/// What a check found.
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

/// What is said of one value.
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
    /// What it is held against.
    pub reference: Option<f64>,
    /// Largest admissible distance from the reference (for a bound: the bound itself).
    pub tolerance: Option<f64>,
    /// What came out.
    pub outcome: Outcome,
    /// Where reference and tolerance come from; why a check is not applicable.
    pub source: String,
}

impl Verdict {
    /// |value − reference| ≤ tolerance.
    #[must_use]
    pub fn close(
        check: &str,
        metric: &str,
        value: f64,
        reference: f64,
        tolerance: f64,
        source: impl Into<String>,
    ) -> Self {
        Self {
            check: check.to_owned(),
            kind: Kind::Truth,
            metric: metric.to_owned(),
            value: Some(value),
            reference: Some(reference),
            tolerance: Some(tolerance),
            outcome: found(Kind::Truth, (value - reference).abs() <= tolerance),
            source: source.into(),
        }
    }

    /// value ≤ bound.
    #[must_use]
    pub fn at_most(
        check: &str,
        kind: Kind,
        metric: &str,
        value: f64,
        bound: f64,
        source: impl Into<String>,
    ) -> Self {
        Self {
            check: check.to_owned(),
            kind,
            metric: metric.to_owned(),
            value: Some(value),
            reference: None,
            tolerance: Some(bound),
            outcome: found(kind, value <= bound),
            source: source.into(),
        }
    }

    /// value > bound.
    #[must_use]
    pub fn above(
        check: &str,
        kind: Kind,
        metric: &str,
        value: f64,
        bound: f64,
        source: impl Into<String>,
    ) -> Self {
        Self {
            outcome: found(kind, value > bound),
            ..Self::at_most(check, kind, metric, value, bound, source)
        }
    }

    /// The same, counted as bookkeeping.
    #[must_use]
    pub fn bookkeeping(self) -> Self {
        Self {
            kind: Kind::Bookkeeping,
            ..self
        }
    }

    /// A check that does not apply, and why: never a pass.
    #[must_use]
    pub fn not_applicable(check: &str, metric: &str, why: impl Into<String>) -> Self {
        Self {
            check: check.to_owned(),
            kind: Kind::Truth,
            metric: metric.to_owned(),
            value: None,
            reference: None,
            tolerance: None,
            outcome: Outcome::NotJudged,
            source: why.into(),
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

    /// Whether the check was applied, is not one of drift, and does not hold.
    #[must_use]
    pub fn misses_the_truth(&self) -> bool {
        self.failed() && self.kind != Kind::Drift
    }

    /// Whether the result has drifted from its golden.
    #[must_use]
    pub fn drifts(&self) -> bool {
        self.failed() && self.kind == Kind::Drift
    }
}

/// The outcome of a check of a kind that was applied.
fn found(kind: Kind, holds: bool) -> Outcome {
    match (holds, kind) {
        (false, _) => Outcome::Failed,
        (true, Kind::KnownLimit) => Outcome::WrongAsKnown,
        (true, _) => Outcome::Right,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_is_not_a_number_never_passes() {
        assert!(Verdict::close("c", "m", f64::NAN, 1.0, 1.0, "").failed());
        assert!(Verdict::at_most("c", Kind::Truth, "m", f64::NAN, 1.0, "").failed());
        assert!(Verdict::above("c", Kind::KnownLimit, "m", f64::NAN, 1.0, "").failed());
    }

    #[test]
    fn not_applicable_is_neither_pass_nor_failure() {
        let v = Verdict::not_applicable("c", "m", "no reference");
        assert_eq!((v.outcome, v.holds()), (Outcome::NotJudged, None));
        assert!(!v.failed());
    }

    #[test]
    fn a_known_limit_is_wrong_as_known_and_fails_when_it_vanishes() {
        let limit = |value| Verdict::above("c", Kind::KnownLimit, "m", value, 1.0, "").outcome;
        assert_eq!(limit(2.0), Outcome::WrongAsKnown);
        assert_eq!(limit(1.0), Outcome::Failed);
        let exact = Verdict::close("c", "m", 1.0, 1.0, 0.0, "");
        assert_eq!(exact.outcome, Outcome::Right);
    }
}
