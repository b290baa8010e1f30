//! Uniform generalised interpolation (uGIMP).
//!
//! Bardenhagen & Kober (2004): hat functions averaged over the particle's domain of fixed size,
//! w_i(x) = 1/(2l) ∫_{x−l}^{x+l} N_i dx. Zhao et al. 2023, section 4, use this form.

use super::{AxisNodes, AxisWeights, Basis, EightAxisWeights, WallTreatment};
use crate::grid::Axis;
use crate::number::{Eight, Real};

/// Nodes before the first vertex, for a particle domain that reaches over the end of the axis.
const GHOSTS: usize = 1;

/// uGIMP functions on the vertices of an axis and one ghost node beyond either end.
#[derive(Debug, Clone, PartialEq)]
pub struct Gimp {
    axis: Axis,
    h: f64,
    origin: f64,
    inverse_h: f64,
}

impl Gimp {
    /// Index of the first function, values and derivatives: of one particle, or of eight.
    #[inline(always)]
    fn functions<T: Real>(&self, x: T, half_size: f64) -> (T, [T; 3], [T; 3]) {
        let (one, inverse_h) = (T::splat(1.0), T::splat(self.inverse_h));
        let length = (half_size + half_size) * self.inverse_h;
        let begin = (x - T::splat(half_size) - T::splat(self.origin)) * inverse_h;
        let first = begin.floor();
        // The domain [a, b] in units of cells from the first node; past `1` it lies in the next cell.
        let a = begin - first;
        let b = a + T::splat(length);
        let inside = b.at_most(1.0);
        let over = b - inside;
        let scale = T::splat(1.0 / length);
        let half_scale = T::splat(0.5) * scale;
        let w0 = half_scale * ((one - a) * (one - a) - (one - inside) * (one - inside));
        let w2 = half_scale * over * over;
        let dw0 = -scale * inverse_h * (inside - a);
        let dw2 = scale * inverse_h * over;
        (first, [w0, one - w0 - w2, w2], [dw0, -dw0 - dw2, dw2])
    }
}

impl Basis<3> for Gimp {
    fn new(axis: &Axis, h: f64, _wall: WallTreatment) -> Self {
        Self { axis: *axis, h, origin: axis.lo - GHOSTS as f64 * h, inverse_h: 1.0 / h }
    }

    /// The domain reaches from a node's vertex to either side at the same length: 2/l of the neighbours, 1/(1 − l) of
    /// the node.
    fn steepness(half_size: f64) -> Option<f64> {
        Some(2.0 / half_size + 1.0 / (1.0 - half_size))
    }

    fn nodes(&self) -> AxisNodes {
        let cells = self.axis.cells;
        let count = cells + 1 + 2 * GHOSTS;
        AxisNodes {
            position: (0..count).map(|i| self.origin + i as f64 * self.h).collect(),
            original: self
                .axis
                .is_periodic()
                .then(|| (0..count).map(|i| (i + cells - GHOSTS) % cells + GHOSTS).collect()),
        }
    }

    /// A mean over the domain does not vanish where the domain's centre meets the wall; it has when all of it is
    /// beyond.
    fn beyond_wall(half_size: f64) -> f64 {
        half_size
    }

    #[inline(always)]
    fn weights(&self, x: f64, half_size: f64) -> AxisWeights<3> {
        let (first, w, dw) = self.functions(x, half_size);
        AxisWeights { first: first as usize, w, dw }
    }

    /// The hats themselves, to which the means tend.
    fn at_point(&self, x: f64) -> AxisWeights<3> {
        let place = (x - self.origin) * self.inverse_h;
        let first = place.floor().clamp(0.0, self.axis.cells as f64);
        let t = place - first;
        // Past one the point lies between the second and the third node: on the last vertex, or beyond it.
        let (w, dw) =
            if t <= 1.0 { ([1.0 - t, t, 0.0], [-1.0, 1.0, 0.0]) } else { ([0.0, 2.0 - t, t - 1.0], [0.0, -1.0, 1.0]) };
        AxisWeights { first: first as usize, w, dw: dw.map(|dw| dw * self.inverse_h) }
    }

    #[inline(always)]
    fn weights_of_eight(&self, x: Eight, half_size: f64) -> EightAxisWeights<3> {
        let (first, w, dw) = self.functions(x, half_size);
        EightAxisWeights { first, w, dw }
    }
}
