//! A rigid strip footing on a cohesive, nearly incompressible ground.
//!
//! Section 4.2 of Zhao, Jiang & Choo (2022). Set-up, choices and tolerances: `docs/footing.md`.

mod checks;
mod reference;
mod simulation;
mod sketch;

use super::manufactured::plan::{ladder, other_transfers, pairs};
use crate::case::{
    Case, CheckInfo, Headline, Job, Level, MetricInfo, Quantity, RunSpec, Sweep, Tier, error,
    headline, metric,
};
use crate::error::Error;
use crate::parameter::{Domain, Parameter, Parameters, number, parameter};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::sketch::Sketch;
use crate::verdict::Verdict;
use simulation::Simulated;

pub(crate) use reference::footing_limit;

/// The strip footing.
pub(super) struct Footing;

const LEVELS: [Level; 4] = [
    Level {
        name: "b10",
        h: 1.0 / 10.0,
    },
    Level {
        name: "b20",
        h: 1.0 / 20.0,
    },
    Level {
        name: "b40",
        h: 1.0 / 40.0,
    },
    Level {
        name: "b80",
        h: 1.0 / 80.0,
    },
];

const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
const REMEDIES: [RemedyName; 4] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

const PARAMETERS: [Parameter; 16] = [
    parameter(
        "young_modulus",
        "Pa",
        "1e6",
        number(1e-3, 1e12, false),
        "Young's modulus E",
    ),
    parameter(
        "poisson_ratio",
        "-",
        "0.49",
        number(0.0, 0.5, true),
        "Poisson's ratio ν",
    ),
    parameter(
        "density",
        "kg/m³",
        "1000",
        number(1e-6, 1e6, false),
        "density ρ; it only matters for how slowly the footing must move",
    ),
    parameter(
        "undrained_strength",
        "Pa",
        "100",
        number(1e-6, 1e12, false),
        "undrained shear strength s_u of plane strain: the ground yields at ‖s‖ = √2 s_u",
    ),
    parameter(
        "domain_width",
        "B",
        "6",
        Domain::Integer { least: 2, most: 40 },
        "width of the right half of the ground, in widths of the footing",
    ),
    parameter(
        "domain_depth",
        "B",
        "6",
        Domain::Integer { least: 1, most: 40 },
        "depth of the ground, likewise",
    ),
    parameter(
        "penetration_rate",
        "m/s",
        "2e-3",
        number(1e-6, 1.0, false),
        "speed of the footing after its start",
    ),
    parameter(
        "penetration",
        "B",
        "0.004",
        number(1e-4, 0.1, false),
        "penetration at the end, in widths of the footing",
    ),
    parameter(
        "ramp",
        "s",
        "0.8",
        number(1e-6, 1e3, false),
        "time over which the footing's speed rises from zero",
    ),
    parameter(
        "damping",
        "-",
        "0.002",
        number(0.0, 1.0, true),
        "local damping factor",
    ),
    parameter(
        "cfl",
        "-",
        "0.4",
        number(1e-3, 1.0, true),
        "CFL number c Δt / h of pressure waves",
    ),
    parameter(
        "flip",
        "-",
        "1",
        number(0.0, 1.0, false),
        "PIC/FLIP blend η: 1 is FLIP",
    ),
    parameter(
        "wall",
        "-",
        "open-knot",
        Domain::Choice(&["open-knot", "wall-line"]),
        "how B-splines meet the sides and the base",
    ),
    parameter(
        "contact",
        "-",
        "rigid-nodes",
        Domain::Choice(&["rigid-nodes", "barrier"]),
        "how the footing presses: nodes that move with it, or a barrier on particles that come near it",
    ),
    parameter(
        "rough",
        "-",
        "true",
        Domain::Boolean,
        "whether the ground sticks to the footing; if not, it slides freely",
    ),
    parameter(
        "ppc_per_direction",
        "-",
        "2",
        Domain::Integer { least: 1, most: 4 },
        "particles per cell and direction",
    ),
];

const METRICS: &[MetricInfo] = &[
    metric(
        "nc_b",
        "-",
        "bearing capacity factor q/s_u with the pressure q = F/(B/2), mean over the last quarter of the penetration",
    ),
    metric(
        "nc_b_plus_h",
        "-",
        "likewise with q = F/((B + h)/2): a footing of held nodes on grid lines ends between a held and a free node",
    ),
    metric(
        "nc_effective",
        "-",
        "likewise with the width that the held nodes of the scheme act with: B for quadratic splines, whose nodes lie in the middle of cells, B + h for GIMP, B + h/2 for cubic ones",
    ),
    metric(
        "prandtl_error",
        "-",
        "relative distance of nc_b from 2 + π: the error of the contact pressure",
    ),
    metric("nc_peak", "-", "largest q/s_u of the run, by B"),
    metric(
        "plateau_rise",
        "-",
        "relative growth of the load per 10⁻³ of s/B over the last quarter of the penetration",
    ),
    metric(
        "elastic_slope",
        "-",
        "d(q/s_u)/d(s/B) by B, a straight line fitted to all rows after the start; elastic in runs of great strength",
    ),
    metric(
        "force_imbalance",
        "-",
        "force on the base over that on the footing, less one, mean over the last quarter: inertia",
    ),
    metric(
        "mechanism_width",
        "B",
        "half the width of the ground that rises while the footing sinks: where the surface rises by half of what it does in Prandtl's mechanism (Hill's, if smooth)",
    ),
    metric(
        "heave",
        "-",
        "mean rise of the surface from 0.75 B to 1.25 B while the footing sinks by one: one half in Prandtl's mechanism",
    ),
    metric("nc_0.0003", "-", "q/s_u by B at s/B = 0.0003"),
    metric("nc_0.0005", "-", "likewise at 0.0005"),
    metric("nc_0.001", "-", "likewise at 0.001"),
    metric("nc_0.0015", "-", "likewise at 0.0015"),
    metric("nc_0.002", "-", "likewise at 0.002"),
    metric("nc_0.003", "-", "likewise at 0.003"),
    metric(
        "mean_stress_0.25_0.25",
        "-",
        "mean normal stress over s_u at the end at the material point 0.25 B from the axis and 0.25 B deep, by a linear fit over the particles within 2h",
    ),
    metric("mean_stress_0.25_0.5", "-", "likewise at 0.25 B, 0.5 B"),
    metric("mean_stress_0.75_0.25", "-", "likewise at 0.75 B, 0.25 B"),
    metric("mean_stress_1_0.25", "-", "likewise at B, 0.25 B"),
    metric("mean_stress_0.25_1", "-", "likewise at 0.25 B, B"),
    metric(
        "mean_stress_rms",
        "Pa",
        "rms over all particles of the mean normal stress",
    ),
    metric(
        "checkerboard_rms",
        "Pa",
        "rms over all particles of σ_m − Πσ_m",
    ),
    metric(
        "checkerboard_ratio",
        "-",
        "checkerboard_rms over mean_stress_rms",
    ),
    metric(
        "plastic_strain_max",
        "-",
        "largest equivalent plastic strain of a particle",
    ),
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end"),
    metric("mass", "kg/m", "mass of the particles"),
];

const HEADLINES: &[Headline] = &[
    headline("nc_b", "N_c by B (–)", 1.0, 3),
    headline("nc_b_plus_h", "N_c by B + h (–)", 1.0, 3),
    headline("nc_effective", "N_c by effective width (–)", 1.0, 3),
    headline("plateau_rise", "rise (%/10⁻³)", 100.0, 2),
    headline("elastic_slope", "slope (–)", 1.0, 0),
    headline("force_imbalance", "imbalance (%)", 100.0, 2),
    headline("mechanism_width", "mechanism (B)", 1.0, 2),
    headline("checkerboard_ratio", "checkerboard (–)", 1.0, 2),
    headline("log_jacobian_gap", "ln(J/J̄) (10⁻⁶)", 1e6, 2),
];

const QUANTITIES: &[Quantity] = &[error(
    "prandtl_error",
    "relative error of the contact pressure",
)];

const SWEEPS: &[Sweep] = &[Sweep {
    parameter: "penetration_rate",
    label: "penetration rate (m/s)",
    abscissa: |rate| rate,
    logarithmic: true,
}];

impl Case for Footing {
    fn name(&self) -> &'static str {
        "footing"
    }

    fn title(&self) -> &'static str {
        "Strip footing"
    }

    fn description(&self) -> &'static str {
        "A rough rigid strip footing pressed slowly into weightless ground, a Hencky solid with J2 plasticity \
         (plane strain, ν = 0.49). Its bearing capacity is (2 + π) s_u (Prandtl). Standard MPM locks and finds \
         no limit load; the F̄ remedies do, the recursive one depends on the rate."
    }

    fn references(&self) -> Vec<String> {
        reference::describe()
    }

    fn limits(&self) -> &'static [&'static str] {
        &[
            "A footing of held nodes acts as wide as up to the middle between its last node and the first free one: B + h, with quadratic splines B.",
            "The footing's nodes stay where they are: strokes are small against a cell.",
            "The inertia of the start shows below s/B = 0.0003; the elastic slope is measured in runs of great strength.",
        ]
    }

    fn parameters(&self) -> &[Parameter] {
        &PARAMETERS
    }

    fn schemes(&self) -> Vec<Scheme> {
        let cubic = pairs(&[BasisName::Bspline3], &[RemedyName::FbarConsistent]);
        [pairs(&BASES, &REMEDIES), cubic, other_transfers()].concat()
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
        SWEEPS
    }

    fn watched(&self) -> &'static [&'static str] {
        &["pressure_over_strength", "jacobian_max"]
    }

    fn sketch(&self) -> Sketch {
        sketch::sketch()
    }

    fn plan(&self, tier: Tier) -> Vec<RunSpec> {
        plan(tier)
    }

    fn cost(&self, spec: &RunSpec) -> f64 {
        let sweep = match spec.scheme.remedy() {
            RemedyName::None => 1.0,
            RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => 1.5,
            RemedyName::FbarConsistent => 2.5,
        };
        let dense = spec.set.iter().any(|s| s == "ppc_per_direction=4");
        sweep * if dense { 4.0 } else { 1.0 } / spec.level.h.powi(3)
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

/// Ground just large enough for the limit load, and a penetration just long enough.
const SMALL: &[&str] = &["domain_width=3", "domain_depth=3", "penetration=0.0025"];
/// A strength beyond reach: the ground stays elastic.
const ELASTIC: &[&str] = &["undrained_strength=1e6"];

fn runs(level: Level, bases: &[BasisName], remedies: &[RemedyName], set: &[&str]) -> Vec<RunSpec> {
    ladder(&[level], &pairs(bases, remedies), set)
}

fn plan(tier: Tier) -> Vec<RunSpec> {
    use BasisName::{Bspline3, Gimp};
    use RemedyName::{FbarConsistent, FbarRate, FbarRecursive, None};
    let [b10, b20, b40, b80] = LEVELS;
    let three = [None, FbarRecursive, FbarConsistent];
    let cubic = |level| runs(level, &[Bspline3], &[FbarConsistent], &[]);
    match tier {
        Tier::Quick => Vec::new(),
        Tier::Pr => [
            runs(b10, &BASES, &[None, FbarConsistent], &[]),
            runs(b20, &BASES, &[None, FbarConsistent], SMALL),
        ]
        .concat(),
        Tier::Nightly => {
            let rates = |rate| runs(b10, &BASES, &[FbarRecursive, FbarConsistent], &[rate]);
            [
                plan(Tier::Pr),
                runs(b10, &BASES, &[FbarRecursive, FbarRate], &[]),
                runs(b20, &BASES, &REMEDIES, &[]),
                runs(b20, &BASES, &REMEDIES, &["ppc_per_direction=4"]),
                cubic(b20),
                runs(b40, &BASES, &three, &[]),
                runs(b20, &BASES, &three, &["contact=barrier"]),
                rates("penetration_rate=4e-3"),
                rates("penetration_rate=1e-3"),
                runs(b10, &BASES, &[None, FbarRate, FbarConsistent], ELASTIC),
                runs(b20, &BASES, &[FbarConsistent], ELASTIC),
                runs(b10, &[Gimp], &[FbarRate, FbarConsistent], &["rough=false"]),
            ]
            .concat()
        }
        Tier::Long => [
            runs(
                b40,
                &BASES,
                &[FbarConsistent],
                &["ppc_per_direction=4", "penetration=0.003"],
            ),
            runs(b80, &BASES, &[FbarConsistent], &["penetration=0.003"]),
            runs(b40, &BASES, &[FbarRate], &[]),
            runs(b80, &BASES, &REMEDIES, &[]),
            cubic(b10),
            cubic(b40),
            cubic(b80),
            ladder(&LEVELS, &other_transfers(), &[]),
            runs(
                b10,
                &BASES,
                &[None, FbarConsistent],
                &["ppc_per_direction=4"],
            ),
        ]
        .concat(),
    }
}
