//! Typed errors of the solver.

use crate::memory::MemoryError;
use std::fmt;
use thiserror::Error;

/// Failure of a step, with the offending value.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Fault {
    /// A quantity of a particle is NaN or infinite.
    #[error("{quantity} is not finite ({value})")]
    NotFinite {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// The determinant of the deformation gradient is not positive.
    #[error("Jacobian J = {0} is not positive")]
    NonPositiveJacobian(f64),
    /// The particle has left the grid: coordinate `axis` lies outside `[lo, hi]` (m).
    #[error("coordinate {axis} = {value} m lies off the grid [{lo}, {hi}] m")]
    OffGrid {
        /// Axis, counted from zero.
        axis: usize,
        /// Coordinate (m).
        value: f64,
        /// Lower end of the grid (m).
        lo: f64,
        /// Upper end of the grid (m).
        hi: f64,
    },
    /// The time step exceeds what the wave and particle speeds allow.
    #[error("time step is unstable: CFL number {cfl} exceeds {limit}")]
    UnstableTimeStep {
        /// (c + |v|) Δt / h of the particle; where a contact is too stiff, the CFL number of both together.
        cfl: f64,
        /// The largest admissible value.
        limit: f64,
    },
    /// The particle would enter a rigid body: its gap (m) is no longer positive.
    #[error("gap to a rigid body closes: {0} m")]
    GapClosed(f64),
    /// The pores of a solid with incompressible grains would close.
    #[error("porosity n = {0} is not positive")]
    NonPositivePorosity(f64),
    /// A face of the particle's domain lies in a cell without material: this share of a corner would be lost.
    #[error("a share {0} of a loaded or drained face lies on a node in an empty cell")]
    EmptyCell(f64),
    /// The particle's domain has grown beyond a cell: half its size over the cell's.
    #[error("half size of the particle domain is {0} cells; the limit is half a cell")]
    WideDomain(f64),
}

impl Fault {
    /// Stable name of the kind, as written to records.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "not-finite",
            Self::NonPositiveJacobian(_) => "non-positive-jacobian",
            Self::OffGrid { .. } => "off-grid",
            Self::UnstableTimeStep { .. } => "unstable-time-step",
            Self::GapClosed(_) => "gap-closed",
            Self::NonPositivePorosity(_) => "non-positive-porosity",
            Self::EmptyCell(_) => "empty-cell",
            Self::WideDomain(_) => "wide-domain",
        }
    }

    /// The offending value.
    pub fn value(&self) -> f64 {
        match *self {
            Self::NotFinite { value, .. } | Self::OffGrid { value, .. } => value,
            Self::NonPositiveJacobian(j) => j,
            Self::GapClosed(gap) => gap,
            Self::NonPositivePorosity(share) | Self::EmptyCell(share) | Self::WideDomain(share) => share,
            Self::UnstableTimeStep { cfl, .. } => cfl,
        }
    }
}

/// Why a body finds no equilibrium, told by the motion that meets the least resistance. Places are in m, NaN along axes
/// that the body has not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cause {
    /// Not known: the matrix has no factors, or the solver does not look.
    Unknown,
    /// Functions at the rim move: place of a node, and the share of a cell that it sees.
    Rim([f64; 3], f64),
    /// The body, or a part of it, moves without strain: centre of what moves, and its share of the volume.
    Loose([f64; 3], f64),
    /// The body strains, most at a place, with a share of the elastic stiffness that is small or negative.
    GivesWay([f64; 3], f64),
    /// The body resists every motion, with this share of the elastic stiffness at least.
    Sound(f64),
}

impl fmt::Display for Cause {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = |at: &[f64; 3]| {
            let along = at.iter().filter(|x| !x.is_nan()).map(|x| format!("{x:.4}"));
            format!("({}) m", along.collect::<Vec<_>>().join(", "))
        };
        let percent = |share: f64| format!("{:.3} %", 100.0 * share);
        match self {
            Self::Unknown => Ok(()),
            Self::Rim(at, seen) => {
                let (at, seen) = (place(at), percent(*seen));
                write!(to, "; a node at the rim, at {at}, that sees {seen} of a cell is loose: raise the ghost penalty")
            }
            Self::Loose(_, share) if *share > 0.999 => {
                write!(to, "; the whole body can move without strain: add a support or a contact that holds it")
            }
            Self::Loose(at, share) => {
                let (at, share) = (place(at), percent(*share));
                write!(to, "; {share} of the body, around {at}, has come off: hold it, or end the run before")
            }
            Self::GivesWay(at, share) => {
                let (at, share) = (place(at), percent(*share));
                write!(
                    to,
                    "; the body gives way, most at {at}, with {share} of its elastic stiffness: the load is at its limit"
                )
            }
            Self::Sound(share) => {
                let share = percent(*share);
                write!(
                    to,
                    "; the body resists every motion, with {share} of its elastic stiffness: take shorter load steps"
                )
            }
        }
    }
}

/// Errors in building or running a scene.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A value of the scene is outside its range.
    #[error("{what} = {value} is not allowed: {allowed}")]
    Input {
        /// The field.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// The computation broke down at a particle.
    #[error("step {step} (t = {time} s), particle {particle}: {fault}")]
    Breakdown {
        /// Time at the start of the failed step (s).
        time: f64,
        /// Number of steps completed before.
        step: u64,
        /// Identity of the first offending particle (its place in the seeding order).
        particle: u32,
        /// Failure.
        fault: Fault,
    },
    /// Newton's method found no equilibrium, however short the step. The run keeps the last equilibrium, from which
    /// another rule can continue by [`take_over`](crate::Simulation::take_over).
    #[error(
        "step {step}: no equilibrium found beyond t = {time} s, residual {residual:e} of the loads after {iteration} iterations{cause}"
    )]
    NoConvergence {
        /// Time at the start of the failed part of the step (s).
        time: f64,
        /// Number of steps completed before.
        step: u64,
        /// Iterations done.
        iteration: u32,
        /// The residual over that of the loads.
        residual: f64,
        /// Cause of the failure.
        cause: Cause,
    },
    /// A stiffness matrix could not be factorised, or gave no finite solution, however short the step. The run stays as
    /// with [`NoConvergence`](Self::NoConvergence).
    #[error(
        "step {step}: no equilibrium found beyond t = {time} s, the stiffness matrix is singular in iteration {iteration}{cause}"
    )]
    Singular {
        /// Time at the start of the failed part of the step (s).
        time: f64,
        /// Number of steps completed before.
        step: u64,
        /// Iterations done.
        iteration: u32,
        /// Cause of the failure.
        cause: Cause,
    },
    /// Only a part of an external load acts on the body, or only a part of a drained area drains it.
    #[error("step {step} (t = {time} s): only {value} of the {what} ({whole}) acts on the body")]
    Lost {
        /// Time at the start of the failed part of the step (s).
        time: f64,
        /// Number of steps completed before.
        step: u64,
        /// Name of the quantity: a load, an area.
        what: &'static str,
        /// The sum over the body (N, m²).
        value: f64,
        /// Prescribed value.
        whole: f64,
    },
    /// A body handed over does not match the scene.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

/// Checks that `value` is finite and satisfies `ok`.
pub(crate) fn require(ok: bool, what: &'static str, value: f64, allowed: &'static str) -> Result<(), Error> {
    if ok && value.is_finite() { Ok(()) } else { Err(Error::Input { what, value, allowed }) }
}

/// Checks that there is nothing of what `count` counts.
pub(crate) fn require_none(count: usize, what: &'static str, allowed: &'static str) -> Result<(), Error> {
    require(count == 0, what, count as f64, allowed)
}

/// Checks that `value` is positive and finite.
pub(crate) fn positive(value: f64, what: &'static str, allowed: &'static str) -> Result<(), Error> {
    require(value > 0.0, what, value, allowed)
}
