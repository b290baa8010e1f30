//! Threads that leave every bit of a result unchanged.
//!
//! *Gathers* write to particles only: they run over chunks of [`CHUNK`] particles, and sums are
//! formed per chunk and added in the order of the chunks.
//!
//! What is done *node by node* runs over chunks of [`NODE_CHUNK`] nodes, likewise ([`crate::reach`]).
//!
//! *Scatters* write to nodes. Particles are sorted by place, and slabs of [`SLAB`] cells along the
//! first axis hold contiguous runs of them. A slab's particles reach fewer than `2 SLAB` planes of
//! nodes, so slabs of even number can run side by side, each on its own run of planes, and then
//! those of odd number. A node thus receives its contributions in an order that the number of
//! threads doesn't change, without atomics and without private grids.

use rayon::iter::repeat_n;
use rayon::prelude::*;
use std::ops::Range;

/// Particles per chunk of a gather.
pub const CHUNK: usize = 1024;
/// Chunks that a thread takes at once, at most: few, so that threads which are not equally fast end together.
pub const AT_ONCE: usize = 4;
/// Nodes per chunk of what is done for nodes: so many that a small scene is one chunk, which wakes no other thread.
pub const NODE_CHUNK: usize = 4096;
/// Cells per slab, along the first axis.
pub const SLAB: usize = 8;
/// Planes kept before the first node, so that the runs of planes of the first slab begin in the array.
pub const PLANES_BEFORE: usize = 2;
/// Planes in a run.
const RUN: usize = 2 * SLAB;

/// The chunks of a column, or as many empty ones (`chunks` of them) if the column is absent (empty).
pub fn chunks_if_present<T: Send>(
    column: &mut [T],
    chunks: usize,
) -> impl IndexedParallelIterator<Item = &mut [T]> {
    let absent = chunks - column.len().div_ceil(CHUNK);
    column
        .par_chunks_mut(CHUNK)
        .chain(repeat_n((), absent).map(|()| <&mut [T]>::default()))
}

/// Scatters particles to `nodes`: `kernel(particles, nodes of the run, index of the run's first node)`
/// for every slab. `slabs[k]` is the range of particles of slab `k`, `plane` the nodes in a plane.
pub fn scatter<T: Send>(
    nodes: &mut [T],
    plane: usize,
    slabs: &[Range<usize>],
    kernel: impl Fn(Range<usize>, &mut [T], usize) + Sync,
) {
    for colour in 0..2 {
        let start = colour * SLAB * plane;
        if let Some(runs) = nodes.get_mut(start..) {
            // Slabs are few and unlike, so each is for the next thread that is free.
            runs.par_chunks_mut(RUN * plane)
                .enumerate()
                .with_max_len(1)
                .for_each(|(j, run)| {
                    if let Some(particles) = slabs.get(2 * j + colour) {
                        kernel(particles.clone(), run, start + j * RUN * plane);
                    }
                });
        }
    }
}
