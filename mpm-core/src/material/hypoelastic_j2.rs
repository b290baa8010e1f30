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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{drive, sheared, stretches};
    use crate::material::HenckyJ2;
    use nalgebra::{Rotation3, Vector3};
    use std::iter::repeat_n;

    /// Young's modulus (Pa), and a strength κ (Pa) that yields at an elastic strain of half a percent.
    const YOUNG: f64 = 100.0;
    const KAPPA: f64 = 0.4;

    fn softening() -> Strength {
        Strength::softening_linearly(KAPPA, 0.2 * KAPPA, 4.0).unwrap()
    }

    fn law(strength: Strength) -> HypoelasticJ2 {
        HypoelasticJ2::new(YOUNG, 0.3, JaumannUpdate::Split, strength).unwrap()
    }

    /// Plane-strain shortening: the stress difference is 2c = √2 κ(ε), with ε from 2μ (√2 e − √(3/2) ε) = κ(ε), a
    /// linear equation until the residual strength. A step has the strain 2 tanh(e/2) at its middle, e + O(e³).
    #[test]
    fn shortening_follows_the_strength() {
        let law = law(softening());
        let mu = law.elastic.shear_modulus();
        for (end, softens) in [(0.02_f64, true), (0.3, false)] {
            let steps = 1000;
            let step = end / f64::from(steps);
            let (stress, state) = drive(&law, repeat_n(stretches([-step, step, 0.0]), steps as usize));
            let elastic = 2.0 * mu * 2.0_f64.sqrt() * end;
            let stiffness = 2.0 * mu * 1.5_f64.sqrt();
            let plastic =
                if softens { (elastic - KAPPA) / (stiffness - 4.0) } else { (elastic - 0.2 * KAPPA) / stiffness };
            let kappa = (KAPPA - 4.0 * plastic).max(0.2 * KAPPA);
            assert!((state.plastic_strain - plastic).abs() < end * step * step);
            assert!(((stress.yy - stress.xx) / (2.0_f64.sqrt() * kappa) - 1.0).abs() < 1e-3 * step);
        }
    }

    /// A body that turns while it flows carries the turned stress, and no other flow.
    #[test]
    fn a_rigid_turn_turns_the_stress() {
        let law = law(softening());
        let (_, before) = drive(&law, repeat_n(sheared(0.02), 3));
        let turn = Rotation3::new(Vector3::new(0.3, -0.5, 0.8)).into_inner();
        let (stress, after) = law.response(&turn, 1.0, &before);
        let exact = before.elastic.push_forward(&turn);
        // Rounding of the strain, which is nothing, times the modulus.
        assert!((stress.to_matrix() - exact.to_matrix()).norm() < 1e-14 * YOUNG);
        assert!((after.plastic_strain - before.plastic_strain).abs() < 1e-14);
    }

    /// In simple shear the two laws differ by the elastic strain, half a percent.
    #[test]
    fn its_hyperelastic_counterpart_differs_by_the_elastic_strain() {
        let hyperelastic = HenckyJ2::new(YOUNG, 0.3, softening()).unwrap();
        let path = || repeat_n(sheared(1e-3), 100);
        let (stress, state) = drive(&law(softening()), path());
        let (other, after) = drive(&hyperelastic, path());
        assert!(state.plastic_strain > 0.04);
        assert!((state.plastic_strain / after.plastic_strain - 1.0).abs() < 0.005);
        assert!((stress.to_matrix() - other.to_matrix()).norm() < 0.01 * KAPPA);
    }
}
