//! Homogeneous finite deformation, in plane strain: the dynamic patch test.
//!
//! x = X + s G (X − c), s = sin ωt, c the centre of the unit square. F = I + s G is the same everywhere,
//! so Div P = 0 and b = a = −ω² u: any scheme that reproduces linear fields gets the stress right. The
//! sides follow the motion. det F = 1 + s tr G + s² det G must stay positive for −1 ≤ s ≤ 1.

use super::common::ANGULAR_FREQUENCY;
use super::{Entry, Exact, INVERTS, Material, sine};
use crate::Error;
use crate::parameter::{Parameter, Parameters, number, parameters};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// Homogeneous finite deformation.
#[derive(Debug, Clone, Copy)]
pub struct Patch {
    /// Density and moduli.
    pub material: Material,
    /// Largest displacement gradient G.
    pub gradient: Matrix2<f64>,
    /// Angular frequency ω (rad/s).
    pub angular_frequency: f64,
}

pub(crate) const ENTRY: Entry = Entry {
    name: "patch",
    summary: "homogeneous finite deformation of the unit square",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(Patch::new(p)?)),
};

parameters! { pub(crate) const:
    G_XX = "g_xx", "-", "0.2", number(-1e2, 1e2, false), "G_xx";
    G_XY = "g_xy", "-", "0.3", number(-1e2, 1e2, false), "G_xy = ∂u_x/∂Y";
    G_YX = "g_yx", "-", "-0.1", number(-1e2, 1e2, false), "G_yx = ∂u_y/∂X";
    G_YY = "g_yy", "-", "0.1", number(-1e2, 1e2, false), "G_yy";
}

const PARAMETERS: [Parameter; 8] =
    Material::parameters(["1e6", "0.3"], [G_XX, G_XY, G_YX, G_YY, ANGULAR_FREQUENCY.with_default("6.283185307179586")]);

impl Patch {
    /// The solution of the parameters of `patch`.
    ///
    /// # Errors
    /// A gradient with which J reaches zero.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let [xx, xy, yx, yy] = [G_XX, G_XY, G_YX, G_YY].map(|g| p.number(g));
        let gradient = Matrix2::new(xx, xy, yx, yy);
        let least = least_jacobian(gradient.trace(), gradient.determinant());
        if least <= 0.0 {
            return Err(Error(format!(
                "parameters g_xx, g_xy, g_yx, g_yy: {xx}, {xy}, {yx}, {yy} {INVERTS}, down to {least}; \
                 allowed: 1 + s (g_xx + g_yy) + s² (g_xx g_yy − g_xy g_yx) above 0 for s from −1 to 1"
            )));
        }
        Ok(Self { material: Material::new(p)?, gradient, angular_frequency: p.number(ANGULAR_FREQUENCY) })
    }

    /// G (X − c) (m).
    fn shape(&self, x: &Vector3<f64>) -> Vector3<f64> {
        (self.gradient * (x.xy() - Vector2::repeat(0.5))).push(0.0)
    }
}

/// The least of 1 + s `trace` + s² `determinant` over −1 ≤ s ≤ 1.
fn least_jacobian(trace: f64, determinant: f64) -> f64 {
    if trace.abs() < 2.0 * determinant {
        1.0 - trace * trace / (4.0 * determinant)
    } else {
        1.0 - trace.abs() + determinant
    }
}

impl Exact for Patch {
    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency, t)[0]
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency, t)[1]
    }

    fn deformation_gradient(&self, _: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let s = sine(self.angular_frequency, t)[0];
        (Matrix2::identity() + s * self.gradient).to_homogeneous()
    }

    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency, t)[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_solves_the_equations() {
        let s = check::solution(&ENTRY, &["g_xx=0.5"]);
        check::solves_as_neo_hookean(s.as_ref(), 1.0, |_| true);
    }

    #[test]
    fn at_a_quarter_of_the_period_the_gradient_is_as_given() {
        let s = check::solution(&ENTRY, &["g_xx=0.1", "g_xy=0.2", "g_yx=0.3", "g_yy=0.4"]);
        let f = s.deformation_gradient(&Vector3::zeros(), 0.25);
        let expected = Matrix3::new(1.1, 0.2, 0.0, 0.3, 1.4, 0.0, 0.0, 0.0, 1.0);
        assert!((f - expected).norm() < 1e-15);
    }

    #[test]
    fn stress_and_strain_are_the_same_everywhere() {
        let s = check::solution(&ENTRY, &[]);
        let (x, y) = (Vector3::new(0.1, 0.2, 0.0), Vector3::new(0.9, 0.4, 0.0));
        assert_eq!(s.first_piola(&x, 0.2), s.first_piola(&y, 0.2));
        assert!(s.first_piola(&x, 0.2).norm() > 1e4);
    }

    #[test]
    fn the_least_jacobian_is_found_and_must_be_positive() {
        for (trace, determinant) in [(0.3, 0.05), (-0.9, 0.5), (0.2, -0.7), (1.7, 0.9)] {
            let sampled = (-1000..=1000)
                .map(|n| f64::from(n) * 1e-3)
                .map(|s| 1.0 + s * trace + s * s * determinant)
                .fold(f64::INFINITY, f64::min);
            assert!((least_jacobian(trace, determinant) - sampled).abs() < 1e-6);
        }
        let p = Parameters::new(&PARAMETERS, &["g_xx=1.2".to_owned()]).unwrap();
        let text = Patch::new(&p).unwrap_err().to_string();
        assert!(text.contains("g_xx") && text.contains("above 0"), "{text}");
    }
}
