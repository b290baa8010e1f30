//! The order of the particles of a body: by slab of cells, and in a slab by the first node of their stencils.
//!
//! Slabs are what threads share ([`crate::parallel`]). Particles of one stencil stand side by side, so that a
//! kernel can fetch its nodes once for all of them.

use crate::basis::Basis;
use crate::lattice::Lattice;
use crate::parallel::SLAB;
use std::ops::Range;

/// The particles of a body by slab of [`SLAB`] cells along the first axis, as ranges of places in the columns.
pub type Slabs = Vec<Range<usize>>;

/// The order of particles at `positions` (m) with half sizes `half_size` (m), stable where nothing tells them apart,
/// and the range of every slab of [`SLAB`] cells along the first axis; on request those of a cell stand side by side.
pub fn stencil_order<const D: usize, const S: usize, B: Basis<S>>(
    lattice: &Lattice<D, S, B>,
    positions: &[[f64; D]],
    half_size: &[f64; D],
    by_cell: bool,
) -> (Vec<u32>, Slabs) {
    let grid = &lattice.grid;
    let mut first_node = vec![0; positions.len()];
    lattice.for_each_first_node(positions, half_size, |p, first| first_node[p] = first);
    let slab = |p: u32| grid.cell(0, positions[p as usize][0]) / SLAB;
    let order = (0..positions.len() as u32).collect();
    let (mut order, _) = sort(order, lattice.len(), |p| first_node[p as usize]);
    if by_cell {
        (order, _) = sort(order, grid.cells(), |p| grid.cell_of(&positions[p as usize]));
    }
    let (order, begin) = sort(order, grid.axes[0].cells.div_ceil(SLAB), slab);
    let slabs = begin.windows(2).map(|pair| pair[0]..pair[1]).collect();
    (order, slabs)
}

/// Sorts by a `key` below `keys`, stably; with the place where each key begins and the one where the last ends.
fn sort(order: Vec<u32>, keys: usize, key: impl Fn(u32) -> usize) -> (Vec<u32>, Vec<usize>) {
    let mut begin = vec![0; keys + 1];
    for p in &order {
        begin[key(*p) + 1] += 1;
    }
    for k in 0..keys {
        begin[k + 1] += begin[k];
    }
    let mut next = begin.clone();
    let mut sorted = vec![0; order.len()];
    for p in order {
        let slot = &mut next[key(p)];
        sorted[*slot] = p;
        *slot += 1;
    }
    (sorted, begin)
}
