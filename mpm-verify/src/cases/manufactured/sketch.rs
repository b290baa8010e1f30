//! The body and what holds it, drawn.

use super::{Boundary, Manufactured};
use crate::parameter::{Parameter, Parameters};
use crate::sketch::{Point, Shape, Sketch};

/// The body at rest, seen along the third axis; a bar is drawn with a thickness.
pub(super) fn sketch(case: &Manufactured, known: &[Parameter]) -> Sketch {
    let solution = Parameters::new(known, &[]).and_then(|p| (case.solution)(&p));
    let Ok(solution) = solution else {
        return Sketch::default();
    };
    let [[x0, x1], [mut y0, mut y1], _] = solution.extent();
    let width = x1 - x0;
    if solution.dimension() == 1 {
        (y0, y1) = (0.0, 0.1 * width);
    }
    let [a, b, c, d]: [Point; 4] = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    let mut shapes = vec![Shape::Body(vec![a, b, c, d])];
    // Hatched on the left, seen from the first point to the second: outside, going clockwise.
    let held: &[(Point, Point)] = match (case.boundary, solution.dimension()) {
        (Boundary::Periodic, _) => &[],
        (Boundary::Walls(_), 1) => &[(a, d), (c, b)],
        (Boundary::Walls(_), _) => &[(b, a), (a, d), (d, c), (c, b)],
        (Boundary::Slope, _) => &[(b, a)],
        (Boundary::Vessel, _) => &[(b, a), (a, d), (c, b)],
    };
    shapes.extend(held.iter().map(|(from, to)| Shape::Held(*from, *to)));
    let beside = 0.15 * width;
    let mut length = |from: Point, to: Point, metres: f64| {
        shapes.push(Shape::Length {
            from,
            to,
            label: format!("{metres} m"),
        });
    };
    length([x0, y0 - beside], [x1, y0 - beside], width);
    if solution.dimension() > 1 {
        length([x1 + beside, y0], [x1 + beside, y1], y1 - y0);
    }
    Sketch {
        shapes,
        description: match case.boundary {
            Boundary::Walls(mpm_core::stage::WallKind::Fixed) => {
                "The body at rest; all its sides are fixed."
            }
            Boundary::Walls(_) => {
                "The body at rest; material slides along its sides but doesn't leave them."
            }
            Boundary::Periodic => "One cell of a periodic body at rest.",
            Boundary::Slope => "A period of the layer at rest, fixed at its foot, free above.",
            Boundary::Vessel => "The liquid at rest in a vessel with slippery walls, open above.",
        },
    }
}
