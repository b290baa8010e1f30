//! Recursive F̄: J̄ⁿ⁺¹ = Π(J̄ⁿ ΔJ), Eq. (26).

use super::{Remedy, fill};
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;
use crate::space::determinant;

/// Algorithm 1 as printed. The field already averaged is averaged again in every step, which diffuses
/// J̄ with D = ½ s² h²/Δt, s² being the spread of Π: see `docs/method.md`.
#[derive(Debug, Clone, Default)]
pub struct FbarRecursive {
    next: Vec<f64>,
}

impl Memoryless for FbarRecursive {}

impl<const D: usize> Remedy<D> for FbarRecursive {
    fn attach(&mut self, particles: &mut Particles<D>) {
        particles.j_bar = particles.jacobian.clone();
    }

    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]> {
        fill(&mut self.next, particles.len(), |p| {
            particles.j_bar[p] * determinant(&particles.delta_f[p])
        });
        average.average(particles, &mut self.next);
        Some(&self.next)
    }
}
