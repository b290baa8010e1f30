//! The nodes that particles can see before they are sorted again.

use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_core::grid::{Axis, Grid};
use mpm_core::lattice::{Lattice, Stencil};
use mpm_core::parallel::NODE_CHUNK;
use mpm_core::reach::Reach;
use proptest::prelude::*;

const H: f64 = 0.5;
/// In three dimensions more nodes than a chunk has.
const CELLS: usize = 20;

/// Every node that the particles see, now and after any motion by at most a cell, is within reach.
fn covers<const D: usize, const S: usize, B: Basis<S>>(places: &[[f64; 6]]) {
    let grid = Grid::new(H, [Axis::walls(-1.0, CELLS); D]).unwrap();
    let lattice = Lattice::<D, S, B>::new(grid, WallTreatment::WallLine);
    let end = grid.axes[0].hi(H);
    let at = |place: &[f64; 6]| std::array::from_fn(|a| -1.0 + CELLS as f64 * H * place[a]);
    let positions: Vec<[f64; D]> = places.iter().map(at).collect();
    let reach = Reach::of(&lattice, [&positions[..]], &[0.25 * H; D]);
    assert!(D == 1 || !reach.contains(0));
    assert!(D < 3 || lattice.len() > 2 * NODE_CHUNK);
    let mut field = vec![1; lattice.len()];
    reach.clear(&mut field);
    for (node, value) in field.iter().enumerate() {
        assert_eq!(reach.contains(node), *value == 0);
    }
    for (x, place) in positions.iter().zip(places) {
        let moved = std::array::from_fn(|a| (x[a] + H * (2.0 * place[3 + a] - 1.0)).clamp(-1.0, end));
        for x in [*x, moved] {
            let stencil = lattice.stencil(&x, &[0.25 * H; D]);
            let (lines, rows) = Stencil::<D, S>::OUTER;
            for r in 0..lines * rows {
                let row = stencil.row(r / rows, r % rows).node;
                assert!((row..row + S).all(|node| reach.contains(node)));
            }
        }
    }
}

proptest! {
    #[test]
    fn particles_find_their_nodes_within_reach(
        places in prop::collection::vec(prop::array::uniform6(0.0..=1.0_f64), 1..8)
    ) {
        covers::<1, 3, Gimp>(&places);
        covers::<2, 3, Gimp>(&places);
        covers::<3, 3, Gimp>(&places);
        covers::<2, 2, Linear>(&places);
        covers::<3, 3, QuadraticBSpline>(&places);
        covers::<3, 4, CubicBSpline>(&places);
    }
}
