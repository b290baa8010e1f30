//! What may be changed of the column.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("1e7");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.25");
parameters! { pub(super) const:
    POROSITY = "porosity", "-", "0.4", number(0.01, 0.99, false), "porosity of the undeformed column";
    CONDUCTIVITY = "conductivity", "m/s", "1e-5", number(1e-12, 1.0, false),
        "hydraulic conductivity k, of water of 9810 N/m³";
    LOAD = "load", "Pa", "10", number(1e-3, 1e6, false),
        "load q: small, so that what is finite of its strain, q/M, is below all errors";
    STEPS = "steps", "-", "40", Domain::Integer { least: 1, most: 10_000 }, "steps";
    TIME_END = "time_end", "-", "0.1", number(1e-6, 10.0, false),
        "time at the end over H²/c_v; of a single step with a first_step, that";
    FIRST_STEP = "first_step", "-", "0", number(0.0, 1e4, false),
        "c_v Δt/h² of the first step, with h the cells of the displacement; the others grow by a factor. 0: all equal";
    PROJECTION = "projection", "-", "1", number(0.01, 100.0, false), "ppp: its strength times 2G";
    TOLERANCE = "tolerance", "-", "1e-10", number(1e-13, 1e-2, false),
        "residual of a converged step over what it balances";
}

/// All of them.
pub(super) const ALL: [Parameter; 10] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    POROSITY,
    CONDUCTIVITY,
    LOAD,
    STEPS,
    TIME_END,
    FIRST_STEP,
    PROJECTION,
    TOLERANCE,
];
