//! A slope at rest: what creeps or grows in a long time of nothing.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::incline::{ENTRY, INCLINATION, THICKNESS};

const HUNDRED_THOUSAND: &str = "duration=20";
const MILLION: &str = "duration=200";
/// Largest drift of a cell's mean J per 10⁵ steps, and least steps from which it is judged.
const DRIFT: f64 = 1e-5;
const ENOUGH: u64 = 100_000;
/// Growth of a sampled kinetic energy that is no growth of a motion.
const BEATS: f64 = 2.0;
/// Kinetic energy (J/m) that last bits of 2 t of particles on 2 m can walk to in a million steps of 0.2 ms: half of it is
/// ½ m (ε L/Δt)² times the number of steps.
const ROUNDING: f64 = 1e-14;

struct Incline;

impl Known for Incline {
    const SOLUTION: Solution = ENTRY.build;
    const BOUNDARY: Boundary = Boundary::Slope;
    const RESTS: bool = true;
    const PARAMETERS: Composed = (&[ENTRY.parameters], &[(CFL, "0.3")], "2", &[]);
}

pub(super) fn case() -> Case {
    let few = [RemedyName::None, FbarRecursive, FbarConsistent];
    let few = pairs(&SMOOTH, &few);
    let all = pairs(&[Gimp, Bspline2, Bspline3], &REMEDIES);
    let plan = Plan::of(levels(1.0, [("h0.25", 4.0), ("h0.125", 8.0)]))
        .runs(Pr, "h0.25", &few, "")
        .runs(Nightly, "h0.25 h0.125", &all, "")
        .runs(Nightly, "h0.25", &all, HUNDRED_THOUSAND)
        .runs(Nightly, "h0.25", &few, MILLION);
    known_case::<2, Incline>([
        "rest",
        "Slope at rest",
        "A layer two metres thick on a rough incline starts in its exact state of rest and has nothing to do, for up to a million steps: no energy grows, nothing creeps, but what the printed F̄ is known to.",
    ])
    .planned(plan)
    .reference("Exact state of rest at finite deformation, exact/src/incline.rs.")
    .reference("What fbar-recursive tends to: J̄ that is the same everywhere, docs/rest.md.")
    .limit("The layer is endless: no toe, no crest. Elastic: what a yielding slope creeps by is not here.")
    .anew()
    .wanted("place", "largest distance of a particle from its place of rest", "stays")
    .missed_by("out-of-balance pressure-relaxes")
    .wanted("pressure", "mean pressure at the foot", "base-pressure")
    .missed_by("out-of-balance pressure-relaxes")
    .checks(checks())
    .headline(DISPLACEMENT_L2, "rms distance from rest (m)", 1.0, 6)
    .headline(J_DRIFT_PER_1E5_STEPS, "drift of J̄ per 10⁵ steps (–)", 1.0, 6)
    .headline(TRUE_J_DRIFT_PER_1E5_STEPS, "of J (–)", 1.0, 6)
    .headline(KINETIC_GROWTH, "kinetic energy, last / middle third (–)", 1.0, 3)
    .headline(KINETIC_ENERGY_PEAK, "largest kinetic energy (J/m)", 1.0, 6)
    .tables(vec![table("rest", HUNDRED_THOUSAND), table("rest-million", MILLION)])
}

fn table(name: &str, set: &'static str) -> ResultTable {
    ResultTable::of(name, move |r| r.changes(set))
        .by(&[SCHEME])
        .metric("rms distance from rest (m)", DISPLACEMENT_L2, SHORT)
        .metric("drift of J̄ per 10⁵ steps", J_DRIFT_PER_1E5_STEPS, SHORT)
        .metric("of J", TRUE_J_DRIFT_PER_1E5_STEPS, SHORT)
        .metric("pressure at the foot (Pa)", BASE_PRESSURE, fixed(0))
        .metric("last/middle third", KINETIC_GROWTH, SHORT)
        .metric("largest kinetic energy (J/m)", KINETIC_ENERGY_PEAK, SHORT)
}

fn checks() -> Vec<Check> {
    // There is no known reason to leave the state of rest.
    let is_sound = |r: &Run<()>| r.remedy() != FbarRecursive && r.basis() != Bspline3;
    vec![
        mass(),
        Gate::truth("stays", "distance of every particle from rest at most h² |u″|/8, of ρ g sin θ/μ along and ρ g cos θ/M across")
            .at_most(DISPLACEMENT_LINF, interpolation)
            .because("what piecewise linear functions leave of a displacement that is quadratic in depth"),
        Gate::truth("base-pressure", "mean pressure at the foot (1 + ν)/(3 (1 − ν)) ρ g cos θ H within a quarter of a cell's weight")
            .within(BASE_PRESSURE, base_pressure, |r| {
                let share = 0.25 * r.h / r.number(THICKNESS);
                share * base_pressure(r)
            })
            .because("uniaxial strain under the weight; a quarter of a cell, by which an average moves the pressure at a wall"),
        Gate::truth("no-growth", "GIMP and quadratic splines, all but fbar-recursive: peak kinetic energy of the last third at most twice that of the middle third, and rounding")
            .when(is_sound)
            .except(|r| r.metric(KINETIC_GROWTH).is_nan(), "nothing moves, or not for three rows")
            .at_most(KINETIC_GROWTH, |r| BEATS + ROUNDING / r.metric(KINETIC_ENERGY_PEAK))
            .because("nothing feeds a motion; two hundred samples of a ringing that nothing damps don't meet its peaks"),
        Gate::truth("no-creep", "GIMP and quadratic splines, all but fbar-recursive, from 10⁵ steps on: the mean J of no cell drifts by more than 10⁻⁵ per 10⁵ steps")
            .when(move |r| is_sound(r) && r.record.work.steps >= ENOUGH)
            .at_most(TRUE_J_DRIFT_PER_1E5_STEPS, |_| DRIFT)
            .because("the state of rest is one of the equations; a tenth of the compression at the foot"),
        Gate::known_limit("out-of-balance", "cubic splines, and all on the wall's line: distance of a particle from rest above the bound of stays")
            .when(|r| r.basis() == Bspline3 || r.basis() == Bspline2 && r.values.is(WALL, WALL_LINE))
            .above(DISPLACEMENT_LINF, interpolation)
            .because("two particles a direction don't integrate cubic splines, or those that a wall cuts, at a foot that a stress acts on"),
        Gate::known_limit("pressure-relaxes", "fbar-recursive: pressure at the foot within a twentieth of its mean over the height, half the exact value")
            .when(|r| r.remedy() == FbarRecursive)
            .within(BASE_PRESSURE, |r| 0.5 * base_pressure(r), |r| 0.05 * base_pressure(r))
            .because("Eq. (26) diffuses J̄ until it is the same everywhere, in 10⁴ steps here; shear takes over what it leaves"),
    ]
}

/// Interpolation error (m) of piecewise linear functions for the displacement, whose curvature is ρ g sin θ/μ along the slope
/// and ρ g cos θ/M across it (1/m).
fn interpolation(r: &Run<()>) -> f64 {
    let shear = 0.5 * r.number(YOUNG_MODULUS) / (1.0 + r.number(POISSON_RATIO));
    let ratio = r.number(POISSON_RATIO);
    let oedometric = shear * 2.0 * (1.0 - ratio) / (1.0 - 2.0 * ratio);
    let (along, across) = r.number(INCLINATION).to_radians().sin_cos();
    let weight = r.number(DENSITY) * r.number(GRAVITY);
    r.h.powi(2) * weight * (along / shear).hypot(across / oedometric) / 8.0
}

/// Mean pressure at the foot (Pa).
fn base_pressure(r: &Run<()>) -> f64 {
    let ratio = r.number(POISSON_RATIO);
    let weight = r.number(DENSITY) * r.number(GRAVITY) * r.number(THICKNESS);
    let across = weight * r.number(INCLINATION).to_radians().cos();
    (1.0 + ratio) / (3.0 * (1.0 - ratio)) * across
}
