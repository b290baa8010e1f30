//! What may be changed of the lattice.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const LINEAR_VISCOSITY: Parameter = common::LINEAR_VISCOSITY;
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
/// Words of [`LAYOUT`].
pub(super) const JITTERED: &str = "jittered";
pub(super) const CUT_WORD: &str = "cut";

parameters! { pub(super) const:
    DIMENSION = "dimension", "-", "2", Domain::Integer { least: 1, most: 3 }, "dimensions of the lattice";
    LAYOUT = "layout", "-", "aligned", Domain::Choice(&["aligned", JITTERED, CUT_WORD]),
        "particles in the middle of their shares; off it by up to a quarter of them, in every cell alike; or aligned, with a free end that reaches over a grid line by `cut`";
    CUT = "cut", "-", "0.01", number(1e-6, 0.2, false),
        "of the layout cut: how far, in cells, the outermost functions see the first particle";
    STRETCH = "stretch", "-", "1", number(0.3, 3.0, false),
        "J of the body at the start, by a stretch along the axis; other than 1 in one dimension alone";
    STEPS = "steps", "-", "400", Domain::Integer { least: 100, most: 1_000_000 }, "steps of a trial";
}

/// All of them.
pub(super) const ALL: [Parameter; 8] = [
    DIMENSION,
    LAYOUT,
    CUT,
    STRETCH,
    LINEAR_VISCOSITY,
    STEPS,
    PPC_PER_DIRECTION,
    POISSON_RATIO,
];
