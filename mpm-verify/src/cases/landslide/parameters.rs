//! Parameters of a slope, and of the slide.

use crate::cases::parameters;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(in crate::cases) const YOUNG_MODULUS: Parameter = Parameter {
    domain: number(1e3, 1e12, false),
    ..parameters::YOUNG_MODULUS.with_default("25e6")
};
pub(in crate::cases) const POISSON_RATIO: Parameter =
    parameters::POISSON_RATIO.with_default("0.499");
pub(in crate::cases) const DENSITY: Parameter = Parameter {
    domain: number(1e-3, 1e5, false),
    ..parameters::DENSITY.with_default("2150")
};
parameters! { pub(in crate::cases) const:
    HEIGHT = "height", "m", "5", number(0.5, 100.0, false), "height H";
    CREST = "crest", "m", "10", number(0.5, 200.0, false), "length of the crest behind the face";
    FACE_ANGLE = "face_angle", "°", "45", number(5.0, 90.0, false),
        "angle of the face against the horizontal";
    FLOOR = "floor", "m", "30", number(1.0, 500.0, false), "length of the fixed floor before the toe";
}
pub(in crate::cases) const CFL: Parameter = parameters::CFL.with_default("0.35").meaning(
    "largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.01 s, 5·10⁻⁵ s at h = 0.2 m",
);
pub(in crate::cases) const WALL: Parameter =
    parameters::WALL.meaning("how B-splines meet floor and walls");
pub(in crate::cases) const PPC_PER_DIRECTION: Parameter = Parameter {
    domain: Domain::Integer { least: 1, most: 8 },
    ..parameters::PPC_PER_DIRECTION
};

parameters! { pub(super) const:
    PEAK_STRENGTH = "peak_strength", "Pa", "40.82e3", number(1.0, 1e12, false),
        "peak strength κ_p = ‖s‖, √2 times the undrained shear strength";
    RESIDUAL_STRENGTH = "residual_strength", "Pa", "2.45e3", number(1e-3, 1e12, false),
        "residual strength κ_r = ‖s‖; at most the reduced peak";
    SOFTENING = "softening", "-", "5", number(0.0, 1e3, false),
        "softening coefficient η of κ = κ_r + (κ_p − κ_r) exp(−η ε)";
    REDUCTION = "reduction", "-", "1.65", number(1.0, 100.0, false),
        "factor by which the peak strength is divided after the gravity stage";
    RELEASE = "release", "s", "0", number(0.0, 60.0, false),
        "time over which that factor rises from one; 0: at once";
    DURATION = "duration", "s", "5.5", number(0.01, 60.0, false),
        "time after the reduction, or from where it begins";
    WIDTH = "width", "m", "0", number(0.0, 1000.0, false),
        "width, a whole number of cells; 0 stands for that of the level: 5 m, of a slice four cells";
}
pub(super) const DAMPING: Parameter = parameters::DAMPING
    .meaning("local damping after the reduction: with it the slope moves without inertia");

/// The parameters in plane strain.
pub(super) const PARAMETERS: [Parameter; 17] = [
    YOUNG_MODULUS,
    POISSON_RATIO,
    PEAK_STRENGTH,
    RESIDUAL_STRENGTH,
    SOFTENING,
    REDUCTION,
    RELEASE,
    DENSITY,
    HEIGHT,
    CREST,
    FACE_ANGLE,
    FLOOR,
    DURATION,
    DAMPING,
    CFL,
    WALL,
    PPC_PER_DIRECTION,
];

/// Those in three dimensions.
pub(super) fn parameters_3d() -> Vec<Parameter> {
    [&PARAMETERS[..], &[WIDTH]].concat()
}
