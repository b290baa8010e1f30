//! What all transfers share: forces and velocities between one particle and the nodes of its stencil.

use crate::lattice::Stencil;
use crate::nodes::{NodalState, Node};
use crate::tensor::SymmetricTensor;
use nalgebra::SMatrix;

/// What a particle gives to the grid.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a, const D: usize> {
    /// Position (m).
    pub position: &'a [f64; D],
    /// Mass (kg).
    pub mass: f64,
    /// Velocity (m/s).
    pub velocity: &'a [f64; D],
    /// Moment B of the velocities around the particle (m²/s), where the transfer carries one.
    pub affine: Option<&'a SMatrix<f64, D, D>>,
    /// Volume (m³).
    pub volume: f64,
    /// Cauchy stress (Pa).
    pub stress: &'a SymmetricTensor,
    /// External force (N), where there is one.
    pub external_force: Option<&'a [f64; D]>,
}

impl<const D: usize> Given<'_, D> {
    /// Momentum m v (kg m/s) and, in the last place, the mass m (kg).
    #[inline(always)]
    #[must_use]
    pub fn momentum(&self) -> Node {
        let mut carried = [0.0, 0.0, 0.0, self.mass];
        for a in 0..D {
            carried[a] = self.mass * self.velocity[a];
        }
        Node::from(carried)
    }
}

/// Adds a particle's momentum and mass, Eqs. (7) and (8), and its forces, −V_p σ_p ∇w_ip + w_ip f_p,
/// Eq. (10), to `nodes`, which begins at node `origin`.
///
/// `carried(slow, fast, w)` gives, for the row of the stencil at these places and of weight `w`, the momentum and
/// mass that node `k` of the row receives but for the weight along the row.
#[inline(always)]
pub fn spread<const D: usize, const S: usize, R: Fn(usize) -> Node>(
    stencil: &Stencil<D, S>,
    given: &Given<'_, D>,
    carried: impl Fn(usize, usize, f64) -> R,
    nodes: &mut [NodalState],
    origin: usize,
) {
    let mut external = [0.0; 4];
    let mut flux = [[0.0; 4]; D];
    if let Some(force) = given.external_force {
        external[..D].copy_from_slice(force);
    }
    for a in 0..D {
        for b in 0..D {
            flux[b][a] = -given.volume * given.stress.get(a, b);
        }
    }
    let external = Node::from(external);
    let last = stencil.last();
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for slow in 0..lines {
        for fast in 0..rows {
            let row = stencil.row(slow, fast);
            // On a row the force is `across` w + `along` w′ of the last axis.
            let row_carried = carried(slow, fast, row.w);
            let mut across = external * row.w;
            for a in 0..D - 1 {
                across = Node::from(flux[a]).mul_add(Node::splat(row.gradient[a]), across);
            }
            let along = Node::from(flux[D - 1]) * row.gradient[D - 1];

            let begin = row.node - origin;
            let nodes = &mut nodes[begin..begin + S];
            for k in 0..S {
                let (w, dw) = (Node::splat(last.w[k]), Node::splat(last.dw[k]));
                nodes[k].motion = row_carried(k).mul_add(w, nodes[k].motion);
                nodes[k].change = across.mul_add(w, along.mul_add(dw, nodes[k].change));
            }
        }
    }
}

/// What a particle receives from the grid.
#[derive(Debug, Clone, Copy)]
pub struct Received<const D: usize> {
    /// Σ_i w_ip v_iⁿ⁺¹ (m/s), Eq. (12).
    pub velocity: [f64; D],
    /// Σ_i w_ip (v_iⁿ⁺¹ − v_iⁿ) (m/s), the increment of Eq. (11).
    pub increment: [f64; D],
    /// Σ_i v_iⁿ⁺¹ ⊗ ∇w_ip (1/s), entry \[a\]\[b\] = ∂v_a/∂x_b.
    pub gradient: [[f64; D]; D],
    /// Velocity (m/s) that moves the particle: `velocity`, Eq. (17), unless the transfer has a form
    /// of its own.
    pub moving: [f64; D],
}

/// Gathers the nodal velocities vⁿ⁺¹ and their changes vⁿ⁺¹ − vⁿ.
#[inline(always)]
pub fn gather<const D: usize, const S: usize>(
    stencil: &Stencil<D, S>,
    nodes: &[NodalState],
) -> Received<D> {
    let (mut v, mut dv) = (Node::ZERO, Node::ZERO);
    let mut columns = [Node::ZERO; D];
    let last = stencil.last();
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for slow in 0..lines {
        for fast in 0..rows {
            let row = stencil.row(slow, fast);
            let nodes = &nodes[row.node..row.node + S];
            let (mut value, mut slope, mut change) = (Node::ZERO, Node::ZERO, Node::ZERO);
            for k in 0..S {
                let (w, dw) = (Node::splat(last.w[k]), Node::splat(last.dw[k]));
                value = nodes[k].motion.mul_add(w, value);
                slope = nodes[k].motion.mul_add(dw, slope);
                change = nodes[k].change.mul_add(w, change);
            }
            let w = Node::splat(row.w);
            v = value.mul_add(w, v);
            dv = change.mul_add(w, dv);
            for a in 0..D - 1 {
                columns[a] = value.mul_add(Node::splat(row.gradient[a]), columns[a]);
            }
            columns[D - 1] = slope.mul_add(w, columns[D - 1]);
        }
    }
    let (v, dv) = (v.to_array(), dv.to_array());
    let columns = columns.map(Node::to_array);
    let velocity = std::array::from_fn(|a| v[a]);
    Received {
        velocity,
        increment: std::array::from_fn(|a| dv[a]),
        gradient: std::array::from_fn(|a| std::array::from_fn(|b| columns[b][a])),
        moving: velocity,
    }
}
