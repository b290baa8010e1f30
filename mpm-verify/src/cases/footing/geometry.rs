//! The footing, and how wide it acts.

use crate::scheme::BasisName;

/// Width B of the footing (m); its right half is simulated.
pub(super) const WIDTH: f64 = 1.0;

/// The width (m) that a footing of held nodes acts with, and how well it is known: up to the middle between the last
/// held node and the first free one. Quadratic splines have their nodes in the middle of cells, the others on grid
/// lines. Between cubic splines the velocity falls from that of the footing a cell inside of its edge to that of the
/// free ground two cells outside: the place is known to half a cell at either end.
pub(super) fn effective_width(basis: BasisName, h: f64) -> (f64, f64) {
    match basis {
        BasisName::Bspline2 => (WIDTH, 0.0),
        BasisName::Linear | BasisName::Gimp | BasisName::Q8 => (WIDTH + h, 0.0),
        BasisName::Bspline3 => (WIDTH + 0.5 * h, 0.5 * h),
    }
}

/// How far (m) from the axis of a footing of [`WIDTH`] the ground rises at the limit load: Prandtl's mechanism under a
/// rough one, Hill's, half as large, under a smooth one.
pub(super) fn mechanism_extent(rough: bool) -> f64 {
    WIDTH * if rough { 1.5 } else { 1.0 }
}
