//! Parts of scenes that several problems share: particles on a lattice, walls, and the solver of the scheme.

use super::parameters as common;
use crate::prelude::*;

/// Young's modulus (Pa) and density (kg/m³) before it deforms of a body whose problem prescribes neither.
pub(super) const YOUNG_MODULUS: f64 = 1e6;
pub(super) const DENSITY: f64 = 1000.0;
/// Distance d̂ at which a barrier begins, in cells.
pub(super) const REACH: f64 = 0.25;

impl<P: ParameterSet> Setup<P> {
    /// Distance of particles (m), by the parameter `ppc_per_direction`.
    pub(super) fn pitch(&self) -> f64 {
        self.h / self.number(common::PPC_PER_DIRECTION)
    }

    /// The discretisation in `dim` dimensions with that number of particles in every direction, and steps of `dt` (s).
    pub(super) fn regular(&self, dim: usize, dt: f64) -> Discretisation {
        let per_direction = self.number(common::PPC_PER_DIRECTION) as usize;
        self.discretisation(dim, per_direction.pow(dim as u32), dt)
    }

    /// Particles at these places (m), `spacing` (m) apart, of a density (kg/m³).
    pub(super) fn particles_at<const D: usize>(
        &self,
        places: impl IntoIterator<Item = [f64; D]>,
        spacing: f64,
        density: f64,
    ) -> Result<Particles<D>, Fault> {
        Particles::new(self.start_at(places), spacing.powi(D as i32), density, [0.5 * spacing; D])
    }

    /// The explicit solver of a scene, in steps of `dt` (s), with a factor of local damping, and the share of FLIP that the
    /// parameter `flip` sets.
    pub(super) fn explicit<const D: usize>(&self, scene: Scene<D>, dt: f64, damping: f64) -> Begun<D> {
        let settings = self.settings(dt, damping)?;
        let share = self.number(common::FLIP);
        let settings = if share.is_nan() { settings } else { settings.transfer(Flip::new(share)?) };
        mpm_solvers::solver(self.scheme, scene, settings)
    }

    /// The solver of a scheme of bodies that move, explicit or implicit: see [`Self::explicit`].
    pub(super) fn moving<const D: usize>(&self, scene: Scene<D>, dt: f64, damping: f64) -> Begun<D> {
        match self.implicit_settings(dt) {
            Some(settings) => mpm_solvers::implicit(self.scheme, scene, settings),
            None => self.explicit(scene, dt, damping),
        }
    }
}

/// Places (m) of a lattice with these coordinates (m) along the axes; the first axis runs fastest.
pub(super) fn lattice<const D: usize>(axes: [Vec<f64>; D]) -> impl Iterator<Item = [f64; D]> {
    (0..axes.iter().map(Vec::len).product()).map(move |mut k| {
        axes.each_ref().map(|axis| {
            let x = axis[k % axis.len()];
            k /= axis.len();
            x
        })
    })
}

/// Coordinates (m) of the middles of `count` parts of this size (m), from zero on.
pub(super) fn middles(count: usize, size: f64) -> Vec<f64> {
    (0..count).map(|k| (k as f64 + 0.5) * size).collect()
}

/// The lattice of `counts` places along the axes, `spacing` (m) apart, the first at half of it.
pub(super) fn by_rows<const D: usize>(counts: [usize; D], spacing: f64) -> impl Iterator<Item = [f64; D]> {
    lattice(counts.map(|count| middles(count, spacing)))
}

/// The same with the last axis running fastest.
pub(super) fn by_columns<const D: usize>(mut counts: [usize; D], spacing: f64) -> impl Iterator<Item = [f64; D]> {
    counts.reverse();
    by_rows(counts, spacing).map(|mut x| {
        x.reverse();
        x
    })
}

/// A stretch along the first axis.
pub(super) fn stretched<const D: usize>(stretch: f64) -> SMatrix<f64, D, D> {
    let mut f = SMatrix::identity();
    f[(0, 0)] = stretch;
    f
}

/// A wall on which material sticks.
pub(super) fn clamp(axis: usize, end: End) -> Wall {
    Wall::new(axis, end, WallKind::Fixed)
}

/// A wall along which material slides.
pub(super) fn roller(axis: usize, end: End) -> Wall {
    Wall::new(axis, end, WallKind::Roller)
}

/// A number from −1 to 1, without order, by its place in a sequence; the same on every machine.
pub(super) fn noise(k: usize) -> f64 {
    let mut x = (k as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}
