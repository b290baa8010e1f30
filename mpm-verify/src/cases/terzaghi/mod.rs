//! Consolidation of a column at small strain: what the spaces of the pressure do, and the solver of solid and water against
//! an exact solution.
//!
//! Section 5.1 of Pretti et al., doi:10.1002/nme.7630. Set-up, choices and tolerances: `docs/terzaghi.md`.

mod checks;
mod metrics;
mod parameters;
mod pictures;
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
use metrics::{
    ENTRIES, MASS_ERROR, OVERSHOOT_FIRST_STEP, PRESSURE_L2, PRESSURE_L2_STEPS, SETTLEMENT_ERROR,
};
use scene::HEIGHT;
use watch::Consolidation;

use BasisName::{Gimp, Linear};
use SpaceName::{Equal, Ppp, TwoGrid};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [(&str, f64); 5] = [
    ("n10", 10.0),
    ("n20", 20.0),
    ("n40", 40.0),
    ("n80", 80.0),
    ("n160", 160.0),
];
/// Shares c_v Δt/h² of first steps that are run for themselves.
const FIRST_STEPS: [&[&str]; 8] = [
    &["first_step=0.05", "steps=1"],
    &["first_step=0.1", "steps=1"],
    &["first_step=0.16666666666666666", "steps=1"],
    &["first_step=0.25", "steps=1"],
    &["first_step=0.35", "steps=1"],
    &["first_step=0.6666666666666666", "steps=1"],
    &["first_step=0.75", "steps=1"],
    &["first_step=1", "steps=1"],
];
/// A first step of T = 4·10⁻⁵ on 20 and on 160 cells, and eighty growing ones after it.
const COARSE: &[&str] = &["first_step=0.016", "steps=1"];
const FINE: &[&str] = &["first_step=1.024", "steps=1"];
const COARSE_LONG: &[&str] = &["first_step=0.016", "steps=80", "time_end=1"];
const FINE_LONG: &[&str] = &["first_step=1.024", "steps=80", "time_end=1"];

pub(super) fn case() -> Case {
    let levels = levels(HEIGHT, LEVELS);
    Case {
        name: "terzaghi",
        title: "Consolidation of a column",
        description: "A column full of water is loaded at once and drains at its top, at small strain: the exact solution is a series. \
                      Each space of the pressure has a shortest first step below which the pressure overshoots, and by how much \
                      is known in closed form.",
        references: vec![
            "Terzaghi's series, derived in the source and tested against values with fifty digits.".to_owned(),
            "The overshoot of the first step: closed form of the discrete equations, docs/poromechanics.md.".to_owned(),
        ],
        limits: &[
            "Small strain on a fixed grid: no particle crosses a cell, and linear functions and GIMP are one.",
            "Two particles a cell: with more the projection's share of the bound is another one.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(PRESSURE_L2, "error of p (% of q)", 100.0, 4),
            headline(PRESSURE_L2_STEPS, "of space alone (%)", 100.0, 5),
            headline(OVERSHOOT_FIRST_STEP, "overshoot (%)", 100.0, 3),
            headline(SETTLEMENT_ERROR, "error of settlement (%)", 100.0, 4),
            headline(MASS_ERROR, "water made (–)", 1.0, 10),
            headline(ENTRIES, "entries of a matrix", 1.0, 0),
        ],
        quantities: vec![
            error(PRESSURE_L2_STEPS, "rms error of p/q in space"),
            error(PRESSURE_L2, "rms error of p/q"),
        ],
        sweeps: Vec::new(),
        watched: &["base_pressure", "settlement"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-6 * spec.level.h.powi(-2)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Consolidation::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn schemes(bases: &[BasisName]) -> Vec<Scheme> {
    let of = |basis: &BasisName| [TwoGrid, Equal, Ppp].map(|space| Scheme::poro(*basis, space));
    bases.iter().flat_map(of).collect()
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let (both, linear) = (schemes(&[Gimp, Linear]), schemes(&[Linear]));
    let gimp = schemes(&[Gimp]);
    let (n20, n80, n160) = (&levels[1..2], &levels[3..4], &levels[4..]);
    let mut all = vec![
        family(Quick, &levels[..1], &both[..1], &[]),
        family(Pr, levels, &both, &[]),
        family(Pr, n20, &linear, COARSE),
        family(Pr, n160, &linear, FINE),
        family(Nightly, n20, &linear, COARSE_LONG),
        family(Nightly, n160, &linear, FINE_LONG),
    ];
    all.extend(FIRST_STEPS.map(|set| family(Pr, n20, &linear, set)));
    all.extend(FIRST_STEPS.map(|set| family(Nightly, n20, &gimp, set)));
    let steps: [&'static [&'static str]; 4] =
        [&["steps=5"], &["steps=10"], &["steps=20"], &["steps=80"]];
    all.extend(steps.map(|set| family(Pr, n80, &linear, set)));
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
        description: "A column of 1 m on an impermeable floor, under a load q on its drained top.",
    }
}
