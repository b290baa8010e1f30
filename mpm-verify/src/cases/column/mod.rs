//! A column of water at rest: what creeps, creeps here; what grows by itself, grows here.
//!
//! Set-up, choices and tolerances: `docs/column.md`.

mod pictures;
mod tables;

use super::family::{REMEDIES, family, levels, pairs};
use super::manufactured::metrics::{
    BASE_PRESSURE, J_DRIFT_PER_1E5_STEPS, KINETIC_ENERGY_PEAK, KINETIC_GROWTH,
    TRUE_J_DRIFT_PER_1E5_STEPS,
};
use super::manufactured::{
    Boundary, CFL, Manufactured, PPC_PER_DIRECTION, all_parameters, checks::mass,
};
use super::parameters::DENSITY;
use crate::case::{Case, Family, Tier};
use crate::check::{Check, Finding, judge, run};
use crate::exact::common::GRAVITY;
use crate::exact::hydrostatic::{ENTRY, HEIGHT};
use crate::record::Record;
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName};
use crate::spec::Level;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal};
use Tier::{Nightly, Pr};

/// Largest drift of a cell's mean J̄ per 10⁵ steps.
const DRIFT: f64 = 1e-6;
/// Least steps from which a drift per 10⁵ steps is judged.
const ENOUGH: u64 = 100_000;
/// Growth of the kinetic energy over thirds of a run that is no ringing.
const GROWN: f64 = 100.0;
/// Kinetic energy (J/m) that the last bits of 2 t of particles on 2 m can walk to in 5·10⁵ steps of 10 µs:
/// ½ m (ε L/Δt)² times the number of steps.
const ROUNDING: f64 = 1e-12;

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("h0.25", 4.0), ("h0.125", 8.0)]);
    let names = [
        "column",
        "Hydrostatic column",
        "Two metres of water at rest in the exact state of equilibrium, without damping. The printed F̄ creeps at a speed that is known in closed form; a sound remedy neither creeps nor grows anything over half a million steps.",
    ];
    let motion = Manufactured {
        boundary: Boundary::Vessel,
        fluid: true,
        rests: true,
        ..Manufactured::solid(ENTRY.build)
    };
    let defaults = [(CFL, "0.057"), (PPC_PER_DIRECTION, "5")];
    let parameters = all_parameters(ENTRY.parameters, &defaults, "0.2", &[]);
    Case {
        references: vec![
            "Exact state of rest at finite compression, docs/exact.md.".to_owned(),
            "Creep of fbar-recursive: (D/K) ∂p/∂z with D = ½ s² h²/Δt, docs/method.md.".to_owned(),
        ],
        limits: &[
            "Nothing mixes here: what moving particles bring about shows in standing-wave.",
            "Cubic splines on this lattice are not in balance with the exact pressure to 10⁻³ of the weight; the column circulates slowly with every remedy and is judged no further.",
        ],
        plan: plan(&levels),
        levels,
        checks: checks(),
        headlines: vec![
            headline(
                J_DRIFT_PER_1E5_STEPS,
                "drift of J̄ per 10⁵ steps (10⁻⁶)",
                1e6,
                4,
            ),
            headline(
                TRUE_J_DRIFT_PER_1E5_STEPS,
                "drift of J per 10⁵ steps (10⁻⁶)",
                1e6,
                3,
            ),
            headline(
                KINETIC_GROWTH,
                "kinetic energy, last / middle third (–)",
                1.0,
                3,
            ),
            headline(KINETIC_ENERGY_PEAK, "largest kinetic energy (µJ/m)", 1e6, 4),
            headline(BASE_PRESSURE, "pressure at the floor (Pa)", 1.0, 1),
        ],
        quantities: Vec::new(),
        pictures: pictures::draw,
        tables: tables::all(),
        ..motion.case(names, parameters)
    }
}

/// Half a million steps at h = 0.25 m.
const LONG: &[&str] = &["duration=5.04"];

fn plan(levels: &[Level]) -> Vec<Family> {
    let few = pairs(&[Gimp, Bspline2], &REMEDIES);
    let all = pairs(&[Gimp, Bspline2, Bspline3], &REMEDIES);
    let mut pr = pairs(&[Gimp], &[RemedyName::None, FbarRecursive, FbarConsistent]);
    pr.extend(pairs(&[Bspline2], &[FbarConsistent]));
    vec![
        family(Pr, &levels[..1], &pr, &[]),
        family(Nightly, levels, &all, &[]),
        family(Nightly, &levels[..1], &few, LONG),
    ]
}

/// Whether a mode that the average can't see grows with this scheme until it rules the motion.
fn grows(r: &Record) -> bool {
    r.basis() == Gimp && matches!(r.remedy(), FbarTotal | FbarRate)
}

/// Whether a run is long enough that a drift can be told from the ringing of the start.
fn is_long(r: &Record) -> bool {
    r.work.steps >= ENOUGH
}

/// Whether the column rests with this scheme: GIMP and quadratic splines, but for the remedy that creeps.
fn rests(r: &Record) -> bool {
    r.basis() != Bspline3 && r.remedy() != FbarRecursive
}

fn checks() -> Vec<Check> {
    vec![
        mass(),
        Check::truth(
            "base-pressure",
            "pressure at the floor ρ g H within a quarter of a cell's head, by which an average moves the pressure at a wall",
            run(|r| vec![base_pressure(r)]),
        ),
        Check::known_limit(
            "creep",
            "fbar-recursive: mean J of some cell drifts by more than 10⁻³ per 10⁵ steps",
            run(|r| {
                let creeps = r.basis() != Bspline3 && r.remedy() == FbarRecursive;
                let (metric, why) = (
                    TRUE_J_DRIFT_PER_1E5_STEPS,
                    "Eq. (26) diffuses J with D = ½ s² h²/Δt",
                );
                let found = judge(r, metric).above(1e-3, why);
                creeps.then_some(found)
            }),
        ),
        Check::truth(
            "no-creep",
            "GIMP and quadratic splines but fbar-recursive, at least 10⁵ steps: the mean J̄ of no cell drifts by more than 10⁻⁶ per 10⁵ steps",
            run(|r| {
                let metric = J_DRIFT_PER_1E5_STEPS;
                let found = if is_long(r) {
                    let why = "the state of rest is one of the equations";
                    judge(r, metric).at_most(DRIFT, why)
                } else {
                    Finding::not_applicable(metric, "the ringing of the start is not a drift")
                };
                rests(r).then_some(found)
            }),
        ),
        Check::known_limit(
            "null-mode-grows",
            "GIMP with fbar-total and fbar-rate, at least 10⁵ steps: the kinetic energy of the last third is more than 100 times that of the middle third",
            run(|r| {
                let why = "what Π can't see has no stiffness, and under pressure uGIMP's quadrature error makes it negative (docs/modes.md)";
                let found = judge(r, KINETIC_GROWTH).above(GROWN, why);
                (rests(r) && is_long(r) && grows(r)).then_some(found)
            }),
        ),
        Check::truth(
            "no-growth",
            "likewise, but where null-mode-grows: the largest kinetic energy of the last third of the run does not exceed that of the middle third, when the start has rung down, but for what last bits can walk to",
            run(|r| {
                let bound = 1.0 + ROUNDING / r.metric(KINETIC_ENERGY_PEAK);
                let why = "nothing feeds a motion; a random walk of last bits excepted";
                let found = judge(r, KINETIC_GROWTH).at_most(bound, why);
                (rests(r) && is_long(r) && !grows(r)).then_some(found)
            }),
        ),
    ]
}

fn base_pressure(r: &Record) -> Finding {
    let head = r.parameters.number(DENSITY) * r.parameters.number(GRAVITY);
    if is_long(r) && (grows(r) || r.remedy() == FbarRecursive) {
        let why = "the column no longer rests: see creep and null-mode-grows";
        return Finding::not_applicable(BASE_PRESSURE, why);
    }
    judge(r, BASE_PRESSURE).within(
        head * r.parameters.number(HEIGHT),
        0.25 * r.discretisation.h * head,
        "ρ g H; a quarter of a cell's head, by which an average moves the pressure at a wall",
    )
}
