//! Parameters that several problems have: each is asked for by itself, so that a slip does not compile.

use crate::parameter::{Domain, number, parameters};
use crate::record::Record;

pub(super) use crate::exact::parameters::{DENSITY, POISSON_RATIO, YOUNG_MODULUS};

/// Words of [`WALL`].
pub(super) const WALL_LINE: &str = "wall-line";

parameters! { pub(super) const:
    CFL = "cfl", "-", "0.4", number(1e-3, 1.0, true), "CFL number c Δt / h of pressure waves";
    FLIP = "flip", "-", "1", number(0.0, 1.0, false), "PIC/FLIP blend η: 1 is FLIP";
    DAMPING = "damping", "-", "0", number(0.0, 1.0, true), "local damping factor";
    WALL = "wall", "-", "open-knot", Domain::Choice(&["open-knot", WALL_LINE]), "how B-splines meet walls";
    PPC_PER_DIRECTION = "ppc_per_direction", "-", "2", Domain::Integer { least: 1, most: 4 },
        "particles per cell and direction";
    LOAD_STEPS = "load_steps", "-", "4", Domain::Integer { least: 1, most: 10_000 },
        "equal steps of the load";
    STEP_SCALING = "step_scaling", "-", "h", Domain::Choice(&["h", "h2"]),
        "h: the time step shrinks with h; h2: with h², from the one at eight cells per side";
}

/// Whether a run was of its case's own problem, however divided in space and time.
pub(crate) fn is_of_own_problem(record: &Record) -> bool {
    record.changes_none_but(&[
        CFL.name,
        STEP_SCALING.name,
        LOAD_STEPS.name,
        PPC_PER_DIRECTION.name,
    ])
}
