//! Vortex in a box: isochoric, no curved boundary; derived here from the vortex in a ring.
//!
//! On the unit square a point turns about the centre by α = α₀ sin ωt · h(R), h = (1 − R²/R₀²)⁴ for R < R₀ = 0.4 m,
//! zero beyond: smooth except for the fourth derivative at R₀, so b has two. The sides are fixed (rollers are exact
//! too). u, b and P do not depend on λ: the error at ν → ½ over that at ν = 0.3 is a direct measure of locking, and σ_m
//! − μ (R α_R)²/3, zero in the exact solution, is another.

use super::common::ANGULAR_FREQUENCY;
use super::twist::{ANGLE, PLANE, Place, Shape, Vortex};
use super::{Entry, Material};
use crate::parameter::Parameter;

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-vortex-box",
    summary: "isochoric vortex in the unit square",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(Vortex::new(p, BOX)?)),
};

const PARAMETERS: [Parameter; 5] =
    Material::parameters(["1e3", "0.3"], [ANGLE, ANGULAR_FREQUENCY.with_default("3.141592653589793")]);

/// Radius R₀ of the vortex (m).
const RADIUS: f64 = 0.4;

/// h = (1 − R²/R₀²)⁴ and its derivatives by R² (-, 1/m², 1/m⁴) at the arm `d` (m).
pub(super) fn profile(d: [f64; 2]) -> [f64; 3] {
    let q = 1.0 - (d[0] * d[0] + d[1] * d[1]) / (RADIUS * RADIUS);
    if q <= 0.0 {
        return [0.0; 3];
    }
    [q.powi(4), -4.0 * q.powi(3) / RADIUS.powi(2), 12.0 * q.powi(2) / RADIUS.powi(4)]
}

/// The vortex of this file.
pub(super) const BOX: Shape = Shape {
    dimension: 2,
    extent: [[0.0, 1.0]; 3],
    place: |x| {
        let arm = [x.x - 0.5, x.y - 0.5];
        Place { arm, profile: profile(arm), height: PLANE }
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;
    use nalgebra::Vector3;

    #[test]
    fn it_solves_the_equations_in_a_fixed_box() {
        for nu in ["poisson_ratio=0.3", "poisson_ratio=0.4999"] {
            let s = check::solution(&ENTRY, &[nu]);
            check::solves_as_neo_hookean(s.as_ref(), 2.0, |x| ((x.x - 0.5).hypot(x.y - 0.5) - RADIUS).abs() > 0.05);
            check::fixed_on_all_sides(s.as_ref(), 2.0);
        }
    }

    #[test]
    fn the_centre_is_regular_and_the_motion_knows_no_lambda() {
        let centre = Vector3::new(0.5, 0.5, 0.0);
        let [soft, stiff] = ["poisson_ratio=0.3", "poisson_ratio=0.4999"]
            .map(|nu| check::solution(&ENTRY, &["young_modulus=1000", nu]));
        assert!(soft.body_force(&centre, 0.3).norm() < 1e-15);
        assert!(soft.velocity(&centre, 0.3).norm() < 1e-15);
        let x = Vector3::new(0.6, 0.4, 0.0);
        assert_eq!(soft.displacement(&x, 0.3), stiff.displacement(&x, 0.3));
    }

    #[test]
    fn the_mean_stress_is_that_of_the_shear_alone() {
        let s = check::solution(&ENTRY, &["poisson_ratio=0.4999"]);
        let x = Vector3::new(0.7, 0.5, 0.0);
        let (r, q) = (0.2_f64, 0.75_f64);
        let slope = -8.0 * r * q.powi(3) / 0.16;
        let expected = s.material().mu * (r * slope).powi(2) / 3.0;
        assert!((s.mean_stress(&x, 0.5) - expected).abs() < 1e-12 * expected);
    }
}
