//! Stages of a scene: loads, filters and constraints, and the criterion of rest.
//!
//! Four roles, called once per step; a scene lists the stages that it has, and an absent one costs
//! nothing:
//! * a [`Load`] adds to the particles' external force;
//! * a [`ForceFilter`] changes nodal forces, knowing the nodal velocities (damping);
//! * a [`Constraint`] declares nodes, axes and prescribed velocities;
//! * a [`ParticleFilter`] acts on the particles after the step (kinetic damping).
//!
//! A stage that carries something from one step to the next says so in its [`Memory`]; the others are
//! [`Memoryless`](crate::Memoryless).

mod amplitude;
mod dashpots;
mod kinetic_damping;
mod load;
mod local_damping;
mod pressure;
mod rest;
mod rigid_nodes;
mod sides;
mod wall;

pub use amplitude::Amplitude;
pub use dashpots::Dashpots;
pub use kinetic_damping::KineticDamping;
pub use load::{BodyForce, DeadForce, ForceField, Gravity};
pub use local_damping::LocalDamping;
pub use pressure::Pressure;
pub use rest::{Observation, RestCriterion};
pub use rigid_nodes::{MovingNodes, RigidNodes};
pub use wall::{End, Wall, WallKind};

use crate::error::{Error, require};
use crate::frame::Frame;
use crate::memory::Memory;
use crate::nodes::NodalState;
use crate::particles::Particles;

/// A load on the particles.
pub trait Load<const D: usize>: Memory + Send {
    /// Adds the load at `time` (s) to the particles' external force (N).
    fn add(&self, time: f64, particles: &mut Particles<D>);

    /// The acceleration (m/s²) at `time` (s) that the load gives to all material alike, if it is such a load: a solver
    /// may apply it to the nodes and leave the particles' forces alone.
    fn acceleration(&self, _time: f64) -> Option<[f64; D]> {
        None
    }

    /// The same load seen from `frame`.
    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>>;
}

/// A filter of nodal forces.
pub trait ForceFilter: Memory + Send + Sync {
    /// Changes the force (N, in `change`) of a node whose `motion` is its velocity (m/s) before the
    /// update; returns the power (W) that it takes from the motion.
    fn filter(&self, node: &mut NodalState) -> f64;
}

/// A prescribed component of a nodal velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prescribed {
    /// Index of the node in nodal arrays.
    pub node: usize,
    /// Component.
    pub axis: usize,
    /// Velocity (m/s) in the present step.
    pub velocity: f64,
    /// Velocity (m/s) at the amplitude one.
    pub full_velocity: f64,
    /// How it relates to the node's.
    pub bound: Bound,
    /// Coulomb's coefficient, by which the impulse of the constraint slows the node across it.
    pub friction: f64,
    /// Force on the node (N) in the present step, before filters: what damping opposes at a held node is no imbalance.
    pub force: f64,
    /// Place of the constraint in the scene's list.
    pub by: usize,
}

impl Prescribed {
    /// The velocity (m/s) of the node, which would be `free` without the constraint, where that acts.
    pub fn held(&self, free: f64) -> Option<f64> {
        let acts = match self.bound {
            Bound::Equal => true,
            Bound::AtLeast => free < self.velocity,
            Bound::AtMost => free > self.velocity,
        };
        acts.then_some(self.velocity)
    }
}

/// How a nodal velocity relates to a prescribed one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// It is that velocity.
    Equal,
    /// It is no lower.
    AtLeast,
    /// It is no higher.
    AtMost,
}

/// A constraint on the motion of nodes. An explicit solver overwrites, an implicit one eliminates.
pub trait Constraint<const D: usize>: Memory + Send {
    /// Whether the node at `position` (m), of a lattice on `grid`, is constrained along `axis`, and
    /// to which velocity (m/s) when the amplitude is one.
    fn prescribe(&self, grid: &crate::Grid<D>, position: &[f64; D], axis: usize) -> Option<f64>;

    /// How the nodes' velocities relate to those prescribed.
    fn bound(&self) -> Bound {
        Bound::Equal
    }

    /// Coulomb's coefficient of what it holds.
    fn friction(&self) -> f64 {
        0.0
    }

    /// The factor of all its velocities at `time` (s).
    fn amplitude(&self, _time: f64) -> f64 {
        1.0
    }

    /// The integral of the amplitude (s) over `dt` (s) from `time` (s).
    fn travel(&self, time: f64, dt: f64) -> f64 {
        // Simpson's rule: exact where an amplitude is a cubic.
        let at = |share: f64| self.amplitude(time + share * dt);
        dt * (at(0.0) + 4.0 * at(0.5) + at(1.0)) / 6.0
    }

    /// Whole cells along every axis by which the nodes that it holds at time zero have moved on at `time` (s).
    fn shift(&self, _grid: &crate::Grid<D>, _time: f64) -> [f64; D] {
        [0.0; D]
    }

    /// The same constraint seen from `frame`.
    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Constraint<D>>;
}

/// Quantity in the error of a scene with a constraint that holds nothing.
pub const HOLDS_NOTHING: &str = "place in the scene's list, from 0, of a constraint that holds no node of its own";

/// The first constraint of a list that holds the node at `position` (m) along `axis` at `time` (s), by its place, and the
/// velocity (m/s) at the amplitude one.
pub(crate) fn holder<const D: usize>(
    constraints: &[Box<dyn Constraint<D>>],
    grid: &crate::Grid<D>,
    position: &[f64; D],
    (axis, time): (usize, f64),
) -> Option<(usize, f64)> {
    constraints.iter().enumerate().find_map(|(by, c)| {
        let shift = c.shift(grid, time);
        let origin = std::array::from_fn(|a| position[a] - shift[a] * grid.h);
        Some((by, c.prescribe(grid, &origin, axis)?))
    })
}

/// Refuses one of `count` constraints that holds nothing, those that do so being at the places `by`.
pub(crate) fn require_held(count: usize, by: impl Iterator<Item = usize>) -> Result<(), Error> {
    let mut idle = vec![true; count];
    by.for_each(|by| idle[by] = false);
    let found = idle.iter().position(|idle| *idle);
    let allowed = "a wall where the grid has one, or a region with nodes";
    require(found.is_none(), HOLDS_NOTHING, found.unwrap_or(0) as f64, allowed)
}

/// A filter of the particles at the end of a step.
pub trait ParticleFilter<const D: usize>: Memory + Send {
    /// Changes the particles, knowing the kinetic energy (J) of the nodes in the step; returns the
    /// energy (J) that it takes from the particles.
    fn filter(&mut self, nodal_kinetic_energy: f64, particles: &mut Particles<D>) -> f64;
}
