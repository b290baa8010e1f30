//! The parameters of the dam break, and their words.

use crate::cases::parameters as shared;
use crate::parameter::{Domain, Parameter, number, parameter};

/// Words of [`START`] and [`WALL_CONTACT`].
pub(super) const EXACT: &str = "exact";
pub(super) const GRAVITY_STAGE: &str = "gravity-stage";
pub(super) const STICKY: &str = "sticky";

pub(super) const BULK_MODULUS: Parameter = parameter(
    "bulk_modulus",
    "Pa",
    "2e9",
    number(1e5, 1e12, false),
    "bulk modulus K",
);
pub(super) const DENSITY: Parameter = parameter(
    "density",
    "kg/m³",
    "997.5",
    number(1e-3, 1e5, false),
    "density ρ without pressure",
);
pub(super) const VISCOSITY: Parameter = parameter(
    "viscosity",
    "Pa s",
    "0.001",
    number(0.0, 1e6, false),
    "dynamic viscosity μ",
);
pub(super) const DURATION: Parameter = parameter(
    "duration",
    "s",
    "2",
    number(0.01, 10.0, false),
    "time after the removal of the gate",
);
pub(super) const START: Parameter = parameter(
    "start",
    "-",
    EXACT,
    Domain::Choice(&[EXACT, GRAVITY_STAGE]),
    "how the water comes to rest behind the gate: exactly, or by gravity that rises from zero, with damping",
);
pub(super) const WALL_CONTACT: Parameter = parameter(
    "wall_contact",
    "-",
    "separable",
    Domain::Choice(&["separable", STICKY]),
    "whether water comes off the walls freely or they bear tension; it slides freely along either",
);
pub(super) const CFL: Parameter = shared::CFL.with_default("0.0567").meaning(
    "largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.005 s, 10⁻⁵ s at h = 0.25 m",
);
pub(super) const PIC_RATE: Parameter = parameter(
    "pic_rate",
    "1/s",
    "0",
    number(0.0, 1e6, false),
    "share of PIC per unit of time, r: η = exp(−r Δt); 0 is FLIP",
);
pub(super) const WALL: Parameter = shared::WALL.meaning("how B-splines meet floor and walls");
pub(super) const PPC_PER_DIRECTION: Parameter = Parameter {
    default: "5",
    domain: Domain::Integer { least: 1, most: 8 },
    ..shared::PPC_PER_DIRECTION
};
pub(super) const SEED: Parameter = parameter(
    "seed",
    "-",
    "0",
    Domain::Integer {
        least: 0,
        most: 1000,
    },
    "which member of an ensemble whose starts differ in last bits; 0 is the undisturbed one",
);

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
