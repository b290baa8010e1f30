//! What may be changed of the cantilever.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const HENCKY: &str = "hencky";
pub(super) const NEO_HOOKEAN: &str = "neo-hookean";
pub(super) const JAUMANN: &str = "jaumann";
pub(super) const JAUMANN_LINEAR: &str = "jaumann-linear";
pub(super) const GAUSS: &str = "gauss";
pub(super) const NONE: &str = "none";
pub(super) const SOFT: &str = "soft";
pub(super) const GHOST: &str = "ghost";
pub(super) const EXTENSION: &str = "extension";

pub(super) const YOUNG_MODULUS: Parameter = common::YOUNG_MODULUS.with_default("1e5");
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0");
pub(super) const LOAD_STEPS: Parameter = common::LOAD_STEPS
    .with_default("20")
    .meaning("equal steps of the weight");
parameters! { pub(super) const:
    LAW = "law", "-", HENCKY, Domain::Choice(&[HENCKY, NEO_HOOKEAN, JAUMANN, JAUMANN_LINEAR]),
        "elastic law; jaumann is integrated to second order, jaumann-linear as the paper does";
    POINTS_PER_DIRECTION = "points_per_direction", "-", "4", Domain::Integer { least: 2, most: 8 },
        "particles per cell and direction; of one, in the middle, what alternates from node to node has no strain";
    POINTS = "points", "-", "uniform", Domain::Choice(&["uniform", GAUSS]),
        "where particles start: in the middle of equal parts of a cell, or, the paper's subdivision, two Gauss points in each half of their number";
    STABILISATION = "stabilisation", "-", GHOST, Domain::Choice(&[NONE, SOFT, GHOST, EXTENSION]),
        "what holds functions that see hardly any material";
    STABILISATION_FACTOR = "stabilisation_factor", "-", "0.01", number(1e-8, 1.0, false),
        "of ghost its share of Young's modulus, of soft that of the stiffness of the mesh";
    WEIGHT = "weight", "N/m³", "4000", number(1.0, 1e6, false),
        "weight of the initial volume at the end";
    TOLERANCE = "tolerance", "-", "1e-9", number(1e-13, 1e-2, false),
        "residual of a converged step over the loads";
}

/// All of them.
pub(super) const ALL: [Parameter; 10] = [
    LAW,
    YOUNG_MODULUS,
    POISSON_RATIO,
    WEIGHT,
    LOAD_STEPS,
    POINTS_PER_DIRECTION,
    POINTS,
    STABILISATION,
    STABILISATION_FACTOR,
    TOLERANCE,
];
