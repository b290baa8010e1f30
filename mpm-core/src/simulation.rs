//! What can be done with a run and asked of it.

use crate::error::Error;
use crate::memory::{Memory, Saved};
use crate::monitor::{Residual, Totals};
use crate::particles::Particles;
use crate::tensor::SymmetricTensor;
use crate::work::Work;

/// A run, whatever its basis and law.
pub trait Simulation<const D: usize>: Memory + Send {
    /// Advances by one step.
    ///
    /// # Errors
    /// [`Error::Breakdown`] when the computation breaks down; the state is then that of the middle
    /// of the step and no further step makes sense.
    fn step(&mut self) -> Result<(), Error>;
    /// Time (s).
    fn time(&self) -> f64;
    /// The particles, sorted by place.
    fn particles(&self) -> &Particles<D>;
    /// Mass, momentum, energies, J.
    fn totals(&self) -> Totals;
    /// Out-of-balance and held forces of the last step.
    fn residual(&self) -> Residual;
    /// The force of the body on the constraint with this place in the scene's list in the last step (N):
    /// the nodal forces at the components that it holds. NaN of a constraint that there isn't.
    fn force_on(&self, constraint: usize) -> [f64; 3];
    /// The impulse of the body on the constraint with this place in the scene's list since time zero (N s): the
    /// momentum that it took. Beside the nodal forces it has what the particles brought to the held nodes. NaN of a
    /// constraint that there isn't.
    fn impulse_on(&self, constraint: usize) -> [f64; 3];
    /// The force of the body on the rigid body of the contact with this place in the scene's list in the last step
    /// (N). NaN of a contact that there isn't.
    fn reaction(&self, contact: usize) -> [f64; 3];
    /// What the run did so far.
    fn work(&self) -> Work;
    /// Replaces `field` (one value per particle) by its average Π `field`.
    fn average(&mut self, field: &mut [f64]);
    /// The stress of every particle (Pa) with which it enters the next forces: the law's, with the
    /// remedy's share.
    fn force_stress(&mut self) -> Vec<SymmetricTensor>;
    /// The equivalent plastic strain of every particle.
    fn plastic_strain(&self) -> Vec<f64>;
    /// The body, particles with their states, as bytes.
    ///
    /// # Errors
    /// [`Error::Memory`], as [`Memory::save`].
    fn body(&self) -> Result<Saved, Error>;
    /// Goes on with the [`body`](Self::body) of another run of the same particles, basis, remedy, transfer and kind of
    /// law: under the stages and with the constants of this one, whose time and sums stay as they are.
    ///
    /// # Errors
    /// [`Error::Memory`], as [`Memory::restore`]; the run then stays as it was.
    fn take_over(&mut self, body: &Saved) -> Result<(), Error>;
}
