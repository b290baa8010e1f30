//! Parameters of the footing.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) use common::{CFL, FLIP, POISSON_RATIO, PPC_PER_DIRECTION, YOUNG_MODULUS};

pub(super) const DENSITY: Parameter =
    common::DENSITY.meaning("density ρ; it only matters for how slowly the footing must move");
parameters! { pub(super) const:
    UNDRAINED_STRENGTH = "undrained_strength", "Pa", "100", number(1e-6, 1e12, false),
        "undrained shear strength s_u of plane strain: the ground yields at ‖s‖ = √2 s_u";
    DOMAIN_WIDTH = "domain_width", "B", "6", Domain::Integer { least: 2, most: 40 },
        "width of the right half of the ground, in widths of the footing";
    DOMAIN_DEPTH = "domain_depth", "B", "6", Domain::Integer { least: 1, most: 40 },
        "depth of the ground, likewise";
    PENETRATION_RATE = "penetration_rate", "m/s", "2e-3", number(1e-6, 1.0, false),
        "speed of the footing after its start";
    PENETRATION = "penetration", "B", "0.004", number(1e-4, 0.1, false),
        "penetration at the end, in widths of the footing";
    RAMP = "ramp", "s", "0.8", number(1e-6, 1e3, false),
        "time over which the footing's speed rises from zero";
    CONTACT = "contact", "-", "rigid-nodes", Domain::Choice(&["rigid-nodes", BARRIER]),
        "how the footing presses: nodes that move with it, or a barrier on particles that come near it";
    ROUGH = "rough", "-", "true", Domain::Boolean,
        "whether the ground sticks to the footing; if not, it slides freely";
}
/// What only an explicit run has.
pub(super) const OF_EXPLICIT: [&str; 7] = [
    DENSITY.name,
    PENETRATION_RATE.name,
    RAMP.name,
    DAMPING.name,
    CFL.name,
    FLIP.name,
    WALL.name,
];
/// What only a quasi-static run has.
pub(super) const OF_QUASI_STATIC: [&str; 2] = [LOAD_STEPS.name, TOLERANCE.name];
pub(super) const LOAD_STEPS: Parameter = common::LOAD_STEPS.with_default("16").meaning(
    "quasi-static: equal steps of the penetration; one that finds no equilibrium is halved",
);
pub(super) const TOLERANCE: Parameter = common::TOLERANCE.with_default("1e-8");
pub(super) const DAMPING: Parameter = common::DAMPING.with_default("0.002");
pub(super) const WALL: Parameter =
    common::WALL.meaning("how B-splines meet the sides and the base");
/// A word of [`CONTACT`].
pub(super) const BARRIER: &str = "barrier";

/// All of them.
pub(super) const ALL: [Parameter; 18] = [
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
    LOAD_STEPS,
    TOLERANCE,
];
