//! The geometry of the dam break.

use super::reference::{DEPTH, LENGTH, TANK};
use crate::sketch::{Shape, Sketch};

pub(super) fn sketch() -> Sketch {
    let length = |from, to, label: &str| Shape::Length {
        from,
        to,
        label: label.to_owned(),
    };
    let note = |at, text: &str| Shape::Note {
        at,
        text: text.to_owned(),
    };
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
        length([0.0, -0.5], [LENGTH, -0.5], "4 m"),
        length([0.0, -1.0], [TANK, -1.0], "6 m"),
        length([-0.5, 0.0], [-0.5, DEPTH], "2 m"),
        note([0.5 * LENGTH, 0.5 * DEPTH], "water"),
        note([LENGTH + 0.4, DEPTH + 0.2], "gate"),
    ];
    Sketch {
        shapes,
        description: "Water four metres long and two metres deep stands between the left wall of a tank and a gate; the tank is six metres long, open above, its floor and walls smooth. The gate is removed at once.",
    }
}
