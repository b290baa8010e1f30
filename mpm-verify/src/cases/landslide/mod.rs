//! Landslides of a slope of soft clay that loses its strength as it flows, in plane strain and in three dimensions.
//!
//! Section 4.4 of Zhao, Jiang & Choo (2023).

mod checks;
mod figures;
pub(super) mod foreign;
mod look;
mod plane_strain;
mod run;
mod tables;

use super::slope::{self, REMEDIES};
use crate::cases::prelude::*;
use plane_strain::Beside;
use run::Slide;

const LEVELS_2D: [Level; 4] =
    [Level::new("h0.4", 0.4), Level::new("h0.2", 0.2), Level::new("h0.1", 0.1), Level::new("h0.05", 0.05)];
const LEVELS_3D: [Level; 4] =
    [Level::new("h0.5", 0.5), Level::new("slice-h0.4", 0.4), Level::new("h0.25", 0.25), Level::new("h0.2", 0.2)];
const REDUCTION: Parameter = real("-", "1.65", 1.0, 100.0)
    .named("reduction")
    .meaning("factor by which the peak strength is divided after the gravity stage");

parameters! {
    struct Landslide {
        young_modulus: f64 = slope::YOUNG_MODULUS;
        poisson_ratio: f64 = slope::POISSON_RATIO;
        peak_strength: f64 = real("Pa", "40.82e3", 1.0, 1e12), "peak strength κ_p = ‖s‖, √2 times the undrained shear strength";
        residual_strength: f64 = real("Pa", "2.45e3", 1e-3, 1e12), "residual strength κ_r = ‖s‖; at most the reduced peak";
        softening: f64 = real("-", "5", 0.0, 1e3), "softening coefficient η of κ = κ_r + (κ_p − κ_r) exp(−η ε)";
        reduction: f64 = REDUCTION;
        release: f64 = real("s", "0", 0.0, 60.0), "time over which that factor rises from one; 0: at once";
        density: f64 = slope::DENSITY;
        height: f64 = slope::HEIGHT;
        crest: f64 = slope::CREST;
        face_angle: f64 = slope::FACE_ANGLE;
        floor: f64 = slope::FLOOR;
        duration: f64 = real("s", "5.5", 0.01, 60.0), "time after the reduction, or from where it begins";
        damping: f64 = common::DAMPING, "local damping after the reduction: with it the slope moves without inertia";
        cfl: f64 = slope::CFL;
        wall: common::Wall = slope::WALL;
        ppc_per_direction: usize = slope::PPC_PER_DIRECTION;
        width: f64 = real("m", "0", 0.0, 1000.0), "width, a whole number of cells; 0 stands for that of the level: 5 m, of a slice four cells";
    }
}

metrics! { ALL:
    PARTICLES = "particles", "-", "number of particles";
    PARTICLES_ACROSS = "particles_across", "-", "of them across the width";
    MASS = "mass", "kg/m", "mass at the end, per metre of width";
    BASE_REACTION_RATIO = "base_reaction_ratio", "-", "force on the base over the weight, in the last 0.01 s of the gravity stage";
    KINETIC_SHARE_AT_REST = "kinetic_share_at_rest", "-", "kinetic energy of the nodes over the stored energy at the end of the gravity stage";
    OVERBURDEN_ERROR = "overburden_error", "-", "rms over the particles within H/2 of the back wall of the vertical stress less the weight above, over γ H, then";
    CHECKERBOARD_AT_REST = "checkerboard_at_rest", "-", "rms of σ_m − Πσ_m over γ H, then";
    CHECKERBOARD_2_5S = "checkerboard_2.5s", "-", "rms of σ_m − Πσ_m over γ H, 2.5 s after the reduction";
    YIELDED_AT_REST = "yielded_at_rest", "-", "share of the particles that have yielded, then";
    SETTLEMENT_AT_REST = "settlement_at_rest", "m", "how far the crest's edge has sunk, then";
    RUNOUT_1S = "runout_1s", "m", "distance of the outermost particle, and half its spacing, from the first toe, 1 s after the reduction";
    RUNOUT_2_5S = "runout_2.5s", "m", "distance of the outermost particle, and half its spacing, from the first toe, 2.5 s after the reduction";
    RUNOUT_END = "runout_end", "m", "distance of the outermost particle, and half its spacing, from the first toe, at the end";
    BULK_RUNOUT_2_5S = "bulk_runout_2.5s", "m", "distance from the first toe beyond which a hundredth of the ground lies, at 2.5 s";
    BULK_RUNOUT_END = "bulk_runout_end", "m", "distance from the first toe beyond which a hundredth of the ground lies, at the end";
    SETTLEMENT_2_5S = "settlement_2.5s", "m", "how far the crest's edge has sunk at 2.5 s";
    SETTLEMENT_END = "settlement_end", "m", "settlement of the crest's edge at the end";
    FAILED_SHARE_2_5S = "failed_share_2.5s", "-", "share of the ground that has moved by more than H/20 since the reduction, at 2.5 s";
    FAILED_SHARE_END = "failed_share_end", "-", "share of the ground that has moved by more than H/20 since the reduction, at the end";
    FAILURE_TIME = "failure_time", "s", "when a hundredth of the ground has moved so far";
    RETROGRESSION_END = "retrogression_end", "m", "distance behind the crest's edge to which its surface has moved so far, at the end";
    SHEAR_BANDS_END = "shear_bands_end", "-", "peaks of the plastic strain above one half through the particles from half the height, at the end";
    REARMOST_BAND_END = "rearmost_band_end", "m", "how far behind the crest's edge the rearmost of them is, before any motion";
    PLASTIC_DISSIPATION = "plastic_dissipation", "J/m", "energy that flow has dissipated since the reduction";
    KINETIC_ENERGY_MAX = "kinetic_energy_max", "J/m", "largest kinetic energy";
    ENERGY_GAIN = "energy_gain", "-", "largest growth of kinetic and potential energy and stress work in 0.01 s, over the potential energy at the reduction";
    UNACCOUNTED_ENERGY = "unaccounted_energy", "-", "kinetic, potential and stored energy and dissipation at the end less those at the reduction, over the potential energy then";
    FALLEN_ENERGY = "fallen_energy", "-", "potential energy lost since the reduction, over that then";
    JACOBIAN_MIN = "jacobian_min", "-", "least J of a particle at any time";
    JACOBIAN_MAX = "jacobian_max", "-", "greatest J of a particle at any time";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at the end";
    WIDTH_SPREAD_AT_REST = "width_spread_at_rest", "-",
        "largest range over the width of the displacement of what was in one place of the section, over the largest displacement, at the end of the gravity stage";
    WIDTH_SPREAD_0_5S = "width_spread_0.5s", "-", "width_spread_at_rest, 0.5 s after the reduction instead";
    WIDTH_SPREAD_END = "width_spread_end", "-", "width_spread_at_rest, at the end instead";
    OFF_PLANE_STRAIN_AT_REST = "off_plane_strain_at_rest", "-", "relative difference of the crest's settlement from that in plane strain, at the end of the gravity stage";
    OFF_PLANE_STRAIN_0_5S = "off_plane_strain_0.5s", "-", "relative difference of the crest's settlement from that in plane strain, 0.5 s after the reduction";
    OFF_PLANE_STRAIN_END = "off_plane_strain_end", "m", "difference of the outermost particle from that in plane strain at the end";
}

fn cost(spec: &RunSpec, dimension: i32) -> f64 {
    let sweep = remedy_cost(spec, [1.0, 1.2, 1.2, 1.2, 1.7]);
    let short = spec.set.iter().any(|set| set.starts_with("duration="));
    let across = if spec.level.name.starts_with("slice") { 0.3 } else { 1.0 };
    across * sweep / spec.level.h.powi(dimension + 1) / if short { 3.0 } else { 1.0 }
}

fn case_of(
    [name, title, description, size]: [&'static str; 4],
    dimension: i32,
    parameters: Vec<Parameter>,
    begin: Begin,
) -> Case {
    Case::begun_by(name, title, ALL, parameters, begin)
        .described(description)
        .reference("Zhao, Jiang & Choo (2023), section 4.4, Figures 14 to 16: in kind; the paper gives no numbers but those of the set-up")
        .reference("Limit analysis (docs/exact.md): γH/c = 6.04 (6.015 to 6.078) for 45° on a firm base, so the slope's factor of safety is 1.65 before and 1.00 after the reduction")
        .limit("Softening is local: shear bands are as thin as the cells allow, and what flows after the onset depends on their size.")
        .limit("The reduced slope stands at a factor of safety of one: which scheme and level tips is part of the answer.")
        .limit("The clay is undrained; nothing drains, and nothing cracks. Its averaged volume is kept; that of single particles in the flow is not (J).")
        .wanted("geostatic-stress", "vertical stress far from the face after the gravity stage", "overburden")
        .missed_by("locked-stress")
        .wanted("stability", "whether the slope fails", "stands fails")
        .missed_by("locked")
        .where_referenced()
        .checks(checks::checks())
        .headline(RUNOUT_2_5S, "run-out at 2.5 s (m)", 1.0, 2)
        .headline(RUNOUT_END, "run-out at the end (m)", 1.0, 2)
        .headline(BULK_RUNOUT_END, "of the bulk (m)", 1.0, 2)
        .headline(SETTLEMENT_END, "settlement (m)", 1.0, 2)
        .headline(FAILED_SHARE_END, "failed (%)", 100.0, 1)
        .headline(FAILURE_TIME, "fails at (s)", 1.0, 2)
        .headline(RETROGRESSION_END, "retrogression (m)", 1.0, 2)
        .headline(SHEAR_BANDS_END, "shear bands", 1.0, 0)
        .headline(CHECKERBOARD_AT_REST, "σ_m − Πσ_m at rest (γH)", 1.0, 4)
        .headline(UNACCOUNTED_ENERGY, "unaccounted energy (%)", 100.0, 2)
        .headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 4)
        .quantity(value(RUNOUT_2_5S, "run-out at 2.5 s (m)"))
        .sweep(Sweep::of(REDUCTION, "reduction of the peak strength (–)"))
        .sweep(Sweep::of(slope::CFL, "CFL number (–)").logarithmic())
        .watched(&["toe", "settlement", "kinetic_energy", "failed_share"])
        .sketch(slope::sketch(size))
        .cost(move |spec| cost(spec, dimension))
        .pictures(figures::draw)
        .breaks_down(checks::breaks_down)
}

pub(super) fn plane_case() -> Case {
    const TEXTS: [&str; 4] = [
        "landslide-2d",
        "Landslide in plane strain",
        "A slope of clay, 5 m high at 45°, under its weight. Its peak strength is divided by 1.65; it softens as it flows. \
         The section of the landslide in three dimensions, for studies of cell size, remedy and time step.",
        "5 m",
    ];
    let in_plane = |p: &Parameter| p.name != "width";
    let parameters = Landslide::list().into_iter().filter(in_plane).collect();
    let begin = Box::new(problem::begin::<2, Slide<2>>);
    let strain = ["plastic_strain", "plastic strain after 1 s (-)"];
    case_of(TEXTS, 2, parameters, begin)
        .planned(plan_2d())
        .field(FieldView::at(1.0, strain, (0.0, 0.004), [(0.0, 16.0), (0.0, 5.0)]))
        .tables(tables::in_plane())
}

pub(super) fn case() -> Case {
    const TEXTS: [&str; 4] = [
        "landslide",
        "Landslide",
        "A slope of clay, 5 m high at 45° and 5 m wide between smooth walls, under its weight. Its peak strength is divided by \
         1.65; it softens as it flows and slides out onto a rough floor. Standard MPM locks: with GIMP it stands.",
        "5 m, 5 m wide",
    ];
    let begin: Begin = Box::new(|spec, values| Ok(Box::new(Beside::new(spec, values)?)));
    case_of(TEXTS, 3, Landslide::list(), begin).planned(plan_3d()).tables(vec![tables::in_space()])
}

fn plan_2d() -> Plan {
    let all = pairs(&[Gimp, Bspline2], &REMEDIES);
    let levels = "h0.4 h0.2 h0.1 h0.05";
    Plan::of(LEVELS_2D)
        .runs(Pr, "h0.4", &all, "duration=1")
        .runs(Nightly, "h0.4 h0.2", &all, "")
        .runs(Nightly, "h0.4", &all, "reduction=1 duration=2.5")
        .each(Nightly, "h0.4", &all, ["reduction=1.8", "reduction=2", "cfl=0.175", "release=2"])
        .each(Long, "h0.2", &all, ["reduction=1.8", "reduction=2", "cfl=0.175", "release=2"])
        .runs(Nightly, "h0.4", &all, "damping=0.7")
        .runs(Long, "h0.2", &all, "damping=0.7")
        .runs(Long, "h0.1 h0.05", &all, "")
        .runs(Long, levels, &other_transfers(), "")
        .each(Long, "h0.4", &main_pairs(), ["ppc_per_direction=3", "ppc_per_direction=4"])
}

fn plan_3d() -> Plan {
    let all = pairs(&[Gimp, Bspline2], &REMEDIES);
    let early = pairs(&[Gimp], &[RemedyName::None, FbarConsistent]);
    Plan::of(LEVELS_3D)
        // A narrow slice before a short floor, from under rising gravity to just after the reduction, by long steps.
        .runs(Pr, "h0.5", &early, "width=2 floor=3 duration=0.06 cfl=0.6")
        .runs(Nightly, "slice-h0.4", &early, "duration=0.5")
        .runs(Nightly, "slice-h0.4", &all, "")
        .each(Long, "slice-h0.4", &early, ["reduction=1 duration=1", "reduction=2 duration=2.5"])
        .runs(Nightly, "h0.5", &early, "")
        .each(Long, "h0.5", &all, ["", "width=2"])
        .runs(Long, "h0.25 h0.2", &all, "")
}
