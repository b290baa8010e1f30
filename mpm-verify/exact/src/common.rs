//! Parameters of the exact solutions.

use crate::parameter::{Domain, number, parameters};

/// Share of an unseen strain (one that Π filters out) kept by `fbar-consistent`: ε of `docs/remedy.md`, whose square is
/// the share of the bulk modulus that resists it.
pub const UNSEEN: f64 = 0.01;

parameters! { pub const:
    DIMENSION = "dimension", "-", "2", Domain::Integer { least: 1, most: 3 },
        "dimension: 1 uniaxial strain, 2 plane strain, 3";
    ANGULAR_FREQUENCY = "angular_frequency", "rad/s", "1", number(1e-6, 1e6, false), "angular frequency ω";
    GRAVITY = "gravity", "m/s²", "9.81", number(0.0, 1e4, false), "acceleration of gravity g, downwards";
    YOUNG_MODULUS = "young_modulus", "Pa", "1e6", number(1e-3, 1e12, false), "Young's modulus E";
    POISSON_RATIO = "poisson_ratio", "-", "0.49", number(0.0, 0.5, true), "Poisson's ratio ν";
    DENSITY = "density", "kg/m³", "1000", number(1e-6, 1e6, false),
        "density ρ₀ in the reference configuration";
    AMPLITUDE = "amplitude", "m", "0.05", number(0.0, 1.0, false), "amplitude A";
}
