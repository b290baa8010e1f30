//! A number and its derivatives.

use super::Real;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number and its derivatives by `N` variables. Its value has the bits that the formula gives for one number.
///
/// Branches decide on values. Equality asks for equal slopes too, so that what is zero has no slope either.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize> {
    /// The number.
    pub value: f64,
    /// Its derivatives.
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The `k`-th variable, at `value`.
    #[must_use]
    pub fn variable(value: f64, k: usize) -> Self {
        let slope = std::array::from_fn(|j| f64::from(u8::from(j == k)));
        Self { value, slope }
    }

    /// `value`, a function of this number with the given derivative.
    #[inline]
    fn map(self, value: f64, derivative: f64) -> Self {
        let slope = self.slope.map(|slope| derivative * slope);
        Self { value, slope }
    }

    /// `value`, a function of this number and `other` with the given derivatives by both.
    #[inline]
    fn join(self, other: Self, value: f64, [by_this, by_other]: [f64; 2]) -> Self {
        let slope = |k: usize| by_this * self.slope[k] + by_other * other.slope[k];
        Self { value, slope: std::array::from_fn(slope) }
    }
}

impl<const N: usize> Default for Dual<N> {
    fn default() -> Self {
        Self::splat(0.0)
    }
}

/// Operators: what they make of the values a and b, and its derivatives by both.
macro_rules! operators {
    ($($operation:ident, $name:ident, ($a:ident, $b:ident): $value:expr, $derivatives:expr;)*) => {$(
        impl<const N: usize> $operation for Dual<N> {
            type Output = Self;

            #[inline]
            fn $name(self, other: Self) -> Self {
                let ($a, $b) = (self.value, other.value);
                self.join(other, $value, $derivatives)
            }
        }
    )*};
}

operators! {
    Add, add, (a, b): a + b, [1.0, 1.0];
    Sub, sub, (a, b): a - b, [1.0, -1.0];
    Mul, mul, (a, b): a * b, [b, a];
    Div, div, (a, b): a / b, [1.0 / b, -(a / b) * (1.0 / b)];
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.map(-self.value, -1.0)
    }
}

macro_rules! assign {
    ($($operation:ident, $name:ident, $operator:tt;)*) => {$(
        impl<const N: usize> $operation for Dual<N> {
            #[inline]
            fn $name(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assign! {
    AddAssign, add_assign, +;
    SubAssign, sub_assign, -;
    MulAssign, mul_assign, *;
}

impl<const N: usize> Real for Dual<N> {
    #[inline]
    fn splat(value: f64) -> Self {
        let slope = [0.0; N];
        Self { value, slope }
    }

    #[inline]
    fn pack(mut of: impl FnMut(usize) -> f64) -> Self {
        Self::splat(of(0))
    }

    #[inline]
    fn mul_add(self, a: Self, b: Self) -> Self {
        let value = self.value.mul_add(a.value, b.value);
        Self { value, ..self * a + b }
    }

    /// At zero, where a norm has no derivative, the slope is zero.
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.map(root, if root == 0.0 { 0.0 } else { 0.5 / root })
    }

    #[inline]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.map(value, value)
    }

    #[inline]
    fn ln(self) -> Self {
        self.map(self.value.ln(), 1.0 / self.value)
    }

    #[inline]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }

    #[inline]
    fn floor(self) -> Self {
        Self::splat(self.value.floor())
    }

    #[inline]
    fn at_least(self, limit: f64) -> Self {
        if self.value > limit { self } else { Self::splat(limit) }
    }

    #[inline]
    fn at_most(self, limit: f64) -> Self {
        if self.value < limit { self } else { Self::splat(limit) }
    }

    #[inline]
    fn clamped(self, low: f64, high: f64) -> Self {
        self.at_least(low).at_most(high)
    }

    #[inline]
    fn all_below(self, limit: f64) -> bool {
        self.value < limit
    }

    #[inline]
    fn all_between(self, low: f64, high: f64) -> bool {
        self.value > low && self.value < high
    }

    #[inline]
    fn any_positive(self) -> bool {
        self.value > 0.0
    }

    #[inline]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        if self.value > 0.0 { then } else { otherwise }
    }

    #[inline]
    fn with_slopes_of(self, correction: Self) -> Self {
        self.join(correction, self.value, [1.0, 1.0])
    }
}
