//! The geometry of the strip footing.

use super::geometry::WIDTH;
use crate::sketch::{Shape, Sketch};

/// Width and depth of the ground in widths of the footing.
const EXTENT: f64 = 6.0;

pub(super) fn sketch() -> Sketch {
    let extent = EXTENT * WIDTH;
    let half = 0.5 * WIDTH;
    let shapes = vec![
        Shape::Body(vec![
            [0.0, -extent],
            [extent, -extent],
            [extent, 0.0],
            [0.0, 0.0],
        ]),
        Shape::Body(vec![[0.0, 0.0], [half, 0.0], [half, 0.25], [0.0, 0.25]]),
        Shape::Held([extent, -extent], [0.0, -extent]),
        Shape::Load([0.25 * WIDTH, 1.0], [0.25 * WIDTH, 0.3]),
        Shape::length([0.0, -extent - 0.7], [extent, -extent - 0.7], "6B"),
        Shape::length([extent + 0.5, -extent], [extent + 0.5, 0.0], "6B"),
        Shape::note([1.6 * WIDTH, 0.45], "footing, B/2 = 0.5 m"),
        Shape::note([-0.6, -0.5 * extent], "symmetry"),
        Shape::note([extent - 0.6, -0.5 * extent], "roller"),
    ];
    Sketch {
        shapes,
        description: "A square of ground six footing widths wide and deep, its base fixed, its sides on rollers, the left one the axis of symmetry; a rigid footing half a metre wide presses on the upper left corner.",
    }
}
