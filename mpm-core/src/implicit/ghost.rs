//! The ghost penalty (Burman 2010, doi:10.1016/j.crma.2010.10.006): what a cell with hardly any material lacks, its
//! neighbours lend it.
//!
//! On the faces between cells of the body, one of which is at its edge, the polynomials of either side are drawn
//! together: γ E h^(2k−1) ∫ \[∂ₙᵏu\] · \[∂ₙᵏv\] with the degree k. All lower derivatives of a spline are continuous, so
//! the jump is all by which the two differ. It vanishes where u is one polynomial of degree k.

use super::domains::Domains;
use super::penalty::Penalty;
use super::pieces::{AxisPieces, Pieces};
use crate::lattice::Lattice;
use nalgebra::DMatrix;
use std::array::from_fn;

/// Intervals of all axes, and which of them hold material.
struct Cells<const D: usize> {
    axes: [AxisPieces; D],
    active: Vec<bool>,
}

/// Indices of a place among `counts`, the last of which runs fastest.
pub(super) fn indices<const D: usize>(mut place: usize, counts: [usize; D]) -> [usize; D] {
    let mut index = [0; D];
    for a in (0..D).rev() {
        index[a] = place % counts[a];
        place /= counts[a];
    }
    index
}

impl<const D: usize> Cells<D> {
    fn count(&self, axis: usize) -> usize {
        self.axes[axis].top.len()
    }

    fn place(&self, cell: &[usize; D]) -> usize {
        (0..D).fold(0, |place, a| place * self.count(a) + cell[a])
    }

    fn cell(&self, place: usize) -> [usize; D] {
        indices(place, from_fn(|a| self.count(a)))
    }

    /// The interval after `i`, if there is one.
    fn next(&self, axis: usize, i: usize) -> Option<usize> {
        let n = self.count(axis);
        let wraps = self.axes[axis].periodic && i + 1 == n;
        if wraps { Some(0) } else { Some(i + 1).filter(|i| *i < n) }
    }

    /// Whether a neighbour of the cell, also across an edge or corner, holds no material. Cells behind a wall count as
    /// full, cells beyond an open end as empty.
    fn at_edge(&self, cell: &[usize; D]) -> bool {
        (0..3_usize.pow(D as u32)).any(|k| {
            let mut neighbour = [0; D];
            for a in 0..D {
                let (axis, n) = (&self.axes[a], self.count(a) as isize);
                let mut i = cell[a] as isize + (k / 3_usize.pow(a as u32) % 3) as isize - 1;
                if axis.periodic {
                    i = i.rem_euclid(n);
                }
                let beyond = axis.beyond as isize;
                if (i < beyond && axis.walls.0) || (i >= n - beyond && axis.walls.1) {
                    return false;
                }
                if i < 0 || i >= n {
                    return true;
                }
                neighbour[a] = i as usize;
            }
            !self.active[self.place(&neighbour)]
        })
    }

    /// Counts cells as the body's by which parts of it that touch at an edge or a corner alone share faces: no face ties
    /// them else.
    fn bridge(&mut self) {
        // Blocks of two cells along two axes, then along three.
        for axes in (0..1_usize << D).filter(|axes| axes.count_ones() > 1) {
            let corners: Vec<usize> = (0..1 << D).filter(|k| k & !axes == 0).collect();
            let block = |first: usize| {
                let corner = |k: &usize| {
                    let mut cell = self.cell(first);
                    for a in (0..D).filter(|a| k >> a & 1 == 1) {
                        cell[a] = self.next(a, cell[a])?;
                    }
                    Some(self.place(&cell))
                };
                let places: Option<Vec<usize>> = corners.iter().map(corner).collect();
                places.filter(|places| {
                    let full = |k: &usize| corners.iter().position(|c| c == k).is_some_and(|n| self.active[places[n]]);
                    let mut apart: Vec<usize> = corners.iter().copied().filter(full).collect();
                    let mut reached: Vec<usize> = apart.pop().into_iter().collect();
                    while let Some(k) = reached.pop() {
                        reached.extend(apart.extract_if(.., |other| (*other ^ k).is_power_of_two()));
                    }
                    !apart.is_empty()
                })
            };
            for place in (0..self.active.len()).filter_map(block).flatten().collect::<Vec<_>>() {
                self.active[place] = true;
            }
        }
    }
}

/// Penalties of the faces near the edge of the body on a field with this many `components`, with γ E the `strength`, of
/// which a face has the least `share` of the particles in its two cells; all of it without shares.
pub(super) fn penalties<const D: usize, const S: usize, B: Pieces<S>>(
    lattice: &Lattice<D, S, B>,
    strength: f64,
    share: &[f64],
    components: usize,
    domains: Domains<D>,
) -> Vec<Penalty> {
    let h = lattice.grid.h;
    let axes: [AxisPieces; D] = from_fn(|a| B::pieces(&lattice.grid.axes[a], h));
    let degree = axes[0].degree;
    let mut cells = Cells { active: vec![false; axes.iter().map(|a| a.top.len()).product()], axes };
    let mut least = vec![1.0_f64; cells.active.len()];
    for (p, (x, half_size)) in domains.iter().enumerate() {
        let stencil = lattice.stencil(x, &half_size);
        let touched = stencil.axis.each_ref().map(|axis| B::touched(axis));
        for k in 0..touched.iter().product() {
            let index = indices(k, touched);
            let place = cells.place(&from_fn(|a| stencil.axis[a].first + index[a]));
            cells.active[place] = true;
            least[place] = least[place].min(share.get(p).copied().unwrap_or(1.0));
        }
    }
    cells.bridge();
    let at_edge: Vec<bool> =
        (0..cells.active.len()).map(|place| cells.active[place] && cells.at_edge(&cells.cell(place))).collect();
    let mut first_node = usize::MAX;
    lattice.for_each_node(|node, _| first_node = first_node.min(node));
    let strides: [usize; D] = from_fn(|a| match D - a {
        1 => 1,
        2 => lattice.row_length(),
        _ => lattice.plane(),
    });
    let scale = strength * h.powi(2 * degree as i32 - 1);
    let mut found = Vec::new();
    for place in 0..cells.active.len() {
        let cell = cells.cell(place);
        for normal in 0..D {
            let Some(after) = cells.next(normal, cell[normal]) else {
                continue;
            };
            let mut beside = cell;
            beside[normal] = after;
            let other = cells.place(&beside);
            if !(cells.active[place] && cells.active[other] && (at_edge[place] || at_edge[other])) {
                continue;
            }
            let scale = scale * least[place].min(least[other]);
            let axis = &cells.axes[normal];
            let mut jump = vec![0.0; degree + 2];
            for k in 0..=degree {
                jump[k + 1] += axis.top[after][k];
                jump[k] -= axis.top[cell[normal]][k];
            }
            let counts: [usize; D] = from_fn(|a| if a == normal { degree + 2 } else { degree + 1 });
            let functions: usize = counts.iter().product();
            let mut stiffness = DMatrix::zeros(functions * components, functions * components);
            for j in 0..functions {
                for i in 0..functions {
                    let (p, q) = (indices(i, counts), indices(j, counts));
                    let mut k = scale * jump[p[normal]] * jump[q[normal]];
                    for a in (0..D).filter(|a| *a != normal) {
                        k *= cells.axes[a].mass[cell[a]][p[a]][q[a]];
                    }
                    for c in 0..components {
                        stiffness[(i * components + c, j * components + c)] = k;
                    }
                }
            }
            let node = (0..functions).map(|k| {
                let index = indices(k, counts);
                (0..D).fold(first_node, |node, a| {
                    let (at, n) = (cell[a] + index[a], cells.count(a));
                    // A face where an axis closes has functions beyond the last image.
                    node + if cells.axes[a].periodic && at >= n { at - n } else { at } * strides[a]
                })
            });
            found.push(Penalty { node: node.collect(), stiffness });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::domains::HalfSizes;
    use super::*;
    use crate::basis::{Linear, WallTreatment};
    use crate::grid::{Axis, Grid};

    /// Two rows of cells: as many faces between them, and in each row one fewer, or as many where it closes.
    #[test]
    fn faces_are_between_all_cells_that_are_next_to_each_other() {
        const CELLS: usize = 6;
        let centre: Vec<[f64; 2]> =
            (0..2 * CELLS).map(|k| [(k % CELLS) as f64 + 0.5, (k / CELLS) as f64 + 2.5]).collect();
        let half_size = HalfSizes::OfAll([0.25; 2]);
        for (axis, in_a_row) in [(Axis::open(0.0, CELLS), CELLS - 1), (Axis::periodic(0.0, CELLS), CELLS)] {
            let grid = Grid::new(1.0, [axis, Axis::open(0.0, CELLS)]).unwrap();
            let lattice = Lattice::<2, 2, Linear>::new(grid, WallTreatment::OpenKnot);
            let domains = Domains { centre: &centre, half_size };
            let found = penalties(&lattice, 1.0, &[], 1, domains);
            assert_eq!(found.len(), CELLS + 2 * in_a_row);
            let last = lattice.len();
            assert!(found.iter().flat_map(|p| &p.node).all(|node| *node < last));
        }
    }

    /// Two cells that touch at a corner, in the plane and in space, are tied through the cells between them.
    #[test]
    fn cells_that_touch_at_a_corner_share_faces() {
        fn faces<const D: usize>(cells: &[[f64; D]]) -> usize {
            let grid = Grid::new(1.0, [Axis::open(0.0, 4); D]).unwrap();
            let lattice = Lattice::<D, 2, Linear>::new(grid, WallTreatment::OpenKnot);
            let half_size = HalfSizes::OfAll([0.25; D]);
            penalties(&lattice, 1.0, &[], 1, Domains { centre: cells, half_size }).len()
        }
        assert_eq!(faces(&[[0.5, 0.5], [1.5, 1.5]]), 4);
        assert_eq!(faces(&[[0.5, 1.5], [1.5, 0.5]]), 4);
        assert_eq!(faces(&[[0.5, 0.5], [2.5, 0.5]]), 0);
        assert_eq!(faces(&[[0.5, 0.5, 0.5], [1.5, 1.5, 1.5]]), 12);
        assert_eq!(faces(&[[0.5, 0.5, 0.5], [1.5, 1.5, 0.5]]), 4);
    }
}
