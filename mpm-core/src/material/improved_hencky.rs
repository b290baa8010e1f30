//! Hencky elasticity of a porous solid whose energy has no bound as pores close (Pretti, Coombs, Augarde, Puigvert &
//! Gutiérrez 2024, doi:10.1016/j.mechmat.2024.104958): W = G ‖dev h‖² + K v²/(2n) of the strain h = ½ ln b, with the
//! volumetric strain v = tr h = ln J and the porosity n = 1 − (1 − n₀)/J of a solid with incompressible grains.
//!
//! dn/dv = 1 − n, hence τ = 2G dev h + \[K v/n − K v² (1 − n)/(2n²)\] I, which grows without bound as n → 0. W is ours
//! from their description: a bulk parameter, a shear modulus and a positive porosity.

use super::{Law, Response};
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;

/// A porous solid of incompressible grains. Its state is the left Cauchy–Green tensor b = F Fᵀ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImprovedHencky {
    bulk_parameter: f64,
    pub(super) shear_modulus: f64,
    pub(super) porosity: f64,
}

impl ImprovedHencky {
    /// From the bulk parameter K (Pa), the shear modulus G (Pa) and the porosity n₀ of undeformed material, whose bulk
    /// modulus is K/n₀.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a porosity outside (0, 1).
    pub fn new(bulk_parameter: f64, shear_modulus: f64, porosity: f64) -> Result<Self, Error> {
        let allowed = "positive (Pa)";
        positive(bulk_parameter, "bulk parameter", allowed)?;
        positive(shear_modulus, "shear modulus", allowed)?;
        require(porosity > 0.0 && porosity < 1.0, "porosity", porosity, "above 0 and below 1")?;
        Ok(Self { bulk_parameter, shear_modulus, porosity })
    }

    /// K v²/(2n), and its first and second derivatives by v (Pa).
    #[inline(always)]
    pub(super) fn volumetric<T: Real>(&self, v: T) -> [T; 3] {
        let number = T::splat;
        let solid = number(1.0 - self.porosity) * (-v).exp();
        let n = number(1.0) - solid;
        // Pores that have closed have no energy, and no stress that could be mistaken for one.
        let k = n.if_positive(number(self.bulk_parameter) / n, number(f64::NAN));
        // v (1 − n)/n.
        let ratio = v * solid / n;
        let half = number(0.5);
        [
            half * k * v * v,
            k * v * (number(1.0) - half * ratio),
            k * (number(1.0) - ratio - ratio + half * ratio * ratio * (number(1.0) + number(1.0) / solid)),
        ]
    }
}

impl Law for ImprovedHencky {
    type State = SymmetricTensor;

    fn in_units(&self, stress: f64) -> Self {
        Self {
            bulk_parameter: stress * self.bulk_parameter,
            shear_modulus: stress * self.shear_modulus,
            porosity: self.porosity,
        }
    }

    fn initial_state(&self) -> SymmetricTensor {
        SymmetricTensor::identity()
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, state: &SymmetricTensor<T>) -> Response<Self, T> {
        let b = state.push_forward(delta_f);
        let inverse_jacobian = T::splat(1.0) / b.determinant().sqrt();
        let logarithm = b.ln();
        let [_, mean, _] = self.volumetric(T::splat(0.5) * logarithm.trace());
        let stress = logarithm
            .deviator()
            .scale_add_identity(T::splat(self.shear_modulus) * inverse_jacobian, mean * inverse_jacobian);
        (stress, b)
    }

    fn porosity(&self) -> Option<f64> {
        Some(self.porosity)
    }

    fn energy(&self, b: &SymmetricTensor) -> f64 {
        let logarithm = b.ln();
        let deviator = 0.5 * logarithm.deviator().norm();
        let [volumetric, ..] = self.volumetric(0.5 * logarithm.trace());
        self.shear_modulus * deviator * deviator + volumetric
    }

    /// The second derivative by v and 4G/3, − τ₁ along the least Kirchhoff stress τ₁.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, _b: &SymmetricTensor<T>) -> T {
        let [_, _, bulk] = self.volumetric(j.ln());
        bulk + T::splat(4.0 / 3.0 * self.shear_modulus) - j * stress.least_at_least()
    }
}
