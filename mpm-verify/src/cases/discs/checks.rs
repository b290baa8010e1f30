//! What is checked of the discs. The bounds are derived in `docs/discs.md`.

use super::metrics as m;
use super::metrics::{ASYMMETRY, ENERGY_GAIN, MASS, MOMENTUM_ERROR, NEWTON_ITERATIONS};
use super::parameters::{LUMPED, OFFSET, STEP_FACTOR, TOLERANCE};
use super::scene::RADIUS;
use crate::check::{Check, Finding, judge, run};
use crate::record::Record;
use crate::scheme::{BasisName, RuleName, Scheme, TransferName};

/// Roundings of a step's sum of forces, in shares of the discs' momentum.
const ROUNDINGS: f64 = 16.0;
/// What a rule that conserves energy may gain.
const NO_GAIN: f64 = 1e-4;
/// What is above it is not conserved.
const GAINED: f64 = 1e-3;
/// What rounding may become in the collision.
const MIRRORED: f64 = 1e-6;

/// Half of what a step exchanges.
const HALF: f64 = 0.5;

/// What rounding may come to in an explicit run.
fn rounding(r: &Record) -> f64 {
    (r.work.steps as f64 * ROUNDINGS * f64::EPSILON).max(1e-12)
}

fn is_explicit(r: &Record) -> bool {
    matches!(r.scheme(), Scheme::Explicit(_))
}

/// Whether linear functions go through fine cells: each face that a particle crosses is a jump.
fn jumps(r: &Record) -> bool {
    r.basis() == BasisName::Linear && r.level == "h0.025"
}

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::bookkeeping(
            "mass",
            "the particles have the mass of their share of a cell, to rounding",
            run(|r| {
                let particles = r.work.particles as f64;
                let of_each = 1000.0 * r.discretisation.h.powi(2) / f64::from(r.discretisation.ppc);
                let mass = particles * of_each;
                let why = "density times the volume that is seeded; each of n sums rounds once";
                Some(judge(r, MASS).within(mass, particles * f64::EPSILON * mass, why))
            }),
        ),
        Check::truth(
            "momentum",
            "all: linear momentum changes by no more than rounding in every step, and with newmark by what Newton's method leaves",
            run(|r| {
                let left = match r.scheme().rule() {
                    Some(RuleName::Newmark) => r.parameters.number(TOLERANCE),
                    _ => 0.0,
                };
                let steps = r.work.steps as f64;
                let bound = steps * (ROUNDINGS * f64::EPSILON + left);
                let why = "internal forces sum to zero, as the functions sum to one";
                Some(judge(r, MOMENTUM_ERROR).at_most(bound.max(1e-12), why))
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "midpoint, β above 0, head on, but for linear functions at h = 0.025 m: kinetic and stored energy never above their start by more than 10⁻⁴",
            run(|r| {
                let why = "a lumped share takes energy, the rule gives none: docs/implicit.md";
                let found = judge(r, ENERGY_GAIN).at_most(NO_GAIN, why);
                let head_on = r.parameters.number(OFFSET) == 0.0;
                let blended = head_on && r.parameters.number(LUMPED) > 0.0;
                let judged = r.scheme().rule() == Some(RuleName::Midpoint) && blended;
                (judged && !jumps(r)).then_some(found)
            }),
        ),
        Check::known_limit(
            "linear-gains",
            "midpoint with linear functions at h = 0.025 m and 100 times the explicit step, head on: energy rises above its start by more than 10⁻⁴",
            run(|r| {
                let why = "gradients that jump at faces, where a step ends by chance";
                let found = judge(r, ENERGY_GAIN).above(NO_GAIN, why);
                let midpoint = r.scheme().rule() == Some(RuleName::Midpoint);
                let head_on = r.parameters.number(OFFSET) == 0.0;
                let long = r.parameters.is(STEP_FACTOR, "100");
                (midpoint && long && head_on && jumps(r)).then_some(found)
            }),
        ),
        Check::known_limit(
            "newmark-gains",
            "newmark at 100 times the explicit step, but for linear functions at h = 0.025 m, and linear functions and GIMP at 10 times, head on: energy rises above its start by more than 10⁻³",
            run(|r| {
                let why = "equilibrium at the end of the step with velocities of another place";
                let found = judge(r, ENERGY_GAIN).above(GAINED, why);
                let smooth = r.basis() == BasisName::Bspline2;
                let long = r.parameters.is(STEP_FACTOR, "100")
                    || r.parameters.is(STEP_FACTOR, "10") && !smooth;
                let head_on = r.parameters.number(OFFSET) == 0.0;
                let newmark = r.scheme().rule() == Some(RuleName::Newmark) && !jumps(r);
                (newmark && long && head_on).then_some(found)
            }),
        ),
        Check::truth(
            "mirror",
            "all but linear functions, whose gradients jump where rounding decides: particles stay mirror images about the centre",
            run(|r| {
                let why = "the scene and the lattice are; rounding grows in the collision";
                let found = judge(r, ASYMMETRY).at_most(MIRRORED, why);
                (r.basis() != BasisName::Linear).then_some(found)
            }),
        ),
        Check::truth(
            "free-flight",
            "explicit: until a function sees both discs every particle keeps its velocity, to rounding, and its volume; for ever if none does",
            run(|r| {
                let why = "functions sum to one and their slopes to zero: a uniform motion has no strain and no force";
                let each = [m::FLIGHT_ERROR, m::FLIGHT_STRAIN];
                let judged = is_explicit(r);
                let found = each.map(|metric| judge(r, metric).at_most(rounding(r), why));
                found.into_iter().filter(|_| judged).collect::<Vec<_>>()
            }),
        ),
        Check::truth(
            "exchange",
            "explicit, not musl: kinetic and stored energy never above their start by more than half of what a step changes the stored one by",
            run(|r| {
                let bound = HALF * r.metric(m::ENERGY_EXCHANGED) + rounding(r);
                let why = "velocities live half a step before places, and transfers only take";
                (is_explicit(r) && r.transfer() != TransferName::Musl)
                    .then(|| judge(r, ENERGY_GAIN).at_most(bound, why))
            }),
        ),
        Check::truth(
            "restitution",
            "explicit: the discs part no faster than they met, but for what a step exchanges",
            run(|r| {
                let bound = 1.0 + HALF * r.metric(m::ENERGY_EXCHANGED) + rounding(r);
                let why = "the motion of the centres of mass is part of the energy";
                is_explicit(r).then(|| judge(r, m::RESTITUTION).at_most(bound, why))
            }),
        ),
        Check::truth(
            "affine-keeps-angular-momentum",
            "apic: angular momentum, that of the affine parts with it, is kept to rounding",
            run(|r| {
                let why = "the affine part carries what a node's arm has, and stresses are symmetric: docs/spin.md";
                (r.transfer() == TransferName::Apic)
                    .then(|| judge(r, m::ANGULAR_MOMENTUM_ERROR).at_most(rounding(r), why))
            }),
        ),
        Check::truth(
            "no-spin",
            "explicit, head on, all but linear functions: the angular momentum stays zero",
            run(|r| {
                let why = "the scene is its own image in the line of motion, which turns angular momentum round";
                let head_on = r.parameters.number(OFFSET) == 0.0;
                (is_explicit(r) && head_on && r.basis() != BasisName::Linear)
                    .then(|| judge(r, m::ANGULAR_MOMENTUM_ERROR).at_most(MIRRORED, why))
            }),
        ),
        Check::known_limit(
            "touches-through-the-grid",
            "explicit, discs that pass each other within reach of the functions: a hundredth of their velocity and more is turned or lost, though they don't touch",
            run(|r| {
                let why = "nodes that see both have one velocity";
                let apart = r.parameters.number(OFFSET) >= 2.0 * RADIUS;
                let meet = r.metric(m::FREE_UNTIL).is_finite();
                (is_explicit(r) && apart && meet).then(|| judge(r, m::DEFLECTION).above(0.01, why))
            }),
        ),
        Check::truth(
            "newton",
            "implicit: at most seven Newton iterations a step, as four squarings lead from a tenth to the tolerance, and three more lead there",
            run(|r| {
                let bound = 7.0 * r.work.steps as f64;
                let why = "quadratic convergence with the exact tangent";
                let found =
                    Finding::at_most(NEWTON_ITERATIONS, r.metric(NEWTON_ITERATIONS), bound, why);
                r.scheme().rule().map(|_| found)
            }),
        ),
    ]
}
