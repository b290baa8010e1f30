//! Vortex in a box with a bounded pressure: nearly isochoric, for finding the right pressure and not
//! merely a small one; derived here.
//!
//! Before the point turns as in [the vortex in a box](super::vortex_box), the body is stretched along each axis:
//! X̂_i = X_i + ε sin(kX_i) sin ωt, ε = p₀/(λk), k = 2π, x = x_vortex(X̂, t). So
//! J = Π (1 + ε k cos kX_i sin ωt), and λ ln J → p₀ sin ωt (cos kX + cos kY) as λ → ∞. The sides are
//! rollers. b comes from the generic formula, with F, its gradients and a by the chain rule: with
//! a, b of (X̂, t) and A, B of (X, t),
//!
//! x,AB = Σ_ab x,ab X̂_a,A X̂_b,B + Σ_a x,a X̂_a,AB.

use super::common::ANGULAR_FREQUENCY;
use super::twist::{ANGLE, Vortex};
use super::vortex_box::BOX;
use super::{Entry, Exact, INVERTS, Material, require_below, sine};
use crate::Error;
use crate::parameter::{Parameter, Parameters, number, parameters};
use nalgebra::{Matrix3, Matrix3x4, Matrix4, Vector3};
use std::f64::consts::TAU;

/// Vortex in a box with a bounded pressure.
#[derive(Debug, Clone, Copy)]
pub struct VortexPressure {
    /// The vortex.
    pub vortex: Vortex,
    /// Amplitude p₀ of the pressure (Pa).
    pub pressure: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-vortex-pressure",
    summary: "vortex in the unit square with a pressure that stays bounded as ν → ½",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(VortexPressure::new(p)?)),
};

parameters! { pub const:
    PRESSURE = "pressure", "Pa", "100", number(0.0, 1e12, false), "amplitude p₀ of λ ln J";
}

const PARAMETERS: [Parameter; 6] =
    Material::parameters(["1e3", "0.499"], [ANGLE, ANGULAR_FREQUENCY.with_default("3.141592653589793"), PRESSURE]);

/// The stretched point X̂ with its derivatives.
struct Stretched {
    place: Vector3<f64>,
    /// (X̂, t)_a,A.
    first: Matrix4<f64>,
    /// X̂_i,AB.
    second: [Matrix4<f64>; 3],
}

impl VortexPressure {
    /// The solution of the parameters of `mms-vortex-pressure`.
    ///
    /// # Errors
    /// A pressure of λ or more.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let vortex = Vortex::new(p, BOX)?;
        let pressure = p.number(PRESSURE);
        let limit = vortex.material.lambda;
        if pressure != 0.0 {
            require_below(["pressure", "Pa", INVERTS], pressure, limit)?;
        }
        Ok(Self { vortex, pressure })
    }

    fn stretched(&self, x: &Vector3<f64>, t: f64) -> Stretched {
        // Without a pressure nothing is stretched, whatever λ is.
        let epsilon = match self.pressure == 0.0 {
            true => 0.0,
            false => self.pressure / (self.vortex.material.lambda * TAU),
        };
        let [s, s_t, s_tt] = sine(self.vortex.angular_frequency, t).map(|s| epsilon * s);
        let mut place = *x;
        let mut first = Matrix4::identity();
        let mut second = [Matrix4::zeros(); 3];
        for i in 0..2 {
            let (sin, cos) = (TAU * x[i]).sin_cos();
            place[i] += sin * s;
            first[(i, i)] += TAU * cos * s;
            first[(i, 3)] = sin * s_t;
            second[i][(i, i)] = -TAU * TAU * sin * s;
            second[i][(i, 3)] = TAU * cos * s_t;
            second[i][(3, i)] = TAU * cos * s_t;
            second[i][(3, 3)] = sin * s_tt;
        }
        Stretched { place, first, second }
    }

    /// F in the first three columns, v (m/s) in the last.
    fn first_derivatives(&self, x: &Vector3<f64>, t: f64) -> Matrix3x4<f64> {
        let inner = self.stretched(x, t);
        self.vortex.twist(&inner.place, t).first_derivatives() * inner.first
    }
}

impl Exact for VortexPressure {
    fn material(&self) -> Material {
        self.vortex.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let place = self.stretched(x, t).place;
        place - x + self.vortex.displacement(&place, t)
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.first_derivatives(x, t).column(3).into_owned()
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let all = self.first_derivatives(x, t);
        all.fixed_columns::<3>(0).into_owned()
    }

    fn jacobian(&self, x: &Vector3<f64>, t: f64) -> f64 {
        let stretch = self.stretched(x, t).first;
        stretch[(0, 0)] * stretch[(1, 1)]
    }

    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let inner = self.stretched(x, t);
        let twist = self.vortex.twist(&inner.place, t);
        let outer = twist.first_derivatives();
        let bent = twist.second_derivatives();
        let second = [0, 1, 2].map(|k| {
            let chain = inner.first.transpose() * bent[k] * inner.first;
            chain + (0..3).map(|i| outer[(k, i)] * inner.second[i]).sum::<Matrix4<f64>>()
        });
        let f = (outer * inner.first).fixed_columns::<3>(0).into_owned();
        let g = [0, 1, 2].map(|j| Matrix3::from_fn(|k, l| second[k][(l, j)]));
        let a = Vector3::from_fn(|k, _| second[k][(3, 3)]);
        self.vortex.material.body_force(&f, &g, &a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_solves_the_equations_between_rollers() {
        for set in [["poisson_ratio=0.3", "pressure=200"], ["poisson_ratio=0.499", "pressure=100"]] {
            let s = check::solution(&ENTRY, &set);
            check::solves_as_neo_hookean(s.as_ref(), 2.0, |x| ((x.x - 0.5).hypot(x.y - 0.5) - 0.4).abs() > 0.1);
            check::between_rollers(s.as_ref(), 2.0);
        }
    }

    #[test]
    fn the_pressure_stays_bounded_as_lambda_grows() {
        let s = check::solution(&ENTRY, &["poisson_ratio=0.499999"]);
        let x = Vector3::new(0.1, 0.25, 0.0);
        let pressure = s.material().lambda * s.jacobian(&x, 0.5).ln();
        let limit = 100.0 * ((TAU * 0.1).cos() + (TAU * 0.25).cos());
        assert!((pressure - limit).abs() < 1e-3 * limit, "{pressure} {limit}");
    }

    #[test]
    fn a_pressure_of_lambda_is_refused() {
        let set = ["poisson_ratio=0.3".to_owned(), "pressure=600".to_owned()];
        let p = Parameters::new(&PARAMETERS, &set).unwrap();
        let text = VortexPressure::new(&p).unwrap_err().to_string();
        assert!(text.contains("pressure") && text.contains("576.9"), "{text}");
    }
}
