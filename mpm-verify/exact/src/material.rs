//! The neo-Hookean solid of the manufactured solutions, and the force that makes any motion a solution.
//!
//! W = μ/2 (I₁ − 3 − 2 ln J) + λ/2 (ln J)², so P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ. Balance of momentum in the
//! reference configuration, ρ₀ a = Div P + ρ₀ b, read the other way round gives the body force
//! b = a − Div P/ρ₀ of a motion that is chosen (the method of manufactured solutions, Roache 2002,
//! doi:10.1115/1.1436090).

use super::common::{DENSITY, POISSON_RATIO, YOUNG_MODULUS};
use crate::Error;
use crate::parameter::{Parameter, Parameters};
use mpm_core::material::NeoHookean;
use nalgebra::{Matrix3, Vector3};

/// Density and Lamé's parameters of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Density ρ₀ in the reference configuration (kg/m³).
    pub density: f64,
    /// Shear modulus μ (Pa); zero for a fluid.
    pub mu: f64,
    /// Lamé's first parameter λ (Pa): the bulk modulus of a fluid, infinite for an incompressible one.
    pub lambda: f64,
}

impl Material {
    /// From Young's modulus, Poisson's ratio and density, as in [`Material::parameters`].
    ///
    /// # Errors
    /// Moduli that the law does not allow.
    pub(super) fn new(parameters: &Parameters) -> Result<Self, Error> {
        let law = NeoHookean::new(parameters.number(YOUNG_MODULUS), parameters.number(POISSON_RATIO))
            .map_err(|refused| Error(refused.to_string()))?;
        Ok(Self { density: parameters.number(DENSITY), mu: law.mu, lambda: law.lambda })
    }

    /// Young's modulus, Poisson's ratio and density, with defaults for the first two, and then those of a motion.
    pub(super) const fn parameters<const N: usize, const ALL: usize>(
        [young_modulus, poisson_ratio]: [&'static str; 2],
        of_motion: [Parameter; N],
    ) -> [Parameter; ALL] {
        let mut all = [DENSITY; ALL];
        all[0] = YOUNG_MODULUS.with_default(young_modulus);
        all[1] = POISSON_RATIO.with_default(poisson_ratio);
        let mut k = 0;
        while k < N {
            all[3 + k] = of_motion[k];
            k += 1;
        }
        all
    }

    /// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ (Pa).
    #[must_use]
    pub fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let (inverse_transpose, ln_j) = inverse_transpose(f);
        self.mu * (f - inverse_transpose) + self.lambda * ln_j * inverse_transpose
    }

    /// ∂P_ii/∂F_ii = μ + (μ + λ (1 − ln J))/F_ii² (Pa) of a diagonal F.
    #[must_use]
    pub(super) fn axial_tangent(&self, f_ii: f64, ln_j: f64) -> f64 {
        self.mu + (self.mu + self.lambda * (1.0 - ln_j)) / (f_ii * f_ii)
    }

    /// Div P (N/m³) of any motion, from F and its gradients G_j = ∂F/∂X_j (1/m):
    ///
    /// (Div P)_i = Σ_j \[μ G_j + (μ − λ ln J) F⁻ᵀ G_jᵀ F⁻ᵀ + λ (F⁻ᵀ : G_j) F⁻ᵀ\]_ij,
    ///
    /// as dF⁻ᵀ = −F⁻ᵀ dFᵀ F⁻ᵀ and d ln J = F⁻ᵀ : dF.
    #[must_use]
    pub fn divergence(&self, f: &Matrix3<f64>, g: &[Matrix3<f64>; 3]) -> Vector3<f64> {
        let (f_inv_t, ln_j) = inverse_transpose(f);
        (0..3)
            .map(|j| {
                let dp = self.mu * g[j]
                    + (self.mu - self.lambda * ln_j) * f_inv_t * g[j].transpose() * f_inv_t
                    + self.lambda * f_inv_t.dot(&g[j]) * f_inv_t;
                dp.column(j).into_owned()
            })
            .sum()
    }

    /// The body force b = a − Div P/ρ₀ (m/s²) that any motion of acceleration `a` (m/s²) needs.
    #[must_use]
    pub fn body_force(&self, f: &Matrix3<f64>, g: &[Matrix3<f64>; 3], a: &Vector3<f64>) -> Vector3<f64> {
        a - self.divergence(f, g) / self.density
    }
}

/// F⁻ᵀ = cof F / J, and ln J. Not a number where J ≤ 0, which no solution allows.
fn inverse_transpose(f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
    let columns = [f.column(0), f.column(1), f.column(2)];
    let cofactor = Matrix3::from_columns(&[
        columns[1].cross(&columns[2]),
        columns[2].cross(&columns[0]),
        columns[0].cross(&columns[1]),
    ]);
    let j = columns[0].dot(&cofactor.column(0));
    (cofactor / j, j.ln())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_core::material::Law;

    const RUBBER: Material = Material { density: 1000.0, mu: 3.0e5, lambda: 2.0e6 };

    /// P = J σ F⁻ᵀ with the stress of the solver's own law.
    #[test]
    fn the_law_is_the_solvers() {
        let f = Matrix3::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.3, -0.2, 0.1, 1.2);
        let law = NeoHookean { mu: RUBBER.mu, lambda: RUBBER.lambda };
        let sigma = law.response(&f, 1.0, &law.initial_state()).0.to_matrix();
        let expected = f.determinant() * sigma * f.try_inverse().unwrap().transpose();
        assert!((RUBBER.first_piola(&f) - expected).norm() < 1e-9 * expected.norm());
    }
}
