//! Checks of the stability of the slope. The tolerances are derived in `docs/slope-stability.md`.

use super::super::landslide::parameters::{FACE_ANGLE, HEIGHT};
use super::super::landslide::{STABILITY, factor_of_safety};
use super::{MOST, STANDS_AT, STRENGTH, STRENGTH_REDUCTION_FACTOR, TRIALS};
use crate::check::{Check, Finding, checks, judge, run, study};
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName};

const METRIC: Metric = STRENGTH_REDUCTION_FACTOR;
/// What a slope may exceed its limit by and still be called standing.
const SLOW: f64 = 0.005;
/// Cells (m) up to which standard quadratic splines no longer lock beyond what a band of cells explains.
const FINE: f64 = 0.2;

pub(super) fn checks() -> Vec<Check> {
    checks! {
        truth "lower-bound":
            "all: the factor is above the lower bound of limit analysis less half the last bracket"
            => run(|r| {
                let why = "lower bound of limit analysis: docs/exact.md";
                bounds(r).map(|(lower, _)| judge(r, METRIC).above(lower, why))
            });
        truth "limit-load":
            "F̄, and standard quadratic splines at h ≤ 0.2 m in motion: the factor lies between the lower bound of limit analysis and its upper bound and h/H, by which a band of cells is too strong; both widened by half the last bracket and the half per cent of a slow failure"
            => run(|r| {
                let Some((lower, upper)) = bounds(r) else {
                    let why = "the bounds of limit analysis are those for 45°";
                    return Some(Finding::not_applicable(METRIC, why));
                };
                let (middle, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
                let why = "limit analysis: docs/exact.md";
                let found = judge(r, METRIC).within(middle, half, why);
                (!locks(r)).then_some(found)
            });
        known_limit "locked":
            "none with GIMP, and with quadratic splines at h > 0.2 m or in equilibrium: the slope still stands at a factor above all that"
            => run(|r| {
                bounds(r).filter(|_| locks(r)).map(|(_, upper)| {
                    let why = "standard MPM locks: Zhao et al. 2023, Figure 14";
                    let bound = upper - resolution(r);
                    judge(r, STANDS_AT).above(bound, why)
                })
            });
        truth "factor-converges":
            "fbar-consistent: from level to level the factor comes nearer to that of limit analysis, or stays within the uncertainty of both"
            => study(converges);
        truth "solvers-agree":
            "fbar-consistent: the factor of equilibrium is that of the explicit run, within half of both brackets and the half per cent of a slow failure"
            => study(agrees);
    }
}

/// Between which the factor may lie, where limit analysis knows.
fn bounds(r: &Record) -> Option<(f64, f64)> {
    if r.parameters.number(FACE_ANGLE) != 45.0 {
        return None;
    }
    let (_, least, most) = STABILITY;
    let too_strong = 1.0 + r.discretisation.h / r.parameters.number(HEIGHT);
    let lower = factor(r, least) - resolution(r);
    let upper = (1.0 + SLOW) * too_strong * factor(r, most) + resolution(r);
    Some((lower, upper))
}

/// Factor of safety of the run's slope for a stability number.
fn factor(record: &Record, stability: f64) -> f64 {
    factor_of_safety(
        &record.parameters,
        record.parameters.number(STRENGTH),
        stability,
    )
}

/// Half of the bracket that the trials leave.
fn resolution(record: &Record) -> f64 {
    let number = |p| record.parameters.number(p);
    0.5 * (number(MOST) - 1.0) / 2.0_f64.powf(number(TRIALS) - 1.0)
}

/// In equilibrium nothing overshoots and tips what hardly stands, so that fine splines show what they lock, too.
fn locks(record: &Record) -> bool {
    let still = record.scheme().rule().is_some();
    let coarse = record.discretisation.h > FINE;
    let locks = record.basis() == BasisName::Gimp || coarse || still;
    record.remedy() == RemedyName::None && locks
}

fn is_ours(r: &&Record) -> bool {
    r.remedy() == RemedyName::FbarConsistent && r.status == Status::Ok && r.is_default()
}

/// Whether trials of equilibrium and of motion come to the same limit.
fn agrees(records: &[Record]) -> Vec<Finding> {
    let found = |r: &Record| {
        let moving = records.iter().filter(is_ours).find(|moving| {
            let same = moving.basis() == r.basis() && moving.level == r.level;
            same && moving.scheme().rule().is_none()
        })?;
        let expected = moving.metric(METRIC);
        let tolerance = resolution(r) + resolution(moving) + SLOW * expected;
        let why = format!("{} {}: the explicit run", r.scheme(), r.level);
        Some(judge(r, METRIC).within(expected, tolerance, why))
    };
    let still = records.iter().filter(is_ours);
    let still = still.filter(|r| r.scheme().rule().is_some());
    still.filter_map(found).collect()
}

fn converges(records: &[Record]) -> Vec<Finding> {
    let schemes = crate::distinct(records.iter().filter(is_ours).map(Record::scheme));
    let mut found = Vec::new();
    for scheme in schemes {
        let of_scheme = records
            .iter()
            .filter(is_ours)
            .filter(|r| r.scheme() == scheme);
        let mut runs: Vec<&Record> = of_scheme.collect();
        runs.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
        for pair in runs.windows(2) {
            let off = |r: &Record| (r.metric(METRIC) - factor(r, STABILITY.0)).abs();
            let known_to = resolution(pair[1]) + factor(pair[1], STABILITY.2 - STABILITY.0);
            found.push(Finding::at_most(
                METRIC,
                off(pair[1]),
                off(pair[0]).max(known_to),
                format!("{scheme}: {} against {}", pair[1].level, pair[0].level),
            ));
        }
    }
    found
}

#[cfg(test)]
mod tests;
