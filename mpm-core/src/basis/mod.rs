//! Basis functions: one-dimensional factors of a tensor product.
//!
//! A [`Basis`] lives on one axis; a grid in `D` dimensions has `D` of them and
//! w_ip = Π_a w(x_a), ∂w_ip/∂x_b = w′(x_b) Π_{a≠b} w(x_a). At most `S` functions per axis are
//! non-zero at a point.

mod bspline;
mod gimp;
mod linear;

pub use bspline::{BSpline, CubicBSpline, QuadraticBSpline, WallTreatment};
pub use gimp::Gimp;
pub use linear::Linear;

use crate::grid::Axis;

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
    pub const NONE: Self = Self {
        first: 0,
        w: [0.0; S],
        dw: [0.0; S],
    };
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
pub trait Basis<const S: usize>: Send + Sync + Sized {
    /// The functions on `axis` with cells of size `h` (m).
    fn new(axis: &Axis, h: f64, wall: WallTreatment) -> Self;

    /// Its nodes.
    fn nodes(&self) -> AxisNodes;

    /// Values and derivatives at `x` (m), which lies on the axis, for a particle that reaches
    /// `half_size` (m, at most half a cell) to either side.
    fn weights(&self, x: f64, half_size: f64) -> AxisWeights<S>;
}

#[cfg(test)]
mod tests;
