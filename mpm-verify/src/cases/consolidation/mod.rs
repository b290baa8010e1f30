//! Consolidation of a column at finite strain: the solver of solid and water against an independent solution.
//!
//! Set-up, reference and tolerances: `docs/consolidation.md`.

mod checks;
mod errors;
pub(super) mod foreign;
mod metrics;
mod parameters;
mod pictures;
mod reference;
mod scene;
mod tables;
mod watch;

use super::family::{family, levels};
use crate::case::{Case, Family, Tier};
use crate::metric::error;
use crate::results::headline;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use scene::HEIGHT;
use watch::Consolidation;

use BasisName::{Gimp, Linear};
use SpaceName::{Equal, Ppp, TwoGrid};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [(&str, f64); 6] = [
    ("n8", 8.0),
    ("n16", 16.0),
    ("n32", 32.0),
    ("n64", 64.0),
    ("n128", 128.0),
    ("n256", 256.0),
];
/// The column's own modulus, and a load under which no particle crosses a cell.
const WHOLE: &[&str] = &["load=1"];
const SMALL: &[&str] = &["load=0.003"];
/// Fewer steps; the other rate; a top that lets less through.
const STEPS: [&[&str]; 2] = [&["refine=1"], &["refine=2"]];
const LOGARITHM: [&[&str]; 3] = [
    &["volume_rate=logarithmic"],
    &["load=1", "volume_rate=logarithmic"],
    &["refine=1", "volume_rate=logarithmic"],
];
/// Ghost penalties, on displacements, on pressures, and on both as other cases have them.
const GHOSTS: [&[&str]; 9] = [
    &["ghost_displacement=0.01"],
    &["ghost_displacement=0.1"],
    &["ghost_displacement=1"],
    &["ghost_displacement=10"],
    &["ghost_pressure=0.001"],
    &["ghost_pressure=0.01"],
    &["ghost_pressure=0.1"],
    &["ghost_pressure=1"],
    &["ghost_displacement=0.1", "ghost_pressure=0.01"],
];
const DRAINS: [&[&str]; 2] = [&["drain=100"], &["drain=1e3"]];

pub(super) fn case() -> Case {
    let levels = levels(HEIGHT, LEVELS);
    Case {
        name: "consolidation",
        title: "Consolidation of a column at finite strain",
        description: "A column full of water settles by a fifth or by two fifths of its height as it drains at its top: the surface leaves \
                      the grid's lines, particles cross cells, pores close and let less water through.",
        references: vec![
            "references/consolidation.py: Chebyshev collocation, and finite volumes that agree with it to 10⁻⁸.".to_owned(),
            "The same of backward Euler's steps: the error of space by itself.".to_owned(),
        ],
        limits: &[
            "One dimension; the improved Hencky law is ours of what is told of it.",
            "References at loads of 0.003, 0.3 and 1 M₀ alone.",
            "Linear functions break down at large strain: what they would come to is not known.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::SETTLEMENT_ERROR, "error of settlement (%)", 100.0, 3),
            headline(m::SETTLEMENT_ERROR_STEPS, "of space alone (%)", 100.0, 3),
            headline(m::BASE_PRESSURE_ERROR, "error of p at the base (% of q)", 100.0, 3),
            headline(m::SETTLEMENT_END, "settlement (% of H)", 100.0, 3),
            headline(m::MASS_ERROR, "water made (–)", 1.0, 10),
            headline(m::RATE_LOSS, "½ Σ V (J̃ − 1)² over the outflow (–)", 1.0, 10),
            headline(m::ENTRIES, "entries of a matrix", 1.0, 0),
        ],
        quantities: vec![
            error(m::SETTLEMENT_ERROR_STEPS, "relative error of the settlement in space"),
            error(m::SETTLEMENT_ERROR, "relative error of the settlement"),
        ],
        sweeps: Vec::new(),
        watched: &["base_pressure", "settlement"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-3 * spec.level.h.powi(-1)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Consolidation::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: checks::breaks_down,
    }
}

fn schemes(bases: &[BasisName]) -> Vec<Scheme> {
    let of = |basis: &BasisName| [TwoGrid, Equal, Ppp].map(|space| Scheme::poro(*basis, space));
    bases.iter().flat_map(of).collect()
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let (both, gimp, linear) = (
        schemes(&[Gimp, Linear]),
        schemes(&[Gimp]),
        schemes(&[Linear]),
    );
    let (coarse, two_grid, n16) = (&levels[..3], &both[..1], &levels[1..2]);
    let mut all = vec![
        family(Quick, &levels[..1], two_grid, STEPS[0]),
        family(Pr, &levels[..4], &gimp, &[]),
        family(Pr, n16, &both, SMALL),
        family(Pr, coarse, &gimp, WHOLE),
        family(Pr, n16, two_grid, LOGARITHM[0]),
        family(Nightly, &levels[3..5], &both, &[]),
        family(Nightly, &levels[3..], &both, WHOLE),
        family(Nightly, coarse, &linear, &[]),
        family(Nightly, coarse, &linear, WHOLE),
        family(Nightly, coarse, &both, SMALL),
    ];
    all.extend(STEPS.map(|set| family(Pr, n16, two_grid, set)));
    all.extend(LOGARITHM.map(|set| family(Nightly, n16, two_grid, set)));
    all.extend(GHOSTS.map(|set| family(Nightly, coarse, two_grid, set)));
    all.extend(DRAINS.map(|set| family(Nightly, coarse, &gimp, set)));
    all
}

fn sketch() -> Sketch {
    let mut shapes = vec![
        Shape::Body(vec![[0.0, 0.0], [0.3, 0.0], [0.3, 1.0], [0.0, 1.0]]),
        Shape::Held([0.0, 0.0], [0.3, 0.0]),
        Shape::length([-0.1, 0.0], [-0.1, 1.0], "1 m"),
        Shape::note([0.15, 1.2], "q, drained"),
    ];
    for k in 0..3 {
        let x = 0.05 + 0.1 * f64::from(k);
        shapes.push(Shape::Load([x, 1.13], [x, 1.02]));
    }
    Sketch {
        shapes,
        description: "A column of 1 m on an impermeable floor, under a load q on its drained top that makes it settle.",
    }
}
