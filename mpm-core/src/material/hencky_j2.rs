//! Hencky elasticity with J2 plasticity, perfect or softening.
//!
//! W = μ ‖dev h‖² + ½ K (tr h)² of Hencky's elastic strain h = ½ ln b_e, hence the Kirchhoff stress
//! τ = 2μ dev h + K tr h I. It yields at **‖s‖ = κ**, s = dev τ and ‖·‖ the Frobenius norm. That is
//! √(2/3) of the strength in uniaxial tension and √2 times the undrained shear strength s_u of plane strain:
//! κ = √(2/3) σ_y = √2 s_u. Flow is associated and keeps the volume. Strength falls with the equivalent
//! plastic strain ε, ε̇ = √(2/3) γ̇ with the flow γ̇ = ‖ε̇ᵖ‖, as κ = κ_r + (κ_p − κ_r) e^(−η ε): Section 4.4
//! of Zhao, Jiang & Choo (2023); perfect plasticity, Section 4.2, has
//! κ_r = κ_p. Integrated by the exponential map (Simo 1992, doi:10.1016/0045-7825(92)90123-2), which returns
//! along a radius, for any size of the step: exact where the direction of flow doesn't turn, of first order in
//! the step where it does.

use super::{Law, NeoHookean, State};
use crate::error::{Error, require};
use crate::number::{Lanes, Real};
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// Newton steps for the flow: at most this many. The function is concave, so that from the second on the
/// iterates fall towards the root.
const MOST_STEPS: usize = 50;
/// Relative accuracy of ‖s‖ = κ.
const ACCURACY: f64 = 1e-14;
/// √(2/3): equivalent plastic strain per flow.
const PER_FLOW: f64 = 0.816_496_580_927_726;

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
    pub fn at<T: Real>(&self, plastic_strain: T) -> (T, T) {
        // Without softening an exponential would be the dearest part of the law.
        if self.softening == 0.0 {
            return (T::splat(self.peak), T::default());
        }
        let excess = T::splat(self.peak - self.residual)
            * (T::splat(-self.softening) * plastic_strain).exp();
        (
            T::splat(self.residual) + excess,
            T::splat(-self.softening) * excess,
        )
    }

    /// What flow up to an equivalent plastic strain dissipates per reference volume (J/m³): ∫ √(3/2) κ dε.
    #[must_use]
    pub fn plastic_work(&self, plastic_strain: f64) -> f64 {
        let softened = if self.softening == 0.0 {
            plastic_strain
        } else {
            -(-self.softening * plastic_strain).exp_m1() / self.softening
        };
        1.5_f64.sqrt() * (self.residual * plastic_strain + (self.peak - self.residual) * softened)
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
pub struct ElastoplasticState<T = f64> {
    /// Elastic left Cauchy–Green tensor b_e.
    pub elastic: SymmetricTensor<T>,
    /// Equivalent plastic strain ε.
    pub plastic_strain: T,
}

impl State for ElastoplasticState {
    type Of<T: Real> = ElastoplasticState<T>;

    #[inline(always)]
    fn pack<T: Real>(of: impl Fn(usize) -> Self) -> ElastoplasticState<T> {
        ElastoplasticState {
            elastic: SymmetricTensor::pack(|k| of(k).elastic),
            plastic_strain: T::pack(|k| of(k).plastic_strain),
        }
    }

    #[inline(always)]
    fn part<T: Lanes>(of: &ElastoplasticState<T>, k: usize) -> Self {
        Self {
            elastic: of.elastic.part(k),
            plastic_strain: of.plastic_strain.part(k),
        }
    }
}

impl HenckyJ2 {
    /// From Young's modulus (Pa), Poisson's ratio and the strength.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a strength that softens faster
    /// than the elastic stress can fall, √(2/3) η (κ_p − κ_r) ≥ 2μ, so that the stress would jump at yield.
    pub fn new(young_modulus: f64, poisson_ratio: f64, strength: Strength) -> Result<Self, Error> {
        let NeoHookean { lambda, mu } = NeoHookean::new(young_modulus, poisson_ratio)?;
        let slope = -PER_FLOW * strength.at(0.0).1;
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
    /// `trial` − 2μ γ = κ(ε + √(2/3) γ). Zero of a stress within it.
    #[inline(always)]
    fn flow<T: Real>(&self, trial: T, plastic_strain: T) -> T {
        let per_flow = T::splat(PER_FLOW);
        let stiffness = T::splat(2.0 * self.shear_modulus);
        let (mut kappa, mut slope) = self.strength.at(plastic_strain);
        let mut excess = (trial - kappa).at_least(0.0);
        let mut flow = T::default();
        if !excess.any_positive() {
            return flow;
        }
        let yields = excess;
        for _ in 0..MOST_STEPS {
            if !(excess.abs() - T::splat(ACCURACY) * kappa).any_positive() {
                break;
            }
            flow += excess / (stiffness + per_flow * slope);
            (kappa, slope) = self.strength.at(plastic_strain + per_flow * flow);
            excess = yields.if_positive(trial - stiffness * flow - kappa, T::default());
        }
        flow.with_slopes_of(excess / (stiffness + per_flow * slope))
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

    fn at_rest(&self, f: &Matrix3<f64>) -> (SymmetricTensor, ElastoplasticState) {
        // The stress depends on no rate: any duration will do.
        self.update(f, 1.0, &self.initial_state())
    }

    #[inline(always)]
    fn response<T: Real>(
        &self,
        delta_f: &Matrix3<T>,
        _dt: f64,
        state: &ElastoplasticState<T>,
    ) -> (SymmetricTensor<T>, ElastoplasticState<T>) {
        let mut elastic = state.elastic.push_forward(delta_f);
        let plastic_strain = state.plastic_strain;
        // Flow keeps the volume: the elastic Jacobian is the whole one.
        let inverse_jacobian = T::splat(1.0) / elastic.determinant().sqrt();
        let logarithm = elastic.ln();
        let direction = logarithm.deviator();
        let (norm, mut shear) = (direction.norm(), T::splat(self.shear_modulus));
        let flow = self.flow(shear * norm, plastic_strain);
        if flow.any_positive() {
            let share = T::splat(2.0) * flow / norm.at_least(f64::MIN_POSITIVE);
            let back = direction.scale_add_identity(-share, T::default());
            elastic = elastic.times_commuting(&back.exp());
            shear -= shear * share;
        }
        let pressure_part = T::splat(0.5 * self.bulk_modulus) * logarithm.trace();
        let stress = direction
            .scale_add_identity(shear * inverse_jacobian, pressure_part * inverse_jacobian);
        let after = ElastoplasticState {
            elastic,
            plastic_strain: plastic_strain + T::splat(PER_FLOW) * flow,
        };
        (stress, after)
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

    /// K + 4μ/3 − τ₁ along the least Kirchhoff stress τ₁ of elastic material.
    #[inline(always)]
    fn wave_modulus<T: Real>(
        &self,
        j: T,
        stress: &SymmetricTensor<T>,
        _state: &ElastoplasticState<T>,
    ) -> T {
        let undeformed = self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus;
        T::splat(undeformed) - j * stress.least_at_least()
    }
}

#[cfg(test)]
mod tests;
