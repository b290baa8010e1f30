//! Nodal values during a step.

use std::ops::AddAssign;
use wide::f64x4;

/// A nodal vector, padded to four components; the last one is free for a scalar (the mass).
pub type Node = f64x4;

/// A vector of a node, from its components.
pub fn padded<const D: usize>(vector: &[f64; D]) -> Node {
    let mut padded = [0.0; 4];
    padded[..D].copy_from_slice(vector);
    Node::from(padded)
}

/// Values of a node during a step: one cache line.
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
        self.motion += other.motion;
        self.change += other.change;
    }
}

impl NodalState {
    /// Mass of the node (kg).
    #[inline(always)]
    pub fn mass(&self) -> f64 {
        self.motion.as_array()[3]
    }

    /// Kinetic energy of the node (J), once `motion` is a velocity.
    #[inline(always)]
    pub fn kinetic_energy(&self) -> f64 {
        let v = self.motion.as_array();
        0.5 * v[3] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    }
}
