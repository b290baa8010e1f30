//! Geometry of the background grid.

use crate::error::{Error, positive, require};

/// Kind of end of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Nothing: material may come near but not leave.
    Open,
    /// A wall on the grid line, on which a basis may become interpolatory and constraints act.
    Wall,
}

/// The two ends of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisKind {
    /// An end on either side.
    Bounded {
        /// At the lower end.
        lo: Side,
        /// At the upper end.
        hi: Side,
    },
    /// The upper end is the lower one.
    Periodic,
}

/// One axis of the grid: `cells` cells of the grid's size from coordinate `lo` (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Coordinate of the lower end (m).
    pub lo: f64,
    /// Number of cells.
    pub cells: usize,
    /// Its ends.
    pub kind: AxisKind,
}

impl Axis {
    /// An axis with the given ends.
    #[must_use]
    pub fn bounded(lo: f64, cells: usize, ends: (Side, Side)) -> Self {
        let (low, high) = ends;
        Self { lo, cells, kind: AxisKind::Bounded { lo: low, hi: high } }
    }

    /// An axis open at both ends.
    #[must_use]
    pub fn open(lo: f64, cells: usize) -> Self {
        Self::bounded(lo, cells, (Side::Open, Side::Open))
    }

    /// An axis between two walls.
    #[must_use]
    pub fn walls(lo: f64, cells: usize) -> Self {
        Self::bounded(lo, cells, (Side::Wall, Side::Wall))
    }

    /// A periodic axis.
    #[must_use]
    pub fn periodic(lo: f64, cells: usize) -> Self {
        Self { lo, cells, kind: AxisKind::Periodic }
    }

    /// Coordinate of the upper end (m) for cells of size `h` (m).
    pub fn hi(&self, h: f64) -> f64 {
        self.lo + self.cells as f64 * h
    }

    /// Whether the lower and the upper end are walls.
    pub fn wall_ends(&self) -> (bool, bool) {
        match self.kind {
            AxisKind::Bounded { lo, hi } => (lo == Side::Wall, hi == Side::Wall),
            AxisKind::Periodic => (false, false),
        }
    }

    /// Whether the axis is periodic.
    pub fn is_periodic(&self) -> bool {
        self.kind == AxisKind::Periodic
    }
}

/// A Cartesian grid of square cells in `D` dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid<const D: usize> {
    /// Cell size (m).
    pub h: f64,
    /// The axes.
    pub axes: [Axis; D],
}

/// Fewest cells of an axis: every basis then has its full support and distinct periodic images.
const MIN_CELLS: usize = 4;

impl<const D: usize> Grid<D> {
    /// A grid of cells of size `h` (m).
    ///
    /// # Errors
    /// `h` not positive and finite, or an axis with fewer than four cells or a non-finite origin.
    pub fn new(h: f64, axes: [Axis; D]) -> Result<Self, Error> {
        positive(h, "cell size", "positive and finite (m)")?;
        for axis in &axes {
            require(true, "grid origin", axis.lo, "finite (m)")?;
            require(axis.cells >= MIN_CELLS, "cells of an axis", axis.cells as f64, "at least 4")?;
        }
        Ok(Self { h, axes })
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.axes.iter().map(|axis| axis.cells).product()
    }

    /// Number of the cell that holds `x` (m), clamped to the grid; the last axis varies fastest.
    pub fn cell_of(&self, x: &[f64; D]) -> usize {
        (0..D).fold(0, |number, a| number * self.axes[a].cells + self.cell(a, x[a]))
    }

    /// Index of the cell along `axis` that holds coordinate `x` (m), clamped to the grid.
    pub fn cell(&self, axis: usize, x: f64) -> usize {
        let a = &self.axes[axis];
        (((x - a.lo) / self.h) as usize).min(a.cells - 1)
    }
}
