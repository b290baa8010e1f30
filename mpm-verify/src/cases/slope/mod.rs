//! The slope of clay that `landslide` and `slope-stability` share: parameters, section, ground and sketch.

pub(super) mod ground;
pub(super) mod section;

use crate::cases::prelude::*;
use section::Section;

/// Standard, the paper's, ours.
pub(super) const REMEDIES: [RemedyName; 3] = [RemedyName::None, FbarRecursive, FbarConsistent];
pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("25e6").within(number(1e3, 1e12, false));
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.499");
pub(super) const DENSITY: Parameter = common::DENSITY.with_default("2150").within(number(100.0, 1e4, false));
parameters! { pub(super) const:
    HEIGHT = "height", "m", "5", number(1.0, 100.0, false), "height H";
    CREST = "crest", "m", "10", number(0.5, 200.0, false), "length of the crest behind the face";
    FACE_ANGLE = "face_angle", "°", "45", number(5.0, 90.0, false), "angle of the face against the horizontal";
    FLOOR = "floor", "m", "30", number(1.0, 500.0, false), "length of the fixed floor before the toe";
}
pub(super) const CFL: Parameter = common::CFL
    .with_default("0.35")
    .meaning("largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.01 s, 5·10⁻⁵ s at h = 0.2 m");
pub(super) const WALL: Parameter = common::WALL.meaning("how B-splines meet floor and walls");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION.within(Domain::Integer { least: 2, most: 8 });

/// The section, with its height (and width) as labelled.
pub(super) fn sketch(height: &str) -> Sketch {
    let section = Section { height: 5.0, crest: 10.0, run: 5.0 };
    Sketch::of("A slope of clay five metres high with a face at 45°; its crest is ten metres long, up to a smooth wall. The floor is fixed and runs on thirty metres past the toe.")
        .body(section.corners())
        .held_along(&[[24.0, 0.0], [0.0, 0.0], [0.0, 5.0]])
        .length([0.0, 5.7], [10.0, 5.7], "10 m")
        .length([10.0, 5.7], [15.0, 5.7], "5 m")
        .length([-0.7, 0.0], [-0.7, 5.0], height)
        .note([5.0, 2.5], "clay")
        .note([19.0, 0.8], "fixed floor")
}
