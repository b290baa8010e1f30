//! Numbers with their derivatives.

use mpm_core::number::{Dual, Real};

/// Functions of two variables and what their derivatives are.
#[test]
fn derivatives_are_those_of_analysis() {
    let (a, b) = (1.7, 0.6);
    let (x, y) = (Dual::<2>::variable(a, 0), Dual::variable(b, 1));
    let two = Dual::splat(2.0);
    let mut in_place = x;
    in_place += y;
    in_place -= two;
    in_place *= x;
    for (found, value, slope) in [
        (x + y, a + b, [1.0, 1.0]),
        (x - y * two, a - 2.0 * b, [1.0, -2.0]),
        (x * y, a * b, [b, a]),
        (x / y, a / b, [1.0 / b, -a / (b * b)]),
        (-x, -a, [-1.0, 0.0]),
        (x.mul_add(y, two), a * b + 2.0, [b, a]),
        (in_place, (a + b - 2.0) * a, [2.0 * a + b - 2.0, a]),
        (x.sqrt(), a.sqrt(), [0.5 / a.sqrt(), 0.0]),
        ((x * y).exp(), (a * b).exp(), [b, a].map(|s| s * (a * b).exp())),
        (x.ln(), a.ln(), [1.0 / a, 0.0]),
        ((y - x).abs(), a - b, [1.0, -1.0]),
        (x.floor(), 1.0, [0.0, 0.0]),
        (x.at_least(1.0), a, [1.0, 0.0]),
        (x.at_least(2.0), 2.0, [0.0, 0.0]),
        (y.at_most(1.0), b, [0.0, 1.0]),
        (y.at_most(0.5), 0.5, [0.0, 0.0]),
        ((x - y).if_positive(x, y), a, [1.0, 0.0]),
        ((y - x).if_positive(x, y), b, [0.0, 1.0]),
        (x.with_slopes_of(y), a, [1.0, 1.0]),
    ] {
        assert!((found.value - value).abs() < 1e-15 * value.abs().max(1.0));
        for (found, slope) in found.slope.into_iter().zip(slope) {
            assert!((found - slope).abs() < 4e-15, "{found} {slope}");
        }
    }
}

/// The norm of nothing has an infinite slope times zero in it.
#[test]
fn the_root_of_zero_has_no_slope() {
    let x = Dual::<1>::variable(0.0, 0);
    assert_eq!((x * x).sqrt(), Dual::default());
}

#[test]
fn what_is_zero_but_moves_is_not_zero() {
    assert!(Dual::<1>::variable(0.0, 0) != Dual::default());
}
