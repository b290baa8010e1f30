//! The parameters of the dam break, and their words.

use crate::cases::parameters as shared;
use crate::parameter::{Domain, Parameter, number, parameters};

/// Words of [`START`] and [`WALL_CONTACT`].
pub(super) const EXACT: &str = "exact";
pub(super) const GRAVITY_STAGE: &str = "gravity-stage";
pub(super) const STICKY: &str = "sticky";

parameters! { pub(super) const:
    BULK_MODULUS = "bulk_modulus", "Pa", "2e9", number(1e5, 1e12, false), "bulk modulus K";
    DENSITY = "density", "kg/m³", "997.5", number(1e-3, 1e5, false), "density ρ without pressure";
    VISCOSITY = "viscosity", "Pa s", "0.001", number(0.0, 1e6, false), "dynamic viscosity μ";
    DURATION = "duration", "s", "2", number(0.01, 10.0, false), "time after the removal of the gate";
    START = "start", "-", EXACT, Domain::Choice(&[EXACT, GRAVITY_STAGE]),
        "how the water comes to rest behind the gate: exactly, or by gravity that rises from zero, with damping";
    WALL_CONTACT = "wall_contact", "-", "separable", Domain::Choice(&["separable", STICKY]),
        "whether water comes off the walls freely or they bear tension; it slides freely along either";
    PIC_RATE = "pic_rate", "1/s", "0", number(0.0, 1e6, false),
        "share of PIC per unit of time, r: η = exp(−r Δt); 0 is FLIP";
    SEED = "seed", "-", "0", Domain::Integer { least: 0, most: 1000 },
        "which member of an ensemble whose starts differ in last bits; 0 is the undisturbed one";
}
pub(super) const CFL: Parameter = shared::CFL.with_default("0.0567").meaning(
    "largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.005 s, 10⁻⁵ s at h = 0.25 m",
);
pub(super) const WALL: Parameter = shared::WALL.meaning("how B-splines meet floor and walls");
pub(super) const PPC_PER_DIRECTION: Parameter = Parameter {
    default: "5",
    domain: Domain::Integer { least: 1, most: 8 },
    ..shared::PPC_PER_DIRECTION
};

pub(super) const ALL: [Parameter; 11] = [
    BULK_MODULUS,
    DENSITY,
    VISCOSITY,
    DURATION,
    START,
    WALL_CONTACT,
    CFL,
    PIC_RATE,
    WALL,
    PPC_PER_DIRECTION,
    SEED,
];
