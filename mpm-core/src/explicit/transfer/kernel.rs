//! Shared kernels of the transfers: forces and velocities between a particle and the nodes of its stencil.
//!
//! Particles come in eights. Results computed side by side are written to memory, where the loop over the eight reads
//! them: a run-time index keeps the arrays there.

use crate::lattice::{Stencil, StencilRef};
use crate::nodes::{NodalState, Node};
use crate::number::{EIGHT, Eight, Octet};
use crate::tensor::SymmetricTensor;

/// Data that eight particles give to the grid.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Given<const D: usize> {
    /// Momentum m v (kg m/s).
    momentum: [Octet; D],
    /// Mass m (kg).
    mass: Octet,
    /// −V σ (N m), column by column.
    flux: [[Octet; D]; D],
    /// External force (N), where there is one.
    external: Option<[Octet; D]>,
}

impl<const D: usize> Default for Given<D> {
    fn default() -> Self {
        Self { momentum: [[0.0; EIGHT]; D], mass: [0.0; EIGHT], flux: [[[0.0; EIGHT]; D]; D], external: None }
    }
}

impl<const D: usize> Given<D> {
    /// Sets the data of particles with the given mass (kg), velocity (m/s), volume (m³), Cauchy stress (Pa) and
    /// external force (N).
    #[inline(always)]
    pub fn set(
        &mut self,
        mass: Eight,
        velocity: &[Eight; D],
        volume: Eight,
        stress: &SymmetricTensor<Eight>,
        external: Option<[Eight; D]>,
    ) {
        self.mass = mass.to_array();
        for a in 0..D {
            self.momentum[a] = (mass * velocity[a]).to_array();
            for b in 0..D {
                self.flux[b][a] = (-volume * stress.get(a, b)).to_array();
            }
        }
        self.external = external.map(|force| force.map(Eight::to_array));
    }

    /// Momentum and, in the last place, mass of the `l`-th particle.
    #[inline(always)]
    pub fn momentum(&self, l: usize) -> Node {
        let mut momentum = padded(&self.momentum, l);
        momentum.as_mut_array()[3] = self.mass[l];
        momentum
    }
}

/// The vector of the `l`-th particle.
#[inline(always)]
pub(super) fn padded<const D: usize>(components: &[Octet; D], l: usize) -> Node {
    let mut vector = [0.0; 4];
    for a in 0..D {
        vector[a] = components[a][l];
    }
    Node::from(vector)
}

/// Adds a particle's momentum and mass, Eqs. (7) and (8), and its forces, −V_p σ_p ∇w_ip + w_ip f_p,
/// Eq. (10), to `nodes`, which begins at node `origin`.
///
/// `carried(slow, fast, w)` gives, for the row of the stencil at these places and of weight `w`, the momentum and mass
/// that node `k` of the row receives, without the weight along the row.
#[inline(always)]
pub fn spread<const D: usize, const S: usize, R: Fn(usize) -> Node>(
    stencil: StencilRef<'_, D, S>,
    given: &Given<D>,
    carried: impl Fn(usize, usize, Node) -> R,
    nodes: &mut [NodalState],
    origin: usize,
) {
    let l = stencil.place();
    let mut flux = [Node::ZERO; D];
    for a in 0..D {
        flux[a] = padded(&given.flux[a], l);
    }
    let external = given.external.as_ref().map(|force| padded(force, l));
    let (last, slope) = (stencil.last(), stencil.slope());
    let stride = stencil.stride();
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for slow in 0..lines {
        let (begin, length) = stencil.line(slow, origin);
        let line = &mut nodes[begin..begin + length];
        for fast in 0..rows {
            // On a row the force is `across` w + `along` w′ of the last axis.
            let weight = Node::splat(stencil.row_weight(slow, fast));
            let row_carried = carried(slow, fast, weight);
            let mut across = external.map_or(Node::ZERO, |force| force * weight);
            for a in 0..D - 1 {
                let gradient = Node::splat(stencil.row_gradient(slow, fast, a));
                across = flux[a].mul_add(gradient, across);
            }
            let along = flux[D - 1] * weight;
            let nodes = &mut line[fast * stride..fast * stride + S];
            for k in 0..S {
                nodes[k].motion = row_carried(k).mul_add(last[k], nodes[k].motion);
                let force = along.mul_add(slope[k], nodes[k].change);
                nodes[k].change = across.mul_add(last[k], force);
            }
        }
    }
}

/// Data that eight particles receive from the grid.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Received<const D: usize> {
    /// Σ_i w_ip v_iⁿ⁺¹ (m/s), Eq. (12).
    velocity: [Octet; D],
    /// Σ_i w_ip (v_iⁿ⁺¹ − v_iⁿ) (m/s), the increment of Eq. (11).
    increment: [Octet; D],
    /// Σ_i v_iⁿ⁺¹ ⊗ ∇w_ip (1/s), entry \[a\]\[b\] = ∂v_a/∂x_b.
    gradient: [[Octet; D]; D],
}

impl<const D: usize> Default for Received<D> {
    fn default() -> Self {
        Self { velocity: [[0.0; EIGHT]; D], increment: [[0.0; EIGHT]; D], gradient: [[[0.0; EIGHT]; D]; D] }
    }
}

impl<const D: usize> Received<D> {
    /// Σ_i w_ip v_iⁿ⁺¹ (m/s) along an axis.
    #[inline(always)]
    pub fn velocity(&self, a: usize) -> Eight {
        Eight::new(self.velocity[a])
    }

    /// Σ_i w_ip (v_iⁿ⁺¹ − v_iⁿ) (m/s) along an axis.
    #[inline(always)]
    pub fn increment(&self, a: usize) -> Eight {
        Eight::new(self.increment[a])
    }

    /// ∂v_a/∂x_b (1/s).
    #[inline(always)]
    pub fn gradient(&self, a: usize, b: usize) -> Eight {
        Eight::new(self.gradient[a][b])
    }

    /// Replaces the gradient of the `l`-th particle by that which it has in `other`.
    #[inline(always)]
    pub(super) fn take_gradient(&mut self, other: &Self, l: usize) {
        for a in 0..D {
            for b in 0..D {
                self.gradient[a][b][l] = other.gradient[a][b][l];
            }
        }
    }
}

/// Gathers the nodal velocities vⁿ⁺¹ and their changes vⁿ⁺¹ − vⁿ.
///
/// `also(slow, fast, w, v, nodes)` sees, for the row of the stencil at these places and of weight `w`, the nodes and the
/// sum `v` of their velocities with the weights along the row.
#[inline(always)]
pub fn gather<const D: usize, const S: usize>(
    stencil: StencilRef<'_, D, S>,
    nodes: &[NodalState],
    received: &mut Received<D>,
    mut also: impl FnMut(usize, usize, Node, Node, &[NodalState]),
) {
    let (mut v, mut dv) = (Node::ZERO, Node::ZERO);
    let mut columns = [Node::ZERO; D];
    let (last, slope) = (stencil.last(), stencil.slope());
    let stride = stencil.stride();
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for slow in 0..lines {
        let (begin, length) = stencil.line(slow, 0);
        let line = &nodes[begin..begin + length];
        for fast in 0..rows {
            let nodes = &line[fast * stride..fast * stride + S];
            let (mut value, mut tilt, mut change) = (Node::ZERO, Node::ZERO, Node::ZERO);
            for k in 0..S {
                value = nodes[k].motion.mul_add(last[k], value);
                tilt = nodes[k].motion.mul_add(slope[k], tilt);
                change = nodes[k].change.mul_add(last[k], change);
            }
            let weight = Node::splat(stencil.row_weight(slow, fast));
            v = value.mul_add(weight, v);
            dv = change.mul_add(weight, dv);
            for a in 0..D - 1 {
                let gradient = Node::splat(stencil.row_gradient(slow, fast, a));
                columns[a] = value.mul_add(gradient, columns[a]);
            }
            columns[D - 1] = tilt.mul_add(weight, columns[D - 1]);
            also(slow, fast, weight, value, nodes);
        }
    }
    let l = stencil.place();
    for a in 0..D {
        received.velocity[a][l] = v.as_array()[a];
        received.increment[a][l] = dv.as_array()[a];
        for b in 0..D {
            received.gradient[a][b][l] = columns[b].as_array()[a];
        }
    }
}
