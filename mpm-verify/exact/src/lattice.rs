//! Values of a regular grid's functions at particles, in waves, and on regular lattices of particles.

use mpm_solvers::scheme::BasisName;
use std::f64::consts::{PI, TAU};

/// Images of a wave that are summed.
const IMAGES: i32 = 200;

/// Transform of the functions of `basis` at `k` (radians a cell), of particles `per_cell` of which have the size of a cell.
/// Functions are repeated averages: theirs is a power of sinc, GIMP's has that of the domain.
pub fn transform(basis: BasisName, per_cell: f64, k: f64) -> f64 {
    let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
    match basis {
        BasisName::Linear => sinc(0.5 * k).powi(2),
        BasisName::Gimp => sinc(0.5 * k).powi(2) * sinc(0.5 * k / per_cell),
        BasisName::Bspline2 | BasisName::Bspline3 | BasisName::Q8 => sinc(0.5 * k).powi(basis.degree() as i32 + 1),
    }
}

/// (ψ, ψ) h² and Π̂ of a wave of this angle from node to node, for particles everywhere: sums over its images.
pub fn symbol(angle: f64, transform: &dyn Fn(f64) -> f64) -> [f64; 2] {
    let images = (-IMAGES..=IMAGES).map(|k| angle + TAU * f64::from(k));
    images.fold([0.0; 2], |[slopes, values], k| {
        let square = transform(k).powi(2);
        [slopes + k * k * square, values + square]
    })
}

/// Amplitude of the force of a uniform stress over the stress, as a wave of the lattice with `waves` periods a cell.
pub fn force(waves: f64, transform: &dyn Fn(f64) -> f64) -> f64 {
    4.0 * PI * waves * transform(TAU * waves).abs()
}

/// How far from a particle of this half size (cells) its functions are, in cells.
pub fn support(basis: BasisName, half_size: f64) -> f64 {
    match basis {
        BasisName::Linear => 1.0,
        BasisName::Gimp => 1.0 + half_size,
        BasisName::Bspline2 => 1.5,
        BasisName::Bspline3 | BasisName::Q8 => 2.0,
    }
}

/// First and last node that sees a particle at `x`, in cells from a grid line: functions that begin at it see nothing.
pub fn nodes(basis: BasisName, half_size: f64, x: f64) -> [f64; 2] {
    let first = match basis {
        BasisName::Bspline2 => 0.5,
        BasisName::Linear | BasisName::Gimp | BasisName::Bspline3 | BasisName::Q8 => 0.0,
    };
    let (x, reach) = (x - first, support(basis, half_size));
    [(x - reach).floor() + 1.0, (x + reach).ceil() - 1.0]
}
