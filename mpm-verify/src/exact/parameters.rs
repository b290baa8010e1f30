//! Parameters of the exact solutions.

use crate::parameter::{Domain, Parameter};

/// A number, given by name, unit and default, within a closed range.
pub(super) const fn number(
    [name, unit, default]: [&'static str; 3],
    [least, most]: [f64; 2],
    meaning: &'static str,
) -> Parameter {
    Parameter {
        name,
        unit,
        default,
        domain: Domain::Number {
            least,
            most,
            below: false,
        },
        meaning,
    }
}

/// The dimension of a motion that comes in one, two and three.
pub(crate) const DIMENSION: Parameter = Parameter {
    name: "dimension",
    unit: "-",
    default: "2",
    domain: Domain::Integer { least: 1, most: 3 },
    meaning: "dimension: 1 uniaxial strain, 2 plane strain, 3",
};

/// The angular frequency ω.
pub(crate) const ANGULAR_FREQUENCY: Parameter = number(
    ["angular_frequency", "rad/s", "1"],
    [1e-6, 1e6],
    "angular frequency ω",
);

/// Gravity g.
pub(crate) const GRAVITY: Parameter = number(
    ["gravity", "m/s²", "9.81"],
    [0.0, 1e4],
    "acceleration of gravity g, downwards",
);

pub(crate) const YOUNG_MODULUS: Parameter = number(
    ["young_modulus", "Pa", "1e6"],
    [1e-3, 1e12],
    "Young's modulus E",
);
pub(crate) const POISSON_RATIO: Parameter = Parameter {
    name: "poisson_ratio",
    unit: "-",
    default: "0.49",
    domain: Domain::Number {
        least: 0.0,
        most: 0.5,
        below: true,
    },
    meaning: "Poisson's ratio ν",
};
pub(crate) const DENSITY: Parameter = number(
    ["density", "kg/m³", "1000"],
    [1e-6, 1e6],
    "density ρ₀ in the reference configuration",
);
pub(crate) const AMPLITUDE: Parameter =
    number(["amplitude", "m", "0.05"], [0.0, 1.0], "amplitude A");
