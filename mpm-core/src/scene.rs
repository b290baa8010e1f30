//! Everything that a run is made of.

use crate::basis::WallTreatment;
use crate::contact::RigidContact;
use crate::explicit::remedy::Remedy;
use crate::explicit::transfer::Flip;
use crate::grid::Grid;
use crate::material::Law;
use crate::particles::Particles;
use crate::stage::{Constraint, ForceFilter, Load, ParticleFilter};

/// Everything that a run is made of. Stages that a scene doesn't have are empty lists.
pub struct Scene<const D: usize, M: Law, T = Flip> {
    /// The grid.
    pub grid: Grid<D>,
    /// How B-splines meet walls.
    pub wall: WallTreatment,
    /// The law of the body.
    pub law: M,
    /// The particle–grid transfer.
    pub transfer: T,
    /// The particles of the body.
    pub particles: Particles<D>,
    /// The locking remedy of the body.
    pub remedy: Box<dyn Remedy<D>>,
    /// Loads.
    pub loads: Vec<Box<dyn Load<D>>>,
    /// Contacts with rigid bodies.
    pub contacts: Vec<RigidContact<D>>,
    /// Filters of nodal forces.
    pub force_filters: Vec<Box<dyn ForceFilter>>,
    /// Constraints.
    pub constraints: Vec<Box<dyn Constraint<D>>>,
    /// Filters of particles.
    pub particle_filters: Vec<Box<dyn ParticleFilter<D>>>,
    /// Time step Δt (s).
    pub dt: f64,
}

impl<const D: usize, M: Law, T> Scene<D, M, T> {
    /// The scene with another transfer.
    #[must_use]
    pub fn with_transfer<U>(self, transfer: U) -> Scene<D, M, U> {
        Scene {
            grid: self.grid,
            wall: self.wall,
            law: self.law,
            transfer,
            particles: self.particles,
            remedy: self.remedy,
            loads: self.loads,
            contacts: self.contacts,
            force_filters: self.force_filters,
            constraints: self.constraints,
            particle_filters: self.particle_filters,
            dt: self.dt,
        }
    }
}
