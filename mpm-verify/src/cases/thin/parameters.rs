//! What may be changed of the beam.

use crate::cases::parameters as common;
use crate::parameter::{Parameter, number, parameters};

pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const CFL: Parameter = Parameter {
    domain: number(1e-3, 100.0, false),
    ..common::CFL
        .with_default("0.3")
        .meaning("CFL number c Δt / h of pressure waves; explicit: below 1")
};
parameters! { pub(super) const:
    SHIFT = "shift", "h", "0", number(0.0, 1.0, true),
        "how far the faces of the beam lie above the nearest grid lines, in cells";
}

/// All of them.
pub(super) const ALL: [Parameter; 8] = [
    SHIFT,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
    CFL,
    common::DYNAMIC[0],
    common::DYNAMIC[1],
    common::DYNAMIC[2],
    common::DYNAMIC[3],
];
