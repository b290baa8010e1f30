//! Problems whose exact solution is known: what each of them says of its motion, and one simulation for all.

pub(super) mod checks;
pub(super) mod errors;
pub(super) mod foreign;
mod metrics;
mod motion;
mod scenario;
mod sketch;
pub(super) mod tables;

use super::parameters;
pub(super) use super::parameters::{
    ALPHA, DELTA, DENSITY, DYNAMIC, LUMPED, POISSON_RATIO, UNSEEN, WALL, WALL_LINE, YOUNG_MODULUS,
};
use crate::cases::prelude::*;
use crate::exact;
pub(super) use crate::exact::common::{AMPLITUDE, ANGULAR_FREQUENCY, GRAVITY};
pub(super) use checks::*;
pub(super) use metrics::*;
pub(super) use motion::Motion;
pub(super) use scenario::{Scenario, forcing, vector};
use std::marker::PhantomData;
pub(super) use tables::mean_stress;

pub(super) type Solution = fn(&Parameters) -> Result<Box<dyn Exact>, exact::Error>;

/// Remedies that are compared: without, by rates, and ours.
pub(super) const COMPARED: [RemedyName; 3] = [RemedyName::None, FbarRate, FbarConsistent];
/// More particles than the cases' own two per direction.
pub(super) const MORE: [&str; 2] = ["ppc_per_direction=3", "ppc_per_direction=4"];
pub(super) const THREE: &str = "n8 n16 n32";
pub(super) const FOUR: &str = "n8 n16 n32 n64";
pub(super) const FIVE: &str = "n8 n16 n32 n64 n128";

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

/// A motion that is known in closed form, and its boundary: a solid between rollers unless said.
pub(super) trait Known: Send + Sync + 'static {
    /// Makes the exact solution.
    const SOLUTION: Solution;
    const BOUNDARY: Boundary = Boundary::Walls(WallKind::Roller);
    /// Whether the body is a fluid.
    const FLUID: bool = false;
    /// Whether the body is to stay at rest.
    const RESTS: bool = false;
    /// Angular frequency (rad/s) of a solution that is one standing wave.
    const FREQUENCY: Option<fn(&Parameters) -> f64> = None;
    /// Parts of its parameters; nothing if it makes the list by itself.
    const PARAMETERS: Composed = (&[], &[], "", &[]);

    fn parameters() -> Vec<Parameter> {
        all_parameters(Self::PARAMETERS)
    }
}

/// The parameters of a solution, with other defaults for some; the time to run (s) beside what every such problem has; and
/// the problem's own.
pub(super) type Composed =
    (&'static [&'static [Parameter]], &'static [(Parameter, &'static str)], &'static str, &'static [Parameter]);

/// The parameters of a motion, which are read by name: each case composes its own list.
pub(super) struct Own<K>(PhantomData<K>);

impl<K> Clone for Own<K> {
    fn clone(&self) -> Self {
        Self(PhantomData)
    }
}

impl<K: Known> ParameterSet for Own<K> {
    fn list() -> Vec<Parameter> {
        K::parameters()
    }

    fn read(_: &Parameters) -> Result<Self, exact::Error> {
        Ok(Self(PhantomData))
    }
}

/// A case of this motion in `D` dimensions, by name, title and description, with the errors and headlines that serve most.
pub(super) fn known_case<const D: usize, K: Known>([name, title, description]: [&'static str; 3]) -> Case {
    Case::of::<D, Motion<D, K>>(name, title, METRICS)
        .described(description)
        .wanted("displacement", "rms error of u at the end", "error-bound")
        .missed_by("motion-lost beyond-bound")
        .headlines(headlines())
        .quantities(ERRORS.to_vec())
        .watched(&["displacement_l2", "log_jacobian_gap_rms"])
        .sketch(sketch::sketch::<K>())
        .cost(scenario::cost::<K>)
}

/// Begins a run in as many dimensions as the exact solution of its parameters has.
pub(super) fn begin<K: Known>(spec: &RunSpec, p: &Parameters) -> Result<Box<dyn Job>, Error> {
    match (K::SOLUTION)(p)?.dimension() {
        1 => problem::begin::<1, Motion<1, K>>(spec, p),
        2 => problem::begin::<2, Motion<2, K>>(spec, p),
        _ => problem::begin::<3, Motion<3, K>>(spec, p),
    }
}

/// 8 to 128 cells per metre.
pub(super) fn metre_levels() -> Vec<Level> {
    levels(1.0, [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0), ("n128", 128.0)])
}

parameters! { pub(super) const:
    DURATION = "duration", "s", "1", number(1e-9, 1e6, false), "time to run";
    RELAXATION = "relaxation", "-", "10", number(0.0, 1e9, false), "relaxation β of the remedy fbar-consistent";
    HOLD = "hold", "-", "0", number(0.0, 1e9, false),
        "ε² M of the remedy fbar-consistent is at least this many times the smooth pressure, M the body's modulus of pressure waves; zero: ε = 0.01 everywhere";
    STEP_POISSON_RATIO = "step_poisson_ratio", "-", "0.49", number(0.0, 0.5, true),
        "the time step is that of a body with this Poisson's ratio, if the body's own is lower: runs at several ratios then differ in nothing else";
}
pub(super) const CFL: Parameter = parameters::CFL
    .with_default("0.3")
    .within(number(1e-4, 100.0, false))
    .meaning("CFL number c Δt / h of pressure waves, rounded down so that steps fill the duration; explicit: below 1");
pub(super) const PPC_PER_DIRECTION: Parameter =
    parameters::PPC_PER_DIRECTION.within(Domain::Integer { least: 1, most: 5 });
const FLIP: Parameter = parameters::FLIP.meaning("PIC/FLIP blend η of the transfer flip: 1 is FLIP");

fn all_parameters((of_solution, defaults, duration, own): Composed) -> Vec<Parameter> {
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
    let mut all = [&of_solution.concat()[..], &numerical, own].concat();
    set_defaults(&mut all, defaults);
    all
}

pub(super) fn set_defaults(all: &mut [Parameter], defaults: &[(Parameter, &'static str)]) {
    for p in all {
        if let Some((_, default)) = defaults.iter().find(|(known, _)| known.name == p.name) {
            p.default = default;
        }
    }
}
