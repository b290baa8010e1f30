//! Constitutive laws: pure functions (ΔF̄, Δt, state) → (σ, state′) in three dimensions.

mod hencky_j2;
mod neo_hookean;
mod newtonian_fluid;

pub use hencky_j2::{ElastoplasticState, HenckyJ2, Strength};
pub use neo_hookean::NeoHookean;
pub use newtonian_fluid::NewtonianFluid;

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

    /// Cauchy stress (Pa) and state after the relative deformation `delta_f` over `dt` (s).
    fn update(
        &self,
        delta_f: &Matrix3<f64>,
        dt: f64,
        state: &Self::State,
    ) -> (SymmetricTensor, Self::State);

    /// The same of many particles, the `k`-th of which deforms by `delta_f(k)`. A law for which it pays computes
    /// [`EIGHT`](crate::number::EIGHT) of them side by side.
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

#[cfg(test)]
mod tests;
