//! Layer of a neo-Hookean solid at rest on an incline, deformed finitely; derived here.
//!
//! Nothing changes along the layer, x = X + u(Y), y = Y + v(Y): F has u′ beside the diagonal and J = 1 + v′ on it. Gravity
//! g acts at the angle θ from the layer's normal. With q(J) = μ (J − 1/J) + λ (ln J)/J balance reads
//!
//! P_xY = μ u′ = ρ₀ g sin θ (H − Y), P_yY = q(J) = −ρ₀ g cos θ (H − Y),
//!
//! the first of which is u = ρ₀ g sin θ Y (2H − Y)/(2μ). From the second dY = q′ dJ/(ρ₀ g cos θ), so that with the stored
//! energy W(J) = μ ((J² − 1)/2 − ln J) + λ (ln J)²/2, W′ = q,
//!
//! v = ∫₀^Y (J − 1) dY = [(J − 1) q − W] / (ρ₀ g cos θ), from the foot's J to that of Y.
//!
//! The foot is fixed, the surface free, the sides are one.

use super::common::{GRAVITY, POISSON_RATIO, YOUNG_MODULUS};
use super::{Entry, Exact, Material};
use crate::Error;
use crate::parameter::{Parameter, Parameters, number, parameters};
use nalgebra::{Matrix3, Vector3};

/// Layer on an incline, in plane strain.
#[derive(Debug, Clone, Copy)]
pub struct Incline {
    material: Material,
    /// Acceleration of gravity along the layer and against its normal (m/s²).
    gravity: [f64; 2],
    /// Length of a period and height of the layer without gravity (m).
    size: [f64; 2],
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "incline",
    summary: "layer at rest on an incline under its weight, finite deformation",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(Incline::new(p)?)),
};

parameters! { pub const:
    INCLINATION = "inclination", "°", "30", number(0.0, 80.0, false), "angle θ of the layer from the horizontal";
    LENGTH = "length", "m", "1", number(1e-3, 1e3, false), "length of a period along the layer";
    THICKNESS = "thickness", "m", "2", number(1e-3, 1e3, false), "height H of the layer without gravity";
}

const PARAMETERS: [Parameter; 7] = Material::parameters(["1e7", "0.49"], [GRAVITY, INCLINATION, LENGTH, THICKNESS]);

/// Newton steps to J, which a monotonic q reaches in a few.
const ITERATIONS: usize = 30;

impl Incline {
    /// The solution of the parameters of `incline`.
    ///
    /// # Errors
    /// Moduli that the law does not allow; a layer that sinks by more than a tenth of its height at the foot.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let angle = p.number(INCLINATION).to_radians();
        let gravity = p.number(GRAVITY);
        let layer = Self {
            material: Material::new(p)?,
            gravity: [gravity * angle.sin(), gravity * angle.cos()],
            size: [p.number(LENGTH), p.number(THICKNESS)],
        };
        let (young, ratio) = (p.number(YOUNG_MODULUS), p.number(POISSON_RATIO));
        let weight = layer.weight(1, 0.0);
        if weight > 0.1 * young {
            return Err(Error(format!(
                "young_modulus = {young} with poisson_ratio = {ratio} bears {weight:e} Pa at the foot badly; allowed: at \
                 least ten times that"
            )));
        }
        Ok(layer)
    }

    /// Load along an axis at the height `y` (Pa).
    fn weight(&self, axis: usize, y: f64) -> f64 {
        self.material.density * self.gravity[axis] * (self.size[1] - y)
    }

    /// J − 1 at the height `y` (m).
    fn growth(&self, y: f64) -> f64 {
        let Material { mu, lambda, .. } = self.material;
        let target = -self.weight(1, y);
        let mut e = 0.0_f64;
        for _ in 0..ITERATIONS {
            let (j, log) = (1.0 + e, e.ln_1p());
            let slope = mu * (1.0 + 1.0 / (j * j)) + lambda * (1.0 - log) / (j * j);
            e -= (self.stress(e) - target) / slope;
        }
        e
    }

    /// q (Pa) at J − 1 = `e`.
    fn stress(&self, e: f64) -> f64 {
        let Material { mu, lambda, .. } = self.material;
        (mu * e * (2.0 + e) + lambda * e.ln_1p()) / (1.0 + e)
    }

    /// (J − 1) q − W (Pa) there.
    fn complement(&self, e: f64) -> f64 {
        let Material { mu, lambda, .. } = self.material;
        let log = e.ln_1p();
        e * self.stress(e) - mu * (e + 0.5 * e * e - log) - 0.5 * lambda * log * log
    }
}

impl Exact for Incline {
    fn material(&self) -> Material {
        self.material
    }

    fn extent(&self) -> [[f64; 2]; 3] {
        [[0.0, self.size[0]], [0.0, self.size[1]], [0.0; 2]]
    }

    fn displacement(&self, x: &Vector3<f64>, _: f64) -> Vector3<f64> {
        let y = x.y;
        let along = self.material.density * self.gravity[0] * y * (2.0 * self.size[1] - y) / (2.0 * self.material.mu);
        let weight = self.material.density * self.gravity[1];
        let sunk = if weight > 0.0 {
            let of = |y: f64| self.complement(self.growth(y));
            (of(y) - of(0.0)) / weight
        } else {
            0.0
        };
        Vector3::new(along, sunk, 0.0)
    }

    fn velocity(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, _: f64) -> Matrix3<f64> {
        let mut f = Matrix3::identity();
        f[(0, 1)] = self.weight(0, x.y) / self.material.mu;
        f[(1, 1)] += self.growth(x.y);
        f
    }

    fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::new(self.gravity[0], -self.gravity[1], 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_balances_gravity_at_any_angle() {
        for angle in ["inclination=0", "inclination=30", "inclination=80"] {
            for young in ["young_modulus=1e7", "young_modulus=3e5"] {
                let s = check::solution(&ENTRY, &[angle, young]);
                check::solves_as_neo_hookean(s.as_ref(), 1.0, |_| true);
            }
        }
    }

    #[test]
    fn the_foot_stays_and_the_surface_is_free() {
        let s = check::solution(&ENTRY, &["young_modulus=3e5"]);
        let at = |y: f64| Vector3::new(0.3, y, 0.0);
        assert!(s.displacement(&at(0.0), 0.0).norm() < 1e-15);
        let traction = s.first_piola(&at(2.0), 0.0).column(1).into_owned();
        assert!(traction.norm() < 1e-9);
        assert!(s.displacement(&at(2.0), 0.0).y < -1e-4);
    }

    #[test]
    fn a_layer_too_soft_is_refused() {
        let p = Parameters::new(&PARAMETERS, &["young_modulus=1e5".to_owned()]).unwrap();
        assert!(Incline::new(&p).unwrap_err().to_string().contains("young_modulus"));
    }
}
