//! B-splines of any degree, as piecewise polynomials on the cells.
//!
//! Steffen, Kirby & Berzins (2008). Where an axis ends in a wall there are two treatments
//! ([`WallTreatment`]). In every knot interval the `S` non-zero functions are polynomials of degree
//! `S − 1` in the local coordinate; their coefficients are made once, by the Cox–de Boor recursion,
//! for each distinct knot pattern.

use super::{AxisNodes, AxisWeights, Basis, EightAxisWeights};
use crate::grid::Axis;
use crate::number::{Eight, Real, indices};

/// How B-splines meet a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WallTreatment {
    /// The wall's knot is repeated, so that the first function interpolates there.
    #[default]
    OpenKnot,
    /// Uniform splines with a node on the wall line; nodes at or beyond it are constrained.
    WallLine,
}

/// Splines of degree `S − 1`.
#[derive(Debug, Clone, PartialEq)]
pub struct BSpline<const S: usize> {
    h: f64,
    inverse_h: f64,
    /// Coordinate of the first knot interval (m).
    origin: f64,
    /// Knot pattern of each knot interval, an index into `polynomials`.
    pattern: Vec<usize>,
    /// The last interval, a whole number.
    last: f64,
    /// Coordinates before the first and after the last equally spaced knot interval; infinite without such an interval.
    uniform: (f64, f64),
    /// Per pattern: coefficient of the k-th power of the local coordinate for each function.
    polynomials: Vec<[[f64; S]; S]>,
    /// Knots in units of h from `origin`.
    knots: Vec<f64>,
    /// Cells of a periodic axis.
    period: Option<usize>,
}

/// Linear hat functions, the basis of the original MPM. They interpolate everywhere, so that walls treat them alike.
pub type Linear = BSpline<2>;
/// Quadratic B-splines, the paper's second basis.
pub type QuadraticBSpline = BSpline<3>;
/// Cubic B-splines.
pub type CubicBSpline = BSpline<4>;

/// Steepness of cubic splines: 3.13682 at ξ = 0.276, rounded up.
const CUBIC: f64 = 3.137;

impl<const S: usize> Basis<S> for BSpline<S> {
    fn new(axis: &Axis, h: f64, wall: WallTreatment) -> Self {
        let degree = S - 1;
        let (clamp_lo, clamp_hi) = match wall {
            WallTreatment::OpenKnot => axis.wall_ends(),
            WallTreatment::WallLine => (false, false),
        };
        // Splines of even degree have their nodes between knots: for a node on the wall line the
        // knots move by half a cell, and one more interval is needed.
        let half_shift = wall == WallTreatment::WallLine && degree.is_multiple_of(2) && !axis.is_periodic();
        let (origin, intervals) = if half_shift { (axis.lo - 0.5 * h, axis.cells + 1) } else { (axis.lo, axis.cells) };
        let lowest = if clamp_lo { 0.0 } else { f64::NEG_INFINITY };
        let highest = if clamp_hi { intervals as f64 } else { f64::INFINITY };
        let knots: Vec<f64> =
            (0..=intervals + 2 * degree).map(|k| (k as f64 - degree as f64).clamp(lowest, highest)).collect();
        let mut polynomials = Vec::new();
        let pattern: Vec<usize> = (0..intervals)
            .map(|cell| {
                let p = interval_polynomials::<S>(&knots[cell..=cell + 2 * degree + 1], cell);
                polynomials.iter().position(|q| *q == p).unwrap_or_else(|| {
                    polynomials.push(p);
                    polynomials.len() - 1
                })
            })
            .collect();
        // Only the knots within reach of a function's interval matter.
        let equally_spaced = |cell: &usize| {
            let knots = &knots[cell + 1..=cell + 2 * degree];
            knots.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
        };
        let first = (0..intervals).find(equally_spaced);
        let last = (0..intervals).rev().find(equally_spaced);
        let uniform = match (first, last) {
            (Some(first), Some(last)) => (first as f64 - 1.0, last as f64 + 1.0),
            _ => (f64::INFINITY, f64::INFINITY),
        };
        Self {
            h,
            inverse_h: 1.0 / h,
            origin,
            uniform,
            last: (intervals - 1) as f64,
            pattern,
            polynomials,
            knots,
            period: axis.is_periodic().then_some(axis.cells),
        }
    }

    /// At a knot two quadratic splines are ½ with the slope 1, and w′²/w of the third, which begins there, is 2. A hat
    /// vanishes with a slope: hats have no bound. Degrees above three are not needed.
    fn steepness(_half_size: f64) -> Option<f64> {
        match S {
            3 => Some(6.0),
            4 => Some(CUBIC),
            _ => None,
        }
    }

    fn nodes(&self) -> AxisNodes {
        let degree = S - 1;
        let count = self.pattern.len() + degree;
        let greville = |i: usize| -> f64 {
            match degree {
                0 => self.knots[i] + 0.5,
                _ => self.knots[i + 1..=i + degree].iter().sum::<f64>() / degree as f64,
            }
        };
        AxisNodes {
            position: (0..count).map(|i| self.origin + self.h * greville(i)).collect(),
            original: self.period.map(|cells| (0..count).map(|i| i % cells).collect()),
        }
    }

    #[inline(always)]
    fn weights(&self, x: f64, _half_size: f64) -> AxisWeights<S> {
        let (interval, t) = self.place(x);
        let first = interval as usize;
        let (w, slope) = if self.between_walls(interval) > 0.0 {
            uniform_functions(t)
        } else {
            let c = &self.polynomials[self.pattern[first]];
            functions(t, |k, s| c[k][s])
        };
        AxisWeights { first, w, dw: self.per_metre(slope) }
    }

    #[inline(always)]
    fn weights_of_eight(&self, x: Eight, _half_size: f64) -> EightAxisWeights<S> {
        let (first, t) = self.place(x);
        let (mut w, mut slope) = uniform_functions(t);
        let (before, after) = self.uniform;
        if !first.all_between(before, after) {
            let inside = self.between_walls(first);
            let c = indices(first).map(|first| &self.polynomials[self.pattern[first as usize]]);
            let (near_w, near_slope): ([_; S], [_; S]) = functions(t, |k, s| Eight::pack(|p| c[p][k][s]));
            for s in 0..S {
                w[s] = inside.if_positive(w[s], near_w[s]);
                slope[s] = inside.if_positive(slope[s], near_slope[s]);
            }
        }
        EightAxisWeights { first, w, dw: self.per_metre(slope) }
    }
}

impl<const S: usize> BSpline<S> {
    /// The knot interval of a place, and the local coordinate in it: of one particle, or of eight.
    #[inline(always)]
    fn place<T: Real>(&self, x: T) -> (T, T) {
        let distance = (x - T::splat(self.origin)) * T::splat(self.inverse_h);
        let first = distance.floor().clamped(0.0, self.last);
        (first, distance - first)
    }

    /// Positive where all knots that the functions of `interval` have are equally spaced.
    #[inline(always)]
    fn between_walls<T: Real>(&self, interval: T) -> T {
        let (before, after) = self.uniform;
        (interval - T::splat(before)) * (T::splat(after) - interval)
    }

    /// Derivatives (1/m), from those in the local coordinate.
    #[inline(always)]
    fn per_metre<T: Real>(&self, mut slope: [T; S]) -> [T; S] {
        for d in &mut slope {
            *d *= T::splat(self.inverse_h);
        }
        slope
    }
}

/// Values and derivatives at the local coordinate `t` between equally spaced knots, by the recursion of Cox and de
/// Boor; a derivative is the difference of two functions of the degree below.
#[inline(always)]
fn uniform_functions<T: Real, const S: usize>(t: T) -> ([T; S], [T; S]) {
    let number = |n: usize| T::splat(n as f64);
    if S == 1 {
        return ([number(1); S], [number(0); S]);
    }
    let left = number(1) - t;
    let (mut w, mut slope) = ([T::default(); S], [T::default(); S]);
    (w[0], w[1]) = (left, t);
    (slope[0], slope[1]) = (-number(1), number(1));
    for degree in 2..S {
        if degree == S - 1 {
            slope[0] = -w[0];
            for s in 1..degree {
                slope[s] = w[s - 1] - w[s];
            }
            slope[degree] = w[degree - 1];
        }
        let inverse = T::splat(1.0 / degree as f64);
        w[degree] = inverse * t * w[degree - 1];
        for s in (2..degree).rev() {
            let rising = (t + number(degree - s)) * w[s - 1];
            w[s] = inverse * (number(s + 1) - t).mul_add(w[s], rising);
        }
        w[0] *= inverse * left;
        // All together are one.
        w[1] = number(1) - w[0];
        for s in 2..=degree {
            w[1] -= w[s];
        }
    }
    (w, slope)
}

/// Values and derivatives at the local coordinate `t`, from the coefficients `c(power, function)`.
#[inline(always)]
fn functions<T: Real, const S: usize>(t: T, c: impl Fn(usize, usize) -> T) -> ([T; S], [T; S]) {
    let mut w = std::array::from_fn(|s| c(S - 1, s));
    let mut slope = [T::default(); S];
    for k in (0..S - 1).rev() {
        for s in 0..S {
            slope[s] = slope[s] * t + w[s];
            w[s] = w[s] * t + c(k, s);
        }
    }
    (w, slope)
}

/// Polynomials of the functions that are non-zero on `[cell, cell + 1]`, in the coordinate from
/// `cell`: Cox–de Boor on the `2 S` knots around the interval (a repeated knot's 0/0 counts as 0).
fn interval_polynomials<const S: usize>(knots: &[f64], cell: usize) -> [[f64; S]; S] {
    let degree = S - 1;
    let t: Vec<f64> = knots.iter().map(|k| k - cell as f64).collect();
    // b[i][k]: coefficient k of the function that starts at knot i; degree zero first.
    let mut b = vec![[0.0; S]; 2 * degree + 1];
    b[degree][0] = 1.0;
    for p in 1..=degree {
        for i in 0..b.len() - p {
            let mut next = [0.0; S];
            let rising = t[i + p] - t[i];
            let falling = t[i + p + 1] - t[i + 1];
            for k in 0..p {
                if rising > 0.0 {
                    next[k] -= b[i][k] * t[i] / rising;
                    next[k + 1] += b[i][k] / rising;
                }
                if falling > 0.0 {
                    next[k] += b[i + 1][k] * t[i + p + 1] / falling;
                    next[k + 1] -= b[i + 1][k] / falling;
                }
            }
            b[i] = next;
        }
    }
    let mut coefficients = [[0.0; S]; S];
    for (k, row) in coefficients.iter_mut().enumerate() {
        for (s, c) in row.iter_mut().enumerate() {
            *c = b[s][k];
        }
    }
    coefficients
}
