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
use super::kernel::{Given, Received, gather, padded, spread};
use crate::basis::{Basis, EightAxisWeights};
use crate::eights::matrix_entries;
use crate::lattice::{Lattice, StencilRef};
use crate::memory::Memoryless;
use crate::nodes::{NodalState, Node};
use crate::number::{EIGHT, Eight, Octet, Real};
use crate::particles::Particles;
use nalgebra::SMatrix;

/// APIC, with forces from ∇w. Particles move with Σ w_ip v_iⁿ⁺¹.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Apic;

/// A second moment below this share of h² counts as zero: a particle this close to a node of hats.
/// Largest share of a result that this neglects.
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

/// The diagonal of D_p (m²) of eight particles, from the functions that see them and their arms.
#[inline(always)]
pub fn second_moment<const D: usize, const S: usize>(
    functions: &[EightAxisWeights<S>; D],
    arms: &[[Eight; S]; D],
) -> [Eight; D] {
    let mut moment = [Eight::ZERO; D];
    for a in 0..D {
        for k in 0..S {
            moment[a] += functions[a].w[k] * arms[a][k] * arms[a][k];
        }
    }
    moment
}

/// The affine part of the momenta of eight particles, and the arms on which it acts.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Affine<const D: usize, const S: usize> {
    /// x_i − x_p (m), axis by axis.
    arms: [[Octet; S]; D],
    /// Columns of m C = m B D⁻¹ (kg/s).
    slope: [[Octet; D]; D],
}

impl<const D: usize, const S: usize> Default for Affine<D, S> {
    fn default() -> Self {
        Self { arms: [[[0.0; EIGHT]; S]; D], slope: [[[0.0; EIGHT]; D]; D] }
    }
}

/// Moments B (m²/s) of eight particles, column by column.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Moments<const D: usize>([[Octet; D]; D]);

impl<const D: usize> Default for Moments<D> {
    fn default() -> Self {
        Self([[[0.0; EIGHT]; D]; D])
    }
}

impl Memoryless for Apic {}

impl<const D: usize> Transfer<D> for Apic {
    type Gives<const S: usize> = Affine<D, S>;
    type Receives = Moments<D>;

    fn attach(&self, particles: &mut Particles<D>) {
        particles.affine.resize(particles.position.len(), SMatrix::zeros());
    }

    #[inline(always)]
    fn give<const S: usize, B: Basis<S>>(
        &self,
        lattice: &Lattice<D, S, B>,
        functions: &[EightAxisWeights<S>; D],
        x: &[Eight; D],
        mass: Eight,
        affine: Option<&[SMatrix<f64, D, D>; EIGHT]>,
    ) -> Affine<D, S> {
        let arms = lattice.arms(functions, x);
        let mut gives = Affine { arms: arms.map(|arms| arms.map(Eight::to_array)), ..Affine::default() };
        if let Some(affine) = affine {
            let (moment, affine) = (second_moment(functions, &arms), matrix_entries(affine));
            let smallest = Eight::splat(SINGULAR * lattice.grid.h * lattice.grid.h);
            for a in 0..D {
                let there = moment[a] - smallest;
                let ratio = there.if_positive(mass / moment[a], Eight::ZERO);
                for b in 0..D {
                    gives.slope[a][b] = (ratio * affine[b][a]).to_array();
                }
            }
        }
        gives
    }

    #[inline(always)]
    fn particle_to_grid<const S: usize>(
        &self,
        stencil: StencilRef<'_, D, S>,
        given: &Given<D>,
        gives: &Affine<D, S>,
        nodes: &mut [NodalState],
        origin: usize,
    ) {
        let l = stencil.place();
        let momentum = given.momentum(l);
        let mut slope = [Node::ZERO; D];
        for a in 0..D {
            slope[a] = padded(&gives.slope[a], l);
        }
        let carried = |slow: usize, fast: usize, w: Node| {
            let outer = outer::<D>(slow, fast);
            let mut middle = momentum;
            for a in 0..D - 1 {
                middle = slope[a].mul_add(Node::splat(gives.arms[a][outer[a]][l]), middle);
            }
            let (middle, slope) = (middle * w, slope[D - 1] * w);
            move |k: usize| slope.mul_add(Node::splat(gives.arms[D - 1][k][l]), middle)
        };
        spread(stencil, given, carried, nodes, origin);
    }

    /// B_p = Σ_i w_ip v_i ⊗ (x_i − x_p).
    #[inline(always)]
    fn grid_to_particle<const S: usize>(
        &self,
        stencil: StencilRef<'_, D, S>,
        gives: &Affine<D, S>,
        nodes: &[NodalState],
        received: &mut Received<D>,
        receives: &mut Moments<D>,
    ) {
        let l = stencil.place();
        let mut columns = [Node::ZERO; D];
        let mut weighted = stencil.last();
        for k in 0..S {
            weighted[k] *= Node::splat(gives.arms[D - 1][k][l]);
        }
        gather(stencil, nodes, received, |slow, fast, w, value, nodes| {
            let outer = outer::<D>(slow, fast);
            let mut moment = Node::ZERO;
            for k in 0..S {
                moment = nodes[k].motion.mul_add(weighted[k], moment);
            }
            for a in 0..D - 1 {
                let arm = w * Node::splat(gives.arms[a][outer[a]][l]);
                columns[a] = value.mul_add(arm, columns[a]);
            }
            columns[D - 1] = moment.mul_add(w, columns[D - 1]);
        });
        for a in 0..D {
            for b in 0..D {
                receives.0[a][b][l] = columns[a].as_array()[b];
            }
        }
    }

    #[inline(always)]
    fn receive(
        &self,
        received: &Received<D>,
        receives: &Moments<D>,
        velocity: &mut [Eight; D],
        affine: &mut Option<[SMatrix<f64, D, D>; EIGHT]>,
    ) -> [Eight; D] {
        for a in 0..D {
            velocity[a] = received.velocity(a);
        }
        if let Some(affine) = affine {
            for (l, affine) in affine.iter_mut().enumerate() {
                *affine = SMatrix::from_fn(|b, a| receives.0[a][b][l]);
            }
        }
        *velocity
    }
}
