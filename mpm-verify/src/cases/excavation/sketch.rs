//! The geometry of the excavation.

use crate::sketch::{Shape, Sketch};

pub(super) fn sketch() -> Sketch {
    Sketch {
        shapes: vec![
            Shape::Body(vec![
                [0.0, 0.0],
                [2.3, 0.0],
                [2.3, 0.2],
                [1.5, 1.0],
                [0.0, 1.0],
            ]),
            Shape::Body(vec![[2.3, 0.0], [2.5, 0.0], [2.3, 0.2]]),
            Shape::Held([3.5, 0.0], [0.0, 0.0]),
            Shape::Held([0.0, 0.0], [0.0, 1.0]),
            Shape::length([0.0, 1.12], [1.5, 1.12], "1.5 m"),
            Shape::length([1.5, 1.12], [2.5, 1.12], "1 m"),
            Shape::length([-0.12, 0.0], [-0.12, 1.0], "1 m"),
            Shape::note([0.9, 0.5], "clay"),
            Shape::note([2.85, 0.2], "taken away"),
        ],
        description: "A slope of clay one metre high with a face at 45° and a crest of 1.5 m, up to rollers that let it \
                      move up and down. The wedge of the lowest 0.2 m at its toe is taken away.",
    }
}
