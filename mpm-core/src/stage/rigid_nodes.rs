//! A rigid body as prescribed velocities of the nodes that it covers.

use super::{Amplitude, Constraint};
use crate::frame::Frame;
use crate::grid::Grid;
use crate::memory::Memoryless;

/// The nodes in a box move with a rigid body. The box stays where it is: this is
/// contact for strokes that are small against a cell, [`MovingNodes`] that for others. Material sticks to it along the axes
/// that it holds, and cannot leave it.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidNodes<const D: usize> {
    /// Lower and upper end along every axis (m), infinite ones allowed. A node counts as within up to a
    /// billionth of a cell.
    pub extent: [[f64; 2]; D],
    /// Velocity (m/s) of the axes that are held: of a rough body all, of a smooth one its normal.
    pub velocity: [Option<f64>; D],
    /// Factor over time of the velocity.
    pub amplitude: Amplitude,
}

/// A node this fraction of a cell outside still counts as within.
const MARGIN: f64 = 1e-9;

impl<const D: usize> Memoryless for RigidNodes<D> {}

impl<const D: usize> Constraint<D> for RigidNodes<D> {
    fn prescribe(&self, grid: &Grid<D>, position: &[f64; D], axis: usize) -> Option<f64> {
        let margin = MARGIN * grid.h;
        let mut ends = position.iter().zip(&self.extent);
        let within = ends.all(|(x, [lo, hi])| *x >= lo - margin && *x <= hi + margin);
        self.velocity[axis].filter(|_| within)
    }

    fn amplitude(&self, time: f64) -> f64 {
        self.amplitude.at(time)
    }

    fn travel(&self, time: f64, dt: f64) -> f64 {
        self.amplitude.integral(time + dt) - self.amplitude.integral(time)
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Constraint<D>> {
        Box::new(self.rigid_from(frame))
    }
}

impl<const D: usize> RigidNodes<D> {
    fn rigid_from(&self, frame: &Frame<D>) -> Self {
        let mut velocity = [None; D];
        for (axis, v) in self.velocity.iter().enumerate() {
            let (axis, sign) = frame.axis(axis);
            velocity[axis] = v.map(|v| frame.scale(0, 1) * sign * v);
        }
        Self { extent: frame.extent(&self.extent), velocity, amplitude: self.amplitude.clone() }
    }
}

/// The nodes in a box that moves with its velocity: those of its start, moved by the whole number of cells that is nearest
/// to its stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingNodes<const D: usize> {
    /// Nodes before it moves.
    pub nodes: RigidNodes<D>,
    /// Stroke at time zero (m).
    pub from: [f64; D],
}

impl<const D: usize> Memoryless for MovingNodes<D> {}

impl<const D: usize> Constraint<D> for MovingNodes<D> {
    fn prescribe(&self, grid: &Grid<D>, position: &[f64; D], axis: usize) -> Option<f64> {
        self.nodes.prescribe(grid, position, axis)
    }

    fn amplitude(&self, time: f64) -> f64 {
        self.nodes.amplitude.at(time)
    }

    fn travel(&self, time: f64, dt: f64) -> f64 {
        Constraint::<D>::travel(&self.nodes, time, dt)
    }

    fn shift(&self, grid: &Grid<D>, time: f64) -> [f64; D] {
        let rise = self.nodes.amplitude.integral(time);
        let stroke = |a: usize| self.from[a] + self.nodes.velocity[a].map_or(0.0, |v| v * rise);
        std::array::from_fn(|a| (stroke(a) / grid.h).round())
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Constraint<D>> {
        Box::new(Self { nodes: self.nodes.rigid_from(frame), from: frame.vector(&self.from, frame.scale(0, 1)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Axis;

    #[test]
    fn nodes_at_its_ends_are_its_own() {
        let grid = Grid::new(0.5, [Axis::open(0.0, 8); 2]).unwrap();
        let body = RigidNodes {
            extent: [[1.0, 2.0], [0.5, 0.5]],
            velocity: [Some(3.0), None],
            amplitude: Amplitude::Rise(0.0),
        };
        for (x, held) in [(0.5, false), (1.0, true), (1.5, true), (2.0, true), (2.5, false)] {
            let own = body.prescribe(&grid, &[x, 0.5], 0);
            assert_eq!(own, held.then_some(3.0), "{x}");
            assert_eq!(body.prescribe(&grid, &[x, 0.5], 1), None);
            assert_eq!(body.prescribe(&grid, &[x, 1.0], 0), None);
        }
    }
}
