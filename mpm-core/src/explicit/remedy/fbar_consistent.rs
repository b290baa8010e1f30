//! Energy-consistent F̄: one average A in the rate of volume and in the pressure of the force.

use super::{Remedy, fill};
use crate::memory::Memoryless;
use crate::parallel::CHUNK;
use crate::particles::Particles;
use crate::projection::Average;
use crate::space::determinant;
use crate::tensor::SymmetricTensor;
use nalgebra::SMatrix;
use rayon::prelude::*;

/// J̄ⁿ⁺¹ = J̄ⁿ A(ΔJ), less a relaxation of what Π can't see, and the force from the stress
/// (J̄/J) dev σ + A((J̄/J) p) I, with A = I − (1 − ε)(I − Π)², ε = 0.01.
///
/// A is symmetric in the volume-weighted product, as Π is, so the power that the pressure takes from
/// the grid is the rate of the energy stored: `docs/remedy.md` derives it. It errs by the square of
/// Π's error. What Π can't see keeps the share ε of its strain, a stiffness ε² K, so that a pressure
/// doesn't feed it. It fills as particles pass each other, and is
/// emptied by J̄ ← J̄ − (I − Π) θ (I − Π) J̄ with θ = min(1, β γ) and γ the shear strain of the step,
/// which keeps the volume, never adds energy to first order, and does nothing at rest.
#[derive(Debug, Clone)]
pub struct FbarConsistent {
    relaxation: f64,
    field: Vec<f64>,
    rest: Vec<f64>,
}

/// The relaxation β that serves every problem of the bench.
const RELAXATION: f64 = 10.0;
/// The share ε of a strain that Π can't see which is kept. ε² K has to hold against the pressure of a body,
/// 10⁻⁴ K is ten times that of two metres of water; from 0.1 on bodies lock (`docs/remedy.md`).
const UNSEEN: f64 = 0.01;

impl Default for FbarConsistent {
    fn default() -> Self {
        Self::new(RELAXATION)
    }
}

impl FbarConsistent {
    /// With relaxation β (dimensionless, zero for none).
    #[must_use]
    pub fn new(relaxation: f64) -> Self {
        Self {
            relaxation,
            field: Vec::new(),
            rest: Vec::new(),
        }
    }

    /// Replaces `field` by A `field` = Π field + ε r + (1 − ε) Π r with r = (I − Π) field.
    fn average<const D: usize>(&mut self, particles: &Particles<D>, average: &mut dyn Average<D>) {
        self.rest.clone_from(&self.field);
        average.average(particles, &mut self.rest);
        for_each_pair(&mut self.field, &mut self.rest, |_, field, smooth| {
            let rough = *field - *smooth;
            *field = *smooth + UNSEEN * rough;
            *smooth = rough;
        });
        average.average(particles, &mut self.rest);
        for_each_pair(&mut self.field, &mut self.rest, |_, field, seen| {
            *field += (1.0 - UNSEEN) * *seen;
        });
    }

    /// Takes (I − Π) θ (I − Π) `field` off `field`.
    fn relax<const D: usize>(&mut self, particles: &Particles<D>, average: &mut dyn Average<D>) {
        self.rest.clone_from(&self.field);
        average.average(particles, &mut self.rest);
        let relaxation = self.relaxation;
        for_each_pair(&mut self.field, &mut self.rest, |p, field, rest| {
            let theta = (relaxation * shear(&particles.delta_f[p])).min(1.0);
            *rest = theta * (*field - *rest);
            *field -= *rest;
        });
        average.average(particles, &mut self.rest);
        for_each_pair(&mut self.field, &mut self.rest, |_, field, smooth| {
            *field += *smooth;
        });
    }
}

/// `change(p, a, b)` for the entries of two fields at every particle p, in parallel.
fn for_each_pair(a: &mut [f64], b: &mut [f64], change: impl Fn(usize, &mut f64, &mut f64) + Sync) {
    a.par_chunks_mut(CHUNK)
        .zip(b.par_chunks_mut(CHUNK))
        .enumerate()
        .for_each(|(c, (a, b))| {
            for (k, (a, b)) in a.iter_mut().zip(b).enumerate() {
                change(c * CHUNK + k, a, b);
            }
        });
}

/// √2 ‖dev sym(ΔF − I)‖, the shear strain of a step; the deviator is that of the motion's own dimensions.
fn shear<const D: usize>(delta_f: &SMatrix<f64, D, D>) -> f64 {
    let strain = 0.5 * (delta_f + delta_f.transpose());
    let mean = (0..D).map(|a| strain[(a, a)]).sum::<f64>() / D as f64;
    let mut squares = 0.0;
    for a in 0..D {
        for b in 0..D {
            let e = strain[(a, b)] - if a == b { mean } else { 0.0 };
            squares += e * e;
        }
    }
    (2.0 * squares).sqrt()
}

/// The part of a stress that works on a change of volume: in plane strain, the in-plane mean.
fn mean<const D: usize>(stress: &SymmetricTensor) -> f64 {
    (0..D).map(|a| stress.get(a, a)).sum::<f64>() / D as f64
}

impl Memoryless for FbarConsistent {}

impl<const D: usize> Remedy<D> for FbarConsistent {
    fn attach(&mut self, particles: &mut Particles<D>) {
        particles.j_bar = particles.jacobian.clone();
    }

    fn force_stress(
        &mut self,
        particles: &Particles<D>,
        average: &mut dyn Average<D>,
        stress: &mut Vec<SymmetricTensor>,
    ) {
        stress.resize(particles.len(), SymmetricTensor::default());
        stress
            .par_chunks_mut(CHUNK)
            .zip(particles.stress.par_chunks(CHUNK))
            .zip(particles.jacobian.par_chunks(CHUNK))
            .zip(particles.j_bar.par_chunks(CHUNK))
            .for_each(|(((stress, own), j), j_bar)| {
                for (((stress, own), j), j_bar) in stress.iter_mut().zip(own).zip(j).zip(j_bar) {
                    *stress = own.scale_add_identity(j_bar / j, 0.0);
                }
            });
        fill(&mut self.field, particles.len(), |p| mean::<D>(&stress[p]));
        self.average(particles, average);
        stress
            .par_chunks_mut(CHUNK)
            .zip(self.field.par_chunks(CHUNK))
            .for_each(|(stress, averaged)| {
                for (stress, averaged) in stress.iter_mut().zip(averaged) {
                    *stress = stress.scale_add_identity(1.0, averaged - mean::<D>(stress));
                }
            });
    }

    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]> {
        fill(&mut self.field, particles.len(), |p| {
            determinant(&particles.delta_f[p])
        });
        self.average(particles, average);
        self.field
            .par_chunks_mut(CHUNK)
            .zip(particles.j_bar.par_chunks(CHUNK))
            .for_each(|(field, j_bar)| {
                for (next, j_bar) in field.iter_mut().zip(j_bar) {
                    *next *= j_bar;
                }
            });
        if self.relaxation > 0.0 {
            self.relax(particles, average);
        }
        Some(&self.field)
    }
}
