//! Generalised vortex in a ring (Kamojjala, Brannon, Sadeghirad & Guilkey 2015,
//! doi:10.1007/s00366-013-0342-x): isochoric, with large rotation and shear.
//!
//! On 0.75 ≤ R ≤ 1.25 a point turns about the origin by α = α₀ sin ωt · h(R),
//! h = 1 − 32 (R−1)² + 256 (R−1)⁴. h = h′ = 0 on both circles: neither moves, and no traction acts on
//! them. Outside the ring α = 0 (the polynomial grows again): the square \[−1.5, 1.5\]² is filled with
//! material at rest, its sides are fixed. h″, and with it b, jumps at the circles. u, b and P do not
//! depend on λ.

use super::common::ANGULAR_FREQUENCY;
use super::twist::{self, PLANE, Place, Shape, Vortex};
use super::{Entry, Material};
use crate::parameter::Parameter;

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-vortex-ring",
    summary: "isochoric vortex in a ring, material at rest around it",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(Vortex::new(p, RING)?)),
};

/// Largest angle α₀, π/4 (rad).
pub const ANGLE: Parameter = twist::ANGLE.with_default("0.7853981633974483");

const PARAMETERS: [Parameter; 5] =
    Material::parameters(["1e3", "0.3"], [ANGLE, ANGULAR_FREQUENCY.with_default("3.141592653589793")]);

/// h and its derivatives by R², from h′ and h″ by R: h′/(2R) and (h″ − h′/R)/(4R²).
fn profile(r: f64) -> [f64; 3] {
    let s = r - 1.0;
    if s.abs() >= 0.25 {
        return [0.0; 3];
    }
    let h = 1.0 - 32.0 * s.powi(2) + 256.0 * s.powi(4);
    let h_r = -64.0 * s + 1024.0 * s.powi(3);
    let h_rr = -64.0 + 3072.0 * s.powi(2);
    [h, h_r / (2.0 * r), (h_rr - h_r / r) / (4.0 * r * r)]
}

/// The vortex of this file.
const RING: Shape = Shape {
    dimension: 2,
    extent: [[-1.5, 1.5]; 3],
    place: |x| Place { arm: [x.x, x.y], profile: profile(x.x.hypot(x.y)), height: PLANE },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;
    use nalgebra::Vector3;

    #[test]
    fn it_solves_the_equations_away_from_the_circles() {
        let s = check::solution(&ENTRY, &["angle=1.5"]);
        check::solves_as_neo_hookean(s.as_ref(), 2.0, |x| {
            let r = x.x.hypot(x.y);
            (r - 0.75).abs() > 0.05 && (r - 1.25).abs() > 0.05
        });
        check::fixed_on_all_sides(s.as_ref(), 2.0);
    }

    #[test]
    fn neither_circle_moves_nor_carries_traction() {
        let s = check::solution(&ENTRY, &[]);
        for r in [0.75 + 1e-9, 1.25 - 1e-9] {
            let x = Vector3::new(0.6 * r, 0.8 * r, 0.0);
            assert!(s.displacement(&x, 0.5).norm() < 1e-12);
            assert!(s.velocity(&x, 0.2).norm() < 1e-12);
            let traction = s.first_piola(&x, 0.5) * (x / r);
            assert!(traction.norm() < 1e-4, "{traction}");
        }
        let outside = Vector3::new(1.4, 0.2, 0.0);
        assert_eq!(s.body_force(&outside, 0.3), Vector3::zeros());
        assert_eq!(s.displacement(&Vector3::zeros(), 0.3), Vector3::zeros());
    }
}
