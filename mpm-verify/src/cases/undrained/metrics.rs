//! What is measured of the undrained body.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    INF_SUP = "inf_sup", "-",
        "least number β > 0 that a pressure's norm times the norms of motions can fall to where it works on them, Chapelle and Bathe's";
    ZERO_MODES = "zero_modes", "-", "pressures that no motion sees: β² < 10⁻⁹";
    DISPLACEMENT_ERROR = "displacement_error", "-",
        "rms over the particles of the distance from the exact displacement, over its rms; none of the ellipse";
    PRESSURE_ERROR = "pressure_error", "-",
        "rms over the particles of the distance from the exact pressure, over its rms; none of the ellipse";
    CHECKERBOARD_RATIO = "checkerboard_ratio", "-",
        "rms over the cells of the pressure of a checkerboard's amplitude, over the rms of the exact pressure; none of the ellipse";
    UNKNOWNS = "displacements", "-", "unknown components of displacement";
    PRESSURES = "pressures", "-", "unknown pressures";
}
