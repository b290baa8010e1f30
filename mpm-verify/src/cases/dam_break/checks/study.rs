//! Checks on runs of the dam break together: over levels, against standard MPM, against one change.

use super::{is_averaged, is_flip};
use crate::cases::dam_break::metrics as m;
use crate::cases::dam_break::parameters::{CFL, DURATION, GRAVITY_STAGE, SEED, START};
use crate::cases::dam_break::reference::LENGTH;
use crate::check::{Check, Finding, On, checks, judge, study};
use crate::metric::Metric;
use crate::parameter::Parameter;
use crate::record::{Record, Status};
use crate::scheme::{RemedyName, Scheme};

/// Share of the front's error, a cell, that the time step may add to it.
const TIME_STEP: f64 = 0.1;
/// Relative difference of the front's advance between the two starts, whose pressures differ by twice that.
const STARTS: f64 = 2.5e-3;
/// Largest pressure and checkerboard of F̄ over those of standard MPM.
const SMOOTHER: f64 = 0.5;

pub(super) fn checks() -> Vec<Check> {
    checks! {
        truth "front-converges":
            "F̄ with FLIP: the rms error of the front falls from level to level, with one CFL number"
            => of_finished(|records| falls(records, m::FRONT_RMS_ERROR));
        truth "start-converges":
            "F̄ with FLIP: the rms error of the pressure behind the gate falls from level to level, with one CFL number"
            => of_finished(|records| falls(records, m::PRESSURE_PROFILE_ERROR));
        truth "late-converges":
            "fbar-consistent with FLIP: from level to level, with one CFL number, impulse on the wall and mean centre of mass over 2 s change less, or by less than an ensemble spreads"
            => of_finished(late);
        truth "smoother":
            "F̄: rms and checkerboard of the pressure at 0.4 s are less than half of standard MPM's"
            => of_finished(against_standard);
        truth "starts-agree":
            "all: after a gravity stage the front advances as from the exact start within 0.25 %"
            => of_finished(starts);
        truth "time-step":
            "fbar-consistent with FLIP: a CFL number up to 0.3 moves the front at 0.4 s by less than a tenth of a cell"
            => of_finished(time_steps);
    }
}

/// A check on the runs that have come to their end.
fn of_finished(found: fn(&[&Record]) -> Vec<Finding>) -> On {
    study(move |records| {
        let finished = records.iter().filter(|r| r.status == Status::Ok);
        found(&finished.collect::<Vec<_>>())
    })
}

/// Whether a run is of the case's own problem, but for its time step and for how long it goes on.
fn is_own(record: &Record) -> bool {
    record.changes_none_but(&[CFL.name, DURATION.name])
}

/// Whether an assignment `name=value` is of a parameter.
fn sets(assignment: &str, parameter: Parameter) -> bool {
    assignment.split('=').next() == Some(parameter.name)
}

/// The runs of each scheme of F̄ with FLIP that are divided in time in one way, coarsest first.
fn ladders<'a>(records: &[&'a Record]) -> Vec<(Scheme, Vec<&'a Record>)> {
    let judged = |r: &&&Record| is_own(r) && is_averaged(r) && is_flip(r);
    let mut own: Vec<&Record> = records.iter().filter(judged).copied().collect();
    own.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
    let kinds = crate::distinct(own.iter().map(|r| (r.scheme(), &r.set)));
    let of_kind = |(scheme, set)| {
        let same = |r: &&&Record| (r.scheme(), &r.set) == (scheme, set);
        (scheme, own.iter().filter(same).copied().collect())
    };
    kinds.into_iter().map(of_kind).collect()
}

/// Whether an error falls from level to level.
fn falls(records: &[&Record], metric: Metric) -> Vec<Finding> {
    let mut found = Vec::new();
    for (_, runs) in ladders(records) {
        for pair in runs.windows(2) {
            let (coarse, fine) = (pair[0].metric(metric), pair[1].metric(metric));
            let levels = format!("{} against {}", pair[1].level, pair[0].level);
            let source = format!("{}: {levels}", name(pair[0]));
            found.push(Finding::at_most(metric, fine, coarse, source));
        }
    }
    found
}

/// Scheme and changed parameters of a run.
fn name(run: &Record) -> String {
    format!("{} {}", run.scheme(), run.set.join(" "))
        .trim_end()
        .to_owned()
}

/// Whether what is summed over the whole flow converges.
fn late(records: &[&Record]) -> Vec<Finding> {
    let mut found = Vec::new();
    for (scheme, runs) in ladders(records) {
        let whole = runs.iter().all(|r| !r.metric(m::WALL_IMPULSE).is_nan());
        if scheme.remedy() != RemedyName::FbarConsistent || !whole {
            continue;
        }
        for metric in [m::WALL_IMPULSE, m::CENTRE_X_MEAN] {
            for three in runs.windows(3) {
                let [a, b, c] = [0, 1, 2].map(|k: usize| three[k].metric(metric));
                let levels = [0, 1, 2].map(|k: usize| &three[k].level);
                found.push(Finding::at_most(
                    metric,
                    (c - b).abs(),
                    (b - a).abs() + spread(records, three[0], metric),
                    format!(
                        "{}: from {} to {}, against from {} to {}",
                        name(three[0]),
                        levels[1],
                        levels[2],
                        levels[0],
                        levels[1]
                    ),
                ));
            }
        }
    }
    found
}

/// The range of a metric over an ensemble of the scheme, of the level and the time step that have one.
fn spread(records: &[&Record], like: &Record, metric: Metric) -> f64 {
    let members = |r: &&&Record| r.scheme() == like.scheme() && r.changes_only(SEED.name);
    let values = || records.iter().filter(members).map(|r| r.metric(metric));
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    range.max(0.0)
}

/// What the average of the volume does to the pressure.
fn against_standard(records: &[&Record]) -> Vec<Finding> {
    let mut found = Vec::new();
    for run in records.iter().filter(|r| is_averaged(r)) {
        let standard = records.iter().find(|r| {
            !is_averaged(r)
                && (r.basis(), r.transfer()) == (run.basis(), run.transfer())
                && (&r.level, &r.set) == (&run.level, &run.set)
        });
        let Some(standard) = standard else {
            continue;
        };
        for metric in [m::PRESSURE_RMS, m::CHECKERBOARD_RMS] {
            found.push(judge(run, metric).at_most(
                SMOOTHER * standard.metric(metric),
                format!("{} {} against standard MPM", run.scheme(), run.folder()),
            ));
        }
    }
    found
}

/// What the start changes.
fn starts(records: &[&Record]) -> Vec<Finding> {
    let staged = |r: &Record| r.parameters.is(START, GRAVITY_STAGE);
    let metric = m::FRONT_X_EARLY;
    let found = |(run, own): (&Record, &Record)| {
        judge(run, metric).within(
            own.metric(metric),
            STARTS * (own.metric(metric) - LENGTH),
            format!("{} {}: the exact start", run.scheme(), run.level),
        )
    };
    changed(records, staged, START).map(found).collect()
}

/// What the time step changes.
fn time_steps(records: &[&Record]) -> Vec<Finding> {
    let ours = |r: &Record| r.remedy() == RemedyName::FbarConsistent && is_flip(r);
    let metric = m::FRONT_X_EARLY;
    let found = |(run, own): (&Record, &Record)| {
        let [cfl, of_own] = [run, own].map(|r| r.parameters.number(CFL));
        let name = format!("{} {}", run.scheme(), run.level);
        judge(run, metric).within(
            own.metric(metric),
            TIME_STEP * run.discretisation.h,
            format!("{name}: CFL number {cfl} against {of_own}"),
        )
    };
    changed(records, ours, CFL).map(found).collect()
}

/// Runs with a `parameter` of their own, each with the run that differs from it in that alone; how long they go on
/// aside, the latter is of the case's own parameters.
fn changed<'a>(
    records: &[&'a Record],
    which: impl Fn(&Record) -> bool,
    parameter: Parameter,
) -> impl Iterator<Item = (&'a Record, &'a Record)> {
    let runs = records.iter().copied();
    let runs = runs.filter(move |r| which(r) && r.set.iter().any(|set| sets(set, parameter)));
    runs.filter_map(move |run| {
        let rest = || run.set.iter().filter(|set| !sets(set, parameter));
        let same = |r: &&&Record| {
            (r.scheme(), &r.level) == (run.scheme(), &run.level) && r.set.iter().eq(rest())
        };
        let own = records.iter().find(same)?;
        let is_own = own.set.iter().all(|set| sets(set, DURATION));
        is_own.then_some((run, *own))
    })
}
