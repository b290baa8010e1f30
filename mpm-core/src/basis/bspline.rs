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
    /// Before the first and after the last of the intervals that have the pattern of the middle one.
    uniform: (f64, f64),
    /// Per pattern: coefficient of the k-th power of the local coordinate for each function.
    polynomials: Vec<[[f64; S]; S]>,
    /// Knots in units of h from `origin`.
    knots: Vec<f64>,
    /// Cells of a periodic axis.
    period: Option<usize>,
}

/// Quadratic B-splines, the paper's second basis.
pub type QuadraticBSpline = BSpline<3>;
/// Cubic B-splines.
pub type CubicBSpline = BSpline<4>;

impl<const S: usize> Basis<S> for BSpline<S> {
    fn new(axis: &Axis, h: f64, wall: WallTreatment) -> Self {
        let degree = S - 1;
        let (clamp_lo, clamp_hi) = match wall {
            WallTreatment::OpenKnot => axis.wall_ends(),
            WallTreatment::WallLine => (false, false),
        };
        // Splines of even degree have their nodes between knots: for a node on the wall line the
        // knots move by half a cell, and one more interval is needed.
        let half_shift =
            wall == WallTreatment::WallLine && degree.is_multiple_of(2) && !axis.is_periodic();
        let (origin, intervals) = if half_shift {
            (axis.lo - 0.5 * h, axis.cells + 1)
        } else {
            (axis.lo, axis.cells)
        };
        let lowest = if clamp_lo { 0.0 } else { f64::NEG_INFINITY };
        let highest = if clamp_hi {
            intervals as f64
        } else {
            f64::INFINITY
        };
        let knots: Vec<f64> = (0..=intervals + 2 * degree)
            .map(|k| (k as f64 - degree as f64).clamp(lowest, highest))
            .collect();
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
        let middle = pattern[intervals / 2];
        let of_middle = |interval: &usize| pattern[*interval] == middle;
        let last_before = (0..intervals / 2).rev().find(|i| !of_middle(i));
        let first_after = (intervals / 2..intervals).find(|i| !of_middle(i));
        let uniform = (
            last_before.map_or(-1.0, |i| i as f64),
            first_after.unwrap_or(intervals) as f64,
        );
        Self {
            h,
            inverse_h: 1.0 / h,
            origin,
            uniform,
            pattern,
            polynomials,
            knots,
            period: axis.is_periodic().then_some(axis.cells),
        }
    }

    fn nodes(&self) -> AxisNodes {
        let degree = S - 1;
        let count = self.pattern.len() + degree;
        let greville = |i: usize| -> f64 {
            self.knots[i + 1..=i + degree].iter().sum::<f64>() / degree as f64
        };
        AxisNodes {
            position: (0..count)
                .map(|i| self.origin + self.h * greville(i))
                .collect(),
            original: self
                .period
                .map(|cells| (0..count).map(|i| i % cells).collect()),
        }
    }

    #[inline(always)]
    fn weights(&self, x: f64, _half_size: f64) -> AxisWeights<S> {
        let (first, t) = self.place(x);
        let c = &self.polynomials[self.pattern[first as usize]];
        let (w, dw) = self.functions(t, |k, s| c[k][s]);
        AxisWeights {
            first: first as usize,
            w,
            dw,
        }
    }

    #[inline(always)]
    fn weights_of_eight(&self, x: Eight, _half_size: Eight) -> EightAxisWeights<S> {
        let (interval, t) = self.place(x);
        let first = indices(interval);
        let (before, after) = self.uniform;
        // Away from walls all have one pattern.
        let (w, dw) = if interval.all_below(after) && (-interval).all_below(-before) {
            let c = &self.polynomials[self.pattern[first[0]]];
            self.functions(t, |k, s| Eight::splat(c[k][s]))
        } else {
            let c = first.map(|first| &self.polynomials[self.pattern[first]]);
            self.functions(t, |k, s| Eight::pack(|p| c[p][k][s]))
        };
        EightAxisWeights { first, w, dw }
    }
}

impl<const S: usize> BSpline<S> {
    /// The knot interval of a place, and the local coordinate in it: of one particle, or of eight.
    #[inline(always)]
    fn place<T: Real>(&self, x: T) -> (T, T) {
        let distance = (x - T::splat(self.origin)) * T::splat(self.inverse_h);
        let last = (self.pattern.len() - 1) as f64;
        let first = distance.floor().at_least(0.0).at_most(last);
        (first, distance - first)
    }

    /// Values and derivatives at the local coordinate `t`, from the coefficients `c(power, function)`.
    #[inline(always)]
    fn functions<T: Real>(&self, t: T, c: impl Fn(usize, usize) -> T) -> ([T; S], [T; S]) {
        let mut w = std::array::from_fn(|s| c(S - 1, s));
        let mut dw = [T::default(); S];
        for k in (0..S - 1).rev() {
            for s in 0..S {
                dw[s] = dw[s] * t + w[s];
                w[s] = w[s] * t + c(k, s);
            }
        }
        for d in &mut dw {
            *d *= T::splat(self.inverse_h);
        }
        (w, dw)
    }
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
