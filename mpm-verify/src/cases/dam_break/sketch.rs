//! The geometry of the dam break.

use super::reference::{DEPTH, LENGTH, TANK};
use crate::sketch::{Shape, Sketch};

pub(super) fn sketch() -> Sketch {
    let shapes = vec![
        Shape::Body(vec![
            [0.0, 0.0],
            [LENGTH, 0.0],
            [LENGTH, DEPTH],
            [0.0, DEPTH],
        ]),
        Shape::Held([TANK, 0.0], [0.0, 0.0]),
        Shape::Held([0.0, 0.0], [0.0, 3.0]),
        Shape::Held([TANK, 3.0], [TANK, 0.0]),
        Shape::length([0.0, -0.5], [LENGTH, -0.5], "4 m"),
        Shape::length([0.0, -1.0], [TANK, -1.0], "6 m"),
        Shape::length([-0.5, 0.0], [-0.5, DEPTH], "2 m"),
        Shape::note([0.5 * LENGTH, 0.5 * DEPTH], "water"),
        Shape::note([LENGTH + 0.4, DEPTH + 0.2], "gate"),
    ];
    Sketch {
        shapes,
        description: "Water four metres long and two metres deep stands between the left wall of a tank and a gate; the tank is six metres long, open above, its floor and walls smooth. The gate is removed at once.",
    }
}
