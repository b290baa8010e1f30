//! Second half of a particle's step, once ΔF is known: law, volume and position, eight particles at a time.

use super::remedy::{DeformationChunk, Known, force_stress};
use super::{ChunkSums, check_cfl};
use crate::basis::Basis;
use crate::bodies::Chunk;
use crate::eights::{AHEAD, Eights, block, blocks, components, entries, numbers, store_numbers, store_vectors};
use crate::grid::Grid;
use crate::number::{EIGHT, Eight, Lanes};
use crate::particles::Particles;
use crate::room::Room;
use crate::tensor::SymmetricTensor;
use std::ops::Range;

/// The stress that enters the forces: the law's, or the one with the `mean` that a remedy gives.
pub(super) struct ForceStress<'a> {
    stress: Eights<'a, SymmetricTensor>,
    /// That mean, J̄ and J, where there is one.
    adjusted: Option<[Eights<'a, f64>; 3]>,
}

impl<'a> ForceStress<'a> {
    /// That of the particles in `range`.
    #[inline(always)]
    pub(super) fn of<const D: usize>(p: &'a Particles<D>, mean: &'a [f64], range: Range<usize>) -> Self {
        let columns = |mean| [mean, &p.j_bar[range.clone()], &p.jacobian[range.clone()]];
        Self {
            stress: Eights::of(&p.stress[range.clone()]),
            adjusted: mean.get(range.clone()).map(|mean| columns(mean).map(Eights::of)),
        }
    }

    /// Asks for the `k`-th eight.
    #[inline(always)]
    pub(super) fn fetch(&self, k: usize) {
        self.stress.fetch(k);
        for column in self.adjusted.iter().flatten() {
            column.fetch(k);
        }
    }

    /// That of the `k`-th eight, in `D` dimensions.
    #[inline(always)]
    pub(super) fn at<const D: usize>(&self, k: usize) -> SymmetricTensor<Eight> {
        let stress = self.stress.at(k);
        let stress = SymmetricTensor::pack(|l| stress[l]);
        match &self.adjusted {
            Some([mean, j_bar, j]) => {
                let ratio = Eight::new(*j_bar.at(k)) / Eight::new(*j.at(k));
                force_stress::<Eight, D>(&stress, ratio, Eight::new(*mean.at(k)))
            }
            None => stress,
        }
    }
}

/// The same of the `k`-th eight of a chunk, with the `mean` of its particles.
#[inline(always)]
pub(super) fn force_stress_of<const D: usize>(p: &Chunk<'_, D>, mean: &[f64], k: usize) -> SymmetricTensor<Eight> {
    let mut spare = None;
    let stress = block(p.stress, k, &mut spare);
    let stress = SymmetricTensor::pack(|l| stress[l]);
    if mean.is_empty() {
        return stress;
    }
    let ratio = numbers(p.j_bar, k) / numbers(p.jacobian, k);
    force_stress::<Eight, D>(&stress, ratio, numbers(mean, k))
}

/// The columns that a remedy averages, of a chunk.
pub(super) fn known<'a, const D: usize>(p: &'a Chunk<'_, D>, deformation: &'a DeformationChunk<'_, D>) -> Known<'a> {
    Known {
        stress: p.stress,
        jacobian: p.jacobian,
        j_bar: p.j_bar,
        volume_change: deformation.volume_change,
        shear: deformation.shear,
    }
}

/// Second half of the particles' step.
pub(super) struct SecondHalf<const D: usize> {
    dt: f64,
    h: f64,
    room: Room<D>,
    /// The square of how far a wave goes in a step, over its modulus ρ₀ c² (m²/Pa).
    reach: f64,
}

impl<const D: usize> SecondHalf<D> {
    /// On `grid`, with steps of `dt` (s) and particles of these half sizes (m), the least dense of which have the
    /// given reference density (kg/m³).
    pub(super) fn of<const S: usize, B: Basis<S>>(grid: &Grid<D>, dt: f64, density: f64, half_size: &[f64; D]) -> Self {
        Self { dt, h: grid.h, room: Room::new(grid, half_size.map(B::beyond_wall)), reach: dt * dt / density }
    }

    /// That of all particles of a chunk, by the deformation that was kept, and J̄ⁿ⁺¹ if it is `next`.
    pub(super) fn finish_all(
        &self,
        p: &mut Chunk<'_, D>,
        deformation: &DeformationChunk<'_, D>,
        next: &[f64],
        sums: &mut ChunkSums,
    ) {
        for k in 0..blocks(p.len()) {
            p.fetch_second_half(k + AHEAD);
            let mut delta_f = deformation.raw(k);
            if !next.is_empty() {
                let (j_bar, next) = (numbers(p.j_bar, k), numbers(next, k));
                store_numbers(p.j_bar, k, next);
                delta_f = deformation.averaged(k, j_bar, next);
            }
            self.finish(p, k, &delta_f, &deformation.increment(k), sums);
        }
    }

    /// Stress, state and volume, Eqs. (15), (22), and position, Eq. (17), of the `k`-th eight of a chunk that deform by
    /// `delta_f` and move by `increment` (m). A particle that breaks down stays where it is, so the state can be
    /// inspected.
    #[inline(never)]
    pub(super) fn finish(
        &self,
        p: &mut Chunk<'_, D>,
        k: usize,
        delta_f: &[[Eight; D]; D],
        increment: &[Eight; D],
        sums: &mut ChunkSums,
    ) {
        let j = numbers(p.jacobian, k);
        let size = EIGHT * p.states.width;
        let here = k * size..p.states.entries.len().min((k + 1) * size);
        let rows = &mut p.states.entries[here];
        let modulus = p.law.update_eight(delta_f.as_flattened(), self.dt, j, rows, &mut p.stress[k * EIGHT..]);
        store_numbers(p.volume, k, j * numbers(p.reference_volume, k));
        sums.wave_modulus = sums.wave_modulus.fast_max(modulus);

        let mut x = components(block(p.position, k, &mut None));
        let mut distance = Eight::ZERO;
        for a in 0..D {
            x[a] += increment[a];
            distance = distance.fast_max(increment[a].abs());
        }
        // A wave and the particle stay within a cell in a step.
        let left = Eight::splat(self.h) - distance;
        let reached = modulus * Eight::splat(self.reach);
        let within = left.simd_ge(Eight::ZERO) & reached.simd_le(left * left);
        if within.all() && self.room.holds_all(&x) {
            store_vectors(p.position, k, &x);
            let largest = distance.to_array().into_iter().fold(0.0, f64::max);
            sums.largest_increment = sums.largest_increment.max(largest);
            return;
        }
        for l in 0..entries(p.len(), k) {
            let (mut next, distance) = (x.map(|x| x.part(l)), distance.part(l));
            let wave = reached.part(l).sqrt();
            let checked = check_cfl(distance + wave, self.h).and_then(|()| self.room.place(&mut next));
            match checked {
                Ok(wrapped) => {
                    p.position[k * EIGHT + l] = next;
                    sums.largest_increment = sums.largest_increment.max(distance);
                    sums.wrapped |= wrapped;
                }
                Err(fault) => {
                    sums.astray.get_or_insert((p.begin + k * EIGHT + l, fault));
                }
            }
        }
    }
}
