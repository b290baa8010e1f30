//! Constitutive laws: pure functions (ΔF̄, Δt, state) → (σ, state′) in three dimensions.

mod any;
mod cam_clay;
mod drucker_prager;
mod hencky;
mod hencky_j2;
mod hypoelastic;
mod hypoelastic_j2;
mod improved_hencky;
mod mohr_coulomb;
mod neo_hookean;
mod newtonian_fluid;
mod strain_under;
mod strength;
mod viscous;
mod volumetric_state;

pub use any::{Answers, AnyLaw, SharedLaw, shared};
pub use cam_clay::CamClay;
pub use drucker_prager::{DruckerPrager, Matched};
pub use hencky::Hencky;
pub use hencky_j2::HenckyJ2;
pub use hypoelastic::{Hypoelastic, JaumannUpdate};
pub use hypoelastic_j2::HypoelasticJ2;
pub use improved_hencky::ImprovedHencky;
pub use mohr_coulomb::MohrCoulomb;
pub use neo_hookean::NeoHookean;
pub use newtonian_fluid::NewtonianFluid;
pub(crate) use strain_under::strain_under;
pub use strength::{ElastoplasticState, Strength};
pub use viscous::Viscous;
pub use volumetric_state::VolumetricState;

use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use std::fmt::Debug;

/// State of a particle: the numbers that its law needs, and no more.
pub trait State: Copy + Send + Sync + PartialEq + Debug {
    /// How many: one or more.
    const NUMBERS: usize;

    /// The same made of numbers `T`.
    type Of<T: Real>;

    /// The state of the numbers `of(0)`, `of(1)`, ….
    fn read<T: Real>(of: impl Fn(usize) -> T) -> Self::Of<T>;

    /// Gives every number with its place to `put`.
    fn write<T: Real>(of: &Self::Of<T>, put: impl FnMut(usize, &T));
}

impl State for f64 {
    const NUMBERS: usize = 1;
    type Of<T: Real> = T;

    #[inline(always)]
    fn read<T: Real>(of: impl Fn(usize) -> T) -> T {
        of(0)
    }

    #[inline(always)]
    fn write<T: Real>(of: &T, mut put: impl FnMut(usize, &T)) {
        put(0, of);
    }
}

impl State for SymmetricTensor {
    const NUMBERS: usize = 6;
    type Of<T: Real> = SymmetricTensor<T>;

    #[inline(always)]
    fn read<T: Real>(of: impl Fn(usize) -> T) -> SymmetricTensor<T> {
        SymmetricTensor { xx: of(0), yy: of(1), zz: of(2), xy: of(3), yz: of(4), xz: of(5) }
    }

    #[inline(always)]
    fn write<T: Real>(of: &SymmetricTensor<T>, mut put: impl FnMut(usize, &T)) {
        put(0, &of.xx);
        put(1, &of.yy);
        put(2, &of.zz);
        put(3, &of.xy);
        put(4, &of.yz);
        put(5, &of.xz);
    }
}

impl<S: State> State for (S, f64) {
    const NUMBERS: usize = S::NUMBERS + 1;
    type Of<T: Real> = (S::Of<T>, T);

    #[inline(always)]
    fn read<T: Real>(of: impl Fn(usize) -> T) -> Self::Of<T> {
        let last = of(S::NUMBERS);
        (S::read(of), last)
    }

    #[inline(always)]
    fn write<T: Real>((state, last): &Self::Of<T>, mut put: impl FnMut(usize, &T)) {
        S::write(state, &mut put);
        put(S::NUMBERS, last);
    }
}

/// The state of a law `M`, made of numbers `T`.
pub type StateOf<M, T> = <<M as Law>::State as State>::Of<T>;

/// Cauchy stress (Pa) and state after a step of a law `M`, made of numbers `T`.
pub type Response<M, T> = (SymmetricTensor<T>, StateOf<M, T>);

/// A constitutive law.
pub trait Law: Sized + Send + Sync {
    /// State of a particle.
    type State: State<Of<f64> = Self::State>;

    /// Whether the stress of a step is the derivative of a potential (a stored energy; of associated plasticity, with
    /// what flow dissipates): stiffness matrices are then symmetric.
    const CONSERVATIVE: bool = true;

    /// The material in units where 1 Pa = `stress`; time is unchanged.
    #[must_use]
    fn in_units(&self, stress: f64) -> Self;

    /// The state of undeformed material.
    fn initial_state(&self) -> Self::State;

    /// The state of undeformed material of a particle whose state is `like` one: what was given to the particle stays.
    fn undeformed(&self, _like: &Self::State) -> Self::State {
        self.initial_state()
    }

    /// A state whose strength is `share` times the law's; none of a law without a strength that particles can have.
    fn stronger(&self, _state: Self::State, _share: f64) -> Option<Self::State> {
        None
    }

    /// Cauchy stress (Pa) and state of a body that rests at the deformation gradient `f`, came there at no rate and was
    /// `undeformed`. Default: of laws whose stress depends on no rate, after a step of any duration.
    fn resting(&self, f: &Matrix3<f64>, undeformed: &Self::State) -> (SymmetricTensor, Self::State) {
        self.response(f, 1.0, undeformed)
    }

    /// [`Law::resting`] of a particle to which nothing was given.
    fn at_rest(&self, f: &Matrix3<f64>) -> (SymmetricTensor, Self::State) {
        self.resting(f, &self.initial_state())
    }

    /// Cauchy stress (Pa) and state after the relative deformation `delta_f` over `dt` (s): the law, of one particle
    /// or of eight, or with derivatives.
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, dt: f64, state: &StateOf<Self, T>) -> Response<Self, T>;

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
        (self.wave_modulus(1.0, &SymmetricTensor::default(), &self.initial_state()) / density).sqrt()
    }
}
