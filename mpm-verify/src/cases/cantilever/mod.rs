//! A cantilever under its weight: the quasi-static case of the implicit paper.
//!
//! Section 3.1 of Wang, Vardon, Hicks & Chen (2016). Set-up, choices and tolerances: `docs/cantilever.md`.

mod checks;
mod edge;
pub(super) mod foreign;
mod metrics;
mod parameters;
mod pictures;
mod reference;
mod scene;
mod sketch;
mod tables;
mod watch;

use super::family::family;
use crate::case::{Case, Family, FieldView, Tier};
use crate::metric::error;
use crate::record::Record;
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::{Level, RunSpec};
use metrics::{
    CORNER_ERROR, CORNER_UX, CORNER_UY, EDGE_MEAN_UY, LOG10_CONDITION, NEWTON_ITERATIONS,
    STRESS_ERROR, STRESS_MAX, STRESS_MIN,
};
use parameters::{LOAD_STEPS, NONE, STABILISATION};
use watch::Bending;

use BasisName::{Bspline2, Bspline3, Gimp, Linear, Q8};
use Tier::{Long, Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let sizes = [
        ("h0.1", 0.1),
        ("h0.05", 0.05),
        ("h0.025", 0.025),
        ("h0.0125", 0.0125),
    ];
    let levels = sizes.map(|(name, h)| Level { name, h });
    Case {
        name: "cantilever",
        title: "Cantilever under its weight",
        description: "An elastic beam in plane strain, clamped on the left, bends under its own weight by half its length, quasi-statically: \
                      the case by which the implicit paper shows its method. Quadratic splines with a ghost penalty converge to the \
                      finite elements; the paper's serendipity elements don't converge.",
        references: reference::describe(),
        limits: &[
            "The corners of the clamp are singular points: the greatest stresses grow without bound under refinement.",
            "Serendipity elements are the paper's, for this case alone.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(levels),
        levels: levels.to_vec(),
        metrics: metrics::all(),
        checks: checks::checks(),
        headlines: vec![
            headline(CORNER_UX, "corner u_x (m)", 1.0, 4),
            headline(CORNER_UY, "corner u_y (m)", 1.0, 4),
            headline(EDGE_MEAN_UY, "edge mean u_y (m)", 1.0, 4),
            headline(STRESS_MIN, "σ_xx from (kPa)", 1e-3, 1),
            headline(STRESS_MAX, "to (kPa)", 1e-3, 1),
            headline(NEWTON_ITERATIONS, "iterations", 1.0, 0),
            headline(LOG10_CONDITION, "log₁₀ condition", 1.0, 1),
        ],
        quantities: vec![
            error(CORNER_ERROR, "relative error of the corner's u_y"),
            error(STRESS_ERROR, "relative error of σ_xx near the clamp"),
        ],
        sweeps: Vec::new(),
        watched: &["corner_uy", "newton_iterations"],
        field: Some(FieldView {
            time: None,
            value: "stress_xx",
            label: "σ_xx at 4 kN/m³ (Pa)",
            range: (-4e4, 4e4),
            window: [(-0.05, 1.05), (-0.65, 0.35)],
        }),
        sketch: sketch::sketch(),
        cost: Box::new(cost),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Bending::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: known_breakdown,
    }
}

/// Steps times unknowns to the power of their elimination.
fn cost(spec: &RunSpec) -> f64 {
    1e-3 * spec.level.h.powi(-3)
}

fn schemes(bases: &[BasisName]) -> Vec<Scheme> {
    let of = |basis: &BasisName| Scheme::quasi_static(*basis, RemedyName::None);
    bases.iter().map(of).collect()
}

fn plan([h1, h2, h3, h4]: [Level; 4]) -> Vec<Family> {
    let splines = schemes(&[Bspline2]);
    let soft: &'static [&'static str] = &["stabilisation=soft"];
    let mut all = vec![
        family(Quick, &[h1], &splines, &[]),
        family(Pr, &[h1, h2, h3], &splines, &[]),
        family(Pr, &[h1, h2], &schemes(&[Linear, Gimp]), &[]),
        family(Pr, &[h1], &schemes(&[Q8]), soft),
        family(Pr, &[h2], &splines, &["law=neo-hookean"]),
        family(Pr, &[h2], &splines, &["law=jaumann"]),
        family(Pr, &[h1, h2], &splines, EXTENDED),
        family(Nightly, &[h3], &splines, EXTENDED),
        family(Nightly, &[h1, h2, h3], &schemes(&[Gimp]), EXTENDED),
        family(Nightly, &[h4], &splines, &[]),
        family(Nightly, &[h3, h4], &schemes(&[Linear, Gimp]), &[]),
        family(Nightly, &[h1, h2], &schemes(&[Bspline3]), &[]),
        family(Nightly, &[h2, h3], &schemes(&[Q8]), soft),
        family(Long, &[h4], &schemes(&[Q8]), soft),
        family(Long, &[h3, h4], &schemes(&[Bspline3]), &[]),
        family(
            Nightly,
            &[h1],
            &schemes(&[Linear, Gimp, Bspline2, Bspline3, Q8]),
            &["stabilisation=none"],
        ),
    ];
    let sets: [&'static [&'static str]; 22] = [
        &["load_steps=5"],
        &["load_steps=10"],
        &["load_steps=40"],
        &["load_steps=80"],
        &["load_steps=160"],
        &["law=jaumann", "load_steps=10"],
        &["law=jaumann", "load_steps=40"],
        &["law=jaumann-linear", "load_steps=10"],
        &["law=jaumann-linear", "load_steps=20"],
        &["law=jaumann-linear", "load_steps=40"],
        &["law=jaumann-linear", "load_steps=80"],
        &["points=gauss"],
        &["points_per_direction=2"],
        &["points_per_direction=3"],
        &["points_per_direction=6"],
        &["stabilisation_factor=0.1"],
        &["stabilisation_factor=0.001"],
        &["stabilisation=soft", "stabilisation_factor=0.1"],
        &["stabilisation=soft"],
        &["stabilisation=soft", "stabilisation_factor=0.001"],
        &["stabilisation=soft", "stabilisation_factor=0.0001"],
        &["law=neo-hookean", "load_steps=10"],
    ];
    all.extend(sets.map(|set| family(Nightly, &[h2], &splines, set)));
    let gimp: [&'static [&'static str]; 3] = [
        &["points_per_direction=2"],
        &["load_steps=5"],
        &["load_steps=80"],
    ];
    all.extend(gimp.map(|set| family(Nightly, &[h2], &schemes(&[Gimp]), set)));
    all.extend(STRENGTHS.map(|set| family(Nightly, &[h1, h2, h3], &schemes(&[Gimp]), set)));
    // The paper's elements, points, law and stabilisation: Figures 2 to 4.
    let papers: [&'static [&'static str]; 7] = [
        &PAPER,
        &["law=jaumann-linear", "points=gauss", "stabilisation=none"],
        &[
            "law=jaumann-linear",
            "points=gauss",
            "stabilisation=soft",
            "stabilisation_factor=0.1",
        ],
        &[
            "law=jaumann-linear",
            "points=gauss",
            "stabilisation=soft",
            "stabilisation_factor=0.001",
        ],
        &[
            "law=jaumann-linear",
            "points=gauss",
            "stabilisation=soft",
            "stabilisation_factor=0.0001",
        ],
        &[
            "law=jaumann-linear",
            "points=gauss",
            "points_per_direction=2",
            "stabilisation=soft",
        ],
        &[
            "law=jaumann-linear",
            "points=gauss",
            "points_per_direction=6",
            "stabilisation=soft",
        ],
    ];
    all.extend(papers.map(|set| family(Nightly, &[h1], &schemes(&[Q8]), set)));
    all
}

/// Ghost penalties of GIMP, beside its own.
const STRENGTHS: [&[&str]; 5] = [
    &["stabilisation_factor=0.0005"],
    &["stabilisation_factor=0.005"],
    &["stabilisation_factor=0.05"],
    &["stabilisation_factor=0.5"],
    &["stabilisation_factor=1"],
];
const EXTENDED: &[&str] = &["stabilisation=extension"];
/// The paper's choices.
const PAPER: [&str; 3] = ["law=jaumann-linear", "points=gauss", "stabilisation=soft"];

/// Without stabilisation, or with the paper's elements.
fn known_breakdown(r: &Record) -> Option<&'static str> {
    if r.parameters.is(STABILISATION, NONE) {
        return Some(
            "without stabilisation functions at the rim see fewer strains than they have unknowns",
        );
    }
    let many = r.parameters.number(LOAD_STEPS) > 20.0;
    (r.basis() == Q8 && many).then_some("particles of serendipity elements leave the body")
}
