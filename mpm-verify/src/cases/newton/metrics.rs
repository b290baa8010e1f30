//! What is measured of the column.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    CARRIED = "carried", "-", "share of the load at the last equilibrium that was found";
    BEARABLE = "bearable", "-", "share of the load up to which there is one";
    EQUILIBRIUM_ERROR = "equilibrium_error", "-",
        "rms error of the displacements at the last equilibrium over the height; none if there was none";
    BOUND = "equilibrium_bound", "-", "bound of it: what cells of this size leave";
    REACTION_ERROR = "reaction_error", "-",
        "force on the floor, or on what holds the upper end, over the weight that is carried, less one";
    GAP_ERROR = "gap_error", "-",
        "standing: mean gap of the lowest particles less the exact one, over the distance at which the barrier begins";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps that were taken";
    PARTS = "parts", "-", "most parts that a load step was cut into";
}
