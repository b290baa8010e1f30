//! The geometry of the landslide.

use super::section::Section;
use crate::sketch::{Shape, Sketch};

/// The section, with its height (and width) as labelled.
pub(crate) fn sketch(height: &str) -> Sketch {
    let section = Section {
        height: 5.0,
        crest: 10.0,
        run: 5.0,
    };
    let shapes = vec![
        Shape::Body(section.corners().to_vec()),
        Shape::Held([24.0, 0.0], [0.0, 0.0]),
        Shape::Held([0.0, 0.0], [0.0, 5.0]),
        Shape::length([0.0, 5.7], [10.0, 5.7], "10 m"),
        Shape::length([10.0, 5.7], [15.0, 5.7], "5 m"),
        Shape::length([-0.7, 0.0], [-0.7, 5.0], height),
        Shape::note([5.0, 2.5], "clay"),
        Shape::note([19.0, 0.8], "fixed floor"),
    ];
    Sketch {
        shapes,
        description: "A slope of clay five metres high with a face at 45°; its crest is ten metres long, up to a smooth wall. The floor is fixed and runs on thirty metres past the toe.",
    }
}
