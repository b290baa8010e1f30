//! Checks of the dam break. The tolerances are derived in `docs/dam-break.md`.

mod study;

use super::metrics as m;
use super::parameters::{BULK_MODULUS, CFL, DENSITY, DURATION, EXACT, PIC_RATE, START};
use super::reference::{
    DEPTH, GRAVITY, LENGTH, TANK, elastic_energy, energies, greatest_speed, passage, uncertainty,
};
use crate::cases::parameters::is_of_own_problem;
use crate::check::{Check, Finding, checks, judge, run};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};

/// Relative tolerance of the forces at rest: of the exact start, and after the gravity stage.
const AT_REST: (f64, f64) = (1e-3, 5e-3);
/// Rms error of the pressure at rest over that at the floor on cells of [`PROFILE_CELL`] (m).
const PROFILE: f64 = 0.01;
const PROFILE_CELL: f64 = 0.25;
/// Rounding of sums over steps and particles.
const ROUNDING: f64 = 1e-9;
/// Cells (m) from which on splashes are fine enough to show what coarse cells swallow.
const FINE: f64 = 0.125;
/// Cells (m) beyond which they swallow even what `fbar-rate` makes.
const COARSE: f64 = 0.25;
/// Duration (s) of the runs whose known limits were found by running.
const WHOLE: f64 = 2.0;

const MAKES_ENERGY: &str = "force and rate of volume average differently, so that the stress gives work for nothing: docs/remedy.md";
const DRIFTS: &str = "averages of averages let the true volumes drift until particles turn inside out: docs/dam-break.md";

/// All checks: on single runs, then on runs together.
pub(super) fn checks() -> Vec<Check> {
    let mut checks = checks! {
        bookkeeping "particle-count":
            "L H / (h/n)² particles at n per direction: the paper's 3,200 at h = 0.25 m and five"
            => run(particle_count);
        bookkeeping "mass":
            "all: the mass at the end is ρ L H to rounding"
            => run(mass);
        truth "base-reaction":
            "none, fbar-rate, fbar-consistent: the force on the floor, mean over three of the water's longest periods behind the gate, is its weight within 0.1 %, within 0.5 % after a gravity stage"
            => run(base_reaction);
        truth "gate-force":
            "none, fbar-rate, fbar-consistent: the force on the gate, likewise, is ½ ρ g H² within 0.1 %, within 0.5 % after a gravity stage"
            => run(gate_force);
        known_limit "creeps":
            "fbar-recursive from the exact start, CFL below 0.1: the force on the floor is short of the weight by more than 0.1 %, because the water starts to sink"
            => run(creeps);
        truth "pressure-profile":
            "none, fbar-rate, fbar-consistent: the pressure behind the gate is hydrostatic, rms, within 1 % of that at the floor at h = 0.25 m, elsewhere as h^(3/2)"
            => run(pressure_profile);
        known_limit "smoothed-start":
            "fbar-recursive, fbar-total from the exact start: the pressure is off by more than that after one step: Π(J) ≠ J at floor and surface"
            => run(smoothed_start);
        truth "front":
            "F̄ with FLIP: the front is within a cell of the inviscid one, rms over t √(g/H) from 0.2 to 0.9"
            => run(front);
        truth "arrival":
            "F̄ with FLIP: the front passes x = 6 m − 2h within the time in which the inviscid one crosses a cell"
            => run(arrival);
        truth "front-speed":
            "all: the front is slower than 2 √(g H)"
            => run(front_speed);
        truth "energy-not-gained":
            "all: kinetic and potential energy and stress work never exceed their start; without APIC, whose affine motion the kinetic energy leaves out, they never grow"
            => run(energy_not_gained);
        truth "motion-not-gained":
            "all, but fbar-total and fbar-rate where makes-energy is found: kinetic and potential energy never exceed their start by more than what is stored elastically then"
            => run(motion_not_gained);
        known_limit "makes-energy":
            "fbar-total, fbar-rate: wherever they exceed it, because the stress works on a volume that the law does not see. They have to over the 2 s of the case's own flow: with FLIP (but quadratic splines with fbar-rate at h = 0.5 m and CFL 0.3), and with APIC at h = 0.125 m and below"
            => run(energy_made);
        truth "dissipation":
            "all that make no energy: no more kinetic and potential energy is lost than until the water is at rest in the tank"
            => run(dissipation);
        truth "volume":
            "all: at 0.4 s the particles cover L H within what strips two particles wide resolve"
            => run(volume);
        known_limit "locked":
            "none with GIMP: the front is more than a cell behind the inviscid one, rms"
            => run(locked);
    };
    checks.extend(study::checks());
    checks
}

/// Why a run is known to break down before its end, if it is.
pub(super) fn breaks_down(record: &Record) -> Option<&'static str> {
    if record.parameters.number(DURATION) < WHOLE {
        return None;
    }
    let gimp = record.basis() == BasisName::Gimp;
    // On coarse cells quadratic splines, and on the coarsest fbar-rate with small steps, make energy too, but keep the
    // water in the tank.
    let coarsest = record.discretisation.h > COARSE;
    let keeps_it = record.remedy() == RemedyName::FbarRate && coarsest && has_small_steps(record);
    let leaves_it = gimp && !keeps_it || is_flip(record) && is_fine(record);
    if has_to_make_energy(record) && leaves_it {
        return Some(MAKES_ENERGY);
    }
    let printed = record.remedy() == RemedyName::FbarRecursive;
    (printed && gimp && is_flip(record) && is_fine(record)).then_some(DRIFTS)
}

fn is_fine(record: &Record) -> bool {
    record.discretisation.h <= FINE
}

/// Whether a run has the case's own time step, not a larger one.
fn has_small_steps(record: &Record) -> bool {
    record.parameters.number(CFL) < 0.1
}

fn is_flip(record: &Record) -> bool {
    record.transfer() == TransferName::Flip && record.parameters.number(PIC_RATE) == 0.0
}

fn is_averaged(record: &Record) -> bool {
    record.remedy() != RemedyName::None
}

/// Whether the first step replaces the exact J by its average.
fn smooths(record: &Record) -> bool {
    matches!(
        record.remedy(),
        RemedyName::FbarRecursive | RemedyName::FbarTotal
    )
}

/// Whether force and rate of volume are from different averages.
fn averages_differ(record: &Record) -> bool {
    matches!(
        record.remedy(),
        RemedyName::FbarTotal | RemedyName::FbarRate
    )
}

/// Whether averages differ and nothing dissipates enough.
fn has_to_make_energy(record: &Record) -> bool {
    // What a step takes, ½ Σ m |Δv|², grows with it: large ones take more than little that is made.
    let little = record.remedy() == RemedyName::FbarRate
        && record.basis() == BasisName::Bspline2
        && record.discretisation.h > COARSE;
    let outweighed = little && !has_small_steps(record);
    averages_differ(record) && !outweighed && (is_flip(record) || is_fine(record))
}

/// Whether a run makes energy, as is known of its remedy: it has exceeded the bound, or it has to and is judged for it.
fn makes_energy(record: &Record) -> bool {
    let known = is_of_own_problem(record) && has_to_make_energy(record);
    let made = record.metric(m::MOTION_EXCESS) > stored(record);
    averages_differ(record) && (known || made)
}

fn particle_count(r: &Record) -> Vec<Finding> {
    let cells = LENGTH * DEPTH / r.discretisation.h.powi(2);
    vec![Finding::within(
        "particles",
        r.work.particles as f64,
        f64::from(r.discretisation.ppc) * cells,
        0.0,
        "Zhao et al. 2023, section 4.3: 3,200 at h = 0.25 m",
    )]
}

fn mass(r: &Record) -> Vec<Finding> {
    let mass = r.parameters.number(DENSITY) * LENGTH * DEPTH;
    vec![judge(r, m::MASS).within(mass, ROUNDING * mass, "conservation of mass")]
}

fn volume(r: &Record) -> Vec<Finding> {
    let covered = r.metric(m::COVERED_EARLY);
    if covered.is_nan() {
        let why = "the run ends before 0.4 s";
        return vec![Finding::not_applicable(m::COVERED_EARLY, why)];
    }
    vec![Finding::within(
        m::COVERED_EARLY,
        covered,
        LENGTH * DEPTH,
        resolved_area(r),
        "conservation of mass of a body that hardly compresses",
    )]
}

/// How well (m²) strips two particles wide measure the area of the water: they end at its highest particle where the
/// surface drops by H in all, and its edge is known to half a particle.
fn resolved_area(record: &Record) -> f64 {
    let spacing = record.discretisation.h / f64::from(record.discretisation.ppc).sqrt();
    0.5 * 2.0 * spacing * DEPTH + 0.5 * spacing * TANK
}

/// Tolerance of forces at rest.
fn at_rest(record: &Record) -> f64 {
    if record.parameters.is(START, EXACT) {
        AT_REST.0
    } else {
        AT_REST.1
    }
}

const NOT_AT_REST: &str = "the water is not at rest: its J is replaced by an average";

fn base_reaction(r: &Record) -> Vec<Finding> {
    let metric = m::BASE_REACTION_RATIO;
    vec![if smooths(r) {
        Finding::not_applicable(metric, NOT_AT_REST)
    } else {
        let weight = "weight of the water";
        judge(r, metric).within(1.0, at_rest(r), weight)
    }]
}

fn gate_force(r: &Record) -> Vec<Finding> {
    let metric = m::GATE_FORCE;
    let force = 0.5 * r.parameters.number(DENSITY) * GRAVITY * DEPTH * DEPTH;
    vec![if smooths(r) {
        Finding::not_applicable(metric, NOT_AT_REST)
    } else {
        let tolerance = at_rest(r) * force;
        judge(r, metric).within(force, tolerance, "hydrostatics")
    }]
}

/// Averages of averages diffuse the volume by h²/Δt: it takes an exact start and the case's own time step to see it.
fn creeps(r: &Record) -> Vec<Finding> {
    let sees = r.parameters.is(START, EXACT) && has_small_steps(r);
    if r.remedy() != RemedyName::FbarRecursive || !sees {
        return Vec::new();
    }
    let short = 1.0 - r.metric(m::BASE_REACTION_RATIO);
    let source = "averages of averages diffuse the volume: docs/column.md";
    let metric = m::BASE_REACTION_RATIO;
    vec![Finding::above(metric, short, at_rest(r), source)]
}

/// What is off by h in layers as thick as h is off by h^(3/2) in the mean.
fn profile_bound(record: &Record) -> f64 {
    PROFILE * (record.discretisation.h / PROFILE_CELL).powf(1.5)
}

fn pressure_profile(r: &Record) -> Option<Finding> {
    let metric = m::PRESSURE_PROFILE_ERROR;
    let found = || judge(r, metric).at_most(profile_bound(r), "hydrostatics");
    (!smooths(r)).then(found)
}

fn smoothed_start(r: &Record) -> Option<Finding> {
    let metric = m::PRESSURE_PROFILE_ERROR;
    let source =
        "Π takes the mean of J over what is there: at floor and surface that lies to one side";
    let found = || judge(r, metric).above(profile_bound(r), source);
    let seen = smooths(r) && r.parameters.is(START, EXACT);
    seen.then(found)
}

fn energy_not_gained(r: &Record) -> Vec<Finding> {
    let source = "explicit steps with lumped masses take energy from the motion, never give it";
    let metrics: &[_] = match r.transfer() {
        TransferName::Apic => &[m::ENERGY_EXCESS],
        _ => &[m::ENERGY_EXCESS, m::ENERGY_GAIN],
    };
    let found = |&metric: &_| judge(r, metric).at_most(ROUNDING, source);
    metrics.iter().map(found).collect()
}

/// Elastic energy of the water at rest behind the gate over all its energy: what the stress can give back.
fn stored(record: &Record) -> f64 {
    let density = record.parameters.number(DENSITY);
    let (at_start, _) = energies(density);
    elastic_energy(density, record.parameters.number(BULK_MODULUS)) / at_start
}

fn motion_not_gained(r: &Record) -> Option<Finding> {
    let metric = m::MOTION_EXCESS;
    let source = "the elastic energy of the water at rest";
    let found = || judge(r, metric).at_most(stored(r), source);
    (!makes_energy(r)).then(found)
}

fn energy_made(r: &Record) -> Option<Finding> {
    let metric = m::MOTION_EXCESS;
    let found = || judge(r, metric).above(stored(r), MAKES_ENERGY);
    makes_energy(r).then(found)
}

fn dissipation(r: &Record) -> Option<Finding> {
    let (at_start, at_rest) = energies(r.parameters.number(DENSITY));
    let metric = m::MOTION_LOSS;
    let source = "water at rest in the tank has two thirds of its energy";
    let bound = 1.0 - at_rest / at_start;
    let found = || judge(r, metric).at_most(bound, source);
    (!makes_energy(r)).then(found)
}

fn front_speed(r: &Record) -> Vec<Finding> {
    let metric = m::FRONT_SPEED_MAX;
    let bound = greatest_speed();
    vec![judge(r, metric).at_most(bound, "Ritter 1892")]
}

/// Distance (m) from the inviscid front that a grid may leave.
fn front_bound(record: &Record) -> f64 {
    record.discretisation.h + uncertainty()
}

/// Why the front of a run is not judged, if it is not.
fn front_is_open(record: &Record) -> Option<&'static str> {
    if record.metric(m::FRONT_RMS_ERROR).is_nan() {
        Some("the run ends before the front is near the wall")
    } else if !is_flip(record) {
        Some("this transfer is viscous: see docs/dam-break.md")
    } else {
        None
    }
}

fn front(r: &Record) -> Option<Finding> {
    let metric = m::FRONT_RMS_ERROR;
    let source = "inviscid front; a grid resolves no tongue thinner than a cell";
    let found = match front_is_open(r) {
        Some(why) => Finding::not_applicable(metric, why),
        None => judge(r, metric).at_most(front_bound(r), source),
    };
    is_averaged(r).then_some(found)
}

fn arrival(r: &Record) -> Option<Finding> {
    let metric = m::ARRIVAL_ERROR;
    let passes = passage(TANK - 2.0 * r.discretisation.h);
    let speed = passes.map_or(f64::NAN, |(_, speed)| speed);
    let source = "inviscid front, likewise";
    let found = match front_is_open(r) {
        Some(why) => Finding::not_applicable(metric, why),
        None => judge(r, metric).at_most(front_bound(r) / speed, source),
    };
    is_averaged(r).then_some(found)
}

fn locked(r: &Record) -> Option<Finding> {
    let metric = m::FRONT_RMS_ERROR;
    let source = "standard MPM locks: Zhao et al. 2023, Figure 12";
    let found = || judge(r, metric).above(front_bound(r), source);
    let judged = !is_averaged(r) && r.basis() == BasisName::Gimp && front_is_open(r).is_none();
    judged.then(found)
}

#[cfg(test)]
mod tests;
