//! What is measured of a slide.

use crate::metric::metrics;
use crate::results::{Column, headline};

metrics! { pub(super) METRICS:
    PARTICLES = "particles", "-", "number of particles";
    PARTICLES_ACROSS = "particles_across", "-", "of them across the width";
    MASS = "mass", "kg/m", "mass at the end, per metre of width";
    BASE_REACTION_RATIO = "base_reaction_ratio", "-",
        "force on the base over the weight, in the last 0.01 s of the gravity stage";
    KINETIC_SHARE_AT_REST = "kinetic_share_at_rest", "-",
        "kinetic energy of the nodes over the stored energy at the end of the gravity stage";
    OVERBURDEN_ERROR = "overburden_error", "-",
        "rms over the particles within H/2 of the back wall of the vertical stress less the weight above, over γ H, then";
    CHECKERBOARD_AT_REST = "checkerboard_at_rest", "-", "rms of σ_m − Πσ_m over γ H, then";
    CHECKERBOARD_2_5S = "checkerboard_2.5s", "-", "likewise 2.5 s after the reduction";
    YIELDED_AT_REST = "yielded_at_rest", "-", "share of the particles that have yielded, then";
    SETTLEMENT_AT_REST = "settlement_at_rest", "m", "how far the crest's edge has sunk, then";
    RUNOUT_1S = "runout_1s", "m",
        "distance of the outermost particle, and half its spacing, from the first toe, 1 s after the reduction";
    RUNOUT_2_5S = "runout_2.5s", "m", "likewise at 2.5 s";
    RUNOUT_END = "runout_end", "m", "likewise at the end";
    BULK_RUNOUT_2_5S = "bulk_runout_2.5s", "m",
        "distance from the first toe beyond which a hundredth of the ground lies, at 2.5 s";
    BULK_RUNOUT_END = "bulk_runout_end", "m", "likewise at the end";
    SETTLEMENT_2_5S = "settlement_2.5s", "m", "how far the crest's edge has sunk at 2.5 s";
    SETTLEMENT_END = "settlement_end", "m", "likewise at the end";
    FAILED_SHARE_2_5S = "failed_share_2.5s", "-",
        "share of the ground that has moved by more than H/20 since the reduction, at 2.5 s";
    FAILED_SHARE_END = "failed_share_end", "-", "likewise at the end";
    FAILURE_TIME = "failure_time", "s", "when a hundredth of the ground has moved so far";
    RETROGRESSION_END = "retrogression_end", "m",
        "distance behind the crest's edge to which its surface has moved so far, at the end";
    SHEAR_BANDS_END = "shear_bands_end", "-",
        "peaks of the plastic strain above one half through the particles from half the height, at the end";
    REARMOST_BAND_END = "rearmost_band_end", "m",
        "how far behind the crest's edge the rearmost of them is, before any motion";
    PLASTIC_DISSIPATION = "plastic_dissipation", "J/m", "energy that flow has dissipated since the reduction";
    KINETIC_ENERGY_MAX = "kinetic_energy_max", "J/m", "largest kinetic energy";
    ENERGY_GAIN = "energy_gain", "-",
        "largest growth of kinetic and potential energy and stress work in 0.01 s, over the potential energy at the reduction";
    UNACCOUNTED_ENERGY = "unaccounted_energy", "-",
        "kinetic, potential and stored energy and dissipation at the end less those at the reduction, over the potential energy then";
    FALLEN_ENERGY = "fallen_energy", "-", "potential energy lost since the reduction, over that then";
    JACOBIAN_MIN = "jacobian_min", "-", "least J of a particle at any time";
    JACOBIAN_MAX = "jacobian_max", "-", "greatest J of a particle at any time";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at the end";
    WIDTH_SPREAD_AT_REST = "width_spread_at_rest", "-",
        "largest range over the width of the displacement of what was in one place of the section, over the largest displacement, at the end of the gravity stage";
    WIDTH_SPREAD_0_5S = "width_spread_0.5s", "-", "likewise 0.5 s after the reduction";
    WIDTH_SPREAD_END = "width_spread_end", "-", "likewise at the end";
    OFF_PLANE_STRAIN_AT_REST = "off_plane_strain_at_rest", "-",
        "relative difference of the crest's settlement from that in plane strain, at the end of the gravity stage";
    OFF_PLANE_STRAIN_0_5S = "off_plane_strain_0.5s", "-", "likewise 0.5 s after the reduction";
    OFF_PLANE_STRAIN_END = "off_plane_strain_end", "m",
        "difference of the outermost particle from that in plane strain at the end";
}

/// What the table of results shows.
pub(super) fn headlines() -> Vec<Column> {
    vec![
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
    ]
}
