//! Particle–grid transfers: how velocities go to the nodes and come back.
//!
//! | transfer | particle velocity | null space | angular momentum | with no forces, energy |
//! |---|---|---|---|---|
//! | [`Flip`], η = 1 | V + S a Δt | kept | – | unchanged |
//! | [`Musl`] | the same; strains from velocities mapped again | kept | – | unchanged |
//! | [`Flip`], η = 0: PIC | S S⁺V + S a Δt | removed | lost | falls |
//! | [`Apic`] | the same, and its moment | removed | conserved | falls little |
//! | [`Xpic`] (m) | V + S a Δt − (1 − S S⁺)ᵐ V | removed | – | falls less the larger m |
//!
//! S maps nodes to particles, S⁺ maps back with lumped mass. All conserve momentum, and all form
//! forces and velocity gradients with ∇w; gradients are those of the velocities after the update but with [`Musl`].

mod apic;
mod flip;
pub mod kernel;
mod musl;
mod sweep;
mod xpic;

pub use apic::{Apic, second_moment};
pub use flip::Flip;
pub use kernel::{Given, Received};
pub use musl::Musl;
pub use xpic::Xpic;

use crate::basis::{Basis, EightAxisWeights};
use crate::lattice::{Lattice, StencilRef};
use crate::memory::Memory;
use crate::nodes::NodalState;
use crate::number::{EIGHT, Eight};
use crate::order::Slabs;
use crate::particles::Particles;
use crate::stage::Prescribed;
use nalgebra::SMatrix;

/// A particle–grid transfer. Its methods stand inside the loop over particles and nodes, so it is a
/// type parameter of the solver. They serve eight particles, or one of eight.
pub trait Transfer<const D: usize>: Memory + Clone + Send + Sync {
    /// Data that eight particles give to the nodes beside momentum, mass and forces.
    type Gives<const S: usize>: Copy + Default;
    /// Data that eight particles receive beside [`Received`].
    type Receives: Copy + Default;

    /// Gives the particles the columns that the transfer needs; a column that is there is kept.
    fn attach(&self, _particles: &mut Particles<D>) {}

    /// Data given by particles at `x` (m) that see `functions`, with their mass (kg) and moment B (m²/s), if they carry
    /// one.
    fn give<const S: usize, B: Basis<S>>(
        &self,
        _lattice: &Lattice<D, S, B>,
        _functions: &[EightAxisWeights<S>; D],
        _x: &[Eight; D],
        _mass: Eight,
        _affine: Option<&[SMatrix<f64, D, D>; EIGHT]>,
    ) -> Self::Gives<S> {
        Self::Gives::default()
    }

    /// Adds a particle's mass, momentum and forces, Eqs. (7), (8), (10), to `nodes`, which begins at
    /// node `origin`. Default: a particle's momentum has no moment.
    #[inline(always)]
    fn particle_to_grid<const S: usize>(
        &self,
        stencil: StencilRef<'_, D, S>,
        given: &Given<D>,
        _gives: &Self::Gives<S>,
        nodes: &mut [NodalState],
        origin: usize,
    ) {
        let momentum = given.momentum(stencil.place());
        let carried = |_, _, w| {
            let row = momentum * w;
            move |_| row
        };
        kernel::spread(stencil, given, carried, nodes, origin);
    }

    /// Between the grid update and G2P: what needs passes over all particles, of bodies with these `slabs`. `held` are
    /// the prescribed velocities. Returns how often it went from the grid to the particles and back.
    fn prepare<const S: usize, B: Basis<S>>(
        &mut self,
        _lattice: &Lattice<D, S, B>,
        _particles: &Particles<D>,
        _slabs: &[Slabs],
        _nodes: &[NodalState],
        _held: &[Prescribed],
    ) -> u64 {
        0
    }

    /// Gathers for a particle, Eqs. (11)–(13); `gives` are those of [`Transfer::give`].
    fn grid_to_particle<const S: usize>(
        &self,
        stencil: StencilRef<'_, D, S>,
        gives: &Self::Gives<S>,
        nodes: &[NodalState],
        received: &mut Received<D>,
        receives: &mut Self::Receives,
    );

    /// New velocities (m/s), and moments B (m²/s) where there are such, from what particles received. Returns the
    /// velocity that moves them: Σ_i w_ip v_iⁿ⁺¹, Eq. (17), unless the transfer has a form of its own.
    fn receive(
        &self,
        received: &Received<D>,
        receives: &Self::Receives,
        velocity: &mut [Eight; D],
        affine: &mut Option<[SMatrix<f64, D, D>; EIGHT]>,
    ) -> [Eight; D];
}
