//! Compressible neo-Hookean elasticity.
//!
//! W = μ/2 (I₁ − 3 − 2 ln J) + λ/2 (ln J)², hence P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ and
//! σ = \[μ (b − I) + λ ln J I\]/J with b = F Fᵀ.

use super::{Law, Response};
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;

/// A neo-Hookean solid. Its state is the left Cauchy–Green tensor b = F Fᵀ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookean {
    /// Lamé's first parameter λ (Pa).
    pub lambda: f64,
    /// Shear modulus μ (Pa).
    pub mu: f64,
}

impl NeoHookean {
    /// From Young's modulus (Pa) and Poisson's ratio at small strain.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5).
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Result<Self, Error> {
        positive(young_modulus, "Young's modulus", "positive (Pa)")?;
        require(
            poisson_ratio > -1.0 && poisson_ratio < 0.5,
            "Poisson's ratio",
            poisson_ratio,
            "greater than −1 and less than 0.5",
        )?;
        Ok(Self {
            lambda: young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
            mu: young_modulus / (2.0 * (1.0 + poisson_ratio)),
        })
    }
}

impl Law for NeoHookean {
    type State = SymmetricTensor;

    fn in_units(&self, stress: f64) -> Self {
        Self { lambda: stress * self.lambda, mu: stress * self.mu }
    }

    fn initial_state(&self) -> SymmetricTensor {
        SymmetricTensor::identity()
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, state: &SymmetricTensor<T>) -> Response<Self, T> {
        let b = state.push_forward(delta_f);
        let squared_jacobian = b.determinant();
        let inverse_jacobian = T::splat(1.0) / squared_jacobian.sqrt();
        let pressure_part = T::splat(0.5 * self.lambda) * squared_jacobian.ln() - T::splat(self.mu);
        let stress = b.scale_add_identity(T::splat(self.mu) * inverse_jacobian, pressure_part * inverse_jacobian);
        (stress, b)
    }

    fn energy(&self, b: &SymmetricTensor) -> f64 {
        let log_jacobian = 0.5 * b.determinant().ln();
        0.5 * self.mu * (b.trace() - 3.0 - 2.0 * log_jacobian) + 0.5 * self.lambda * log_jacobian * log_jacobian
    }

    /// λ + μ + μ b₁ − λ ln J along the greatest stretch √b₁.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, b: &SymmetricTensor<T>) -> T {
        let stretches = b.greatest_at_most() + b.mean();
        T::splat(self.lambda) + T::splat(self.mu) * stretches - j * stress.mean()
    }
}
