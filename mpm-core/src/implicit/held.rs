//! Components of nodes that constraints hold.

use super::interpolation::Interpolation;
use crate::error::{Error, require_none};
use crate::scene::Scene;
use crate::stage::{Bound, Constraint, holder, require_held};

/// A component of a node that a constraint holds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Held {
    /// Velocity (m/s) at the amplitude one.
    pub(crate) velocity: f64,
    /// Place of the constraint in the scene's list.
    pub(crate) by: usize,
}

/// Refuses constraints on one side.
pub(crate) fn check<const D: usize>(constraints: &[Box<dyn Constraint<D>>]) -> Result<(), Error> {
    let one_sided = constraints.iter().filter(|c| c.bound() != Bound::Equal).count();
    let allowed = "none: walls of such a run are fixed or rollers";
    require_none(one_sided, "one-sided constraints of a quasi-static run", allowed)
}

/// Constraint of every component of every node at `time` (s): the first of the scene's constraints that holds it.
///
/// # Errors
/// A constraint holds nothing.
pub(crate) fn components<const D: usize>(
    functions: &dyn Interpolation<D>,
    scene: &Scene<D>,
    time: f64,
) -> Result<Vec<[Option<Held>; D]>, Error> {
    let mut held = vec![[None; D]; functions.len()];
    functions.for_each_node(&mut |node, position| {
        for (axis, held) in held[node].iter_mut().enumerate() {
            let first = holder(&scene.constraints, &scene.grid, &position, (axis, time));
            *held = first.map(|(by, velocity)| Held { velocity, by });
        }
    });
    require_held(scene.constraints.len(), held.as_flattened().iter().flatten().map(|held| held.by))?;
    Ok(held)
}

/// The integrals of the constraints' amplitudes (s) over `dt` (s) from `time` (s).
pub(crate) fn travel<const D: usize>(constraints: &[Box<dyn Constraint<D>>], time: f64, dt: f64) -> Vec<f64> {
    constraints.iter().map(|c| c.travel(time, dt)).collect()
}
