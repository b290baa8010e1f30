//! What is checked of the bar. The bounds are derived in `docs/shock.md`.

use super::metrics as m;
use super::parameters::{CFL, LINEAR_VISCOSITY, MACH, VISCOSITY};
use super::watch::WAY;
use crate::check::{Check, Finding, judge, run};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};

/// Speed up to which nothing but rounding and cells is in the way of the exact state.
const WEAK: f64 = 0.5;
/// Cells (m) down to which FLIP's own filter leaves the most of what rings alone.
const COARSE: f64 = 1.0 / 128.0;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "shock-speed",
            "the front's speed is the exact one, within two cells over the way on which it is measured and twice what the energy that rings does to the stress; without a remedy and with fbar-consistent, but for linear functions, whose stress fades as they cross cells",
            run(|r| is_sound(r).then(|| of(r, m::SHOCK_SPEED_ERROR))),
        ),
        Check::truth(
            "stress",
            "the mean stress behind it is the exact one, likewise",
            run(|r| is_sound(r).then(|| of(r, m::STRESS_ERROR))),
        ),
        Check::truth(
            "wall-force",
            "the wall takes the exact momentum, likewise",
            run(|r| is_sound(r).then(|| of(r, m::WALL_FORCE_ERROR))),
        ),
        Check::truth(
            "velocity",
            "the mean velocity behind it is zero, within a cell over the way and half of what the energy that rings does to the stress",
            run(|r| {
                let why = "the wall stops what comes";
                is_sound(r).then(|| {
                    let found = judge(r, m::VELOCITY_ERROR).within(0.0, bound(r), why);
                    found.of_scale(1.0)
                })
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "none and fbar-consistent: energy never above its start by more than the CFL number times a cell of the bar",
            run(|r| {
                let keeps = matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent);
                let offset = r.parameters.number(CFL) * r.discretisation.h;
                let why = "velocities live half a step before places, in the front alone";
                keeps.then(|| judge(r, m::ENERGY_GAIN).at_most(offset, why))
            }),
        ),
        Check::truth(
            "energy-loss",
            "likewise, with an artificial viscosity whose linear part takes what rings, where the front is steady: it takes the exact energy in a second, within two cells over the way on which it is measured",
            run(|r| is_steady(r).then(|| of(r, m::LOSS_RATE_ERROR))),
        ),
        Check::truth(
            "front-width",
            "likewise: the front is as wide as the steady one, within as many cells as functions have nodes",
            run(|r| {
                let why = "q bears what line and law leave; a function's support is the least that is seen of a jump";
                let found = judge(r, m::FRONT_WIDTH);
                is_steady(r).then(|| found.within(r.metric(m::PREDICTED_WIDTH), support(r), why))
            }),
        ),
        Check::known_limit(
            "weak-viscosity-rings",
            "an artificial viscosity whose linear part is small, without a remedy, at Mach 0.5 and more: stresses exceed the exact one by more than a tenth",
            run(|r| {
                let why =
                    "quadratic in the rate, it acts in the front and not on what is left behind it";
                let weak = is_viscous(r) && !takes_what_rings(r) && r.remedy() == RemedyName::None;
                let fast = r.parameters.number(MACH) >= WEAK;
                (weak && fast).then(|| judge(r, m::OVERSHOOT).above(0.1, why))
            }),
        ),
        Check::known_limit(
            "rings",
            "without viscosity, Mach 0.5 and more, up to 128 cells, without a remedy: of what the front should take a tenth and more is not taken but rings",
            run(|r| {
                let why = "no viscosity: a step of a stress leaves waves of a few cells behind it, which carry the energy";
                let strong = !is_viscous(r)
                    && r.parameters.number(MACH) >= WEAK
                    && r.remedy() == RemedyName::None;
                let strong = strong && r.discretisation.h >= COARSE;
                strong.then(|| judge(r, m::ENERGY_LOSS_ERROR).at_most(-0.1, why))
            }),
        ),
        Check::known_limit(
            "recursion-smears",
            "fbar-recursive, up to Mach 0.5: a quarter more than what the front should take is lost",
            run(|r| {
                let why =
                    "Eq. (26) diffuses J: a front is smeared, and what it takes is not its own";
                let smears = is_weak(r) && r.remedy() == RemedyName::FbarRecursive;
                smears.then(|| judge(r, m::ENERGY_LOSS_ERROR).above(0.25, why))
            }),
        ),
        Check::known_limit(
            "averaged-hats-lose-stress",
            "linear functions with an average, up to Mach 0.5: a tenth and more of the stress is missing",
            run(|r| {
                let why = "a pressure feeds what an average can't see, at any step: docs/critical-step.md";
                let loses = is_weak(r) && is_averaged_hats(r);
                loses.then(|| judge(r, m::STRESS_ERROR).at_most(-0.1, why))
            }),
        ),
    ]
}

fn is_viscous(r: &Record) -> bool {
    VISCOSITY.iter().any(|c| r.parameters.number(*c) > 0.0)
}

/// Whether the linear viscosity lets a wave of four cells fall to e⁻² while the front goes five: ½ c₁ h c k² for 5 h/c.
fn takes_what_rings(r: &Record) -> bool {
    let k = 0.5 * std::f64::consts::PI;
    2.5 * r.parameters.number(LINEAR_VISCOSITY) * k * k >= 2.0
}

/// As far as a function reaches (m).
fn support(r: &Record) -> f64 {
    (r.basis().degree() as f64 + 1.0) * r.discretisation.h
}

/// Whether a run is to have the exact front, and the loss and width that its viscosity makes: four widths and more of the
/// way are behind it at the end, and functions resolve it.
fn is_steady(r: &Record) -> bool {
    let width = r.metric(m::PREDICTED_WIDTH);
    is_sound(r) && takes_what_rings(r) && (support(r)..0.25 * WAY).contains(&width)
}

/// Whether a front is slow and has no viscosity.
fn is_weak(r: &Record) -> bool {
    !is_viscous(r) && r.parameters.number(MACH) <= WEAK
}

fn is_averaged_hats(r: &Record) -> bool {
    r.basis() == BasisName::Linear && r.remedy() != RemedyName::None
}

/// Whether a run is to have the exact front.
fn is_sound(r: &Record) -> bool {
    let keeps = matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent);
    keeps && r.basis() != BasisName::Linear
}

/// An error that is to be within twice the bound, over what it is an error of.
fn of(r: &Record, metric: Metric) -> Finding {
    let found = judge(r, metric).within(0.0, 2.0 * bound(r), JUMPS);
    found.of_scale(1.0)
}

const JUMPS: &str = "Rankine and Hugoniot; what is not lost rings, and moves the mean by ½ P″⟨δF²⟩";

/// A cell over the way on which the front is measured, and what ringing can do to the mean stress.
fn bound(r: &Record) -> f64 {
    let rings = if takes_what_rings(r) {
        0.0
    } else {
        r.metric(m::JUMP_BOUND)
    };
    r.discretisation.h / (0.5 * WAY) + rings
}
