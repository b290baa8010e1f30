//! A slope at rest: what creeps or grows in a long time of nothing.
//!
//! Set-up, choices and tolerances: `docs/rest.md`.

use super::family::{REMEDIES, family, levels, pairs};
use super::manufactured::checks::mass;
use super::manufactured::metrics::{
    BASE_PRESSURE, DISPLACEMENT_L2, DISPLACEMENT_LINF, J_DRIFT_PER_1E5_STEPS, KINETIC_ENERGY_PEAK,
    KINETIC_GROWTH, TRUE_J_DRIFT_PER_1E5_STEPS,
};
use super::manufactured::{Boundary, CFL, Manufactured, all_parameters};
use super::parameters::{DENSITY, POISSON_RATIO, YOUNG_MODULUS};
use crate::case::{Case, Family, Tier};
use crate::check::{Check, judge, run};
use crate::exact::common::GRAVITY;
use crate::exact::incline::{ENTRY, INCLINATION, THICKNESS};
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, SHORT, fixed, headline};
use crate::scheme::{BasisName, RemedyName};
use crate::spec::Level;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRecursive};
use Tier::{Nightly, Pr};

/// Largest drift of a cell's mean J per 10⁵ steps, and least steps from which it is judged.
const DRIFT: f64 = 1e-5;
const ENOUGH: u64 = 100_000;
/// Growth of a sampled kinetic energy that is no growth of a motion.
const BEATS: f64 = 2.0;
/// Kinetic energy (J/m) that last bits of 2 t of particles on 2 m can walk to in a million steps of 0.2 ms: half of it is
/// ½ m (ε L/Δt)² times the number of steps.
const ROUNDING: f64 = 1e-14;

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("h0.25", 4.0), ("h0.125", 8.0)]);
    let names = [
        "rest",
        "Slope at rest",
        "A layer two metres thick on a rough incline starts in its exact state of rest and has nothing to do, for up to a million steps: no energy grows, nothing creeps, but what the printed F̄ is known to.",
    ];
    let motion = Manufactured {
        boundary: Boundary::Slope,
        rests: true,
        ..Manufactured::solid(ENTRY.build)
    };
    let parameters = all_parameters(ENTRY.parameters, &[(CFL, "0.3")], "2", &[]);
    Case {
        references: vec![
            "Exact state of rest at finite deformation, exact/src/incline.rs.".to_owned(),
            "What fbar-recursive tends to: J̄ that is the same everywhere, docs/rest.md.".to_owned(),
        ],
        limits: &[
            "The layer is endless: no toe, no crest. Elastic: what a yielding slope creeps by is not here.",
        ],
        plan: plan(&levels),
        levels,
        checks: checks(),
        headlines: vec![
            headline(DISPLACEMENT_L2, "rms distance from rest (m)", 1.0, 6),
            headline(
                J_DRIFT_PER_1E5_STEPS,
                "drift of J̄ per 10⁵ steps (–)",
                1.0,
                6,
            ),
            headline(TRUE_J_DRIFT_PER_1E5_STEPS, "of J (–)", 1.0, 6),
            headline(
                KINETIC_GROWTH,
                "kinetic energy, last / middle third (–)",
                1.0,
                3,
            ),
            headline(KINETIC_ENERGY_PEAK, "largest kinetic energy (J/m)", 1.0, 6),
        ],
        quantities: Vec::new(),
        tables: vec![
            table("rest", HUNDRED_THOUSAND),
            table("rest-million", MILLION),
        ],
        ..motion.case(names, parameters)
    }
}

const HUNDRED_THOUSAND: &[&str] = &["duration=20"];
const MILLION: &[&str] = &["duration=200"];

fn plan(levels: &[Level]) -> Vec<Family> {
    let few = pairs(
        &[Gimp, Bspline2],
        &[RemedyName::None, FbarRecursive, FbarConsistent],
    );
    let all = pairs(&[Gimp, Bspline2, Bspline3], &REMEDIES);
    vec![
        family(Pr, &levels[..1], &few, &[]),
        family(Nightly, levels, &all, &[]),
        family(Nightly, &levels[..1], &all, HUNDRED_THOUSAND),
        family(Nightly, &levels[..1], &few, MILLION),
    ]
}

fn checks() -> Vec<Check> {
    vec![
        mass(),
        Check::truth(
            "stays",
            "GIMP and quadratic splines, all but fbar-recursive: no particle is farther from its place of rest than h² u″/8, u″ = ρ g sin θ/μ",
            run(|r: &Record| {
                let why = "what piecewise linear functions leave of a displacement that is quadratic in depth";
                is_sound(r).then(|| judge(r, DISPLACEMENT_LINF).at_most(interpolation(r), why))
            }),
        ),
        Check::truth(
            "base-pressure",
            "likewise: the mean pressure at the foot is (1 + ν)/(3 (1 − ν)) ρ g cos θ H within a quarter of a cell's weight",
            run(|r| {
                let why = "uniaxial strain under the weight; a quarter of a cell, by which an average moves the pressure at a wall";
                let exact = base_pressure(r);
                let share = 0.25 * r.discretisation.h / r.parameters.number(THICKNESS);
                is_sound(r).then(|| judge(r, BASE_PRESSURE).within(exact, share * exact, why))
            }),
        ),
        Check::truth(
            "no-growth",
            "likewise: the largest kinetic energy of the last third of the run is at most twice that of the middle third, but for what last bits can walk to",
            run(|r| {
                let bound = BEATS + ROUNDING / r.metric(KINETIC_ENERGY_PEAK);
                let why = "nothing feeds a motion; two hundred samples of a ringing that nothing damps don't meet its peaks";
                is_sound(r).then(|| judge(r, KINETIC_GROWTH).at_most(bound, why))
            }),
        ),
        Check::truth(
            "no-creep",
            "likewise, from 10⁵ steps on: the mean J of no cell drifts by more than 10⁻⁵ per 10⁵ steps",
            run(|r| {
                let metric = TRUE_J_DRIFT_PER_1E5_STEPS;
                let why = "the state of rest is one of the equations; a hundredth of the compression at the foot";
                (is_sound(r) && r.work.steps >= ENOUGH)
                    .then(|| judge(r, metric).at_most(DRIFT, why))
            }),
        ),
        Check::known_limit(
            "cubic-out-of-balance",
            "cubic splines: a particle is farther from its place than that",
            run(|r| {
                let why = "two particles a direction don't integrate cubic splines at a foot that a stress acts on";
                (r.basis() == Bspline3)
                    .then(|| judge(r, DISPLACEMENT_LINF).above(interpolation(r), why))
            }),
        ),
        Check::known_limit(
            "pressure-relaxes",
            "fbar-recursive: the pressure at the foot is its mean over the height, half of what it should be, within a twentieth",
            run(|r| {
                let why = "Eq. (26) diffuses J̄ until it is the same everywhere, in 10⁴ steps here; shear takes over what it leaves";
                let exact = base_pressure(r);
                (r.remedy() == FbarRecursive)
                    .then(|| judge(r, BASE_PRESSURE).within(0.5 * exact, 0.05 * exact, why))
            }),
        ),
    ]
}

/// Whether a scheme has no known reason to leave the state of rest.
fn is_sound(r: &Record) -> bool {
    r.remedy() != FbarRecursive && r.basis() != Bspline3
}

/// What piecewise linear functions leave of the displacement (m).
fn interpolation(r: &Record) -> f64 {
    r.discretisation.h.powi(2) * curvature(r) / 8.0
}

/// ρ g sin θ/μ (1/m).
fn curvature(r: &Record) -> f64 {
    let number = |p| r.parameters.number(p);
    let shear = 0.5 * number(YOUNG_MODULUS) / (1.0 + number(POISSON_RATIO));
    number(DENSITY) * number(GRAVITY) * number(INCLINATION).to_radians().sin() / shear
}

/// Mean pressure at the foot (Pa).
fn base_pressure(r: &Record) -> f64 {
    let number = |p| r.parameters.number(p);
    let ratio = number(POISSON_RATIO);
    let weight = number(DENSITY) * number(GRAVITY) * number(THICKNESS);
    let across = weight * number(INCLINATION).to_radians().cos();
    (1.0 + ratio) / (3.0 * (1.0 - ratio)) * across
}

fn table(name: &'static str, set: &'static [&'static str]) -> ResultTable {
    let columns = [
        ("rms distance from rest (m)", DISPLACEMENT_L2),
        ("drift of J̄ per 10⁵ steps", J_DRIFT_PER_1E5_STEPS),
        ("of J", TRUE_J_DRIFT_PER_1E5_STEPS),
        ("pressure at the foot (Pa)", BASE_PRESSURE),
        ("last/middle third", KINETIC_GROWTH),
        ("largest kinetic energy (J/m)", KINETIC_ENERGY_PEAK),
    ];
    let columns = columns.map(|(title, metric)| {
        let format = if metric == BASE_PRESSURE {
            fixed(0)
        } else {
            SHORT
        };
        Column::metric(title, metric, format)
    });
    ResultTable::new(name, move |r| r.set == set, &[SCHEME], columns)
}
