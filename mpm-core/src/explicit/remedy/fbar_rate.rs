//! Rate F̄: J̄ⁿ⁺¹ = J̄ⁿ Π(ΔJ).

use super::{Deformation, Remedy, fill_with_products};
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;

/// Only the increment of the volume is averaged.
#[derive(Debug, Clone, Default)]
pub struct FbarRate {
    averaged: Vec<f64>,
    next: Vec<f64>,
}

impl Memoryless for FbarRate {}

impl<const D: usize> Remedy<D> for FbarRate {
    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        deformation: &Deformation<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]> {
        self.averaged.clone_from(&deformation.volume_change);
        average.average(particles, &mut self.averaged);
        fill_with_products(&mut self.next, &particles.j_bar, &self.averaged);
        Some(&self.next)
    }
}
