//! What may be changed of the bar.

use crate::cases::parameters as common;
use crate::parameter::{Parameter, number, parameters};

pub(super) const CFL: Parameter = common::CFL.with_default("0.2");
pub(super) const FLIP: Parameter = common::FLIP;
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const WALL: Parameter = common::WALL;
pub(super) const LINEAR_VISCOSITY: Parameter = common::LINEAR_VISCOSITY;

parameters! { pub(super) const:
    MACH = "mach", "-", "0.5", number(0.01, 3.0, false), "speed of the bar over that of its waves";
    QUADRATIC_VISCOSITY = "quadratic_viscosity", "-", "0", number(0.0, 10.0, false),
        "coefficient c₂ of the quadratic artificial viscosity: 2 makes a front five to ten cells wide";
}

/// All of them.
pub(super) const ALL: [Parameter; 8] = [
    MACH,
    LINEAR_VISCOSITY,
    QUADRATIC_VISCOSITY,
    CFL,
    FLIP,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
    WALL,
];

/// The coefficients of the artificial viscosity, the linear one first.
pub(super) const VISCOSITY: [Parameter; 2] = [LINEAR_VISCOSITY, QUADRATIC_VISCOSITY];
