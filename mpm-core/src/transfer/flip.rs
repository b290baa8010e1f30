//! The PIC/FLIP transfer, Eqs. (7), (8), (10)–(13).

use super::{NodalState, Node};
use crate::lattice::Stencil;
use crate::tensor::SymmetricTensor;

/// What a particle gives to the grid.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a, const D: usize> {
    /// Mass (kg).
    pub mass: f64,
    /// Velocity (m/s).
    pub velocity: &'a [f64; D],
    /// Volume (m³).
    pub volume: f64,
    /// Cauchy stress (Pa).
    pub stress: &'a SymmetricTensor,
    /// External force (N).
    pub external_force: &'a [f64; D],
}

/// Adds a particle's momentum and mass, w_ip m_p (v_p, 1), Eqs. (7) and (8), and its forces,
/// −V_p σ_p ∇w_ip + w_ip f_p, Eq. (10), to `nodes`, which begins at node `origin`.
#[inline(always)]
pub fn particle_to_grid<const D: usize, const S: usize>(
    stencil: &Stencil<D, S>,
    given: &Given<'_, D>,
    nodes: &mut [NodalState],
    origin: usize,
) {
    let mut carried = [0.0, 0.0, 0.0, given.mass];
    let mut external = [0.0; 4];
    let mut flux = [[0.0; 4]; D];
    for a in 0..D {
        carried[a] = given.mass * given.velocity[a];
        external[a] = given.external_force[a];
        for b in 0..D {
            flux[b][a] = -given.volume * given.stress.get(a, b);
        }
    }
    let (carried, external) = (Node::from(carried), Node::from(external));
    let last = stencil.last();
    for r in 0..Stencil::<D, S>::ROWS {
        let row = stencil.row(r);
        // On a row the force is `across` w + `along` w′ of the last axis.
        let row_carried = carried * row.w;
        let mut across = external * row.w;
        for a in 0..D - 1 {
            across = Node::from(flux[a]).mul_add(Node::splat(row.gradient[a]), across);
        }
        let along = Node::from(flux[D - 1]) * row.gradient[D - 1];

        let begin = row.node - origin;
        let nodes = &mut nodes[begin..begin + S];
        for k in 0..S {
            let (w, dw) = (Node::splat(last.w[k]), Node::splat(last.dw[k]));
            nodes[k].motion = row_carried.mul_add(w, nodes[k].motion);
            nodes[k].change = across.mul_add(w, along.mul_add(dw, nodes[k].change));
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
}

/// Gathers the nodal velocities vⁿ⁺¹ and their changes vⁿ⁺¹ − vⁿ.
#[inline(always)]
pub fn grid_to_particle<const D: usize, const S: usize>(
    stencil: &Stencil<D, S>,
    nodes: &[NodalState],
) -> Received<D> {
    let (mut v, mut dv) = (Node::ZERO, Node::ZERO);
    let mut columns = [Node::ZERO; D];
    let last = stencil.last();
    for r in 0..Stencil::<D, S>::ROWS {
        let row = stencil.row(r);
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
    let (v, dv) = (v.to_array(), dv.to_array());
    let columns = columns.map(Node::to_array);
    let mut received = Received {
        velocity: [0.0; D],
        increment: [0.0; D],
        gradient: [[0.0; D]; D],
    };
    for a in 0..D {
        received.velocity[a] = v[a];
        received.increment[a] = dv[a];
        for b in 0..D {
            received.gradient[a][b] = columns[b][a];
        }
    }
    received
}

/// The blend of Eq. (13): `eta` = 1 is FLIP, 0 is PIC.
#[inline(always)]
pub fn blend<const D: usize>(eta: f64, old: &[f64; D], received: &Received<D>) -> [f64; D] {
    let mut new = *old;
    for a in 0..D {
        let flip = old[a] + received.increment[a];
        new[a] = eta * flip + (1.0 - eta) * received.velocity[a];
    }
    new
}
