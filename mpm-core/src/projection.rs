//! The volume average Π, Eqs. (19)–(21).
//!
//! (Πq)_p = Σ_i w_ip q_i with q_i = Σ_p w_ip V_p q_p / V_i and V_i = Σ_p w_ip V_p. It reproduces
//! constants, V Π is symmetric, and its eigenvalues lie in \[0, 1\].

use crate::basis::Basis;
use crate::lattice::{Lattice, Stencil};
use crate::parallel::{CHUNK, scatter};
use crate::particles::Particles;
use rayon::prelude::*;
use std::ops::{AddAssign, Range};

/// Something that averages a particle field.
pub trait Average<const D: usize> {
    /// Replaces `field` (one value per particle) by Π `field`, with the particles' present positions
    /// and volumes.
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]);
}

/// What a node gathers for an average.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NodalAverage {
    /// Σ w V q, then q_i.
    value: f64,
    /// V_i = Σ w V.
    volume: f64,
}

impl AddAssign for NodalAverage {
    fn add_assign(&mut self, other: Self) {
        self.value += other.value;
        self.volume += other.volume;
    }
}

/// Π on a lattice, with the nodal array it works in.
pub struct Projection<'a, const D: usize, const S: usize, B> {
    /// The lattice whose functions average.
    pub lattice: &'a Lattice<D, S, B>,
    /// Ranges of particles by slab.
    pub slabs: &'a [Range<usize>],
    /// Work array, one entry per node.
    pub nodes: &'a mut [NodalAverage],
    /// Counts the applications.
    pub count: &'a mut u64,
}

impl<const D: usize, const S: usize, B: Basis<S>> Average<D> for Projection<'_, D, S, B> {
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]) {
        let lattice = self.lattice;
        let (x, l, volume) = (&particles.position, &particles.half_size, &particles.volume);
        self.nodes.fill(NodalAverage::default());
        let values: &[f64] = field;
        scatter(
            self.nodes,
            lattice.plane(),
            self.slabs,
            |slab, nodes, first| {
                let (x, l) = (&x[slab.clone()], &l[slab.clone()]);
                let (volume, values) = (&volume[slab.clone()], &values[slab]);
                for p in 0..x.len() {
                    let stencil = lattice.stencil(&x[p], &l[p]);
                    let last = stencil.last();
                    for r in 0..Stencil::<D, S>::ROWS {
                        let row = stencil.row(r);
                        let begin = row.node - first;
                        let row_volume = row.w * volume[p];
                        let row_value = row_volume * values[p];
                        for (node, w) in nodes[begin..begin + S].iter_mut().zip(&last.w) {
                            node.value = w.mul_add(row_value, node.value);
                            node.volume = w.mul_add(row_volume, node.volume);
                        }
                    }
                }
            },
        );
        lattice.fold(self.nodes);
        for node in self.nodes.iter_mut() {
            if node.volume > 0.0 {
                node.value /= node.volume;
            }
        }
        lattice.unfold(self.nodes);
        let nodes: &[NodalAverage] = self.nodes;
        field
            .par_chunks_mut(CHUNK)
            .zip(x.par_chunks(CHUNK))
            .zip(l.par_chunks(CHUNK))
            .for_each(|((field, x), l)| {
                for ((q, x), l) in field.iter_mut().zip(x).zip(l) {
                    let stencil = lattice.stencil(x, l);
                    let last = stencil.last();
                    let mut sum = 0.0;
                    for r in 0..Stencil::<D, S>::ROWS {
                        let row = stencil.row(r);
                        let nodes = &nodes[row.node..row.node + S];
                        let mut row_sum = 0.0;
                        for (node, w) in nodes.iter().zip(&last.w) {
                            row_sum = w.mul_add(node.value, row_sum);
                        }
                        sum = row.w.mul_add(row_sum, sum);
                    }
                    *q = sum;
                }
            });
        *self.count += 1;
    }
}
