//! Load steps far too large, a softening body, a floor that is hardly touched: the implicit solver finds the exact
//! equilibrium, or says that it finds none.
//!
//! Set-up, choices and tolerances: `docs/newton.md`.

mod checks;
mod exact;
mod metrics;
mod parameters;
mod tables;
mod watch;

use super::family::{family, implicit, levels};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use watch::Loaded;

use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("n8", 8.0), ("n16", 16.0)]);
    Case {
        name: "newton",
        title: "Load steps that are far too large",
        description: "A column under its own weight, which softens where it hangs and touches a barrier where it stands, in a thousand \
                      load steps or in one: the implicit solver finds the exact equilibrium, cuts the step, or says that it finds none.",
        references: vec![
            "Exact: uniaxial strain of a Hencky body under its own weight, src/cases/newton/exact.rs."
                .to_owned(),
        ],
        limits: &["Uniaxial strain, one law, no stabilisation of cut cells."],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::CARRIED, "load carried (%)", 100.0, 1),
            headline(m::BEARABLE, "that there is (%)", 100.0, 1),
            headline(m::EQUILIBRIUM_ERROR, "error (–)", 1.0, 5),
            headline(m::BOUND, "bound (–)", 1.0, 5),
            headline(m::NEWTON_ITERATIONS, "iterations", 1.0, 0),
            headline(m::PARTS, "most parts of a step", 1.0, 0),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["equilibrium_error", "newton_iterations"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|_| 0.05),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Loaded::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn schemes() -> Vec<Scheme> {
    use BasisName::{Bspline2, Gimp, Linear};
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    implicit(
        &[RuleName::QuasiStatic],
        &[Gimp, Linear, Bspline2],
        &remedies,
    )
}

/// Loads in one step, and what stands: iterations that rounding hardly changes.
const SURE: [&[&str]; 4] = [
    &["load=0.97"],
    &["support=stands"],
    &["load=2", "support=stands"],
    &["load=2", "poisson_ratio=0.4999", "support=stands"],
];
/// Numbers of load steps, loads beyond the greatest, a floor that is not touched: steps that are cut.
const CUT: [&[&str]; 8] = [
    &["load_steps=10"],
    &["load=0.97", "load_steps=10"],
    &["load=1.1"],
    &["load=1.1", "load_steps=10"],
    &["load=10"],
    &["load_steps=10", "support=stands"],
    &["gap=1", "support=stands"],
    &["gap=1.5", "support=stands"],
];
const SMALL: [&[&str]; 7] = [
    &["load_steps=100"],
    &["load_steps=1000"],
    &["load=1.1", "load_steps=100"],
    &["load_steps=100", "support=stands"],
    &["load_steps=1000", "support=stands"],
    &["load=20", "support=stands"],
    &["gap=0.99", "support=stands"],
];

fn plan(levels: &[Level]) -> Vec<Family> {
    let all = schemes();
    let coarse = &levels[..1];
    let splines: Vec<Scheme> = all
        .iter()
        .copied()
        .filter(|s| s.basis() == BasisName::Bspline2)
        .collect();
    let mut plan = vec![
        family(Quick, coarse, &all[..1], &[]),
        family(Pr, coarse, &all, &[]),
    ];
    plan.extend(SURE.map(|set| family(Pr, coarse, &all, set)));
    plan.push(family(Pr, coarse, &splines, CUT[0]));
    plan.push(family(Pr, coarse, &splines, CUT[2]));
    plan.push(family(Pr, coarse, &splines, CUT[5]));
    plan.extend(CUT.map(|set| family(Nightly, levels, &all, set)));
    plan.extend(SMALL.map(|set| family(Nightly, coarse, &all, set)));
    plan.push(family(Nightly, &levels[1..], &all, &[]));
    plan.extend(SURE.map(|set| family(Nightly, &levels[1..], &all, set)));
    plan
}

fn sketch() -> Sketch {
    let column = |x: f64| Shape::Body(vec![[x, 0.0], [x + 0.25, 0.0], [x + 0.25, 1.0], [x, 1.0]]);
    let weight = |x: f64| Shape::Load([x + 0.125, 0.6], [x + 0.125, 0.35]);
    Sketch {
        shapes: vec![
            column(0.0),
            weight(0.0),
            Shape::Held([0.0, 1.0], [0.25, 1.0]),
            column(0.6),
            weight(0.6),
            Shape::Held([0.5, -0.03], [0.95, -0.03]),
            Shape::length([-0.1, 0.0], [-0.1, 1.0], "1 m"),
        ],
        description: "A column of 1 m that hangs under its weight, and one that stands on a floor; rollers at the sides.",
    }
}
