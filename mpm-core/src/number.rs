//! Numbers: one, eight side by side, or one with its derivatives.
//!
//! A formula that is written for any [`Real`] serves one particle and, in one go, eight of them, and of a [`Dual`]
//! number it gives the derivatives as well. It must not branch on a value, but may do less where *all* of its numbers
//! allow it. Code that takes numbers apart loses derivatives: it asks for [`Lanes`], which a dual number lacks.

mod dual;

pub use dual::Dual;

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};
use wide::f64x8;

/// Eight numbers.
pub type Eight = f64x8;
/// How many.
pub const EIGHT: usize = 8;

/// Whether this build multiplies and adds in one instruction. Without it a step takes 2.2 to 2.6 times as long, and
/// each product is rounded before it is added, which changes last digits; with it, they are the same for any processor.
/// A package that uses this one gets it by `RUSTFLAGS="-C target-cpu=native"`, or `x86-64-v3` for any processor with
/// AVX2.
pub const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// Eight numbers in memory, each of which a loop over the eight reads as a broadcast.
pub type Octet = [f64; EIGHT];

/// Whole numbers as indices. They are below 2³², so that sums of a few do not overflow, which the compiler then knows.
#[inline(always)]
pub fn indices(of: Eight) -> [u32; EIGHT] {
    of.fast_trunc_int().to_array().map(|index| index as u32)
}

/// One number or several, with or without derivatives.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + MulAssign
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// `x` in every lane, a constant.
    fn splat(x: f64) -> Self;

    /// `of(k)` in lane `k`, constants.
    fn pack(of: impl FnMut(usize) -> f64) -> Self;

    /// `self` `a` + `b`, rounded once where the processor can.
    #[must_use]
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Exponential.
    #[must_use]
    fn exp(self) -> Self;

    /// Natural logarithm.
    #[must_use]
    fn ln(self) -> Self;

    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// The greatest integer that is not above.
    #[must_use]
    fn floor(self) -> Self;

    /// The greater one; `limit` for what is not a number.
    #[must_use]
    fn at_least(self, limit: f64) -> Self;

    /// The smaller one; `limit` for what is not a number.
    #[must_use]
    fn at_most(self, limit: f64) -> Self;

    /// This number, at least `low` and at most `high`; of what is not a number any number or none.
    #[must_use]
    fn clamped(self, low: f64, high: f64) -> Self;

    /// Whether all are below `limit`; what is not a number is not.
    fn all_below(self, limit: f64) -> bool;

    /// Whether all are above `low` and below `high`.
    fn all_between(self, low: f64, high: f64) -> bool;

    /// Whether one is above zero.
    fn any_positive(self) -> bool;

    /// `then` where this number is above zero, `otherwise` elsewhere.
    #[must_use]
    fn if_positive(self, then: Self, otherwise: Self) -> Self;

    /// This number, to whose derivatives those of `correction` are added: one more step of an iteration whose value
    /// has converged, while its derivatives lag by one.
    #[must_use]
    #[inline(always)]
    fn with_slopes_of(self, _correction: Self) -> Self {
        self
    }
}

/// Numbers that can be taken apart.
pub trait Lanes: Real {
    /// The number in lane `k`.
    fn part(&self, k: usize) -> f64;
}

/// Functions of a number that its type has under the same name.
macro_rules! of_the_type {
    ($number:ty: $($name:ident($($other:ident),*)),*) => {$(
        #[inline(always)]
        fn $name(self, $($other: Self),*) -> Self {
            <$number>::$name(self, $($other),*)
        }
    )*};
}

impl Real for f64 {
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn pack(mut of: impl FnMut(usize) -> f64) -> Self {
        of(0)
    }

    of_the_type!(f64: mul_add(a, b), sqrt(), exp(), ln(), abs(), floor());

    #[inline(always)]
    fn at_least(self, limit: f64) -> Self {
        self.max(limit)
    }

    #[inline(always)]
    fn at_most(self, limit: f64) -> Self {
        self.min(limit)
    }

    #[inline(always)]
    fn clamped(self, low: f64, high: f64) -> Self {
        self.max(low).min(high)
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        self < limit
    }

    #[inline(always)]
    fn all_between(self, low: f64, high: f64) -> bool {
        self > low && self < high
    }

    #[inline(always)]
    fn any_positive(self) -> bool {
        self > 0.0
    }

    #[inline(always)]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        if self > 0.0 { then } else { otherwise }
    }
}

impl Lanes for f64 {
    #[inline(always)]
    fn part(&self, _k: usize) -> f64 {
        *self
    }
}

impl Real for Eight {
    #[inline(always)]
    fn splat(x: f64) -> Self {
        f64x8::splat(x)
    }

    #[inline(always)]
    fn pack(of: impl FnMut(usize) -> f64) -> Self {
        f64x8::new(std::array::from_fn(of))
    }

    of_the_type!(f64x8: mul_add(a, b), sqrt(), exp(), ln(), abs(), floor());

    #[inline(always)]
    fn at_least(self, limit: f64) -> Self {
        self.max(f64x8::splat(limit))
    }

    #[inline(always)]
    fn at_most(self, limit: f64) -> Self {
        self.min(f64x8::splat(limit))
    }

    #[inline(always)]
    fn clamped(self, low: f64, high: f64) -> Self {
        self.fast_max(f64x8::splat(low)).fast_min(f64x8::splat(high))
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        self.simd_lt(f64x8::splat(limit)).all()
    }

    #[inline(always)]
    fn all_between(self, low: f64, high: f64) -> bool {
        (self.simd_gt(f64x8::splat(low)) & self.simd_lt(f64x8::splat(high))).all()
    }

    #[inline(always)]
    fn any_positive(self) -> bool {
        self.simd_gt(f64x8::ZERO).any()
    }

    #[inline(always)]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        self.simd_gt(f64x8::ZERO).select(then, otherwise)
    }
}

impl Lanes for Eight {
    #[inline(always)]
    fn part(&self, k: usize) -> f64 {
        self.as_array()[k]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Units in the last place by which the logarithm of eight may differ from the library's: the polynomial's
    /// quotient, its product with a power and two sums are rounded, and so is the other.
    const UNITS: f64 = 4.0;

    /// One number among seven that are within, or by itself.
    fn all_are_between(x: f64) -> [bool; 2] {
        let eight = Eight::pack(|l| if l == 5 { x } else { 1.5 });
        let found = [eight.all_between(1.0, 2.0), x.all_between(1.0, 2.0)];
        assert_eq!(eight.all_below(2.0), x.all_below(2.0));
        found
    }

    #[test]
    fn ends_are_not_between() {
        for (x, between) in [(0.5, false), (1.0, false), (1.25, true), (2.0, false)] {
            assert_eq!(all_are_between(x), [between; 2], "{x}");
        }
        assert_eq!(all_are_between(f64::NAN), [false; 2]);
    }

    proptest! {
        #[test]
        fn the_logarithm_of_eight_is_that_of_each(
            x in prop::array::uniform8(prop_oneof![
                0.99..1.01_f64,
                0.1..10.0_f64,
                (-700.0..700.0_f64).prop_map(f64::exp),
            ])
        ) {
            let together = f64x8::new(x).ln().to_array();
            for (x, together) in x.into_iter().zip(together) {
                let alone = x.ln();
                let unit = alone.abs().next_up() - alone.abs();
                prop_assert!((together - alone).abs() <= UNITS * unit, "ln {x}: {together}, {alone}");
            }
        }
    }

    #[test]
    fn the_logarithm_of_what_has_none_is_no_number() {
        let of = f64x8::new([0.0, -1.0, f64::NAN, f64::INFINITY, 1.0, 2.0, 3.0, 4.0]).ln();
        let [of_zero, of_negative, of_nothing, of_infinity, of_one, ..] = of.to_array();
        assert_eq!(of_zero, f64::NEG_INFINITY);
        assert!(of_negative.is_nan() && of_nothing.is_nan());
        assert_eq!((of_infinity, of_one), (f64::INFINITY, 0.0));
    }
}
