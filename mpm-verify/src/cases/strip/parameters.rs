//! What may be changed of the strip.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

/// A word of [`LAW`].
pub(super) const CAM_CLAY: &str = "cam-clay";
/// A word of [`CONTROL`].
pub(super) const SETTLEMENT: &str = "settlement";

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS
    .with_default("1e6")
    .meaning("Young's modulus of the soil at rest");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO
    .with_default("0.25")
    .meaning("Poisson's ratio of the soil at rest");
parameters! { pub(super) const:
    LAW = "law", "-", "elastic", Domain::Choice(&["elastic", CAM_CLAY]),
        "improved Hencky, or modified Cam clay with that elasticity";
    DIMENSION = "dimension", "-", "2", Domain::Integer { least: 2, most: 3 },
        "2: a strip, in plane strain; 3: a square whose half side is half_width, on a cube of elastic soil";
    POROSITY = "porosity", "-", "0.4", number(0.01, 0.99, false), "porosity of the undeformed soil";
    CONDUCTIVITY = "conductivity", "m/s", "1e-6", number(1e-18, 1.0, false),
        "hydraulic conductivity k of the undeformed soil, of water of 9810 N/m³, after Kozeny and Carman";
    LOAD = "load", "Pa", "4e5", number(1.0, 1e8, false), "load q on the strip at the end";
    HALF_WIDTH = "half_width", "m", "1", number(0.5, 5.0, false), "half the width of the strip; 5 m is the whole surface";
    DURATION = "duration", "s", "2000", number(1e-6, 1e12, false), "time in which the load, or the settlement, grows linearly";
    STEPS = "steps", "-", "20", Domain::Integer { least: 1, most: 10_000 }, "equal steps";
    CONTROL = "control", "-", "load", Domain::Choice(&["load", SETTLEMENT]),
        "what is given: a load on the flexible strip, or the settlement of a rigid smooth one";
    PENETRATION = "penetration", "m", "0.01", number(1e-9, 0.1, false), "settlement at which a limit load is told; of control=settlement that at the end";
    DRAIN = "drain", "-", "1e4", number(1.0, 1e6, false), "what the drained surface lets through for its pressure, over κ₀/h";
    GHOST_DISPLACEMENT = "ghost_displacement", "-", "0.1", number(0.0, 10.0, false), "ghost penalty of the displacement over G";
    GHOST_PRESSURE = "ghost_pressure", "-", "0.01", number(0.0, 10.0, false), "ghost penalty of the pressure over κ₀ Δt";
    PROJECTION = "projection", "-", "1", number(0.01, 100.0, false), "ppp: its strength times 2G";
    INITIAL_PRESSURE = "initial_pressure", "Pa", "2e4", number(0.0, 1e7, false),
        "cam-clay: isotropic effective pressure at the start, which a load on the whole surface balances";
    PRECONSOLIDATION = "preconsolidation", "Pa", "4e4", number(0.0, 1e8, false), "cam-clay: preconsolidation p_c at the start";
    CRITICAL_RATIO = "critical_ratio", "-", "1", number(0.0, 3.0, false), "cam-clay: q/p of the critical state";
    COMPRESSIBILITY = "plastic_compressibility", "-", "0.05", number(0.0, 1.0, false), "cam-clay: λ − κ";
    ALPHA = "shape_alpha", "-", "1", number(0.0, 1.0, false), "cam-clay: α of Collins and Hilder, 1 the ellipse";
    GAMMA = "shape_gamma", "-", "1", number(0.0, 1.0, false), "cam-clay: γ of Collins and Hilder, 1 the ellipse";
    TOLERANCE = "tolerance", "-", "1e-9", number(1e-13, 1e-2, false), "residual of a converged step over what it balances";
}

/// All of them.
pub(super) const ALL: [Parameter; 23] = [
    LAW,
    DIMENSION,
    YOUNG_MODULUS,
    POISSON_RATIO,
    POROSITY,
    CONDUCTIVITY,
    LOAD,
    HALF_WIDTH,
    DURATION,
    STEPS,
    CONTROL,
    PENETRATION,
    DRAIN,
    GHOST_DISPLACEMENT,
    GHOST_PRESSURE,
    PROJECTION,
    INITIAL_PRESSURE,
    PRECONSOLIDATION,
    CRITICAL_RATIO,
    COMPRESSIBILITY,
    ALPHA,
    GAMMA,
    TOLERANCE,
];
