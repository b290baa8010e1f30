//! Recursive F̄: J̄ⁿ⁺¹ = Π(J̄ⁿ ΔJ), Eq. (26).

use super::{Deformation, Remedy, fill_with_products};
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;

/// Algorithm 1 as printed. The field already averaged is averaged again in every step, which diffuses
/// J̄ with D = ½ s² h²/Δt, s² being the spread of Π: see `docs/method.md`.
#[derive(Debug, Clone, Default)]
pub struct FbarRecursive {
    next: Vec<f64>,
}

impl Memoryless for FbarRecursive {}

impl<const D: usize> Remedy<D> for FbarRecursive {
    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        deformation: &Deformation<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]> {
        let change = &deformation.volume_change;
        fill_with_products(&mut self.next, &particles.j_bar, change);
        average.average(particles, &mut self.next);
        Some(&self.next)
    }
}
