//! Hypoelasticity with J2 plasticity: the rate of the Cauchy stress is that of [`Hypoelastic`], and where its deviator
//! exceeds the strength, ‖s‖ > κ, flow takes it back along a radius.
//!
//! The law of Section 3.3 of Wang, Vardon, Hicks & Chen (2016), doi:10.1016/j.compgeo.2015.08.008: small elastic
//! strains in a body that turns and flows far. [`HenckyJ2`](super::HenckyJ2) is its hyperelastic counterpart; the two
//! differ by the elastic strain.

use super::strength::PER_FLOW;
use super::{ElastoplasticState, Hypoelastic, JaumannUpdate, Law, Response, Strength};
use crate::error::Error;
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;

/// A hypoelastic solid that yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HypoelasticJ2 {
    elastic: Hypoelastic,
    strength: Strength,
}

impl HypoelasticJ2 {
    /// From Young's modulus (Pa), Poisson's ratio, the integration of a step and the strength.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a strength that softens faster
    /// than the elastic stress can fall.
    pub fn new(
        young_modulus: f64,
        poisson_ratio: f64,
        update: JaumannUpdate,
        strength: Strength,
    ) -> Result<Self, Error> {
        let elastic = Hypoelastic::new(young_modulus, poisson_ratio, update)?;
        strength.require_gentler_than(elastic.shear_modulus())?;
        Ok(Self { elastic, strength })
    }
}

impl Law for HypoelasticJ2 {
    type State = ElastoplasticState;

    /// A rate of stress that follows from no energy.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        Self { elastic: self.elastic.in_units(stress), strength: self.strength.in_units(stress) }
    }

    fn initial_state(&self) -> ElastoplasticState {
        ElastoplasticState { elastic: self.elastic.initial_state(), plastic_strain: 0.0 }
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, dt: f64, state: &ElastoplasticState<T>) -> Response<Self, T> {
        let (trial, _) = self.elastic.response(delta_f, dt, &state.elastic);
        let deviator = trial.deviator();
        let norm = deviator.norm();
        let stiffness = 2.0 * self.elastic.shear_modulus();
        let flow = self.strength.flow(norm, stiffness, state.plastic_strain);
        let back = T::splat(stiffness) * flow / norm.at_least(f64::MIN_POSITIVE);
        let stress = deviator.scale_add_identity(T::splat(1.0) - back, trial.mean());
        let after =
            ElastoplasticState { elastic: stress, plastic_strain: state.plastic_strain + T::splat(PER_FLOW) * flow };
        (stress, after)
    }

    fn plastic_strain(&self, state: &ElastoplasticState) -> f64 {
        state.plastic_strain
    }

    /// ½ σ : C⁻¹ : σ, the energy that linear elasticity has at this stress. The law itself stores none.
    fn energy(&self, state: &ElastoplasticState) -> f64 {
        self.elastic.energy(&state.elastic)
    }

    /// That of elastic material.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &ElastoplasticState<T>) -> T {
        self.elastic.wave_modulus(j, stress, &state.elastic)
    }
}
