//! Exact work counters: what a run did, independent of the machine.

use serde::{Deserialize, Serialize};

/// Counts of a run since it began.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Work {
    /// Particles.
    pub particles: u64,
    /// Nodes of the lattice, empty ones and images included.
    pub nodes: u64,
    /// Completed steps.
    pub steps: u64,
    /// Particles times steps.
    pub particle_steps: u64,
    /// Particle–node pairs visited by all transfers.
    pub particle_node_pairs: u64,
    /// Applications of the volume average Π.
    pub projections: u64,
    /// Times the particles were sorted by place.
    pub sorts: u64,
}
