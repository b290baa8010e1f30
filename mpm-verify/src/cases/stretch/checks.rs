//! What is checked of the body. The bounds are derived in `docs/stretch.md`.

use super::metrics as m;
use super::parameters::{DIMENSION, END, PPC_PER_DIRECTION};
use super::watch::SWING;
use crate::check::{Check, judge, run};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};

/// Where a stop is looked for, in stretches, and what the free part's noise does to the speed of waves.
const SEEN: f64 = 0.02;
/// What of a stress is noise if its slopes jump.
const JUMPS: f64 = 0.3;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "stress-noise",
            "no remedy, all but linear functions: as long as the exact state is stable the stress is the exact one within twice what answers the forces of the lattice",
            run(|r| {
                let why = "forces of a wave that the lattice makes, over the stiffness that it meets; twice of what begins at once";
                let bound = SWING * r.metric(m::PREDICTED_NOISE);
                (is_plain(r) && is_continuous(r))
                    .then(|| judge(r, m::STRESS_NOISE).at_most(bound, why))
            }),
        ),
        Check::truth(
            "tears-no-earlier",
            "pulled, no remedy, all but linear functions: the body holds as long as every motion of its free nodes has a positive stiffness, wherever the noise that is foretold may stretch it more",
            run(|r| {
                let why = "a positive stiffness restores; a stress that moves with the particles takes from it";
                let tears =
                    is_pulled(r) && is_plain(r) && is_continuous(r) && has(r, m::TEAR_STRETCH);
                tears.then(|| judge(r, m::TEAR_STRETCH).above(r.metric(m::UNSTABLE_STRETCH), why))
            }),
        ),
        Check::truth(
            "crushed-whole",
            "crushed, no remedy: the body doesn't tear, its mean stress is the exact one within the noise that is foretold",
            run(|r| {
                let why = "neighbours come closer, and no stiffness is negative under pressure";
                let bound = SWING * r.metric(m::PREDICTED_NOISE);
                (!is_pulled(r)
                    && is_plain(r)
                    && is_continuous(r)
                    && !has(r, m::PREDICTED_STOP_STRETCH))
                .then(|| judge(r, m::STRESS_KEPT).within(1.0, bound, why))
            }),
        ),
        Check::truth(
            "stops",
            "explicit, where the waves of the exact state outrun the step: the program says so at that stretch, within 2 %, or, where the body tears before or in the plane linear functions jump, no later",
            run(|r| {
                let why = "(c + |v|) Δt ≤ h of the deformed state, asked in every step";
                let stop = r.metric(m::PREDICTED_STOP_STRETCH);
                has(r, m::PREDICTED_STOP_STRETCH).then(|| {
                    let found = judge(r, m::STOPPED_STRETCH);
                    if is_pulled(r) {
                        found.at_most(stop * (1.0 + SEEN), why)
                    } else if r.discretisation.dim > 1 && !is_continuous(r) {
                        found.above(stop * (1.0 - SEEN), why)
                    } else {
                        found.within(stop, SEEN * stop, why)
                    }
                })
            }),
        ),
        Check::known_limit(
            "jumps",
            "linear functions without a remedy, two particles a cell: three tenths of the stress and more are noise",
            run(|r| {
                let why = "the stress of a particle pushes another node as soon as it crosses a grid line";
                let two = r.parameters.number(PPC_PER_DIRECTION) == 2.0;
                (two && is_plain(r) && !is_continuous(r))
                    .then(|| judge(r, m::STRESS_NOISE).above(JUMPS, why))
            }),
        ),
        Check::known_limit(
            "tears-early",
            "explicit, pulled: the body tears, and says nothing, before its particles, at their exact places, would lose their last common node",
            run(|r| {
                let why = "a stress that moves with the particles gives motions a negative stiffness that the grid sees badly";
                let latest = r
                    .metric(m::PREDICTED_TEAR_STRETCH)
                    .min(r.parameters.number(END));
                (is_pulled(r) && r.scheme().rule().is_none() && !has(r, m::PREDICTED_STOP_STRETCH))
                    .then(|| judge(r, m::TEAR_STRETCH).at_most(latest, why))
            }),
        ),
        Check::known_limit(
            "recursion-loses",
            "fbar-recursive, one dimension, crushed to a tenth and less, all but cubic splines: nine tenths of the stress are lost",
            run(|r| {
                let why =
                    "under a pressure, what an average can't see grows: docs/critical-step.md";
                let crushed =
                    r.parameters.number(END) <= 0.1 && r.parameters.number(DIMENSION) == 1.0;
                let own =
                    r.remedy() == RemedyName::FbarRecursive && r.basis() != BasisName::Bspline3;
                (crushed && own).then(|| judge(r, m::STRESS_KEPT).at_most(0.1, why))
            }),
        ),
    ]
}

fn has(r: &Record, metric: crate::metric::Metric) -> bool {
    r.metric(metric).is_finite()
}

fn is_pulled(r: &Record) -> bool {
    r.parameters.number(END) > 1.0
}

fn is_plain(r: &Record) -> bool {
    r.remedy() == RemedyName::None
}

fn is_continuous(r: &Record) -> bool {
    r.basis() != BasisName::Linear
}
