//! A column of water at rest: what creeps, creeps here; what grows by itself, grows here.

use super::manufactured::foreign::{TIME, gaps_of_rest, of_rest};
use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::hydrostatic::{ENTRY, HEIGHT};
use crate::foreign::Foreign;

/// Half a million steps at h = 0.25 m.
const HALF_A_MILLION: &str = "duration=5.04";
/// Largest drift of a cell's mean J̄ per 10⁵ steps.
const DRIFT: f64 = 1e-6;
/// Least steps from which a drift per 10⁵ steps is judged.
const ENOUGH: u64 = 100_000;
/// Growth of the kinetic energy over thirds of a run that is no ringing.
const GROWN: f64 = 100.0;
/// Kinetic energy (J/m) that the last bits of 2 t of particles on 2 m can walk to in 5·10⁵ steps of 10 µs:
/// ½ m (ε L/Δt)² times the number of steps.
const ROUNDING: f64 = 1e-12;

struct WaterColumn;

impl Known for WaterColumn {
    const SOLUTION: Solution = ENTRY.build;
    const BOUNDARY: Boundary = Boundary::Vessel;
    const FLUID: bool = true;
    const RESTS: bool = true;
    const PARAMETERS: Composed = (&[ENTRY.parameters], &[(CFL, "0.057"), (PPC_PER_DIRECTION, "5")], "0.2", &[]);
}

pub(super) fn case() -> Case {
    let few = pairs(&SMOOTH, &REMEDIES);
    let all = pairs(&[Gimp, Bspline2, Bspline3], &REMEDIES);
    let mut pr = pairs(&[Gimp], &[RemedyName::None, FbarRecursive, FbarConsistent]);
    pr.extend(pairs(&[Bspline2], &[FbarConsistent]));
    let plan = Plan::of(levels(1.0, [("h0.25", 4.0), ("h0.125", 8.0)]))
        .runs(Pr, "h0.25", &pr, "")
        .runs(Nightly, "h0.25 h0.125", &all, "")
        .runs(Nightly, "h0.25", &few, HALF_A_MILLION);
    known_case::<2, WaterColumn>([
        "column",
        "Hydrostatic column",
        "Two metres of water at rest in the exact state of equilibrium, without damping. The printed F̄ creeps at a speed that is known in closed form; a sound remedy neither creeps nor grows anything over half a million steps.",
    ])
    .planned(plan)
    .reference("Exact state of rest at finite compression, docs/exact.md.")
    .reference("Creep of fbar-recursive: (D/K) ∂p/∂z with D = ½ s² h²/Δt, docs/method.md.")
    .limit("Nothing mixes here: what moving particles bring about shows in standing-wave.")
    .limit("Cubic splines on this lattice are not in balance with the exact pressure to 10⁻³ of the weight; the column circulates slowly with every remedy and is judged no further.")
    .anew()
    .wanted("pressure", "pressure at the floor at rest", "base-pressure")
    .missed_by("creep")
    .checks(checks())
    .headline(J_DRIFT_PER_1E5_STEPS, "drift of J̄ per 10⁵ steps (10⁻⁶)", 1e6, 4)
    .headline(TRUE_J_DRIFT_PER_1E5_STEPS, "drift of J per 10⁵ steps (10⁻⁶)", 1e6, 3)
    .headline(KINETIC_GROWTH, "kinetic energy, last / middle third (–)", 1.0, 3)
    .headline(KINETIC_ENERGY_PEAK, "largest kinetic energy (µJ/m)", 1e6, 4)
    .headline(BASE_PRESSURE, "pressure at the floor (Pa)", 1.0, 1)
    .pictures(pictures)
    .table(ResultTable::of("column", |r| r.changes(HALF_A_MILLION))
        .by(&[SCHEME])
        .metric("drift of J̄ per 10⁵ steps", J_DRIFT_PER_1E5_STEPS, SHORT)
        .metric("of J", TRUE_J_DRIFT_PER_1E5_STEPS, SHORT)
        .metric("largest kinetic energy (J/m)", KINETIC_ENERGY_PEAK, SHORT)
        .metric("last/middle third", KINETIC_GROWTH, SHORT)
        .metric("pressure at the floor (kPa; exact 19.57)", BASE_PRESSURE, fixed(2).times(1e-3))
        .metric("rms error of u (m)", DISPLACEMENT_L2, SHORT))
}

pub(super) fn foreign() -> Foreign {
    Foreign {
        abscissa: Some(TIME),
        gaps: gaps_of_rest,
        ..Foreign::of::<2, Motion<2, WaterColumn>>(of_rest::<WaterColumn>())
    }
}

/// Whether the pressure ρ c v of the motion is as large as what the pressure at the floor may be off.
fn rings(r: &Run<()>) -> bool {
    let speed = (2.0 * r.metric(KINETIC_ENERGY_PEAK) / r.metric(MASS)).sqrt();
    let sound = r.number(CFL) * r.h / r.dt();
    sound * speed > 0.25 * r.h * r.number(GRAVITY)
}

fn checks() -> Vec<Check> {
    // A mode that the average can't see grows until it rules the motion.
    let grows = |r: &Run<()>| r.basis() == Gimp && matches!(r.remedy(), FbarTotal | FbarRate);
    // Long enough to distinguish a drift from the ringing of the start.
    let is_long = |r: &Run<()>| r.record.work.steps >= ENOUGH;
    // The column rests: GIMP and quadratic splines with any remedy except the creeping one.
    let rests = |r: &Run<()>| r.basis() != Bspline3 && r.remedy() != FbarRecursive;
    // ρ g (Pa/m).
    let weight = |r: &Run<()>| r.number(DENSITY) * r.number(GRAVITY);
    vec![
        mass(),
        Gate::truth("base-pressure", "pressure at the floor ρ g H within the hydrostatic pressure of a quarter cell")
            .except(move |r| weight(r) == 0.0, "nothing has weight")
            .except(rings, "the column rings, and with it the pressure")
            .except(move |r| is_long(r) && (grows(r) || r.remedy() == FbarRecursive), "the column no longer rests: see creep and null-mode-grows")
            .within(BASE_PRESSURE, move |r| weight(r) * r.number(HEIGHT), move |r| 0.25 * r.h * weight(r))
            .because("ρ g H; a quarter of a cell's head, by which an average moves the pressure at a wall"),
        Gate::known_limit("creep", "fbar-recursive: mean J of a cell drifts by more than 10⁻³ per 10⁵ steps")
            .when(|r| r.basis() != Bspline3 && r.remedy() == FbarRecursive)
            .above(TRUE_J_DRIFT_PER_1E5_STEPS, |_| 1e-3)
            .because("Eq. (26) diffuses J with D = ½ s² h²/Δt"),
        Gate::truth("no-creep", "GIMP and quadratic splines except fbar-recursive, at least 10⁵ steps: mean J̄ of every cell drifts by at most 10⁻⁶ per 10⁵ steps")
            .when(rests)
            .except(move |r| !is_long(r), "the ringing of the start is not a drift")
            .at_most(J_DRIFT_PER_1E5_STEPS, |_| DRIFT)
            .because("the state of rest is one of the equations"),
        Gate::known_limit("null-mode-grows", "GIMP with fbar-total and fbar-rate, at least 10⁵ steps: kinetic energy of the last third more than 100 times that of the middle third")
            .when(move |r| rests(r) && is_long(r) && grows(r))
            .above(KINETIC_GROWTH, |_| GROWN)
            .because("what Π can't see has no stiffness, and under pressure uGIMP's quadrature error makes it negative (docs/remedy.md)"),
        Gate::truth("no-growth", "GIMP, quadratic splines, not fbar-recursive, from 10⁵ steps: peak kinetic energy of the last third at most the middle third's, and rounding")
            .when(move |r| rests(r) && is_long(r) && !grows(r))
            .at_most(KINETIC_GROWTH, |r| 1.0 + ROUNDING / r.metric(KINETIC_ENERGY_PEAK))
            .because("nothing feeds a motion; a random walk of last bits excepted"),
    ]
}

/// A panel per basis of the longest runs at the coarsest level: how far particles are from rest, over the steps.
fn pictures(gallery: &mut Gallery) -> Result<(), Error> {
    let panels = [Gimp, Bspline2].map(|basis| {
        let of_basis = |r: &&Record| r.basis() == basis && r.status == Status::Ok && is_flip(r);
        let runs = || gallery.records.iter().filter(of_basis);
        let longest = runs().map(|r| r.work.steps).max().unwrap_or(0);
        let labels = ["steps (10⁵)", "rms distance from rest (m)"];
        let longest = runs().filter(move |r| r.work.steps == longest);
        Panel::new("", labels).log_y().histories(gallery, longest, |record, t| {
            let moved = t.points("time", "displacement_l2").into_iter().filter(|(t, _)| *t > 0.0);
            let steps = |t: f64| t / record.discretisation.dt / 1e5;
            moved.map(|(t, u)| (steps(t), u)).collect()
        })
    });
    let caption = format!(
        "Distance of the particles from their places at rest: {FbarRecursive} creeps; with GIMP a mode that no average sees grows from rounding with every F̄."
    );
    let [gimp, splines] = panels;
    Figure::new("creep", caption, [gimp?, splines?]).columns(2).draw(gallery)
}
