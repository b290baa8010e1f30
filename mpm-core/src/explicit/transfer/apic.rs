//! The affine particle-in-cell transfer.
//!
//! Jiang, Schroeder, Selle, Teran & Stomakhin (2015), doi 10.1145/2766996; Jiang, Schroeder & Teran
//! (2017), doi 10.1016/j.jcp.2017.02.050. A particle carries, besides v_p, the moment
//! B_p = Σ_i w_ip v_i ⊗ (x_i − x_p) of the velocities around it, and gives to a node the momentum
//! w_ip m_p (v_p + B_p D_p⁻¹ (x_i − x_p)) with D_p = Σ_i w_ip (x_i − x_p) ⊗ (x_i − x_p).
//!
//! Here x_i is where the basis has its node (its Greville abscissae), so that Σ_i w_ip x_i = x_p and
//! everything below holds at walls too. It also makes D_p diagonal: D_p is h²/4 for quadratic and h²/3
//! for cubic splines away from walls, and depends on the place everywhere else.
//!
//! * An affine field survives P2G and G2P.
//! * Linear momentum Σ m v and angular momentum Σ m (x × v + ε:B), ε:B = Σ_i w (x_i − x_p) × v_i, are
//!   those of the nodes after P2G and after G2P, and moving with Σ w v keeps them.
//! * Σ ½ m (|v|² + B D⁻¹ : B) can only fall in a transfer with no forces.
//!
//! Hat functions have D = 0 along an axis on whose node the particle stands. There is then no other
//! node to tell of a slope, B is zero and the affine part is left out: nothing is lost. Carrying B
//! rather than C = B D⁻¹ over a step is what conserves angular momentum where D_p changes as the
//! particle moves; near a node of hats C can then be large, on nodes of little mass.

use super::Transfer;
use super::kernel::{Given, Received, gather, spread};
use crate::basis::Basis;
use crate::lattice::{Arms, Lattice, Stencil};
use crate::memory::Memoryless;
use crate::nodes::{NodalState, Node};
use crate::particles::Particles;
use nalgebra::SMatrix;

/// APIC, with forces from ∇w. Particles move with Σ w_ip v_iⁿ⁺¹.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Apic;

/// A second moment below this share of h² counts as zero: a particle this close to a node of hats.
/// What it then leaves out is at most this share of what it gives.
const SINGULAR: f64 = 1e-12;

/// The places of a row along the outer axes, axis by axis.
#[inline(always)]
fn outer<const D: usize>(slow: usize, fast: usize) -> [usize; D] {
    let mut outer = [0; D];
    if D == 2 {
        outer[0] = fast;
    }
    if D == 3 {
        outer[0] = slow;
        outer[1] = fast;
    }
    outer
}

/// The diagonal of D_p (m²).
#[inline(always)]
pub fn second_moment<const D: usize, const S: usize>(
    stencil: &Stencil<D, S>,
    arms: &Arms<D, S>,
) -> [f64; D] {
    std::array::from_fn(|a| {
        let terms = stencil.axis[a].w.iter().zip(&arms[a]);
        terms.map(|(w, arm)| w * arm * arm).sum()
    })
}

impl Memoryless for Apic {}

impl<const D: usize> Transfer<D> for Apic {
    fn attach(&self, particles: &mut Particles<D>) {
        particles
            .affine
            .resize(particles.position.len(), SMatrix::zeros());
    }

    #[inline(always)]
    fn particle_to_grid<const S: usize, B: Basis<S>>(
        &self,
        lattice: &Lattice<D, S, B>,
        stencil: &Stencil<D, S>,
        given: &Given<'_, D>,
        nodes: &mut [NodalState],
        origin: usize,
    ) {
        let arms = lattice.arms(stencil, given.position);
        let moment = second_moment(stencil, &arms);
        let smallest = SINGULAR * lattice.grid.h * lattice.grid.h;
        // Columns of m C = m B D⁻¹.
        let mut slope = [Node::ZERO; D];
        for a in 0..D {
            if let Some(affine) = given.affine
                && moment[a] > smallest
            {
                let mut column = [0.0; 4];
                for b in 0..D {
                    column[b] = given.mass * affine[(b, a)] / moment[a];
                }
                slope[a] = Node::from(column);
            }
        }
        let momentum = given.momentum();
        let along = &arms[D - 1];
        let carried = |slow: usize, fast: usize, w: f64| {
            let outer = outer::<D>(slow, fast);
            let mut middle = momentum;
            for a in 0..D - 1 {
                middle = slope[a].mul_add(Node::splat(arms[a][outer[a]]), middle);
            }
            let (middle, slope) = (middle * w, slope[D - 1] * w);
            move |k: usize| slope.mul_add(Node::splat(along[k]), middle)
        };
        spread(stencil, given, carried, nodes, origin);
    }

    #[inline(always)]
    fn grid_to_particle<const S: usize, B: Basis<S>>(
        &self,
        lattice: &Lattice<D, S, B>,
        stencil: &Stencil<D, S>,
        position: &[f64; D],
        nodes: &[NodalState],
        velocity: &mut [f64; D],
        affine: Option<&mut SMatrix<f64, D, D>>,
    ) -> Received<D> {
        let got = gather(stencil, nodes);
        *velocity = got.velocity;
        if let Some(affine) = affine {
            *affine = moment_of_velocities(stencil, &lattice.arms(stencil, position), nodes);
        }
        got
    }
}

/// B_p = Σ_i w_ip v_i ⊗ (x_i − x_p) (m²/s).
#[inline(always)]
fn moment_of_velocities<const D: usize, const S: usize>(
    stencil: &Stencil<D, S>,
    arms: &Arms<D, S>,
    nodes: &[NodalState],
) -> SMatrix<f64, D, D> {
    let mut columns = [Node::ZERO; D];
    let last = stencil.last();
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for slow in 0..lines {
        for fast in 0..rows {
            let (row, outer) = (stencil.row(slow, fast), outer::<D>(slow, fast));
            let nodes = &nodes[row.node..row.node + S];
            let (mut value, mut moment) = (Node::ZERO, Node::ZERO);
            for k in 0..S {
                let weighted = nodes[k].motion * last.w[k];
                value += weighted;
                moment = weighted.mul_add(Node::splat(arms[D - 1][k]), moment);
            }
            for a in 0..D - 1 {
                columns[a] = value.mul_add(Node::splat(row.w * arms[a][outer[a]]), columns[a]);
            }
            columns[D - 1] = moment.mul_add(Node::splat(row.w), columns[D - 1]);
        }
    }
    let columns = columns.map(Node::to_array);
    SMatrix::from_fn(|a, b| columns[b][a])
}
