//! Stencils of eight particles, in memory.

use super::{Lattice, Stencil};
use crate::basis::{Basis, EightAxisWeights};
use crate::nodes::Node;
use crate::number::{EIGHT, Octet};

/// The stencils of eight particles, in memory. A loop over the eight reads a weight as a broadcast, which costs a fused
/// multiplication nothing; a weight that is taken out of numbers side by side costs an instruction each.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Stencils<const D: usize, const S: usize> {
    /// By the places of a row along the outer axes: for each of these axes the product of their weights with that
    /// axis' derivative instead (1/m), and in the last place the product of weights.
    rows: [[[Octet; D]; S]; S],
    /// Weights and derivatives (1/m) along the last axis.
    last: [Octet; S],
    slope: [Octet; S],
    first: [u32; EIGHT],
    strides: [u32; D],
}

impl<const D: usize, const S: usize> Stencils<D, S> {
    /// Room for eight on a lattice.
    #[must_use]
    pub fn on<B: Basis<S>>(lattice: &Lattice<D, S, B>) -> Self {
        Self {
            rows: [[[[1.0; EIGHT]; D]; S]; S],
            last: [[0.0; EIGHT]; S],
            slope: [[0.0; EIGHT]; S],
            first: [0; EIGHT],
            strides: lattice.strides.map(|stride| stride as u32),
        }
    }

    /// Makes them those of eight particles, from the functions along every axis and the first nodes.
    #[inline(always)]
    pub(super) fn set(&mut self, functions: &[EightAxisWeights<S>; D], first: [u32; EIGHT]) {
        self.first = first;
        let last = &functions[D - 1];
        for k in 0..S {
            self.last[k] = last.w[k].to_array();
            self.slope[k] = last.dw[k].to_array();
        }
        let (lines, rows) = Stencil::<D, S>::OUTER;
        for slow in 0..lines {
            for fast in 0..rows {
                let row = &mut self.rows[slow][fast];
                if D == 2 {
                    row[0] = functions[0].dw[fast].to_array();
                    row[1] = functions[0].w[fast].to_array();
                }
                if D == 3 {
                    let (outer, middle) = (&functions[0], &functions[1]);
                    row[0] = (outer.dw[slow] * middle.w[fast]).to_array();
                    row[1] = (outer.w[slow] * middle.dw[fast]).to_array();
                    row[D - 1] = (outer.w[slow] * middle.w[fast]).to_array();
                }
            }
        }
    }

    /// The `l`-th.
    #[inline(always)]
    pub fn at(&self, l: usize) -> StencilRef<'_, D, S> {
        StencilRef { of: self, l }
    }
}

/// One of eight stencils.
#[derive(Debug, Clone, Copy)]
pub struct StencilRef<'a, const D: usize, const S: usize> {
    of: &'a Stencils<D, S>,
    l: usize,
}

impl<const D: usize, const S: usize> StencilRef<'_, D, S> {
    /// Which of the eight.
    #[inline(always)]
    pub fn place(&self) -> usize {
        self.l
    }

    /// The first node.
    #[inline(always)]
    pub fn first(&self) -> usize {
        self.of.first[self.l] as usize
    }

    /// In an array that begins at node `origin`: where the rows at the place `slow` begin, and how many nodes further
    /// the last of them ends; each begins [`StencilRef::stride`] nodes after the one before.
    #[inline(always)]
    pub fn line(&self, slow: usize, origin: usize) -> (usize, usize) {
        let begin = self.first() - origin;
        match D {
            1 => (begin, S),
            2 => (begin, (S - 1) * self.stride() + S),
            _ => (begin + slow * self.of.strides[0] as usize, (S - 1) * self.stride() + S),
        }
    }

    /// Nodes from one row to the next in a line.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        if D == 1 { 0 } else { self.of.strides[D - 2] as usize }
    }

    /// Product of the outer axes' weights of a row.
    #[inline(always)]
    pub fn row_weight(&self, slow: usize, fast: usize) -> f64 {
        self.row_gradient(slow, fast, D - 1)
    }

    /// The same with the derivative (1/m) along outer axis `a`; with `D − 1` the weight.
    #[inline(always)]
    pub fn row_gradient(&self, slow: usize, fast: usize, a: usize) -> f64 {
        self.of.rows[slow][fast][a][self.l]
    }

    /// The weights along the last axis, each as often as a node has components.
    #[inline(always)]
    pub fn last(&self) -> [Node; S] {
        let mut last = [Node::ZERO; S];
        for k in 0..S {
            last[k] = Node::splat(self.of.last[k][self.l]);
        }
        last
    }

    /// The derivatives along the last axis (1/m), each repeated for the components of a node.
    #[inline(always)]
    pub fn slope(&self) -> [Node; S] {
        let mut slope = [Node::ZERO; S];
        for k in 0..S {
            slope[k] = Node::splat(self.of.slope[k][self.l]);
        }
        slope
    }
}
