//! What is checked of the beam. The bounds are derived in `docs/thin.md`.

use super::metrics as m;
use super::parameters::{POISSON_RATIO, PPC_PER_DIRECTION, SHIFT};
use super::theory::SLENDER;
use crate::accuracy::fit_order;
use crate::cases::parameters::LUMPED;
use crate::check::{Check, Finding, judge, run, study};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme};

/// Relative difference of a beam's frequency by how its sections shear.
const SECTIONS: f64 = 2e-3;
/// Formal order of the error, and what an observed one may lack of it.
const FORMAL: f64 = 2.0;
const SLACK: f64 = 0.15;
/// What is rounding of a frequency that is read from zeros of a series.
const READ: f64 = 1e-3;
/// Least frequency over the exact one of what is locked, and greatest of what is too soft.
const LOCKED: f64 = 1.5;
const SOFT: f64 = 0.9;
/// Three zeros in five periods of the exact frequency.
const SLOWEST: f64 = 0.3;
/// From this Poisson's ratio on a body is nearly incompressible.
const STIFF: f64 = 0.49;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "as-predicted",
            "linear functions and splines without a remedy, midpoint with lumped=0: the frequency is that of the bending stiffness that cells and particles leave, within (βh)²/6 + 0.002, β the wave number of the mode",
            run(|r| {
                let why = "mass of the particles, stiffness by docs/thin.md; along the beam cells err by (βh)²/12, sections shear by Cowper's coefficient or evenly";
                let consistent = r.scheme().rule() == Some(RuleName::Midpoint)
                    && r.parameters.number(LUMPED) == 0.0;
                (consistent && r.basis() != BasisName::Gimp && is_predicted(r)).then(|| {
                    let predicted = r.metric(m::PREDICTED_RATIO);
                    judge(r, m::FREQUENCY_RATIO).within(predicted, slack(r) * predicted, why)
                })
            }),
        ),
        Check::truth(
            "no-stiffer",
            "the frequency is at most the predicted one, within as much",
            run(|r| {
                let why = "lumping adds inertia; functions that see a hair of the beam and averages of the volume change take stiffness";
                is_predicted(r).then(|| {
                    let bound = (1.0 + slack(r)) * r.metric(m::PREDICTED_RATIO);
                    Finding::at_most(m::FREQUENCY_RATIO.name, frequency(r), bound, why)
                })
            }),
        ),
        Check::truth(
            "order",
            "splines without a remedy, faces on grid lines: the error of the frequency falls from one cell to four at an order of at least 2 − 0.15",
            study(|records| {
                let splines = |r: &&&Record| {
                    matches!(r.basis(), BasisName::Bspline2 | BasisName::Bspline3)
                        && r.remedy() == RemedyName::None
                        && r.parameters.number(SHIFT) == 0.0
                };
                let ladders = ladders(records).into_iter();
                let found = ladders.filter(|runs| runs.iter().all(|r| splines(&r))).filter_map(|runs| {
                    let points = runs.iter().map(|r| (r.discretisation.h, r.metric(m::FREQUENCY_ERROR)));
                    let order = fit_order(&points.collect::<Vec<_>>())?.order;
                    let why = "the second moment of the particles and the turning of the nodes' mass both err by h²";
                    Some(Finding::above(about("order", runs[0]), order, FORMAL - SLACK, why))
                });
                found.collect()
            }),
        ),
        Check::truth(
            "average-no-stiffer",
            "fbar-consistent: the frequency is at most that of no remedy with the same cells, to what reading it leaves",
            study(|records| {
                let found = pairs(records).map(|(averaged, plain)| {
                    let ratio = frequency(averaged) / frequency(plain);
                    let why = "an average of the volume change stores no more energy than the volume change";
                    Finding::at_most(about("over none", averaged), ratio, 1.0 + READ, why)
                });
                found.collect()
            }),
        ),
        Check::known_limit(
            "locks",
            "linear functions without a remedy at ν ≥ 0.49, one and two cells: above 1.5 times the exact frequency",
            run(|r| {
                let why = "within a cell the depth can't change as it bends, at the price of M and not of E′";
                let own = r.basis() == BasisName::Linear && r.remedy() == RemedyName::None;
                let thin = r.level != "t4" && r.parameters.number(POISSON_RATIO) >= STIFF;
                (own && thin).then(|| judge(r, m::FREQUENCY_RATIO).above(LOCKED, why))
            }),
        ),
        Check::known_limit(
            "two-particles",
            "splines without a remedy, one cell with two particles over the depth: below 0.9 of the exact frequency",
            run(|r| {
                let why = "two particles have three quarters of the second moment of the section";
                let splines = matches!(r.basis(), BasisName::Bspline2 | BasisName::Bspline3);
                let two = r.parameters.number(PPC_PER_DIRECTION) == 2.0;
                (splines && two && r.level == "t1" && r.remedy() == RemedyName::None)
                    .then(|| judge(r, m::FREQUENCY_RATIO).at_most(SOFT, why))
            }),
        ),
        Check::known_limit(
            "average-hollows",
            "fbar-consistent at ν = 0, one cell: below 0.9 of the frequency without a remedy",
            study(|records| {
                let found = pairs(records)
                    .filter(|(r, _)| r.level == "t1" && r.parameters.number(POISSON_RATIO) == 0.0);
                let found = found.map(|(averaged, plain)| {
                    let ratio = frequency(averaged) / frequency(plain);
                    let why = "over one cell the average of what is stretched above and pressed below is nothing";
                    Finding::at_most(about("over none", averaged), ratio, SOFT, why)
                });
                found.collect()
            }),
        ),
    ]
}

/// Frequency over the exact one; of an average that leaves fewer than three zeros in five periods, the greatest that it may be.
fn frequency(r: &Record) -> f64 {
    let ratio = r.metric(m::FREQUENCY_RATIO);
    let slow = ratio.is_nan() && r.remedy() == RemedyName::FbarConsistent;
    if slow { SLOWEST } else { ratio }
}

/// What a frequency may be off the predicted one.
fn slack(r: &Record) -> f64 {
    let angle = SLENDER * r.discretisation.h;
    angle * angle / 6.0 + SECTIONS
}

/// Whether the stiffness of a run is known.
fn is_predicted(r: &Record) -> bool {
    r.metric(m::PREDICTED_RATIO).is_finite()
}

fn about(what: &str, r: &Record) -> String {
    let set = r.set.join(" ");
    let text = format!(
        "{} {what} of {} {} {set}",
        m::FREQUENCY_RATIO.name,
        r.scheme(),
        r.level
    );
    text.trim_end().to_owned()
}

/// The runs of a scheme and parameters at all levels, where there are three.
fn ladders(records: &[Record]) -> Vec<Vec<&Record>> {
    let firsts = records.iter().filter(|r| r.level == "t1");
    let same = |a: &Record, b: &Record| a.scheme() == b.scheme() && a.set == b.set;
    let ladder = |first| {
        records
            .iter()
            .filter(|r| same(r, first))
            .collect::<Vec<_>>()
    };
    firsts.map(ladder).filter(|runs| runs.len() >= 3).collect()
}

/// Each run with the average, and that without.
fn pairs(records: &[Record]) -> impl Iterator<Item = (&Record, &Record)> {
    let averaged = records
        .iter()
        .filter(|r| r.remedy() == RemedyName::FbarConsistent);
    averaged.filter_map(|r| {
        let plain = Scheme::flip(r.basis(), RemedyName::None);
        let like = |o: &&Record| o.scheme() == plain && o.level == r.level && o.set == r.set;
        Some((r, records.iter().find(like)?))
    })
}
