//! Ledger of a run: time, sums, reactions and counters, the same for every solver.

use crate::contact::RigidContact;
use crate::error::{Error, Fault};
use crate::memory::MemoryError;
use crate::monitor::{Accumulated, Convergence, Reaction, Residual};
use crate::scene::Part;
use crate::work::{Spent, Work};
use serde::{Deserialize, Serialize};

/// Time, sums, reactions and counters of a run, to be read by the methods of [`Simulation`](crate::Simulation).
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Ledger {
    /// Time (s).
    pub(crate) time: f64,
    pub(crate) accumulated: Accumulated,
    pub(crate) residual: Residual,
    /// Convergence of the last step, of a solver with Newton's method.
    pub(crate) convergence: Option<Convergence>,
    /// Reactions of the constraints, in the scene's order, and of the bodies on what they touch.
    pub(crate) reactions: Vec<Reaction>,
    pub(crate) touches: Vec<Reaction>,
    pub(crate) work: Work,
    /// Wall time, which a checkpoint does not keep.
    #[serde(skip)]
    pub(crate) spent: Spent,
}

impl Ledger {
    /// Ledger of a run at time zero.
    pub(crate) fn new([particles, nodes]: [usize; 2], constraints: usize, bodies: usize) -> Self {
        Self {
            reactions: vec![Reaction::default(); constraints],
            touches: vec![Reaction::default(); bodies],
            work: Work { particles: particles as u64, nodes: nodes as u64, ..Work::default() },
            ..Self::default()
        }
    }

    /// Counts a completed step.
    pub(crate) fn count_step(&mut self) {
        self.work.steps += 1;
        self.work.particle_steps += self.work.particles;
    }

    /// Counts a completed step that Newton's method made in `parts` parts.
    pub(crate) fn count_parts(&mut self, parts: u32) {
        if let Some(convergence) = &mut self.convergence {
            convergence.parts = parts;
        }
        self.count_step();
    }

    /// Reaction of a part of the scene with these contacts; NaN of a part that does not exist.
    pub(crate) fn on<const D: usize>(&self, part: Part, contacts: &[RigidContact<D>]) -> Reaction {
        let found = match part {
            Part::Constraint(place) => self.reactions.get(place).copied(),
            Part::Body(place) => self.touches.get(place).copied(),
            Part::Contact(place) => contacts.get(place).map(RigidContact::reaction),
        };
        found.unwrap_or(Reaction::NONE)
    }

    /// Error of the present step for the particle at `index` in the columns, whose identities are `ids`.
    pub(crate) fn breakdown(&self, ids: &[u32], index: usize, fault: Fault) -> Error {
        Error::Breakdown {
            time: self.time,
            step: self.work.steps,
            particle: ids.get(index).copied().unwrap_or(0),
            fault,
        }
    }

    /// Checks that `saved` is the ledger of a run with the same constraints and nodes.
    pub(crate) fn check(&self, saved: &Self) -> Result<(), MemoryError> {
        let (constraints, nodes) = (self.reactions.len(), self.work.nodes as usize);
        MemoryError::unless_equal("constraints", saved.reactions.len(), constraints)?;
        MemoryError::unless_equal("bodies", saved.touches.len(), self.touches.len())?;
        MemoryError::unless_equal("nodes", saved.work.nodes as usize, nodes)
    }

    /// Replaces all but the wall time by what was saved.
    pub(crate) fn restore(&mut self, saved: Self) {
        let spent = self.spent;
        *self = Self { spent, ..saved };
    }
}
