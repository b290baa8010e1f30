//! What may be changed of the body.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const CFL: Parameter = common::CFL.with_default("0.3");
pub(super) const FLIP: Parameter = common::FLIP;
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter =
    common::PPC_PER_DIRECTION.meaning("particles per cell across the motion");
pub(super) const WALL: Parameter = common::WALL;
parameters! { pub(super) const:
    STRETCH = "stretch", "-", "0.98", number(0.8, 1.2, false),
        "equal stretch in the plane that the body is under: below 1 a pressure, above a tension";
    SPEED = "speed", "-", "0.05", number(1e-3, 0.5, false), "speed of the body over that of waves";
    CELLS = "cells", "-", "100", number(1.0, 1e5, false), "cells that it crosses";
    PARTICLES = "particles", "-", "14", Domain::Integer { least: 8, most: 32 },
        "particles in the eight cells of a period along the motion";
}

/// All of them.
pub(super) const ALL: [Parameter; 10] = [
    STRETCH,
    SPEED,
    CELLS,
    PARTICLES,
    CFL,
    common::TIME_STEP,
    FLIP,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
    WALL,
];
