//! Isochoric swirl in three dimensions; derived here from the vortex in a box.
//!
//! In the unit cube a point turns about the line through (½, ½) by
//! α = α₀ sin ωt · (1 − R²/R₀²)⁴ · sin² πZ, R₀ = 0.4 m: all sides are fixed (rollers are exact too).
//! In cylindrical coordinates P = μ \[R α_R (e_r E_Θ + e_θ E_R) + R α_Z (e_θ E_Z + e_z E_Θ)\], and
//! b_r = −R α_t² + (μ/ρ₀) R (α_R² + α_Z²), b_θ = R α_tt − (μ/ρ₀) (3 α_R + R α_RR + R α_ZZ), b_z = 0.

use super::common::ANGULAR_FREQUENCY;
use super::twist::{ANGLE, Place, Shape, Vortex};
use super::vortex_box::profile;
use super::{Entry, Material};
use crate::parameter::Parameter;
use std::f64::consts::{PI, TAU};

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-swirl",
    summary: "isochoric swirl in the unit cube",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(Vortex::new(p, SWIRL)?)),
};

const PARAMETERS: [Parameter; 5] =
    Material::parameters(["1e3", "0.3"], [ANGLE, ANGULAR_FREQUENCY.with_default("3.141592653589793")]);

/// The vortex of this file.
const SWIRL: Shape = Shape {
    dimension: 3,
    extent: [[0.0, 1.0]; 3],
    place: |x| {
        let arm = [x.x - 0.5, x.y - 0.5];
        let height = [(PI * x.z).sin().powi(2), PI * (TAU * x.z).sin(), 2.0 * PI * PI * (TAU * x.z).cos()];
        Place { arm, profile: profile(arm), height }
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;
    use crate::parameter::Parameters;
    use nalgebra::Vector3;

    #[test]
    fn it_solves_the_equations_in_a_fixed_cube() {
        let s = check::solution(&ENTRY, &["poisson_ratio=0.49"]);
        check::solves_as_neo_hookean(s.as_ref(), 2.0, |x| ((x.x - 0.5).hypot(x.y - 0.5) - 0.4).abs() > 0.05);
        check::fixed_on_all_sides(s.as_ref(), 2.0);
    }

    /// Second derivatives against differences of the first: all that closed forms don't use, too.
    #[test]
    fn the_second_derivatives_are_those_of_the_first() {
        let s = Vortex::new(&Parameters::new(&PARAMETERS, &[]).unwrap(), SWIRL).unwrap();
        let (x, t) = (Vector3::new(0.6, 0.35, 0.2), 0.3);
        let slopes = check::gradient(&s, &x, |x| s.twist(x, t).first_derivatives());
        let second = s.twist(&x, t).second_derivatives();
        for (j, slope) in slopes.iter().enumerate() {
            for (k, second) in second.iter().enumerate() {
                let difference = second.column(j) - slope.row(k).transpose();
                assert!(difference.norm() < 1e-9 * slope.norm(), "{k} {j}: {difference}");
            }
        }
    }

    /// The formulas of the head of this file, in cylindrical coordinates.
    #[test]
    fn the_forces_are_those_of_cylindrical_coordinates() {
        let s = check::solution(&ENTRY, &[]);
        let (r, z, theta, t) = (0.2_f64, 0.3_f64, 0.7_f64, 0.3_f64);
        let x = Vector3::new(0.5 + r * theta.cos(), 0.5 + r * theta.sin(), z);
        let q = 1.0 - r * r / 0.16;
        let (g, zeta) = ((PI * t).sin(), (PI * z).sin().powi(2));
        let h = q.powi(4);
        let h_r = -8.0 * r * q.powi(3) / 0.16;
        let h_rr = -8.0 * q.powi(3) / 0.16 + 48.0 * r * r * q.powi(2) / 0.0256;
        let alpha_z = g * h * PI * (TAU * z).sin();
        let alpha_zz = g * h * 2.0 * PI * PI * (TAU * z).cos();
        let c2 = s.material().mu / s.material().density;
        let radial =
            -r * (PI * (PI * t).cos() * h * zeta).powi(2) + c2 * r * ((g * h_r * zeta).powi(2) + alpha_z.powi(2));
        let hoop = -r * PI * PI * g * h * zeta - c2 * (g * zeta * (3.0 * h_r + r * h_rr) + r * alpha_zz);
        let turned = theta + g * h * zeta;
        let expected =
            Vector3::new(radial * turned.cos() - hoop * turned.sin(), radial * turned.sin() + hoop * turned.cos(), 0.0);
        assert!((s.body_force(&x, t) - expected).norm() < 1e-12 * expected.norm());
    }
}
