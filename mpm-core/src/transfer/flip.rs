//! The PIC/FLIP transfer, Eqs. (7), (8), (10)–(13).

use super::{NodalState, Node, axpy, pad};
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
    let momentum: [f64; D] = std::array::from_fn(|a| given.mass * given.velocity[a]);
    let carried = pad(&momentum, given.mass);
    let external = pad(given.external_force, 0.0);
    let flux: [Node; D] = std::array::from_fn(|b| {
        pad::<D>(
            &std::array::from_fn(|a| -given.volume * given.stress.get(a, b)),
            0.0,
        )
    });
    let last = stencil.last();
    stencil.for_each_row(|row| {
        // On a row the force is `across` w + `along` w′ of the last axis.
        let mut row_carried = [0.0; 4];
        axpy(&mut row_carried, row.w, &carried);
        let mut across = [0.0; 4];
        axpy(&mut across, row.w, &external);
        for a in 0..D - 1 {
            axpy(&mut across, row.gradient[a], &flux[a]);
        }
        let mut along = [0.0; 4];
        axpy(&mut along, row.gradient[D - 1], &flux[D - 1]);

        let begin = row.node - origin;
        let nodes = &mut nodes[begin..begin + S];
        for k in 0..S {
            axpy(&mut nodes[k].motion, last.w[k], &row_carried);
            axpy(&mut nodes[k].change, last.w[k], &across);
            axpy(&mut nodes[k].change, last.dw[k], &along);
        }
    });
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
    let mut v = [0.0; 4];
    let mut dv = [0.0; 4];
    let mut columns = [[0.0; 4]; D];
    let last = stencil.last();
    stencil.for_each_row(|row| {
        let nodes = &nodes[row.node..row.node + S];
        let (mut value, mut slope, mut change) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for k in 0..S {
            axpy(&mut value, last.w[k], &nodes[k].motion);
            axpy(&mut slope, last.dw[k], &nodes[k].motion);
            axpy(&mut change, last.w[k], &nodes[k].change);
        }
        axpy(&mut v, row.w, &value);
        axpy(&mut dv, row.w, &change);
        for a in 0..D - 1 {
            axpy(&mut columns[a], row.gradient[a], &value);
        }
        axpy(&mut columns[D - 1], row.gradient[D - 1], &slope);
    });
    Received {
        velocity: std::array::from_fn(|a| v[a]),
        increment: std::array::from_fn(|a| dv[a]),
        gradient: std::array::from_fn(|a| std::array::from_fn(|b| columns[b][a])),
    }
}

/// The blend of Eq. (13): `eta` = 1 is FLIP, 0 is PIC.
#[inline(always)]
pub fn blend<const D: usize>(eta: f64, old: &[f64; D], received: &Received<D>) -> [f64; D] {
    std::array::from_fn(|a| {
        eta * (old[a] + received.increment[a]) + (1.0 - eta) * received.velocity[a]
    })
}
