//! Remedies for volumetric locking: how the averaged Jacobian J̄ is formed.
//!
//! The F̄ method replaces ΔF by ΔF̄ = (J̄ⁿ⁺¹ / (J̄ⁿ ΔJ))^(1/dim) ΔF, Eq. (25). The members of the
//! family differ in J̄ⁿ⁺¹ alone:
//!
//! | remedy | J̄ⁿ⁺¹ | |
//! |---|---|---|
//! | [`Standard`] | J | standard MPM |
//! | [`FbarRecursive`] | Π(J̄ⁿ ΔJ) | Algorithm 1 as printed, Eq. (26) |
//! | [`FbarTotal`] | Π(Jⁿ⁺¹) | Eqs. (18)–(21), nothing accumulates |
//! | [`FbarRate`] | J̄ⁿ Π(ΔJ) | only the increment is averaged |
//! | [`FbarConsistent`] | J̄ⁿ A(ΔJ), relaxed | the force averages as the rate does: A = I − (1 − ε)(I − Π)² |

mod fbar_consistent;
mod fbar_rate;
mod fbar_recursive;
mod fbar_total;
mod standard;

pub use fbar_consistent::FbarConsistent;
pub use fbar_rate::FbarRate;
pub use fbar_recursive::FbarRecursive;
pub use fbar_total::FbarTotal;
pub use standard::Standard;

use crate::memory::Memory;
use crate::parallel::CHUNK;
use crate::particles::Particles;
use crate::projection::Average;
use crate::space::{determinant, stretch_of_volume};
use crate::tensor::SymmetricTensor;
use rayon::prelude::*;

/// A locking remedy of a body. What it remembers of a particle, J̄, is a column of the particles.
pub trait Remedy<const D: usize>: Memory + Send {
    /// Gives the particles the columns that the remedy needs.
    fn attach(&mut self, _particles: &mut Particles<D>) {}

    /// Before the forces are formed: fills `stress` with the stress (Pa) that enters them, of a remedy that averages the
    /// pressure as well; of others `stress` stays empty, and the law's enters them.
    fn force_stress(
        &mut self,
        _particles: &Particles<D>,
        _average: &mut dyn Average<D>,
        _stress: &mut Vec<SymmetricTensor>,
    ) {
    }

    /// After ΔF and J are known: J̄ⁿ⁺¹ of every particle, unless that is J. Positions, volumes and J̄ are still those of
    /// the step's start; it can be asked for again after other ΔF, and [`commit`] makes it that of the particles.
    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]>;
}

/// Fills `out` with `f(particle)`, in parallel.
fn fill(out: &mut Vec<f64>, n: usize, f: impl Fn(usize) -> f64 + Sync) {
    out.resize(n, 0.0);
    out.par_chunks_mut(CHUNK).enumerate().for_each(|(c, out)| {
        for (k, value) in out.iter_mut().enumerate() {
            *value = f(c * CHUNK + k);
        }
    });
}

/// Sets J̄ to `next` and scales ΔF to ΔF̄, Eq. (25).
pub fn commit<const D: usize>(particles: &mut Particles<D>, next: &[f64]) {
    particles
        .delta_f
        .par_chunks_mut(CHUNK)
        .zip(particles.j_bar.par_chunks_mut(CHUNK))
        .zip(next.par_chunks(CHUNK))
        .for_each(|((delta_f, j_bar), next)| {
            for ((delta_f, j_bar), next) in delta_f.iter_mut().zip(j_bar).zip(next) {
                let volume_ratio = next / (*j_bar * determinant(delta_f));
                *delta_f *= stretch_of_volume::<D>(volume_ratio);
                *j_bar = *next;
            }
        });
}

#[cfg(test)]
mod tests;
