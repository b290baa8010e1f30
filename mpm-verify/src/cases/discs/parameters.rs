//! What may be changed of the discs.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("1e5");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const WALL: Parameter = common::WALL;
parameters! { pub(super) const:
    SPEED = "speed", "m/s", "0.005", number(1e-4, 1.0, false),
        "each component of the velocities, of opposite signs; the run lasts 37.5 s at 0.005 m/s, and less in proportion";
    OFFSET = "offset", "m", "0", number(0.0, 0.2, false),
        "shift of the upper disc across the line of motion";
    STEP_FACTOR = "step_factor", "-", "1", Domain::Choice(&["1", "10", "100"]),
        "time step over 2.5 ms at h = 0.05 m, and in proportion to h; explicit: 1";
    LUMPED = "lumped", "-", "0.1", number(0.0, 1.0, false),
        "midpoint: share β of the lumped mass, the rest is consistent";
    ALPHA = "alpha", "-", "0.25", number(0.0, 2.0, false),
        "newmark: α, at least (δ + ½)²/4";
    DELTA = "delta", "-", "0.5", number(0.0, 2.0, false),
        "newmark: δ, at least ½";
    TOLERANCE = "tolerance", "-", "1e-10", number(1e-13, 1e-2, false),
        "implicit: residual of a converged step over the loads";
}

/// All of them.
pub(super) const ALL: [Parameter; 11] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    SPEED,
    OFFSET,
    STEP_FACTOR,
    LUMPED,
    ALPHA,
    DELTA,
    TOLERANCE,
    PPC_PER_DIRECTION,
    WALL,
];
