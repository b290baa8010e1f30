//! What is measured of a footing.

use crate::metric::{Metric, metrics};
use crate::results::{Column, headline};

metrics! { pub(super) OWN:
    NC_B = "nc_b", "-",
        "bearing capacity factor q/s_u with the pressure q = F/(B/2), mean over the last quarter of the penetration";
    NC_B_PLUS_H = "nc_b_plus_h", "-",
        "likewise with q = F/((B + h)/2): a footing of held nodes on grid lines ends between a held and a free node";
    NC_EFFECTIVE = "nc_effective", "-",
        "likewise with the width that the held nodes of the scheme act with: B for quadratic splines, whose nodes lie in the middle of cells, B + h for GIMP, B + h/2 for cubic ones";
    PRANDTL_ERROR = "prandtl_error", "-",
        "relative distance of nc_b from 2 + π: the error of the contact pressure";
    NC_PEAK = "nc_peak", "-", "largest q/s_u of the run, by B";
    PLATEAU_RISE = "plateau_rise", "-",
        "relative growth of the load per 10⁻³ of s/B over the last quarter of the penetration";
    ELASTIC_SLOPE = "elastic_slope", "-",
        "d(q/s_u)/d(s/B) by B, a straight line fitted to all rows after the start; elastic in runs of great strength";
    FORCE_IMBALANCE = "force_imbalance", "-",
        "force on the base over that on the footing, less one, mean over the last quarter: inertia";
    MECHANISM_WIDTH = "mechanism_width", "B",
        "half the width of the ground that rises while the footing sinks: where the surface rises by half of what it does in Prandtl's mechanism (Hill's, if smooth)";
    HEAVE = "heave", "-",
        "mean rise of the surface from 0.75 B to 1.25 B while the footing sinks by one: one half in Prandtl's mechanism";
    MEAN_STRESS_RMS = "mean_stress_rms", "Pa", "rms over all particles of the mean normal stress";
    CHECKERBOARD_RMS = "checkerboard_rms", "Pa", "rms over all particles of σ_m − Πσ_m";
    CHECKERBOARD_RATIO = "checkerboard_ratio", "-", "checkerboard_rms over mean_stress_rms";
    PLASTIC_STRAIN_MAX = "plastic_strain_max", "-", "largest equivalent plastic strain of a particle";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at the end";
    MASS = "mass", "kg/m", "mass of the particles";
    NEWTON_ITERATIONS = "newton_iterations", "-", "quasi-static: Newton's iterations";
    LINEAR_ITERATIONS = "linear_iterations", "-", "quasi-static: those of linear solutions";
}

metrics! {
    /// The load on the way, with the penetrations over B at which it is measured.
    pub(super) CURVE at f64:
    3e-4 => "nc_0.0003", "-", "q/s_u by B at s/B = 0.0003";
    5e-4 => "nc_0.0005", "-", "q/s_u by B at s/B = 0.0005";
    1e-3 => "nc_0.001", "-", "q/s_u by B at s/B = 0.001";
    1.5e-3 => "nc_0.0015", "-", "q/s_u by B at s/B = 0.0015";
    2e-3 => "nc_0.002", "-", "q/s_u by B at s/B = 0.002";
    3e-3 => "nc_0.003", "-", "q/s_u by B at s/B = 0.003";
}

metrics! {
    /// The mean normal stress at material points (in B, the surface at zero).
    pub(super) MEAN_STRESSES at [f64; 2]:
    [0.25, -0.25] => "mean_stress_0.25_0.25", "-",
        "mean normal stress over s_u at the end at the material point 0.25 B from the axis and 0.25 B deep, by a linear fit over the particles within 2h";
    [0.25, -0.5] => "mean_stress_0.25_0.5", "-", "likewise at 0.25 B from the axis and 0.5 B deep";
    [0.75, -0.25] => "mean_stress_0.75_0.25", "-", "likewise at 0.75 B from the axis and 0.25 B deep";
    [1.0, -0.25] => "mean_stress_1_0.25", "-", "likewise at 1 B from the axis and 0.25 B deep";
    [0.25, -1.0] => "mean_stress_0.25_1", "-", "likewise at 0.25 B from the axis and 1 B deep";
}

/// All of them.
pub(super) fn all() -> Vec<Metric> {
    let curve = CURVE.iter().map(|(metric, _)| *metric);
    let stresses = MEAN_STRESSES.iter().map(|(metric, _)| *metric);
    OWN.iter().copied().chain(curve).chain(stresses).collect()
}

/// What the table of results shows.
pub(super) fn headlines() -> Vec<Column> {
    vec![
        headline(NC_B, "N_c by B (–)", 1.0, 3),
        headline(NC_B_PLUS_H, "N_c by B + h (–)", 1.0, 3),
        headline(NC_EFFECTIVE, "N_c by effective width (–)", 1.0, 3),
        headline(PLATEAU_RISE, "rise (%/10⁻³)", 100.0, 2),
        headline(ELASTIC_SLOPE, "slope (–)", 1.0, 0),
        headline(FORCE_IMBALANCE, "imbalance (%)", 100.0, 2),
        headline(MECHANISM_WIDTH, "mechanism (B)", 1.0, 2),
        headline(CHECKERBOARD_RATIO, "checkerboard (–)", 1.0, 2),
        headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (10⁻⁶)", 1e6, 2),
        headline(NEWTON_ITERATIONS, "iterations", 1.0, 0),
    ]
}
