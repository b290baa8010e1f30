//! Walls on the ends of an axis.

use super::{Bound, Constraint};
use crate::grid::Grid;
use crate::memory::Memoryless;

/// Which end of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The lower end.
    Lo,
    /// The upper end.
    Hi,
}

/// What a wall holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallKind {
    /// All components.
    Fixed,
    /// The normal component; material slides freely and sticks to the wall.
    Roller,
    /// Likewise, but one-sided: the wall bears no tension and material comes off it freely.
    Separable,
}

/// A wall at one end of an axis: the nodes on it and beyond it are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wall {
    /// Axis normal to the wall.
    pub axis: usize,
    /// End of that axis.
    pub end: End,
    /// What is held.
    pub kind: WallKind,
}

/// A node this fraction of a cell inside still counts as on the wall.
const ON_WALL: f64 = 1e-9;

impl Memoryless for Wall {}

impl<const D: usize> Constraint<D> for Wall {
    fn prescribe(&self, grid: &Grid<D>, position: &[f64; D], axis: usize) -> Option<f64> {
        let ends = &grid.axes[self.axis];
        let x = position[self.axis];
        let behind = match self.end {
            End::Lo => x <= ends.lo + ON_WALL * grid.h,
            End::Hi => x >= ends.hi(grid.h) - ON_WALL * grid.h,
        };
        let held = self.kind == WallKind::Fixed || axis == self.axis;
        (behind && held).then_some(0.0)
    }

    fn bound(&self) -> Bound {
        match (self.kind, self.end) {
            (WallKind::Fixed | WallKind::Roller, _) => Bound::Equal,
            (WallKind::Separable, End::Lo) => Bound::AtLeast,
            (WallKind::Separable, End::Hi) => Bound::AtMost,
        }
    }
}
