//! The volume average Π, Eqs. (19)–(21).
//!
//! (Πq)_p = Σ_i w_ip q_i with q_i = Σ_p w_ip V_p q_p / V_i and V_i = Σ_p w_ip V_p. It reproduces
//! constants, V Π is symmetric, and its eigenvalues lie in \[0, 1\].

mod blocks;
mod patch;
mod patches;

use crate::basis::{BSpline, Basis, WallTreatment};
use crate::bodies::Body;
use crate::grid::Grid;
use crate::lattice::{Lattice, Weights};
use crate::parallel::{CHUNK, NODE_CHUNK, for_each_piece, scatter};
use crate::particles::Particles;
use crate::reach::Reach;
use crate::work::Work;
use blocks::Blocks;
use patch::{Patch, ROW};
pub use patches::Patches;
use std::ops::Range;

/// Something that averages a particle field.
pub trait Average<const D: usize> {
    /// Replaces `field` (one value per particle) by Π `field`, with the particles' present positions
    /// and volumes.
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]);
}

/// The functions that Π averages with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Onto {
    /// Those of the basis, as Zhao, Jiang & Choo (2023) have it.
    #[default]
    Basis,
    /// Linear hats of the same grid.
    Hats,
    /// Constants of a cell. They don't overlap, so that Π² = Π.
    Cells,
    /// Linear functions on blocks of two cells along each axis, by least squares: Π² = Π.
    Blocks,
    /// Constants of the particles that shared a cell when they were last sorted: Π² = Π, and averages that a step takes in
    /// the one pass over its particles.
    Patches,
}

/// A space of functions that fields of the particles of a body are averaged with; those of others are left alone.
pub trait Space<const D: usize>: Average<D> + Send {
    /// Marks weights and volumes as outdated: call it when particles have moved, changed volume or order.
    fn expire(&mut self);

    /// Forgets all nodal values and finds the nodes within the particles' reach: call it when particles are sorted into
    /// these `slabs`.
    fn find_reach(&mut self, particles: &Particles<D>, slabs: &[Range<usize>]);

    /// Pairs of a particle and a function in an average.
    fn pairs(&self) -> u64;

    /// The patches, if its functions are theirs.
    fn patches(&self) -> Option<&Patches> {
        None
    }

    /// The same, to be found anew.
    fn patches_mut(&mut self) -> Option<&mut Patches> {
        None
    }
}

/// Averages on a lattice. Weights and nodal volumes serve all averages until the particles move or change their
/// volumes: a remedy that averages six times in a step computes them once.
#[derive(Debug, Clone)]
pub struct Averaging<const D: usize, const S: usize, B> {
    /// The lattice whose functions average.
    lattice: Lattice<D, S, B>,
    /// The nodes within the particles' reach.
    reach: Reach,
    /// The place of its first particle in the columns, and ranges of its particles by slab, from there.
    begin: usize,
    slabs: Vec<Range<usize>>,
    /// Weights of every particle.
    weights: Vec<Weights<D, S>>,
    /// V_i of every node. These two arrays are longer than the lattice by the padding of the last row.
    volumes: Vec<f64>,
    /// Σ w V q, then q_i of every node.
    values: Vec<f64>,
    /// Whether weights and volumes are those of the particles.
    current: bool,
}

/// The space on `grid` of these functions, or of the basis, which meets walls as told.
pub fn space<const D: usize, const S: usize, B: Basis<S>>(
    grid: Grid<D>,
    wall: WallTreatment,
    onto: Option<Onto>,
) -> Box<dyn Space<D>> {
    match onto {
        None | Some(Onto::Basis) => Box::new(Averaging::<D, S, B>::new(Lattice::new(grid, wall))),
        Some(Onto::Hats) => Box::new(Averaging::<D, 2, BSpline<2>>::new(Lattice::new(grid, wall))),
        Some(Onto::Cells) => Box::new(Averaging::<D, 1, BSpline<1>>::new(Lattice::new(grid, WallTreatment::OpenKnot))),
        Some(Onto::Blocks) => Box::new(Blocks::new(&grid)),
        Some(Onto::Patches) => Box::new(Patches::default()),
    }
}

/// Π in a step: spaces, and the counts of the work.
pub struct Projection<'a, const D: usize> {
    /// The space of every body.
    pub spaces: &'a mut [Box<dyn Space<D>>],
    /// The bodies, of which some do not average.
    pub each: &'a [Body],
    /// Counts applications, and pairs of particle and function.
    pub work: &'a mut Work,
}

impl<const D: usize> Average<D> for Projection<'_, D> {
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]) {
        self.work.projections += 1;
        let averaging = self.spaces.iter_mut().zip(self.each).filter(|(_, body)| body.averages);
        for (space, _) in averaging {
            space.average(particles, field);
            self.work.particle_node_pairs += space.pairs();
        }
    }
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

impl<const D: usize, const S: usize, B: Basis<S>> Averaging<D, S, B> {
    /// Averages on a lattice.
    #[must_use]
    pub fn new(lattice: Lattice<D, S, B>) -> Self {
        let (reach, n) = (Reach::everything(&lattice), lattice.len() + ROW);
        let (weights, volumes, values) = (Vec::new(), vec![0.0; n], vec![0.0; n]);
        Self { lattice, reach, begin: 0, slabs: Vec::new(), weights, volumes, values, current: false }
    }

    /// Its particles, by place in the columns.
    fn range(&self) -> Range<usize> {
        self.begin..self.begin + self.slabs.last().map_or(0, |slab| slab.end)
    }

    /// Weights and nodal volumes of the particles.
    fn prepare(&mut self, particles: &Particles<D>) {
        let (lattice, range) = (&self.lattice, self.range());
        self.weights.resize(range.len(), Weights::default());
        let columns = (&mut self.weights[..], &particles.position[range.clone()]);
        for_each_piece(columns, range.len(), CHUNK, &|_, (weights, x)| {
            lattice.weights(x, &particles.half_size, weights);
        });
        let volume = &particles.volume[range];
        scatter_values(lattice, &self.slabs, &self.weights, &self.reach, &mut self.volumes, |p| volume[p]);
        self.current = true;
    }
}

impl<const D: usize, const S: usize, B: Basis<S>> Average<D> for Averaging<D, S, B> {
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]) {
        if !self.current {
            self.prepare(particles);
        }
        let range = self.range();
        let Self { lattice, reach, slabs, weights, volumes, values, .. } = self;
        let field = &mut field[range.clone()];
        let (volume, given): (&[f64], &[f64]) = (&particles.volume[range], field);
        scatter_values(lattice, slabs, weights, reach, values, |p| volume[p] * given[p]);
        let n = volumes.len();
        for_each_piece((&mut values[..], &volumes[..]), n, NODE_CHUNK, &|begin, (values, volumes)| {
            for part in reach.within(begin, values.len()) {
                divide(&mut values[part.clone()], &volumes[part]);
            }
        });
        lattice.unfold(values);
        gather_values(lattice, weights, values, field);
    }
}

impl<const D: usize, const S: usize, B: Basis<S>> Space<D> for Averaging<D, S, B> {
    fn expire(&mut self) {
        self.current = false;
    }

    fn find_reach(&mut self, particles: &Particles<D>, slabs: &[Range<usize>]) {
        self.begin = slabs.first().map_or(0, |slab| slab.start);
        self.slabs.clear();
        self.slabs.extend(slabs.iter().map(|slab| slab.start - self.begin..slab.end - self.begin));
        self.reach = Reach::of(&self.lattice, [&particles.position[self.range()]], &particles.half_size);
        self.volumes.fill(0.0);
        self.values.fill(0.0);
        self.current = false;
    }

    fn pairs(&self) -> u64 {
        2 * (S as u64).pow(D as u32) * self.range().len() as u64
    }
}
