//! A body that no water leaves: whether pressures and motions of the two grids fit together.
//!
//! Sections 3 and 4.4 of Pretti et al., doi:10.1002/nme.7630. Set-up, choices and tolerances: `docs/undrained.md`.

mod checks;
mod forms;
mod look;
mod metrics;
mod parameters;
mod tables;

use super::family::{family, levels};
use super::still::Still;
use crate::case::{Case, Family, Tier};
use crate::metric::error;
use crate::results::headline;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use look::Undrained;
use metrics::{
    CHECKERBOARD_RATIO, DISPLACEMENT_ERROR, INF_SUP, PRESSURE_ERROR, PRESSURES, ZERO_MODES,
};

use BasisName::{Bspline2, Gimp, Linear};
use SpaceName::{Equal, TwoGrid};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [(&str, f64); 3] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)];
const ELLIPSE: &[&str] = &["domain=ellipse"];
const ELLIPSE_ACROSS: &[&str] = &["domain=ellipse", "layout=across"];
const ACROSS: &[&str] = &["layout=across"];
const LINEAR_PRESSURE: &[&str] = &["pressure_functions=linear"];

pub(super) fn case() -> Case {
    let levels = levels(1.0, LEVELS);
    Case {
        name: "undrained",
        title: "Spaces of displacement and pressure where no water flows",
        description: "Chapelle and Bathe's number of each pair of spaces on three meshes: of one that is stable it has a bound, of equal \
                      order it falls with the cells. And the motion of a body that keeps its volume, against an exact one.",
        references: vec![
            "Theory: a stable pair has an inf–sup number above a bound that no mesh changes; bilinear functions of equal order have none.".to_owned(),
            "Exact motion without change of volume, and its pressure, in closed form.".to_owned(),
        ],
        limits: &[
            "Matrices of an undeformed body at small strain, of the solver's functions and ghost penalties but assembled here: no step is taken.",
            "Norms are sums over the particles, exact integrals of linear functions and GIMP on the square alone.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(INF_SUP, "β", 1.0, 4),
            headline(ZERO_MODES, "pressures without effect", 1.0, 0),
            headline(DISPLACEMENT_ERROR, "error of u (%)", 100.0, 3),
            headline(PRESSURE_ERROR, "error of p (%)", 100.0, 2),
            headline(CHECKERBOARD_RATIO, "checkerboard (%)", 100.0, 2),
            headline(PRESSURES, "pressures", 1.0, 0),
        ],
        quantities: vec![
            error(DISPLACEMENT_ERROR, "error of the displacement"),
            error(PRESSURE_ERROR, "error of the pressure"),
        ],
        sweeps: Vec::new(),
        watched: &["inf_sup"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-6 * spec.level.h.powi(-4)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| {
            Ok(Box::new(Still::new(Undrained::new(spec, parameters)?)))
        }),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let of = |bases: &[BasisName], spaces: &[SpaceName]| -> Vec<Scheme> {
        let each = bases
            .iter()
            .flat_map(|b| spaces.iter().map(|s| Scheme::poro(*b, *s)));
        each.collect()
    };
    let stable = of(&[Gimp, Linear, Bspline2], &[TwoGrid]);
    let equal = of(&[Gimp, Linear], &[Equal]);
    let splines = of(&[Bspline2], &[TwoGrid]);
    let (gimp, equal_gimp) = (&stable[..1], &equal[..1]);
    vec![
        family(Quick, &levels[..1], gimp, &[]),
        family(Pr, levels, &stable, &[]),
        family(Pr, &levels[..2], &equal, &[]),
        family(Pr, levels, gimp, ACROSS),
        family(Pr, &levels[..2], equal_gimp, ACROSS),
        family(Pr, levels, gimp, ELLIPSE_ACROSS),
        family(Pr, levels, equal_gimp, ELLIPSE_ACROSS),
        family(Pr, levels, &stable[1..2], ELLIPSE),
        family(Pr, levels, &equal[1..], ELLIPSE),
        family(Pr, levels, &splines, LINEAR_PRESSURE),
        family(Nightly, levels, &equal, &[]),
        family(Nightly, levels, equal_gimp, ACROSS),
    ]
}

fn sketch() -> Sketch {
    let arc = (0..=24).map(|k| {
        let angle = std::f64::consts::PI * f64::from(k) / 24.0;
        [1.763 + 0.437 * angle.cos(), 0.611 * angle.sin()]
    });
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let sides = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
    let mut shapes = vec![Shape::Body(square), Shape::Body(arc.collect())];
    let mut last = [0.0, 0.0];
    for next in sides {
        shapes.push(Shape::Held(last, next));
        last = next;
    }
    shapes.extend([
        Shape::Held([1.326, 0.0], [2.2, 0.0]),
        Shape::length([-0.12, 0.0], [-0.12, 1.0], "1 m"),
        Shape::note([0.5, 0.5], "square"),
        Shape::note([1.763, 0.25], "ellipse"),
    ]);
    Sketch {
        shapes,
        description: "A square of 1 m that is held all around, and half an ellipse that is held at its straight side.",
    }
}
