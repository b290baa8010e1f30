//! Artificial viscosity: a pressure that resists quick compression and takes what a shock must lose.
//!
//! q = ρ h ε̇ (c₁ c + c₂ h ε̇) where the volume shrinks at the rate ε̇ = −(det ΔF − 1)/Δt > 0, and none elsewhere; σ =
//! σ(law) − q I, with the density ρ = ρ₀/J of the moment, as the cells of a grid do not shrink with the material. The
//! quadratic part is that of von Neumann & Richtmyer, *A method for the numerical calculation of hydrodynamic shocks*,
//! J. Appl. Phys. 21, 232–237, 1950, doi:10.1063/1.1699639: a strong front is as wide as some cells, whatever its
//! speed. The linear one, with the speed c of waves in undeformed material, is Landshoff's (*A numerical method for
//! treating fluid flow in the presence of shocks*, Los Alamos LA-1930, 1955): it damps what is left behind the front.

use super::{Law, Response, StateOf};
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::{SymmetricTensor, determinant};
use nalgebra::Matrix3;

/// A law with an artificial viscosity. Its state is that of the law, and J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscous<M> {
    law: M,
    /// ρ₀ h c₁ c (Pa s) and ρ₀ h² c₂ (Pa s²).
    linear: f64,
    quadratic: f64,
}

impl<M: Law> Viscous<M> {
    /// `law` in material of a density (kg/m³) where it is undeformed, on cells of size `h` (m), with the coefficients c₁
    /// and c₂.
    ///
    /// # Errors
    /// A density or a size that is not positive, a coefficient that is negative, or any not finite.
    pub fn new(law: M, density: f64, h: f64, [linear, quadratic]: [f64; 2]) -> Result<Self, Error> {
        positive(density, "density", "positive (kg/m³)")?;
        positive(h, "size of the cells", "positive (m)")?;
        for coefficient in [linear, quadratic] {
            let what = "coefficient of the artificial viscosity";
            require(coefficient >= 0.0, what, coefficient, "zero or positive")?;
        }
        Ok(Self { linear: density * h * linear * law.wave_speed(density), quadratic: density * h * h * quadratic, law })
    }
}

impl<M: Law> Law for Viscous<M> {
    type State = (M::State, f64);

    /// Viscous stresses dissipate.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        Self { law: self.law.in_units(stress), linear: stress * self.linear, quadratic: stress * self.quadratic }
    }

    fn initial_state(&self) -> Self::State {
        (self.law.initial_state(), 1.0)
    }

    fn resting(&self, f: &Matrix3<f64>, (undeformed, _): &Self::State) -> (SymmetricTensor, Self::State) {
        let (stress, state) = self.law.resting(f, undeformed);
        (stress, (state, f.determinant()))
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, dt: f64, (state, j): &StateOf<Self, T>) -> Response<Self, T> {
        let (stress, state) = self.law.response(delta_f, dt, state);
        let relative = determinant(delta_f);
        let j = *j * relative;
        let lost = (T::splat(1.0) - relative) / T::splat(dt);
        let rate = lost.if_positive(lost, T::splat(0.0));
        let q = rate * (T::splat(self.linear) + T::splat(self.quadratic) * rate) / j;
        (stress.scale_add_identity(T::splat(1.0), -q), (state, j))
    }

    fn plastic_strain(&self, (state, _): &Self::State) -> f64 {
        self.law.plastic_strain(state)
    }

    fn porosity(&self) -> Option<f64> {
        self.law.porosity()
    }

    fn energy(&self, (state, _): &Self::State) -> f64 {
        self.law.energy(state)
    }

    /// That of the law. A step must be shorter than waves alone ask for: by √(1 + ζ²) + ζ, ζ = c₁ + 2 c₂ h ε̇/c, as of
    /// any oscillator with such a damping.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, (state, _): &StateOf<Self, T>) -> T {
        self.law.wave_modulus(j, stress, state)
    }
}
