//! Verdicts on runs of the dam break together: over levels, against standard MPM, against one change.

use super::{is_averaged, is_flip};
use crate::cases::dam_break::reference::LENGTH;
use crate::record::{Record, Status};
use crate::scheme::RemedyName;
use crate::verdict::{Kind, Verdict};

/// Share of the front's error, a cell, that the time step may add to it.
const TIME_STEP: f64 = 0.1;
/// Relative difference of the front's advance between the two starts, whose pressures differ by twice that.
const STARTS: f64 = 2.5e-3;
/// Largest pressure and checkerboard of F̄ over those of standard MPM.
const SMOOTHER: f64 = 0.5;

pub(in crate::cases::dam_break) fn judge_study(records: &[Record]) -> Vec<Verdict> {
    let finished = |r: &&Record| r.status == Status::Ok;
    let records: Vec<Record> = records.iter().filter(finished).cloned().collect();
    let mut verdicts = levels(&records);
    verdicts.extend(against_standard(&records));
    verdicts.extend(starts(&records));
    verdicts.extend(time_steps(&records));
    verdicts
}

/// Whether a run is of the case's own parameters, but for its time step.
fn is_own(record: &Record) -> bool {
    record.is_default() || record.changes_only("cfl")
}

/// Whether the runs of a scheme with one time step converge over the levels.
fn levels(records: &[Record]) -> Vec<Verdict> {
    let judged = |r: &&Record| is_own(r) && is_averaged(r) && is_flip(r);
    let mut own: Vec<&Record> = records.iter().filter(judged).collect();
    own.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
    let mut verdicts = Vec::new();
    for (scheme, set) in crate::distinct(own.iter().map(|r| (r.scheme(), &r.set))) {
        let same = |r: &&&Record| (r.scheme(), &r.set) == (scheme, set);
        let runs: Vec<&Record> = own.iter().filter(same).copied().collect();
        for (check, metric) in [
            ("front-converges", "front_rms_error"),
            ("start-converges", "pressure_profile_error"),
        ] {
            for pair in runs.windows(2) {
                let (coarse, fine) = (pair[0].metric(metric), pair[1].metric(metric));
                verdicts.push(Verdict::at_most(
                    check,
                    Kind::Truth,
                    metric,
                    fine,
                    coarse,
                    format!(
                        "{}: {} against {}",
                        name(pair[0]),
                        pair[1].level,
                        pair[0].level
                    ),
                ));
            }
        }
        if scheme.remedy() == RemedyName::FbarConsistent {
            late(records, &runs, &mut verdicts);
        }
    }
    verdicts
}

/// Scheme and changed parameters of a run.
fn name(run: &Record) -> String {
    format!("{} {}", run.scheme(), run.set.join(" "))
        .trim_end()
        .to_owned()
}

/// Whether what is summed over the whole flow converges.
fn late(records: &[Record], runs: &[&Record], verdicts: &mut Vec<Verdict>) {
    for metric in ["wall_impulse", "centre_x_mean"] {
        for three in runs.windows(3) {
            let change = |k: usize| (three[k + 1].metric(metric) - three[k].metric(metric)).abs();
            verdicts.push(Verdict::at_most(
                "late-converges",
                Kind::Truth,
                metric,
                change(1),
                change(0) + spread(records, three[0], metric),
                format!(
                    "{}: from {} to {}, against from {} to {}",
                    name(three[0]),
                    three[1].level,
                    three[2].level,
                    three[0].level,
                    three[1].level
                ),
            ));
        }
    }
}

/// The range of a metric over an ensemble of the scheme, of the level and the time step that have one.
fn spread(records: &[Record], like: &Record, metric: &str) -> f64 {
    let members = |r: &&Record| r.scheme() == like.scheme() && r.changes_only("seed");
    let values = || records.iter().filter(members).map(|r| r.metric(metric));
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    range.max(0.0)
}

/// What the average of the volume does to the pressure.
fn against_standard(records: &[Record]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for run in records.iter().filter(|r| is_averaged(r)) {
        let standard = records.iter().find(|r| {
            let scheme = run.scheme();
            r.remedy() == RemedyName::None
                && (r.basis(), r.transfer()) == (scheme.basis(), scheme.transfer())
                && (&r.level, &r.set) == (&run.level, &run.set)
        });
        let Some(standard) = standard else {
            continue;
        };
        for metric in ["pressure_rms", "checkerboard_rms"] {
            verdicts.push(Verdict::at_most(
                "smoother",
                Kind::Truth,
                metric,
                run.metric(metric),
                SMOOTHER * standard.metric(metric),
                format!("{} {} against standard MPM", run.scheme(), run.folder()),
            ));
        }
    }
    verdicts
}

/// What the start changes.
fn starts(records: &[Record]) -> Vec<Verdict> {
    let staged = |r: &&Record| r.parameters.is("start", "gravity-stage");
    changed(records, staged, "start")
        .into_iter()
        .map(|(run, own)| {
            let metric = "front_x_0.4s";
            Verdict::close(
                "starts-agree",
                metric,
                run.metric(metric),
                own.metric(metric),
                STARTS * (own.metric(metric) - LENGTH),
                format!("{} {}: the exact start", run.scheme(), run.level),
            )
        })
        .collect()
}

/// What the time step changes.
fn time_steps(records: &[Record]) -> Vec<Verdict> {
    let ours = |r: &&Record| r.remedy() == RemedyName::FbarConsistent && is_flip(r);
    changed(records, ours, "cfl")
        .into_iter()
        .map(|(run, own)| {
            let metric = "front_x_0.4s";
            Verdict::close(
                "time-step",
                metric,
                run.metric(metric),
                own.metric(metric),
                TIME_STEP * run.discretisation.h,
                format!(
                    "{} {}: CFL number {} against {}",
                    run.scheme(),
                    run.level,
                    run.parameters.number("cfl"),
                    own.parameters.number("cfl")
                ),
            )
        })
        .collect()
}

/// Runs that differ from those of the case's own parameters in `parameter` alone, with these.
fn changed<'a>(
    records: &'a [Record],
    which: impl Fn(&&Record) -> bool,
    parameter: &str,
) -> Vec<(&'a Record, &'a Record)> {
    let runs = records.iter().filter(|r| r.changes_only(parameter));
    runs.filter(|r| which(r))
        .filter_map(|run| {
            let same =
                |r: &&Record| r.is_default() && r.scheme() == run.scheme() && r.level == run.level;
            Some((run, records.iter().find(same)?))
        })
        .collect()
}
