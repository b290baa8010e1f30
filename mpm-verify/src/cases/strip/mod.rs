//! A flexible strip on soil full of water: the solver of solid and water where the ground sinks out of its cells, and
//! where clay yields.
//!
//! G. Pretti et al., section 5.3. Set-up, reference and tolerances: `docs/strip.md`.

mod checks;
mod limit;
mod metrics;
mod oedometer;
mod parameters;
mod pictures;
mod reference;
mod scene;
mod tables;
mod watch;

use super::family::{family, levels};
use crate::case::{Case, Family, Tier};
use crate::metric::value;
use crate::results::headline;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use watch::drive;

use BasisName::Gimp;
use SpaceName::{Equal, Ppp, TwoGrid};
use Tier::{Long, Nightly, Pr, Quick};

const LEVELS: [(&str, f64); 3] = [("b2", 2.0), ("b4", 4.0), ("b8", 8.0)];

/// Loads at which strain is small: the reference's steps, and no flow.
const SMALL: &[&str] = &["load=40"];
const UNDRAINED: &[&str] = &["conductivity=1e-16", "load=40", "steps=1"];
/// A square instead of a strip, at such loads and at the whole one.
const SQUARE: &[&str] = &["dimension=3", "load=40"];
const SQUARE_UNDRAINED: &[&str] = &["conductivity=1e-16", "dimension=3", "load=40", "steps=1"];
const SQUARE_LARGE: &[&str] = &["dimension=3"];
/// Clay, until it bears no more.
const CLAY: &[&str] = &["law=cam-clay", "load=1e5"];
/// Clay before that.
const CLAY_BELOW: &[&str] = &["law=cam-clay", "load=5.5e4"];
/// Stiff undrained clay under a load, and under a settlement.
const LIMIT_LOAD: &[&str] = &[
    "conductivity=1e-16",
    "law=cam-clay",
    "load=7.2e4",
    "steps=72",
    "young_modulus=1e8",
];
const LIMIT_SETTLEMENT: &[&str] = &[
    "conductivity=1e-16",
    "control=settlement",
    "law=cam-clay",
    "young_modulus=1e8",
];

/// Other numbers of steps, of elastic soil and of clay.
const STEPS: [&[&str]; 8] = [
    &["steps=1"],
    &["steps=2"],
    &["steps=5"],
    &["steps=10"],
    &["steps=40"],
    &["law=cam-clay", "load=1e5", "steps=10"],
    &["law=cam-clay", "load=1e5", "steps=40"],
    &[
        "law=cam-clay",
        "load=1e5",
        "shape_alpha=0.6",
        "shape_gamma=0.9",
    ],
];
/// Clay under a load on its whole surface that water leaves freely.
const UNIFORM: [&[&str]; 3] = [
    &[
        "duration=1e10",
        "half_width=5",
        "law=cam-clay",
        "load=1e5",
        "steps=10",
    ],
    &[
        "duration=1e10",
        "half_width=5",
        "law=cam-clay",
        "load=1e5",
        "steps=20",
    ],
    &[
        "duration=1e10",
        "half_width=5",
        "law=cam-clay",
        "load=1e5",
        "steps=40",
    ],
];
/// Less of the ghost penalties, or none.
const GHOSTS: [&[&str]; 5] = [
    &["ghost_displacement=0", "ghost_pressure=0"],
    &["ghost_displacement=0"],
    &["ghost_pressure=0"],
    &["ghost_displacement=0.01"],
    &["ghost_displacement=1"],
];

pub(super) fn case() -> Case {
    let levels = levels(1.0, LEVELS);
    Case {
        name: "strip",
        title: "Flexible strip on soil full of water",
        description: "A strip without stiffness presses on soil full of water in plane strain, elastic or Cam clay: the surface leaves the \
                      grid's lines by half the strip's half width, and clay yields until it bears no more. Or a square on a cube of soil.",
        references: vec![
            "references/strip_fem.py: Taylor and Hood's finite elements at small strain, of the same steps and undrained, of a strip and of a square.".to_owned(),
            "Prandtl's limit load (2 + π) s_u of undrained clay, with the strength of its critical state.".to_owned(),
        ],
        limits: &[
            "The paper's numbers were not to be read: size, moduli, load and times are ours.",
            "At large strain nothing is known but balances, and that pressures are smooth.",
            "A rigid strip is held nodes, for settlements that are small against a cell.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::SETTLEMENT, "settlement (% of B)", 100.0, 3),
            headline(m::SETTLEMENT_RATIO, "over that of finite elements", 1.0, 4),
            headline(m::PRESSURE_ERROR, "error of p (% of q)", 100.0, 3),
            headline(m::ROUGHNESS, "roughness of p (% of q)", 100.0, 3),
            headline(m::LEAST_PRESSURE, "least p (% of q)", 100.0, 2),
            headline(m::LAST_LOAD, "last load (kPa)", 1e-3, 2),
            headline(m::LIMIT_LOAD, "limit load (kPa)", 1e-3, 2),
            headline(m::UNIFORM_ERROR, "of clay in uniaxial strain, error (%)", 100.0, 4),
            headline(m::NEWTON_ITERATIONS, "Newton iterations", 1.0, 0),
            headline(m::ENTRIES, "entries of a matrix", 1.0, 0),
        ],
        quantities: vec![value(m::SETTLEMENT, "settlement")],
        sweeps: Vec::new(),
        watched: &["load", "settlement"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| match spec.set.iter().any(|s| s == SQUARE_LARGE[0]) {
            true => 0.1 * spec.level.h.powi(-6),
            false => 1e-3 * spec.level.h.powi(-3),
        }),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(drive),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: checks::breaks_down,
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let all = [TwoGrid, Equal, Ppp].map(|space| Scheme::poro(Gimp, space));
    let (two_grid, coarse, b4) = (&all[..1], &levels[..2], &levels[1..2]);
    let mut plan = vec![
        family(Quick, &levels[..1], two_grid, &[]),
        family(Pr, levels, &all, UNDRAINED),
        family(Pr, coarse, two_grid, SMALL),
        family(Pr, b4, two_grid, &[]),
        family(Pr, &levels[..1], two_grid, CLAY_BELOW),
        family(Nightly, levels, &all, &[]),
        family(Nightly, levels, &all, SMALL),
        family(Nightly, levels, two_grid, CLAY),
        family(Nightly, levels, &all, CLAY_BELOW),
        family(Nightly, levels, two_grid, LIMIT_LOAD),
        family(Nightly, levels, two_grid, LIMIT_SETTLEMENT),
    ];
    plan.extend([
        family(Pr, &levels[..1], two_grid, SQUARE_UNDRAINED),
        family(Nightly, coarse, &all, SQUARE_UNDRAINED),
        family(Nightly, &levels[..1], two_grid, SQUARE),
        family(Long, coarse, two_grid, SQUARE),
        family(Long, coarse, two_grid, SQUARE_LARGE),
    ]);
    plan.extend(UNIFORM.map(|set| family(Pr, &levels[..1], two_grid, set)));
    plan.extend(STEPS.map(|set| family(Nightly, b4, two_grid, set)));
    plan.extend(GHOSTS.map(|set| family(Nightly, b4, two_grid, set)));
    plan
}

fn sketch() -> Sketch {
    let mut shapes = vec![
        Shape::Body(vec![[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]]),
        Shape::Held([0.0, 0.0], [5.0, 0.0]),
        Shape::Held([0.0, 0.0], [0.0, 5.0]),
        Shape::length([0.0, -0.5], [5.0, -0.5], "5 B"),
        Shape::note([3.2, 5.3], "drained"),
        Shape::note([0.5, 6.0], "q"),
    ];
    for k in 0..4 {
        let x = 0.125 + 0.25 * f64::from(k);
        shapes.push(Shape::Load([x, 5.7], [x, 5.05]));
    }
    Sketch {
        shapes,
        description: "Half of a flexible strip on a square of soil whose surface is drained.",
    }
}
