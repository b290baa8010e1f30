//! Verdicts on one run.

use crate::case::Case;
use crate::check::Finding;
use crate::error::{Error, ExitCode};
use crate::record::{BREAKS_DOWN, Record, Status};
use crate::run::checkpoint::Saving;
use crate::run::execute;
use crate::spec::RunSpec;
use crate::verdict::{Kind, Outcome, Verdict};
use std::path::Path;

/// Runs `spec` of `case` and judges it: see [`execute`].
///
/// # Errors
/// Those of [`execute`].
pub fn judged_run(
    case: &Case,
    spec: &RunSpec,
    place: Option<(&Path, Saving)>,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Record, Error> {
    execute(case, spec, place, threads, &|r| judge(case, r), progress)
}

/// All verdicts on one run.
pub fn judge(case: &Case, record: &Record) -> Vec<Verdict> {
    let mut verdicts = vec![match (case.breaks_down)(record) {
        None => completes(record),
        Some(why) => breaks_down(record, why),
    }];
    if record.status == Status::Ok {
        verdicts.extend(case.judge(record));
    }
    verdicts
}

/// Whether the run came to its end: a check of every case.
fn completes(record: &Record) -> Verdict {
    let ended = f64::from(u8::from(record.status == Status::Ok));
    let why = "the equations have a solution";
    Finding::within("run", ended, 1.0, 0.0, why).verdict("completes", Kind::Bookkeeping)
}

/// Whether a run that is known to break down does.
fn breaks_down(record: &Record, why: &str) -> Verdict {
    let broke = f64::from(u8::from(record.status == Status::Failed));
    Finding::above("run", broke, 0.0, why).verdict(BREAKS_DOWN, Kind::KnownLimit)
}

/// Whether at least one check against the truth, beyond completion, was applied to a run, or it broke
/// down as it is known to.
#[must_use]
pub fn has_truth(record: &Record) -> bool {
    let judges = |kind| matches!(kind, Kind::Truth | Kind::KnownLimit);
    let mut verdicts = record.verdicts.iter();
    verdicts.any(|v| judges(v.kind) && v.outcome != Outcome::NotJudged)
}

/// How the program should end after one run.
#[must_use]
pub fn exit_code(record: &Record) -> ExitCode {
    if record.broke_down() {
        ExitCode::RunFailed
    } else if record.verdicts.iter().any(Verdict::failed) {
        ExitCode::TruthFailed
    } else {
        ExitCode::Good
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::record::fixture::record;

    #[test]
    fn a_breakdown_ends_well_only_where_it_is_known() {
        let mut broken = record("h1", Vec::new());
        broken.status = Status::Failed;
        let cook = cases::find("cook").unwrap();
        broken.verdicts = judge(cook, &broken);
        assert_eq!(exit_code(&broken), ExitCode::RunFailed);
        broken.verdicts = vec![breaks_down(&broken, "as known")];
        assert_eq!(exit_code(&broken), ExitCode::Good);
        broken.status = Status::Ok;
        broken.verdicts = vec![breaks_down(&broken, "as known")];
        assert_eq!(exit_code(&broken), ExitCode::TruthFailed);
    }
}
