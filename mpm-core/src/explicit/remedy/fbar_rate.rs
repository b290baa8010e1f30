//! Rate F̄: J̄ⁿ⁺¹ = J̄ⁿ Π(ΔJ).

use super::{Remedy, fill};
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;
use crate::space::determinant;

/// Only the increment of the volume is averaged.
#[derive(Debug, Clone, Default)]
pub struct FbarRate {
    next: Vec<f64>,
}

impl Memoryless for FbarRate {}

impl<const D: usize> Remedy<D> for FbarRate {
    fn attach(&mut self, particles: &mut Particles<D>) {
        particles.j_bar = particles.jacobian.clone();
    }

    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]> {
        fill(&mut self.next, particles.len(), |p| {
            determinant(&particles.delta_f[p])
        });
        average.average(particles, &mut self.next);
        for (next, j_bar) in self.next.iter_mut().zip(&particles.j_bar) {
            *next *= j_bar;
        }
        Some(&self.next)
    }
}
