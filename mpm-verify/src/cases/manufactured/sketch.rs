//! Sketch of the body with its supports.

use super::{Boundary, Known};
use crate::cases::prelude::*;
use crate::sketch::Point;

/// The body at rest, seen along the third axis; a bar is drawn with a thickness.
pub(super) fn sketch<K: Known>() -> Sketch {
    let solution = Parameters::new(&K::parameters(), &[]).and_then(|p| (K::SOLUTION)(&p));
    let Ok(solution) = solution else { return Sketch::default() };
    let [[x0, x1], [mut y0, mut y1], _] = solution.extent();
    let width = x1 - x0;
    if solution.dimension() == 1 {
        (y0, y1) = (0.0, 0.1 * width);
    }
    let [a, b, c, d]: [Point; 4] = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    // Hatched on the left, seen from the first point to the second: outside, going clockwise.
    let (held, description): (&[(Point, Point)], _) = match K::BOUNDARY {
        Boundary::Periodic => (&[], "One cell of a periodic body at rest."),
        Boundary::Slope => (&[(b, a)], "A period of the layer at rest, fixed at its foot, free above."),
        Boundary::Vessel => {
            (&[(b, a), (a, d), (c, b)], "The liquid at rest in a vessel with slippery walls, open above.")
        }
        Boundary::Walls(kind) => (
            match solution.dimension() {
                1 => &[(a, d), (c, b)],
                _ => &[(b, a), (a, d), (d, c), (c, b)],
            },
            match kind {
                WallKind::Fixed => "The body at rest; all its sides are fixed.",
                _ => "The body at rest; material slides along its sides but doesn't leave them.",
            },
        ),
    };
    let body = Sketch::of(description).body([a, b, c, d]);
    let body = held.iter().fold(body, |sketch, (from, to)| sketch.held(*from, *to));
    let beside = 0.15 * width;
    let body = body.length([x0, y0 - beside], [x1, y0 - beside], &format!("{width} m"));
    match solution.dimension() {
        1 => body,
        _ => body.length([x1 + beside, y0], [x1 + beside, y1], &format!("{} m", y1 - y0)),
    }
}
