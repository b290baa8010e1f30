//! Constitutive laws: pure functions (ΔF̄, Δt, state) → (σ, state′) in three dimensions.

mod cam_clay;
mod hencky;
mod hencky_j2;
mod hypoelastic;
mod hypoelastic_j2;
mod improved_hencky;
mod neo_hookean;
mod newtonian_fluid;
mod strength;
mod viscous;

pub use cam_clay::{CamClay, CamClayState};
pub use hencky::Hencky;
pub use hencky_j2::HenckyJ2;
pub use hypoelastic::{Hypoelastic, JaumannUpdate};
pub use hypoelastic_j2::HypoelasticJ2;
pub use improved_hencky::ImprovedHencky;
pub use neo_hookean::NeoHookean;
pub use newtonian_fluid::NewtonianFluid;
pub use strength::{ElastoplasticState, Strength};
pub use viscous::Viscous;

use crate::number::{Dual, EIGHT, Eight, Lanes, Real};
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// State of a particle: the numbers that its law needs, and no more.
pub trait State: Copy + Send + Sync + PartialEq + Debug + Serialize + DeserializeOwned {
    /// The same made of numbers `T`.
    type Of<T: Real>;

    /// The states `of(0)`, `of(1)`, …, as [`Real::pack`] packs numbers.
    fn pack<T: Real>(of: impl Fn(usize) -> Self) -> Self::Of<T>;

    /// The `k`-th of the states.
    fn part<T: Lanes>(of: &Self::Of<T>, k: usize) -> Self;
}

impl State for f64 {
    type Of<T: Real> = T;

    #[inline(always)]
    fn pack<T: Real>(of: impl Fn(usize) -> Self) -> T {
        T::pack(of)
    }

    #[inline(always)]
    fn part<T: Lanes>(of: &T, k: usize) -> Self {
        of.part(k)
    }
}

impl State for SymmetricTensor {
    type Of<T: Real> = SymmetricTensor<T>;

    #[inline(always)]
    fn pack<T: Real>(of: impl Fn(usize) -> Self) -> SymmetricTensor<T> {
        SymmetricTensor::pack(of)
    }

    #[inline(always)]
    fn part<T: Lanes>(of: &SymmetricTensor<T>, k: usize) -> Self {
        of.part(k)
    }
}

impl<S: State> State for (S, f64) {
    type Of<T: Real> = (S::Of<T>, T);

    #[inline(always)]
    fn pack<T: Real>(of: impl Fn(usize) -> Self) -> Self::Of<T> {
        (S::pack(|k| of(k).0), T::pack(|k| of(k).1))
    }

    #[inline(always)]
    fn part<T: Lanes>(of: &Self::Of<T>, k: usize) -> Self {
        (S::part(&of.0, k), of.1.part(k))
    }
}

/// The state of a law `M`, made of numbers `T`.
pub type StateOf<M, T> = <<M as Law>::State as State>::Of<T>;

/// A constitutive law.
pub trait Law: Sized + Send + Sync {
    /// State of a particle.
    type State: State;

    /// Whether the stress of a step is the derivative of a potential (a stored energy; of associated plasticity, with
    /// what flow dissipates): stiffness matrices are then symmetric.
    const CONSERVATIVE: bool = true;

    /// The material in units where 1 Pa = `stress`; time is unchanged.
    #[must_use]
    fn in_units(&self, stress: f64) -> Self;

    /// The state of undeformed material.
    fn initial_state(&self) -> Self::State;

    /// Cauchy stress (Pa) and state of a body that rests at the deformation gradient `f` and came there at no rate.
    /// Default: of laws whose stress depends on no rate, after a step of any duration.
    fn at_rest(&self, f: &Matrix3<f64>) -> (SymmetricTensor, Self::State) {
        self.update(f, 1.0, &self.initial_state())
    }

    /// Cauchy stress (Pa) and state after the relative deformation `delta_f` over `dt` (s): the law, of one particle
    /// or of eight, or with derivatives.
    fn response<T: Real>(
        &self,
        delta_f: &Matrix3<T>,
        dt: f64,
        state: &StateOf<Self, T>,
    ) -> (SymmetricTensor<T>, StateOf<Self, T>);

    /// [`Law::response`] of one particle.
    #[inline]
    fn update(&self, delta_f: &Matrix3<f64>, dt: f64, state: &Self::State) -> (SymmetricTensor, Self::State) {
        let (stress, state) = self.response(delta_f, dt, &State::pack::<f64>(|_| *state));
        (stress, State::part::<f64>(&state, 0))
    }

    /// [`Law::response`] of many particles, the `k`-th of which deforms by `delta_f(k)`: eight of them side by side,
    /// and those that are left over one by one.
    #[inline]
    fn update_all(
        &self,
        delta_f: impl Fn(usize) -> Matrix3<f64>,
        dt: f64,
        states: &mut [Self::State],
        stresses: &mut [SymmetricTensor],
    ) {
        let (blocks, rest) = states.as_chunks_mut::<EIGHT>();
        let (of_blocks, of_rest) = stresses.as_chunks_mut::<EIGHT>();
        let first_of_rest = blocks.len() * EIGHT;
        for (block, (states, stresses)) in blocks.iter_mut().zip(of_blocks).enumerate() {
            let each: [_; EIGHT] = std::array::from_fn(|k| delta_f(block * EIGHT + k));
            let deformation = Matrix3::from_fn(|i, j| Eight::pack(|k| each[k][(i, j)]));
            let before = State::pack::<Eight>(|k| states[k]);
            let (stress, after) = self.response(&deformation, dt, &before);
            for (k, (state, one)) in states.iter_mut().zip(stresses).enumerate() {
                (*one, *state) = (stress.part(k), State::part::<Eight>(&after, k));
            }
        }
        for (k, (state, stress)) in rest.iter_mut().zip(of_rest).enumerate() {
            (*stress, *state) = self.update(&delta_f(first_of_rest + k), dt, state);
        }
    }

    /// The consistent tangent: the Cauchy stress σ (Pa) of [`Law::update`] and in `slope[3 i + j]` of its components
    /// the derivatives ∂σ/∂ΔF_ij, while the state of the step's start stays.
    ///
    /// An implicit step differentiates P_rel = ΔJ σ ΔF⁻ᵀ, the stress per area at the step's start, whose derivative
    /// A_ijkl = ∂P_rel,ij/∂ΔF_kl has the geometric part as well: a node's force is Σ V P_rel ∇w and the stiffness
    /// between two nodes K_ik = Σ V ∂_j w A_ijkl ∂_l w′, with volumes and gradients of the step's start. P_rel of dual
    /// numbers, from this σ and ΔF of the same variables, is A.
    fn tangent(&self, delta_f: &Matrix3<f64>, dt: f64, state: &Self::State) -> SymmetricTensor<Dual<9>> {
        let variables = Matrix3::from_fn(|i, j| Dual::variable(delta_f[(i, j)], 3 * i + j));
        self.response(&variables, dt, &State::pack::<Dual<9>>(|_| *state)).0
    }

    /// Equivalent plastic strain √(2/3) ∫‖ε̇ᵖ‖ dt; zero of a law that does not flow.
    fn plastic_strain(&self, _state: &Self::State) -> f64 {
        0.0
    }

    /// Porosity n₀ of undeformed material, of a law that depends on it.
    fn porosity(&self) -> Option<f64> {
        None
    }

    /// Stored energy per reference volume (J/m³).
    fn energy(&self, state: &Self::State) -> f64;

    /// ρ₀ c² (Pa) of the fastest pressure wave, of speed c along the material that it deforms, or more: never less. `j`
    /// is the Jacobian, ρ₀ the density of undeformed material.
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &StateOf<Self, T>) -> T;

    /// Speed of pressure waves (m/s) in undeformed material of the given density (kg/m³).
    fn wave_speed(&self, density: f64) -> f64 {
        let state = State::pack::<f64>(|_| self.initial_state());
        (self.wave_modulus(1.0, &SymmetricTensor::default(), &state) / density).sqrt()
    }
}

#[cfg(test)]
mod tests;
