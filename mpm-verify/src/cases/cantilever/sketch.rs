//! The geometry of the cantilever, drawn.

use super::scene::{DEPTH, LENGTH};
use crate::sketch::{Shape, Sketch};

/// The beam as it is drawn.
pub(super) fn sketch() -> Sketch {
    let mut shapes = vec![
        Shape::Body(vec![
            [0.0, 0.0],
            [LENGTH, 0.0],
            [LENGTH, DEPTH],
            [0.0, DEPTH],
        ]),
        Shape::Held([0.0, 0.0], [0.0, DEPTH]),
        Shape::length([0.0, -0.1], [LENGTH, -0.1], "1 m"),
        Shape::length([1.12, 0.0], [1.12, DEPTH], "0.3 m"),
        Shape::note([0.5, 0.24], "4 kN/m³"),
        Shape::Probe {
            at: [LENGTH, 0.0],
            label: "corner".to_owned(),
        },
    ];
    for k in 0..4 {
        let x = 0.2 + 0.2 * f64::from(k);
        shapes.push(Shape::Load([x, 0.19], [x, 0.07]));
    }
    Sketch {
        shapes,
        description: "A beam 1 m long and 0.3 m deep, clamped on its left side, under its own weight.",
    }
}
