//! Column of nearly incompressible fluid at rest under its weight, compressed finitely; derived here.
//!
//! The fluid has p = −K (J − 1) and the reference height H. Nothing moves sideways, so F = diag(1, J, 1)
//! and P = −p J F⁻ᵀ = −p diag(J, 1, J). Balance, ∂P_YY/∂Y = ρ₀ g, is ∂p/∂Y = −ρ₀ g: in the reference
//! height the pressure is linear, however large the compression. With p = 0 at the surface
//!
//! p = ρ₀ g (H − Y), J = 1 − p/K, u = ∫₀^Y (J − 1) dY = −ρ₀ g Y (2H − Y)/(2K).
//!
//! Rollers on the floor and the sides, a free surface. J > 0 as long as ρ₀ g H < K.

use super::common::{DENSITY, GRAVITY};
use super::{Entry, Exact, INVERTS, Material, require_below};
use crate::Error;
use crate::parameter::{Parameter, Parameters, number, parameters};
use nalgebra::{Matrix3, Vector3};

/// Column of fluid at rest, in plane strain.
#[derive(Debug, Clone, Copy)]
pub struct Hydrostatic {
    /// Density ρ₀ without pressure (kg/m³).
    pub density: f64,
    /// Bulk modulus K (Pa).
    pub bulk_modulus: f64,
    /// Acceleration of gravity g (m/s²).
    pub gravity: f64,
    /// Width (m).
    pub width: f64,
    /// Height H without gravity (m).
    pub height: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "hydrostatic",
    summary: "column of fluid at rest under its weight, finite compression",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(Hydrostatic::new(p)?)),
};

parameters! { pub const:
    BULK_MODULUS = "bulk_modulus", "Pa", "2e9", number(1e-3, 1e12, false), "bulk modulus K";
    WIDTH = "width", "m", "1", number(1e-3, 1e3, false), "width";
    HEIGHT = "height", "m", "2", number(1e-3, 1e3, false), "height H without gravity";
}

const PARAMETERS: [Parameter; 5] = [BULK_MODULUS, DENSITY.with_default("997.5"), GRAVITY, WIDTH, HEIGHT];

impl Hydrostatic {
    /// The solution of the parameters of `hydrostatic`.
    ///
    /// # Errors
    /// A height at which the floor would carry more than K.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let column = Self {
            density: p.number(DENSITY),
            bulk_modulus: p.number(BULK_MODULUS),
            gravity: p.number(GRAVITY),
            width: p.number(WIDTH),
            height: p.number(HEIGHT),
        };
        column.upright("height")
    }

    /// The same, its height being the parameter of that name.
    ///
    /// # Errors
    /// A height at which the floor would carry more than K.
    pub fn upright(self, height: &str) -> Result<Self, Error> {
        let limit = self.bulk_modulus / (self.density * self.gravity);
        require_below([height, "m", INVERTS], self.height, limit)?;
        Ok(self)
    }

    /// Pressure p (Pa) at the reference height `y` (m).
    #[must_use]
    pub fn pressure(&self, y: f64) -> f64 {
        self.density * self.gravity * (self.height - y)
    }
}

impl Exact for Hydrostatic {
    fn material(&self) -> Material {
        Material { density: self.density, mu: 0.0, lambda: self.bulk_modulus }
    }

    fn extent(&self) -> [[f64; 2]; 3] {
        [[0.0, self.width], [0.0, self.height], [0.0; 2]]
    }

    fn displacement(&self, x: &Vector3<f64>, _: f64) -> Vector3<f64> {
        let weight = self.density * self.gravity;
        let sunk = weight * x.y * (2.0 * self.height - x.y) / (2.0 * self.bulk_modulus);
        Vector3::new(0.0, -sunk, 0.0)
    }

    fn velocity(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        Matrix3::from_diagonal(&Vector3::new(1.0, self.jacobian(x, t), 1.0))
    }

    fn jacobian(&self, x: &Vector3<f64>, _: f64) -> f64 {
        1.0 - self.pressure(x.y) / self.bulk_modulus
    }

    /// P = −p diag(J, 1, J).
    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let j = self.jacobian(x, t);
        -self.pressure(x.y) * Matrix3::from_diagonal(&Vector3::new(j, 1.0, j))
    }

    fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::new(0.0, -self.gravity, 0.0)
    }

    fn mean_stress(&self, x: &Vector3<f64>, _: f64) -> f64 {
        -self.pressure(x.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_balances_gravity_at_any_compression() {
        for k in ["bulk_modulus=2e9", "bulk_modulus=4e4"] {
            let s = check::solution(&ENTRY, &[k]);
            check::solves(s.as_ref(), 1.0, |_| true);
            for y in [0.0, 0.3, 1.0, 2.0] {
                let x = Vector3::new(0.5, y, 0.0);
                let (f, p) = (s.deformation_gradient(&x, 0.0), s.first_piola(&x, 0.0));
                let j = f.determinant();
                let k = s.material().lambda;
                let law = k * (j - 1.0) * j * f.try_inverse().unwrap().transpose();
                // J − 1 has lost what is below the last bit of J.
                assert!((p - law).norm() < 1e-14 * k, "{p} {law}");
                assert!((s.mean_stress(&x, 0.0) - k * (j - 1.0)).abs() < 1e-14 * k);
            }
        }
    }

    #[test]
    fn the_floor_stays_the_sides_stay_and_the_surface_is_free() {
        let s = check::solution(&ENTRY, &[]);
        assert_eq!(s.displacement(&Vector3::new(0.3, 0.0, 0.0), 0.0).y, 0.0);
        assert_eq!(s.displacement(&Vector3::new(0.0, 1.3, 0.0), 0.0).x, 0.0);
        assert_eq!(s.mean_stress(&Vector3::new(0.3, 2.0, 0.0), 0.0), 0.0);
    }

    #[test]
    fn a_column_that_crushes_its_floor_is_refused() {
        let set = ["bulk_modulus=1e4".to_owned()];
        let p = Parameters::new(&PARAMETERS, &set).unwrap();
        let text = Hydrostatic::new(&p).unwrap_err().to_string();
        assert!(text.contains("height") && text.contains("below 1.02"), "{text}");
    }
}
