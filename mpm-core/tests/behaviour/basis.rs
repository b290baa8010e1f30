//! Properties of every basis.

use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_core::number::{EIGHT, Eight, Real};
use mpm_core::{Axis, Side};
use proptest::prelude::*;

/// Tolerance of an identity between sums of a few weights of order one.
const ROUNDING: f64 = 1e-12;

fn axes() -> impl Strategy<Value = Axis> {
    let sides = || prop_oneof![Just(Side::Open), Just(Side::Wall)];
    let bounded = (sides(), sides(), -3.0..3.0, 4usize..9)
        .prop_map(|(lo, hi, origin, cells)| Axis::bounded(origin, cells, (lo, hi)));
    let periodic = (-3.0..3.0, 4usize..9).prop_map(|(origin, cells)| Axis::periodic(origin, cells));
    prop_oneof![3 => bounded, 1 => periodic]
}

fn walls() -> impl Strategy<Value = WallTreatment> {
    prop_oneof![Just(WallTreatment::OpenKnot), Just(WallTreatment::WallLine)]
}

/// Places along an axis, its ends and knots among them, as a share of its length.
fn places() -> impl Strategy<Value = f64> {
    prop_oneof![4 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0), 1 => Just(0.25), 1 => Just(0.5)]
}

fn check<const S: usize, B: Basis<S>>(axis: Axis, h: f64, wall: WallTreatment, place: f64, half: f64) {
    let basis = B::new(&axis, h, wall);
    let nodes = basis.nodes();
    let length = axis.hi(h) - axis.lo;
    let x = axis.lo + place * length;
    let half_size = half * h;
    let at = basis.weights(x, half_size);
    assert!(at.first + S <= nodes.position.len(), "{axis:?} {x}");

    // Eight side by side have the bits of one after the other, wherever the others are.
    let beside = |k: usize| axis.lo + (place + 0.123 * k as f64).fract() * length;
    let places: [f64; EIGHT] = std::array::from_fn(|k| if k == 5 { x } else { beside(k) });
    let eight = basis.weights_of_eight(Eight::pack(|k| places[k]), half_size);
    for (k, x) in places.into_iter().enumerate() {
        assert_eq!(eight.part(k), basis.weights(x, half_size), "{x}");
    }

    let unity: f64 = at.w.iter().sum();
    let slope: f64 = at.dw.iter().sum();
    assert!((unity - 1.0).abs() < ROUNDING, "sum: {unity}");
    assert!((slope * h).abs() < ROUNDING, "derivative of one: {slope}");
    let positive = at.w.iter().all(|w| *w > -ROUNDING);
    assert!(positive, "negative weight: {:?}", at.w);

    let position = &nodes.position[at.first..at.first + S];
    let reproduced: f64 = at.w.iter().zip(position).map(|(w, q)| w * q).sum();
    let one: f64 = at.dw.iter().zip(position).map(|(dw, q)| dw * q).sum();
    let error = (reproduced - x).abs();
    assert!(error < ROUNDING * 10.0, "{x} became {reproduced}");
    let error = (one - 1.0).abs();
    assert!(error < ROUNDING * 100.0, "derivative of x: {one}");

    // A central difference of step d errs by d² w‴/6 inside a polynomial piece and by d w″ where a knot lies within it;
    // w″ h² ≤ 6 and w‴ h³ ≤ 9 for all bases, except at the kink of hats.
    let d = 1e-6 * h;
    if x - d > axis.lo && x + d < axis.hi(h) {
        let dense = |x: f64| {
            let at = basis.weights(x, half_size);
            let mut all = vec![0.0; nodes.position.len()];
            all[at.first..at.first + S].copy_from_slice(&at.w);
            all
        };
        let (ahead, behind) = (dense(x + d), dense(x - d));
        let kink = S == 2 && ((x - axis.lo) / h).fract().min(1.0 - ((x - axis.lo) / h).fract()) < 2e-6;
        for (k, dw) in at.dw.iter().enumerate() {
            let difference = (ahead[at.first + k] - behind[at.first + k]) / (2.0 * d);
            assert!(kink || (difference - dw).abs() * h < 2e-5, "{dw} but {difference} at {x}");
        }
    }
}

proptest! {
    #[test]
    fn linear(axis in axes(), h in 0.1..2.0, wall in walls(), place in places()) {
        check::<2, Linear>(axis, h, wall, place, 0.25);
    }

    #[test]
    fn gimp(axis in axes(), h in 0.1..2.0, place in places(), half in 0.05..=0.5) {
        check::<3, Gimp>(axis, h, WallTreatment::OpenKnot, place, half);
    }

    #[test]
    fn quadratic(axis in axes(), h in 0.1..2.0, wall in walls(), place in places()) {
        check::<3, QuadraticBSpline>(axis, h, wall, place, 0.25);
    }

    #[test]
    fn cubic(axis in axes(), h in 0.1..2.0, wall in walls(), place in places()) {
        check::<4, CubicBSpline>(axis, h, wall, place, 0.25);
    }
}

#[test]
fn open_knots_interpolate_at_walls_and_nodes_stand_on_both_kinds_of_wall() {
    let axis = Axis::walls(0.0, 6);
    let basis = CubicBSpline::new(&axis, 0.5, WallTreatment::OpenKnot);
    assert_eq!(basis.weights(0.0, 0.0).w, [1.0, 0.0, 0.0, 0.0]);
    assert!((basis.weights(3.0, 0.0).w[3] - 1.0).abs() < ROUNDING);
    for wall in [WallTreatment::OpenKnot, WallTreatment::WallLine] {
        for nodes in [QuadraticBSpline::new(&axis, 0.5, wall).nodes(), CubicBSpline::new(&axis, 0.5, wall).nodes()] {
            assert!(nodes.position.iter().any(|x| x.abs() < ROUNDING));
            assert!(nodes.position.iter().any(|x| (x - 3.0).abs() < ROUNDING));
        }
    }
}

#[test]
fn interior_splines_are_the_textbook_ones() {
    let axis = Axis::open(0.0, 8);
    let quadratic = QuadraticBSpline::new(&axis, 1.0, WallTreatment::OpenKnot).weights(3.5, 0.0);
    assert_eq!(quadratic.w, [0.125, 0.75, 0.125]);
    let cubic = CubicBSpline::new(&axis, 1.0, WallTreatment::OpenKnot).weights(4.0, 0.0);
    for (w, exact) in cubic.w.iter().zip([1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0]) {
        assert!((w - exact).abs() < ROUNDING);
    }
}

/// Means tend to hats where domains shrink, and of a point they are the hats: also on the last vertex and beyond it.
#[test]
fn of_a_point_means_are_hats() {
    let axis = Axis::open(-1.0, 8);
    let basis = Gimp::new(&axis, 0.5, WallTreatment::OpenKnot);
    let nodes = basis.nodes().position;
    for x in [-1.2, -1.0, -0.9, 0.0, 0.3, 2.99, 3.0, 3.4] {
        let at = basis.at_point(x);
        for (k, (w, dw)) in at.w.iter().zip(at.dw).enumerate() {
            let distance = (x - nodes[at.first + k]) / 0.5;
            assert!((w - (1.0 - distance.abs()).max(0.0)).abs() < 1e-14, "{x} {k}");
            assert!(*w == 0.0 || *w == 1.0 || (dw + 2.0 * distance.signum()).abs() < 1e-14);
        }
        assert!(at.dw.iter().sum::<f64>().abs() < 1e-14);
    }
}

#[test]
fn gimp_is_the_average_of_the_hat_over_the_particle() {
    // Midpoint rule on 20,000 points of a piecewise linear function: error below 1e-8.
    let axis = Axis::open(0.0, 8);
    let basis = Gimp::new(&axis, 1.0, WallTreatment::OpenKnot);
    let nodes = basis.nodes().position;
    for (x, half) in [(3.1, 0.25), (3.9, 0.25), (4.0, 0.5), (2.5, 0.1)] {
        let at = basis.weights(x, half);
        for (k, w) in at.w.iter().enumerate() {
            let n = 20_000;
            let mean: f64 = (0..n)
                .map(|i| x + half * (2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0))
                .map(|q| (1.0 - (q - nodes[at.first + k]).abs()).max(0.0))
                .sum::<f64>()
                / f64::from(n);
            assert!((mean - w).abs() < 1e-7, "{x} {half} {k}: {w} but {mean}");
        }
    }
}

/// The greatest h² Σ w′²/w over many places in a cell, and the value that the basis states.
fn steepest<const S: usize, B: Basis<S>>(half_size: f64) -> (f64, Option<f64>) {
    const PLACES: u32 = 20_000;
    let basis = B::new(&Axis::periodic(0.0, 8), 1.0, WallTreatment::OpenKnot);
    let at = |k: u32| {
        let at = basis.weights(3.0 + f64::from(k) / f64::from(PLACES), half_size);
        let seen = at.w.iter().zip(&at.dw).filter(|(w, _)| **w > 0.0);
        seen.map(|(w, dw)| dw * dw / w).sum::<f64>()
    };
    ((1..PLACES).map(at).fold(0.0, f64::max), B::steepness(half_size))
}

#[test]
fn the_steepness_is_the_greatest_over_a_cell() {
    let near = |(found, said): (f64, Option<f64>)| {
        let said = said.unwrap();
        assert!(found <= said && found > 0.99 * said, "{found} {said}");
    };
    near(steepest::<3, QuadraticBSpline>(0.25));
    near(steepest::<4, CubicBSpline>(0.25));
    for half_size in [0.5, 0.25, 0.125] {
        near(steepest::<3, Gimp>(half_size));
    }
    let (found, said) = steepest::<2, Linear>(0.25);
    assert!(said.is_none() && found > 1e4, "{found}");
}
