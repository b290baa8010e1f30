//! XPIC(m): PIC that filters only what no node sees.
//!
//! Hammerquist & Nairn (2017), doi 10.1016/j.cma.2017.01.035. With S the map from nodes to particles
//! (entries w_ip) and S⁺ the lumped map back (w_ip m_p/m_i), velocities become
//!
//! V ← V + S a Δt − (1 − S S⁺)ᵐ V = S (v* + a Δt),  v* = Σ_{k<m} (1 − S⁺S)ᵏ S⁺V.
//!
//! A mode that S S⁺ reduces by the factor λ, in \[0, 1\], is thus reduced by 1 − (1 − λ)ᵐ in every step:
//! m = 1 is PIC; as m grows all modes survive but those with λ = 0, the null space of S⁺.
//! v* is found by m − 1 sweeps u ← v + u − S⁺S u from u = v, that is, Richardson's iteration for the
//! velocities whose lumped image is v; the paper's alternating sum of binomials is the same polynomial.
//!
//! FMPM(m) of Nairn & Hammerquist (2021, doi 10.1016/j.cma.2021.113667) applies the same
//! series, there read as the inverse of the full mass matrix, to the updated velocities, v + a Δt
//! instead of v, and uses the result for strains as well. Here accelerations stay lumped, and ∇v
//! and the constraints are those of every other transfer.
//!
//! Particles move by Δt (S v + ½ (Vⁿ⁺¹ − Vⁿ)), second order in Δt; v is vⁿ, at held nodes what they
//! are held to (as mapped it would carry particles through a wall).

use super::Transfer;
use super::kernel::{Received, gather};
use super::sweep::Sweep;
use crate::basis::Basis;
use crate::error::{Error, require};
use crate::lattice::{Lattice, StencilRef};
use crate::memory::Memoryless;
use crate::nodes::{NodalState, Node};
use crate::number::{EIGHT, Eight};
use crate::order::Slabs;
use crate::particles::Particles;
use crate::stage::Prescribed;
use nalgebra::SMatrix;

/// Largest order: every sweep costs about a P2G, and gains less than the one before.
const MAX_ORDER: u32 = 5;

/// XPIC(m), with m − 1 extra passes between particles and grid per step.
#[derive(Debug, Clone, PartialEq)]
pub struct Xpic {
    order: u32,
    /// Per node: v* + a Δt in `motion`, vⁿ in `change`.
    sweep: Sweep,
}

impl Xpic {
    /// XPIC of order m = `order`.
    ///
    /// # Errors
    /// An order outside 1..=5.
    pub fn new(order: u32) -> Result<Self, Error> {
        require((1..=MAX_ORDER).contains(&order), "order of XPIC", f64::from(order), "from 1 (PIC) to 5")?;
        Ok(Self { order, sweep: Sweep::default() })
    }
}

impl Memoryless for Xpic {}

impl<const D: usize> Transfer<D> for Xpic {
    type Gives<const S: usize> = ();
    /// From its own nodes: S (v* + a Δt) for the velocity, S v for the increment.
    type Receives = Received<D>;

    fn prepare<const S: usize, B: Basis<S>>(
        &mut self,
        lattice: &Lattice<D, S, B>,
        particles: &Particles<D>,
        slabs: &[Slabs],
        nodes: &[NodalState],
        held: &[Prescribed],
    ) -> u64 {
        self.sweep.begin(nodes, |node| {
            let mut before = node.motion - node.change;
            before.as_mut_array()[3] = 0.0;
            NodalState { motion: before, change: before }
        });
        for _ in 1..self.order {
            self.sweep.there_and_back(lattice, particles, slabs);
            let Sweep { nodes: own, mapped } = &mut self.sweep;
            for ((own, mapped), node) in own.iter_mut().zip(mapped).zip(nodes) {
                if node.mass() > 0.0 {
                    own.motion += own.change - *mapped / Node::splat(node.mass());
                }
            }
            lattice.unfold(own);
        }
        let own = &mut self.sweep.nodes;
        for (own, node) in own.iter_mut().zip(nodes) {
            own.motion += node.change;
        }
        for c in held {
            let velocity = &mut own[c.node].change.as_mut_array()[c.axis];
            *velocity = c.held(*velocity).unwrap_or(*velocity);
        }
        lattice.unfold(own);
        u64::from(self.order - 1)
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
    }

    #[inline(always)]
    fn receive(
        &self,
        _received: &Received<D>,
        receives: &Received<D>,
        velocity: &mut [Eight; D],
        _affine: &mut Option<[SMatrix<f64, D, D>; EIGHT]>,
    ) -> [Eight; D] {
        let mut moving = [Eight::ZERO; D];
        for a in 0..D {
            let next = receives.velocity(a);
            moving[a] = receives.increment(a) + Eight::splat(0.5) * (next - velocity[a]);
            velocity[a] = next;
        }
        moving
    }
}
