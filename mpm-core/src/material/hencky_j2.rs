//! Hencky elasticity with J2 plasticity, perfect or softening.
//!
//! W = μ ‖dev h‖² + ½ K (tr h)² of Hencky's elastic strain h = ½ ln b_e, hence the Kirchhoff stress
//! τ = 2μ dev h + K tr h I. It yields at **‖s‖ = κ**, s = dev τ and ‖·‖ the Frobenius norm. That is
//! √(2/3) of the strength in uniaxial tension and √2 times the undrained shear strength s_u of plane strain:
//! κ = √(2/3) σ_y = √2 s_u. Flow is associated and keeps the volume. Strength falls with the equivalent
//! plastic strain ε, ε̇ = √(2/3) γ̇ with the flow γ̇ = ‖ε̇ᵖ‖, as κ = κ_r + (κ_p − κ_r) e^(−η ε): Section 4.4
//! of Zhao, Jiang & Choo (2022); perfect plasticity, Section 4.2, has
//! κ_r = κ_p. Integrated by the exponential map (Simo 1992, doi:10.1016/0045-7825(92)90123-2), which returns
//! along a radius, for any size of the step: exact where the direction of flow doesn't turn, of first order in
//! the step where it does.

use super::{Law, NeoHookean};
use crate::error::{Error, require};
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// Newton steps for the flow: at most this many. The function is concave, so that from the second on the
/// iterates fall towards the root.
const MOST_STEPS: usize = 50;
/// Relative accuracy of ‖s‖ = κ.
const ACCURACY: f64 = 1e-14;

/// The strength κ of J2 plasticity as a function of the equivalent plastic strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    peak: f64,
    residual: f64,
    softening: f64,
}

impl Strength {
    /// Perfect plasticity with κ = ‖s‖ (Pa).
    ///
    /// # Errors
    /// κ not positive and finite.
    pub fn perfect(kappa: f64) -> Result<Self, Error> {
        Self::softening(kappa, kappa, 0.0)
    }

    /// Perfect plasticity with the undrained shear strength s_u (Pa) of plane strain: κ = √2 s_u.
    ///
    /// # Errors
    /// s_u not positive and finite.
    pub fn undrained(shear_strength: f64) -> Result<Self, Error> {
        Self::perfect(std::f64::consts::SQRT_2 * shear_strength)
    }

    /// From `peak` to `residual` (both ‖s‖, Pa) with the coefficient η (dimensionless).
    ///
    /// # Errors
    /// A strength that is not positive and finite, a residual strength above the peak, a negative η.
    pub fn softening(peak: f64, residual: f64, eta: f64) -> Result<Self, Error> {
        require(peak > 0.0, "peak strength", peak, "positive (Pa)")?;
        require(
            residual > 0.0 && residual <= peak,
            "residual strength",
            residual,
            "positive and at most the peak strength (Pa)",
        )?;
        require(eta >= 0.0, "softening coefficient", eta, "zero or positive")?;
        Ok(Self {
            peak,
            residual,
            softening: eta,
        })
    }

    /// κ (Pa) at an equivalent plastic strain, and its slope (Pa).
    #[must_use]
    #[inline]
    pub fn at(&self, plastic_strain: f64) -> (f64, f64) {
        // Without softening an exponential would be the dearest part of the law.
        if self.softening == 0.0 {
            return (self.peak, 0.0);
        }
        let excess = (self.peak - self.residual) * (-self.softening * plastic_strain).exp();
        (self.residual + excess, -self.softening * excess)
    }
}

/// A Hencky solid that yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HenckyJ2 {
    bulk_modulus: f64,
    shear_modulus: f64,
    strength: Strength,
}

/// What a particle of a [`HenckyJ2`] remembers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ElastoplasticState {
    /// Elastic left Cauchy–Green tensor b_e.
    pub elastic: SymmetricTensor,
    /// Equivalent plastic strain ε.
    pub plastic_strain: f64,
}

impl HenckyJ2 {
    /// From Young's modulus (Pa), Poisson's ratio and the strength.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a strength that softens faster
    /// than the elastic stress can fall, √(2/3) η (κ_p − κ_r) ≥ 2μ, so that the stress would jump at yield.
    pub fn new(young_modulus: f64, poisson_ratio: f64, strength: Strength) -> Result<Self, Error> {
        let NeoHookean { lambda, mu } = NeoHookean::new(young_modulus, poisson_ratio)?;
        let slope = -(2.0_f64 / 3.0).sqrt() * strength.at(0.0).1;
        require(
            slope < 2.0 * mu,
            "slope of softening √(2/3) η (κ_p − κ_r)",
            slope,
            "less than twice the shear modulus (Pa)",
        )?;
        Ok(Self {
            bulk_modulus: lambda + 2.0 * mu / 3.0,
            shear_modulus: mu,
            strength,
        })
    }

    /// The flow γ that takes a trial stress of norm `trial` (Pa) back to the surface:
    /// `trial` − 2μ γ = κ(ε + √(2/3) γ).
    fn flow(&self, trial: f64, plastic_strain: f64) -> f64 {
        let per_flow = (2.0_f64 / 3.0).sqrt();
        let mut flow = 0.0;
        for _ in 0..MOST_STEPS {
            let (kappa, slope) = self.strength.at(plastic_strain + per_flow * flow);
            let excess = trial - 2.0 * self.shear_modulus * flow - kappa;
            if excess.abs() <= ACCURACY * kappa {
                break;
            }
            flow += excess / (2.0 * self.shear_modulus + per_flow * slope);
        }
        flow
    }
}

impl Law for HenckyJ2 {
    type State = ElastoplasticState;

    fn initial_state(&self) -> ElastoplasticState {
        ElastoplasticState {
            elastic: SymmetricTensor::identity(),
            plastic_strain: 0.0,
        }
    }

    #[inline]
    fn update(
        &self,
        delta_f: &Matrix3<f64>,
        _dt: f64,
        state: &ElastoplasticState,
    ) -> (SymmetricTensor, ElastoplasticState) {
        let mut state = *state;
        state.elastic = state.elastic.push_forward(delta_f);
        // Flow keeps the volume: the elastic Jacobian is the whole one.
        let inverse_jacobian = 1.0 / state.elastic.determinant().sqrt();
        let logarithm = state.elastic.ln();
        let direction = logarithm.deviator();
        let (norm, mut shear) = (direction.norm(), self.shear_modulus);
        let trial = shear * norm;
        if trial > self.strength.at(state.plastic_strain).0 {
            let flow = self.flow(trial, state.plastic_strain);
            let back = direction.scale_add_identity(-2.0 * flow / norm, 0.0);
            state.elastic = state.elastic.times_commuting(&back.exp());
            state.plastic_strain += (2.0_f64 / 3.0).sqrt() * flow;
            shear -= 2.0 * self.shear_modulus * flow / norm;
        }
        let pressure_part = 0.5 * self.bulk_modulus * logarithm.trace();
        let stress = direction
            .scale_add_identity(shear * inverse_jacobian, pressure_part * inverse_jacobian);
        (stress, state)
    }

    fn plastic_strain(&self, state: &ElastoplasticState) -> f64 {
        state.plastic_strain
    }

    fn energy(&self, state: &ElastoplasticState) -> f64 {
        let log_jacobian = 0.5 * state.elastic.determinant().ln();
        let deviator = 0.5 * state.elastic.ln().deviator().norm();
        self.shear_modulus * deviator * deviator
            + 0.5 * self.bulk_modulus * log_jacobian * log_jacobian
    }

    fn wave_speed(&self, density: f64) -> f64 {
        ((self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus) / density).sqrt()
    }
}

#[cfg(test)]
mod tests;
