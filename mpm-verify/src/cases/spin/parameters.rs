//! What may be changed of the disc.

use crate::cases::parameters as common;
use crate::parameter::{Parameter, number, parameters};

pub(super) const CFL: Parameter = common::CFL;
pub(super) const FLIP: Parameter = common::FLIP;
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const WALL: Parameter = common::WALL;
parameters! { pub(super) const:
    TURNS = "turns", "-", "10", number(0.1, 1e4, false), "turns";
    RIM_SPEED = "rim_speed", "-", "0.1", number(1e-3, 0.3, false), "speed of the rim over that of waves";
}

/// All of them.
pub(super) const ALL: [Parameter; 8] = [
    TURNS,
    RIM_SPEED,
    CFL,
    common::TIME_STEP,
    FLIP,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
    WALL,
];
