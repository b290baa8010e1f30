//! Ledger of a run: time, sums, reactions and counters, the same for every solver.

use crate::contact::RigidContact;
use crate::error::{Error, Fault};
use crate::memory::MemoryError;
use crate::monitor::{Accumulated, Convergence, Reaction, Residual};
use crate::simulation::Part;
use crate::work::{Spent, Work};
use serde::{Deserialize, Serialize};

/// Time, sums, reactions and counters of a run.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Ledger {
    /// Time (s).
    pub(crate) time: f64,
    pub(crate) accumulated: Accumulated,
    pub(crate) residual: Residual,
    /// Convergence of the last step, of a solver with Newton's method.
    pub(crate) convergence: Option<Convergence>,
    /// Reactions of the constraints, in the scene's order.
    pub(crate) reactions: Vec<Reaction>,
    pub(crate) work: Work,
    /// Wall time: not kept by a checkpoint.
    #[serde(skip)]
    pub(crate) spent: Spent,
}
