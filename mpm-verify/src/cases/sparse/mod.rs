//! A vortex in a box on few particles without order: what an error is worth that is a matter of luck.
//!
//! Set-up, choices and tolerances: `docs/sparse.md`.

mod checks;
mod look;
mod metrics;
mod parameters;
mod tables;

use super::family::{family, implicit, levels, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use look::Clouds;
use metrics as m;

use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)]);
    Case {
        name: "sparse",
        title: "Few particles without order",
        description: "A small turn in a box, whose exact solution is known, on twenty clouds each of one to sixteen particles a cell: \
                      where particles lie anywhere, smaller cells hardly help; where one lies in each part of a cell, more particles do.",
        references: vec![
            "Exact: the vortex of mms-vortex-box, turned by a hundredth of a radian.".to_owned(),
            "The error of random points and what it does to a stiffness, docs/sparse.md."
                .to_owned(),
        ],
        limits: &[
            "Particles of equal volume, which stay where they are: no cloud here is of a motion's own making.",
            "The motion ends within the box: half-empty cells at a free face are in thin.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::ERROR_MEDIAN, "error of u, median (%)", 100.0, 2),
            headline(m::ERROR_HIGH, "nine in ten below (%)", 100.0, 2),
            headline(m::STRESS_MEDIAN, "error of σ (%)", 100.0, 1),
            headline(m::SOFTENING, "softening (%)", 100.0, 2),
            headline(m::BROKEN, "break down (%)", 100.0, 0),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["displacement_error"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-3 * spec.level.h.powi(-2)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(super::analysis::begin::<Clouds>),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

const LATTICE: [&[&str]; 2] = [
    &["layout=lattice", "ppc_per_direction=2"],
    &["layout=lattice", "ppc_per_direction=3"],
];
const RANDOM: [&[&str]; 2] = [&["ppc_per_direction=2"], &["ppc_per_direction=3"]];
const BETTER: [&[&str]; 4] = [
    &["layout=jittered", "ppc_per_direction=2"],
    &["layout=jittered", "ppc_per_direction=3"],
    &["layout=holes", "ppc_per_direction=2"],
    &["layout=holes", "ppc_per_direction=3"],
];
const SCATTERED: &[&str] = &["layout=scattered", "ppc_per_direction=2"];
const SIXTEEN: [&[&str]; 4] = [
    &["layout=lattice", "ppc_per_direction=4"],
    &["ppc_per_direction=4"],
    &["layout=jittered", "ppc_per_direction=4"],
    &["layout=holes", "ppc_per_direction=4"],
];

fn plan(levels: &[Level]) -> Vec<Family> {
    use BasisName::{Bspline2, Bspline3, Gimp, Linear};
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    let of = |bases: &[BasisName]| implicit(&[RuleName::QuasiStatic], bases, &remedies);
    let all = of(&[Linear, Gimp, Bspline2, Bspline3]);
    let few = of(&[Linear, Gimp, Bspline2]);
    let splines = implicit(&[RuleName::QuasiStatic], &[Bspline2], &remedies[..1]);
    let moving = pairs(&[Linear, Gimp, Bspline2], &remedies);
    let [coarse, middle] = [&levels[..1], &levels[1..2]];
    let mut plan = vec![
        family(Quick, coarse, &splines, RANDOM[0]),
        family(Pr, coarse, &few, &[]),
        family(Pr, coarse, &few, RANDOM[0]),
        family(Pr, levels, &splines, LATTICE[0]),
        family(Pr, levels, &splines, RANDOM[0]),
        family(Pr, middle, &splines, LATTICE[1]),
        family(Pr, middle, &splines, RANDOM[1]),
        family(Nightly, &levels[..2], &few, &[]),
        family(Nightly, coarse, &all, &[]),
        family(Nightly, levels, &all, RANDOM[0]),
        family(Nightly, levels, &all, LATTICE[0]),
        family(Nightly, middle, &moving, &[]),
        family(Nightly, levels, &moving, RANDOM[0]),
        family(Nightly, levels, &moving, LATTICE[0]),
        family(Nightly, levels, &splines, SCATTERED),
    ];
    plan.extend(BETTER.map(|set| family(Pr, middle, &splines, set)));
    for sets in [LATTICE, RANDOM] {
        plan.extend(sets.map(|set| family(Nightly, &levels[1..], &splines, set)));
    }
    plan.extend(BETTER.map(|set| family(Nightly, &levels[1..], &splines, set)));
    plan.extend(SIXTEEN.map(|set| family(Nightly, &levels[1..], &splines, set)));
    plan
}

fn sketch() -> Sketch {
    let sides = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
    let mut shapes = vec![Shape::Body(vec![
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ])];
    let mut last = [0.0, 0.0];
    for next in sides {
        shapes.push(Shape::Held(last, next));
        last = next;
    }
    shapes.extend([
        Shape::Load([0.75, 0.4], [0.75, 0.6]),
        Shape::Load([0.25, 0.6], [0.25, 0.4]),
        Shape::length([-0.12, 0.0], [-0.12, 1.0], "1 m"),
    ]);
    Sketch {
        shapes,
        description: "A square of 1 m between slippery walls, whose middle turns.",
    }
}
