//! Parameters of Cook's membrane.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) use common::{DAMPING, FLIP, PPC_PER_DIRECTION};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("70");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.499");
pub(super) const DENSITY: Parameter =
    common::DENSITY.with_default("1").meaning("density ρ; the state of rest does not depend on it");
parameters! { pub(super) const:
    LOAD = "load", "N/m", "1", number(1e-12, 1e12, false),
        "total upward dead load on the right side, per metre of depth";
    LOAD_RAMP = "load_ramp", "periods", "0.08", number(0.0, 10.0, false),
        "time over which the load grows, in fundamental periods";
    LOAD_AT = "load_at", "-", COLUMN, Domain::Choice(&[COLUMN, "edge"]),
        "column: the last column of particles carries the load, at x = 48 m − h/4 for two particles per direction; edge: the last two columns carry 3/2 and −1/2 of it, whose resultant then acts on x = 48 m";
    KINETIC_DAMPING = "kinetic_damping", "-", "true", Domain::Boolean,
        "zero the velocities at every peak of the kinetic energy";
    MAX_PERIODS = "max_periods", "periods", "2", number(1e-3, 1e3, false),
        "longest time to run, in fundamental periods of 60 s (at the default E and ρ); a run that creeps after one is stopped there";
    REST_WINDOW = "rest_window", "periods", "0.05", number(1e-3, 10.0, false),
        "time over which the criterion of rest must hold";
    GHOST = "ghost", "-", "1e-8", number(0.0, 1.0, false),
        "quasi-static: ghost penalty, in shares of Young's modulus; the root of rounding, which only keeps the matrix regular; 0: none";
}
/// What only an explicit run has.
pub(super) const OF_EXPLICIT: [&str; 8] = [
    LOAD_RAMP.name,
    DAMPING.name,
    KINETIC_DAMPING.name,
    CFL.name,
    FLIP.name,
    WALL.name,
    MAX_PERIODS.name,
    REST_WINDOW.name,
];
/// What only a quasi-static run has.
pub(super) const OF_QUASI_STATIC: [&str; 2] = [LOAD_STEPS.name, GHOST.name];
/// A word of [`LOAD_AT`].
pub(super) const COLUMN: &str = "column";
pub(super) const LOAD_STEPS: Parameter = common::LOAD_STEPS.meaning(
    "quasi-static: steps of the load, which rises smoothly over them; one that finds no equilibrium is halved",
);
pub(super) const CFL: Parameter = common::CFL.with_default("0.3");
pub(super) const WALL: Parameter = common::WALL.meaning("how B-splines meet the clamped side");

/// All of them.
pub(super) const ALL: [Parameter; 16] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    DENSITY,
    LOAD,
    LOAD_RAMP,
    LOAD_AT,
    DAMPING,
    KINETIC_DAMPING,
    CFL,
    FLIP,
    WALL,
    MAX_PERIODS,
    REST_WINDOW,
    PPC_PER_DIRECTION,
    LOAD_STEPS,
    GHOST,
];
