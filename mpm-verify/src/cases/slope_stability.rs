//! The factor by which the strength of a slope can be divided before it fails.
//!
//! The section and the elasticity of the landslide with perfect plasticity: no softening, so that limit analysis says what
//! is right. Set-up, choices and tolerances: `docs/slope-stability.md`.

mod checks;
mod simulation;

use crate::case::{
    Case, CheckInfo, Headline, Job, Level, MetricInfo, Quantity, RunSpec, Sweep, Tier, error,
    headline, metric, runs,
};
use crate::error::Error;
use crate::parameter::{Domain, Parameter, Parameters, number, parameter};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::sketch::Sketch;
use crate::verdict::Verdict;
use simulation::Simulated;

/// The stability of the landslide's slope.
pub(super) struct SlopeStability;

const LEVELS: [Level; 3] = [
    Level {
        name: "h0.4",
        h: 0.4,
    },
    Level {
        name: "h0.2",
        h: 0.2,
    },
    Level {
        name: "h0.1",
        h: 0.1,
    },
];
const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
const REMEDIES: [RemedyName; 3] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarConsistent,
];

const PARAMETERS: [Parameter; 13] = [
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
        "strength",
        "Pa",
        "40.82e3",
        number(1.0, 1e12, false),
        "strength κ = ‖s‖, √2 times the undrained shear strength",
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
        "5",
        number(1.0, 500.0, false),
        "length of the fixed floor before the toe",
    ),
    parameter(
        "most",
        "-",
        "3",
        number(1.1, 100.0, false),
        "largest factor that is tried",
    ),
    parameter(
        "trials",
        "-",
        "8",
        Domain::Integer { least: 1, most: 20 },
        "trials: the largest factor, then bisection",
    ),
    parameter(
        "cfl",
        "-",
        "0.35",
        number(1e-3, 1.0, true),
        "largest CFL number c Δt / h of pressure waves",
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

const METRICS: &[MetricInfo] = &[
    metric(
        "strength_reduction_factor",
        "-",
        "middle of the factors between which the slope first fails; the largest tried, if it stands",
    ),
    metric(
        "factor_error",
        "-",
        "relative distance of that from the factor of limit analysis, which is known to half a per cent; none where the slope stands at the largest factor or has another angle than 45°",
    ),
    metric("stands_at", "-", "largest factor at which the slope stands"),
    metric("fails_at", "-", "least factor at which it fails"),
    metric(
        "moved_standing",
        "m",
        "largest displacement since the reduction at the largest factor at which it stands",
    ),
    metric("mass", "kg/m", "mass of the ground"),
];

const HEADLINES: &[Headline] = &[
    headline("strength_reduction_factor", "factor (–)", 1.0, 3),
    headline("stands_at", "stands at", 1.0, 3),
    headline("fails_at", "fails at", 1.0, 3),
    headline("moved_standing", "moved, standing (mm)", 1e3, 1),
];

const QUANTITIES: &[Quantity] = &[error("factor_error", "relative error of the factor")];

impl Case for SlopeStability {
    fn name(&self) -> &'static str {
        "slope-stability"
    }

    fn title(&self) -> &'static str {
        "Stability of the slope"
    }

    fn description(&self) -> &'static str {
        "The slope of the landslide, without softening, under its weight. Its strength is divided by factors between which it first fails, \
         found by bisection; limit analysis gives the factor. Standard MPM locks and stands where it should fail."
    }

    fn references(&self) -> Vec<String> {
        vec!["Limit analysis (docs/exact.md): γH/c = 6.04 (6.015 to 6.078) for 45° on a firm base at the level of the toe".to_owned()]
    }

    fn limits(&self) -> &'static [&'static str] {
        &[
            "Failure is a displacement of H/50 within 4 s: a slope within half a per cent of its limit is called standing.",
            "A shear band is as wide as the cells and can't come nearer to the fixed base: the slope is too strong by about h/H.",
        ]
    }

    fn parameters(&self) -> &[Parameter] {
        &PARAMETERS
    }

    fn schemes(&self) -> Vec<Scheme> {
        let of = |basis| REMEDIES.map(|remedy| Scheme::flip(basis, remedy));
        BASES.into_iter().flat_map(of).collect()
    }

    fn levels(&self) -> &[Level] {
        &LEVELS
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
        &[]
    }

    fn watched(&self) -> &'static [&'static str] {
        &["factor", "moved"]
    }

    fn sketch(&self) -> Sketch {
        super::landslide::sketch("5 m")
    }

    fn plan(&self, tier: Tier) -> Vec<RunSpec> {
        let [h40, h20, h10] = LEVELS;
        let all = |level| runs(level, &self.schemes(), &[]);
        match tier {
            Tier::Quick | Tier::Pr => Vec::new(),
            Tier::Nightly => [all(h40), all(h20)].concat(),
            Tier::Long => all(h10),
        }
    }

    fn cost(&self, spec: &RunSpec) -> f64 {
        spec.level.h.powi(-3)
    }

    fn start(&self, spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error> {
        Ok(Box::new(Simulated::new(spec, parameters)?))
    }

    fn judge(&self, record: &Record) -> Vec<Verdict> {
        checks::judge(record)
    }

    fn judge_study(&self, records: &[Record]) -> Vec<Verdict> {
        checks::judge_study(records)
    }
}
