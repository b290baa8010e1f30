//! What is measured of a slide.

use crate::metric::{Headline, Metric, headline, metric};

pub(super) const PARTICLES: Metric = metric("particles", "-", "number of particles");
pub(super) const PARTICLES_ACROSS: Metric =
    metric("particles_across", "-", "of them across the width");
pub(super) const MASS: Metric = metric("mass", "kg/m", "mass at the end, per metre of width");
pub(super) const BASE_REACTION_RATIO: Metric = metric(
    "base_reaction_ratio",
    "-",
    "force on the base over the weight, in the last 0.01 s of the gravity stage",
);
pub(super) const KINETIC_SHARE_AT_REST: Metric = metric(
    "kinetic_share_at_rest",
    "-",
    "kinetic energy of the nodes over the stored energy at the end of the gravity stage",
);
pub(super) const OVERBURDEN_ERROR: Metric = metric(
    "overburden_error",
    "-",
    "rms over the particles within H/2 of the back wall of the vertical stress less the weight above, over γ H, then",
);
pub(super) const CHECKERBOARD_AT_REST: Metric = metric(
    "checkerboard_at_rest",
    "-",
    "rms of σ_m − Πσ_m over γ H, then",
);
pub(super) const CHECKERBOARD_2_5S: Metric = metric(
    "checkerboard_2.5s",
    "-",
    "likewise 2.5 s after the reduction",
);
pub(super) const YIELDED_AT_REST: Metric = metric(
    "yielded_at_rest",
    "-",
    "share of the particles that have yielded, then",
);
pub(super) const SETTLEMENT_AT_REST: Metric = metric(
    "settlement_at_rest",
    "m",
    "how far the crest's edge has sunk, then",
);
pub(super) const RUNOUT_1S: Metric = metric(
    "runout_1s",
    "m",
    "distance of the outermost particle, and half its spacing, from the first toe, 1 s after the reduction",
);
pub(super) const RUNOUT_2_5S: Metric = metric("runout_2.5s", "m", "likewise at 2.5 s");
pub(super) const RUNOUT_END: Metric = metric("runout_end", "m", "likewise at the end");
pub(super) const BULK_RUNOUT_2_5S: Metric = metric(
    "bulk_runout_2.5s",
    "m",
    "distance from the first toe beyond which a hundredth of the ground lies, at 2.5 s",
);
pub(super) const BULK_RUNOUT_END: Metric = metric("bulk_runout_end", "m", "likewise at the end");
pub(super) const SETTLEMENT_2_5S: Metric = metric(
    "settlement_2.5s",
    "m",
    "how far the crest's edge has sunk at 2.5 s",
);
pub(super) const SETTLEMENT_END: Metric = metric("settlement_end", "m", "likewise at the end");
pub(super) const FAILED_SHARE_2_5S: Metric = metric(
    "failed_share_2.5s",
    "-",
    "share of the ground that has moved by more than H/20 since the reduction, at 2.5 s",
);
pub(super) const FAILED_SHARE_END: Metric = metric("failed_share_end", "-", "likewise at the end");
pub(super) const FAILURE_TIME: Metric = metric(
    "failure_time",
    "s",
    "when a hundredth of the ground has moved so far",
);
pub(super) const RETROGRESSION_END: Metric = metric(
    "retrogression_end",
    "m",
    "distance behind the crest's edge to which its surface has moved so far, at the end",
);
pub(super) const SHEAR_BANDS_END: Metric = metric(
    "shear_bands_end",
    "-",
    "peaks of the plastic strain above one half through the particles from half the height, at the end",
);
pub(super) const REARMOST_BAND_END: Metric = metric(
    "rearmost_band_end",
    "m",
    "how far behind the crest's edge the rearmost of them is, before any motion",
);
pub(super) const PLASTIC_DISSIPATION: Metric = metric(
    "plastic_dissipation",
    "J/m",
    "energy that flow has dissipated since the reduction",
);
pub(super) const KINETIC_ENERGY_MAX: Metric =
    metric("kinetic_energy_max", "J/m", "largest kinetic energy");
pub(super) const ENERGY_GAIN: Metric = metric(
    "energy_gain",
    "-",
    "largest growth of kinetic and potential energy and stress work in 0.01 s, over the potential energy at the reduction",
);
pub(super) const UNACCOUNTED_ENERGY: Metric = metric(
    "unaccounted_energy",
    "-",
    "kinetic, potential and stored energy and dissipation at the end less those at the reduction, over the potential energy then",
);
pub(super) const FALLEN_ENERGY: Metric = metric(
    "fallen_energy",
    "-",
    "potential energy lost since the reduction, over that then",
);
pub(super) const JACOBIAN_MIN: Metric =
    metric("jacobian_min", "-", "least J of a particle at any time");
pub(super) const JACOBIAN_MAX: Metric =
    metric("jacobian_max", "-", "greatest J of a particle at any time");
pub(super) const LOG_JACOBIAN_GAP: Metric =
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end");
pub(super) const WIDTH_SPREAD_AT_REST: Metric = metric(
    "width_spread_at_rest",
    "-",
    "largest range over the width of the displacement of what was in one place of the section, over the largest displacement, at the end of the gravity stage",
);
pub(super) const WIDTH_SPREAD_0_5S: Metric = metric(
    "width_spread_0.5s",
    "-",
    "likewise 0.5 s after the reduction",
);
pub(super) const WIDTH_SPREAD_END: Metric = metric("width_spread_end", "-", "likewise at the end");
pub(super) const OFF_PLANE_STRAIN_AT_REST: Metric = metric(
    "off_plane_strain_at_rest",
    "-",
    "relative difference of the crest's settlement from that in plane strain, at the end of the gravity stage",
);
pub(super) const OFF_PLANE_STRAIN_0_5S: Metric = metric(
    "off_plane_strain_0.5s",
    "-",
    "likewise 0.5 s after the reduction",
);
pub(super) const OFF_PLANE_STRAIN_END: Metric = metric(
    "off_plane_strain_end",
    "m",
    "difference of the outermost particle from that in plane strain at the end",
);

pub(super) const METRICS: &[Metric] = &[
    PARTICLES,
    PARTICLES_ACROSS,
    MASS,
    BASE_REACTION_RATIO,
    KINETIC_SHARE_AT_REST,
    OVERBURDEN_ERROR,
    CHECKERBOARD_AT_REST,
    CHECKERBOARD_2_5S,
    YIELDED_AT_REST,
    SETTLEMENT_AT_REST,
    RUNOUT_1S,
    RUNOUT_2_5S,
    RUNOUT_END,
    BULK_RUNOUT_2_5S,
    BULK_RUNOUT_END,
    SETTLEMENT_2_5S,
    SETTLEMENT_END,
    FAILED_SHARE_2_5S,
    FAILED_SHARE_END,
    FAILURE_TIME,
    RETROGRESSION_END,
    SHEAR_BANDS_END,
    REARMOST_BAND_END,
    PLASTIC_DISSIPATION,
    KINETIC_ENERGY_MAX,
    ENERGY_GAIN,
    UNACCOUNTED_ENERGY,
    FALLEN_ENERGY,
    JACOBIAN_MIN,
    JACOBIAN_MAX,
    LOG_JACOBIAN_GAP,
    WIDTH_SPREAD_AT_REST,
    WIDTH_SPREAD_0_5S,
    WIDTH_SPREAD_END,
    OFF_PLANE_STRAIN_AT_REST,
    OFF_PLANE_STRAIN_0_5S,
    OFF_PLANE_STRAIN_END,
];

/// What the table of results shows.
pub(super) const HEADLINES: &[Headline] = &[
    headline(RUNOUT_2_5S, "run-out at 2.5 s (m)", 1.0, 2),
    headline(RUNOUT_END, "run-out at the end (m)", 1.0, 2),
    headline(BULK_RUNOUT_END, "of the bulk (m)", 1.0, 2),
    headline(SETTLEMENT_END, "settlement (m)", 1.0, 2),
    headline(FAILED_SHARE_END, "failed (%)", 100.0, 1),
    headline(FAILURE_TIME, "fails at (s)", 1.0, 2),
    headline(RETROGRESSION_END, "retrogression (m)", 1.0, 2),
    headline(SHEAR_BANDS_END, "shear bands", 1.0, 0),
    headline(CHECKERBOARD_AT_REST, "σ_m − Πσ_m at rest (γH)", 1.0, 4),
    headline(UNACCOUNTED_ENERGY, "unaccounted energy (%)", 100.0, 2),
    headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 4),
];
