//! What is measured of the column.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    PRESSURE_L2 = "pressure_l2", "-",
        "rms over the particles, at the end, of the pressure less Terzaghi's, over the load";
    PRESSURE_L2_STEPS = "pressure_l2_steps", "-",
        "likewise less the exact solution in space of the same backward Euler steps: the error of space alone";
    OVERSHOOT_FIRST_STEP = "overshoot_first_step", "-",
        "largest pressure at a node after the first step over the load, less one; zero where none exceeds it by 10⁻⁹";
    SETTLEMENT_ERROR = "settlement_error", "-",
        "distance at the end of the settlement from Terzaghi's, over the final one q H/M";
    MASS_ERROR = "mass_error", "-",
        "change of the volume and outflow together, over the outflow; 10⁻⁹ if it is less, which no golden should hold";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix";
}
