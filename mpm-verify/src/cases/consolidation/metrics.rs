//! What is measured of the column.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    SETTLEMENT_ERROR = "settlement_error", "-",
        "largest relative error of the settlement at the tabulated T from 0.1 on; none at a load that has no reference";
    SETTLEMENT_ERROR_STEPS = "settlement_error_steps", "-",
        "likewise against the exact solution in space of the same backward Euler steps: the error of space alone";
    BASE_PRESSURE_ERROR = "base_pressure_error", "-",
        "largest error there of the pressure at the base, over the load";
    BASE_PRESSURE_ERROR_STEPS = "base_pressure_error_steps", "-",
        "likewise against the exact solution in space of the same steps";
    SETTLEMENT_EARLY = "settlement_0.1", "-", "settlement over H at T = 0.1";
    SETTLEMENT_END = "settlement_end", "-", "settlement over H at T = 2";
    MASS_ERROR = "mass_error", "-",
        "change of the volume and outflow together, over the outflow; 10⁻⁹ if it is less, which no golden should hold";
    RATE_LOSS = "rate_loss", "-",
        "½ Σ V (J̃ − 1)² of all particles and steps over the outflow: what the logarithmic rate loses to leading order";
    VOLUME_STEP = "volume_step", "-", "largest |J̃ − 1| of a particle in a step";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix, on average";
}
