//! Linear functions on blocks of 2ᴰ cells: a projection by least squares, so that Π² = Π.
//!
//! With the mean P over a block, the functions 1, e₁, … are orthonormal there in the volume-weighted product: e_a is
//! the coordinate x_a less its mean and less what the e_b before it see, over its norm. Πq = Pq + Σ_a e_a P(e_a q).

use super::{Average, Averaging, Space};
use crate::basis::{BSpline, WallTreatment};
use crate::grid::{Axis, Grid};
use crate::lattice::Lattice;
use crate::particles::Particles;
use std::ops::Range;

/// Cells along an axis of a block.
const WIDTH: usize = 2;
/// The least norm of a coordinate in a block, in block widths: particles in a row have no slope across it.
const LEAST: f64 = 1e-6;

/// Averages on the blocks of a grid.
pub(super) struct Blocks<const D: usize> {
    /// The mean P over a block.
    means: Averaging<D, 1, BSpline<1>>,
    /// e_a of every particle; zero of those of other bodies.
    functions: [Vec<f64>; D],
    /// Room for products, and for a field before it is averaged.
    sums: Vec<f64>,
    given: Vec<f64>,
    /// Whether the functions are those of the particles' present places.
    current: bool,
}

impl<const D: usize> Blocks<D> {
    /// Those of `grid`; the last block of an axis with an odd number of cells is half as wide.
    #[must_use]
    pub(super) fn new(grid: &Grid<D>) -> Self {
        let axes = grid.axes.map(|axis| Axis { cells: axis.cells.div_ceil(WIDTH), ..axis });
        let grid = Grid { h: WIDTH as f64 * grid.h, axes };
        let means = Averaging::new(Lattice::new(grid, WallTreatment::OpenKnot));
        Self { means, functions: [const { Vec::new() }; D], sums: Vec::new(), given: Vec::new(), current: false }
    }

    /// Finds the functions by Gram and Schmidt's method.
    fn prepare(&mut self, particles: &Particles<D>) {
        let Self { means, functions, sums, .. } = self;
        let least = (LEAST * means.lattice.grid.h).powi(2);
        for a in 0..D {
            let (before, e) = functions.split_at_mut(a);
            let e = &mut e[0];
            e.clear();
            e.extend(particles.position.iter().map(|x| x[a]));
            // What rounding leaves of the others the second time is small against e itself.
            for _ in 0..2 {
                sums.clone_from(e);
                means.average(particles, sums);
                e.iter_mut().zip(&*sums).for_each(|(e, mean)| *e -= mean);
                for before in &*before {
                    see(means, particles, (e, before), sums);
                    e.iter_mut().zip(before).zip(&*sums).for_each(|((e, before), seen)| *e -= *before * seen);
                }
            }
            see(means, particles, (e, e), sums);
            for (e, square) in e.iter_mut().zip(&*sums) {
                *e = if *square > least { *e / square.sqrt() } else { 0.0 };
            }
        }
        self.current = true;
    }
}

/// P(q e) of every particle.
fn see<const D: usize>(
    means: &mut Averaging<D, 1, BSpline<1>>,
    particles: &Particles<D>,
    (q, e): (&[f64], &[f64]),
    seen: &mut Vec<f64>,
) {
    seen.clear();
    seen.extend(q.iter().zip(e).map(|(q, e)| q * e));
    means.average(particles, seen);
}

impl<const D: usize> Average<D> for Blocks<D> {
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]) {
        if !self.current {
            self.prepare(particles);
        }
        let Self { means, functions, sums, given, .. } = self;
        given.clear();
        given.extend_from_slice(field);
        means.average(particles, field);
        for e in functions {
            see(means, particles, (given, e), sums);
            field.iter_mut().zip(e).zip(&*sums).for_each(|((field, e), seen)| *field += *e * seen);
        }
    }
}

impl<const D: usize> Space<D> for Blocks<D> {
    fn expire(&mut self) {
        self.means.expire();
        self.current = false;
    }

    fn find_reach(&mut self, particles: &Particles<D>, slabs: &[Range<usize>]) {
        let wide: Vec<_> = slabs.chunks(WIDTH).map(|pair| pair[0].start..pair[pair.len() - 1].end).collect();
        self.means.find_reach(particles, &wide);
        self.current = false;
    }

    fn pairs(&self) -> u64 {
        (1 + D as u64) * self.means.pairs()
    }
}
