//! What is measured of the half ellipse.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    COND_UU = "log10_cond_uu", "-", "log10 of the condition number of the displacement's matrix, largest over the places";
    COND_UU_MEAN = "log10_cond_uu_mean", "-", "likewise, mean";
    COND_UU_LEAST = "log10_cond_uu_least", "-", "likewise, least";
    COND_PP = "log10_cond_pp", "-", "log10 of the condition number of the pressure's matrix, largest over the places";
    COND_PP_MEAN = "log10_cond_pp_mean", "-", "likewise, mean";
    COND_PP_LEAST = "log10_cond_pp_least", "-", "likewise, least";
    COND = "log10_cond", "-", "log10 of the condition number of the whole matrix, largest over every fourth place";
    COND_SCALED = "log10_cond_scaled", "-", "likewise, scaled to a diagonal of ones";
    SOFTEST_UU = "softest_uu", "-", "least eigenvalue of the displacement's matrix over G, least over the places";
    SOFTEST_PP = "softest_pp", "-", "least eigenvalue of the pressure's matrix over its conductivity, least over the places";
    MIRROR_ERROR = "mirror_error", "-",
        "largest difference of log10 of the displacement's condition number between a place and its mirror image";
    DEFLECTION_CHANGE = "deflection_change", "-",
        "change by α of the mean deflection, under its weight, of a cantilever of eight cells that fits the grid";
}
