//! The volume average Π, Eqs. (19)–(21).
//!
//! (Πq)_p = Σ_i w_ip q_i with q_i = Σ_p w_ip V_p q_p / V_i and V_i = Σ_p w_ip V_p. It reproduces
//! constants, V Π is symmetric, and its eigenvalues lie in \[0, 1\].

use crate::basis::Basis;
use crate::lattice::{Lattice, Weights};
use crate::parallel::{CHUNK, scatter};
use crate::particles::Particles;
use rayon::prelude::*;
use std::ops::Range;

/// Something that averages a particle field.
pub trait Average<const D: usize> {
    /// Replaces `field` (one value per particle) by Π `field`, with the particles' present positions
    /// and volumes.
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]);
}

/// What averages work with. Weights and nodal volumes are those of all averages until the particles move or
/// change their volumes: a remedy that averages six times in a step computes them once.
#[derive(Debug, Clone)]
pub struct Averaging<const D: usize, const S: usize> {
    /// Of every particle.
    weights: Vec<Weights<D, S>>,
    /// V_i of every node.
    volumes: Vec<f64>,
    /// Σ w V q, then q_i of every node.
    values: Vec<f64>,
    /// Whether weights and volumes are those of the particles.
    current: bool,
}

impl<const D: usize, const S: usize> Averaging<D, S> {
    /// For a lattice of so many nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self {
            weights: Vec::new(),
            volumes: vec![0.0; nodes],
            values: vec![0.0; nodes],
            current: false,
        }
    }

    /// To be told when particles have moved, changed their volumes or been put in another order.
    pub fn expire(&mut self) {
        self.current = false;
    }
}

/// Π on a lattice.
pub struct Projection<'a, const D: usize, const S: usize, B> {
    /// The lattice whose functions average.
    pub lattice: &'a Lattice<D, S, B>,
    /// Ranges of particles by slab.
    pub slabs: &'a [Range<usize>],
    /// What it works with.
    pub averaging: &'a mut Averaging<D, S>,
    /// Counts the applications.
    pub count: &'a mut u64,
}

/// Scatters to `nodes`, one value per node, what `weighted` gives for a particle's place and the weight of a row.
fn scatter_rows<const D: usize, const S: usize, B: Basis<S>>(
    lattice: &Lattice<D, S, B>,
    slabs: &[Range<usize>],
    weights: &[Weights<D, S>],
    nodes: &mut [f64],
    weighted: impl Fn(usize, f64) -> f64 + Sync,
) {
    nodes.fill(0.0);
    scatter(nodes, lattice.plane(), slabs, |slab, nodes, origin| {
        for p in slab {
            let weights = &weights[p];
            for r in 0..Weights::<D, S>::ROWS {
                let (node, w) = lattice.row(weights, r);
                let value = weighted(p, w);
                let begin = node - origin;
                for (node, w) in nodes[begin..begin + S].iter_mut().zip(weights.last()) {
                    *node = w.mul_add(value, *node);
                }
            }
        }
    });
    lattice.fold(nodes);
}

impl<const D: usize, const S: usize, B: Basis<S>> Projection<'_, D, S, B> {
    /// Weights and nodal volumes of the particles.
    fn prepare(&mut self, particles: &Particles<D>) {
        let (lattice, averaging) = (self.lattice, &mut *self.averaging);
        averaging
            .weights
            .resize(particles.len(), Weights::default());
        averaging
            .weights
            .par_chunks_mut(CHUNK)
            .zip(particles.position.par_chunks(CHUNK))
            .zip(particles.half_size.par_chunks(CHUNK))
            .for_each(|((weights, x), l)| {
                for ((weights, x), l) in weights.iter_mut().zip(x).zip(l) {
                    *weights = lattice.stencil(x, l).weights();
                }
            });
        let volume = &particles.volume;
        let (weights, volumes) = (&averaging.weights, &mut averaging.volumes);
        scatter_rows(lattice, self.slabs, weights, volumes, |p, w| w * volume[p]);
        averaging.current = true;
    }
}

impl<const D: usize, const S: usize, B: Basis<S>> Average<D> for Projection<'_, D, S, B> {
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]) {
        if !self.averaging.current {
            self.prepare(particles);
        }
        let (lattice, averaging) = (self.lattice, &mut *self.averaging);
        let (weights, values) = (&averaging.weights, &mut averaging.values);
        let (volume, given): (&[f64], &[f64]) = (&particles.volume, field);
        scatter_rows(lattice, self.slabs, weights, values, |p, w| {
            w * volume[p] * given[p]
        });
        for (value, volume) in values.iter_mut().zip(&averaging.volumes) {
            if *volume > 0.0 {
                *value /= volume;
            }
        }
        lattice.unfold(values);
        let values: &[f64] = values;
        field
            .par_chunks_mut(CHUNK)
            .zip(weights.par_chunks(CHUNK))
            .for_each(|(field, weights)| {
                for (q, weights) in field.iter_mut().zip(weights) {
                    let mut sum = 0.0;
                    for r in 0..Weights::<D, S>::ROWS {
                        let (node, w) = lattice.row(weights, r);
                        let mut row_sum = 0.0;
                        for (value, w) in values[node..node + S].iter().zip(weights.last()) {
                            row_sum = w.mul_add(*value, row_sum);
                        }
                        sum = w.mul_add(row_sum, sum);
                    }
                    *q = sum;
                }
            });
        *self.count += 1;
    }
}
