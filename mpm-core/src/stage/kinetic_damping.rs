//! Kinetic damping: dynamic relaxation towards equilibrium.

use super::ParticleFilter;
use crate::memory::{Memory, MemoryError, Saved};
use crate::particles::Particles;
use nalgebra::SMatrix;

/// Sets all velocities to zero whenever the kinetic energy of the nodes has passed a peak (Cundall
/// 1976): near a peak the stored energy is near its least, and there is no coefficient to choose.
///
/// The peak is sought in the energy of the nodes because particles also carry velocities that no
/// node sees (the null space of the transfer), whose slow growth would hide the peaks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KineticDamping {
    previous: f64,
}

impl Memory for KineticDamping {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&self.previous)
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        self.previous = saved.read("kinetic damping")?;
        Ok(())
    }
}

impl<const D: usize> ParticleFilter<D> for KineticDamping {
    fn filter(&mut self, nodal_kinetic_energy: f64, particles: &mut Particles<D>) -> f64 {
        if nodal_kinetic_energy >= self.previous {
            self.previous = nodal_kinetic_energy;
            return 0.0;
        }
        let loss = particles.kinetic_energy();
        particles.velocity.fill([0.0; D]);
        particles.affine.fill(SMatrix::zeros());
        self.previous = 0.0;
        loss
    }
}
