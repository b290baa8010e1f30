//! What is checked of the body. The bounds are derived in `docs/translate.md`.

use super::metrics as m;
use super::parameters::{CELLS, FLIP, SPEED};
use crate::check::{Check, judge, run};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};

/// What is rounding of a stress over many steps.
const ROUNDING: f64 = 1e-9;
/// An oscillation that a force sets off at once swings to twice its answer to it.
const SWING: f64 = 2.0;
/// Fastest body whose noise is foretold: beyond it the wave of the lattice is as fast as sound.
const SLOW: f64 = 0.06;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "momentum",
            "momentum is kept to rounding",
            run(|r| {
                let why = "weights sum to one and their gradients to zero";
                Some(judge(r, m::MOMENTUM_ERROR).at_most(ROUNDING, why))
            }),
        ),
        Check::truth(
            "domains-that-tile-are-silent",
            "gimp with flip and no remedy: the stress stays what it is to rounding",
            run(|r| {
                let why = "domains that tile the body integrate a gradient of hats exactly: a uniform stress pushes no node";
                let silent = is_plain(r) && r.basis() == BasisName::Gimp;
                let found = silent.then(|| {
                    let noise = judge(r, m::STRESS_NOISE).at_most(ROUNDING, why);
                    let kept = judge(r, m::STRESS_KEPT).within(1.0, ROUNDING, why);
                    [noise, kept]
                });
                found.into_iter().flatten().collect::<Vec<_>>()
            }),
        ),
        Check::truth(
            "noise",
            "other functions with flip and no remedy: the noise of the stress is at most twice what answers the forces of the lattice",
            run(|r| {
                let why = "forces of a wave that the lattice makes, over the stiffness that it meets; twice of what begins at once";
                let bound = SWING * r.metric(m::PREDICTED_NOISE);
                (is_plain(r) && r.basis() != BasisName::Gimp && is_slow(r))
                    .then(|| judge(r, m::STRESS_NOISE).at_most(bound, why))
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "all but musl: kinetic and stored energy rise by nothing but rounding",
            run(|r| {
                let why = "what a stress gives to the velocities that its errors make is taken from what it stores";
                (r.transfer() != TransferName::Musl)
                    .then(|| judge(r, m::ENERGY_GAIN).at_most(ROUNDING, why))
            }),
        ),
        Check::known_limit(
            "crossing",
            "linear functions and splines, a hundred cells: the mean stress fades, of linear functions by more than a half, of quadratic splines by a tenth, of cubic ones, slow, by a hundredth",
            run(|r| {
                let most = match r.basis() {
                    BasisName::Linear => 0.5,
                    BasisName::Bspline2 => 0.9,
                    BasisName::Bspline3 if is_slow(r) => 0.99,
                    BasisName::Bspline3 | BasisName::Gimp | BasisName::Q8 => return None,
                };
                let why = "a uniform stress works on the velocities that its own quadrature error makes, and the transfer takes what it gives them";
                let crossed = r.parameters.number(CELLS) >= 100.0;
                (crossed && r.transfer() != TransferName::Musl)
                    .then(|| judge(r, m::STRESS_KEPT).at_most(most, why))
            }),
        ),
        Check::known_limit(
            "musl-gains",
            "linear functions with musl, a hundred cells: energy rises by more than a tenth of the kinetic energy",
            run(|r| {
                let why = "the stress' work is that of velocities mapped again, not that of the nodes' forces";
                let own = r.basis() == BasisName::Linear && r.transfer() == TransferName::Musl;
                let crossed = r.parameters.number(CELLS) >= 100.0;
                (own && crossed).then(|| judge(r, m::ENERGY_GAIN).above(0.1, why))
            }),
        ),
    ]
}

fn is_slow(r: &Record) -> bool {
    r.parameters.number(SPEED) < SLOW
}

fn is_plain(r: &Record) -> bool {
    let flip = r.transfer() == TransferName::Flip && r.parameters.number(FLIP) == 1.0;
    r.remedy() == RemedyName::None && flip
}
