//! Axis-aligned displacement with a pressure gradient normal to the walls; derived here.
//!
//! The cosine of [`super::AxisAligned`] makes ∂J/∂n = 0 at the walls, which hides what a basis or an
//! average of J does there. A parabola doesn't: on the cube \[0, 1\]^d
//!
//! u_i = 4A X_i (1 − X_i) s, s = sin ωt, F_ii = 1 + 4A (1 − 2X_i) s, F_ij = 0 (i ≠ j),
//!
//! so ∂F_ii/∂X_i = −8A s everywhere, and ∂p/∂n is largest at the walls. P is diagonal and P_ii depends
//! on F_ii and J alone, of which F_ii(X_i) is all that changes along X_i:
//! ∂P_ii/∂X_i = −8A s \[μ + (μ + λ (1 − ln J))/F_ii²\]. With a_i = −ω² u_i:
//!
//! b_i = −ω² u_i + (8A s/ρ₀) \[μ + (μ + λ (1 − ln J))/F_ii²\].
//!
//! u_i = 0 where X_i = 0 or 1, and no shear traction acts: rollers on all sides are exact. F_ii > 0
//! as long as 4A < 1.

use super::common::{AMPLITUDE, ANGULAR_FREQUENCY, DIMENSION};
use super::{Entry, Exact, INVERTS, Material, require_below, sine};
use crate::Error;
use crate::parameter::{Parameter, Parameters};
use nalgebra::{Matrix3, Vector3};

/// Axis-aligned displacement with a pressure gradient normal to the walls.
#[derive(Debug, Clone, Copy)]
pub struct WallPressure {
    /// Density and moduli.
    pub material: Material,
    /// Dimension d.
    pub dimension: usize,
    /// Amplitude A (m): the displacement half way between the walls.
    pub amplitude: f64,
    /// Angular frequency ω (rad/s).
    pub angular_frequency: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-wall-pressure",
    summary: "axis-aligned displacement with a pressure gradient normal to the walls, d = 1, 2, 3",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(WallPressure::new(p)?)),
};

const PARAMETERS: [Parameter; 6] =
    Material::parameters(["1e7", "0.3"], [DIMENSION, AMPLITUDE, ANGULAR_FREQUENCY.with_default("314.1592653589793")]);

impl WallPressure {
    /// The solution of the parameters of `mms-wall-pressure`.
    ///
    /// # Errors
    /// An amplitude with which F_ii reaches zero.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let amplitude = p.number(AMPLITUDE);
        require_below(["amplitude", "m", INVERTS], amplitude, 0.25)?;
        Ok(Self {
            material: Material::new(p)?,
            dimension: p.number(DIMENSION) as usize,
            amplitude,
            angular_frequency: p.number(ANGULAR_FREQUENCY),
        })
    }

    /// 4A X_i (1 − X_i) on the axes of the motion (m).
    fn shape(&self, x: &Vector3<f64>) -> Vector3<f64> {
        Vector3::from_fn(|i, _| if i < self.dimension { 4.0 * self.amplitude * x[i] * (1.0 - x[i]) } else { 0.0 })
    }
}

impl Exact for WallPressure {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency, t)[0]
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency, t)[1]
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let s = sine(self.angular_frequency, t)[0];
        let mut f = Matrix3::identity();
        for i in 0..self.dimension {
            f[(i, i)] += 4.0 * self.amplitude * (1.0 - 2.0 * x[i]) * s;
        }
        f
    }

    /// b_i = −ω² u_i + (8A s/ρ₀) \[μ + (μ + λ (1 − ln J))/F_ii²\].
    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let [s, _, acceleration] = sine(self.angular_frequency, t);
        let f = self.deformation_gradient(x, t);
        let ln_j = f.determinant().ln();
        let mut b = self.shape(x) * acceleration;
        for i in 0..self.dimension {
            b[i] += 8.0 * self.amplitude * s / self.material.density * self.material.axial_tangent(f[(i, i)], ln_j);
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_solves_the_equations_between_rollers_in_every_dimension() {
        for d in ["1", "2", "3"] {
            let s = check::solution(&ENTRY, &[&format!("dimension={d}"), "amplitude=0.1"]);
            check::solves_as_neo_hookean(s.as_ref(), 0.02, |_| true);
            check::between_rollers(s.as_ref(), 0.02);
        }
    }

    /// Purpose of the solution: ∂σ_m/∂n at a wall is as large as inside.
    #[test]
    fn the_pressure_has_a_gradient_normal_to_the_walls() {
        let s = check::solution(&ENTRY, &[]);
        let slope = |x: f64| {
            let mean = |x: f64| s.mean_stress(&Vector3::new(x, 0.3, 0.0), 0.005);
            (mean(x + 1e-4) - mean(x - 1e-4)) / 2e-4
        };
        assert!(slope(1e-3).abs() > 0.5 * slope(0.5).abs());
        assert!(slope(1.0 - 1e-3).abs() > 0.5 * slope(0.5).abs());
    }
}
