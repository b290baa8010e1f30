//! What functions of a regular grid see of waves and of regular lattices of particles.

use crate::scheme::BasisName;
use std::f64::consts::{PI, TAU};

/// Images of a wave that are summed.
const IMAGES: i32 = 200;

/// Transform of the functions of `basis` at `k` (radians a cell), of particles `per_cell` of which have the size of a cell.
/// Functions are repeated averages: theirs is a power of sinc, GIMP's has that of the domain.
pub(super) fn transform(basis: BasisName, per_cell: f64, k: f64) -> f64 {
    let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
    match basis {
        BasisName::Linear => sinc(0.5 * k).powi(2),
        BasisName::Gimp => sinc(0.5 * k).powi(2) * sinc(0.5 * k / per_cell),
        BasisName::Bspline2 | BasisName::Bspline3 | BasisName::Q8 => {
            sinc(0.5 * k).powi(basis.degree() as i32 + 1)
        }
    }
}

/// (ψ, ψ) h² and Π̂ of a wave of this angle from node to node, for particles everywhere: sums over its images.
pub(super) fn symbol(angle: f64, transform: &dyn Fn(f64) -> f64) -> [f64; 2] {
    let images = (-IMAGES..=IMAGES).map(|k| angle + TAU * f64::from(k));
    images.fold([0.0; 2], |[slopes, values], k| {
        let square = transform(k).powi(2);
        [slopes + k * k * square, values + square]
    })
}

/// Amplitude of the force of a uniform stress over the stress, as a wave of the lattice with `waves` periods a cell.
pub(super) fn force(waves: f64, transform: &dyn Fn(f64) -> f64) -> f64 {
    4.0 * PI * waves * transform(TAU * waves).abs()
}
