//! Hencky elasticity with J2 plasticity, perfect or softening.
//!
//! W = μ ‖dev h‖² + ½ K (tr h)² of Hencky's elastic strain h = ½ ln b_e, hence the Kirchhoff stress τ = 2μ dev h + K tr
//! h I. It yields at **‖s‖ = κ**, s = dev τ and ‖·‖ the Frobenius norm. That is √(2/3) of the strength in uniaxial
//! tension and √2 times the undrained shear strength s_u of plane strain: κ = √(2/3) σ_y = √2 s_u. Flow is associated
//! and keeps the volume. [`Strength`] says how κ falls. Integrated by the exponential map (Simo 1992,
//! doi:10.1016/0045-7825(92)90123-2), which returns along a radius, for any size of the step: exact where the direction
//! of flow does not turn, of first order in the step where it does.

use super::strength::PER_FLOW;
use super::{ElastoplasticState, Hencky, Law, Response, Strength};
use crate::error::Error;
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;

/// A Hencky solid that yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HenckyJ2 {
    elasticity: Hencky,
    strength: Strength,
}

impl HenckyJ2 {
    /// From Young's modulus (Pa), Poisson's ratio and the strength.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a strength that softens faster
    /// than the elastic stress can fall.
    pub fn new(young_modulus: f64, poisson_ratio: f64, strength: Strength) -> Result<Self, Error> {
        let elasticity = Hencky::new(young_modulus, poisson_ratio)?;
        strength.require_gentler_than(elasticity.shear_modulus)?;
        Ok(Self { elasticity, strength })
    }
}

impl Law for HenckyJ2 {
    type State = ElastoplasticState;

    fn in_units(&self, stress: f64) -> Self {
        Self { elasticity: self.elasticity.in_units(stress), strength: self.strength.in_units(stress) }
    }

    fn initial_state(&self) -> ElastoplasticState {
        ElastoplasticState { elastic: self.elasticity.initial_state(), plastic_strain: 0.0 }
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, state: &ElastoplasticState<T>) -> Response<Self, T> {
        let mut elastic = state.elastic.push_forward(delta_f);
        let plastic_strain = state.plastic_strain;
        // Flow keeps the volume: the elastic Jacobian is the whole one.
        let inverse_jacobian = T::splat(1.0) / elastic.determinant().sqrt();
        let logarithm = elastic.ln();
        let direction = logarithm.deviator();
        let Hencky { bulk_modulus, shear_modulus } = self.elasticity;
        let (norm, mut shear) = (direction.norm(), T::splat(shear_modulus));
        let flow = self.strength.flow(shear * norm, 2.0 * shear_modulus, plastic_strain);
        if flow.any_positive() {
            let share = T::splat(2.0) * flow / norm.at_least(f64::MIN_POSITIVE);
            let back = direction.scale_add_identity(-share, T::default());
            elastic = elastic.times_commuting(&back.exp());
            shear -= shear * share;
        }
        let pressure_part = T::splat(0.5 * bulk_modulus) * logarithm.trace();
        let stress = direction.scale_add_identity(shear * inverse_jacobian, pressure_part * inverse_jacobian);
        let after = ElastoplasticState { elastic, plastic_strain: plastic_strain + T::splat(PER_FLOW) * flow };
        (stress, after)
    }

    fn plastic_strain(&self, state: &ElastoplasticState) -> f64 {
        state.plastic_strain
    }

    fn energy(&self, state: &ElastoplasticState) -> f64 {
        self.elasticity.energy(&state.elastic)
    }

    /// That of elastic material.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &ElastoplasticState<T>) -> T {
        self.elasticity.wave_modulus(j, stress, &state.elastic)
    }
}

#[cfg(test)]
mod tests;
