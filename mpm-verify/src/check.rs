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
}

/// The outcome of a check.
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
    /// Whether it holds; absent where the check is not applicable.
    pub pass: Option<bool>,
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
            pass: Some((value - reference).abs() <= tolerance),
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
            pass: Some(value <= bound),
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
            pass: Some(value > bound),
            ..Self::at_most(check, kind, metric, value, bound, source)
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
            pass: None,
            source: why.into(),
        }
    }

    /// Whether the check was applied and does not hold.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.pass == Some(false)
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
        assert_eq!(v.pass, None);
        assert!(!v.failed());
    }
}
