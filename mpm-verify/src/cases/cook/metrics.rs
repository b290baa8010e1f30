//! What is measured of Cook's membrane.

use crate::metric::{Metric, metrics};
use crate::results::{Column, headline};

metrics! { pub(super) OWN:
    MID_EDGE_UY = "mid_edge_uy", "m",
        "u_y of the middle of the right side, (48, 52) m, by a linear fit over the particles within 2h";
    EDGE_MEAN_UY = "edge_mean_uy", "m", "u_y averaged over the right side, from such fits at eight points";
    TIP_UY = "tip_uy", "m", "u_y of the upper right corner, (48, 60) m, by such a fit";
    TIP_UY_NEAREST = "tip_uy_nearest", "m", "u_y of the particle nearest to that corner";
    TIP_UX = "tip_ux", "m", "u_x of that corner, by the fit";
    MEAN_STRESS_RMS_ERROR = "mean_stress_rms_error", "Pa",
        "rms over particles with x > 3 m, 3 m away from the clamped corners, of the mean normal stress minus the reference";
    MEAN_STRESS_RMS = "mean_stress_rms", "Pa", "rms over all particles of the mean normal stress";
    CHECKERBOARD_RMS = "checkerboard_rms", "Pa", "rms over all particles of σ_m − Πσ_m";
    CHECKERBOARD_RATIO = "checkerboard_ratio", "-", "checkerboard_rms over mean_stress_rms";
    CREEP_RATE = "creep_rate", "1/s", "slope of rms ln(J/J̄) against time over the second half of the run";
    CREEP_LINEARITY = "creep_linearity", "-", "R² of that straight line";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at the end";
    AT_REST = "at_rest", "-", "1 if the criterion of rest was met, 0 if the run was stopped without";
    REST_TIME = "rest_time", "s", "time at the end of the run";
    WORK_RESIDUAL = "work_residual", "-",
        "largest out-of-balance virtual work over the last window, relative to that of the load";
    REACTION_UY = "reaction_uy", "N/m", "vertical reaction of the clamped side";
    MASS = "mass", "kg/m", "mass of the particles";
    SEEDED_VOLUME = "seeded_volume", "m²", "reference volume of the particles; the membrane's is 1,440 m²";
    ENERGY_GAIN = "energy_gain", "-",
        "largest kinetic energy + stress work + losses − load work over the run, relative to the final load work";
    ENERGY_LOSS = "energy_loss", "-",
        "largest excess of the load's work, likewise: what the transfer dissipates";
    PERIOD = "period", "s", "nominal fundamental period";
    REACTION_ERROR = "reaction_error", "-",
        "quasi-static: distance of the clamp's reaction from the load over the load; 10⁻⁹ if it is less";
    NEWTON_ITERATIONS = "newton_iterations", "-", "quasi-static: Newton iterations of all steps";
    LINEAR_ITERATIONS = "linear_iterations", "-",
        "quasi-static: solutions by factors, with F̄ iterations of conjugate gradients";
    FEM_MID_EDGE_ERROR = "fem_mid_edge_error", "-", "relative error of mid_edge_uy";
    FEM_EDGE_MEAN_ERROR = "fem_edge_mean_error", "-", "relative error of edge_mean_uy";
    FEM_TIP_ERROR = "fem_tip_error", "-", "relative error of tip_uy";
}

metrics! {
    /// The mean normal stress at material points (m).
    pub(super) MEAN_STRESSES at [f64; 2]:
    [24.0, 36.0] => "mean_stress_24_36", "Pa",
        "mean normal stress at the material point (24, 36) m, by a linear fit";
    [16.0, 30.0] => "mean_stress_16_30", "Pa", "likewise at (16, 30) m";
    [36.0, 48.0] => "mean_stress_36_48", "Pa", "likewise at (36, 48) m";
    [24.0, 24.0] => "mean_stress_24_24", "Pa", "likewise at (24, 24) m";
    [8.0, 20.0] => "mean_stress_8_20", "Pa", "likewise at (8, 20) m";
    [8.0, 40.0] => "mean_stress_8_40", "Pa", "likewise at (8, 40) m";
    [44.0, 52.0] => "mean_stress_44_52", "Pa", "likewise at (44, 52) m";
}

/// All of them.
pub(super) fn all() -> Vec<Metric> {
    let stresses = MEAN_STRESSES.iter().map(|(metric, _)| *metric);
    OWN.iter().copied().chain(stresses).collect()
}

/// What the table of results shows.
pub(super) fn headlines() -> Vec<Column> {
    vec![
        headline(FEM_MID_EDGE_ERROR, "mid-edge error (%)", 100.0, 2),
        headline(FEM_EDGE_MEAN_ERROR, "edge-mean error (%)", 100.0, 2),
        headline(FEM_TIP_ERROR, "tip error (%)", 100.0, 2),
        headline(MEAN_STRESS_RMS_ERROR, "σ_m rms error (mPa)", 1e3, 1),
        headline(CHECKERBOARD_RATIO, "checkerboard (–)", 1.0, 2),
        headline(AT_REST, "at rest (1: yes)", 1.0, 0),
        headline(REST_TIME, "time at the end (s)", 1.0, 0),
        headline(CREEP_RATE, "creep of ln(J/J̄) (10⁻⁶/s)", 1e6, 2),
        headline(LOG_JACOBIAN_GAP, "ln(J/J̄) at the end (10⁻⁴)", 1e4, 2),
    ]
}
