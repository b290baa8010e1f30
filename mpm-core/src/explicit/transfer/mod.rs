//! Particle–grid transfers: how velocities go to the nodes and come back.
//!
//! | transfer | particle velocity | null space | angular momentum | with no forces, energy |
//! |---|---|---|---|---|
//! | [`Flip`], η = 1 | V + S a Δt | kept | – | unchanged |
//! | [`Flip`], η = 0: PIC | S S⁺V + S a Δt | removed | lost | falls |
//! | [`Apic`] | the same, and its moment | removed | conserved | falls little |
//! | [`Xpic`] (m) | V + S a Δt − (1 − S S⁺)ᵐ V | removed | – | falls less the larger m |
//!
//! S maps nodes to particles, S⁺ maps back with lumped mass. All conserve momentum, and all form
//! forces and velocity gradients with ∇w.

mod apic;
mod flip;
pub mod kernel;
#[cfg(test)]
mod tests;
mod xpic;

pub use apic::{Apic, second_moment};
pub use flip::Flip;
pub use kernel::{Given, Received};
pub use xpic::Xpic;

use crate::basis::Basis;
use crate::lattice::{Lattice, Stencil};
use crate::memory::Memory;
use crate::nodes::NodalState;
use crate::particles::Particles;
use crate::stage::Prescribed;
use nalgebra::SMatrix;
use std::ops::Range;

/// A particle–grid transfer. Its methods stand inside the loop over particles and nodes, so it is a
/// type parameter of the solver.
pub trait Transfer<const D: usize>: Memory + Send + Sync {
    /// Gives the particles the columns that the transfer needs; a column that is there is kept.
    fn attach(&self, _particles: &mut Particles<D>) {}

    /// Adds a particle's mass, momentum and forces, Eqs. (7), (8), (10), to `nodes`, which begins at
    /// node `origin`.
    fn particle_to_grid<const S: usize, B: Basis<S>>(
        &self,
        lattice: &Lattice<D, S, B>,
        stencil: &Stencil<D, S>,
        given: &Given<'_, D>,
        nodes: &mut [NodalState],
        origin: usize,
    );

    /// Between the grid update and G2P: what needs passes over all particles. `held` are the prescribed
    /// velocities. Returns how often it went from the grid to the particles and back.
    fn prepare<const S: usize, B: Basis<S>>(
        &mut self,
        _lattice: &Lattice<D, S, B>,
        _particles: &Particles<D>,
        _slabs: &[Range<usize>],
        _nodes: &[NodalState],
        _held: &[Prescribed],
    ) -> u64 {
        0
    }

    /// New velocity (m/s), and moment B (m²/s) where there is one, of a particle at `position` (m);
    /// returns what else it receives, Eqs. (11)–(13).
    fn grid_to_particle<const S: usize, B: Basis<S>>(
        &self,
        lattice: &Lattice<D, S, B>,
        stencil: &Stencil<D, S>,
        position: &[f64; D],
        nodes: &[NodalState],
        velocity: &mut [f64; D],
        affine: Option<&mut SMatrix<f64, D, D>>,
    ) -> Received<D>;
}
