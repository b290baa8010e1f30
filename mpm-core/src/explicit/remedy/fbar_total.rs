//! Total F̄: J̄ⁿ⁺¹ = Π(Jⁿ⁺¹), Eqs. (18)–(21).

use super::{Deformation, Remedy};
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;

/// The average of the true Jacobian; nothing accumulates.
#[derive(Debug, Clone, Default)]
pub struct FbarTotal {
    next: Vec<f64>,
}

impl Memoryless for FbarTotal {}

impl<const D: usize> Remedy<D> for FbarTotal {
    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        _deformation: &Deformation<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]> {
        self.next.clone_from(&particles.jacobian);
        average.average(particles, &mut self.next);
        Some(&self.next)
    }
}
