//! Parameters of the footing.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameter};

pub(super) use common::{CFL, FLIP, POISSON_RATIO, PPC_PER_DIRECTION, YOUNG_MODULUS};

pub(super) const DENSITY: Parameter =
    common::DENSITY.meaning("density ρ; it only matters for how slowly the footing must move");
pub(super) const UNDRAINED_STRENGTH: Parameter = parameter(
    "undrained_strength",
    "Pa",
    "100",
    number(1e-6, 1e12, false),
    "undrained shear strength s_u of plane strain: the ground yields at ‖s‖ = √2 s_u",
);
pub(super) const DOMAIN_WIDTH: Parameter = parameter(
    "domain_width",
    "B",
    "6",
    Domain::Integer { least: 2, most: 40 },
    "width of the right half of the ground, in widths of the footing",
);
pub(super) const DOMAIN_DEPTH: Parameter = parameter(
    "domain_depth",
    "B",
    "6",
    Domain::Integer { least: 1, most: 40 },
    "depth of the ground, likewise",
);
pub(super) const PENETRATION_RATE: Parameter = parameter(
    "penetration_rate",
    "m/s",
    "2e-3",
    number(1e-6, 1.0, false),
    "speed of the footing after its start",
);
pub(super) const PENETRATION: Parameter = parameter(
    "penetration",
    "B",
    "0.004",
    number(1e-4, 0.1, false),
    "penetration at the end, in widths of the footing",
);
pub(super) const RAMP: Parameter = parameter(
    "ramp",
    "s",
    "0.8",
    number(1e-6, 1e3, false),
    "time over which the footing's speed rises from zero",
);
pub(super) const DAMPING: Parameter = common::DAMPING.with_default("0.002");
pub(super) const WALL: Parameter =
    common::WALL.meaning("how B-splines meet the sides and the base");
/// A word of [`CONTACT`].
pub(super) const BARRIER: &str = "barrier";
pub(super) const CONTACT: Parameter = parameter(
    "contact",
    "-",
    "rigid-nodes",
    Domain::Choice(&["rigid-nodes", BARRIER]),
    "how the footing presses: nodes that move with it, or a barrier on particles that come near it",
);
pub(super) const ROUGH: Parameter = parameter(
    "rough",
    "-",
    "true",
    Domain::Boolean,
    "whether the ground sticks to the footing; if not, it slides freely",
);

/// All of them.
pub(super) const ALL: [Parameter; 16] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    DENSITY,
    UNDRAINED_STRENGTH,
    DOMAIN_WIDTH,
    DOMAIN_DEPTH,
    PENETRATION_RATE,
    PENETRATION,
    RAMP,
    DAMPING,
    CFL,
    FLIP,
    WALL,
    CONTACT,
    ROUGH,
    PPC_PER_DIRECTION,
];
