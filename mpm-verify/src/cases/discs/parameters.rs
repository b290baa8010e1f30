//! What may be changed of the discs.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("1e5");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const FLIP: Parameter = common::FLIP;
pub(super) const WALL: Parameter = common::WALL;
pub(super) use common::{LUMPED, TOLERANCE};
parameters! { pub(super) const:
    SPEED = "speed", "m/s", "0.005", number(1e-4, 1.0, false),
        "each component of the velocities, of opposite signs; the run lasts 37.5 s at 0.005 m/s, and less in proportion";
    OFFSET = "offset", "m", "0", number(0.0, 0.8, false),
        "distance of the lines on which the discs' centres fly; beyond 0.4 the discs don't touch";
    STEP_FACTOR = "step_factor", "-", "1", Domain::Choice(&["1", "10", "100"]),
        "time step over 2.5 ms at h = 0.05 m, and in proportion to h; explicit: 1";
}

/// All of them.
pub(super) const ALL: [Parameter; 12] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    SPEED,
    OFFSET,
    STEP_FACTOR,
    FLIP,
    LUMPED,
    common::ALPHA,
    common::DELTA,
    TOLERANCE,
    PPC_PER_DIRECTION,
    WALL,
];
