//! Remedies for volumetric locking: how the averaged Jacobian J̄ is formed.
//!
//! The F̄ method replaces ΔF by ΔF̄ = (J̄ⁿ⁺¹ / (J̄ⁿ ΔJ))^(1/dim) ΔF, Eq. (25). [`Standard`] MPM has J̄ = J. Members of the
//! family [`Fbar`] differ in the [`Form`] of J̄ⁿ⁺¹ and of the force, and in the functions that Π averages with.

mod fbar;

pub use crate::projection::Onto;
pub use fbar::{Fbar, Form};

use crate::eights::{Eights, blocks, numbers, store_numbers};
use crate::memory::{Memory, Memoryless};
use crate::number::{Eight, Real};
use crate::parallel::{CHUNK, Front, for_each_piece};
use crate::particles::Particles;
use crate::projection::Average;
use crate::space::stretch_of_volume;
use crate::tensor::SymmetricTensor;
use std::ops::Range;

/// How particles move and deform in a step, where something stands between G2P and the law that needs it of all: in
/// eights, and what a remedy averages in columns.
#[derive(Debug, Clone, Default)]
pub struct Deformation<const D: usize> {
    /// ΔF, Eq. (16).
    pub delta_f: Vec<[[Eight; D]; D]>,
    /// Displacement (m).
    pub increment: Vec<[Eight; D]>,
    /// ΔJ = det ΔF.
    pub volume_change: Vec<f64>,
    /// Shear strain √2 ‖dev sym(ΔF − I)‖, of a remedy that asks for it; the deviator is that of the motion's own
    /// dimensions.
    pub shear: Vec<f64>,
}

impl<const D: usize> Deformation<D> {
    /// Room for bodies with these numbers of particles.
    #[must_use]
    pub fn of(remedy: &dyn Remedy<D>, lengths: &[usize]) -> Self {
        let (n, eights) = (lengths.iter().sum(), lengths.iter().map(|n| blocks(*n)).sum());
        Self {
            delta_f: vec![[[Eight::ZERO; D]; D]; eights],
            increment: vec![[Eight::ZERO; D]; eights],
            volume_change: vec![0.0; n],
            shear: vec![0.0; if remedy.asks_for_shear() { n } else { 0 }],
        }
    }

    /// All of it, for threads to share in chunks.
    pub fn chunk(&mut self) -> DeformationChunk<'_, D> {
        DeformationChunk {
            delta_f: &mut self.delta_f,
            increment: &mut self.increment,
            volume_change: &mut self.volume_change,
            shear: &mut self.shear,
        }
    }
}

/// The deformation of some particles.
pub struct DeformationChunk<'a, const D: usize> {
    delta_f: &'a mut [[[Eight; D]; D]],
    increment: &'a mut [[Eight; D]],
    volume_change: &'a mut [f64],
    shear: &'a mut [f64],
}

impl<const D: usize> Front for DeformationChunk<'_, D> {
    fn front(&mut self, pieces: usize, size: usize) -> Self {
        Self {
            delta_f: self.delta_f.front(pieces, blocks(size)),
            increment: self.increment.front(pieces, blocks(size)),
            volume_change: self.volume_change.front(pieces, size),
            shear: self.shear.front(pieces, size),
        }
    }
}

impl<const D: usize> DeformationChunk<'_, D> {
    /// Whether there is one.
    #[inline(always)]
    pub fn is_there(&self) -> bool {
        !self.delta_f.is_empty()
    }

    /// Keeps that of the `k`-th eight: ΔF, its determinant and the displacement (m).
    #[inline(always)]
    pub fn keep(&mut self, k: usize, delta_f: &[[Eight; D]; D], volume_change: Eight, increment: &[Eight; D]) {
        self.delta_f[k] = *delta_f;
        self.increment[k] = *increment;
        store_numbers(self.volume_change, k, volume_change);
        if !self.shear.is_empty() {
            store_numbers(self.shear, k, shear(delta_f));
        }
    }

    /// ΔF of the `k`-th eight.
    #[inline(always)]
    pub fn raw(&self, k: usize) -> [[Eight; D]; D] {
        self.delta_f[k]
    }

    /// ΔF̄ of the `k`-th eight, Eq. (25), from J̄ at the begin of the step and the `next`.
    #[inline(always)]
    pub fn averaged(&self, k: usize, j_bar: Eight, next: Eight) -> [[Eight; D]; D] {
        let stretch = stretch_of_volume::<Eight, D>(next / (j_bar * numbers(self.volume_change, k)));
        self.delta_f[k].map(|row| row.map(|entry| entry * stretch))
    }

    /// The displacement (m) of the `k`-th eight.
    #[inline(always)]
    pub fn increment(&self, k: usize) -> [Eight; D] {
        self.increment[k]
    }
}

/// √2 ‖dev sym(ΔF − I)‖.
#[inline(always)]
fn shear<const D: usize>(delta_f: &[[Eight; D]; D]) -> Eight {
    let mut mean = Eight::ZERO;
    for a in 0..D {
        mean += delta_f[a][a];
    }
    mean *= Eight::splat(1.0 / D as f64);
    let mut squares = Eight::ZERO;
    for a in 0..D {
        for b in 0..D {
            let strain = Eight::splat(0.5) * (delta_f[a][b] + delta_f[b][a]);
            let e = if a == b { strain - mean } else { strain };
            squares = e.mul_add(e, squares);
        }
    }
    (squares + squares).sqrt()
}

/// A locking remedy of a body. Its state, J̄, is a column of the particles.
pub trait Remedy<const D: usize>: Memory + Send {
    /// Gives the particles the columns that the remedy needs: J̄, if it averages.
    fn attach(&mut self, particles: &mut Particles<D>) {
        if self.averages_onto().is_some() {
            particles.j_bar = particles.jacobian.clone();
        }
    }

    /// The functions that J̄ is averaged with; of a remedy without them, J̄ is J.
    fn averages_onto(&self) -> Option<Onto> {
        Some(Onto::Basis)
    }

    /// Whether it averages more where there is shear.
    fn asks_for_shear(&self) -> bool {
        false
    }

    /// Before the forces are formed: fills `mean` with the mean stress (Pa) that enters them by [`force_stress`], of a
    /// remedy that averages the pressure as well; of others `mean` stays empty, and the law's stress enters them.
    fn force_mean(&mut self, _particles: &Particles<D>, _average: &mut dyn Average<D>, _mean: &mut Vec<f64>) {}

    /// After ΔF and J are known: J̄ⁿ⁺¹ of every particle, unless that is J. Positions, volumes and J̄ are still those
    /// of the step's start; it can be asked for again after other ΔF. Who takes the step makes it that of the
    /// particles.
    fn next_j_bar(
        &mut self,
        particles: &Particles<D>,
        deformation: &Deformation<D>,
        average: &mut dyn Average<D>,
    ) -> Option<&[f64]>;
}

/// No remedy: ΔF̄ = ΔF, no averaged Jacobian is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Standard;

impl Memoryless for Standard {}

impl<const D: usize> Remedy<D> for Standard {
    fn averages_onto(&self) -> Option<Onto> {
        None
    }

    fn next_j_bar(&mut self, _: &Particles<D>, _: &Deformation<D>, _: &mut dyn Average<D>) -> Option<&[f64]> {
        None
    }
}

/// Fills `out` with the products of two columns.
fn fill_with_products(out: &mut Vec<f64>, a: &[f64], b: &[f64]) {
    fill(out, a.len(), |chunk| {
        let (a, b) = (Eights::of(&a[chunk.clone()]), Eights::of(&b[chunk]));
        move |k| Eight::new(*a.at(k)) * Eight::new(*b.at(k))
    });
}

/// Fills `out` with numbers, `n` in all. `of_chunk(particles)` gives what makes those of the `k`-th eight of them.
fn fill<F: Fn(usize) -> Eight>(out: &mut Vec<f64>, n: usize, of_chunk: impl Fn(Range<usize>) -> F + Sync) {
    out.resize(n, 0.0);
    for_each_piece(&mut out[..], n, CHUNK, &|begin, out| {
        let f = of_chunk(begin..begin + out.len());
        for k in 0..blocks(out.len()) {
            store_numbers(out, k, f(k));
        }
    });
}

/// The part of a stress that works on a change of volume: in plane strain, the in-plane mean.
#[inline(always)]
fn mean<T: Real, const D: usize>(stress: &SymmetricTensor<T>) -> T {
    let mut sum = T::default();
    for a in 0..D {
        sum += stress.get(a, a);
    }
    sum * T::splat(1.0 / D as f64)
}

/// The stress that enters the forces where a remedy gives its `mean`: (J̄/J) dev σ and that mean; `ratio` is J̄/J.
#[inline(always)]
pub fn force_stress<T: Real, const D: usize>(stress: &SymmetricTensor<T>, ratio: T, of_force: T) -> SymmetricTensor<T> {
    stress.scale_add_identity(ratio, of_force - ratio * mean::<T, D>(stress))
}
