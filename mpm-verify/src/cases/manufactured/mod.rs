//! Problems whose exact solution is known: one description per problem, one simulation for all.
//!
//! Choices, gates and tolerances: `docs/manufactured.md`.

pub(super) mod checks;
pub(super) mod errors;
pub(super) mod metrics;
pub(super) mod pictures;
mod scene;
mod sketch;
mod slow;
mod tables;
mod watch;

use super::parameters;
use crate::case::Case;
use crate::error::Error;
use crate::exact::{self, Exact};
use crate::job::Job;
use crate::parameter::{Domain, Parameter, Parameters, number, parameters};
use crate::spec::{Level, RunSpec};
use metrics::{ERRORS, METRICS, headlines};
use mpm_core::stage::WallKind;
pub(super) use scene::{forcing, vector};
use slow::Slow;
use watch::Motion;

/// What holds the body.
#[derive(Debug, Clone, Copy)]
pub(super) enum Boundary {
    /// Walls on all sides.
    Walls(WallKind),
    /// Opposite sides are one.
    Periodic,
    /// Rollers on floor and sides, a free surface above.
    Vessel,
    /// A fixed floor, sides that are one, a free surface above.
    Slope,
}

/// A motion that is known in closed form, and what holds the body.
#[derive(Clone, Copy)]
pub(super) struct Manufactured {
    /// Makes the exact solution.
    pub(super) solution: fn(&Parameters) -> Result<Box<dyn Exact>, exact::Error>,
    pub(super) boundary: Boundary,
    /// Whether the body is a fluid.
    pub(super) fluid: bool,
    /// Whether the body is to stay at rest.
    pub(super) rests: bool,
    /// Angular frequency (rad/s) of a solution that is one standing wave.
    pub(super) frequency: Option<fn(&Parameters) -> f64>,
}

impl Manufactured {
    /// A solid between rollers.
    pub(super) fn solid(solution: fn(&Parameters) -> Result<Box<dyn Exact>, exact::Error>) -> Self {
        Self {
            solution,
            boundary: Boundary::Walls(WallKind::Roller),
            fluid: false,
            rests: false,
            frequency: None,
        }
    }

    /// A case of this motion, with the levels, errors and headlines that serve most; plan and checks are the
    /// problem's own.
    pub(super) fn case(
        self,
        [name, title, description]: [&'static str; 3],
        parameters: Vec<Parameter>,
    ) -> Case {
        let (known, of_begin) = (parameters.clone(), parameters.clone());
        Case {
            name,
            title,
            description,
            references: Vec::new(),
            limits: &[],
            levels: levels(),
            plan: Vec::new(),
            metrics: METRICS.to_vec(),
            checks: Vec::new(),
            headlines: headlines(),
            quantities: ERRORS.to_vec(),
            sweeps: Vec::new(),
            watched: &["displacement_l2", "log_jacobian_gap_rms"],
            field: None,
            sketch: sketch::sketch(&self, &parameters),
            cost: Box::new(move |spec| scene::cost(&self, &known, spec)),
            ladder: &[],
            own_runs: crate::record::of_defaults,
            begin: Box::new(move |spec, p| self.begin(spec, p, &of_begin)),
            pictures: |_| Ok(()),
            tables: tables::of(name),
            breaks_down: |_| None,
            parameters,
        }
    }

    /// A case of this motion, so slow that it is always in equilibrium.
    pub(super) fn slow_case(self, names: [&'static str; 3], parameters: Vec<Parameter>) -> Case {
        Case {
            metrics: [&metrics::OF_SLOW, metrics::STATIC].concat(),
            headlines: metrics::slow_headlines(),
            quantities: metrics::SLOW_ERRORS.to_vec(),
            watched: &["displacement_l2", "newton_iterations"],
            cost: Box::new(|spec| 1e-4 * spec.level.h.powi(-3)),
            begin: Box::new(move |spec, p| {
                Ok(match (self.solution)(p)?.dimension() {
                    3 => Box::new(Slow::<3>::drive(self, spec, p)?),
                    _ => Box::new(Slow::<2>::drive(self, spec, p)?),
                })
            }),
            ..self.case(names, parameters)
        }
    }

    fn begin(
        self,
        spec: &RunSpec,
        p: &Parameters,
        known: &[Parameter],
    ) -> Result<Box<dyn Job>, Error> {
        Ok(match (self.solution)(p)?.dimension() {
            1 => Box::new(Motion::<1>::drive(self, spec, p, known)?),
            2 => Box::new(Motion::<2>::drive(self, spec, p, known)?),
            _ => Box::new(Motion::<3>::drive(self, spec, p, known)?),
        })
    }
}

/// 8 to 128 cells per metre.
pub(super) fn levels() -> Vec<Level> {
    super::family::levels(
        1.0,
        [
            ("n8", 8.0),
            ("n16", 16.0),
            ("n32", 32.0),
            ("n64", 64.0),
            ("n128", 128.0),
        ],
    )
}

parameters! { pub(super) const:
    DURATION = "duration", "s", "1", number(1e-9, 1e6, false), "time to run";
    LOAD_STEPS = "load_steps", "-", "4", Domain::Integer { least: 1, most: 10_000 },
        "quasi-static: equal steps of time";
    RELAXATION = "relaxation", "-", "10", number(0.0, 1e9, false),
        "relaxation β of the remedy fbar-consistent";
    HOLD = "hold", "-", "0", number(0.0, 1e9, false),
        "ε² M of the remedy fbar-consistent is at least this many times the smooth pressure, M the body's modulus of pressure waves; zero: ε = 0.01 everywhere";
    STEP_POISSON_RATIO = "step_poisson_ratio", "-", "0.49", number(0.0, 0.5, true),
        "the time step is that of a body with this Poisson's ratio, if the body's own is lower: runs at several ratios then differ in nothing else";
}
pub(super) const CFL: Parameter = Parameter {
    domain: number(1e-4, 100.0, false),
    ..parameters::CFL.with_default("0.3").meaning(
        "CFL number c Δt / h of pressure waves, rounded down so that steps fill the duration; explicit: below 1",
    )
};
pub(super) const PPC_PER_DIRECTION: Parameter = Parameter {
    domain: Domain::Integer { least: 1, most: 5 },
    ..parameters::PPC_PER_DIRECTION
};
const FLIP: Parameter =
    parameters::FLIP.meaning("PIC/FLIP blend η of the transfer flip: 1 is FLIP");

/// The parameters of a solution, with other defaults for some; those of every such problem, with the time to run (s);
/// and the problem's own.
pub(super) fn all_parameters(
    of_solution: &[Parameter],
    defaults: &[(Parameter, &'static str)],
    duration: &'static str,
    own: &[Parameter],
) -> Vec<Parameter> {
    let numerical = [
        DURATION.with_default(duration),
        CFL,
        parameters::TIME_STEP,
        parameters::STEP_SCALING,
        PPC_PER_DIRECTION,
        parameters::WALL,
        FLIP,
        RELAXATION,
        HOLD,
    ];
    let mut all = [of_solution, &numerical, own].concat();
    for p in &mut all {
        if let Some((_, default)) = defaults.iter().find(|(known, _)| known.name == p.name) {
            p.default = default;
        }
    }
    all
}
