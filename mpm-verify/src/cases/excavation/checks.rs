//! What is checked of the excavation. The bounds are derived in `docs/excavation.md`.

use super::metrics as m;
use super::parameters::{BASE, FRICTION, FRICTIONAL, JAUMANN, LAW, PEAK, RESIDUAL};
use crate::check::{Check, Finding, checks, judge, run, study};
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::RuleName;

/// Newton's tolerance times the root of the number of nodes that its norm is of.
const EQUILIBRIUM: f64 = 1e-8;
/// Newton's tolerance times the number of steps and the forces that swing over those that drive.
const BALANCED: f64 = 1e-6;
/// What a rule that conserves energy may gain.
const NO_GAIN: f64 = 1e-4;
/// Rounding of a friction force.
const ROUNDING: f64 = 1e-9;
/// By how much arcs are above the collapse load: the gap to finite-element limit analysis.
const ARCS: f64 = 0.012;
/// Run-outs of two levels that differ by less are the same.
const SAME: f64 = 0.01;

pub(super) fn checks() -> Vec<Check> {
    checks! {
        truth "reaction":
            "in equilibrium before the excavation the base bears the weight, and base and rollers push each other alone"
            => run(|r| {
                let why = "equilibrium, to Newton's tolerance";
                let metrics = [m::REACTION_ERROR, m::SIDE_ERROR];
                let found = metrics.map(|metric| judge(r, metric).at_most(EQUILIBRIUM, why));
                if rests(r) { found.to_vec() } else { Vec::new() }
            });
        truth "taken-over":
            "what stays keeps its stress from phase to phase, bit for bit: the cut is made in ground that rests"
            => run(|r| {
                let why = "a phase begins as the one before it ended";
                let change = r.metric(m::HANDED_OVER);
                (!change.is_nan()).then(|| judge(r, m::HANDED_OVER).at_most(0.0, why))
            });
        truth "stands-below-the-limit":
            "without softening, on a rough base: a slope that limit analysis lets stand by more than arcs are above the collapse load stands, whole and cut"
            => run(|r| {
                let why = "finite-element limit analysis: docs/excavation.md";
                limits(r, move |factor| factor > 1.0 + ARCS, move |r, metric| {
                    judge(r, metric).within(1.0, 0.0, why)
                })
            });
        truth "falls-above-the-limit":
            "a slope whose factor of safety at the peak strength is below one does not stand, whole or cut"
            => run(|r| {
                let why = "arcs and sliding feet are upper bounds: docs/excavation.md";
                upper(r).into_iter().filter(|(factor, metric)| {
                    *factor < 1.0 && !r.metric(*metric).is_nan()
                }).map(|(_, metric)| judge(r, metric).within(0.0, 0.0, why)).collect::<Vec<_>>()
            });
        truth "balance":
            "midpoint: kinetic energy, the stresses' work and what the lumped mass and the ghost penalty took are the work of the load"
            => run(|r| {
                let why = "Eq. (21) of docs/implicit.md, to Newton's tolerance";
                moves(r, RuleName::Midpoint).then(|| judge(r, m::BALANCE_ERROR).at_most(BALANCED, why))
            });
        truth "no-energy-gain":
            "midpoint, hencky-j2: kinetic, stored and dissipated energy never exceed the work of the load by more than 10⁻⁴ of it"
            => run(|r| {
                let why = "the rule gives none, flow takes: docs/implicit.md";
                let stores = !r.parameters.is(LAW, JAUMANN);
                let judged = stores && moves(r, RuleName::Midpoint);
                judged.then(|| judge(r, m::ENERGY_GAIN).at_most(NO_GAIN, why))
            });
        truth "momentum":
            "midpoint, base=friction: vertical momentum is the impulse of the weight less that of the base"
            => run(|r| {
                let why = "internal forces sum to zero, as the functions sum to one";
                let judged = slides(r) && moves(r, RuleName::Midpoint);
                judged.then(|| judge(r, m::MOMENTUM_ERROR).at_most(ROUNDING, why))
            });
        truth "flow":
            "plastic strain never falls, of no particle"
            => run(|r| {
                let why = "flow dissipates";
                Some(judge(r, m::FLOW_LEAST).above(-f64::EPSILON, why))
            });
        truth "coulomb":
            "base=friction: the base never holds more than μ times its pressure"
            => run(|r| {
                let bound = r.parameters.number(FRICTION) * (1.0 + ROUNDING);
                let why = "Coulomb's law, which holds of every particle";
                slides(r).then(|| judge(r, m::FRICTION_RATIO).at_most(bound, why))
            });
        truth "peak-does-not-fail":
            "rough base: with softening the cut slope does not stand, and at the peak strength without softening it does"
            => study(peak_does_not_fail);
        known_limit "run-out-by-level":
            "rough base, softening: the run-outs of two levels differ by more than a hundredth, as softening has no length"
            => study(differs_by_level);
    }
}

/// Whether the whole slope has an equilibrium under full gravity.
fn rests(r: &Record) -> bool {
    let carried = r.metric(m::GRAVITY_CARRIED);
    carried > 1.0 - 1e-9 && r.metric(m::STANDS_UNCUT) == 1.0
}

fn slides(r: &Record) -> bool {
    r.parameters.is(BASE, FRICTIONAL)
}

/// Whether a run moved, after the excavation, by this rule.
fn moves(r: &Record, rule: RuleName) -> bool {
    r.scheme().rule() == Some(rule) && !r.metric(m::KINETIC_PEAK).is_nan()
}

fn softens(r: &Record) -> bool {
    r.parameters.number(RESIDUAL) < r.parameters.number(PEAK)
}

/// Factors of limit analysis with whether the slope stands.
fn upper(r: &Record) -> [(f64, Metric); 2] {
    [
        (r.metric(m::FACTOR_UNCUT), m::STANDS_UNCUT),
        (r.metric(m::FACTOR_CUT), m::STANDS_CUT),
    ]
}

/// Of a slope without softening on a rough base, what is demanded where its factor is such.
fn limits(
    r: &Record,
    such: impl Fn(f64) -> bool,
    demands: impl Fn(&Record, Metric) -> Finding,
) -> Vec<Finding> {
    let judged = !softens(r) && !slides(r);
    let factors = upper(r).into_iter();
    factors
        .filter(|(factor, _)| judged && such(*factor))
        .map(|(_, metric)| demands(r, metric))
        .collect()
}

fn is_own(r: &Record, but: &[&str]) -> bool {
    r.status == Status::Ok && r.changes_none_but(but)
}

/// Pairs of runs of one scheme and level, with softening and without.
fn peak_does_not_fail(records: &[Record]) -> Vec<Finding> {
    let mut found = Vec::new();
    for perfect in records
        .iter()
        .filter(|r| is_own(r, &[RESIDUAL.name]) && !softens(r))
    {
        let alike = |r: &&Record| {
            is_own(r, &[]) && (r.scheme(), &r.level) == (perfect.scheme(), &perfect.level)
        };
        for softened in records.iter().filter(alike) {
            let stands = |r: &Record| r.metric(m::STANDS_CUT);
            let moving = softened.scheme().rule() != Some(RuleName::QuasiStatic);
            if moving && !(stands(softened) + stands(perfect)).is_nan() {
                found.push(Finding::within(
                    m::STANDS_CUT,
                    stands(perfect) - stands(softened),
                    1.0,
                    0.0,
                    format!("{} {}", perfect.scheme(), perfect.level),
                ));
            }
        }
    }
    found
}

fn differs_by_level(records: &[Record]) -> Vec<Finding> {
    let mut found = Vec::new();
    let own: Vec<&Record> = records.iter().filter(|r| is_own(r, &[])).collect();
    for (k, coarse) in own.iter().enumerate() {
        for fine in &own[k + 1..] {
            let alike = coarse.scheme() == fine.scheme() && coarse.level != fine.level;
            if alike && moves(coarse, RuleName::Midpoint) && moves(fine, RuleName::Midpoint) {
                let [a, b] = [coarse, fine].map(|r| r.metric(m::RUNOUT_END));
                found.push(Finding::above(
                    m::RUNOUT_END,
                    (a / b - 1.0).abs(),
                    SAME,
                    format!(
                        "{}: {} against {}",
                        coarse.scheme(),
                        coarse.level,
                        fine.level
                    ),
                ));
            }
        }
    }
    found
}
