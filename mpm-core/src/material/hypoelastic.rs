//! Hypoelasticity with the Jaumann rate: σ̊ = σ̇ − W σ + σ W = C : D, with Hooke's C and the Cauchy stress σ.
//!
//! Two integrations of a step. The second-order one takes the velocity gradient L Δt = (ΔF − I)\[½ (ΔF + I)\]⁻¹ at the
//! middle of the step, D and W its parts, and rotates the stress of the start by all of the step's rotation, the
//! strain's by half of it: σ′ = Q σ Qᵀ + Q½ (C : D Δt) Q½ᵀ with Cayley's Q = (I − ½ W Δt)⁻¹ (I + ½ W Δt) and Q½ of half
//! the spin. A step that turns rigidly gives exactly the turned stress. Hughes & Winget (1980) leave C : D unrotated,
//! of first order. The first-order one is that of Wang, Vardon, Hicks & Chen (2016), Eqs. (8) to (10): linear strain
//! and spin of the step, spin times the stress of its start. Their Eq. (9) as printed adds −(σ Δω + Δω σ), which of an
//! antisymmetric Δω is antisymmetric and hence no stress; Δω σ − σ Δω is meant, as their Eq. (16) shows.

use super::{Law, NeoHookean, Response};
use crate::error::Error;
use crate::number::Real;
use crate::tensor::{SymmetricTensor, determinant, minor};
use nalgebra::Matrix3;

/// How a step is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JaumannUpdate {
    /// The strain's stress halfway in the rotation: of second order in the step.
    Split,
    /// Linear in the displacement of the step: of first order.
    Linear,
}

/// A hypoelastic solid. Its state is the Cauchy stress (Pa).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hypoelastic {
    lambda: f64,
    mu: f64,
    update: JaumannUpdate,
}

impl Hypoelastic {
    /// From Young's modulus (Pa), Poisson's ratio and the integration of a step.
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5).
    pub fn new(young_modulus: f64, poisson_ratio: f64, update: JaumannUpdate) -> Result<Self, Error> {
        let NeoHookean { lambda, mu } = NeoHookean::new(young_modulus, poisson_ratio)?;
        Ok(Self { lambda, mu, update })
    }

    /// μ (Pa).
    pub(super) fn shear_modulus(&self) -> f64 {
        self.mu
    }

    /// C : `strain`.
    fn hooke<T: Real>(&self, strain: &SymmetricTensor<T>) -> SymmetricTensor<T> {
        let pressure = T::splat(self.lambda) * strain.trace();
        strain.scale_add_identity(T::splat(2.0 * self.mu), pressure)
    }
}

fn inverse<T: Real>(m: &Matrix3<T>) -> Matrix3<T> {
    let scale = T::splat(1.0) / determinant(m);
    Matrix3::from_fn(|i, j| scale * minor(m, j, i))
}

fn product<T: Real>(a: &Matrix3<T>, b: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| a[(i, 0)] * b[(0, j)] + a[(i, 1)] * b[(1, j)] + a[(i, 2)] * b[(2, j)])
}

fn identity_plus<T: Real>(scale: f64, m: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| {
        let one = if i == j { 1.0 } else { 0.0 };
        T::splat(one) + T::splat(scale) * m[(i, j)]
    })
}

fn skew_part<T: Real>(m: &Matrix3<T>) -> Matrix3<T> {
    Matrix3::from_fn(|i, j| T::splat(0.5) * (m[(i, j)] - m[(j, i)]))
}

impl Law for Hypoelastic {
    type State = SymmetricTensor;

    /// A rate of stress that follows from no energy.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        Self { lambda: stress * self.lambda, mu: stress * self.mu, update: self.update }
    }

    fn initial_state(&self) -> SymmetricTensor {
        SymmetricTensor::default()
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, stress: &SymmetricTensor<T>) -> Response<Self, T> {
        let gradient = Matrix3::from_fn(|i, j| {
            let one = if i == j { 1.0 } else { 0.0 };
            delta_f[(i, j)] - T::splat(one)
        });
        let stress = match self.update {
            JaumannUpdate::Split => {
                let at_middle = product(&gradient, &inverse(&identity_plus(0.5, &gradient)));
                let spin = skew_part(&at_middle);
                let cayley = |half: f64| {
                    let (behind, ahead) = (identity_plus(-half, &spin), identity_plus(half, &spin));
                    product(&inverse(&behind), &ahead)
                };
                let strain = SymmetricTensor::symmetric_part(&at_middle);
                let strained = self.hooke(&strain).push_forward(&cayley(0.25));
                stress.push_forward(&cayley(0.5)).add(&strained)
            }
            JaumannUpdate::Linear => {
                let spin = skew_part(&gradient);
                let full = Matrix3::from_fn(|i, j| stress.get(i, j));
                let turned = product(&spin, &full);
                let twice = turned + turned.transpose();
                let strain = SymmetricTensor::symmetric_part(&gradient);
                let turning = SymmetricTensor::symmetric_part(&twice);
                stress.add(&turning).add(&self.hooke(&strain))
            }
        };
        (stress, stress)
    }

    /// ½ σ : C⁻¹ : σ, the energy that linear elasticity has at this stress. The law itself stores none.
    fn energy(&self, stress: &SymmetricTensor) -> f64 {
        let deviator = stress.deviator().norm();
        let bulk = self.lambda + 2.0 * self.mu / 3.0;
        deviator * deviator / (4.0 * self.mu) + stress.mean() * stress.mean() / (2.0 * bulk)
    }

    /// J (λ + 2μ): uniaxial strain turns no stress.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, _stress: &SymmetricTensor<T>, _state: &SymmetricTensor<T>) -> T {
        j * T::splat(self.lambda + 2.0 * self.mu)
    }
}
