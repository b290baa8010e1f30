//! Two shears one after the other on the periodic unit cell: isochoric; derived here.
//!
//! With s = sin ωt: x = X + A s sin kY, y = Y + A s sin kx, where the second shear sees the current x.
//! With p = ∂x/∂Y = A k s cos kY and q = ∂y/∂x = A k s cos kx:
//!
//! F = \[1, p; q, 1 + pq\], J = 1, P = μ \[−pq, p + q; p + q, pq\],
//! Div P = μ (p₁, q₁ + p₁ q + p² q₁), p₁ = ∂p/∂Y, q₁ = ∂q/∂x.
//!
//! The cell is periodic in both directions; no amplitude inverts it.

use super::common::{AMPLITUDE, ANGULAR_FREQUENCY};
use super::{Entry, Exact, Material, sine};
use crate::Error;
use crate::parameter::{Parameter, Parameters};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Double shear of the periodic unit cell.
#[derive(Debug, Clone, Copy)]
pub struct DoubleShear {
    /// Density and moduli.
    pub material: Material,
    /// Amplitude A (m).
    pub amplitude: f64,
    /// Angular frequency ω (rad/s).
    pub angular_frequency: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-double-shear",
    summary: "two isochoric shears of the periodic unit cell",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(DoubleShear::new(p)?)),
};

const PARAMETERS: [Parameter; 5] =
    Material::parameters(["1e3", "0.4999"], [AMPLITUDE, ANGULAR_FREQUENCY.with_default("3.141592653589793")]);

/// Wave number k (1/m).
const K: f64 = TAU;

impl DoubleShear {
    /// The solution of the parameters of `mms-double-shear`.
    ///
    /// # Errors
    /// Moduli that the law does not allow.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        Ok(Self {
            material: Material::new(p)?,
            amplitude: p.number(AMPLITUDE),
            angular_frequency: p.number(ANGULAR_FREQUENCY),
        })
    }

    /// A s with its first and second derivative in time.
    fn growth(&self, t: f64) -> [f64; 3] {
        sine(self.angular_frequency, t).map(|s| self.amplitude * s)
    }

    /// p and q.
    fn shears(&self, x: &Vector3<f64>, t: f64) -> (f64, f64) {
        let [s, ..] = self.growth(t);
        let current = x.x + s * (K * x.y).sin();
        (s * K * (K * x.y).cos(), s * K * (K * current).cos())
    }
}

impl Exact for DoubleShear {
    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let [s, ..] = self.growth(t);
        let u = s * (K * x.y).sin();
        Vector3::new(u, s * (K * (x.x + u)).sin(), 0.0)
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let [s, s_t, _] = self.growth(t);
        let sin_y = (K * x.y).sin();
        let v = s_t * sin_y;
        let (sin, cos) = (K * (x.x + s * sin_y)).sin_cos();
        Vector3::new(v, s * K * v * cos + s_t * sin, 0.0)
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let (p, q) = self.shears(x, t);
        Matrix3::new(1.0, p, 0.0, q, 1.0 + p * q, 0.0, 0.0, 0.0, 1.0)
    }

    fn jacobian(&self, _: &Vector3<f64>, _: f64) -> f64 {
        1.0
    }

    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let (p, q) = self.shears(x, t);
        self.material.mu * Matrix3::new(-p * q, p + q, 0.0, p + q, p * q, 0.0, 0.0, 0.0, 0.0)
    }

    /// b = a − Div P/ρ₀, with ẋ and ẍ of the first shear in
    /// a_y = A \[s (k ẍ cos kx − k² ẋ² sin kx) + 2 ṡ k ẋ cos kx + s̈ sin kx\].
    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let [s, s_t, s_tt] = self.growth(t);
        let sin_y = (K * x.y).sin();
        let (sin, cos) = (K * (x.x + s * sin_y)).sin_cos();
        let (rate, a_x) = (s_t * sin_y, s_tt * sin_y);
        let a_y = s * (K * a_x * cos - (K * rate).powi(2) * sin) + 2.0 * s_t * K * rate * cos + s_tt * sin;
        let (p, q) = self.shears(x, t);
        let (p1, q1) = (-s * K * K * sin_y, -s * K * K * sin);
        let c2 = self.material.mu / self.material.density;
        Vector3::new(a_x - c2 * p1, a_y - c2 * (q1 + p1 * q + p * p * q1), 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_solves_the_equations() {
        let s = check::solution(&ENTRY, &[]);
        check::solves_as_neo_hookean(s.as_ref(), 2.0, |_| true);
    }

    #[test]
    fn it_is_periodic() {
        let s = check::solution(&ENTRY, &[]);
        let x = Vector3::new(0.3, 0.4, 0.0);
        for shift in [Vector3::x(), Vector3::y()] {
            let (here, there) = (s.displacement(&x, 0.4), s.displacement(&(x + shift), 0.4));
            assert!((here - there).norm() < 1e-15);
            assert!((s.body_force(&x, 0.4) - s.body_force(&(x + shift), 0.4)).norm() < 1e-12);
        }
    }
}
