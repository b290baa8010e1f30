//! The factor by which the strength of a slope can be divided before it fails.
//!
//! The section and the elasticity of the landslide with perfect plasticity: no softening, so that limit analysis says what
//! is right. Set-up, choices and tolerances: `docs/slope-stability.md`.

mod checks;
mod tables;
mod watch;

use super::family::{family, implicit, pairs};
use super::landslide::STABILITY;
use super::landslide::parameters::{
    CFL, CREST, DENSITY, FACE_ANGLE, FLOOR, HEIGHT, POISSON_RATIO, PPC_PER_DIRECTION, WALL,
    YOUNG_MODULUS,
};
use super::parameters as common;
use crate::case::{Case, Tier};
use crate::metric::{error, metrics};
use crate::parameter::{Domain, Parameter, number, parameters};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::spec::Level;
use watch::Trials;

use BasisName::{Bspline2, Gimp};
use RemedyName::{FbarConsistent, FbarRecursive};
use Tier::{Long, Nightly, Pr};

parameters! { const:
    STRENGTH = "strength", "Pa", "40.82e3", number(1.0, 1e12, false),
        "strength κ = ‖s‖, √2 times the undrained shear strength";
    MOST = "most", "-", "3", number(1.1, 100.0, false), "largest factor that is tried";
    TRIALS = "trials", "-", "8", Domain::Integer { least: 1, most: 20 },
        "trials: the largest factor, then bisection";
}

const LOAD_STEPS: Parameter =
    common::LOAD_STEPS.meaning("quasi-static: equal steps in which the weight is raised");
const TOLERANCE: Parameter = common::TOLERANCE.with_default("1e-8");
/// What only an explicit run has.
const OF_EXPLICIT: [&str; 2] = [CFL.name, WALL.name];
/// What only a quasi-static run has.
const OF_QUASI_STATIC: [&str; 2] = [LOAD_STEPS.name, TOLERANCE.name];

const PARAMETERS: [Parameter; 15] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    STRENGTH,
    DENSITY,
    HEIGHT,
    CREST,
    FACE_ANGLE,
    FLOOR.with_default("5"),
    MOST,
    TRIALS,
    CFL,
    WALL,
    PPC_PER_DIRECTION,
    LOAD_STEPS,
    TOLERANCE,
];

metrics! { METRICS:
    STRENGTH_REDUCTION_FACTOR = "strength_reduction_factor", "-",
        "middle of the factors between which the slope first fails; the largest tried, if it stands";
    FACTOR_ERROR = "factor_error", "-",
        "relative distance of that from the factor of limit analysis, which is known to half a per cent; none where the slope stands at the largest factor or has another angle than 45°";
    STANDS_AT = "stands_at", "-", "largest factor at which the slope stands";
    FAILS_AT = "fails_at", "-", "least factor at which it fails";
    MOVED_STANDING = "moved_standing", "m",
        "largest displacement since the reduction at the largest factor at which it stands";
    MASS = "mass", "kg/m", "mass of the ground";
    NEWTON_ITERATIONS = "newton_iterations", "-", "quasi-static: Newton's iterations of all trials";
}

fn levels() -> [Level; 3] {
    [("h0.4", 0.4), ("h0.2", 0.2), ("h0.1", 0.1)].map(|(name, h)| Level { name, h })
}

/// Of the pull request: three trials of softer ground, whose steps are longer. The limit load doesn't ask for stiffness.
const SHORT: &[&str] = &["young_modulus=6.25e6", "most=2", "trials=3"];

/// Likewise of equilibrium, for which stiffness costs nothing.
const QUICK: &[&str] = &["most=2", "trials=3"];

pub(super) fn case() -> Case {
    let levels = levels();
    let none = RemedyName::None;
    let remedies = [none, FbarRecursive, FbarConsistent];
    let remedied = implicit(&[RuleName::QuasiStatic], &[Gimp], &[FbarConsistent]);
    let statics = implicit(
        &[RuleName::QuasiStatic],
        &[Gimp, Bspline2],
        &[none, FbarConsistent],
    );
    let (gimp, all) = (
        pairs(&[Gimp], &remedies),
        pairs(&[Gimp, Bspline2], &remedies),
    );
    Case {
        name: "slope-stability",
        title: "Stability of the slope",
        description: "The slope of the landslide, without softening, under its weight. Its strength is divided by factors between which it first fails, \
                      found by bisection; limit analysis gives the factor. Standard MPM locks and stands where it should fail.",
        references: vec!["Limit analysis (docs/exact.md): γH/c = 6.04 (6.015 to 6.078) for 45° on a firm base at the level of the toe".to_owned()],
        limits: &[
            "Failure is a displacement of H/50 within 4 s: a slope within half a per cent of its limit is called standing.",
            "A shear band is as wide as the cells and can't come nearer to the fixed base: the slope is too strong by about h/H.",
        ],
        parameters: PARAMETERS.to_vec(),
        plan: vec![
            family(Pr, &levels[..1], &gimp, SHORT),
            family(Nightly, &levels[..2], &all, &[]),
            family(Long, &levels[2..], &all, &[]),
            family(Pr, &levels[..1], &remedied, QUICK),
            family(Nightly, &levels[..2], &statics, &[]),
            family(Long, &levels[2..], &statics, &[]),
        ],
        levels: levels.to_vec(),
        metrics: METRICS.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(STRENGTH_REDUCTION_FACTOR, "factor (–)", 1.0, 3),
            headline(STANDS_AT, "stands at", 1.0, 3),
            headline(FAILS_AT, "fails at", 1.0, 3),
            headline(MOVED_STANDING, "moved, standing (mm)", 1e3, 1),
            headline(NEWTON_ITERATIONS, "iterations", 1.0, 0),
        ],
        quantities: vec![error(FACTOR_ERROR, "relative error of the factor").known_to(
            (STABILITY.2 - STABILITY.1) / (2.0 * STABILITY.0),
        )],
        sweeps: Vec::new(),
        watched: &["factor", "moved"],
        field: None,
        sketch: super::landslide::sketch("5 m"),
        cost: Box::new(|spec| {
            let solver = if spec.scheme.rule().is_some() { 0.05 } else { 1.0 };
            solver * spec.level.h.powi(-3)
        }),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Trials::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}
