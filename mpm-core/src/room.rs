//! Where particles may be: between the ends of the grid, and beyond walls as far as the basis sees them.

use crate::error::Fault;
use crate::grid::Grid;
use crate::number::Eight;

/// Where particles may be.
pub(crate) struct Room<const D: usize> {
    lo: [f64; D],
    hi: [f64; D],
    periodic: [bool; D],
}

impl<const D: usize> Room<D> {
    /// On `grid`; at walls also `beyond` (m, axis by axis) them.
    pub(crate) fn new(grid: &Grid<D>, beyond: [f64; D]) -> Self {
        let give = |a: usize, wall: bool| if wall { beyond[a] } else { 0.0 };
        let ends = &grid.axes;
        Self {
            lo: std::array::from_fn(|a| ends[a].lo - give(a, ends[a].wall_ends().0)),
            hi: std::array::from_fn(|a| ends[a].hi(grid.h) + give(a, ends[a].wall_ends().1)),
            periodic: std::array::from_fn(|a| ends[a].is_periodic()),
        }
    }

    /// Whether eight positions are between the ends.
    #[inline(always)]
    pub(crate) fn holds_all(&self, x: &[Eight; D]) -> bool {
        let mut inside = Eight::splat(0.0).simd_le(Eight::splat(1.0));
        for a in 0..D {
            let (lo, hi) = (Eight::splat(self.lo[a]), Eight::splat(self.hi[a]));
            inside = inside & x[a].simd_ge(lo) & x[a].simd_lt(hi);
        }
        inside.all()
    }

    /// Brings a position on a periodic axis back between its ends (true when it had left) and checks the others.
    pub(crate) fn place(&self, x: &mut [f64; D]) -> Result<bool, Fault> {
        let mut wrapped = false;
        for (axis, value) in x.iter_mut().enumerate() {
            let (lo, hi) = (self.lo[axis], self.hi[axis]);
            if *value >= lo && *value < hi {
                continue;
            }
            if !value.is_finite() {
                return Err(Fault::NotFinite { quantity: "position", value: *value });
            }
            if self.periodic[axis] {
                *value = lo + (*value - lo).rem_euclid(hi - lo);
                wrapped = true;
            } else if *value != hi {
                return Err(Fault::OffGrid { axis, value: *value, lo, hi });
            }
        }
        Ok(wrapped)
    }
}
