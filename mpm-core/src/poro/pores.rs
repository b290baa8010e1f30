//! Columns of the particles of a body with water, beside those of a dry one.

use crate::error::Fault;
use crate::grid::Grid;
use crate::implicit::{Domains, HalfSizes, OfHats};
use crate::memory::{MemoryError, rows};
use crate::particles::{Particles, permute};
use serde::{Deserialize, Serialize};

/// Columns beside a body's, one entry per particle. The porosity is no column: J gives it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub(super) struct Pores<const D: usize> {
    /// Pore pressure (Pa).
    pub(super) pressure: Vec<f64>,
    /// Its gradient (Pa/m), and the place (m) where both were found, at the start of the last step; empty unless
    /// something acts on what pressures change by.
    #[serde(with = "rows")]
    pub(super) slope: Vec<[f64; D]>,
    #[serde(with = "rows")]
    pub(super) place: Vec<[f64; D]>,
    /// Half the size of the domain along each axis (m).
    #[serde(with = "rows")]
    pub(super) half_size: Vec<[f64; D]>,
}

impl<const D: usize> Pores<D> {
    /// Puts the particles in the order `order`.
    pub(super) fn permute(&mut self, order: &[u32]) {
        permute(&mut self.pressure, order, 1);
        permute(&mut self.slope, order, 1);
        permute(&mut self.place, order, 1);
        permute(&mut self.half_size, order, 1);
    }

    /// The domains of `particles`.
    pub(super) fn domains<'a>(&'a self, particles: &'a Particles<D>) -> Domains<'a, D> {
        Domains { centre: &particles.position, half_size: HalfSizes::OfEach(&self.half_size) }
    }

    /// Checks that a memory has the columns of this one.
    pub(super) fn check_against(&self, present: &Self) -> Result<(), MemoryError> {
        for (what, saved, expected) in [
            ("pressures", self.pressure.len(), present.pressure.len()),
            ("slopes of pressures", self.slope.len(), present.slope.len()),
            ("places of pressures", self.place.len(), present.place.len()),
            ("half sizes", self.half_size.len(), present.half_size.len()),
        ] {
            MemoryError::unless_equal(what, saved, expected)?;
        }
        Ok(())
    }
}

/// The share of its distance from a wall that a domain keeps which ends there.
const KEPT: f64 = 1.0 - 1e-12;

/// Ends a domain around `x` (m) at the walls that it would reach past, by rounding or because its volume is that of a
/// sheared particle. Functions behind the wall would see hardly any of it, and nothing else, but their shares of the
/// forces are to balance all the same.
pub(super) fn keep_before_walls<const D: usize>(grid: &Grid<D>, x: &[f64; D], half_size: &mut [f64; D]) {
    for (a, l) in half_size.iter_mut().enumerate() {
        let axis = &grid.axes[a];
        let (lower, upper) = axis.wall_ends();
        let ends = [(lower, x[a] - axis.lo), (upper, axis.hi(grid.h) - x[a])];
        for (_, distance) in ends.into_iter().filter(|(wall, _)| *wall) {
            *l = l.min(KEPT * distance);
        }
    }
}

/// The half sizes (m) of a box that goes from `before` to the shape of `after`, but whose volume grows by `change`:
/// what the logarithms of the stretches lack of that of the change is shared in proportion to them, so that an axis
/// along which nothing happens keeps its size.
pub(super) fn grown<const D: usize>(before: &[f64; D], after: &[f64; D], change: f64) -> [f64; D] {
    let logarithms: [f64; D] = std::array::from_fn(|a| (after[a] / before[a]).ln());
    let lacking = change.ln() - logarithms.iter().sum::<f64>();
    let whole: f64 = logarithms.iter().map(|l| l.abs()).sum();
    std::array::from_fn(|a| {
        let share = if whole > 0.0 { logarithms[a].abs() / whole } else { 1.0 / D as f64 };
        before[a] * (logarithms[a] + share * lacking).exp()
    })
}

/// Checks that functions have means over a domain of half sizes `half_size` (m), if means
/// they are: it takes at most a cell.
///
/// # Errors
/// Half a size in cells that is not positive, or too large; NaN of a box that is turned inside out.
pub(super) fn check_width<const D: usize>(functions: &dyn OfHats<D>, half_size: &[f64; D]) -> Result<(), Fault> {
    for l in half_size {
        let cells = l / functions.grid().h;
        let fits = cells > 0.0 && (cells <= 0.5 || !functions.means());
        if !fits {
            return Err(Fault::WideDomain(cells));
        }
    }
    Ok(())
}
