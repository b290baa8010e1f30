//! What may be changed of the body.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const CFL: Parameter = common::CFL
    .with_default("0.1")
    .meaning("CFL number c Δt / h of pressure waves in the undeformed body");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
parameters! { pub(super) const:
    END = "end", "-", "8", number(0.02, 20.0, false),
        "stretch of each axis at the end: above 1 the body is pulled, below it is crushed";
    DIMENSION = "dimension", "-", "1", Domain::Integer { least: 1, most: 2 },
        "1: uniaxial strain; 2: plane strain, alike along both axes";
    SPEED = "speed", "-", "0.02", number(1e-3, 0.2, false),
        "speed of the ends of the free part at the start over that of waves in the undeformed body";
    ROWS = "rows", "-", "140", Domain::Integer { least: 10, most: 10_000 },
        "rows of the series; quasi-static: equal load steps";
}

/// All of them.
pub(super) const ALL: [Parameter; 7] = [
    END,
    DIMENSION,
    SPEED,
    ROWS,
    CFL,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
];
