//! What is measured of Cook's membrane.

use crate::metric::{Headline, Metric, headline, metric};

pub(super) const MID_EDGE_UY: Metric = metric(
    "mid_edge_uy",
    "m",
    "u_y of the middle of the right side, (48, 52) m, by a linear fit over the particles within 2h",
);
pub(super) const EDGE_MEAN_UY: Metric = metric(
    "edge_mean_uy",
    "m",
    "u_y averaged over the right side, from such fits at eight points",
);
pub(super) const TIP_UY: Metric = metric(
    "tip_uy",
    "m",
    "u_y of the upper right corner, (48, 60) m, by such a fit",
);
pub(super) const TIP_UY_NEAREST: Metric = metric(
    "tip_uy_nearest",
    "m",
    "u_y of the particle nearest to that corner",
);
pub(super) const TIP_UX: Metric = metric("tip_ux", "m", "u_x of that corner, by the fit");
pub(super) const MEAN_STRESS_RMS_ERROR: Metric = metric(
    "mean_stress_rms_error",
    "Pa",
    "rms over particles with x > 3 m, 3 m away from the clamped corners, of the mean normal stress minus the reference",
);
pub(super) const MEAN_STRESS_RMS: Metric = metric(
    "mean_stress_rms",
    "Pa",
    "rms over all particles of the mean normal stress",
);
pub(super) const CHECKERBOARD_RMS: Metric = metric(
    "checkerboard_rms",
    "Pa",
    "rms over all particles of σ_m − Πσ_m",
);
pub(super) const CHECKERBOARD_RATIO: Metric = metric(
    "checkerboard_ratio",
    "-",
    "checkerboard_rms over mean_stress_rms",
);
pub(super) const CREEP_RATE: Metric = metric(
    "creep_rate",
    "1/s",
    "slope of rms ln(J/J̄) against time over the second half of the run",
);
pub(super) const CREEP_LINEARITY: Metric =
    metric("creep_linearity", "-", "R² of that straight line");
pub(super) const LOG_JACOBIAN_GAP: Metric =
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end");
pub(super) const AT_REST: Metric = metric(
    "at_rest",
    "-",
    "1 if the criterion of rest was met, 0 if the run was stopped without",
);
pub(super) const REST_TIME: Metric = metric("rest_time", "s", "time at the end of the run");
pub(super) const WORK_RESIDUAL: Metric = metric(
    "work_residual",
    "-",
    "largest out-of-balance virtual work over the last window, relative to that of the load",
);
pub(super) const REACTION_UY: Metric = metric(
    "reaction_uy",
    "N/m",
    "vertical reaction of the clamped side",
);
pub(super) const MASS: Metric = metric("mass", "kg/m", "mass of the particles");
pub(super) const SEEDED_VOLUME: Metric = metric(
    "seeded_volume",
    "m²",
    "reference volume of the particles; the membrane's is 1,440 m²",
);
pub(super) const ENERGY_GAIN: Metric = metric(
    "energy_gain",
    "-",
    "largest kinetic energy + stress work + losses − load work over the run, relative to the final load work",
);
pub(super) const ENERGY_LOSS: Metric = metric(
    "energy_loss",
    "-",
    "largest excess of the load's work, likewise: what the transfer dissipates",
);
pub(super) const PERIOD: Metric = metric("period", "s", "nominal fundamental period");
pub(super) const FEM_MID_EDGE_ERROR: Metric =
    metric("fem_mid_edge_error", "-", "relative error of mid_edge_uy");
pub(super) const FEM_EDGE_MEAN_ERROR: Metric =
    metric("fem_edge_mean_error", "-", "relative error of edge_mean_uy");
pub(super) const FEM_TIP_ERROR: Metric = metric("fem_tip_error", "-", "relative error of tip_uy");

/// The mean normal stress at material points (m).
pub(super) const MEAN_STRESSES: [(Metric, [f64; 2]); 7] = [
    (
        metric(
            "mean_stress_24_36",
            "Pa",
            "mean normal stress at the material point (24, 36) m, by a linear fit",
        ),
        [24.0, 36.0],
    ),
    (
        metric("mean_stress_16_30", "Pa", "likewise at (16, 30) m"),
        [16.0, 30.0],
    ),
    (
        metric("mean_stress_36_48", "Pa", "likewise at (36, 48) m"),
        [36.0, 48.0],
    ),
    (
        metric("mean_stress_24_24", "Pa", "likewise at (24, 24) m"),
        [24.0, 24.0],
    ),
    (
        metric("mean_stress_8_20", "Pa", "likewise at (8, 20) m"),
        [8.0, 20.0],
    ),
    (
        metric("mean_stress_8_40", "Pa", "likewise at (8, 40) m"),
        [8.0, 40.0],
    ),
    (
        metric("mean_stress_44_52", "Pa", "likewise at (44, 52) m"),
        [44.0, 52.0],
    ),
];

/// All of them.
pub(super) fn all() -> Vec<Metric> {
    let own = [
        MID_EDGE_UY,
        EDGE_MEAN_UY,
        TIP_UY,
        TIP_UY_NEAREST,
        TIP_UX,
        MEAN_STRESS_RMS_ERROR,
        MEAN_STRESS_RMS,
        CHECKERBOARD_RMS,
        CHECKERBOARD_RATIO,
        CREEP_RATE,
        CREEP_LINEARITY,
        LOG_JACOBIAN_GAP,
        AT_REST,
        REST_TIME,
        WORK_RESIDUAL,
        REACTION_UY,
        MASS,
        SEEDED_VOLUME,
        ENERGY_GAIN,
        ENERGY_LOSS,
        PERIOD,
        FEM_MID_EDGE_ERROR,
        FEM_EDGE_MEAN_ERROR,
        FEM_TIP_ERROR,
    ];
    let stresses = MEAN_STRESSES.iter().map(|(metric, _)| *metric);
    own.into_iter().chain(stresses).collect()
}

/// What the table of results shows.
pub(super) const HEADLINES: &[Headline] = &[
    headline(FEM_MID_EDGE_ERROR, "mid-edge error (%)", 100.0, 2),
    headline(FEM_EDGE_MEAN_ERROR, "edge-mean error (%)", 100.0, 2),
    headline(FEM_TIP_ERROR, "tip error (%)", 100.0, 2),
    headline(MEAN_STRESS_RMS_ERROR, "σ_m rms error (mPa)", 1e3, 1),
    headline(CHECKERBOARD_RATIO, "checkerboard (–)", 1.0, 2),
    headline(AT_REST, "at rest (1: yes)", 1.0, 0),
    headline(REST_TIME, "time at the end (s)", 1.0, 0),
    headline(CREEP_RATE, "creep of ln(J/J̄) (10⁻⁶/s)", 1e6, 2),
    headline(LOG_JACOBIAN_GAP, "ln(J/J̄) at the end (10⁻⁴)", 1e4, 2),
];
