//! Parameters shared by several problems: each is read by its constant, so that a typo does not compile.

use crate::prelude::*;

pub(super) use crate::exact::common::{DENSITY, POISSON_RATIO, UNSEEN, YOUNG_MODULUS};

pub(super) const WALL_LINE: &str = "wall-line";
pub(super) const AUTO: &str = "auto";

choices! {
    pub(super) enum Wall { OpenKnot = "open-knot", WallLine = "wall-line" }
    pub(super) enum TimeStep { Cfl = "cfl", Auto = "auto" }
}

parameters! { pub(super) const:
    CFL = "cfl", "-", "0.4", number(1e-3, 1.0, true), "CFL number c Δt / h of pressure waves";
    TIME_STEP = "time_step", "-", "cfl", Domain::Choice(&["cfl", AUTO]), "cfl: by the CFL number; auto, explicit: the step that is stable however particles lie, of all but linear functions";
    FLIP = "flip", "-", "1", number(0.0, 1.0, false), "PIC/FLIP blend η: 1 is FLIP";
    DAMPING = "damping", "-", "0", number(0.0, 1.0, true), "local damping factor";
    LINEAR_VISCOSITY = "linear_viscosity", "-", "0", number(0.0, 10.0, false), "coefficient c₁ of the linear artificial viscosity: 0.5 takes what rings behind a shock";
    WALL = "wall", "-", "open-knot", Domain::Choice(&["open-knot", WALL_LINE]), "how B-splines meet walls";
    PPC_PER_DIRECTION = "ppc_per_direction", "-", "2", Domain::Integer { least: 2, most: 4 },
        "particles per cell and direction";
    LOAD_STEPS = "load_steps", "-", "4", Domain::Integer { least: 1, most: 10_000 },
        "equal steps of the load";
    GHOST = "ghost", "-", "0.001", number(0.0, 1.0, false), "implicit: ghost penalty, in shares of Young's modulus; 0: none";
    STEP_SCALING = "step_scaling", "-", "h", Domain::Choice(&["h", "h2"]), "h: the time step shrinks with h; h2: with h², from the one at eight cells per side";
}

parameters! { pub(super) const:
    LUMPED = "lumped", "-", "0.1", number(0.0, 1.0, false), "midpoint: share β of the lumped mass, the rest is consistent";
    ALPHA = "alpha", "-", "0.25", number(0.0, 2.0, false), "newmark: α, at least (δ + ½)²/4";
    DELTA = "delta", "-", "0.5", number(0.5, 2.0, false), "newmark: δ, at least ½";
    TOLERANCE = "tolerance", "-", "1e-10", number(1e-13, 1e-8, false), "implicit: residual of a converged step over the loads";
}

/// Those that the implicit solvers of bodies that move have.
pub(super) const DYNAMIC: [Parameter; 4] = [LUMPED, ALPHA, DELTA, TOLERANCE];

/// Checks a quotient of parameters, which `what` names with its value.
///
/// # Errors
/// It is not among the `allowed`; `why` says what is beyond.
pub(super) fn require_quotient(what: &str, value: f64, allowed: RangeInclusive<f64>, why: &str) -> Result<(), Error> {
    if allowed.contains(&value) {
        return Ok(());
    }
    let (least, most) = (allowed.start(), allowed.end());
    Err(Error::Input(format!("{what} = {value:.3e}; allowed: {least:.3e} to {most:.3e}, {why}")))
}

/// Share of a strain that rounding of positions and volumes may make in a run: four last bits a step, of what is of the
/// order of one. A percent hides what cases of small strain are about.
const HIDDEN: f64 = 0.01;

/// The least strain not lost in the rounding of `steps` steps.
pub(super) fn least_strain(steps: f64) -> f64 {
    4.0 * f64::EPSILON * steps / HIDDEN
}

/// Whether a run was of its case's own problem, however divided in space and time.
pub(crate) fn is_of_own_problem(record: &Record) -> bool {
    record.changes_none_but(&[CFL.name, STEP_SCALING.name, LOAD_STEPS.name, PPC_PER_DIRECTION.name])
}

#[cfg(test)]
mod tests {
    #[test]
    fn cases_have_the_ghost_penalty_of_scenes() {
        assert_eq!(super::GHOST.default.parse(), Ok(mpm_core::implicit::GHOST));
    }
}
