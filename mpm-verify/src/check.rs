//! Checks of a case: each has a name of its own, and the data by which it is decided.

use crate::record::Record;
use crate::verdict::{Kind, Outcome, Verdict};
use serde::Serialize;

/// A check of a case.
#[derive(Serialize)]
pub struct Check {
    pub name: &'static str,
    pub kind: Kind,
    /// Its demand, the schemes it applies to, and the origin of the tolerance.
    pub statement: &'static str,
    /// Data by which it is decided, and the rule.
    #[serde(skip)]
    pub(crate) on: On,
}

type OfRun = Box<dyn Fn(&Record) -> Vec<Finding> + Send + Sync>;
type OfStudy = Box<dyn Fn(&[Record]) -> Vec<Finding> + Send + Sync>;

/// Data by which a check is decided, and the rule; without a statement of the rule nothing is found.
pub(crate) enum On {
    /// One run that has come to its end.
    Run(OfRun),
    /// All runs of a case together.
    Study(OfStudy),
}

impl Check {
    /// Verdicts on one run.
    pub(crate) fn of_run(&self, record: &Record) -> Vec<Verdict> {
        match &self.on {
            On::Run(found) => self.verdicts(found(record)),
            On::Study(_) => Vec::new(),
        }
    }

    /// Verdicts on the runs of a case together.
    pub(crate) fn of_study(&self, records: &[Record]) -> Vec<Verdict> {
        match &self.on {
            On::Run(_) => Vec::new(),
            On::Study(found) => self.verdicts(found(records)),
        }
    }

    /// Whether it is decided by one run.
    pub(crate) fn is_of_run(&self) -> bool {
        matches!(self.on, On::Run(_))
    }

    fn verdicts(&self, found: Vec<Finding>) -> Vec<Verdict> {
        found.into_iter().map(|f| f.verdict(self.name, self.kind)).collect()
    }
}

/// Finding of a check; the judge adds whose finding it is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Finding {
    metric: String,
    value: Option<f64>,
    reference: Option<f64>,
    tolerance: Option<f64>,
    holds: Option<bool>,
    /// Magnitude of the value, if it isn't that of the reference.
    scale: Option<f64>,
    source: String,
}

impl Finding {
    /// |value − reference| ≤ tolerance. It can't be decided by a tolerance that lets nothing at all pass for the
    /// reference: by one that isn't below |reference|, or below [a stated scale](Self::of_scale).
    pub(crate) fn within(
        metric: impl Into<String>,
        value: f64,
        reference: f64,
        tolerance: f64,
        source: impl Into<String>,
    ) -> Self {
        Self {
            value: Some(value),
            reference: Some(reference),
            tolerance: Some(tolerance),
            holds: Some((value - reference).abs() <= tolerance),
            ..Self::not_applicable(metric, source)
        }
    }

    pub(crate) fn at_most(metric: impl Into<String>, value: f64, bound: f64, source: impl Into<String>) -> Self {
        let holds = Some(value <= bound);
        Self { value: Some(value), tolerance: Some(bound), holds, ..Self::not_applicable(metric, source) }
    }

    pub(crate) fn above(metric: impl Into<String>, value: f64, bound: f64, source: impl Into<String>) -> Self {
        Self { holds: Some(value > bound), ..Self::at_most(metric, value, bound, source) }
    }

    /// The check does not apply, and why: never a pass.
    pub(crate) fn not_applicable(metric: impl Into<String>, why: impl Into<String>) -> Self {
        Self {
            metric: metric.into(),
            value: None,
            reference: None,
            tolerance: None,
            holds: None,
            scale: None,
            source: why.into(),
        }
    }

    /// With what a wrong value is of the order of, where the reference is zero or what is left of two.
    pub(crate) fn of_scale(self, scale: f64) -> Self {
        Self { scale: Some(scale), ..self }
    }

    /// Reason why the value can't be judged right: the tolerance is as large as the value.
    fn too_wide(&self) -> Option<String> {
        let (reference, tolerance) = self.reference.zip(self.tolerance)?;
        let scale = self.scale.unwrap_or(reference.abs());
        (tolerance > 0.0 && tolerance >= scale)
            .then(|| format!("a tolerance of {tolerance:.2e} can't tell a value of the order of {scale:.2e} from none"))
    }

    /// As a verdict of a check of some kind.
    pub(crate) fn verdict(self, check: &str, kind: Kind) -> Verdict {
        let outcome = match (self.holds, kind) {
            (None, _) => Outcome::NotJudged,
            (Some(false), _) => Outcome::Failed,
            (Some(true), Kind::KnownLimit) => Outcome::WrongAsKnown,
            (Some(true), _) => Outcome::Right,
        };
        let untold = self.too_wide().filter(|_| outcome != Outcome::Failed && kind != Kind::Drift);
        Verdict {
            check: check.to_owned(),
            kind,
            metric: self.metric,
            value: self.value,
            reference: self.reference,
            tolerance: self.tolerance,
            outcome: if untold.is_some() { Outcome::NotJudged } else { outcome },
            source: untold.unwrap_or(self.source),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_is_not_a_number_never_passes() {
        let nan = f64::NAN;
        for found in [
            Finding::within("m", nan, 1.0, 1.0, ""),
            Finding::at_most("m", nan, 1.0, ""),
            Finding::above("m", nan, 1.0, ""),
        ] {
            assert!(found.clone().verdict("c", Kind::Truth).failed());
            assert!(found.verdict("c", Kind::KnownLimit).failed());
        }
    }

    #[test]
    fn a_tolerance_as_large_as_what_is_judged_lets_nothing_pass() {
        let judged = |found: &Finding| found.clone().verdict("c", Kind::Truth).outcome;
        let wide = Finding::within("m", 1.9, 1.0, 1.0, "");
        assert_eq!(judged(&wide), Outcome::NotJudged);
        let failed = Finding::within("m", 2.1, 1.0, 1.0, "");
        assert_eq!(judged(&failed), Outcome::Failed);
        let sharp = Finding::within("m", 1.9, 1.0, 0.99, "");
        assert_eq!(judged(&sharp), Outcome::Right);
        let zero = Finding::within("m", 0.05, 0.0, 0.1, "");
        assert_eq!(judged(&zero), Outcome::NotJudged);
        assert_eq!(judged(&zero.clone().of_scale(1.0)), Outcome::Right);
        assert_eq!(judged(&zero.clone().of_scale(0.1)), Outcome::NotJudged);
        let drift = zero.verdict("c", Kind::Drift).outcome;
        assert_eq!(drift, Outcome::Right);
        let nothing = Finding::within("m", 0.0, 0.0, 0.0, "");
        assert_eq!(judged(&nothing), Outcome::Right);
    }

    #[test]
    fn not_applicable_is_neither_pass_nor_failure() {
        let v = Finding::not_applicable("m", "no reference").verdict("c", Kind::Truth);
        assert_eq!((v.outcome, v.holds()), (Outcome::NotJudged, None));
        assert!(!v.failed());
    }

    #[test]
    fn a_known_limit_is_wrong_as_known_and_fails_when_it_vanishes() {
        let limit = |value| {
            let found = Finding::above("m", value, 1.0, "");
            found.verdict("c", Kind::KnownLimit).outcome
        };
        assert_eq!(limit(2.0), Outcome::WrongAsKnown);
        assert_eq!(limit(1.0), Outcome::Failed);
        let exact = Finding::within("m", 1.0, 1.0, 0.0, "");
        assert_eq!(exact.verdict("c", Kind::Truth).outcome, Outcome::Right);
    }
}
