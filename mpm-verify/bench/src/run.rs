//! Runs of cases, which the bench is given.

use crate::turn::Error;
use mpm_core::{Memory, Spent};
use mpm_solvers::scheme::Scheme;

/// A running simulation of a verification case.
pub trait Run: Send {
    /// Runs to the next time of observation.
    ///
    /// # Errors
    /// The computation broke down.
    fn advance(&mut self) -> Result<(), Error>;
    /// Whether the run is complete.
    fn finished(&self) -> bool;
    /// Number of particles.
    fn particles(&self) -> u64;
    /// Particle updates so far.
    fn particle_steps(&self) -> u64;
    /// Newton iterations so far.
    fn newton_iterations(&self) -> u64;
    /// Time that the parts of the Newton iterations took so far.
    fn spent(&self) -> Spent;
    /// State of the run.
    fn memory(&self) -> &dyn Memory;
}

/// Begins a run of a case at a level with a scheme and the case's own parameters.
pub type Begin = fn(&str, &str, Scheme) -> Result<Box<dyn Run>, Error>;
