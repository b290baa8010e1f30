//! The nodes of a tensor-product basis on a grid, and how nodal fields are stored.
//!
//! Nodal fields are plain arrays beside the lattice. The first axis varies slowest: nodes of equal
//! first index form a plane, planes are contiguous, and parallel scatters work on runs of planes
//! (see [`crate::parallel`]).

mod stencils;

pub use stencils::{StencilRef, Stencils};

use crate::basis::{AxisNodes, AxisWeights, Basis, EightAxisWeights, WallTreatment};
use crate::eights::{Eights, components};
use crate::grid::Grid;
use crate::number::{EIGHT, Eight, Lanes, indices};
use crate::parallel::PLANES_BEFORE;
use std::ops::AddAssign;

/// A grid with the basis functions of its axes.
#[derive(Debug, Clone)]
pub struct Lattice<const D: usize, const S: usize, B> {
    /// The grid.
    pub grid: Grid<D>,
    bases: [B; D],
    nodes: [AxisNodes; D],
    strides: [usize; D],
    images: Vec<(usize, usize)>,
}

impl<const D: usize, const S: usize, B: Basis<S>> Lattice<D, S, B> {
    /// The lattice of basis `B` on `grid`.
    #[must_use]
    pub fn new(grid: Grid<D>, wall: WallTreatment) -> Self {
        let bases: [B; D] = std::array::from_fn(|a| B::new(&grid.axes[a], grid.h, wall));
        let nodes: [AxisNodes; D] = std::array::from_fn(|a| bases[a].nodes());
        let mut strides = [1; D];
        for a in (0..D - 1).rev() {
            strides[a] = strides[a + 1] * nodes[a + 1].position.len();
        }
        let mut lattice = Self { grid, bases, nodes, strides, images: Vec::new() };
        lattice.images = lattice.periodic_images();
        lattice
    }

    /// Length of a nodal array.
    pub fn len(&self) -> usize {
        (PLANES_BEFORE + self.nodes[0].position.len()) * self.strides[0]
    }

    /// Never: a grid has nodes.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Nodes in a plane of equal first index.
    pub fn plane(&self) -> usize {
        self.strides[0]
    }

    /// Nodes in a row along the last axis; in one dimension that is a plane.
    pub fn row_length(&self) -> usize {
        if D == 1 { 1 } else { self.strides[D - 2] }
    }

    /// The nodes beside a node along the axes.
    pub(crate) fn beside(&self, node: usize) -> impl Iterator<Item = usize> + use<D, S, B> {
        let (strides, len) = (self.strides, self.len());
        strides.into_iter().flat_map(move |s| [node.checked_sub(s), Some(node + s)]).flatten().filter(move |k| *k < len)
    }

    /// The nodes within a few cells of a node along every axis, itself among them.
    pub(crate) fn around(&self, node: usize, cells: usize) -> impl Iterator<Item = usize> + use<D, S, B> {
        let (strides, width) = (self.strides, 2 * cells + 1);
        let ends: [usize; D] = std::array::from_fn(|a| if a == 0 { self.len() } else { strides[a - 1] });
        (0..width.pow(D as u32)).filter_map(move |k| {
            (0..D).try_fold(0, |sum, a| {
                let here = node % ends[a] / strides[a] + k / width.pow(a as u32) % width;
                let at = here.checked_sub(cells)? * strides[a];
                (at < ends[a]).then_some(sum + at)
            })
        })
    }

    /// Whether nodes have periodic images.
    pub fn has_images(&self) -> bool {
        !self.images.is_empty()
    }

    /// The basis functions that see a particle at `x` (m) with half sizes `half_size` (m).
    #[inline(always)]
    pub fn stencil(&self, x: &[f64; D], half_size: &[f64; D]) -> Stencil<D, S> {
        let mut axis = [AxisWeights::NONE; D];
        for a in 0..D {
            axis[a] = self.bases[a].weights(x[a], half_size[a]);
        }
        Stencil { first: self.node(&axis.map(|axis| axis.first)), axis, strides: self.strides }
    }

    /// The functions that see a point `x` (m), a particle without size.
    pub fn stencil_of_point(&self, x: &[f64; D]) -> Stencil<D, S> {
        let axis: [AxisWeights<S>; D] = std::array::from_fn(|a| self.bases[a].at_point(x[a]));
        Stencil { first: self.node(&axis.each_ref().map(|axis| axis.first)), axis, strides: self.strides }
    }

    /// The node of these indices along the axes.
    #[inline(always)]
    fn node(&self, index: &[usize; D]) -> usize {
        let mut node = PLANES_BEFORE * self.strides[0];
        for a in 0..D {
            node += index[a] * self.strides[a];
        }
        node
    }

    /// The functions along every axis that see eight particles at `x` (m) with half sizes `half_size` (m).
    #[inline(always)]
    pub fn functions(&self, x: &[Eight; D], half_size: &[f64; D]) -> [EightAxisWeights<S>; D] {
        let mut functions = [EightAxisWeights::NONE; D];
        for a in 0..D {
            functions[a] = self.bases[a].weights_of_eight(x[a], half_size[a]);
        }
        functions
    }

    /// The first nodes of eight stencils, whole numbers.
    #[inline(always)]
    fn first_nodes(&self, functions: &[EightAxisWeights<S>; D]) -> Eight {
        let mut first = Eight::splat((PLANES_BEFORE * self.strides[0]) as f64);
        for a in 0..D {
            let stride = Eight::splat(self.strides[a] as f64);
            first = functions[a].first.mul_add(stride, first);
        }
        first
    }

    /// Fills `stencils` with those of eight particles, from the functions along every axis.
    #[inline(always)]
    pub fn stencils(&self, functions: &[EightAxisWeights<S>; D], stencils: &mut Stencils<D, S>) {
        stencils.set(functions, indices(self.first_nodes(functions)));
    }

    /// The weights of particles at `x` (m), without derivatives.
    pub fn weights(&self, x: &[[f64; D]], half_size: &[f64; D], weights: &mut [Weights<D, S>]) {
        let eights = Eights::of(x);
        for (k, weights) in weights.chunks_mut(EIGHT).enumerate() {
            let functions = self.functions(&components(eights.at(k)), half_size);
            let first = indices(self.first_nodes(&functions));
            for (l, weights) in weights.iter_mut().enumerate() {
                weights.first = first[l] as usize;
                for a in 0..D {
                    for s in 0..S {
                        weights.w[a][s] = functions[a].w[s].part(l);
                    }
                }
            }
        }
    }

    /// The first node of every stencil of particles at `positions` (m), in their order.
    pub fn for_each_first_node(
        &self,
        positions: &[[f64; D]],
        half_size: &[f64; D],
        mut visit: impl FnMut(usize, usize),
    ) {
        let eights = Eights::of(positions);
        for (k, block) in positions.chunks(EIGHT).enumerate() {
            let functions = self.functions(&components(eights.at(k)), half_size);
            let first = indices(self.first_nodes(&functions));
            for (l, first) in first[..block.len()].iter().enumerate() {
                visit(k * EIGHT + l, *first as usize);
            }
        }
    }

    /// How many nodes after a stencil's first one the row at the places `slow` and `fast` begins: see
    /// [`Stencil::OUTER`].
    #[inline(always)]
    pub fn row_offset(&self, slow: usize, fast: usize) -> usize {
        row_offset(&self.strides, slow, fast)
    }

    /// Distances x_i − x_p (m) from eight particles at `x` (m) to the nodes of the functions that see them, axis by
    /// axis.
    #[inline(always)]
    pub fn arms(&self, functions: &[EightAxisWeights<S>; D], x: &[Eight; D]) -> [[Eight; S]; D] {
        let mut arms = [[Eight::ZERO; S]; D];
        for a in 0..D {
            let first = indices(functions[a].first);
            for k in 0..S {
                let node = first.map(|first| self.nodes[a].position[first as usize + k]);
                arms[a][k] = Eight::new(node) - x[a];
            }
        }
        arms
    }

    /// Position of a node (its Greville abscissae, m) from its multi-index.
    pub fn position(&self, index: &[usize; D]) -> [f64; D] {
        std::array::from_fn(|a| self.nodes[a].position[index[a]])
    }

    /// Calls `visit(node, multi-index)` for every node.
    pub fn for_each_node(&self, mut visit: impl FnMut(usize, &[usize; D])) {
        let first = PLANES_BEFORE * self.strides[0];
        for node in first..self.len() {
            let mut rest = node - first;
            let index = std::array::from_fn(|a| {
                let i = rest / self.strides[a];
                rest %= self.strides[a];
                i
            });
            visit(node, &index);
        }
    }

    /// Adds the values of periodic images to their originals and clears the images.
    pub fn fold<T: Copy + Default + AddAssign>(&self, field: &mut [T]) {
        for &(image, original) in &self.images {
            let value = std::mem::take(&mut field[image]);
            field[original] += value;
        }
    }

    /// Copies the values of originals to their periodic images, in the opposite order.
    pub fn unfold<T: Copy>(&self, field: &mut [T]) {
        for &(image, original) in self.images.iter().rev() {
            field[image] = field[original];
        }
    }

    /// Pairs (image, original) of the periodic axes, axis by axis: a node that is an image on two
    /// axes reaches its original in two hops.
    fn periodic_images(&self) -> Vec<(usize, usize)> {
        let mut images = Vec::new();
        for a in 0..D {
            if let Some(original) = &self.nodes[a].original {
                self.for_each_node(|node, index| {
                    let (from, to) = (index[a], original[index[a]]);
                    if from != to {
                        images.push((node, node + to * self.strides[a] - from * self.strides[a]));
                    }
                });
            }
        }
        images
    }
}

/// How many nodes after a stencil's first one the row at these places begins.
#[inline(always)]
fn row_offset<const D: usize>(strides: &[usize; D], slow: usize, fast: usize) -> usize {
    match D {
        1 => 0,
        2 => fast * strides[0],
        _ => slow * strides[0] + fast * strides[1],
    }
}

/// The functions of every axis that see one particle.
#[derive(Debug, Clone, Copy)]
pub struct Stencil<const D: usize, const S: usize> {
    /// Per axis.
    pub axis: [AxisWeights<S>; D],
    first: usize,
    strides: [usize; D],
}

/// The weights of a stencil, without their gradients.
#[derive(Debug, Clone, Copy)]
pub struct Weights<const D: usize, const S: usize> {
    first: usize,
    w: [[f64; S]; D],
}

impl<const D: usize, const S: usize> Default for Weights<D, S> {
    fn default() -> Self {
        Self { first: 0, w: [[0.0; S]; D] }
    }
}

impl<const D: usize, const S: usize> Weights<D, S> {
    /// The first node of the stencil.
    #[inline(always)]
    pub fn first(&self) -> usize {
        self.first
    }

    /// The weights along an axis.
    #[inline(always)]
    pub fn axis(&self, axis: usize) -> &[f64; S] {
        &self.w[axis]
    }

    /// The weights along the last axis.
    #[inline(always)]
    pub fn last(&self) -> &[f64; S] {
        &self.w[D - 1]
    }
}

/// A run of `S` consecutive nodes along the last axis.
#[derive(Debug, Clone, Copy)]
pub struct Row<const D: usize> {
    /// The first node of the run.
    pub node: usize,
    /// Product of the outer axes' weights.
    pub w: f64,
    /// For each outer axis, the product with that axis' derivative (1/m); `w` in the last place.
    pub gradient: [f64; D],
}

impl<const D: usize, const S: usize> Stencil<D, S> {
    /// Positions of a row along the outer axes (at most two): their number along the slow axis and along the fast one.
    /// Two dimensions have one outer axis, the fast one; one dimension has no outer axis.
    pub const OUTER: (usize, usize) = match D {
        1 => (1, 1),
        2 => (1, S),
        _ => (S, S),
    };

    /// The row at the places `slow` and `fast`, weights factorised: on it the weight of node `k` is
    /// `row.w * last.w[k]` and its gradient `row.gradient[a] * last.w[k]`, with `last.dw[k]` instead
    /// of `last.w[k]` in the last direction.
    #[inline(always)]
    pub fn row(&self, slow: usize, fast: usize) -> Row<D> {
        let mut row = Row { node: self.first() + row_offset(&self.strides, slow, fast), w: 1.0, gradient: [1.0; D] };
        if D == 2 {
            let outer = &self.axis[0];
            row.w = outer.w[fast];
            row.gradient[0] = outer.dw[fast];
        }
        if D == 3 {
            let (outer, middle) = (&self.axis[0], &self.axis[1]);
            row.w = outer.w[slow] * middle.w[fast];
            row.gradient[0] = outer.dw[slow] * middle.w[fast];
            row.gradient[1] = outer.w[slow] * middle.dw[fast];
        }
        row.gradient[D - 1] = row.w;
        row
    }

    /// The first node.
    #[inline(always)]
    pub fn first(&self) -> usize {
        self.first
    }

    /// The weights along the last axis.
    #[inline(always)]
    pub fn last(&self) -> &AxisWeights<S> {
        &self.axis[D - 1]
    }
}
