//! Landslides of a slope of soft clay that loses its strength as it flows, in plane strain and in three dimensions.
//!
//! Section 4.4 of Zhao, Jiang & Choo (2022). Set-up, choices and tolerances: `docs/landslide.md`.

mod checks;
mod ground;
mod observation;
mod section;
mod simulation;
mod sketch;

pub(super) use ground::{DAMPING, Ground, RISE, STABILITY, STAGE, factor_of_safety};
pub(super) use sketch::sketch;

use super::manufactured::plan::{ladder, more_particles, other_transfers};
use crate::case::{
    Case, CheckInfo, Headline, Job, Level, MetricInfo, Quantity, RunSpec, Sweep, Tier, headline,
    metric, runs,
};
use crate::error::Error;
use crate::parameter::{Domain, Parameter, Parameters, number, parameter};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::sketch::Sketch;
use crate::verdict::Verdict;
use simulation::Simulated;
use std::sync::LazyLock;

/// The landslide in plane strain.
pub(super) struct Landslide2d;
/// The landslide in three dimensions.
pub(super) struct Landslide;

const LEVELS_2D: [Level; 4] = [
    level("h0.4", 0.4),
    level("h0.2", 0.2),
    level("h0.1", 0.1),
    level("h0.05", 0.05),
];
const LEVELS: [Level; 4] = [
    level("h0.5", 0.5),
    level("slice-h0.4", 0.4),
    level("h0.25", 0.25),
    level("h0.2", 0.2),
];

const fn level(name: &'static str, h: f64) -> Level {
    Level { name, h }
}

const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
const REMEDIES: [RemedyName; 3] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarConsistent,
];

const PARAMETERS: [Parameter; 17] = [
    parameter(
        "young_modulus",
        "Pa",
        "25e6",
        number(1e3, 1e12, false),
        "Young's modulus E",
    ),
    parameter(
        "poisson_ratio",
        "-",
        "0.499",
        number(0.0, 0.5, true),
        "Poisson's ratio",
    ),
    parameter(
        "peak_strength",
        "Pa",
        "40.82e3",
        number(1.0, 1e12, false),
        "peak strength κ_p = ‖s‖, √2 times the undrained shear strength",
    ),
    parameter(
        "residual_strength",
        "Pa",
        "2.45e3",
        number(1e-3, 1e12, false),
        "residual strength κ_r = ‖s‖; at most the reduced peak",
    ),
    parameter(
        "softening",
        "-",
        "5",
        number(0.0, 1e3, false),
        "softening coefficient η of κ = κ_r + (κ_p − κ_r) exp(−η ε)",
    ),
    parameter(
        "reduction",
        "-",
        "1.65",
        number(1.0, 100.0, false),
        "factor by which the peak strength is divided after the gravity stage",
    ),
    parameter(
        "release",
        "s",
        "0",
        number(0.0, 60.0, false),
        "time over which that factor rises from one; 0: at once",
    ),
    parameter(
        "density",
        "kg/m³",
        "2150",
        number(1e-3, 1e5, false),
        "density ρ",
    ),
    parameter("height", "m", "5", number(0.5, 100.0, false), "height H"),
    parameter(
        "crest",
        "m",
        "10",
        number(0.5, 200.0, false),
        "length of the crest behind the face",
    ),
    parameter(
        "face_angle",
        "°",
        "45",
        number(5.0, 90.0, false),
        "angle of the face against the horizontal",
    ),
    parameter(
        "floor",
        "m",
        "30",
        number(1.0, 500.0, false),
        "length of the fixed floor before the toe",
    ),
    parameter(
        "duration",
        "s",
        "5.5",
        number(0.01, 60.0, false),
        "time after the reduction, or from where it begins",
    ),
    parameter(
        "damping",
        "-",
        "0",
        number(0.0, 1.0, true),
        "local damping after the reduction: with it the slope moves without inertia",
    ),
    parameter(
        "cfl",
        "-",
        "0.35",
        number(1e-3, 1.0, true),
        "largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.01 s, 5·10⁻⁵ s at h = 0.2 m",
    ),
    parameter(
        "wall",
        "-",
        "open-knot",
        Domain::Choice(&["open-knot", "wall-line"]),
        "how B-splines meet floor and walls",
    ),
    parameter(
        "ppc_per_direction",
        "-",
        "2",
        Domain::Integer { least: 1, most: 8 },
        "particles per cell and direction",
    ),
];

/// Those in three dimensions.
static PARAMETERS_3D: LazyLock<Vec<Parameter>> = LazyLock::new(|| {
    let width = parameter(
        "width",
        "m",
        "0",
        number(0.0, 1000.0, false),
        "width, a whole number of cells; 0 stands for that of the level: 5 m, of a slice four cells",
    );
    [&PARAMETERS[..], &[width]].concat()
});

const METRICS: &[MetricInfo] = &[
    metric("particles", "-", "number of particles"),
    metric("particles_across", "-", "of them across the width"),
    metric("mass", "kg/m", "mass at the end, per metre of width"),
    metric(
        "base_reaction_ratio",
        "-",
        "force on the base over the weight, in the last 0.01 s of the gravity stage",
    ),
    metric(
        "kinetic_share_at_rest",
        "-",
        "kinetic energy of the nodes over the stored energy at the end of the gravity stage",
    ),
    metric(
        "overburden_error",
        "-",
        "rms over the particles within H/2 of the back wall of the vertical stress less the weight above, over γ H, then",
    ),
    metric(
        "checkerboard_at_rest",
        "-",
        "rms of σ_m − Πσ_m over γ H, then",
    ),
    metric(
        "checkerboard_2.5s",
        "-",
        "likewise 2.5 s after the reduction",
    ),
    metric(
        "yielded_at_rest",
        "-",
        "share of the particles that have yielded, then",
    ),
    metric(
        "settlement_at_rest",
        "m",
        "how far the crest's edge has sunk, then",
    ),
    metric(
        "runout_1s",
        "m",
        "distance of the outermost particle, and half its spacing, from the first toe, 1 s after the reduction",
    ),
    metric("runout_2.5s", "m", "likewise at 2.5 s"),
    metric("runout_end", "m", "likewise at the end"),
    metric(
        "bulk_runout_2.5s",
        "m",
        "distance from the first toe beyond which a hundredth of the ground lies, at 2.5 s",
    ),
    metric("bulk_runout_end", "m", "likewise at the end"),
    metric(
        "settlement_2.5s",
        "m",
        "how far the crest's edge has sunk at 2.5 s",
    ),
    metric("settlement_end", "m", "likewise at the end"),
    metric(
        "failed_share_2.5s",
        "-",
        "share of the ground that has moved by more than H/20 since the reduction, at 2.5 s",
    ),
    metric("failed_share_end", "-", "likewise at the end"),
    metric(
        "failure_time",
        "s",
        "when a hundredth of the ground has moved so far",
    ),
    metric(
        "retrogression_end",
        "m",
        "distance behind the crest's edge to which its surface has moved so far, at the end",
    ),
    metric(
        "shear_bands_end",
        "-",
        "peaks of the plastic strain above one half through the particles from half the height, at the end",
    ),
    metric(
        "rearmost_band_end",
        "m",
        "how far behind the crest's edge the rearmost of them is, before any motion",
    ),
    metric(
        "plastic_dissipation",
        "J/m",
        "energy that flow has dissipated since the reduction",
    ),
    metric("kinetic_energy_max", "J/m", "largest kinetic energy"),
    metric(
        "energy_gain",
        "-",
        "largest growth of kinetic and potential energy and stress work in 0.01 s, over the potential energy at the reduction",
    ),
    metric(
        "unaccounted_energy",
        "-",
        "kinetic, potential and stored energy and dissipation at the end less those at the reduction, over the potential energy then",
    ),
    metric(
        "fallen_energy",
        "-",
        "potential energy lost since the reduction, over that then",
    ),
    metric("jacobian_min", "-", "least J of a particle at any time"),
    metric("jacobian_max", "-", "greatest J of a particle at any time"),
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end"),
    metric(
        "width_spread_at_rest",
        "-",
        "largest range over the width of the displacement of what was in one place of the section, over the largest displacement, at the end of the gravity stage",
    ),
    metric(
        "width_spread_0.5s",
        "-",
        "likewise 0.5 s after the reduction",
    ),
    metric("width_spread_end", "-", "likewise at the end"),
    metric(
        "off_plane_strain_at_rest",
        "-",
        "relative difference of the crest's settlement from that in plane strain, at the end of the gravity stage",
    ),
    metric(
        "off_plane_strain_0.5s",
        "-",
        "likewise 0.5 s after the reduction",
    ),
    metric(
        "off_plane_strain_end",
        "m",
        "difference of the outermost particle from that in plane strain at the end",
    ),
];

const HEADLINES: &[Headline] = &[
    headline("runout_2.5s", "run-out at 2.5 s (m)", 1.0, 2),
    headline("runout_end", "run-out at the end (m)", 1.0, 2),
    headline("bulk_runout_end", "of the bulk (m)", 1.0, 2),
    headline("settlement_end", "settlement (m)", 1.0, 2),
    headline("failed_share_end", "failed (%)", 100.0, 1),
    headline("failure_time", "fails at (s)", 1.0, 2),
    headline("retrogression_end", "retrogression (m)", 1.0, 2),
    headline("shear_bands_end", "shear bands", 1.0, 0),
    headline("checkerboard_at_rest", "σ_m − Πσ_m at rest (γH)", 1.0, 4),
    headline("unaccounted_energy", "unaccounted energy (%)", 100.0, 2),
    headline("log_jacobian_gap", "ln(J/J̄) (–)", 1.0, 4),
];

const QUANTITIES: &[Quantity] = &[Quantity {
    metric: "runout_2.5s",
    label: "run-out at 2.5 s (m)",
    is_error: false,
}];

const SWEEPS: &[Sweep] = &[
    Sweep {
        parameter: "reduction",
        label: "reduction of the peak strength (–)",
        abscissa: |reduction| reduction,
        logarithmic: false,
    },
    Sweep {
        parameter: "cfl",
        label: "CFL number (–)",
        abscissa: |cfl| cfl,
        logarithmic: true,
    },
];

const LIMITS: &[&str] = &[
    "Softening is local: shear bands are as thin as the cells allow, and what flows after the onset depends on their size.",
    "The reduced slope stands at a factor of safety of one: which scheme and level tips is part of the answer.",
    "The clay is undrained; nothing drains, and nothing cracks. Its averaged volume is kept; that of single particles in the flow is not (J).",
];

fn references() -> Vec<String> {
    vec![
        "Zhao, Jiang & Choo (2022), section 4.4, Figures 14 to 16: in kind; the paper gives no numbers but those of the set-up".to_owned(),
        "Limit analysis (docs/exact.md): γH/c = 6.04 (6.015 to 6.078) for 45° on a firm base, so the slope's factor of safety is 1.65 before and 1.00 after the reduction".to_owned(),
    ]
}

fn schemes() -> Vec<Scheme> {
    let of = |basis| REMEDIES.map(|remedy| Scheme::flip(basis, remedy));
    BASES.into_iter().flat_map(of).collect()
}

fn cost(spec: &RunSpec, dimension: i32) -> f64 {
    let sweep = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => 1.2,
        RemedyName::FbarConsistent => 1.7,
    };
    let short = spec.set.iter().any(|set| set.starts_with("duration="));
    sweep / spec.level.h.powi(dimension + 1) / if short { 3.0 } else { 1.0 }
}

/// What both cases share.
macro_rules! shared {
    () => {
        fn references(&self) -> Vec<String> {
            references()
        }

        fn limits(&self) -> &'static [&'static str] {
            LIMITS
        }

        fn metrics(&self) -> &'static [MetricInfo] {
            METRICS
        }

        fn checks(&self) -> &'static [CheckInfo] {
            checks::CHECKS
        }

        fn headlines(&self) -> &'static [Headline] {
            HEADLINES
        }

        fn quantities(&self) -> &'static [Quantity] {
            QUANTITIES
        }

        fn sweeps(&self) -> &'static [Sweep] {
            SWEEPS
        }

        fn watched(&self) -> &'static [&'static str] {
            &["toe", "settlement", "kinetic_energy", "failed_share"]
        }

        fn breaks_down(&self, record: &Record) -> Option<&'static str> {
            checks::breaks_down(record)
        }

        fn judge(&self, record: &Record) -> Vec<Verdict> {
            checks::judge(record)
        }

        fn judge_study(&self, records: &[Record]) -> Vec<Verdict> {
            checks::judge_study(records)
        }
    };
}

impl Case for Landslide2d {
    shared!();

    fn schemes(&self) -> Vec<Scheme> {
        [schemes(), other_transfers()].concat()
    }

    fn name(&self) -> &'static str {
        "landslide-2d"
    }

    fn title(&self) -> &'static str {
        "Landslide in plane strain"
    }

    fn description(&self) -> &'static str {
        "A slope of clay, 5 m high at 45°, under its weight. Its peak strength is divided by 1.65; it softens as it flows. \
         The section of the landslide in three dimensions, for studies of cell size, remedy and time step."
    }

    fn parameters(&self) -> &[Parameter] {
        &PARAMETERS
    }

    fn levels(&self) -> &[Level] {
        &LEVELS_2D
    }

    fn sketch(&self) -> Sketch {
        sketch("5 m")
    }

    fn plan(&self, tier: Tier) -> Vec<RunSpec> {
        plan_2d(tier)
    }

    fn cost(&self, spec: &RunSpec) -> f64 {
        cost(spec, 2)
    }

    fn start(&self, spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error> {
        Ok(Box::new(Simulated::<2>::new(spec, parameters)?))
    }
}

impl Case for Landslide {
    shared!();

    fn schemes(&self) -> Vec<Scheme> {
        schemes()
    }

    fn name(&self) -> &'static str {
        "landslide"
    }

    fn title(&self) -> &'static str {
        "Landslide"
    }

    fn description(&self) -> &'static str {
        "A slope of clay, 5 m high at 45° and 5 m wide between smooth walls, under its weight. Its peak strength is divided by \
         1.65; it softens as it flows and slides out onto a rough floor. Standard MPM locks: with GIMP it stands."
    }

    fn parameters(&self) -> &[Parameter] {
        &PARAMETERS_3D
    }

    fn levels(&self) -> &[Level] {
        &LEVELS
    }

    fn sketch(&self) -> Sketch {
        sketch("5 m, 5 m wide")
    }

    fn plan(&self, tier: Tier) -> Vec<RunSpec> {
        plan_3d(tier)
    }

    fn cost(&self, spec: &RunSpec) -> f64 {
        let across = if spec.level.name.starts_with("slice") {
            0.3
        } else {
            1.0
        };
        across * cost(spec, 3)
    }

    fn start(&self, spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error> {
        Ok(Box::new(Simulated::<3>::new(spec, parameters)?))
    }
}

fn plan_2d(tier: Tier) -> Vec<RunSpec> {
    let [h40, h20, h10, h05] = LEVELS_2D;
    let all = schemes();
    let studies = |level, sets: &[&[&str]]| -> Vec<RunSpec> {
        sets.iter()
            .flat_map(|set| runs(level, &schemes(), set))
            .collect()
    };
    match tier {
        Tier::Quick => Vec::new(),
        Tier::Pr => runs(h40, &all, &["duration=1"]),
        Tier::Nightly => [
            plan_2d(Tier::Pr),
            runs(h40, &all, &[]),
            runs(h20, &all, &[]),
            studies(h40, &[&["reduction=1", "duration=2.5"]]),
            studies(h40, &[&["reduction=1.8"], &["reduction=2"]]),
            studies(h40, &[&["cfl=0.175"], &["damping=0.7"], &["release=2"]]),
            studies(h20, &[&["reduction=1.8"], &["reduction=2"]]),
            studies(h20, &[&["cfl=0.175"], &["release=2"]]),
            runs(h10, &all, &[]),
        ]
        .concat(),
        Tier::Long => [
            studies(h20, &[&["damping=0.7"]]),
            runs(h05, &all, &[]),
            ladder(&LEVELS_2D, &other_transfers(), &[]),
            more_particles(&[h40]),
        ]
        .concat(),
    }
}

fn plan_3d(tier: Tier) -> Vec<RunSpec> {
    let [h50, slice, h25, h20] = LEVELS;
    let all = schemes();
    let early =
        [RemedyName::None, RemedyName::FbarConsistent].map(|r| Scheme::flip(BasisName::Gimp, r));
    match tier {
        Tier::Quick => Vec::new(),
        Tier::Pr => runs(slice, &early, &["duration=0.5"]),
        Tier::Nightly => [
            plan_3d(Tier::Pr),
            runs(slice, &all, &[]),
            runs(slice, &early, &["reduction=1", "duration=1"]),
            runs(slice, &early, &["reduction=2", "duration=2.5"]),
            runs(h50, &all, &[]),
            runs(h50, &all, &["width=2"]),
            runs(h25, &early, &[]),
        ]
        .concat(),
        Tier::Long => {
            let later: Vec<Scheme> = all.iter().copied().filter(|s| !early.contains(s)).collect();
            [runs(h25, &later, &[]), runs(h20, &all, &[])].concat()
        }
    }
}
