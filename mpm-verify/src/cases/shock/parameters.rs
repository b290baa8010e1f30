//! What may be changed of the bar.

use crate::cases::parameters as common;
use crate::parameter::{Parameter, number, parameters};

pub(super) const CFL: Parameter = common::CFL.with_default("0.2");
pub(super) const FLIP: Parameter = common::FLIP;
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const WALL: Parameter = common::WALL;
parameters! { pub(super) const:
    MACH = "mach", "-", "0.5", number(0.01, 3.0, false), "speed of the bar over that of its waves";
}

/// All of them.
pub(super) const ALL: [Parameter; 6] = [MACH, CFL, FLIP, PPC_PER_DIRECTION, POISSON_RATIO, WALL];
