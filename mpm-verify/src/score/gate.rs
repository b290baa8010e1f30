//! Whether a result passes as a gate of continuous integration: what must be judged, beside what must not fail.

use super::*;
use crate::distinct;
use crate::error::ExitCode;

/// Reason of a demanded check of which there is no verdict.
pub(crate) const INAPPLICABLE: &str = "it does not apply to this result";

/// Demands on a result beyond that no check fails.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Gate {
    /// Whether each wanted quantity must be judged. Otherwise one of them must be.
    pub strict: bool,
    /// Names of checks and wanted quantities that must be judged and hold.
    pub require: Vec<String>,
}

impl Gate {
    /// Checks the names.
    ///
    /// # Errors
    /// The case has no check of a name: the error names the nearest one.
    pub fn known_to(&self, case: &Case) -> Result<(), Error> {
        let judging = case.checks.iter().filter(|c| matches!(c.kind, Kind::Truth | Kind::Bookkeeping));
        let names = distinct(case.wanted.iter().map(|w| w.name).chain(judging.map(|c| c.name)));
        let Some(unknown) = self.require.iter().find(|name| !names.contains(&&***name)) else { return Ok(()) };
        let distance = |name: &&&str| strsim::damerau_levenshtein(unknown, name);
        let nearest = names.iter().min_by_key(distance).copied().unwrap_or_default();
        let said = Error::unknown(&format!("check of {}", case.name), unknown, names.iter().copied());
        Err(Error::Input(format!("--require: {said}; the nearest is {nearest}")))
    }

    /// Whether a verdict among `all` that is not a failure stands in the way.
    pub(crate) fn stops(&self, all: &[Verdict], verdict: &Verdict) -> bool {
        let open = verdict.outcome == Outcome::NotJudged;
        let none_is_judged = || all.iter().filter(|v| v.is_wanted()).all(|v| v.outcome == Outcome::NotJudged);
        let wanted = verdict.is_wanted() && (self.strict || none_is_judged());
        let required = self.require.contains(&verdict.check);
        open && (wanted || required)
    }

    /// Names that must hold and of which there is no verdict: those on a run, or on runs together.
    pub(crate) fn lacking<'a>(&'a self, scores: &Scores, (_, all, are_together): &Judged<'_>) -> Vec<&'a str> {
        let together = |name: &&str| scores.case.checks.iter().any(|c| c.name == *name && !c.is_of_run());
        let own = self.require.iter().map(String::as_str).filter(|name| together(name) == *are_together);
        own.filter(|name| all.iter().all(|v| v.check != *name)).collect()
    }

    /// Why results do not pass, failures apart; nothing if they do.
    #[must_use]
    pub fn refusal(&self, scores: &Scores) -> Option<String> {
        let of = |on: Judged<'_>| {
            let told = on.1.iter().filter(|v| self.stops(on.1, v)).map(|v| match v.is_wanted() {
                true => format!("{} ({})", v.check, v.source),
                false => format!("{}, {} ({})", v.check, v.metric, v.source),
            });
            let lacking = self.lacking(scores, &on).into_iter().map(|name| format!("{name} ({INAPPLICABLE})"));
            let told = distinct(told.chain(lacking)).join("; ");
            let name = if scores.is_list() { format!("{}: ", on.0) } else { String::new() };
            (!told.is_empty()).then(|| name + &told)
        };
        let told: Vec<String> = scores.judged().into_iter().filter_map(of).collect();
        (!told.is_empty()).then(|| format!("Not passed: not judged: {}", told.join("; ")))
    }

    /// How the program should end.
    #[must_use]
    pub fn exit_code(&self, scores: &Scores) -> ExitCode {
        let failed = scores.judged().iter().any(|(_, all, _)| all.iter().any(Verdict::failed));
        if failed || self.refusal(scores).is_some() { ExitCode::TruthFailed } else { ExitCode::Good }
    }
}
