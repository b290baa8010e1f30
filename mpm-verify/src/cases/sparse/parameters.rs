//! What may be changed of the cloud.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, parameters};

/// Words of [`LAYOUT`].
pub(super) const LATTICE: &str = "lattice";
pub(super) const JITTERED: &str = "jittered";
pub(super) const RANDOM: &str = "random";
pub(super) const SCATTERED: &str = "scattered";
pub(super) const HOLES: &str = "holes";

pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION.with_default("1");
pub(super) const CFL: Parameter = common::CFL.with_default("0.3");
parameters! { pub(super) const:
    LAYOUT = "layout", "-", RANDOM, Domain::Choice(&[LATTICE, JITTERED, RANDOM, SCATTERED, HOLES]),
        "lattice; jittered: anywhere in its own part of a cell; random: anywhere in its cell; scattered: anywhere in the body; holes: a lattice that lacks one particle of every cell";
    SEEDS = "seeds", "-", "20", Domain::Integer { least: 1, most: 1000 }, "clouds that are tried, of the same kind";
}

/// All of them.
pub(super) const ALL: [Parameter; 5] = [LAYOUT, SEEDS, PPC_PER_DIRECTION, POISSON_RATIO, CFL];
