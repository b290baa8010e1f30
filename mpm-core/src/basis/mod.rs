//! Basis functions: one-dimensional factors of a tensor product.
//!
//! A [`Basis`] lives on one axis; a grid in `D` dimensions has `D` of them and
//! w_ip = Π_a w(x_a), ∂w_ip/∂x_b = w′(x_b) Π_{a≠b} w(x_a). At most `S` functions per axis are
//! non-zero at a point.

mod bspline;
mod gimp;

pub use bspline::{BSpline, CubicBSpline, Linear, QuadraticBSpline, WallTreatment};
pub use gimp::Gimp;

use crate::grid::Axis;
use crate::number::{EIGHT, Eight, Lanes, Real};

/// The non-zero functions of one axis at a point: `first`, `first + 1`, …, with their values and
/// derivatives (1/m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisWeights<const S: usize> {
    /// Index of the first function.
    pub first: usize,
    /// Values.
    pub w: [f64; S],
    /// Derivatives (1/m).
    pub dw: [f64; S],
}

impl<const S: usize> AxisWeights<S> {
    /// No weight anywhere.
    pub const NONE: Self = Self { first: 0, w: [0.0; S], dw: [0.0; S] };
}

/// The non-zero functions of one axis at eight points.
#[derive(Debug, Clone, Copy)]
pub struct EightAxisWeights<const S: usize> {
    /// Index of the first function at each point, a whole number.
    pub first: Eight,
    /// Values.
    pub w: [Eight; S],
    /// Derivatives (1/m).
    pub dw: [Eight; S],
}

impl<const S: usize> EightAxisWeights<S> {
    /// No weight anywhere.
    pub const NONE: Self = Self { first: Eight::ZERO, w: [Eight::ZERO; S], dw: [Eight::ZERO; S] };

    /// Those at the `k`-th point.
    #[inline(always)]
    pub fn part(&self, k: usize) -> AxisWeights<S> {
        let mut part = AxisWeights { first: self.first.part(k) as usize, ..AxisWeights::NONE };
        for s in 0..S {
            part.w[s] = self.w[s].part(k);
            part.dw[s] = self.dw[s].part(k);
        }
        part
    }
}

/// The nodes of a basis along one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisNodes {
    /// Greville abscissae (m): Σ_i w_i(x) `position[i]` = x.
    pub position: Vec<f64>,
    /// On a periodic axis, the node that each node is an image of (itself if it is the original).
    pub original: Option<Vec<usize>>,
}

/// A one-dimensional basis with at most `S` functions non-zero at a point.
pub trait Basis<const S: usize>: Send + Sync + Sized + 'static {
    /// The functions on `axis` with cells of size `h` (m).
    fn new(axis: &Axis, h: f64, wall: WallTreatment) -> Self;

    /// Its nodes.
    fn nodes(&self) -> AxisNodes;

    /// How far (m) a particle that reaches `half_size` (m) to either side may pass a wall: so far do functions inside
    /// see it and move it.
    fn beyond_wall(_half_size: f64) -> f64 {
        0.0
    }

    /// Greatest h² Σ w′²/w over the places of a particle away from walls, whose half size is `half_size` cells: the
    /// stiffness of a particle over its share of the masses of its nodes. None of functions that have no bound.
    fn steepness(_half_size: f64) -> Option<f64> {
        None
    }

    /// Values and derivatives at `x` (m), which lies on the axis or no further beyond a wall than it may, for a
    /// particle that reaches `half_size` (m, at most half a cell) to either side.
    fn weights(&self, x: f64, half_size: f64) -> AxisWeights<S>;

    /// Values and derivatives at a point `x` (m): of a particle without size.
    fn at_point(&self, x: f64) -> AxisWeights<S> {
        self.weights(x, 0.0)
    }

    /// The same for eight particles. A basis for which it pays computes them side by side.
    #[inline(always)]
    fn weights_of_eight(&self, x: Eight, half_size: f64) -> EightAxisWeights<S> {
        let each: [_; EIGHT] = std::array::from_fn(|k| self.weights(x.part(k), half_size));
        EightAxisWeights {
            first: Eight::pack(|k| each[k].first as f64),
            w: std::array::from_fn(|s| Eight::pack(|k| each[k].w[s])),
            dw: std::array::from_fn(|s| Eight::pack(|k| each[k].dw[s])),
        }
    }
}
