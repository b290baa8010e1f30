//! A nearly incompressible Newtonian fluid.
//!
//! σ = K (J − 1) I + 2 μ dev d with the rate of deformation d = sym(ΔF − I)/Δt; p = −K (J − 1) is the
//! equation of state of Zhao, Jiang & Choo's dam break. With F̄, J is J̄.

use super::Law;
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::{SymmetricTensor, determinant};
use nalgebra::Matrix3;

/// A Newtonian fluid. Its state is J and nothing else; it stores ½ K (J − 1)² per reference volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewtonianFluid {
    /// Bulk modulus K (Pa).
    pub bulk_modulus: f64,
    /// Dynamic viscosity μ (Pa s).
    pub viscosity: f64,
}

impl NewtonianFluid {
    /// From bulk modulus (Pa) and dynamic viscosity (Pa s).
    ///
    /// # Errors
    /// A modulus that is not positive, a viscosity that is negative, or either not finite.
    pub fn new(bulk_modulus: f64, viscosity: f64) -> Result<Self, Error> {
        positive(bulk_modulus, "bulk modulus", "positive (Pa)")?;
        require(viscosity >= 0.0, "viscosity", viscosity, "zero or positive (Pa s)")?;
        Ok(Self { bulk_modulus, viscosity })
    }
}

impl Law for NewtonianFluid {
    type State = f64;

    /// Viscous stresses dissipate.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        Self { bulk_modulus: stress * self.bulk_modulus, viscosity: stress * self.viscosity }
    }

    fn initial_state(&self) -> f64 {
        1.0
    }

    fn resting(&self, f: &Matrix3<f64>, _undeformed: &f64) -> (SymmetricTensor, f64) {
        let j = f.determinant();
        let pressure_part = self.bulk_modulus * (j - 1.0);
        (SymmetricTensor::identity().scale_add_identity(pressure_part, 0.0), j)
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, dt: f64, state: &T) -> (SymmetricTensor<T>, T) {
        let j = *state * determinant(delta_f);
        let velocity_gradient = Matrix3::from_fn(|a, b| {
            let identity = f64::from(u8::from(a == b));
            (delta_f[(a, b)] - T::splat(identity)) / T::splat(dt)
        });
        let rate = SymmetricTensor::symmetric_part(&velocity_gradient);
        let viscous = T::splat(2.0 * self.viscosity);
        let pressure_part = T::splat(self.bulk_modulus) * (j - T::splat(1.0)) - viscous * rate.mean();
        (rate.scale_add_identity(viscous, pressure_part), j)
    }

    /// One by one: so little is computed that eight side by side cost more than they save, 3 % of a step.
    fn energy(&self, j: &f64) -> f64 {
        0.5 * self.bulk_modulus * (j - 1.0) * (j - 1.0)
    }

    /// K J², of the inviscid fluid.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, _stress: &SymmetricTensor<T>, _state: &T) -> T {
        T::splat(self.bulk_modulus) * j * j
    }
}
