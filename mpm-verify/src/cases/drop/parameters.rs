//! What may be changed of the block.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const CFL: Parameter = common::CFL.with_default("0.2").meaning(
    "CFL number c Δt / h of pressure waves, explicit; times step_factor of implicit steps",
);
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) use common::{LUMPED, TOLERANCE};
parameters! { pub(super) const:
    SPEED = "speed", "-", "0.02", number(1e-4, 0.3, false),
        "speed at which the block falls, over that of waves";
    SLANT = "slant", "-", "1", number(-10.0, 10.0, false), "speed along the floor over that";
    FRICTION = "friction", "-", "0.3", number(0.0, 10.0, false), "coefficient of friction";
    STIFFNESS = "stiffness", "-", "1", number(1e-3, 1e4, false),
        "stiffness of the barrier over that which carries the stress of the impact, ρ c v, at half of its distance";
    STEP_FACTOR = "step_factor", "-", "1", Domain::Choice(&["1", "10", "30"]),
        "implicit: time step over that of the CFL number; explicit: 1";
}

/// All of them.
pub(super) const ALL: [Parameter; 12] = [
    SPEED,
    SLANT,
    FRICTION,
    STIFFNESS,
    CFL,
    STEP_FACTOR,
    LUMPED,
    common::ALPHA,
    common::DELTA,
    TOLERANCE,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
];
