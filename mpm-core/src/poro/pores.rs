//! What particles of a body with water have beside those of a dry one.

use crate::grid::Grid;
use crate::implicit::{Domains, HalfSizes};
use crate::memory::{MemoryError, rows};
use crate::particles::{Particles, permute};
use serde::{Deserialize, Serialize};

/// Columns beside a body's, one entry per particle. The porosity is no column: J gives it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub(super) struct Pores<const D: usize> {
    /// Pore pressure (Pa).
    pub(super) pressure: Vec<f64>,
    /// What the pressure differs by from its mean over the cell (Pa); empty unless the space is projected.
    pub(super) fluctuation: Vec<f64>,
    /// Half the size of the domain along each axis (m).
    #[serde(with = "rows")]
    pub(super) half_size: Vec<[f64; D]>,
}

impl<const D: usize> Pores<D> {
    /// Puts the particles in the order `order`.
    pub(super) fn permute(&mut self, order: &[u32]) {
        permute(&mut self.pressure, order);
        permute(&mut self.fluctuation, order);
        permute(&mut self.half_size, order);
    }

    /// The domains of `particles`.
    pub(super) fn domains<'a>(&'a self, particles: &'a Particles<D>) -> Domains<'a, D> {
        Domains {
            centre: &particles.position,
            half_size: HalfSizes::OfEach(&self.half_size),
        }
    }

    /// Checks that a memory has the columns of this one.
    pub(super) fn check_against(&self, present: &Self) -> Result<(), MemoryError> {
        for (what, saved, expected) in [
            ("pressures", self.pressure.len(), present.pressure.len()),
            (
                "fluctuations",
                self.fluctuation.len(),
                present.fluctuation.len(),
            ),
            ("half sizes", self.half_size.len(), present.half_size.len()),
        ] {
            MemoryError::unless_equal(what, saved, expected)?;
        }
        Ok(())
    }
}

/// How far (in cells) rounding may take a domain past a wall, and the share of its distance from there that it then
/// keeps.
const ROUNDING: f64 = 1e-9;
const KEPT: f64 = 1.0 - 1e-12;

/// Draws a domain around `x` (m) back that rounding has taken past a wall. Functions behind the wall would see hardly
/// any of it, and nothing else, but their shares of the forces are to balance all the same.
pub(super) fn keep_before_walls<const D: usize>(
    grid: &Grid<D>,
    x: &[f64; D],
    half_size: &mut [f64; D],
) {
    for (a, l) in half_size.iter_mut().enumerate() {
        let axis = &grid.axes[a];
        let (lower, upper) = axis.wall_ends();
        let ends = [(lower, x[a] - axis.lo), (upper, axis.hi(grid.h) - x[a])];
        for (_, distance) in ends.into_iter().filter(|(wall, _)| *wall) {
            let past = *l - KEPT * distance;
            if past > 0.0 && past < ROUNDING * grid.h {
                *l = KEPT * distance;
            }
        }
    }
}
