//! A beam one, two, four cells thick: what cells and particles make of its bending.
//!
//! Set-up, choices and tolerances: `docs/thin.md`.

mod checks;
mod metrics;
mod parameters;
mod tables;
mod theory;
mod watch;

use super::family::{BASES, family, implicit, levels, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use theory::{DEPTH, HALF};
use watch::Swing;

use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = levels(DEPTH, [("t1", 1.0), ("t2", 2.0), ("t4", 4.0)]);
    Case {
        name: "thin",
        title: "A beam of few cells",
        description: "A free beam, twenty times as long as it is deep, swings in its first mode, one, two or four cells over its depth: \
                      its frequency against Timoshenko's, and against that of the stiffness that cells and particles leave.",
        references: vec![
            "Timoshenko's free beam in plane strain, first symmetric mode: solved in src/cases/thin/theory.rs.".to_owned(),
            "The bending stiffness of cells and particles, docs/thin.md.".to_owned(),
        ],
        limits: &[
            "One slenderness, small deflection, no clamp: that of cantilever is a singular place of its own.",
            "What F̄ leaves of the bending stiffness of linear functions is not foretold.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::FREQUENCY_RATIO, "frequency over exact (–)", 1.0, 4),
            headline(m::PREDICTED_RATIO, "predicted (–)", 1.0, 4),
            headline(m::STIFFNESS_RATIO, "bending stiffness over exact (–)", 1.0, 3),
            headline(m::AMPLITUDE_RATIO, "amplitude kept (–)", 1.0, 3),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["deflection"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-6 * spec.level.h.powi(-3)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Swing::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

const CONSISTENT: &[&str] = &["cfl=5", "lumped=0"];
const NEARLY: &[&str] = &["poisson_ratio=0.49"];
const FOUR: &[&str] = &["ppc_per_direction=4"];
const SHIFTED: &[&str] = &["shift=0.5"];

fn plan(levels: &[Level]) -> Vec<Family> {
    use BasisName::{Bspline2, Gimp, Linear};
    let both = [RemedyName::None, RemedyName::FbarConsistent];
    let plain = [RemedyName::None];
    let of = |rule, bases: &[BasisName]| implicit(&[rule], bases, &plain);
    let (few, all) = (
        pairs(&[Linear, Gimp, Bspline2], &both),
        pairs(&BASES, &both),
    );
    let linear = of(RuleName::Midpoint, &[Linear]);
    let splines = of(RuleName::Midpoint, &[Bspline2]);
    let two = &levels[..2];
    vec![
        family(Quick, &levels[..1], &few[2..3], &[]),
        family(Pr, two, &few, &[]),
        family(Pr, &levels[..1], &few, NEARLY),
        family(Pr, &levels[1..2], &pairs(&[Linear], &both), NEARLY),
        family(Pr, levels, &pairs(&[Bspline2], &plain), &[]),
        family(Pr, two, &linear, CONSISTENT),
        // One cell of quadratic splines, and any of cubic ones, has more functions than particles to give them a mass.
        family(Pr, &levels[1..2], &splines, CONSISTENT),
        family(Pr, two, &pairs(&[Linear, Gimp, Bspline2], &plain), SHIFTED),
        family(Nightly, levels, &all, &[]),
        family(Nightly, levels, &all, NEARLY),
        family(Nightly, two, &all, FOUR),
        family(Nightly, two, &all, SHIFTED),
        family(Nightly, levels, &linear, CONSISTENT),
        family(Nightly, &levels[1..], &splines, CONSISTENT),
        family(
            Nightly,
            levels,
            &of(RuleName::Midpoint, &[Linear, Gimp, Bspline2]),
            &["cfl=5"],
        ),
        family(
            Nightly,
            levels,
            &of(RuleName::Newmark, &[Linear, Gimp, Bspline2]),
            &["cfl=5"],
        ),
    ]
}

fn sketch() -> Sketch {
    let (end, top) = (HALF, DEPTH);
    Sketch {
        shapes: vec![
            Shape::Body(vec![[0.0, 0.0], [end, 0.0], [end, top], [0.0, top]]),
            Shape::Held([0.0, 0.0], [0.0, top]),
            Shape::Load([0.1, 0.25], [0.1, 0.15]),
            Shape::Load([0.95, 0.15], [0.95, 0.25]),
            Shape::length([0.0, -0.08], [end, -0.08], "1 m, half of it"),
            Shape::length([1.1, 0.0], [1.1, top], "0.1 m"),
        ],
        description: "Half of a beam of 2 m by 0.1 m that is free but for the symmetry in its middle.",
    }
}
