//! The volume average Π, Eqs. (19)–(21).
//!
//! (Πq)_p = Σ_i w_ip q_i with q_i = Σ_p w_ip V_p q_p / V_i and V_i = Σ_p w_ip V_p. It reproduces
//! constants, V Π is symmetric, and its eigenvalues lie in \[0, 1\].

mod patch;

use crate::basis::Basis;
use crate::lattice::{Lattice, Weights};
use crate::parallel::{CHUNK, NODE_CHUNK, for_each_piece, scatter};
use crate::particles::Particles;
use crate::reach::Reach;
use patch::{Patch, ROW};
use std::ops::Range;

/// Something that averages a particle field.
pub trait Average<const D: usize> {
    /// Replaces `field` (one value per particle) by Π `field`, with the particles' present positions
    /// and volumes.
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]);
}

/// Workspace of averages. Weights and nodal volumes serve all averages until the particles move or change their
/// volumes: a remedy that averages six times in a step computes them once.
#[derive(Debug, Clone)]
pub struct Averaging<const D: usize, const S: usize> {
    /// Weights of every particle.
    weights: Vec<Weights<D, S>>,
    /// V_i of every node. These two arrays are longer than the lattice by the padding of the last row.
    volumes: Vec<f64>,
    /// Σ w V q, then q_i of every node.
    values: Vec<f64>,
    /// Whether weights and volumes are those of the particles.
    current: bool,
}

impl<const D: usize, const S: usize> Averaging<D, S> {
    /// Workspace for a lattice with this number of nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self { weights: Vec::new(), volumes: vec![0.0; nodes + ROW], values: vec![0.0; nodes + ROW], current: false }
    }

    /// Forgets all nodal values: call it when nodes may have left the particles' reach.
    pub fn clear(&mut self) {
        self.volumes.fill(0.0);
        self.values.fill(0.0);
        self.current = false;
    }

    /// Marks weights and volumes as outdated: call it when particles have moved, changed volume or order.
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
    /// The nodes within the particles' reach.
    pub reach: &'a Reach,
    /// Workspace.
    pub averaging: &'a mut Averaging<D, S>,
    /// Counts the applications.
    pub count: &'a mut u64,
}

/// Scatters to `nodes`, one value per node, what `given` holds for a particle.
fn scatter_values<const D: usize, const S: usize, B: Basis<S>>(
    lattice: &Lattice<D, S, B>,
    slabs: &[Range<usize>],
    weights: &[Weights<D, S>],
    reach: &Reach,
    nodes: &mut [f64],
    given: impl Fn(usize) -> f64 + Sync,
) {
    reach.clear(nodes);
    scatter(nodes, lattice.plane(), slabs, |slab, nodes, origin| {
        let mut p = slab.start;
        while p < slab.end {
            let first = weights[p].first();
            let mut patch = Patch::zero();
            while p < slab.end && weights[p].first() == first {
                patch.add(&weights[p], given(p));
                p += 1;
            }
            patch.add_to(lattice, first - origin, nodes);
        }
    });
    lattice.fold(nodes);
}

/// Gathers from `nodes`, one value per node, to `field`.
fn gather_values<const D: usize, const S: usize, B: Basis<S>>(
    lattice: &Lattice<D, S, B>,
    weights: &[Weights<D, S>],
    nodes: &[f64],
    field: &mut [f64],
) {
    for_each_piece((field, weights), weights.len(), CHUNK, &|_, (field, weights)| {
        let mut p = 0;
        while p < field.len() {
            let first = weights[p].first();
            let patch = Patch::of(lattice, first, nodes);
            while p < field.len() && weights[p].first() == first {
                field[p] = patch.sum(&weights[p]);
                p += 1;
            }
        }
    });
}

/// Divides nodal values by nodal volumes, where there are any.
fn divide(values: &mut [f64], volumes: &[f64]) {
    for (value, volume) in values.iter_mut().zip(volumes) {
        if *volume > 0.0 {
            *value /= *volume;
        }
    }
}

impl<const D: usize, const S: usize, B: Basis<S>> Projection<'_, D, S, B> {
    /// Weights and nodal volumes of the particles.
    fn prepare(&mut self, particles: &Particles<D>) {
        let (lattice, averaging) = (self.lattice, &mut *self.averaging);
        averaging.weights.resize(particles.len(), Weights::default());
        let columns = (&mut averaging.weights[..], &particles.position[..]);
        for_each_piece(columns, particles.len(), CHUNK, &|_, (weights, x)| {
            lattice.weights(x, &particles.half_size, weights);
        });
        let volume = &particles.volume;
        let (weights, volumes) = (&averaging.weights, &mut averaging.volumes);
        scatter_values(lattice, self.slabs, weights, self.reach, volumes, |p| volume[p]);
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
        scatter_values(lattice, self.slabs, weights, self.reach, values, |p| volume[p] * given[p]);
        let fields = (&mut values[..], &averaging.volumes[..]);
        let (reach, n) = (self.reach, averaging.volumes.len());
        for_each_piece(fields, n, NODE_CHUNK, &|begin, (values, volumes)| {
            for part in reach.within(begin, values.len()) {
                divide(&mut values[part.clone()], &volumes[part]);
            }
        });
        lattice.unfold(values);
        gather_values(lattice, weights, values, field);
        *self.count += 1;
    }
}
