//! Sums of weights, of places and of gradients over the nodes of a stencil.

use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_core::grid::{Axis, Grid, Side};
use mpm_core::lattice::{Lattice, Stencil};
use proptest::prelude::*;

/// Sums of a few products of weights of order one.
const ROUNDING: f64 = 1e-11;

/// Walls at the lower ends of all axes but the last, which is open below and a wall above.
fn grid<const D: usize>() -> Grid<D> {
    let mut axes = [Axis::bounded(-1.0, 5, (Side::Wall, Side::Open)); D];
    axes[D - 1] = Axis::bounded(0.5, 6, (Side::Open, Side::Wall));
    Grid { h: 0.5, axes }
}

/// Sum of the weights, of weight × position, and of gradient ⊗ position, by rows.
fn sums<const D: usize, const S: usize, B: Basis<S>>(x: &[f64; D], wall: WallTreatment) {
    let lattice = Lattice::<D, S, B>::new(grid::<D>(), wall);
    let mut index_of = vec![[0; D]; lattice.len()];
    lattice.for_each_node(|node, index| index_of[node] = *index);
    let stencil = lattice.stencil(x, &[0.125; D]);
    let last = stencil.last();
    let mut unity = 0.0;
    let mut place = [0.0; D];
    let mut gradient = [[0.0; D]; D];
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for r in 0..lines * rows {
        let row = stencil.row(r / rows, r % rows);
        for k in 0..S {
            let position = lattice.position(&index_of[row.node + k]);
            unity += row.w * last.w[k];
            for a in 0..D {
                place[a] += row.w * last.w[k] * position[a];
                for b in 0..D {
                    let along = if b == D - 1 { last.dw[k] } else { last.w[k] };
                    gradient[a][b] += row.gradient[b] * along * position[a];
                }
            }
        }
    }
    assert!((unity - 1.0).abs() < ROUNDING);
    for a in 0..D {
        assert!((place[a] - x[a]).abs() < ROUNDING, "{x:?} became {place:?}");
        for b in 0..D {
            let exact = f64::from(u8::from(a == b));
            assert!((gradient[a][b] - exact).abs() < ROUNDING, "{gradient:?}");
        }
    }
}

fn every_basis<const D: usize>(share: [f64; 3]) {
    let grid = grid::<D>();
    let x: [f64; D] = std::array::from_fn(|a| {
        let (lo, hi) = (grid.axes[a].lo, grid.axes[a].hi(grid.h));
        lo + share[a] * (hi - lo)
    });
    for wall in [WallTreatment::OpenKnot, WallTreatment::WallLine] {
        sums::<D, 2, Linear>(&x, wall);
        sums::<D, 3, Gimp>(&x, wall);
        sums::<D, 3, QuadraticBSpline>(&x, wall);
        sums::<D, 4, CubicBSpline>(&x, wall);
    }
}

proptest! {
    #[test]
    fn weights_of_the_product_sum_to_one_and_reproduce_position_and_gradient(
        share in prop::array::uniform3(prop_oneof![
            3 => 0.0..=1.0_f64, 1 => Just(0.0), 1 => Just(1.0),
        ])
    ) {
        every_basis::<1>(share);
        every_basis::<2>(share);
        every_basis::<3>(share);
    }
}
