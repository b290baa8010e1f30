//! Logarithm and exponential of symmetric tensors.
//!
//! Near the identity, where elastic strains of stiff materials are, both are power series. By the theorem of
//! Cayley and Hamilton every power of z is a combination of z², z and I, so that the series run over three
//! numbers and no eigenvectors are needed. Farther away eigenvalues take over.

use super::SymmetricTensor;
use nalgebra::Matrix3;

/// Largest square of the norm at which the series are used: with it the first term left out is below
/// 10⁻¹⁵ of the first one.
const NEAR: f64 = 0.01;
/// Odd powers of the logarithm's series: z¹⁵/15 is below 10⁻¹⁵ of z at ‖z‖ = 0.1.
const LOGARITHM_TERMS: u32 = 7;
/// Powers of the exponential's series: 0.1¹¹/11! is below 10⁻¹⁸.
const EXPONENTIAL_TERMS: u32 = 10;

/// A z² + B z + C I.
#[derive(Clone, Copy, Default)]
struct Quadratic {
    square: f64,
    linear: f64,
    constant: f64,
}

impl Quadratic {
    fn add(&mut self, factor: f64, other: Self) {
        self.square += factor * other.square;
        self.linear += factor * other.linear;
        self.constant += factor * other.constant;
    }
}

/// The powers of a tensor, one after the other, by z³ = I₁ z² − I₂ z + I₃ I.
struct Powers {
    first: f64,
    second: f64,
    third: f64,
    now: Quadratic,
}

impl Powers {
    /// At the first power of `z`, whose square is `square`.
    fn new(z: &SymmetricTensor, square: &SymmetricTensor) -> Self {
        let first = z.trace();
        Self {
            first,
            second: 0.5 * (first * first - square.trace()),
            third: z.determinant(),
            now: Quadratic {
                linear: 1.0,
                ..Quadratic::default()
            },
        }
    }

    fn advance(&mut self) {
        let Quadratic {
            square,
            linear,
            constant,
        } = self.now;
        self.now = Quadratic {
            square: linear + self.first * square,
            linear: constant - self.second * square,
            constant: self.third * square,
        };
    }
}

impl SymmetricTensor {
    /// The natural logarithm of a positive definite tensor, such as twice Hencky's strain of a left
    /// Cauchy–Green tensor: 2 (z + z³/3 + z⁵/5 + …) with z = (b − I)(b + I)⁻¹.
    #[must_use]
    pub fn ln(&self) -> Self {
        let excess = self.scale_add_identity(1.0, -1.0);
        let z = excess.times_commuting(&excess.scale_add_identity(1.0, 2.0).inverse());
        let square = z.times_commuting(&z);
        // Not below for a tensor that isn't finite.
        if square.trace() < NEAR {
            let mut powers = Powers::new(&z, &square);
            let mut sum = powers.now;
            for k in 1..LOGARITHM_TERMS {
                powers.advance();
                powers.advance();
                sum.add(1.0 / f64::from(2 * k + 1), powers.now);
            }
            z.combine(&square, 2.0, sum)
        } else {
            self.map_eigenvalues(f64::ln)
        }
    }

    /// The exponential I + a + a²/2 + a³/6 + ….
    #[must_use]
    pub fn exp(&self) -> Self {
        let square = self.times_commuting(self);
        if square.trace() < NEAR {
            let mut powers = Powers::new(self, &square);
            let mut sum = powers.now;
            sum.constant += 1.0;
            let mut factor = 1.0;
            for k in 2..=EXPONENTIAL_TERMS {
                powers.advance();
                factor /= f64::from(k);
                sum.add(factor, powers.now);
            }
            self.combine(&square, 1.0, sum)
        } else {
            self.map_eigenvalues(f64::exp)
        }
    }

    /// The product with a tensor that has the same principal axes, which is symmetric.
    #[must_use]
    #[inline]
    pub fn times_commuting(&self, other: &Self) -> Self {
        let (a, b) = (self, other);
        Self {
            xx: a.xx * b.xx + a.xy * b.xy + a.xz * b.xz,
            yy: a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
            zz: a.xz * b.xz + a.yz * b.yz + a.zz * b.zz,
            xy: a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
            yz: a.xy * b.xz + a.yy * b.yz + a.yz * b.zz,
            xz: a.xx * b.xz + a.xy * b.yz + a.xz * b.zz,
        }
    }

    /// The inverse, by cofactors.
    #[must_use]
    #[inline]
    fn inverse(&self) -> Self {
        let cofactors = Self {
            xx: self.yy * self.zz - self.yz * self.yz,
            yy: self.xx * self.zz - self.xz * self.xz,
            zz: self.xx * self.yy - self.xy * self.xy,
            xy: self.xz * self.yz - self.xy * self.zz,
            yz: self.xy * self.xz - self.yz * self.xx,
            xz: self.xy * self.yz - self.xz * self.yy,
        };
        let determinant = self.xx * cofactors.xx + self.xy * cofactors.xy + self.xz * cofactors.xz;
        cofactors.scale_add_identity(1.0 / determinant, 0.0)
    }

    /// `factor` (A z² + B z + C I) with the square of this tensor z.
    #[inline]
    fn combine(&self, square: &Self, factor: f64, by: Quadratic) -> Self {
        let (a, b) = (factor * by.square, factor * by.linear);
        let sum = Self {
            xx: a * square.xx + b * self.xx,
            yy: a * square.yy + b * self.yy,
            zz: a * square.zz + b * self.zz,
            xy: a * square.xy + b * self.xy,
            yz: a * square.yz + b * self.yz,
            xz: a * square.xz + b * self.xz,
        };
        sum.scale_add_identity(1.0, factor * by.constant)
    }

    /// The tensor with the same principal axes and mapped eigenvalues.
    fn map_eigenvalues(&self, f: fn(f64) -> f64) -> Self {
        let eigen = self.to_matrix().symmetric_eigen();
        let mapped = Matrix3::from_diagonal(&eigen.eigenvalues.map(f));
        Self::symmetric_part(&(eigen.eigenvectors * mapped * eigen.eigenvectors.transpose()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tensors() -> impl Strategy<Value = SymmetricTensor> {
        prop::array::uniform9(-1.0..1.0_f64)
            .prop_map(|a| SymmetricTensor::symmetric_part(&Matrix3::from_row_slice(&a)))
    }

    fn distance(a: &SymmetricTensor, b: &SymmetricTensor) -> f64 {
        (a.to_matrix() - b.to_matrix()).norm()
    }

    proptest! {
        /// On both sides of the switch, and from strains of 10⁻⁶ on: series and eigenvalues agree to
        /// rounding of the identity that the strain is added to.
        #[test]
        fn series_and_eigenvalues_agree(a in tensors(), digits in -6.0..0.0_f64) {
            let strain = a.scale_add_identity(10.0_f64.powf(digits), 0.0);
            let b = strain.map_eigenvalues(f64::exp);
            prop_assert!(distance(&strain.exp(), &b) < 2e-14);
            prop_assert!(distance(&b.ln(), &b.map_eigenvalues(f64::ln)) < 2e-14);
            prop_assert!(distance(&b.ln(), &strain) < 2e-14);
        }

        #[test]
        fn the_inverse_inverts(a in tensors()) {
            let b = a.scale_add_identity(0.3, 1.5);
            let one = b.times_commuting(&b.inverse());
            prop_assert!(distance(&one, &SymmetricTensor::identity()) < 1e-13);
        }
    }

    /// Along an axis the logarithm is the scalar one, to 10⁻¹⁵ of itself where the strain is small.
    #[test]
    fn small_strains_keep_their_digits() {
        for stretch in [1.0 + 1e-9, 1.0 + 1e-5, 0.999, 1.05] {
            let b = SymmetricTensor {
                xx: stretch,
                ..SymmetricTensor::identity()
            };
            let (found, exact) = (b.ln(), (stretch - 1.0_f64).ln_1p());
            assert!((found.xx / exact - 1.0).abs() < 2e-15, "{stretch}");
            assert!(found.yy.abs() < 1e-16 && found.xy == 0.0);
        }
    }

    #[test]
    fn what_is_not_finite_stays_so() {
        let broken = SymmetricTensor {
            xy: f64::NAN,
            ..SymmetricTensor::identity()
        };
        assert!(broken.ln().trace().is_nan() && broken.exp().trace().is_nan());
    }
}
