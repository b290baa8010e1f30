//! Whether a result passes as a gate of continuous integration: what must be judged, beside what must not fail.

use super::Scored;
use crate::case::Case;
use crate::distinct;
use crate::error::{Error, ExitCode};
use crate::study::judge::exit_code;
use crate::verdict::{Kind, Outcome, Verdict};

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
        let judging = judging.filter(|c| c.is_of_run()).map(|c| c.name);
        let names = distinct(case.wanted.iter().map(|w| w.name).chain(judging));
        let Some(unknown) = self.require.iter().find(|name| !names.contains(&&***name)) else {
            return Ok(());
        };
        let distance = |name: &&&str| strsim::damerau_levenshtein(unknown, name);
        let nearest = names.iter().min_by_key(distance).copied().unwrap_or_default();
        let kind = format!("check of {}", case.name);
        let said = Error::unknown(&kind, unknown, names.iter().copied());
        Err(Error::Input(format!("--require: {said}; the nearest is {nearest}")))
    }

    /// Whether a verdict that is not a failure stands in the way.
    pub(crate) fn stops(&self, scored: &Scored, verdict: &Verdict) -> bool {
        let open = verdict.outcome == Outcome::NotJudged;
        let wanted = verdict.is_wanted() && (self.strict || judges_nothing(scored));
        let required = self.require.contains(&verdict.check);
        open && (wanted || required)
    }

    /// Names that must hold and of which there is no verdict.
    pub(crate) fn lacking<'a>(&'a self, scored: &'a Scored) -> impl Iterator<Item = &'a str> {
        let judged = |name: &&str| scored.record.verdicts.iter().any(|v| v.check == *name);
        self.require.iter().map(String::as_str).filter(move |name| !judged(name))
    }

    /// Why a result does not pass, failures apart; nothing if it does.
    #[must_use]
    pub fn refusal(&self, scored: &Scored) -> Option<String> {
        let all = &scored.record.verdicts;
        let stopping: Vec<&Verdict> = all.iter().filter(|v| self.stops(scored, v)).collect();
        let told = stopping.iter().map(|v| match v.is_wanted() {
            true => format!("{} ({})", v.check, v.source),
            false => format!("{}, {} ({})", v.check, v.metric, v.source),
        });
        let lacking = self.lacking(scored).map(|name| format!("{name} ({INAPPLICABLE})"));
        let told = distinct(told.chain(lacking));
        match told.is_empty() {
            true => None,
            false => Some(format!("Not passed: not judged: {}", told.join("; "))),
        }
    }

    /// How the program should end.
    #[must_use]
    pub fn exit_code(&self, scored: &Scored) -> ExitCode {
        match (exit_code(&scored.record), self.refusal(scored)) {
            (ExitCode::Good, Some(_)) => ExitCode::TruthFailed,
            (code, _) => code,
        }
    }
}

/// Whether no wanted quantity was judged.
fn judges_nothing(scored: &Scored) -> bool {
    let mut wanted = scored.record.verdicts.iter().filter(|v| v.is_wanted());
    wanted.all(|v| v.outcome == Outcome::NotJudged)
}
