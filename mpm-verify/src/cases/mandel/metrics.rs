//! What is measured of the slab.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    CENTRE_PRESSURE_ERROR = "centre_pressure_error", "-",
        "largest distance, from T = 0.01 on, of the pressure in the middle from Mandel's, over the undrained one F/(2a)";
    CENTRE_PRESSURE_ERROR_SPACE = "centre_pressure_error_space", "-",
        "likewise from the exact solution in space of the same backward Euler steps: the error of space alone";
    CENTRE_PRESSURE_ERROR_TIME = "centre_pressure_error_time", "-",
        "likewise from the exact solution in time of the difference equations of the same cells: the error of time alone";
    EQUATIONS_DISTANCE = "equations_distance", "-",
        "largest distance of that pressure, the settlement and the bulge from the solution of the difference equations, over all steps";
    PEAK = "peak", "-", "largest pressure in the middle over F/(2a)";
    PEAK_TIME = "peak_time", "-", "T of it";
    SETTLEMENT_ERROR = "settlement_error", "-",
        "largest distance, from T = 0.01 on, of a plate's path from Mandel's, over F b/(G a)";
    BULGE_ERROR = "bulge_error", "-",
        "likewise of a side's mean path outwards, by the change of the volume, over F/G";
    SUPPORT_ERROR = "support_error", "-",
        "largest distance of the force on the plane of symmetry below from that on the plate, over the latter; 10⁻⁹ if less";
    MASS_ERROR = "mass_error", "-",
        "change of the volume and outflow together, over the outflow; 10⁻⁹ if it is less, which no golden should hold";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix";
}
