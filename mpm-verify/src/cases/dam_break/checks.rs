//! Verdicts on the dam break. The tolerances are derived in `docs/dam-break.md`.

mod study;

pub(super) use study::judge_study;

use super::reference::{
    DEPTH, GRAVITY, LENGTH, TANK, elastic_energy, energies, greatest_speed, passage, uncertainty,
};
use crate::case::{CheckInfo, check};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use crate::verdict::{Kind, Verdict};

/// Relative tolerance of the forces at rest: of the exact start, and after the gravity stage.
const AT_REST: (f64, f64) = (1e-3, 5e-3);
/// Rms error of the pressure at rest over that at the floor on cells of [`PROFILE_CELL`] (m).
const PROFILE: f64 = 0.01;
const PROFILE_CELL: f64 = 0.25;
/// Rounding of sums over steps and particles.
const ROUNDING: f64 = 1e-9;
pub(super) const CHECKS: &[CheckInfo] = &[
    check(
        "particle-count",
        Kind::Bookkeeping,
        "L H / (h/n)² particles at n per direction: the paper's 3,200 at h = 0.25 m and five",
    ),
    check(
        "mass",
        Kind::Bookkeeping,
        "all: the mass at the end is ρ L H to rounding",
    ),
    check(
        "base-reaction",
        Kind::Truth,
        "none, fbar-rate, fbar-consistent: the force on the floor, mean over three of the water's longest periods behind the gate, is its weight within 0.1 %, within 0.5 % after a gravity stage",
    ),
    check(
        "gate-force",
        Kind::Truth,
        "none, fbar-rate, fbar-consistent: the force on the gate, likewise, is ½ ρ g H² within 0.1 %, within 0.5 % after a gravity stage",
    ),
    check(
        "creeps",
        Kind::KnownLimit,
        "fbar-recursive from the exact start, CFL below 0.1: the force on the floor is short of the weight by more than 0.1 %, because the water starts to sink",
    ),
    check(
        "pressure-profile",
        Kind::Truth,
        "none, fbar-rate, fbar-consistent: the pressure behind the gate is hydrostatic, rms, within 1 % of that at the floor at h = 0.25 m, elsewhere as h^(3/2)",
    ),
    check(
        "smoothed-start",
        Kind::KnownLimit,
        "fbar-recursive, fbar-total from the exact start: the pressure is off by more than that after one step: Π(J) ≠ J at floor and surface",
    ),
    check(
        "front",
        Kind::Truth,
        "F̄ with FLIP: the front is within a cell of the inviscid one, rms over t √(g/H) from 0.2 to 0.9",
    ),
    check(
        "arrival",
        Kind::Truth,
        "F̄ with FLIP: the front passes x = 6 m − 2h within the time in which the inviscid one crosses a cell",
    ),
    check(
        "front-speed",
        Kind::Truth,
        "all: the front is slower than 2 √(g H)",
    ),
    check(
        "energy-not-gained",
        Kind::Truth,
        "all: kinetic and potential energy and stress work never exceed their start; without APIC, whose affine motion the kinetic energy leaves out, they never grow",
    ),
    check(
        "motion-not-gained",
        Kind::Truth,
        "none, fbar-recursive, fbar-consistent: kinetic and potential energy never exceed their start by more than what is stored elastically then",
    ),
    check(
        "makes-energy",
        Kind::KnownLimit,
        "fbar-total, fbar-rate with FLIP (but quadratic splines with fbar-rate at h = 0.5 m and CFL 0.3), and with APIC at h = 0.125 m and below: they do, because the stress works on a volume that the law does not see",
    ),
    check(
        "dissipation",
        Kind::Truth,
        "all that make no energy: no more kinetic and potential energy is lost than until the water is at rest in the tank",
    ),
    check(
        "volume",
        Kind::Truth,
        "all: at 0.4 s the particles cover L H within what strips two particles wide resolve",
    ),
    check(
        "locked",
        Kind::KnownLimit,
        "none with GIMP: the front is more than a cell behind the inviscid one, rms",
    ),
    check(
        "front-converges",
        Kind::Truth,
        "F̄ with FLIP: the rms error of the front falls from level to level, with one CFL number",
    ),
    check(
        "start-converges",
        Kind::Truth,
        "F̄ with FLIP: the rms error of the pressure behind the gate falls from level to level, with one CFL number",
    ),
    check(
        "late-converges",
        Kind::Truth,
        "fbar-consistent with FLIP: from level to level, with one CFL number, impulse on the wall and mean centre of mass change less, or by less than an ensemble spreads",
    ),
    check(
        "smoother",
        Kind::Truth,
        "F̄: rms and checkerboard of the pressure at 0.4 s are less than half of standard MPM's",
    ),
    check(
        "starts-agree",
        Kind::Truth,
        "all: after a gravity stage the front advances as from the exact start within 0.25 %",
    ),
    check(
        "time-step",
        Kind::Truth,
        "fbar-consistent with FLIP: a CFL number up to 0.3 moves the front at 0.4 s by less than a tenth of a cell",
    ),
];

const MAKES_ENERGY: &str = "force and rate of volume average differently, so that the stress gives work for nothing: docs/remedy.md";

const DRIFTS: &str = "averages of averages let the true volumes drift until particles turn inside out: docs/dam-break.md";
/// Cells (m) from which on splashes are fine enough to show what coarse cells swallow.
const FINE: f64 = 0.125;

/// Cells (m) beyond which they swallow even what `fbar-rate` makes.
const COARSE: f64 = 0.25;

fn is_fine(record: &Record) -> bool {
    record.discretisation.h <= FINE
}

/// Whether a run has the case's own time step, not a larger one.
fn has_small_steps(record: &Record) -> bool {
    record.parameters.number("cfl") < 0.1
}

/// Whether a scheme has force and rate of volume from different averages, and nothing that dissipates enough.
fn makes_energy(record: &Record) -> bool {
    let differ = matches!(
        record.remedy(),
        RemedyName::FbarTotal | RemedyName::FbarRate
    );
    // What a step takes, ½ Σ m |Δv|², grows with it: large ones take more than little that is made.
    let little = record.remedy() == RemedyName::FbarRate
        && record.basis() == BasisName::Bspline2
        && record.discretisation.h > COARSE;
    let outweighed = little && !has_small_steps(record);
    differ && !outweighed && (is_flip(record) || is_fine(record))
}

/// Why a run is known to break down before its end, if it is.
pub(super) fn breaks_down(record: &Record) -> Option<&'static str> {
    if record.parameters.number("duration") < 2.0 {
        return None;
    }
    let gimp = record.basis() == BasisName::Gimp;
    // On coarse cells quadratic splines, and on the coarsest fbar-rate with small steps, make energy too, but keep the
    // water in the tank.
    let coarsest = record.discretisation.h > COARSE;
    let keeps_it = record.remedy() == RemedyName::FbarRate && coarsest && has_small_steps(record);
    let leaves_it = gimp && !keeps_it || is_flip(record) && is_fine(record);
    if makes_energy(record) && leaves_it {
        return Some(MAKES_ENERGY);
    }
    let printed = record.remedy() == RemedyName::FbarRecursive;
    (printed && gimp && is_flip(record) && is_fine(record)).then_some(DRIFTS)
}

fn is_flip(record: &Record) -> bool {
    record.transfer() == TransferName::Flip && record.parameters.number("pic_rate") == 0.0
}

fn is_averaged(record: &Record) -> bool {
    record.remedy() != RemedyName::None
}

/// Tolerance of forces at rest.
fn at_rest(record: &Record) -> f64 {
    if record.parameters.is("start", "exact") {
        AT_REST.0
    } else {
        AT_REST.1
    }
}

pub(super) fn judge(record: &Record) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    water(record, &mut verdicts);
    start(record, &mut verdicts);
    energy(record, &mut verdicts);
    front(record, &mut verdicts);
    verdicts
}

fn water(record: &Record, verdicts: &mut Vec<Verdict>) {
    let per_cell = f64::from(record.discretisation.ppc);
    let cells = LENGTH * DEPTH / record.discretisation.h.powi(2);
    verdicts.push(
        Verdict::close(
            "particle-count",
            "particles",
            record.work.particles as f64,
            per_cell * cells,
            0.0,
            "Zhao et al. 2022, section 4.3: 3,200 at h = 0.25 m",
        )
        .bookkeeping(),
    );
    let mass = record.parameters.number("density") * LENGTH * DEPTH;
    verdicts.push(
        Verdict::close(
            "mass",
            "mass",
            record.metric("mass"),
            mass,
            ROUNDING * mass,
            "conservation of mass",
        )
        .bookkeeping(),
    );
    let covered = record.metric("covered_0.4s");
    verdicts.push(if covered.is_nan() {
        Verdict::not_applicable("volume", "covered_0.4s", "the run ends before 0.4 s")
    } else {
        Verdict::close(
            "volume",
            "covered_0.4s",
            covered,
            LENGTH * DEPTH,
            resolved_area(record),
            "conservation of mass of a body that hardly compresses",
        )
    });
}

/// How well (m²) strips two particles wide measure the area of the water: they end at its highest particle where the
/// surface drops by H in all, and its edge is known to half a particle.
fn resolved_area(record: &Record) -> f64 {
    let spacing = record.discretisation.h / f64::from(record.discretisation.ppc).sqrt();
    0.5 * 2.0 * spacing * DEPTH + 0.5 * spacing * TANK
}

fn start(record: &Record, verdicts: &mut Vec<Verdict>) {
    rest(record, verdicts);
    let (metric, value) = (
        "pressure_profile_error",
        record.metric("pressure_profile_error"),
    );
    let exact = record.parameters.is("start", "exact");
    // What is off by h in layers as thick as h is off by h^(3/2) in the mean.
    let bound = PROFILE * (record.discretisation.h / PROFILE_CELL).powf(1.5);
    if !smooths(record) {
        verdicts.push(Verdict::at_most(
            "pressure-profile",
            Kind::Truth,
            metric,
            value,
            bound,
            "hydrostatics",
        ));
    } else if exact {
        verdicts.push(Verdict::above(
            "smoothed-start",
            Kind::KnownLimit,
            metric,
            value,
            bound,
            "Π takes the mean of J over what is there: at floor and surface that lies to one side",
        ));
    }
}

/// Whether the first step replaces the exact J by its average.
fn smooths(record: &Record) -> bool {
    matches!(
        record.remedy(),
        RemedyName::FbarRecursive | RemedyName::FbarTotal
    )
}

/// Whether a run starts exactly and has the case's own time step: averages of averages diffuse the volume by h²/Δt.
fn diffuses(record: &Record) -> bool {
    record.parameters.is("start", "exact") && has_small_steps(record)
}

/// The forces of the water at rest.
fn rest(record: &Record, verdicts: &mut Vec<Verdict>) {
    let tolerance = at_rest(record);
    let reaction = record.metric("base_reaction_ratio");
    if record.remedy() == RemedyName::FbarRecursive && diffuses(record) {
        verdicts.push(Verdict::above(
            "creeps",
            Kind::KnownLimit,
            "base_reaction_ratio",
            1.0 - reaction,
            tolerance,
            "averages of averages diffuse the volume: docs/column.md",
        ));
    }
    if smooths(record) {
        let why = "the water is not at rest: its J is replaced by an average";
        for (check, metric) in [
            ("base-reaction", "base_reaction_ratio"),
            ("gate-force", "gate_force"),
        ] {
            verdicts.push(Verdict::not_applicable(check, metric, why));
        }
        return;
    }
    verdicts.push(Verdict::close(
        "base-reaction",
        "base_reaction_ratio",
        reaction,
        1.0,
        tolerance,
        "weight of the water",
    ));
    let force = 0.5 * record.parameters.number("density") * GRAVITY * DEPTH * DEPTH;
    verdicts.push(Verdict::close(
        "gate-force",
        "gate_force",
        record.metric("gate_force"),
        force,
        tolerance * force,
        "hydrostatics",
    ));
}

fn energy(record: &Record, verdicts: &mut Vec<Verdict>) {
    let mut gained = |metric: &str| {
        verdicts.push(Verdict::at_most(
            "energy-not-gained",
            Kind::Truth,
            metric,
            record.metric(metric),
            ROUNDING,
            "explicit steps with lumped masses take energy from the motion, never give it",
        ));
    };
    gained("energy_excess");
    if record.transfer() != TransferName::Apic {
        gained("energy_gain");
    }
    let number = |name| record.parameters.number(name);
    let (at_start, at_rest) = energies(number("density"));
    let stored = elastic_energy(number("density"), number("bulk_modulus")) / at_start;
    let excess = record.metric("motion_excess");
    if makes_energy(record) {
        verdicts.push(Verdict::above(
            "makes-energy",
            Kind::KnownLimit,
            "motion_excess",
            excess,
            stored,
            MAKES_ENERGY,
        ));
        return;
    }
    verdicts.push(Verdict::at_most(
        "motion-not-gained",
        Kind::Truth,
        "motion_excess",
        excess,
        stored,
        "the elastic energy of the water at rest",
    ));
    verdicts.push(Verdict::at_most(
        "dissipation",
        Kind::Truth,
        "motion_loss",
        record.metric("motion_loss"),
        1.0 - at_rest / at_start,
        "water at rest in the tank has two thirds of its energy",
    ));
}

fn front(record: &Record, verdicts: &mut Vec<Verdict>) {
    let h = record.discretisation.h;
    verdicts.push(Verdict::at_most(
        "front-speed",
        Kind::Truth,
        "front_speed_max",
        record.metric("front_speed_max"),
        greatest_speed(),
        "Ritter 1892",
    ));
    let error = record.metric("front_rms_error");
    let why = if error.is_nan() {
        Some("the run ends before the front is near the wall")
    } else if !is_flip(record) {
        Some("this transfer is viscous: see docs/dam-break.md")
    } else {
        None
    };
    let bound = h + uncertainty();
    match record.remedy() {
        RemedyName::None => {
            if why.is_none() && record.basis() == BasisName::Gimp {
                verdicts.push(Verdict::above(
                    "locked",
                    Kind::KnownLimit,
                    "front_rms_error",
                    error,
                    bound,
                    "standard MPM locks: Zhao et al. 2022, Figure 12",
                ));
            }
        }
        _ => {
            if let Some(why) = why {
                verdicts.push(Verdict::not_applicable("front", "front_rms_error", why));
                verdicts.push(Verdict::not_applicable("arrival", "arrival_error", why));
                return;
            }
            verdicts.push(Verdict::at_most(
                "front",
                Kind::Truth,
                "front_rms_error",
                error,
                bound,
                "inviscid front; a grid resolves no tongue thinner than a cell",
            ));
            let speed = passage(TANK - 2.0 * h).map_or(f64::NAN, |(_, speed)| speed);
            verdicts.push(Verdict::at_most(
                "arrival",
                Kind::Truth,
                "arrival_error",
                record.metric("arrival_error"),
                bound / speed,
                "inviscid front, likewise",
            ));
        }
    }
}

#[cfg(test)]
mod tests;
