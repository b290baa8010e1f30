//! Exact work counters: what a run did, independent of the machine.

use serde::{Deserialize, Serialize};
use std::time::Instant;

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
    /// Corrections by Newton's method.
    pub newton_iterations: u64,
    /// Solutions by factors, or iterations of conjugate gradients.
    pub linear_iterations: u64,
    /// Assemblies of a stiffness matrix.
    pub assemblies: u64,
    /// Factorisations of a stiffness matrix.
    pub factorisations: u64,
    /// Orders of elimination that were found anew.
    pub analyses: u64,
    /// Entries of the factorised matrices, summed over the factorisations.
    pub nonzeros: u64,
}

/// Wall time (s) that the parts of Newton's iterations took: of this machine, and so neither a count nor kept by a
/// checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spent {
    /// Forces of trials.
    pub forces: f64,
    /// Derivatives at the particles, and matrices of them.
    pub assembly: f64,
    /// Orders of elimination and factors.
    pub factorisation: f64,
    /// Solutions of linear systems.
    pub solution: f64,
}

/// Adds the time (s) that `work` takes to `spent`.
pub(crate) fn clocked<T>(spent: &mut f64, work: impl FnOnce() -> T) -> T {
    let begun = Instant::now();
    let done = work();
    *spent += begun.elapsed().as_secs_f64();
    done
}
