//! Scenes in another frame and other units.

use mpm_core::{Axis, Frame, Grid, Side, SymmetricTensor};
use nalgebra::SMatrix;

fn turned() -> Frame<2> {
    Frame::along([(1, -1.0), (0, 1.0)]).shifted([5.0, -3.0]).in_units(8.0, 0.25)
}

#[test]
fn there_and_back_is_where_it_was() {
    let (frame, x) = (turned(), [0.75, 2.5]);
    assert_eq!(frame.place(&x), [5.0 - 20.0, -3.0 + 6.0]);
    assert_eq!(frame.place_of_scene(&frame.place(&x)), x);
    assert_eq!(frame.vector_of_scene(&frame.vector(&x, frame.force()), 2.0), x);
    assert_eq!(frame.axis(0), (1, 1.0));
    assert_eq!(frame.axis(1), (0, -1.0));
    assert_eq!(frame.axis(2), (2, 1.0));
}

#[test]
fn ends_change_sides_with_their_axis() {
    let axes = [Axis::bounded(-1.0, 4, (Side::Wall, Side::Open)), Axis::open(2.0, 6)];
    let grid = turned().grid(&Grid { h: 0.5, axes });
    assert_eq!(grid.h, 4.0);
    assert_eq!((grid.axes[0].lo, grid.axes[0].cells), (5.0 - 40.0, 6));
    assert_eq!(grid.axes[1].wall_ends(), (true, false));
    let mirrored = Frame::along([(0, -1.0), (1, 1.0)]).grid(&Grid { h: 0.5, axes });
    assert_eq!(mirrored.axes[0].wall_ends(), (false, true));
    assert_eq!(mirrored.axes[0].lo, -1.0);
}

/// The components of a stress turn as n ⊗ n does.
#[test]
fn a_stress_turns_with_its_directions() {
    let n = [0.25, -1.5];
    let m = turned().vector(&n, 1.0);
    let square = |n: [f64; 2]| SymmetricTensor {
        xx: n[0] * n[0],
        yy: n[1] * n[1],
        zz: 7.0,
        xy: n[0] * n[1],
        ..SymmetricTensor::default()
    };
    let back = turned().stress_of_scene(&square(m));
    let expected = square(n);
    assert_eq!((back.xx, back.yy, back.xy), (4.0 * expected.xx, 4.0 * expected.yy, 4.0 * expected.xy));
    assert_eq!(back.zz, 28.0);
}

#[test]
fn a_tensor_turns_with_its_directions() {
    let n = [0.25, -1.5];
    let m = turned().vector(&n, 1.0);
    let of_scene = SMatrix::from_fn(|i, j| n[i] * n[j]);
    let expected = SMatrix::<f64, 2, 2>::from_fn(|i, j| 3.0 * m[i] * m[j]);
    assert_eq!(turned().matrix(&of_scene, 3.0), expected);
}

#[test]
fn a_node_far_away_is_the_node_it_was() {
    let h = 0.05;
    let grid = Grid { h, axes: [Axis::open(0.0, 8)] };
    let frame = Frame::own().shifted([1e6]);
    for sixths in 0..48 {
        let x = f64::from(sixths) / 6.0 * h;
        let seen = frame.node_of_scene(&grid, &frame.place(&[x]));
        assert!((seen[0] - x).abs() < 1e-16);
    }
}
