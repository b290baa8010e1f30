//! What may be changed of the motion.

use crate::cases::parameters as common;
use crate::exact::common as of_solutions;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("1e5");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.25");
pub(super) const DIMENSION: Parameter = Parameter {
    domain: Domain::Integer { least: 1, most: 2 },
    ..of_solutions::DIMENSION.meaning("dimension: 1 uniaxial strain, 2 plane strain")
};
pub(super) const GRAVITY: Parameter = of_solutions::GRAVITY;
pub(super) const AMPLITUDE: Parameter = of_solutions::AMPLITUDE
    .with_default("0.005")
    .meaning("amplitude A of u: particles cross cells where it exceeds h/4; F needs A < 0.07 m to keep its pores open");
pub(super) const ANGULAR_FREQUENCY: Parameter = of_solutions::ANGULAR_FREQUENCY
    .with_default("0.015707963267948967")
    .meaning("angular frequency ω: the default duration is a quarter of a period");
/// Words of [`CONDUCTIVITY_LAW`] and [`SOURCE`].
pub(super) const CONSTANT: &str = "constant";
pub(super) const RATES: &str = "rates";
pub(super) const ZERO: &str = "zero";
parameters! { pub(super) const:
    POROSITY = "porosity", "-", "0.4", number(0.05, 0.95, false), "porosity of the undeformed body";
    CONDUCTIVITY = "conductivity", "m/s", "1e-4", number(1e-12, 1.0, false),
        "hydraulic conductivity k of the undeformed body, of water of 9810 N/m³";
    CONDUCTIVITY_LAW = "conductivity_law", "-", "kozeny-carman", Domain::Choice(&["kozeny-carman", CONSTANT]),
        "how it depends on the porosity";
    PRESSURE = "pressure", "Pa", "1e4", number(0.0, 1e6, false),
        "amplitude P of the pressure beside that of the water's weight";
    DURATION = "duration", "s", "100", number(1e-3, 1e6, false), "time to run";
    STEPS = "steps", "-", "4", Domain::Integer { least: 1, most: 10_000 }, "equal steps";
    SOURCE = "source", "-", "steps", Domain::Choice(&["steps", RATES]),
        "steps: the water that backward Euler needs to be exact, so that only the error of space is left; rates: that of the rates at a step's end";
    PREDICTOR = "predictor", "-", "particles", Domain::Choice(&["particles", ZERO]),
        "where Newton's method begins to look for pressures: at the volume average of the particles', or at zero";
    PROJECTION = "projection", "-", "1", number(0.01, 100.0, false), "ppp: its strength times 2G";
    TOLERANCE = "tolerance", "-", "1e-10", number(1e-13, 1e-2, false),
        "residual of a converged step over what it balances";
}
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;

/// All of them.
pub(super) const ALL: [Parameter; 17] = [
    DIMENSION,
    YOUNG_MODULUS,
    POISSON_RATIO,
    POROSITY,
    CONDUCTIVITY,
    CONDUCTIVITY_LAW,
    GRAVITY,
    AMPLITUDE,
    PRESSURE,
    ANGULAR_FREQUENCY,
    DURATION,
    STEPS,
    SOURCE,
    PPC_PER_DIRECTION,
    PREDICTOR,
    PROJECTION,
    TOLERANCE,
];
