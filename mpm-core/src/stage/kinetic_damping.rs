//! Kinetic damping: dynamic relaxation towards equilibrium.

use super::ParticleFilter;
use crate::particles::Particles;

/// Sets all velocities to zero whenever the kinetic energy has passed a peak (Cundall 1976): near a
/// peak the stored energy is near its least, and there is no coefficient to choose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KineticDamping {
    previous: f64,
}

impl<const D: usize> ParticleFilter<D> for KineticDamping {
    fn filter(&mut self, kinetic_energy: f64, particles: &mut Particles<D>) -> f64 {
        if kinetic_energy >= self.previous {
            self.previous = kinetic_energy;
            return 0.0;
        }
        particles.velocity.fill([0.0; D]);
        self.previous = 0.0;
        kinetic_energy
    }
}
