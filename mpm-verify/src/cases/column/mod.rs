//! A column of water at rest: what creeps, creeps here; what grows by itself, grows here.
//!
//! Set-up, choices and tolerances: `docs/column.md`.

use super::manufactured::checks;
use super::manufactured::plan::{REMEDIES, ladder, levels, pairs, union};
use super::manufactured::{Boundary, Manufactured, numerical, parameters};
use crate::case::{CheckInfo, Headline, RunSpec, Tier};
use crate::exact::hydrostatic::ENTRY;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};
use crate::verdict::{Kind, Verdict};
use std::sync::LazyLock;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarRate, FbarRecursive, FbarTotal};

/// Largest drift of a cell's mean J̄ per 10⁵ steps.
const DRIFT: f64 = 1e-6;
/// Least steps from which a drift per 10⁵ steps is judged.
const ENOUGH: u64 = 100_000;
/// Growth of the kinetic energy over thirds of a run that is no ringing.
const GROWN: f64 = 100.0;
/// Kinetic energy (J/m) that the last bits of 2 t of particles on 2 m can walk to in 5·10⁵ steps of 10 µs:
/// ½ m (ε L/Δt)² times the number of steps.
const ROUNDING: f64 = 1e-12;

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact state of rest at finite compression, docs/exact.md.",
        "Creep of fbar-recursive: (D/K) ∂p/∂z with D = ½ s² h²/Δt, docs/method.md.",
    ],
    limits: &[
        "Nothing mixes here: what moving particles bring about shows in standing-wave.",
        "Cubic splines on this lattice are not in balance with the exact pressure to 10⁻³ of the weight; the column circulates slowly with every remedy and is judged no further.",
    ],
    boundary: Boundary::Vessel,
    fluid: true,
    rests: true,
    schemes: pairs(&[Gimp, Bspline2, Bspline3], &REMEDIES),
    levels: levels(1.0, [("h0.25", 4.0), ("h0.125", 8.0)]),
    plan,
    checks: CHECKS,
    judge,
    judge_study: |_| Vec::new(),
    headlines: HEADLINES,
    quantities: &[],
    ..Manufactured::solid(
        [
            "column",
            "Hydrostatic column",
            "Two metres of water at rest in the exact state of equilibrium, without damping. The printed F̄ creeps at a speed that is known in closed form; a sound remedy neither creeps nor grows anything over half a million steps.",
        ],
        ENTRY.build,
        parameters(
            ENTRY.parameters,
            &[],
            numerical("0.2").map(|mut p| {
                match p.name {
                    "cfl" => p.default = "0.057",
                    "ppc_per_direction" => p.default = "5",
                    _ => {}
                }
                p
            }),
        ),
    )
});

/// Half a million steps at h = 0.25 m.
const LONG: &str = "duration=5.04";

const HEADLINES: &[Headline] = &[
    Headline {
        metric: "j_drift_per_1e5_steps",
        heading: "drift of J̄ per 10⁵ steps (10⁻⁶)",
        factor: 1e6,
        decimals: 4,
    },
    Headline {
        metric: "true_j_drift_per_1e5_steps",
        heading: "drift of J per 10⁵ steps (10⁻⁶)",
        factor: 1e6,
        decimals: 3,
    },
    Headline {
        metric: "kinetic_growth",
        heading: "kinetic energy, last / middle third (–)",
        factor: 1.0,
        decimals: 3,
    },
    Headline {
        metric: "kinetic_energy_peak",
        heading: "largest kinetic energy (µJ/m)",
        factor: 1e6,
        decimals: 4,
    },
    Headline {
        metric: "base_pressure",
        heading: "pressure at the floor (Pa)",
        factor: 1.0,
        decimals: 1,
    },
];

const CHECKS: &[CheckInfo] = &[
    checks::MASS,
    CheckInfo {
        name: "no-creep",
        kind: Kind::Truth,
        statement: "GIMP and quadratic splines but fbar-recursive, at least 10⁵ steps: the mean J̄ of no cell drifts by more than 10⁻⁶ per 10⁵ steps",
    },
    CheckInfo {
        name: "no-growth",
        kind: Kind::Truth,
        statement: "likewise, but where null-mode-grows: the largest kinetic energy of the last third of the run does not exceed that of the middle third, when the start has rung down, but for what last bits can walk to",
    },
    CheckInfo {
        name: "null-mode-grows",
        kind: Kind::KnownLimit,
        statement: "GIMP with fbar-total and fbar-rate, at least 10⁵ steps: the kinetic energy of the last third is more than 100 times that of the middle third",
    },
    CheckInfo {
        name: "base-pressure",
        kind: Kind::Truth,
        statement: "pressure at the floor ρ g H within a quarter of a cell's head, by which an average moves the pressure at a wall",
    },
    CheckInfo {
        name: "creep",
        kind: Kind::KnownLimit,
        statement: "fbar-recursive: mean J of some cell drifts by more than 10⁻³ per 10⁵ steps",
    },
];

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    match tier {
        Tier::Quick => Vec::new(),
        Tier::Pr => ladder(&levels[..1], &case.schemes[..10], &[]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(levels, &case.schemes, &[]),
            ladder(&levels[..1], &case.schemes[..10], &[LONG]),
        ]),
        Tier::Long => Vec::new(),
    }
}

/// Whether a mode that the average can't see grows with this scheme until it rules the motion.
fn grows(r: &Record) -> bool {
    r.basis() == Gimp && matches!(r.remedy(), FbarTotal | FbarRate)
}

fn judge(r: &Record) -> Vec<Verdict> {
    let number = |name| r.parameters.number(name);
    let head = number("density") * number("gravity");
    let long = r.work.steps >= ENOUGH;
    let mut verdicts = vec![checks::mass(r)];
    verdicts.push(if long && (grows(r) || r.remedy() == FbarRecursive) {
        let why = "the column no longer rests: see creep and null-mode-grows";
        Verdict::not_applicable("base-pressure", "base_pressure", why)
    } else {
        Verdict::close(
            "base-pressure",
            "base_pressure",
            r.metric("base_pressure"),
            head * number("height"),
            0.25 * r.discretisation.h * head,
            "ρ g H; a quarter of a cell's head, by which an average moves the pressure at a wall",
        )
    });
    if r.basis() == Bspline3 {
        return verdicts;
    }
    if r.remedy() == FbarRecursive {
        verdicts.push(Verdict::above(
            "creep",
            Kind::KnownLimit,
            "true_j_drift_per_1e5_steps",
            r.metric("true_j_drift_per_1e5_steps"),
            1e-3,
            "Eq. (26) diffuses J with D = ½ s² h²/Δt",
        ));
        return verdicts;
    }
    let metric = "j_drift_per_1e5_steps";
    if !long {
        verdicts.push(Verdict::not_applicable(
            "no-creep",
            metric,
            "the ringing of the start is not a drift",
        ));
        return verdicts;
    }
    verdicts.push(Verdict::at_most(
        "no-creep",
        Kind::Truth,
        metric,
        r.metric(metric),
        DRIFT,
        "the state of rest is one of the equations",
    ));
    let (metric, growth) = ("kinetic_growth", r.metric("kinetic_growth"));
    verdicts.push(if grows(r) {
        Verdict::above(
            "null-mode-grows",
            Kind::KnownLimit,
            metric,
            growth,
            GROWN,
            "what Π can't see has no stiffness, and under pressure uGIMP's quadrature error makes it negative (docs/modes.md)",
        )
    } else {
        Verdict::at_most(
            "no-growth",
            Kind::Truth,
            metric,
            growth,
            1.0 + ROUNDING / r.metric("kinetic_energy_peak"),
            "nothing feeds a motion; a random walk of last bits excepted",
        )
    });
    verdicts
}
