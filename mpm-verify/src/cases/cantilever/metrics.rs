//! What is measured of the cantilever.

use crate::metric::{Metric, metrics};

metrics! { pub(super) OWN:
    CORNER_UX = "corner_ux", "m",
        "u_x of the lower right corner, (1, 0) m, extrapolated linearly from the nearest particles";
    CORNER_UY = "corner_uy", "m", "u_y of that corner, likewise";
    EDGE_MEAN_UX = "edge_mean_ux", "m",
        "u_x averaged over the right side, extrapolated from the last two columns of particles";
    EDGE_MEAN_UY = "edge_mean_uy", "m", "u_y, likewise";
    CORNER_ERROR = "corner_error", "-",
        "distance of corner_uy from the reference over the reference";
    EDGE_MEAN_ERROR = "edge_mean_error", "-", "of edge_mean_uy, likewise";
    STRESS_MIN = "stress_min", "Pa", "least σ_xx at a particle: compression";
    STRESS_MAX = "stress_max", "Pa", "greatest σ_xx at a particle: tension";
    STRESS_ERROR = "stress_error", "-",
        "rms distance of σ_xx from the reference at six points near the clamp, over the rms of the reference";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    CUTS = "cut_steps", "-", "load steps that were taken in parts";
    LOG10_CONDITION = "log10_condition", "-",
        "log₁₀ of the estimated condition, in the 1-norm, of the stiffness at the end, scaled to a diagonal of ones";
    FORCE_RATIO = "force_ratio", "-",
        "largest out-of-balance force ratio of a step, the paper's Eq. (37); the tolerance, if it is less";
    FORCE_ROUNDING = "force_rounding", "-",
        "largest such ratio that rounding of the stresses by four last bits may leave: Newton's method asks for no less";
    ENERGY_RATIO = "energy_ratio", "-",
        "largest work of a step's residual on its last correction over that of the loads, for the paper's Eq. (38); the tolerance, if it is less";
    REACTION_ERROR = "reaction_error", "-",
        "distance of the clamp's reaction from the weight over the weight; likewise";
    MASS = "mass", "kg/m", "mass of the beam";
}

metrics! {
    /// σ_xx at material points (m).
    pub(super) STRESSES at [f64; 2]:
    [0.1, 0.05] => "stress_xx_0.1_0.05", "Pa",
        "σ_xx at the material point (0.1, 0.05) m, by a linear fit over the particles within h";
    [0.1, 0.15] => "stress_xx_0.1_0.15", "Pa", "likewise at (0.1, 0.15) m";
    [0.1, 0.25] => "stress_xx_0.1_0.25", "Pa", "likewise at (0.1, 0.25) m";
    [0.2, 0.05] => "stress_xx_0.2_0.05", "Pa", "likewise at (0.2, 0.05) m";
    [0.2, 0.15] => "stress_xx_0.2_0.15", "Pa", "likewise at (0.2, 0.15) m";
    [0.2, 0.25] => "stress_xx_0.2_0.25", "Pa", "likewise at (0.2, 0.25) m";
}

/// All of them.
pub(super) fn all() -> Vec<Metric> {
    let stresses = STRESSES.iter().map(|(metric, _)| *metric);
    OWN.iter().copied().chain(stresses).collect()
}
