//! Parameters that several problems have: each is asked for by itself, so that a slip does not compile.

use crate::parameter::{Domain, Parameter, number, parameter};
use crate::record::Record;

pub(super) use crate::exact::parameters::{DENSITY, POISSON_RATIO, YOUNG_MODULUS};

/// Words of [`WALL`].
pub(super) const WALL_LINE: &str = "wall-line";

pub(super) const CFL: Parameter = parameter(
    "cfl",
    "-",
    "0.4",
    number(1e-3, 1.0, true),
    "CFL number c Δt / h of pressure waves",
);
pub(super) const FLIP: Parameter = parameter(
    "flip",
    "-",
    "1",
    number(0.0, 1.0, false),
    "PIC/FLIP blend η: 1 is FLIP",
);
pub(super) const DAMPING: Parameter = parameter(
    "damping",
    "-",
    "0",
    number(0.0, 1.0, true),
    "local damping factor",
);
pub(super) const WALL: Parameter = parameter(
    "wall",
    "-",
    "open-knot",
    Domain::Choice(&["open-knot", WALL_LINE]),
    "how B-splines meet walls",
);
pub(super) const PPC_PER_DIRECTION: Parameter = parameter(
    "ppc_per_direction",
    "-",
    "2",
    Domain::Integer { least: 1, most: 4 },
    "particles per cell and direction",
);
pub(super) const STEP_SCALING: Parameter = parameter(
    "step_scaling",
    "-",
    "h",
    Domain::Choice(&["h", "h2"]),
    "h: the time step shrinks with h; h2: with h², from the one at eight cells per side",
);

/// Whether a run was of its case's own problem, however divided in space and time.
pub(crate) fn is_of_own_problem(record: &Record) -> bool {
    record.changes_none_but(&[CFL.name, STEP_SCALING.name, PPC_PER_DIRECTION.name])
}
