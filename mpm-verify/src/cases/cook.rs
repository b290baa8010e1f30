//! Cook's membrane: nearly incompressible elasticity in bending and shear.
//!
//! Section 4.1 of Zhao, Jiang & Choo (2022). Set-up, choices and tolerances: `docs/cook.md`.

mod checks;
mod reference;
mod simulation;
mod sketch;

use super::manufactured::plan::{ladder, more_particles, other_transfers, pairs};
use crate::case::{
    Case, CheckInfo, Headline, Job, Level, MetricInfo, Quantity, RunSpec, Sweep, Tier, error,
    headline, metric,
};
use crate::error::Error;
use crate::parameter::{Domain, Parameter, Parameters};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::sketch::Sketch;
use crate::verdict::Verdict;
use simulation::Simulated;

/// Cook's membrane.
pub(super) struct Cook;

const LEVELS: [Level; 4] = [
    Level { name: "h2", h: 2.0 },
    Level { name: "h1", h: 1.0 },
    Level {
        name: "h0.5",
        h: 0.5,
    },
    Level {
        name: "h0.25",
        h: 0.25,
    },
];

const BASES: [BasisName; 3] = [BasisName::Gimp, BasisName::Bspline2, BasisName::Bspline3];
const REMEDIES: [RemedyName; 5] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

const PARAMETERS: [Parameter; 14] = [
    Parameter {
        name: "young_modulus",
        unit: "Pa",
        default: "70",
        domain: Domain::Number {
            least: 1e-3,
            most: 1e12,
            below: false,
        },
        meaning: "Young's modulus E",
    },
    Parameter {
        name: "poisson_ratio",
        unit: "-",
        default: "0.499",
        domain: Domain::Number {
            least: 0.0,
            most: 0.5,
            below: true,
        },
        meaning: "Poisson's ratio ν",
    },
    Parameter {
        name: "density",
        unit: "kg/m³",
        default: "1",
        domain: Domain::Number {
            least: 1e-6,
            most: 1e6,
            below: false,
        },
        meaning: "density ρ; the state of rest does not depend on it",
    },
    Parameter {
        name: "load",
        unit: "N/m",
        default: "1",
        domain: Domain::Number {
            least: 1e-12,
            most: 1e12,
            below: false,
        },
        meaning: "total upward dead load on the right side, per metre of depth",
    },
    Parameter {
        name: "load_ramp",
        unit: "periods",
        default: "0.08",
        domain: Domain::Number {
            least: 0.0,
            most: 10.0,
            below: false,
        },
        meaning: "time over which the load grows, in fundamental periods",
    },
    Parameter {
        name: "load_at",
        unit: "-",
        default: "column",
        domain: Domain::Choice(&["column", "edge"]),
        meaning: "column: the last column of particles carries the load, at x = 48 m − h/4 for two \
                  particles per direction; edge: the last two columns carry 3/2 and −1/2 of it, \
                  whose resultant then acts on x = 48 m",
    },
    Parameter {
        name: "damping",
        unit: "-",
        default: "0",
        domain: Domain::Number {
            least: 0.0,
            most: 1.0,
            below: true,
        },
        meaning: "local damping factor",
    },
    Parameter {
        name: "kinetic_damping",
        unit: "-",
        default: "true",
        domain: Domain::Boolean,
        meaning: "zero the velocities at every peak of the kinetic energy",
    },
    Parameter {
        name: "cfl",
        unit: "-",
        default: "0.3",
        domain: Domain::Number {
            least: 1e-3,
            most: 1.0,
            below: true,
        },
        meaning: "CFL number c Δt / h of pressure waves",
    },
    Parameter {
        name: "flip",
        unit: "-",
        default: "1",
        domain: Domain::Number {
            least: 0.0,
            most: 1.0,
            below: false,
        },
        meaning: "PIC/FLIP blend η: 1 is FLIP",
    },
    Parameter {
        name: "wall",
        unit: "-",
        default: "open-knot",
        domain: Domain::Choice(&["open-knot", "wall-line"]),
        meaning: "how B-splines meet the clamped side",
    },
    Parameter {
        name: "max_periods",
        unit: "periods",
        default: "2",
        domain: Domain::Number {
            least: 1e-3,
            most: 1e3,
            below: false,
        },
        meaning: "longest time to run, in fundamental periods of 60 s (at the default E and ρ); a run that creeps after one is stopped there",
    },
    Parameter {
        name: "rest_window",
        unit: "periods",
        default: "0.05",
        domain: Domain::Number {
            least: 1e-3,
            most: 10.0,
            below: false,
        },
        meaning: "time over which the criterion of rest must hold",
    },
    Parameter {
        name: "ppc_per_direction",
        unit: "-",
        default: "2",
        domain: Domain::Integer { least: 1, most: 4 },
        meaning: "particles per cell and direction",
    },
];

const METRICS: &[MetricInfo] = &[
    metric(
        "mid_edge_uy",
        "m",
        "u_y of the middle of the right side, (48, 52) m, by a linear fit over the particles within 2h",
    ),
    metric(
        "edge_mean_uy",
        "m",
        "u_y averaged over the right side, from such fits at eight points",
    ),
    metric(
        "tip_uy",
        "m",
        "u_y of the upper right corner, (48, 60) m, by such a fit",
    ),
    metric(
        "tip_uy_nearest",
        "m",
        "u_y of the particle nearest to that corner",
    ),
    metric("tip_ux", "m", "u_x of that corner, by the fit"),
    metric(
        "mean_stress_rms_error",
        "Pa",
        "rms over particles with x > 3 m, 3 m away from the clamped corners, of the mean normal stress minus the reference",
    ),
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
        "mean_stress_24_36",
        "Pa",
        "mean normal stress at the material point (24, 36) m, by a linear fit",
    ),
    metric("mean_stress_16_30", "Pa", "likewise at (16, 30) m"),
    metric("mean_stress_36_48", "Pa", "likewise at (36, 48) m"),
    metric("mean_stress_24_24", "Pa", "likewise at (24, 24) m"),
    metric("mean_stress_8_20", "Pa", "likewise at (8, 20) m"),
    metric("mean_stress_8_40", "Pa", "likewise at (8, 40) m"),
    metric("mean_stress_44_52", "Pa", "likewise at (44, 52) m"),
    metric(
        "creep_rate",
        "1/s",
        "slope of rms ln(J/J̄) against time over the second half of the run",
    ),
    metric("creep_linearity", "-", "R² of that straight line"),
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end"),
    metric(
        "at_rest",
        "-",
        "1 if the criterion of rest was met, 0 if the run was stopped without",
    ),
    metric("rest_time", "s", "time at the end of the run"),
    metric(
        "work_residual",
        "-",
        "largest out-of-balance virtual work over the last window, relative to that of the load",
    ),
    metric(
        "reaction_uy",
        "N/m",
        "vertical reaction of the clamped side",
    ),
    metric("mass", "kg/m", "mass of the particles"),
    metric(
        "seeded_volume",
        "m²",
        "reference volume of the particles; the membrane's is 1,440 m²",
    ),
    metric(
        "energy_gain",
        "-",
        "largest kinetic energy + stress work + losses − load work over the run, relative to the final load work",
    ),
    metric(
        "energy_loss",
        "-",
        "largest excess of the load's work, likewise: what the transfer dissipates",
    ),
    metric("period", "s", "nominal fundamental period"),
    metric("fem_mid_edge_error", "-", "relative error of mid_edge_uy"),
    metric("fem_edge_mean_error", "-", "relative error of edge_mean_uy"),
    metric("fem_tip_error", "-", "relative error of tip_uy"),
];

const HEADLINES: &[Headline] = &[
    headline("fem_mid_edge_error", "mid-edge error (%)", 100.0, 2),
    headline("fem_edge_mean_error", "edge-mean error (%)", 100.0, 2),
    headline("fem_tip_error", "tip error (%)", 100.0, 2),
    headline("mean_stress_rms_error", "σ_m rms error (mPa)", 1e3, 1),
    headline("checkerboard_ratio", "checkerboard (–)", 1.0, 2),
    headline("at_rest", "at rest (1: yes)", 1.0, 0),
    headline("rest_time", "time at the end (s)", 1.0, 0),
    headline("creep_rate", "creep of ln(J/J̄) (10⁻⁶/s)", 1e6, 2),
    headline("log_jacobian_gap", "ln(J/J̄) at the end (10⁻⁴)", 1e4, 2),
];

const QUANTITIES: &[Quantity] = &[
    error("fem_edge_mean_error", "relative error of edge-mean u_y"),
    error("mean_stress_rms_error", "rms error of σ_m (Pa)"),
    Quantity {
        metric: "tip_ux",
        label: "tip u_x (m)",
        is_error: false,
    },
];

const SWEEPS: &[Sweep] = &[Sweep {
    parameter: "poisson_ratio",
    label: "0.5 − ν",
    abscissa: |ratio| 0.5 - ratio,
    logarithmic: true,
}];

impl Case for Cook {
    fn name(&self) -> &'static str {
        "cook"
    }

    fn title(&self) -> &'static str {
        "Cook's membrane"
    }

    fn description(&self) -> &'static str {
        "A tapered membrane of nearly incompressible neo-Hookean rubber (plane strain, ν = 0.499), \
         clamped on the left, sheared by a dead load on the right; run to rest. Standard MPM locks; \
         the F̄ remedies don't; the recursive one creeps and never rests."
    }

    fn references(&self) -> Vec<String> {
        reference::describe()
    }

    fn limits(&self) -> &'static [&'static str] {
        &[
            "The tip is a weakly singular point: the middle of the right side and the edge's mean are the primary measures.",
            "The particles fill cells of the lattice, 1,444 m² instead of 1,440 m² at h = 1 and ½; the sloping sides are stairs.",
            "The state of rest is approached by kinetic damping; the path to it has no physical meaning.",
        ]
    }

    fn parameters(&self) -> &[Parameter] {
        &PARAMETERS
    }

    fn schemes(&self) -> Vec<Scheme> {
        [pairs(&BASES, &REMEDIES), other_transfers()].concat()
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

    fn settles(&self) -> bool {
        true
    }

    fn sweeps(&self) -> &'static [Sweep] {
        SWEEPS
    }

    fn watched(&self) -> &'static [&'static str] {
        &["tip_uy", "log_jacobian_gap_rms"]
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
            RemedyName::FbarRecursive => 2.5,
            RemedyName::FbarTotal | RemedyName::FbarRate => 1.5,
            RemedyName::FbarConsistent => 3.0,
        };
        sweep / spec.level.h.powi(3)
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

fn plan(tier: Tier) -> Vec<RunSpec> {
    use BasisName::{Bspline2, Bspline3, Gimp};
    use RemedyName::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal, None};
    let [h2, h1, half, quarter] = LEVELS;
    let runs = |level: Level, bases: &[BasisName], remedies: &[RemedyName], set: &[&str]| {
        ladder(&[level], &pairs(bases, remedies), set)
    };
    let halved = ["cfl=0.15"];
    let large = ["cfl=0.6"];
    // The state of rest hardly depends on the time step (see the page): near each one's limit.
    let standard = |level| {
        [
            runs(level, &[Gimp], &[None], &["cfl=0.45"]),
            runs(level, &[Bspline2], &[None], &large),
        ]
        .concat()
    };
    match tier {
        Tier::Quick => [
            runs(h2, &[Gimp], &REMEDIES, &[]),
            runs(h2, &[Gimp], &[FbarRecursive], &halved),
        ]
        .concat(),
        Tier::Pr => [
            runs(h2, &BASES, &REMEDIES, &[]),
            runs(h2, &[Gimp], &[FbarRecursive], &halved),
            runs(h1, &BASES, &REMEDIES[..4], &[]),
            runs(h1, &[Gimp, Bspline2], &[FbarConsistent], &[]),
            standard(half),
            runs(half, &[Gimp, Bspline2], &[FbarRate], &large),
        ]
        .concat(),
        Tier::Nightly => {
            let mut all = plan(Tier::Pr);
            all.extend(runs(h1, &[Bspline3], &[FbarConsistent], &[]));
            all.extend(runs(half, &BASES, &REMEDIES[..4], &[]));
            all.extend(runs(h2, &BASES, &[FbarRecursive], &halved));
            all.extend(standard(quarter));
            all.extend(runs(quarter, &[Gimp, Bspline2], &[FbarRate], &[]));
            for ratio in ["0.3", "0.49", "0.4999"] {
                let set = format!("poisson_ratio={ratio}");
                all.extend(runs(
                    h1,
                    &[Gimp, Bspline2],
                    &[None, FbarTotal, FbarRate],
                    &[&set],
                ));
            }
            all.extend(runs(
                h1,
                &[Gimp, Bspline2],
                &[FbarTotal, FbarRate],
                &["load_at=edge"],
            ));
            all.extend(runs(
                h1,
                &[Bspline2],
                &[None, FbarRate],
                &["wall=wall-line"],
            ));
            all.extend(runs(
                h1,
                &[Gimp],
                &[FbarRate],
                &["rest_window=1", "max_periods=5"],
            ));
            let mut seen = Vec::new();
            all.retain(|spec| {
                let new = !seen.contains(&spec.folder());
                seen.push(spec.folder());
                new
            });
            all
        }
        Tier::Long => [
            runs(quarter, &BASES, &[FbarRecursive], &[]),
            runs(quarter, &[Gimp, Bspline2], &[FbarTotal], &large),
            runs(quarter, &[Bspline3], &[None, FbarTotal, FbarRate], &large),
            runs(half, &BASES, &[FbarConsistent], &[]),
            runs(quarter, &BASES, &[FbarConsistent], &large),
            ladder(&LEVELS, &other_transfers(), &[]),
            more_particles(&[h2, h1]),
        ]
        .concat(),
    }
}
