//! Problems whose exact solution is known: one description per problem, one simulation for all.
//!
//! Choices, gates and tolerances: `docs/manufactured.md`.

pub(super) mod checks;
pub(super) mod plan;
mod scene;
mod simulation;
mod sketch;

use crate::case::{
    Case, CheckInfo, Headline, Job, Level, MetricInfo, Quantity, RunSpec, Sweep, Tier, error,
    headline, metric,
};
use crate::error::Error;
use crate::exact::Exact;
use crate::parameter::{Domain, Parameter, Parameters};
use crate::record::Record;
use crate::scheme::Scheme;
use crate::sketch::Sketch;
use crate::verdict::Verdict;
use mpm_core::stage::WallKind;
use simulation::Simulated;

/// What holds the body.
#[derive(Debug, Clone, Copy)]
pub(super) enum Boundary {
    /// Walls on all sides.
    Walls(WallKind),
    /// Opposite sides are one.
    Periodic,
    /// Rollers on floor and sides, a free surface above.
    Vessel,
}

/// A problem whose exact solution is known.
pub(super) struct Manufactured {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    pub(super) description: &'static str,
    pub(super) references: &'static [&'static str],
    pub(super) limits: &'static [&'static str],
    /// Makes the exact solution.
    pub(super) solution: fn(&Parameters) -> Result<Box<dyn Exact>, Error>,
    /// Those of the solution, then [`numerical`].
    pub(super) parameters: Vec<Parameter>,
    pub(super) boundary: Boundary,
    /// Whether the body is a fluid.
    pub(super) fluid: bool,
    /// Whether the body is to stay at rest.
    pub(super) rests: bool,
    /// Angular frequency (rad/s) of a solution that is one standing wave.
    pub(super) frequency: Option<fn(&Parameters) -> f64>,
    pub(super) levels: Vec<Level>,
    pub(super) schemes: Vec<Scheme>,
    pub(super) plan: fn(&Manufactured, Tier) -> Vec<RunSpec>,
    pub(super) checks: &'static [CheckInfo],
    pub(super) judge: fn(&Record) -> Vec<Verdict>,
    pub(super) judge_study: fn(&[Record]) -> Vec<Verdict>,
    pub(super) headlines: &'static [Headline],
    pub(super) quantities: &'static [Quantity],
    pub(super) sweeps: &'static [Sweep],
    /// Why a run is known to break down.
    pub(super) breaks_down: fn(&Record) -> Option<&'static str>,
}

impl Manufactured {
    /// A solid between rollers, with the checks, errors and sweeps that serve most problems.
    pub(super) fn solid(
        [name, title, description]: [&'static str; 3],
        solution: fn(&Parameters) -> Result<Box<dyn Exact>, Error>,
        parameters: Vec<Parameter>,
    ) -> Self {
        Self {
            name,
            title,
            description,
            references: &[],
            limits: &[],
            solution,
            parameters,
            boundary: Boundary::Walls(WallKind::Roller),
            fluid: false,
            rests: false,
            frequency: None,
            levels: plan::levels(
                1.0,
                [
                    ("n8", 8.0),
                    ("n16", 16.0),
                    ("n32", 32.0),
                    ("n64", 64.0),
                    ("n128", 128.0),
                ],
            ),
            schemes: plan::pairs(&plan::BASES, &plan::REMEDIES),
            plan: |_, _| Vec::new(),
            checks: &[],
            judge: |_| Vec::new(),
            judge_study: |_| Vec::new(),
            headlines: HEADLINES,
            quantities: ERRORS,
            sweeps: &[],
            breaks_down: |_| None,
        }
    }
}

/// Parameters of every such problem, with the time to run (s).
pub(super) const fn numerical(duration: &'static str) -> [Parameter; 7] {
    [
        Parameter {
            name: "duration",
            unit: "s",
            default: duration,
            domain: Domain::Number {
                least: 1e-9,
                most: 1e6,
                below: false,
            },
            meaning: "time to run",
        },
        Parameter {
            name: "cfl",
            unit: "-",
            default: "0.3",
            domain: Domain::Number {
                least: 1e-4,
                most: 1.0,
                below: true,
            },
            meaning: "CFL number c Δt / h of pressure waves, rounded down so that steps fill the duration",
        },
        Parameter {
            name: "step_scaling",
            unit: "-",
            default: "h",
            domain: Domain::Choice(&["h", "h2"]),
            meaning: "h: the time step shrinks with h; h2: with h², from the one at eight cells per side",
        },
        Parameter {
            name: "ppc_per_direction",
            unit: "-",
            default: "2",
            domain: Domain::Integer { least: 1, most: 5 },
            meaning: "particles per cell and direction",
        },
        Parameter {
            name: "wall",
            unit: "-",
            default: "open-knot",
            domain: Domain::Choice(&["open-knot", "wall-line"]),
            meaning: "how B-splines meet walls",
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
            meaning: "PIC/FLIP blend η of the transfer flip: 1 is FLIP",
        },
        Parameter {
            name: "relaxation",
            unit: "-",
            default: "10",
            domain: Domain::Number {
                least: 0.0,
                most: 1e9,
                below: false,
            },
            meaning: "relaxation β of the remedy fbar-consistent",
        },
    ]
}

/// The Poisson's ratio that sets the time step of isochoric problems.
pub(super) const fn step_poisson_ratio(default: &'static str) -> Parameter {
    Parameter {
        name: "step_poisson_ratio",
        unit: "-",
        default,
        domain: Domain::Number {
            least: 0.0,
            most: 0.5,
            below: true,
        },
        meaning: "the time step is that of a body with this Poisson's ratio, if the body's own is lower: runs at several ratios then differ in nothing else",
    }
}

/// `base` with other defaults for some, followed by `more`.
pub(super) fn parameters(
    base: &[Parameter],
    defaults: &[(&str, &'static str)],
    more: impl IntoIterator<Item = Parameter>,
) -> Vec<Parameter> {
    let mut all: Vec<Parameter> = base.to_vec();
    for p in &mut all {
        if let Some((_, default)) = defaults.iter().find(|(name, _)| *name == p.name) {
            p.default = default;
        }
    }
    all.extend(more);
    all
}

pub(super) const METRICS: &[MetricInfo] = &[
    metric(
        "displacement_l2",
        "m",
        "rms over the particles of |u − exact u| at the end",
    ),
    metric("displacement_linf", "m", "largest |u − exact u| at the end"),
    metric(
        "velocity_l2",
        "m/s",
        "rms of |v − exact v| half a step before the end, where velocities live",
    ),
    metric("velocity_linf", "m/s", "largest such error"),
    metric(
        "stress_l2",
        "Pa",
        "rms of the Frobenius norm of the error of the Cauchy stress, as it enters the forces",
    ),
    metric("stress_linf", "Pa", "largest such error"),
    metric(
        "mean_stress_l2",
        "Pa",
        "rms error of the mean normal stress; of an isochoric motion, the spurious pressure",
    ),
    metric("mean_stress_linf", "Pa", "largest such error"),
    metric(
        "displacement_scale",
        "m",
        "largest rms over the particles of the exact u since the start",
    ),
    metric(
        "displacement_ratio",
        "-",
        "projection of the displacement on the exact one, over it",
    ),
    metric("velocity_ratio", "-", "likewise of the velocity"),
    metric(
        "energy_gain",
        "-",
        "largest rise of kinetic + stored energy − work of the loads over its start, relative to the largest kinetic energy",
    ),
    metric("energy_loss", "-", "largest fall, likewise"),
    metric("energy_end", "-", "rise at the end, likewise"),
    metric("kinetic_energy_peak", "J", "largest kinetic energy"),
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end"),
    metric(
        "mass",
        "kg",
        "mass of the particles, per metre in plane strain and per square metre in uniaxial strain",
    ),
    metric(
        "body_mass",
        "kg",
        "ρ₀ times the volume of the body, likewise",
    ),
    metric("damping", "-", "−ln amplitude_ratio"),
    metric(
        "frequency_ratio",
        "-",
        "frequency of the standing wave, from the zeros of its displacement, over the exact one",
    ),
    metric("frequency_error", "-", "|frequency_ratio − 1|"),
    metric(
        "amplitude_ratio",
        "-",
        "largest displacement in the shape of the wave in the last period, over that in the first",
    ),
    metric(
        "j_drift_per_1e5_steps",
        "-",
        "largest change of a cell's mean J̄ (J without a remedy) per 10⁵ steps",
    ),
    metric(
        "true_j_drift_per_1e5_steps",
        "-",
        "largest change of a cell's mean J per 10⁵ steps",
    ),
    metric(
        "kinetic_growth",
        "-",
        "largest kinetic energy in the last third of the run over that in the middle third",
    ),
    metric(
        "base_pressure",
        "Pa",
        "pressure at the floor, by a straight line through the lower half",
    ),
];

/// What the table of results shows.
const HEADLINES: &[Headline] = &[
    headline("displacement_l2", "u rms error (m)", 1.0, 8),
    headline("velocity_l2", "v rms error (m/s)", 1.0, 6),
    headline("stress_l2", "σ rms error (Pa)", 1.0, 2),
    headline("mean_stress_l2", "σ_m rms error (Pa)", 1.0, 2),
    headline("energy_gain", "energy gain (–)", 1.0, 5),
    headline("energy_loss", "energy loss (–)", 1.0, 5),
    headline("log_jacobian_gap", "ln(J/J̄) (–)", 1.0, 6),
];

/// The errors whose convergence is studied.
pub(super) const ERRORS: &[Quantity] = &[
    error("displacement_l2", "rms error of u (m)"),
    error("displacement_linf", "largest error of u (m)"),
    error("velocity_l2", "rms error of v (m/s)"),
    error("stress_l2", "rms error of σ (Pa)"),
    error("mean_stress_l2", "rms error of σ_m (Pa)"),
];

impl Case for Manufactured {
    fn name(&self) -> &'static str {
        self.name
    }

    fn title(&self) -> &'static str {
        self.title
    }

    fn description(&self) -> &'static str {
        self.description
    }

    fn references(&self) -> Vec<String> {
        self.references.iter().map(|s| (*s).to_owned()).collect()
    }

    fn limits(&self) -> &'static [&'static str] {
        self.limits
    }

    fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    fn schemes(&self) -> Vec<Scheme> {
        self.schemes.clone()
    }

    fn levels(&self) -> &[Level] {
        &self.levels
    }

    fn metrics(&self) -> &'static [MetricInfo] {
        METRICS
    }

    fn checks(&self) -> &'static [CheckInfo] {
        self.checks
    }

    fn headlines(&self) -> &'static [Headline] {
        self.headlines
    }

    fn quantities(&self) -> &'static [Quantity] {
        self.quantities
    }

    fn sweeps(&self) -> &'static [Sweep] {
        self.sweeps
    }

    fn watched(&self) -> &'static [&'static str] {
        &["displacement_l2", "log_jacobian_gap_rms"]
    }

    fn sketch(&self) -> Sketch {
        sketch::sketch(self)
    }

    fn plan(&self, tier: Tier) -> Vec<RunSpec> {
        (self.plan)(self, tier)
    }

    fn cost(&self, spec: &RunSpec) -> f64 {
        plan::cost(self, spec)
    }

    fn start(&self, spec: &RunSpec, p: &Parameters) -> Result<Box<dyn Job>, Error> {
        Ok(match (self.solution)(p)?.dimension() {
            1 => Box::new(Simulated::<1>::new(self, spec, p)?),
            2 => Box::new(Simulated::<2>::new(self, spec, p)?),
            _ => Box::new(Simulated::<3>::new(self, spec, p)?),
        })
    }

    fn breaks_down(&self, record: &Record) -> Option<&'static str> {
        (self.breaks_down)(record)
    }

    fn judge(&self, record: &Record) -> Vec<Verdict> {
        (self.judge)(record)
    }

    fn judge_study(&self, records: &[Record]) -> Vec<Verdict> {
        (self.judge_study)(records)
    }
}
