//! What is measured of the largest step.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    CRITICAL_CFL = "critical_cfl", "-",
        "largest CFL number c Δt/h, c of the state of the start, at which noise does not grow a hundredfold within the steps; below one, which the program refuses to exceed";
    PREDICTED_CFL = "predicted_cfl", "-",
        "the same by linear analysis; zero where a mean stress feeds a wave whatever the step";
    FED_CFL = "fed_cfl", "-",
        "where a mean stress feeds a wave: the CFL number at which the fastest grows from a fiftieth of its share of the noise to a hundred times the noise within the steps";
    OFFERED_CFL = "offered_cfl", "-",
        "CFL number of the step that time_step=auto takes of a case that offers it";
}
