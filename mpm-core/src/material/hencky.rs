//! Hencky elasticity: W = μ ‖dev h‖² + ½ K (tr h)² of the strain h = ½ ln b, hence τ = 2μ dev h + K tr h I.

use super::{Law, NeoHookean, Response};
use crate::error::Error;
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;

/// A Hencky solid. Its state is the left Cauchy–Green tensor b = F Fᵀ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hencky {
    pub(super) bulk_modulus: f64,
    pub(super) shear_modulus: f64,
}

impl Hencky {
    /// From Young's modulus (Pa) and Poisson's ratio.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5).
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Result<Self, Error> {
        let NeoHookean { lambda, mu } = NeoHookean::new(young_modulus, poisson_ratio)?;
        Ok(Self { bulk_modulus: lambda + 2.0 * mu / 3.0, shear_modulus: mu })
    }
}

impl Law for Hencky {
    type State = SymmetricTensor;

    fn in_units(&self, stress: f64) -> Self {
        Self { bulk_modulus: stress * self.bulk_modulus, shear_modulus: stress * self.shear_modulus }
    }

    fn initial_state(&self) -> SymmetricTensor {
        SymmetricTensor::identity()
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, state: &SymmetricTensor<T>) -> Response<Self, T> {
        let b = state.push_forward(delta_f);
        let inverse_jacobian = T::splat(1.0) / b.determinant().sqrt();
        let logarithm = b.ln();
        let stress = logarithm.deviator().scale_add_identity(
            T::splat(self.shear_modulus) * inverse_jacobian,
            T::splat(0.5 * self.bulk_modulus) * logarithm.trace() * inverse_jacobian,
        );
        (stress, b)
    }

    fn energy(&self, b: &SymmetricTensor) -> f64 {
        let log_jacobian = 0.5 * b.determinant().ln();
        let deviator = 0.5 * b.ln().deviator().norm();
        self.shear_modulus * deviator * deviator + 0.5 * self.bulk_modulus * log_jacobian * log_jacobian
    }

    /// K + 4μ/3 − τ₁ along the least Kirchhoff stress τ₁.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, _b: &SymmetricTensor<T>) -> T {
        let undeformed = self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus;
        T::splat(undeformed) - j * stress.least_at_least()
    }
}
