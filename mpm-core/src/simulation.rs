//! Interface of a run, whatever its solver.

use crate::error::Error;
use crate::ledger::Ledger;
use crate::memory::{Memory, Saved};
use crate::monitor::{Convergence, Reaction, Residual, Totals, WaterBalance};
use crate::particles::Particles;
pub use crate::scene::Part;
use crate::scene::Scene;
use crate::tensor::SymmetricTensor;
use crate::work::{Spent, Work};

/// A field over the particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// Mean normal stress (Pa, tension positive) that enters the forces.
    MeanStress,
    /// Its average Π over the volume.
    AveragedMeanStress,
    /// Equivalent plastic strain.
    PlasticStrain,
    /// Pore pressure (Pa, compression positive); none of a body without water.
    PorePressure,
    /// Porosity; none of a body without water.
    Porosity,
}

/// A run, whatever its solver, basis and law.
pub trait Simulation<const D: usize>: Memory + Send {
    /// Advances by one step.
    ///
    /// # Errors
    /// [`Error::Breakdown`] when the computation breaks down; the state is then that of the middle
    /// of the step and no further step makes sense.
    fn step(&mut self) -> Result<(), Error>;
    /// Advances by several steps.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn advance(&mut self, steps: usize) -> Result<(), Error> {
        (0..steps).try_for_each(|_| self.step())
    }

    /// Time, sums, reactions and counters so far.
    fn ledger(&self) -> &Ledger;
    /// Time (s).
    fn time(&self) -> f64 {
        self.ledger().time
    }
    /// The scene as it is now.
    fn scene(&self) -> &Scene<D>;
    /// The particles of all bodies, those of a body sorted by place.
    fn particles(&self) -> &Particles<D> {
        &self.scene().bodies.particles
    }
    /// Mass, momentum, energies, J.
    fn totals(&self) -> Totals {
        self.scene().bodies.totals(self.ledger().accumulated)
    }
    /// Out-of-balance and held forces of the last step.
    fn residual(&self) -> Residual {
        self.ledger().residual
    }
    /// How Newton's method came to the end of the last step, of a solver that has one.
    fn convergence(&self) -> Option<&Convergence> {
        self.ledger().convergence.as_ref()
    }
    /// An estimate of the condition, in the 1-norm, of the stiffness matrix of the body as it is, scaled to a diagonal
    /// of ones; NaN of a solver without one, infinite of a singular one.
    fn condition(&self) -> f64 {
        f64::NAN
    }
    /// Work counters so far.
    fn work(&self) -> Work {
        self.ledger().work
    }
    /// Wall time that the parts of Newton's iterations took since this solver was made; nothing of other solvers.
    fn spent(&self) -> Spent {
        self.ledger().spent
    }
    /// Reaction of a part of the scene; NaN for a part that does not exist.
    fn on(&self, part: Part) -> Reaction {
        self.ledger().on(part, &self.scene().contacts)
    }
    /// Water balance, of a body with water.
    fn water(&self) -> Option<&WaterBalance> {
        None
    }
    /// The nodes of the pore pressure that particles see, by place (m) and pressure (Pa); none of a body without water.
    fn pressure_nodes(&self) -> Vec<([f64; D], f64)> {
        Vec::new()
    }
    /// The stress of every particle (Pa) that enters the next forces: the law's, with the remedy's share.
    fn force_stress(&mut self) -> Vec<SymmetricTensor>;
    /// A field, one value per particle.
    fn field(&mut self, field: Field) -> Vec<f64>;
    /// The body, particles with their states, and the sticks of the contacts, as bytes.
    ///
    /// # Errors
    /// [`Error::Memory`], as [`Memory::save`].
    fn body(&self) -> Result<Saved, Error>;
    /// Goes on with the [`body`](Self::body) of another run of the same basis, remedy, transfer and kind of law: under
    /// the stages and with the constants of this one, whose time and sums stay as they are. Sticks go along, contact by
    /// contact in the scenes' order.
    ///
    /// Explicit runs have the same particles. An implicit run may have fewer, those that were seeded first: the others
    /// are taken away, as an excavation does. It may go on by another time rule: what a static run has not, begins at
    /// rest, and Newmark's accelerations are those of the forces now.
    ///
    /// # Errors
    /// [`Error::Memory`], as [`Memory::restore`]; the run then stays as it was.
    fn take_over(&mut self, body: &Saved) -> Result<(), Error>;
}
