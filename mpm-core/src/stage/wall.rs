//! Walls on the ends of an axis.

use super::{Bound, Constraint};
use crate::error::{Error, require};
use crate::frame::Frame;
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

impl End {
    /// The end where this is along an axis that points the other way.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Lo => Self::Hi,
            Self::Hi => Self::Lo,
        }
    }

    /// This end of `axis` seen from `frame`, with its axis there.
    #[must_use]
    pub fn seen_from<const D: usize>(self, axis: usize, frame: &Frame<D>) -> (usize, Self) {
        match frame.axis(axis) {
            (axis, sign) if sign < 0.0 => (axis, self.opposite()),
            (axis, _) => (axis, self),
        }
    }
}

/// Components that a wall holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallKind {
    /// All components.
    Fixed,
    /// The normal component; material slides freely and sticks to the wall.
    Roller,
    /// The normal component, one-sided: the wall bears no tension and material comes off it freely.
    Separable,
}

/// A wall at one end of an axis: the nodes on it and beyond it are held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Axis normal to the wall.
    pub axis: usize,
    /// End of that axis.
    pub end: End,
    /// Components held.
    pub kind: WallKind,
    /// Coulomb's coefficient of a [`WallKind::Separable`] wall in an explicit run: what presses a node onto the wall slows
    /// it along the wall, by that times the normal impulse at most. XPIC does not know of it.
    pub friction: f64,
}

/// A node this fraction of a cell inside still counts as on the wall.
const ON_WALL: f64 = 1e-9;

impl Wall {
    /// Wall at one `end` of an `axis`.
    #[must_use]
    pub fn new(axis: usize, end: End, kind: WallKind) -> Self {
        Self { axis, end, kind, friction: 0.0 }
    }

    /// The same with Coulomb's coefficient of friction.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite; one that is not zero, of a wall that is not separable.
    pub fn friction(self, friction: f64) -> Result<Self, Error> {
        let within = friction == 0.0 || friction > 0.0 && self.kind == WallKind::Separable;
        require(within, "friction of a wall", friction, "zero, or positive at a separable wall")?;
        Ok(Self { friction, ..self })
    }
}

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

    fn friction(&self) -> f64 {
        self.friction
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Constraint<D>> {
        let (axis, end) = self.end.seen_from(self.axis, frame);
        Box::new(Self { axis, end, ..*self })
    }
}
