//! Uniform generalised interpolation (uGIMP).
//!
//! Bardenhagen & Kober (2004): hat functions averaged over the particle's domain of fixed size,
//! w_i(x) = 1/(2l) ∫_{x−l}^{x+l} N_i dx. Zhao et al. 2022, section 4, use this form.

use super::{AxisNodes, AxisWeights, Basis, WallTreatment};
use crate::grid::Axis;

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

impl Basis<3> for Gimp {
    fn new(axis: &Axis, h: f64, _wall: WallTreatment) -> Self {
        Self {
            axis: *axis,
            h,
            origin: axis.lo - GHOSTS as f64 * h,
            inverse_h: 1.0 / h,
        }
    }

    fn nodes(&self) -> AxisNodes {
        let cells = self.axis.cells;
        let count = cells + 1 + 2 * GHOSTS;
        AxisNodes {
            position: (0..count)
                .map(|i| self.origin + i as f64 * self.h)
                .collect(),
            original: self.axis.is_periodic().then(|| {
                (0..count)
                    .map(|i| (i + cells - GHOSTS) % cells + GHOSTS)
                    .collect()
            }),
        }
    }

    #[inline(always)]
    fn weights(&self, x: f64, half_size: f64) -> AxisWeights<3> {
        let length = 2.0 * half_size * self.inverse_h;
        let begin = (x - half_size - self.origin) * self.inverse_h;
        let first = begin as usize;
        // The domain [a, b] in units of cells from the first node; past `1` it lies in the next cell.
        let a = begin - first as f64;
        let b = a + length;
        let inside = b.min(1.0);
        let over = b - inside;
        let scale = 1.0 / length;
        let w0 = 0.5 * scale * ((1.0 - a) * (1.0 - a) - (1.0 - inside) * (1.0 - inside));
        let w2 = 0.5 * scale * over * over;
        let dw0 = -scale * self.inverse_h * (inside - a);
        let dw2 = scale * self.inverse_h * over;
        AxisWeights {
            first,
            w: [w0, 1.0 - w0 - w2, w2],
            dw: [dw0, -dw0 - dw2, dw2],
        }
    }
}
