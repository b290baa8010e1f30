//! What is checked of the block. The bounds are derived in `docs/drop.md`.

use super::metrics as m;
use super::parameters::{CFL, SLANT, TOLERANCE};
use crate::check::{Check, judge, run};
use crate::scheme::{RuleName, TransferName};

/// What is rounding of sums over many steps.
const ROUNDING: f64 = 1e-9;
/// A block that slips all the time does so from the time that its sticks have given way.
const SLIPS: f64 = 4.0;
const YIELDS: f64 = 0.02;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "open",
            "the gap of no particle is ever zero or less",
            run(|r| {
                let why = "the barrier's energy is infinite at a closed gap";
                Some(judge(r, m::LEAST_GAP).above(0.0, why))
            }),
        ),
        Check::truth(
            "coulomb",
            "the force along the floor is at most μ times the one across it, in every step, to rounding",
            run(|r| {
                let why = "every stick is returned to μN";
                Some(judge(r, m::COULOMB_EXCESS).at_most(ROUNDING, why))
            }),
        ),
        Check::truth(
            "momentum",
            "explicit and midpoint: what the block loses the floor has got, to rounding, and with implicit steps to what Newton's method leaves in each",
            run(|r| {
                let left = match r.scheme().rule() {
                    Some(_) => r.parameters.number(TOLERANCE) * r.work.steps as f64,
                    None => 0.0,
                };
                let why = "weights sum to one and their gradients to zero";
                (r.scheme().rule() != Some(RuleName::Newmark))
                    .then(|| judge(r, m::MOMENTUM_ERROR).at_most(ROUNDING + left, why))
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "explicit but for musl, and midpoint: kinetic and stored energy are never more than at the start, explicit by more than what is stored times the CFL number",
            run(|r| {
                let offset = match r.scheme().rule() {
                    None => r.parameters.number(CFL) * r.metric(m::STORED_MOST),
                    Some(_) => ROUNDING,
                };
                let keeps = r.scheme().rule() != Some(RuleName::Newmark)
                    && r.transfer() != TransferName::Musl;
                let why = "barrier and sticks give what they were given, and sliding takes; velocities live half a step before places";
                keeps.then(|| judge(r, m::ENERGY_GAIN).at_most(offset + ROUNDING, why))
            }),
        ),
        Check::truth(
            "slides",
            "four times as fast along the floor as across it: the impulse along it is μ times the one across it, within a fiftieth for sticks that give way first",
            run(|r| {
                let why = "Coulomb: a block that slips all the time";
                let fast = r.parameters.number(SLANT).abs() >= SLIPS;
                fast.then(|| judge(r, m::FRICTION_RATIO).within(1.0, YIELDS, why))
            }),
        ),
    ]
}
