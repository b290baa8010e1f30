//! How a motion in `D` dimensions sits in three: uniaxial strain (1), plane strain (2), solid (3).
//!
//! Out of the space of the motion nothing stretches, so the deformation gradient is completed by
//! ones on the diagonal. Laws see three dimensions only.

use crate::number::{Lanes, Real};
use crate::tensor;
use nalgebra::{Matrix3, SMatrix};

/// The relative deformation gradient completed to three dimensions.
#[inline]
pub fn embed<const D: usize>(f: &SMatrix<f64, D, D>) -> Matrix3<f64> {
    let mut full = Matrix3::identity();
    for i in 0..D {
        for j in 0..D {
            full[(i, j)] = f[(i, j)];
        }
    }
    full
}

/// The same of its entries, one number each or eight.
#[inline(always)]
pub fn embed_entries<T: Real, const D: usize>(f: &[[T; D]; D]) -> Matrix3<T> {
    let (zero, one) = (T::default(), T::splat(1.0));
    let entry = |i: usize, j: usize| match i < D && j < D {
        true => f[i][j],
        false if i == j => one,
        false => zero,
    };
    Matrix3::from_fn(entry)
}

/// The determinant of a deformation gradient (that of its completion).
#[inline]
pub fn determinant<const D: usize>(f: &SMatrix<f64, D, D>) -> f64 {
    determinant_of_entries::<f64, D>(&std::array::from_fn(|a| std::array::from_fn(|b| f[(a, b)])))
}

/// The same of its entries, one number each or eight.
#[inline(always)]
pub fn determinant_of_entries<T: Real, const D: usize>(f: &[[T; D]; D]) -> T {
    match D {
        1 => f[0][0],
        2 => f[0][0] * f[1][1] - f[0][1] * f[1][0],
        _ => tensor::determinant(&embed_entries(f)),
    }
}

/// `x^(1/D)`: by how much each of the `D` directions stretches when the volume grows by `x`,
/// the exponent of Eq. (18). In plane strain the out-of-plane stretch stays one, so `D` = 2.
#[inline(always)]
pub fn stretch_of_volume<T: Lanes, const D: usize>(x: T) -> T {
    match D {
        1 => x,
        2 => x.sqrt(),
        _ => cube_root(x),
    }
}

/// How far from one the series of [`near_one`] serves.
const NEAR: f64 = 0.05;

/// Near one, where steps are, ten times as fast as the library's.
#[inline(always)]
fn cube_root<T: Lanes>(x: T) -> T {
    if (x - T::splat(1.0)).abs().all_below(NEAR) {
        return near_one(x);
    }
    T::pack(|k| match x.part(k) {
        x if (x - 1.0).abs() < NEAR => near_one(x),
        x => x.cbrt(),
    })
}

/// Three terms of the binomial series, which err by less than 10⁻⁶, and one step of Halley's method, which makes of
/// that its cube.
#[inline(always)]
fn near_one<T: Real>(x: T) -> T {
    let excess = x - T::splat(1.0);
    let terms = [5.0 / 81.0, -1.0 / 9.0, 1.0 / 3.0, 1.0].map(T::splat);
    let root = terms[1..].iter().fold(terms[0], |sum, term| *term + excess * sum);
    let cube = root * root * root;
    root + root * (x - cube) / (cube + cube + x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Eight;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_cube_root_is_that_of_the_library(x in prop_oneof![0.9..1.1_f64, 0.0..10.0_f64]) {
            for beside in [1.0, 3.0] {
                let eight = Eight::pack(|l| if l == 3 { x } else { beside });
                let roots = cube_root::<Eight>(eight).to_array();
                prop_assert!((roots[3] / x.cbrt() - 1.0).abs() < 5e-16);
                prop_assert!((roots[4] / f64::cbrt(beside) - 1.0).abs() < 5e-16);
            }
        }
    }
}
