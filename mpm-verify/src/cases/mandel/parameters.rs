//! What may be changed of the slab.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("1e7");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.25");
parameters! { pub(super) const:
    POROSITY = "porosity", "-", "0.4", number(0.01, 0.99, false), "porosity of the undeformed slab";
    CONDUCTIVITY = "conductivity", "m/s", "1e-5", number(1e-12, 1.0, false),
        "hydraulic conductivity k, of water of 9810 N/m³";
    LOAD = "load", "N/m", "10", number(1e-3, 1e6, false),
        "force F on half a plate: small, so that what is finite of the strain, F/(G a), is below all errors";
    STEPS = "steps", "-", "240", Domain::Integer { least: 30, most: 100_000 }, "equal steps to T = 0.3";
    PROJECTION = "projection", "-", "1", number(0.01, 100.0, false), "ppp: its strength times 2G";
    TOLERANCE = "tolerance", "-", "1e-10", number(1e-13, 1e-2, false),
        "residual of a converged step over what it balances";
}

/// All of them.
pub(super) const ALL: [Parameter; 8] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    POROSITY,
    CONDUCTIVITY,
    LOAD,
    STEPS,
    PROJECTION,
    TOLERANCE,
];
