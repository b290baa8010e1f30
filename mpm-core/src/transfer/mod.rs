//! Particle–grid transfers.

pub mod flip;

use std::ops::AddAssign;

/// A nodal vector, padded to four components; the last one is free for a scalar (the mass).
pub type Node = [f64; 4];

/// What the nodes hold during a step: one cache line each.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(64))]
pub struct NodalState {
    /// After P2G: m v and m. After the grid update: vⁿ⁺¹ and m.
    pub motion: Node,
    /// After P2G: the force f. After the grid update: vⁿ⁺¹ − vⁿ.
    pub change: Node,
}

impl AddAssign for NodalState {
    fn add_assign(&mut self, other: Self) {
        axpy(&mut self.motion, 1.0, &other.motion);
        axpy(&mut self.change, 1.0, &other.change);
    }
}

impl NodalState {
    /// Mass of the node (kg).
    #[must_use]
    #[inline(always)]
    pub fn mass(&self) -> f64 {
        self.motion[3]
    }
}

/// `y += a x`, component-wise.
#[inline(always)]
pub(crate) fn axpy(y: &mut Node, a: f64, x: &Node) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}

/// `v` padded to a node, with `last` as the scalar.
#[inline(always)]
pub(crate) fn pad<const D: usize>(v: &[f64; D], last: f64) -> Node {
    let mut node = [0.0, 0.0, 0.0, last];
    node[..D].copy_from_slice(v);
    node
}
