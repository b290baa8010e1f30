//! Linear hat functions on the grid's vertices: the basis of the original MPM.

use super::BSpline;

/// Hat functions: the B-spline of degree one. They interpolate everywhere, so the two wall
/// treatments coincide.
pub type Linear = BSpline<2>;
