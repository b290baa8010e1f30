//! What may be changed of the excavation.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("2e5");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.33");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const WALL: Parameter = common::WALL;
pub(super) use common::{ALPHA, DELTA, TOLERANCE};
/// By β the eigenvalues of M_l⁻¹ M_β lie within β and 1: 500 iterations of conjugate gradients, which are all that a mass
/// gets, come to 10⁻¹⁰ for certain if β ≥ (ln(2·10¹⁰)/1000)² = 0.0006. Ground that flows has nodes that are nearly empty.
pub(super) const LUMPED: Parameter = common::LUMPED.within(number(1e-3, 1.0, false));

/// Words of [`BASE`], [`GRAVITY`] and [`LAW`].
pub(super) const FRICTIONAL: &str = "friction";
pub(super) const STEP: &str = "step";
pub(super) const JAUMANN: &str = "jaumann-j2";

parameters! { pub(super) const:
    PEAK = "peak", "Pa", "5e3", number(1.0, 1e9, false),
        "peak of the strength c in plane-strain shear; κ = √2 c";
    RESIDUAL = "residual", "Pa", "1e3", number(1.0, 1e9, false),
        "residual strength c, at most the peak; the peak: no softening";
    SOFTENING = "softening", "Pa", "5e4", number(1.0, 9e4, true),
        "−H = −dc/dε of the equivalent plastic strain";
    UNIT_WEIGHT = "unit_weight", "N/m³", "2e4", number(1.0, 1e6, false), "unit weight γ";
    CREST = "crest", "m", "1.5", number(1.0, 10.0, false), "length of the crest, up to the rollers";
    CUT = "cut", "m", "0.2", number(0.0, 0.9, false), "height of the vertical cut at the toe";
    BASE = "base", "-", "rough", Domain::Choice(&["rough", FRICTIONAL]),
        "rough: the nodes of the base are held; friction: Coulomb's law beneath the particles";
    FRICTION = "friction", "-", "0.5", number(0.0, 10.0, false), "base=friction: the coefficient μ";
    GRAVITY = "gravity", "-", "ramp", Domain::Choice(&["ramp", STEP]),
        "ramp: in load_steps equal steps, each cut into parts if it has to; step: at once, and never cut";
    LOAD_STEPS = "load_steps", "-", "20", Domain::Integer { least: 1, most: 1000 },
        "gravity=ramp: steps";
    LAW = "law", "-", "hencky-j2", Domain::Choice(&["hencky-j2", JAUMANN]),
        "hyperelastic, or the paper's small strains in rate form";
    CFL = "cfl", "-", "2", number(0.01, 1000.0, false),
        "after the excavation: CFL number c Δt / h of pressure waves";
    DURATION = "duration", "s", "3", number(0.01, 60.0, false), "time after the excavation";
    GHOST = "ghost", "-", "0.01", number(0.0, 1.0, false), "ghost penalty, in shares of Young's modulus; 0: none";
}

/// All of them.
pub(super) const ALL: [Parameter; 22] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    PEAK,
    RESIDUAL,
    SOFTENING,
    UNIT_WEIGHT,
    CREST,
    CUT,
    BASE,
    FRICTION,
    GRAVITY,
    LOAD_STEPS,
    LAW,
    CFL,
    DURATION,
    GHOST,
    LUMPED,
    ALPHA,
    DELTA,
    TOLERANCE,
    WALL,
    PPC_PER_DIRECTION,
];
