//! Remedies for volumetric locking: how the averaged Jacobian J̄ is formed.
//!
//! The F̄ method replaces ΔF by ΔF̄ = (J̄ⁿ⁺¹ / (J̄ⁿ ΔJ))^(1/dim) ΔF, Eq. (25). [`Standard`] MPM has J̄ = J. Members of the
//! family [`Fbar`] differ in the [`Form`] of J̄ⁿ⁺¹ and of the force, and in the functions that Π averages with.

mod fbar;

pub use crate::projection::Onto;
pub use fbar::{Fbar, Form};

use crate::eights::{blocks, numbers, store_numbers};
use crate::memory::{Memory, Memoryless};
use crate::number::{Eight, Real};
use crate::parallel::{CHUNK, Front, for_each_piece};
use crate::particles::Particles;
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
    /// ΔJ and the shear strain, as those of all.
    pub volume_change: &'a mut [f64],
    /// See there.
    pub shear: &'a mut [f64],
}

impl<const D: usize> Front for DeformationChunk<'_, D> {
    fn front(&mut self, pieces: usize, entries: usize) -> Self {
        Self {
            delta_f: self.delta_f.front(pieces, blocks(entries)),
            increment: self.increment.front(pieces, blocks(entries)),
            volume_change: self.volume_change.front(pieces, entries),
            shear: self.shear.front(pieces, entries),
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

/// Columns that a remedy averages, of some particles.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a> {
    /// Cauchy stress (Pa).
    pub stress: &'a [SymmetricTensor],
    /// J.
    pub jacobian: &'a [f64],
    /// J̄ at the step's start.
    pub j_bar: &'a [f64],
    /// ΔJ, once it is known.
    pub volume_change: &'a [f64],
    /// Shear strain of the step, where the remedy asks for it.
    pub shear: &'a [f64],
}

impl<'a> Known<'a> {
    /// That of all particles.
    pub fn of<const D: usize>(particles: &'a Particles<D>, deformation: &'a Deformation<D>) -> Self {
        Self {
            stress: &particles.stress,
            jacobian: &particles.jacobian,
            j_bar: &particles.j_bar,
            volume_change: &deformation.volume_change,
            shear: &deformation.shear,
        }
    }
}

/// Columns that a remedy fills; those that it doesn't use are empty.
#[derive(Debug, Clone, Default)]
pub struct Columns {
    /// J̄ⁿ⁺¹.
    pub next: Vec<f64>,
    /// Mean stress (Pa) that enters the forces by [`force_stress`].
    pub mean: Vec<f64>,
    /// The share of a strain that averages don't see which is kept; empty where all particles have the same.
    pub kept: Vec<f64>,
    /// The rest that averages leave over.
    pub rest: Vec<f64>,
}

/// The same of some particles.
pub struct Filled<'a> {
    /// J̄ⁿ⁺¹.
    pub next: &'a mut [f64],
    /// Mean stress (Pa).
    pub mean: &'a mut [f64],
    /// Share of what is not seen.
    pub kept: &'a mut [f64],
    /// The rest that averages leave over.
    pub rest: &'a mut [f64],
}

impl Columns {
    /// All of them, for threads to share.
    pub fn all(&mut self) -> Filled<'_> {
        Filled { next: &mut self.next, mean: &mut self.mean, kept: &mut self.kept, rest: &mut self.rest }
    }
}

impl Front for Filled<'_> {
    fn front(&mut self, pieces: usize, entries: usize) -> Self {
        Self {
            next: self.next.front(pieces, entries),
            mean: self.mean.front(pieces, entries),
            kept: self.kept.front(pieces, entries),
            rest: self.rest.front(pieces, entries),
        }
    }
}

/// Π of a column of the particles at hand.
pub type Mean<'a> = &'a mut dyn FnMut(&mut [f64]);

/// A locking remedy of a body. Its state, J̄, is a column of the particles.
pub trait Remedy<const D: usize>: Memory + Send + Sync {
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

    /// The columns that it fills, of `n` particles: J̄ⁿ⁺¹ unless that is J; the mean stress of a remedy that averages the
    /// pressure as well, the law's stress entering the forces otherwise.
    fn columns(&self, _n: usize) -> Columns {
        Columns::default()
    }

    /// Before the forces are formed: fills the mean stress, if it has that column.
    fn force_mean(&self, _known: Known<'_>, _filled: &mut Filled<'_>, _average: Mean<'_>) {}

    /// After ΔF and J are known: fills J̄ⁿ⁺¹. Positions, volumes and J̄ are still those of the step's start; it can be
    /// asked for again after other ΔF. Who takes the step makes it that of the particles.
    fn next_j_bar(&self, _known: Known<'_>, _filled: &mut Filled<'_>, _average: Mean<'_>) {}
}

/// No remedy: ΔF̄ = ΔF, no averaged Jacobian is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Standard;

impl Memoryless for Standard {}

impl<const D: usize> Remedy<D> for Standard {
    fn averages_onto(&self) -> Option<Onto> {
        None
    }
}

/// Multiplies a column by another.
fn multiply(out: &mut [f64], by: &[f64]) {
    let n = out.len();
    for_each_piece((out, by), n, CHUNK, &|_, (out, by): (&mut [f64], &[f64])| {
        for (out, by) in out.iter_mut().zip(by) {
            *out *= by;
        }
    });
}

/// Fills `out` with numbers. `of_chunk(particles)` gives what makes those of the `k`-th eight of them.
fn fill<F: Fn(usize) -> Eight>(out: &mut [f64], of_chunk: impl Fn(Range<usize>) -> F + Sync) {
    let n = out.len();
    for_each_piece(out, n, CHUNK, &|begin, out: &mut [f64]| {
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
