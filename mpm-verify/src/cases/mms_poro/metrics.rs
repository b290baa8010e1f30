//! What is measured of the motion.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    DISPLACEMENT_L2 = "displacement_l2", "m", "rms over the particles of |u − exact u| at the end";
    DISPLACEMENT_LINF = "displacement_linf", "m", "largest |u − exact u| at the end";
    DISPLACEMENT_SCALE = "displacement_scale", "m", "rms over the particles of the exact u at the end";
    PRESSURE_L2 = "pressure_l2", "-",
        "rms over the particles of p less the exact one at the end, over that of the exact p";
    PRESSURE_LINF = "pressure_linf", "-", "largest such error, likewise";
    PRESSURE_SCALE = "pressure_scale", "Pa", "rms over the particles of the exact p at the end";
    STRESS_L2 = "stress_l2", "Pa", "rms of the Frobenius norm of the error of the effective Cauchy stress";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix";
}
