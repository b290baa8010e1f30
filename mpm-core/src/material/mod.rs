//! Constitutive laws: pure functions (ΔF̄, Δt, state) → (σ, state′) in three dimensions.

mod hencky_j2;
mod neo_hookean;
mod newtonian_fluid;

pub use hencky_j2::{ElastoplasticState, HenckyJ2, Strength};
pub use neo_hookean::NeoHookean;
pub use newtonian_fluid::NewtonianFluid;

use crate::number::{EIGHT, Eight, Real};
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// A constitutive law.
pub trait Law: Send + Sync {
    /// What a particle remembers; nothing more than the law needs.
    type State: Copy + Send + Sync + PartialEq + std::fmt::Debug + Serialize + DeserializeOwned;

    /// The state of undeformed material.
    fn initial_state(&self) -> Self::State;

    /// Cauchy stress (Pa) and state of a body that rests at the deformation gradient `f` and came there at no rate.
    fn at_rest(&self, f: &Matrix3<f64>) -> (SymmetricTensor, Self::State);

    /// Cauchy stress (Pa) and state after the relative deformation `delta_f` over `dt` (s).
    fn update(
        &self,
        delta_f: &Matrix3<f64>,
        dt: f64,
        state: &Self::State,
    ) -> (SymmetricTensor, Self::State);

    /// The same of many particles, the `k`-th of which deforms by `delta_f(k)`. A law for which it pays computes
    /// [`EIGHT`] of them side by side.
    #[inline]
    fn update_all(
        &self,
        delta_f: impl Fn(usize) -> Matrix3<f64>,
        dt: f64,
        states: &mut [Self::State],
        stresses: &mut [SymmetricTensor],
    ) {
        for (k, (state, stress)) in states.iter_mut().zip(stresses).enumerate() {
            (*stress, *state) = self.update(&delta_f(k), dt, state);
        }
    }

    /// Equivalent plastic strain √(2/3) ∫‖ε̇ᵖ‖ dt; zero of a law that doesn't flow.
    fn plastic_strain(&self, _state: &Self::State) -> f64 {
        0.0
    }

    /// Stored energy per reference volume (J/m³).
    fn energy(&self, state: &Self::State) -> f64;

    /// Speed of pressure waves (m/s) in undeformed material of the given density (kg/m³).
    fn wave_speed(&self, density: f64) -> f64;
}

/// [`Law::update_all`] of a law with a formula for eight: `eight` gives the stresses (Pa) of eight particles after
/// their relative deformation, and changes their states. Those that are left over go one by one.
#[inline(always)]
fn side_by_side<M: Law>(
    law: &M,
    eight: impl Fn(&Matrix3<Eight>, &mut [M::State; EIGHT]) -> SymmetricTensor<Eight>,
    delta_f: impl Fn(usize) -> Matrix3<f64>,
    dt: f64,
    states: &mut [M::State],
    stresses: &mut [SymmetricTensor],
) {
    let (blocks, rest) = states.as_chunks_mut::<EIGHT>();
    let (of_blocks, of_rest) = stresses.as_chunks_mut::<EIGHT>();
    let first_of_rest = blocks.len() * EIGHT;
    for (block, (states, stresses)) in blocks.iter_mut().zip(of_blocks).enumerate() {
        let mut each = [Matrix3::identity(); EIGHT];
        for (k, one) in each.iter_mut().enumerate() {
            *one = delta_f(block * EIGHT + k);
        }
        let packed = |i: usize, j: usize| Eight::pack(|k| each[k][(i, j)]);
        let deformation = Matrix3::new(
            packed(0, 0),
            packed(0, 1),
            packed(0, 2),
            packed(1, 0),
            packed(1, 1),
            packed(1, 2),
            packed(2, 0),
            packed(2, 1),
            packed(2, 2),
        );
        let stress = eight(&deformation, states);
        for (k, one) in stresses.iter_mut().enumerate() {
            *one = stress.part(k);
        }
    }
    for (k, (state, stress)) in rest.iter_mut().zip(of_rest).enumerate() {
        (*stress, *state) = law.update(&delta_f(first_of_rest + k), dt, state);
    }
}

#[cfg(test)]
mod tests;
