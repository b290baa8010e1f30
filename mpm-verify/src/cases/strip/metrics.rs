//! What is measured of the strip.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    SETTLEMENT = "settlement", "-",
        "settlement at the end of the particle next to the axis at the surface, over the half width B";
    SETTLEMENT_RATIO = "settlement_ratio", "-",
        "likewise over that of finite elements at small strain; none but of elastic soil under 1 kPa at most, in their steps or undrained";
    PRESSURE_ERROR = "pressure_error", "-",
        "rms over the particles at the end of the pressure's distance from that of the same elements, over the load";
    PRESSURE_ERROR_LARGEST = "pressure_error_largest", "-",
        "the largest of these distances farther than B/2 from the strip's edge";
    ROUGHNESS = "roughness", "-",
        "rms at the end of the pressure less the mean of the four particles beside it, over the load, farther than B/2 from the strip's edge";
    LEAST_PRESSURE = "least_pressure", "-", "least pressure of a particle at the end, over the load";
    MOST_PRESSURE = "largest_pressure", "-", "largest pressure of a particle at the end, over the load";
    LAST_LOAD = "last_load", "Pa",
        "load on the strip after the last step or part of one that has a solution: of Cam clay its limit, if it has not come to the whole";
    LIMIT_LOAD = "limit_load", "Pa",
        "load at the settlement `penetration`; none if it was not reached";
    GROWTH = "growth", "-",
        "control=settlement: what the load has grown by in the last quarter, over itself";
    UNIFORM_ERROR = "uniform_error", "-",
        "of Cam clay, α = γ = 1, under a load on its whole surface: relative error of the settlement of all of it, by its volume";
    PLASTIC_STRAIN = "plastic_strain", "-", "largest equivalent plastic strain";
    SUPPORT_ERROR = "support_error", "-",
        "distance of the force on the base from the loads, over these; 10⁻⁹ if less";
    MASS_ERROR = "mass_error", "-",
        "change of the volume and outflow together, over what the strip displaces; 10⁻⁹ if it is less, which no golden should hold";
    TURNOVER = "turnover", "-",
        "Σ V |J̃ − 1| of all particles and steps over what the strip displaces";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    MOST_ITERATIONS = "newton_most", "-", "most iterations of a step that has a solution";
    ENTRIES = "matrix_entries", "-", "entries of a matrix, on average";
}
