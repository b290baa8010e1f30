//! Scene of a run: a grid, bodies, and what acts on them.

use crate::bodies::Bodies;
use crate::contact::RigidContact;
use crate::error::{Error, require};
use crate::frame::Frame;
use crate::grid::Grid;
use crate::memory::{Memory, MemoryError, Saved, restore_all, save_all};
use crate::stage::{Constraint, Load};

/// A part of the scene on which something acts, by its place in the scene's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A constraint.
    Constraint(usize),
    /// A contact with a rigid body.
    Contact(usize),
    /// A body that slides on others, or all that stick to each other under the place of any of them: what contact with
    /// other bodies does to it.
    Body(usize),
}

/// A grid, bodies on it, and the loads, constraints and contacts that the scene has. How it is solved is the solver's.
pub struct Scene<const D: usize> {
    /// The grid.
    pub grid: Grid<D>,
    /// The bodies.
    pub bodies: Bodies<D>,
    /// Loads.
    pub loads: Vec<Box<dyn Load<D>>>,
    /// Constraints. Their places are those of [`Part::Constraint`].
    pub constraints: Vec<Box<dyn Constraint<D>>>,
    /// Contacts with rigid bodies. Their places are those of [`Part::Contact`].
    pub contacts: Vec<RigidContact<D>>,
}

/// Memories of the loads, constraints and contacts of a scene.
pub(crate) type SavedStages = (Vec<Saved>, Vec<Saved>, Vec<Saved>);

impl<const D: usize> Scene<D> {
    /// `bodies` on `grid`, left to themselves.
    #[must_use]
    pub fn new(grid: Grid<D>, bodies: Bodies<D>) -> Self {
        Self { grid, bodies, loads: Vec::new(), constraints: Vec::new(), contacts: Vec::new() }
    }

    /// With another load.
    #[must_use]
    pub fn load(mut self, load: impl Load<D> + 'static) -> Self {
        self.loads.push(Box::new(load));
        self
    }

    /// With another constraint. Where several hold the same component of a node, the first one counts.
    #[must_use]
    pub fn constrain(self, constraint: impl Constraint<D> + 'static) -> Self {
        self.constrain_all([constraint])
    }

    /// With several constraints, in their order.
    #[must_use]
    pub fn constrain_all<C: Constraint<D> + 'static>(mut self, constraints: impl IntoIterator<Item = C>) -> Self {
        for constraint in constraints {
            self.constraints.push(Box::new(constraint));
        }
        self
    }

    /// Refuses particles wider than a cell.
    pub(crate) fn check_half_size(&self) -> Result<(), Error> {
        let (what, allowed) = ("particle half size", "at most half a cell (m)");
        let mut half_size = self.bodies.particles.half_size.into_iter();
        half_size.try_for_each(|l| require(l <= 0.5 * self.grid.h, what, l, allowed))
    }

    /// Memories of the stages.
    pub(crate) fn save_stages(&self) -> Result<SavedStages, MemoryError> {
        let contacts: Result<_, _> = self.contacts.iter().map(Memory::save).collect();
        Ok((save_all(&self.loads)?, save_all(&self.constraints)?, contacts?))
    }

    /// Restores the stages from their memories.
    pub(crate) fn restore_stages(&mut self, saved: &SavedStages) -> Result<(), MemoryError> {
        let (loads, constraints, contacts) = saved;
        restore_all("loads", &mut self.loads, loads)?;
        restore_all("constraints", &mut self.constraints, constraints)?;
        MemoryError::unless_equal("contacts", contacts.len(), self.contacts.len())?;
        for (contact, saved) in self.contacts.iter_mut().zip(contacts) {
            contact.restore(saved)?;
        }
        Ok(())
    }

    /// Bytes for the next run: the body, and the sticks of the contacts.
    pub(crate) fn hand_over(&self, body: Saved) -> Result<Saved, MemoryError> {
        let sticks = self.contacts.iter().map(|c| c.sticks().as_flattened());
        Saved::of(&(body, sticks.collect::<Vec<_>>()))
    }

    /// Takes the sticks of a run that ended, contact by contact as far as both have one with friction there; others
    /// begin unstretched.
    pub(crate) fn take_sticks(&mut self, sticks: &[Vec<f64>]) {
        for (contact, sticks) in self.contacts.iter_mut().zip(sticks) {
            let (rows, _) = sticks.as_chunks();
            contact.stick((0..).zip(rows.iter().copied()));
        }
    }

    /// The same scene, before its first step, seen from `frame`.
    ///
    /// # Errors
    /// As [`Bodies::new`].
    pub fn seen_from(self, frame: &Frame<D>) -> Result<Self, Error> {
        let loads = self.loads.into_iter().map(|load| load.seen_from(frame));
        let constraints = self.constraints.into_iter().map(|c| c.seen_from(frame));
        let contacts = self.contacts.iter().map(|c| c.seen_from(frame));
        Ok(Self {
            grid: frame.grid(&self.grid),
            bodies: self.bodies.seen_from(frame)?,
            loads: loads.collect(),
            constraints: constraints.collect(),
            contacts: contacts.collect(),
        })
    }

    /// With another contact.
    #[must_use]
    pub fn contact(mut self, contact: RigidContact<D>) -> Self {
        self.contacts.push(contact);
        self
    }
}
