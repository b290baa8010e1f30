//! Quantities for which a case is run. A run is right only if each was judged and holds.

use crate::verdict::{Kind, Outcome, Verdict};
use serde::Serialize;

/// A quantity for which a case is run.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Wanted {
    pub name: &'static str,
    /// The quantity, its norm and the time at which it counts.
    pub statement: &'static str,
    /// Truth checks that judge it, apart by spaces.
    pub by: &'static str,
    /// Further truth checks that judge it, of which no known limit explains a miss.
    pub firm: &'static str,
    /// Known limits that explain a miss of the first checks, apart by spaces.
    pub limits: &'static str,
    /// Whether runs of which none of the checks says anything have no reference for it, and are not asked.
    pub only_where_referenced: bool,
}

impl Wanted {
    /// A quantity that the checks `by` judge.
    pub(crate) const fn new(name: &'static str, statement: &'static str, by: &'static str) -> Self {
        Self { name, statement, by, firm: "", limits: "", only_where_referenced: false }
    }

    /// With the known limits that explain a miss.
    pub(crate) const fn missed_by(self, limits: &'static str) -> Self {
        Self { limits, ..self }
    }

    /// With checks that judge it too and of which no known limit explains a miss.
    pub(crate) const fn firmly_by(self, firm: &'static str) -> Self {
        Self { firm, ..self }
    }

    /// Not asked of runs of which none of its checks says anything.
    pub(crate) const fn where_referenced(self) -> Self {
        Self { only_where_referenced: true, ..self }
    }

    /// Whether a check is among those that judge it.
    pub(crate) fn is_judged_by(&self, check: &str) -> bool {
        self.checks().any(|name| name == check)
    }

    fn checks(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.by.split(' ').chain(self.firm.split_whitespace())
    }

    /// Names of all checks that judge it, in a sentence.
    pub(crate) fn names(&self) -> String {
        self.checks().collect::<Vec<_>>().join(", ")
    }

    fn judging<'a>(&self, verdicts: &'a [Verdict]) -> impl Iterator<Item = &'a Verdict> + use<'a> {
        let wanted = *self;
        verdicts.iter().filter(move |v| v.kind == Kind::Truth && wanted.is_judged_by(&v.check))
    }

    /// Turns a miss into *wrong as known* where a known limit explains it. A value that is not a number is never explained.
    fn explain(&self, verdicts: &mut [Verdict]) {
        let seen =
            |v: &&Verdict| v.outcome == Outcome::WrongAsKnown && self.limits.split(' ').any(|name| name == v.check);
        let Some(limit) = verdicts.iter().find(seen).map(|v| v.check.clone()) else { return };
        let missed = |v: &&mut Verdict| {
            let is_number = v.value.is_some_and(f64::is_finite);
            v.kind == Kind::Truth && v.failed() && is_number && self.by.split(' ').any(|name| name == v.check)
        };
        for verdict in verdicts.iter_mut().filter(missed) {
            verdict.outcome = Outcome::WrongAsKnown;
            verdict.source = format!("known limit {limit}; {}", verdict.source);
        }
    }

    /// The verdict of its checks together: the worst one, *not judged* where none of them was applied.
    fn verdict(&self, verdicts: &[Verdict]) -> Option<Verdict> {
        if self.only_where_referenced && self.judging(verdicts).next().is_none() {
            return None;
        }
        let worst = [Outcome::Failed, Outcome::WrongAsKnown, Outcome::Right];
        let outcome = worst.into_iter().find(|o| self.judging(verdicts).any(|v| v.outcome == *o));
        let names = |outcome| {
            let own = self.judging(verdicts).filter(move |v| v.outcome == outcome);
            crate::distinct(own.map(|v| &*v.check)).join(", ")
        };
        let reason = || match self.judging(verdicts).next() {
            Some(v) => format!("{}: {}", v.check, v.source),
            None => format!("none of its checks was applied: {}", self.names()),
        };
        Some(Verdict {
            check: self.name.to_owned(),
            kind: Kind::Wanted,
            metric: self.statement.to_owned(),
            value: None,
            reference: None,
            tolerance: None,
            outcome: outcome.unwrap_or(Outcome::NotJudged),
            source: outcome.map_or_else(reason, names),
        })
    }
}

/// The verdicts of a run, after those on its wanted quantities.
pub(crate) fn settled(wanted: &[Wanted], mut verdicts: Vec<Verdict>) -> Vec<Verdict> {
    wanted.iter().for_each(|w| w.explain(&mut verdicts));
    let mut all: Vec<Verdict> = wanted.iter().filter_map(|w| w.verdict(&verdicts)).collect();
    all.append(&mut verdicts);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::check::Finding;
    use crate::study::judge::outcome_of;

    const DEFLECTION: Wanted = Wanted::new("deflection", "at rest", "mid-edge tip").missed_by("locked");

    fn found(holds: Option<bool>, check: &str, kind: Kind) -> Verdict {
        let finding = match holds {
            Some(holds) => Finding::at_most("m", if holds { 0.5 } else { 2.0 }, 1.0, ""),
            None => Finding::not_applicable("m", "not at rest"),
        };
        finding.verdict(check, kind)
    }

    #[test]
    fn a_run_is_right_only_if_each_wanted_quantity_holds() {
        let law = || found(Some(true), "reaction", Kind::Truth);
        let [hold, miss, none] = [Some(true), Some(false), None].map(|h| found(h, "tip", Kind::Truth));
        let limit = |holds| found(Some(holds), "locked", Kind::KnownLimit);
        let outcome = |verdicts: Vec<Verdict>| outcome_of(settled(&[DEFLECTION], verdicts).iter());
        assert_eq!(outcome(vec![law(), hold.clone()]), Outcome::Right);
        assert_eq!(outcome(vec![law(), hold.clone(), none.clone()]), Outcome::Right);
        assert_eq!(outcome(vec![law(), none]), Outcome::NotJudged);
        assert_eq!(outcome(vec![law()]), Outcome::NotJudged);
        assert_eq!(outcome(vec![law(), miss.clone()]), Outcome::Failed);
        assert_eq!(outcome(vec![law(), miss.clone(), limit(true)]), Outcome::WrongAsKnown);
        assert_eq!(outcome(vec![law(), miss, limit(false)]), Outcome::Failed);
        assert_eq!(outcome(vec![law(), hold, limit(false)]), Outcome::Failed);
        let unmeasured = Finding::at_most("m", f64::NAN, 1.0, "").verdict("tip", Kind::Truth);
        assert_eq!(outcome(vec![law(), unmeasured, limit(true)]), Outcome::Failed);
    }

    /// Names of checks are keys: each is that of a check of its kind on single runs.
    #[test]
    fn every_case_wants_something_that_its_truths_judge() {
        for case in cases::all() {
            assert!(case.wanted.iter().any(|w| !w.only_where_referenced), "{}", case.name);
            let is = |name: &str, kind| case.checks.iter().any(|c| c.name == name && c.kind == kind);
            for wanted in &case.wanted {
                let of = format!("{} {}", case.name, wanted.name);
                assert!(wanted.checks().all(|name| is(name, Kind::Truth)), "{of}");
                assert!(wanted.limits.split_whitespace().all(|name| is(name, Kind::KnownLimit)), "{of}");
            }
        }
    }
}
