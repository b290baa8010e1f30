//! Free fall from rest: u = −½ g t² along the last axis; no strain, no stress, whatever the law.

use super::common::{DIMENSION, GRAVITY};
use super::{Entry, Exact, Material};
use crate::Error;
use crate::parameter::{Parameter, Parameters};
use nalgebra::{Matrix3, Vector3};

/// Free fall of the unit cube.
#[derive(Debug, Clone, Copy)]
pub struct FreeFall {
    /// Density and moduli.
    pub material: Material,
    /// Dimension d.
    pub dimension: usize,
    /// Acceleration of gravity g (m/s²).
    pub gravity: f64,
}

pub(crate) const ENTRY: Entry = Entry {
    name: "free-fall",
    summary: "free fall from rest, d = 1, 2, 3",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(FreeFall::new(p)?)),
};

const PARAMETERS: [Parameter; 5] = Material::parameters(["1e6", "0.3"], [DIMENSION, GRAVITY]);

impl FreeFall {
    /// The solution of the parameters of `free-fall`.
    ///
    /// # Errors
    /// Moduli that the law does not allow.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        Ok(Self { material: Material::new(p)?, dimension: p.number(DIMENSION) as usize, gravity: p.number(GRAVITY) })
    }
}

impl Exact for FreeFall {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.body_force(x, t) * (0.5 * t * t)
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.body_force(x, t) * t
    }

    fn deformation_gradient(&self, _: &Vector3<f64>, _: f64) -> Matrix3<f64> {
        Matrix3::identity()
    }

    fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        let mut b = Vector3::zeros();
        b[self.dimension - 1] = -self.gravity;
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_solves_the_equations_in_every_dimension() {
        for d in ["dimension=1", "dimension=2", "dimension=3"] {
            let s = check::solution(&ENTRY, &[d]);
            check::solves_as_neo_hookean(s.as_ref(), 1.0, |_| true);
        }
    }

    #[test]
    fn a_second_of_fall_is_half_of_g() {
        let s = check::solution(&ENTRY, &["dimension=3", "gravity=10"]);
        let state = crate::State::of(s.as_ref(), &Vector3::zeros(), 1.0);
        assert_eq!((state.u[2], state.v[2], state.b[2]), (-5.0, -10.0, -10.0));
        assert_eq!(state.p, [[0.0; 3]; 3]);
    }
}
