//! Verdicts on one run.

use super::*;
use crate::check::Finding;
use crate::record::BREAKS_DOWN;

/// Runs `spec` of `case` and judges it: see [`execute`].
///
/// # Errors
/// Those of [`execute`].
pub fn judged_run(
    case: &Case,
    spec: &RunSpec,
    place: Option<(&Path, Saving)>,
    threads: usize,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Record, Error> {
    execute(case, spec, place, threads, &|r| judge(case, r), progress)
}

/// All verdicts on one run.
pub fn judge(case: &Case, record: &Record) -> Vec<Verdict> {
    let ending = match (case.breaks_down)(record).or_else(|| breaks_beside_the_plan(case, record)) {
        None => completes(record),
        Some(why) => breaks_down(record, why),
    };
    let mut verdicts = vec![if case.plans(record) { ending } else { ending.unplanned() }];
    if record.status == Status::Ok {
        verdicts.extend(case.judge(record));
    }
    verdicts
}

/// Largest CFL number with which explicit steps are stable however GIMP's particles and those of splines lie, rounded down:
/// `docs/critical-step.md`.
const STABLE_CFL: f64 = 0.5;

/// Reason why a run that no tier plans may break down as it did, if one is known of schemes in general.
fn breaks_beside_the_plan(case: &Case, record: &Record) -> Option<&'static str> {
    if record.status == Status::Ok || case.plans(record) {
        return None;
    }
    let holds = |name: &str, of: fn(f64) -> bool| {
        case.parameters.iter().find(|p| p.name == name).is_some_and(|p| of(record.parameters.number(*p)))
    };
    match record.scheme() {
        Scheme::Explicit(_) if holds("cfl", |cfl| cfl > STABLE_CFL) => {
            Some("a CFL number above 0.5: such steps are stable for some layouts only")
        }
        Scheme::Implicit(_) if holds("lumped", |share| share == 0.0) => {
            Some("a consistent mass is singular where a function sees few particles")
        }
        _ => None,
    }
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

/// The outcome of verdicts together, those of drift apart: failed if one fails, wrong as known if a known limit is there.
/// Right if each wanted quantity is, or, without any, if a check against the truth holds. Else not judged.
pub fn outcome_of<'a>(verdicts: impl Iterator<Item = &'a Verdict> + Clone) -> Outcome {
    let judged = |outcome| {
        let mut all = verdicts.clone();
        all.any(|v| v.judges() && v.outcome == outcome)
    };
    let mut wanted = verdicts.clone().filter(|v| v.kind == Kind::Wanted);
    match verdicts.clone().any(Verdict::misses_the_truth) {
        true => Outcome::Failed,
        false if judged(Outcome::WrongAsKnown) => Outcome::WrongAsKnown,
        false if judged(Outcome::Right) && wanted.all(|v| v.outcome == Outcome::Right) => Outcome::Right,
        false => Outcome::NotJudged,
    }
}

pub(crate) fn outcome_of_run(record: &Record) -> Outcome {
    if record.broke_down() { Outcome::Failed } else { outcome_of(record.verdicts.iter()) }
}

/// The verdict with the tightest margin among those that judge wanted quantities, of the `records` that are right.
pub fn tightest<'a>(case: &Case, records: &'a [Record]) -> Option<(&'a Record, &'a Verdict)> {
    let wanted = |v: &&Verdict| {
        let judges = v.kind == Kind::Truth && v.outcome == Outcome::Right;
        judges && case.wanted.iter().any(|w| w.is_judged_by(&v.check))
    };
    let right = records.iter().filter(|r| outcome_of_run(r) == Outcome::Right);
    let judged = right.flat_map(|r| r.verdicts.iter().filter(wanted).filter_map(move |v| Some((v.used()?, r, v))));
    judged.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, run, verdict)| (run, verdict))
}

/// Whether a run broke down as it is known to.
pub(crate) fn broke_as_known(record: &Record) -> bool {
    record.status == Status::Failed && !record.broke_down()
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
    fn a_known_limit_has_to_show_in_planned_runs_only() {
        let case = cases::find("cook").unwrap();
        let planned = case.runs(crate::case::Tier::Pr).remove(0);
        let mut run = record(planned.level.name, Vec::new());
        run.set = vec!["load=0.3".to_owned()];
        assert!(!case.plans(&run));
        run.status = Status::Failed;
        assert!(breaks_beside_the_plan(case, &run).is_none());
        run.status = Status::Ok;
        let vanished = breaks_down(&run, "as known");
        assert!(vanished.failed());
        assert_eq!(vanished.unplanned().outcome, Outcome::NotJudged);
    }

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
