//! Verdicts on the stability of the slope. The tolerances are derived in `docs/slope-stability.md`.

use super::super::landslide::{STABILITY, factor_of_safety};
use crate::case::{CheckInfo, check};
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName};
use crate::verdict::{Kind, Verdict};

/// What a slope may exceed its limit by and still be called standing.
const SLOW: f64 = 0.005;
/// Cells (m) up to which standard quadratic splines no longer lock beyond what a band of cells explains.
const FINE: f64 = 0.2;

pub(super) const CHECKS: &[CheckInfo] = &[
    check(
        "limit-load",
        Kind::Truth,
        "F̄, and standard quadratic splines at h ≤ 0.2 m: the factor lies between the lower bound of limit analysis and its upper bound and h/H, by which a band of cells is too strong; both widened by half the last bracket and the half per cent of a slow failure",
    ),
    check(
        "lower-bound",
        Kind::Truth,
        "all: the factor is above the lower bound of limit analysis less half the last bracket",
    ),
    check(
        "locked",
        Kind::KnownLimit,
        "none with GIMP, and with quadratic splines at h > 0.2 m: the slope still stands at a factor above all that",
    ),
    check(
        "factor-converges",
        Kind::Truth,
        "fbar-consistent: from level to level the factor comes nearer to that of limit analysis, or stays within the uncertainty of both",
    ),
];

/// Factor of safety of the run's slope for a stability number.
fn factor(record: &Record, stability: f64) -> f64 {
    factor_of_safety(
        &record.parameters,
        record.parameters.number("strength"),
        stability,
    )
}

/// Half of the bracket that the trials leave.
fn resolution(record: &Record) -> f64 {
    let number = |name| record.parameters.number(name);
    0.5 * (number("most") - 1.0) / 2.0_f64.powf(number("trials") - 1.0)
}

fn locks(record: &Record) -> bool {
    let coarse = record.discretisation.h > FINE;
    record.remedy() == RemedyName::None && (record.basis() == BasisName::Gimp || coarse)
}

pub(super) fn judge(record: &Record) -> Vec<Verdict> {
    let metric = "strength_reduction_factor";
    if record.parameters.number("face_angle") != 45.0 {
        let why = "the bounds of limit analysis are those for 45°";
        return vec![Verdict::not_applicable("limit-load", metric, why)];
    }
    let (_, least, most) = STABILITY;
    let too_strong = 1.0 + record.discretisation.h / record.parameters.number("height");
    let lower = factor(record, least) - resolution(record);
    let upper = (1.0 + SLOW) * too_strong * factor(record, most) + resolution(record);
    let value = record.metric(metric);
    let not_weaker = Verdict::above(
        "lower-bound",
        Kind::Truth,
        metric,
        value,
        lower,
        "lower bound of limit analysis: docs/exact.md",
    );
    let judged = if locks(record) {
        Verdict::above(
            "locked",
            Kind::KnownLimit,
            "stands_at",
            record.metric("stands_at"),
            upper - resolution(record),
            "standard MPM locks: Zhao et al. 2022, Figure 14",
        )
    } else {
        Verdict::close(
            "limit-load",
            metric,
            value,
            0.5 * (lower + upper),
            0.5 * (upper - lower),
            "limit analysis: docs/exact.md",
        )
    };
    vec![not_weaker, judged]
}

pub(super) fn judge_study(records: &[Record]) -> Vec<Verdict> {
    let metric = "strength_reduction_factor";
    let ours = |r: &&Record| {
        r.remedy() == RemedyName::FbarConsistent && r.status == Status::Ok && r.is_default()
    };
    let schemes = crate::distinct(records.iter().filter(ours).map(Record::scheme));
    let mut verdicts = Vec::new();
    for scheme in schemes {
        let mut runs: Vec<&Record> = records
            .iter()
            .filter(ours)
            .filter(|r| r.scheme() == scheme)
            .collect();
        runs.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
        for pair in runs.windows(2) {
            let off = |r: &Record| (r.metric(metric) - factor(r, STABILITY.0)).abs();
            let known_to = resolution(pair[1]) + factor(pair[1], STABILITY.2 - STABILITY.0);
            verdicts.push(Verdict::at_most(
                "factor-converges",
                Kind::Truth,
                metric,
                off(pair[1]),
                off(pair[0]).max(known_to),
                format!("{scheme}: {} against {}", pair[1].level, pair[0].level),
            ));
        }
    }
    verdicts
}

#[cfg(test)]
mod tests;
