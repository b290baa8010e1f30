//! FLIP with the stress updated from velocities that were mapped again.
//!
//! Sulsky, Zhou & Schreyer (1995), doi 10.1016/0010-4655(94)00170-7: the modified update of stress last, MUSL.
//! Particles take velocities and move as with FLIP; then their new velocities go back to the nodes, with the functions
//! at the places where the step began, and strains come from these:
//!
//! v̄ = S⁺Vⁿ⁺¹ = vⁿ + S⁺S a Δt,  ∇v = Σ_i v̄_i ⊗ ∇w_ip.
//!
//! A node that sees hardly any mass has a force and next to no inertia: vⁿ⁺¹ there is what its few particles feel as a
//! strain, without bound as the mass vanishes. v̄ there is a mean over particles, whose velocities are bounded.
//! Elsewhere S⁺S smooths a Δt over a cell, which is of second order in h. Since 1ᵀ m S⁺S = 1ᵀ m and v = const is kept,
//! momentum and rigid motion are as with FLIP. The work of the stresses, Σ V σ:∇v Δt, is that of v̄, and no longer the
//! power of the nodal forces on vⁿ⁺¹.

use super::kernel::{Received, gather};
use super::sweep::Sweep;
use super::{Flip, Transfer};
use crate::basis::Basis;
use crate::lattice::{Lattice, StencilRef};
use crate::memory::Memoryless;
use crate::nodes::{NodalState, Node};
use crate::number::{EIGHT, Eight};
use crate::order::Slabs;
use crate::particles::Particles;
use crate::stage::Prescribed;
use nalgebra::SMatrix;

/// MUSL: FLIP, with one more pass to the particles and back per step, from which strains come.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Musl {
    /// Per node v̄ in `motion`.
    sweep: Sweep,
}

impl Memoryless for Musl {}

impl<const D: usize> Transfer<D> for Musl {
    type Gives<const S: usize> = ();
    /// From v̄.
    type Receives = Received<D>;

    fn prepare<const S: usize, B: Basis<S>>(
        &mut self,
        lattice: &Lattice<D, S, B>,
        particles: &Particles<D>,
        slabs: &[Slabs],
        nodes: &[NodalState],
        held: &[Prescribed],
    ) -> u64 {
        self.sweep.begin(nodes, |node| NodalState { motion: node.change, change: Node::ZERO });
        self.sweep.there_and_back(lattice, particles, slabs);
        let Sweep { nodes: own, mapped } = &mut self.sweep;
        for ((own, mapped), node) in own.iter_mut().zip(mapped).zip(nodes) {
            own.motion = node.motion;
            if node.mass() > 0.0 {
                own.motion = node.motion - node.change + *mapped / Node::splat(node.mass());
            }
        }
        for c in held {
            let velocity = &mut own[c.node].motion.as_mut_array()[c.axis];
            *velocity = c.held(*velocity).unwrap_or(*velocity);
        }
        lattice.unfold(own);
        1
    }

    #[inline(always)]
    fn grid_to_particle<const S: usize>(
        &self,
        stencil: StencilRef<'_, D, S>,
        _gives: &(),
        nodes: &[NodalState],
        received: &mut Received<D>,
        receives: &mut Received<D>,
    ) {
        gather(stencil, nodes, received, |_, _, _, _, _| {});
        gather(stencil, &self.sweep.nodes, receives, |_, _, _, _, _| {});
        received.take_gradient(receives, stencil.place());
    }

    #[inline(always)]
    fn receive(
        &self,
        received: &Received<D>,
        _receives: &Received<D>,
        velocity: &mut [Eight; D],
        affine: &mut Option<[SMatrix<f64, D, D>; EIGHT]>,
    ) -> [Eight; D] {
        Flip::default().receive(received, &(), velocity, affine)
    }
}
