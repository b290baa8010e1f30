//! Rigid motions: no strain, no stress, whatever the law.
//!
//! Translation x = X + v t needs no force. Rotation about c with the angular velocity Ω,
//! x = c + Q(Ωt) (X − c), needs the centripetal b = −Ω² (x − c).

use super::{Entry, Exact, Material};
use crate::Error;
use crate::parameter::{Parameter, Parameters, number, parameters};
use nalgebra::{Matrix3, Vector3};

/// Translation of the unit square.
#[derive(Debug, Clone, Copy)]
pub struct Translation {
    /// Density and moduli.
    pub material: Material,
    /// Velocity v (m/s).
    pub velocity: Vector3<f64>,
}

/// Rotation of the unit square.
#[derive(Debug, Clone, Copy)]
pub struct Rotation {
    /// Density and moduli.
    pub material: Material,
    /// Angular velocity Ω (rad/s), counter-clockwise.
    pub angular_velocity: f64,
    /// Centre c (m).
    pub centre: Vector3<f64>,
}

pub(crate) const TRANSLATION: Entry = Entry {
    name: "rigid-translation",
    summary: "translation of the unit square",
    parameters: &TRANSLATION_PARAMETERS,
    build: |p| Ok(Box::new(Translation::new(p)?)),
};

pub(crate) const ROTATION: Entry = Entry {
    name: "rigid-rotation",
    summary: "rotation of the unit square about a point, with the centripetal force",
    parameters: &ROTATION_PARAMETERS,
    build: |p| Ok(Box::new(Rotation::new(p)?)),
};

parameters! { pub(crate) const:
    VELOCITY_X = "velocity_x", "m/s", "1", number(-1e4, 1e4, false), "velocity in x";
    VELOCITY_Y = "velocity_y", "m/s", "0.5", number(-1e4, 1e4, false), "velocity in y";
    ANGULAR_VELOCITY = "angular_velocity", "rad/s", "1", number(-1e4, 1e4, false),
        "angular velocity Ω, counter-clockwise";
    CENTRE_X = "centre_x", "m", "0.5", number(-1e3, 1e3, false), "centre c in x";
    CENTRE_Y = "centre_y", "m", "0.5", number(-1e3, 1e3, false), "centre c in y";
}

const TRANSLATION_PARAMETERS: [Parameter; 5] = Material::parameters(["1e6", "0.3"], [VELOCITY_X, VELOCITY_Y]);

const ROTATION_PARAMETERS: [Parameter; 6] =
    Material::parameters(["1e6", "0.3"], [ANGULAR_VELOCITY, CENTRE_X, CENTRE_Y]);

impl Translation {
    /// The solution of the parameters of `rigid-translation`.
    ///
    /// # Errors
    /// Moduli that the law does not allow.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        Ok(Self {
            material: Material::new(p)?,
            velocity: Vector3::new(p.number(VELOCITY_X), p.number(VELOCITY_Y), 0.0),
        })
    }
}

impl Exact for Translation {
    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, _: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.velocity * t
    }

    fn velocity(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        self.velocity
    }

    fn deformation_gradient(&self, _: &Vector3<f64>, _: f64) -> Matrix3<f64> {
        Matrix3::identity()
    }

    fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::zeros()
    }
}

impl Rotation {
    /// The solution of the parameters of `rigid-rotation`.
    ///
    /// # Errors
    /// Moduli that the law does not allow.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        Ok(Self {
            material: Material::new(p)?,
            angular_velocity: p.number(ANGULAR_VELOCITY),
            centre: Vector3::new(p.number(CENTRE_X), p.number(CENTRE_Y), 0.0),
        })
    }

    /// x − c (m).
    fn arm(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.deformation_gradient(x, t) * (Vector3::new(x.x, x.y, 0.0) - self.centre)
    }
}

impl Exact for Rotation {
    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.arm(x, t) - self.arm(x, 0.0)
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        (self.angular_velocity * Vector3::z()).cross(&self.arm(x, t))
    }

    fn deformation_gradient(&self, _: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let (sin, cos) = (self.angular_velocity * t).sin_cos();
        Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
    }

    fn jacobian(&self, _: &Vector3<f64>, _: f64) -> f64 {
        1.0
    }

    fn first_piola(&self, _: &Vector3<f64>, _: f64) -> Matrix3<f64> {
        Matrix3::zeros()
    }

    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        -self.angular_velocity.powi(2) * self.arm(x, t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn they_solve_the_equations() {
        let s = check::solution(&TRANSLATION, &[]);
        check::solves_as_neo_hookean(s.as_ref(), 1.0, |_| true);
        let s = check::solution(&ROTATION, &["angular_velocity=-3", "centre_x=0.2"]);
        check::solves_as_neo_hookean(s.as_ref(), 2.0, |_| true);
    }

    #[test]
    fn a_rotation_keeps_its_centre_and_all_distances() {
        let s = check::solution(&ROTATION, &["centre_x=0.2"]);
        let centre = Vector3::new(0.2, 0.5, 0.0);
        assert!(s.displacement(&centre, 0.7).norm() < 1e-15);
        let x = Vector3::new(0.9, 0.1, 0.0);
        let moved = x + s.displacement(&x, 0.7) - centre;
        assert!((moved.norm() - (x - centre).norm()).abs() < 1e-15);
        assert!(s.velocity(&x, 0.7).dot(&moved).abs() < 1e-15);
    }
}
