//! Logarithm and exponential of symmetric tensors.
//!
//! Near the identity, where elastic strains of stiff materials are, both are power series. By the theorem of Cayley and
//! Hamilton every power of z is a combination of z², z and I, so that the series run over three numbers and no
//! eigenvectors are needed. Farther away the exponential is that of a half, squared, as often as it takes, and the
//! logarithm twice that of the root. All of it is arithmetic: a derivative passes through, be eigenvalues equal or not.
//! Rounding is that of the condition of b, 10⁻¹³ at stretches from 0.2 to 5 and more beyond.

use super::SymmetricTensor;
use crate::number::Real;

/// Largest square of the norm at which the series are used: with it the first term left out is below
/// 10⁻¹⁵ of the first one.
const NEAR: f64 = 0.01;
/// Largest square of the norm at which the first few terms of the series are enough: strains of a stiff ground.
const VERY_NEAR: f64 = 1e-6;
/// Odd powers of the logarithm's series, very near and near: z⁷/7 is below 10⁻¹⁸ of z at ‖z‖ = 10⁻³, z¹⁵/15
/// below 10⁻¹⁵ at 0.1.
const LOGARITHM_TERMS: (u32, u32) = (3, 7);
/// Powers of the exponential's series: 10⁻¹⁸/6! is below 10⁻²⁰, 0.1¹¹/11! below 10⁻¹⁸.
const EXPONENTIAL_TERMS: (u32, u32) = (5, 10);
/// Maximum number of halvings of an exponent, and of roots of a logarithm's argument: beyond it numbers overflow.
const MOST_HALVINGS: u32 = 13;
/// Newton steps for the trace of a root: at most this many.
const MOST_STEPS: u32 = 50;
/// A step by less than this share of the trace was the last: its square is what remains.
const ACCURACY: f64 = 1e-10;

/// A z² + B z + C I.
#[derive(Clone, Copy, Default)]
struct Quadratic<T> {
    square: T,
    linear: T,
    constant: T,
}

impl<T: Real> Quadratic<T> {
    #[inline]
    fn add(&mut self, factor: f64, other: Self) {
        let factor = T::splat(factor);
        self.square += factor * other.square;
        self.linear += factor * other.linear;
        self.constant += factor * other.constant;
    }
}

/// The powers of a tensor, one after the other, by z³ = I₁ z² − I₂ z + I₃ I.
struct Powers<T> {
    first: T,
    second: T,
    third: T,
    now: Quadratic<T>,
}

impl<T: Real> Powers<T> {
    /// At the first power of `z`, whose square is `square`.
    #[inline]
    fn new(z: &SymmetricTensor<T>, square: &SymmetricTensor<T>) -> Self {
        let first = z.trace();
        Self {
            first,
            second: T::splat(0.5) * (first * first - square.trace()),
            third: z.determinant(),
            now: Quadratic { linear: T::splat(1.0), ..Quadratic::default() },
        }
    }

    #[inline]
    fn advance(&mut self) {
        let Quadratic { square, linear, constant } = self.now;
        self.now = Quadratic {
            square: linear + self.first * square,
            linear: constant - self.second * square,
            constant: self.third * square,
        };
    }
}

/// The number of terms for a tensor of this squared norm.
#[inline]
fn terms<T: Real>(size: T, (very_near, near): (u32, u32)) -> u32 {
    if size.all_below(VERY_NEAR) { very_near } else { near }
}

/// `linear` z + `constant` I in a plane, where z² = tr z z − det z I, and in its normal direction.
#[derive(Clone, Copy)]
struct Planar<T> {
    linear: T,
    constant: T,
    normal: T,
}

/// The same of a power of z in a plane.
struct PlanarPowers<T> {
    trace: T,
    determinant: T,
    normal: T,
    now: Planar<T>,
}

impl<T: Real> Planar<T> {
    #[inline]
    fn add(&mut self, factor: f64, other: Self) {
        let factor = T::splat(factor);
        self.linear = factor.mul_add(other.linear, self.linear);
        self.constant = factor.mul_add(other.constant, self.constant);
        self.normal = factor.mul_add(other.normal, self.normal);
    }
}

impl<T: Real> PlanarPowers<T> {
    /// At the first power of `z`.
    #[inline]
    fn new(z: &SymmetricTensor<T>) -> Self {
        Self {
            trace: z.xx + z.yy,
            determinant: z.xx * z.yy - z.xy * z.xy,
            normal: z.zz,
            now: Planar { linear: T::splat(1.0), constant: T::default(), normal: z.zz },
        }
    }

    #[inline]
    fn advance(&mut self) {
        let Planar { linear, constant, normal } = self.now;
        self.now = Planar {
            linear: self.trace.mul_add(linear, constant),
            constant: -self.determinant * linear,
            normal: self.normal * normal,
        };
    }
}

impl<T: Real> SymmetricTensor<T> {
    /// Whether the third axis is a principal one, as in plane strain: everything is then cheaper.
    #[inline]
    pub(super) fn is_planar(&self) -> bool {
        self.xz == T::default() && self.yz == T::default()
    }

    /// `factor` (`linear` z + `constant` I) of this planar z.
    #[inline]
    fn combine_planar(&self, factor: f64, by: Planar<T>) -> Self {
        let factor = T::splat(factor);
        let (linear, constant) = (factor * by.linear, factor * by.constant);
        Self {
            xx: linear.mul_add(self.xx, constant),
            yy: linear.mul_add(self.yy, constant),
            zz: factor * by.normal,
            xy: linear * self.xy,
            ..Self::default()
        }
    }

    /// (b − I)(b + I)⁻¹ of this planar b.
    #[inline]
    fn cayley_planar(&self) -> Self {
        let one = T::splat(1.0);
        let (xx, yy, xy) = (self.xx + one, self.yy + one, self.xy);
        // I − 2 (b + I)⁻¹ would lose the digits of small strains.
        let (ex, ey) = (self.xx - one, self.yy - one);
        let inverse = one / (xx * yy - xy * xy);
        Self {
            xx: inverse * (ex * yy - xy * xy),
            yy: inverse * (ey * xx - xy * xy),
            zz: (self.zz - one) / (self.zz + one),
            xy: inverse * (xy + xy),
            ..Self::default()
        }
    }

    /// The square of the norm of this planar tensor.
    #[inline]
    fn planar_size(&self) -> T {
        self.xx * self.xx + self.yy * self.yy + self.zz * self.zz + T::splat(2.0) * self.xy * self.xy
    }

    /// The natural logarithm of a positive definite tensor, such as twice Hencky's strain of a left
    /// Cauchy–Green tensor: 2 (z + z³/3 + z⁵/5 + …) with z = (b − I)(b + I)⁻¹.
    #[must_use]
    #[inline]
    pub fn ln(&self) -> Self {
        if self.is_planar() {
            let z = self.cayley_planar();
            let size = z.planar_size();
            if size.all_below(NEAR) {
                let mut powers = PlanarPowers::new(&z);
                let mut sum = powers.now;
                for k in 1..terms(size, LOGARITHM_TERMS) {
                    powers.advance();
                    powers.advance();
                    sum.add(1.0 / f64::from(2 * k + 1), powers.now);
                }
                return z.combine_planar(2.0, sum);
            }
        }
        let mut excess = self.scale_add_identity(T::splat(1.0), T::splat(-1.0));
        let mut halvings = 0;
        loop {
            let z = excess.times_commuting(&excess.scale_add_identity(T::splat(1.0), T::splat(2.0)).inverse());
            let square = z.times_commuting(&z);
            let size = square.trace();
            // Not below for a tensor that is not finite; those beside it keep their digits.
            if size.all_below(NEAR) || halvings == MOST_HALVINGS {
                let mut powers = Powers::new(&z, &square);
                let mut sum = powers.now;
                for k in 1..terms(size, LOGARITHM_TERMS) {
                    powers.advance();
                    powers.advance();
                    sum.add(1.0 / f64::from(2 * k + 1), powers.now);
                }
                return z.combine(&square, 2.0 * f64::from(1 << halvings), sum);
            }
            excess = excess.excess_of_root();
            halvings += 1;
        }
    }

    /// √c − I of c = `self` + I, positive definite: (c − I)(√c + I)⁻¹, which keeps the digits of small strains.
    ///
    /// The invariants i, ii, iii of the root are of those of c: iii² = III, 2 ii = i² − I, and i is the largest zero of
    /// (i² − I)² − 4 II − 8 i iii, found by Newton's method from above. By Cayley and Hamilton
    /// √c (c + ii I) = i c + iii I (Hoger & Carlson 1984, doi:10.1090/qam/736511).
    fn excess_of_root(&self) -> Self {
        let number = T::splat;
        let c = self.scale_add_identity(number(1.0), number(1.0));
        let first = c.trace();
        let second = number(0.5) * (first * first - c.times_commuting(&c).trace());
        let iii = c.determinant().sqrt();
        let mut i = (number(3.0) * first).sqrt();
        for _ in 0..MOST_STEPS {
            let twice = i * i - first;
            let value = twice * twice - number(4.0) * second - number(8.0) * i * iii;
            let step = value / (number(4.0) * i * twice - number(8.0) * iii);
            i -= step;
            if !(step.abs() - number(ACCURACY) * i).any_positive() {
                break;
            }
        }
        let ii = number(0.5) * (i * i - first);
        let divisor = c.scale_add_identity(number(1.0) + i, ii + iii);
        self.times_commuting(&c.scale_add_identity(number(1.0), ii)).times_commuting(&divisor.inverse())
    }

    /// The exponential I + a + a²/2 + a³/6 + ….
    #[must_use]
    #[inline]
    pub fn exp(&self) -> Self {
        if self.is_planar() {
            let size = self.planar_size();
            if size.all_below(NEAR) {
                let mut powers = PlanarPowers::new(self);
                let mut sum = powers.now;
                sum.constant += T::splat(1.0);
                sum.normal += T::splat(1.0);
                let mut factor = 1.0;
                for k in 2..=terms(size, EXPONENTIAL_TERMS) {
                    powers.advance();
                    factor /= f64::from(k);
                    sum.add(factor, powers.now);
                }
                return self.combine_planar(1.0, sum);
            }
        }
        let square = self.times_commuting(self);
        let size = square.trace();
        if size.all_below(NEAR) {
            self.exponential_series(&square, terms(size, EXPONENTIAL_TERMS), 1.0)
        } else {
            self.far_exp()
        }
    }

    /// `first` I + a + a²/2 + … of this tensor a near zero.
    #[inline]
    fn exponential_series(&self, square: &Self, terms: u32, first: f64) -> Self {
        let mut powers = Powers::new(self, square);
        let mut sum = powers.now;
        sum.constant += T::splat(first);
        let mut factor = 1.0;
        for k in 2..=terms {
            powers.advance();
            factor /= f64::from(k);
            sum.add(factor, powers.now);
        }
        self.combine(square, 1.0, sum)
    }

    /// The exponential of this tensor a by scaling and squaring, (e^(a/2ⁿ))^(2ⁿ). It squares e^(a/2ⁿ) − I, whose
    /// relative error does not double.
    fn far_exp(&self) -> Self {
        let mut part = *self;
        let mut square = part.times_commuting(&part);
        let mut halvings = 0;
        while halvings < MOST_HALVINGS && !square.trace().all_below(NEAR) {
            part = part.scale_add_identity(T::splat(0.5), T::default());
            square = square.scale_add_identity(T::splat(0.25), T::default());
            halvings += 1;
        }
        let mut excess = part.exponential_series(&square, EXPONENTIAL_TERMS.1, 0.0);
        for _ in 0..halvings {
            let squared = excess.times_commuting(&excess);
            excess = squared.add(&excess).add(&excess);
        }
        excess.scale_add_identity(T::splat(1.0), T::splat(1.0))
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
        cofactors.scale_add_identity(T::splat(1.0) / determinant, T::default())
    }

    /// `factor` (A z² + B z + C I) with the square of this tensor z.
    #[inline]
    fn combine(&self, square: &Self, factor: f64, by: Quadratic<T>) -> Self {
        let factor = T::splat(factor);
        let (a, b) = (factor * by.square, factor * by.linear);
        let sum = Self {
            xx: a * square.xx + b * self.xx,
            yy: a * square.yy + b * self.yy,
            zz: a * square.zz + b * self.zz,
            xy: a * square.xy + b * self.xy,
            yz: a * square.yz + b * self.yz,
            xz: a * square.xz + b * self.xz,
        };
        sum.scale_add_identity(T::splat(1.0), factor * by.constant)
    }

    /// The sum.
    #[must_use]
    #[inline]
    pub(crate) fn add(&self, other: &Self) -> Self {
        Self {
            xx: self.xx + other.xx,
            yy: self.yy + other.yy,
            zz: self.zz + other.zz,
            xy: self.xy + other.xy,
            yz: self.yz + other.yz,
            xz: self.xz + other.xz,
        }
    }
}
