//! Data moved and operations computed by a step of the workloads, in bytes and operations per particle, from the
//! stages' columns.
//!
//! Counted is what a stage reads and writes of its columns if nothing of it stays in a cache from one stage to the next,
//! the particles' share of the nodes (two particles per cell and direction), and the multiplications and additions in
//! the loops over the nodes of a stencil, a fused one as two, vectors of four as four.

use mpm_core::lattice::Weights;
use mpm_core::nodes::NodalState;
use std::mem::size_of;

/// Bytes of a number.
const NUMBER: usize = size_of::<f64>();
/// Numbers of a symmetric tensor.
const SYMMETRIC: usize = 6;

/// Bytes per particle and step.
#[must_use]
pub fn bytes(dimension: usize, fbar: bool) -> f64 {
    let d = dimension;
    let place = d;
    let particle_to_grid = place + 1 + d + 1 + SYMMETRIC;
    // Velocity and J are read and written, volume and stress read.
    let grid_to_particle = 2 * d + 2 + 1 + SYMMETRIC;
    // State, place and volume are read and written, the stress is written, the reference volume read.
    let rest = 2 * SYMMETRIC + 2 * d + 2 + SYMMETRIC + 1;
    let mut numbers = particle_to_grid + grid_to_particle + rest;
    // Zeroed, added to, updated and read; a write is a read and a write.
    let passes_over_nodes = 1 + 2 + 2 + 1;
    let share = 1.0 / f64::from(1 << d);
    let mut bytes = share * (passes_over_nodes * size_of::<NodalState>()) as f64;
    if fbar {
        // ΔF, its determinant and the displacement, kept by G2P and read again; J̄ ΔJ; volumes and values to the nodes and
        // back; the new J̄.
        let between = place + 2 * (d * d + 1 + d);
        let product = 3;
        let average = place + 1 + 2 + 1;
        let new = 1 + 2 + 1;
        numbers += between + product + average + new;
        // Formed once, and read for the volumes, the values and the average.
        let weights = match d {
            2 => size_of::<Weights<2, 3>>(),
            _ => size_of::<Weights<3, 3>>(),
        };
        bytes += (4 * weights) as f64;
        bytes += share * (2 * passes_over_nodes * NUMBER) as f64;
    }
    bytes + (NUMBER * numbers) as f64
}

/// Operations per particle and step in the loops over the nodes.
#[must_use]
pub fn operations(dimension: usize, fbar: bool) -> f64 {
    const NODES: usize = 3;
    const FUSED: usize = 2 * 4;
    let d = dimension;
    let rows = NODES.pow(d as u32 - 1);
    // Per node: momentum, and a force along and across; velocity, its slope and its change.
    let per_node = 3 * FUSED;
    let spread = NODES * per_node + 4 + 4 + (d - 1) * FUSED + 4;
    let gather = NODES * per_node + (2 + d) * FUSED;
    let average = if fbar { 3 * rows * FUSED } else { 0 };
    (rows * (spread + gather) + average) as f64
}

/// Bytes per particle of the columns that the workloads need: what a particle is, not what a stage works with.
#[must_use]
pub fn needed(dimension: usize, fbar: bool) -> f64 {
    let d = dimension;
    // Place in the seeding order; mass, two volumes and J.
    let numbers = 4 + 3 * d + 2 * SYMMETRIC + usize::from(fbar);
    (size_of::<u32>() + NUMBER * numbers) as f64
}
