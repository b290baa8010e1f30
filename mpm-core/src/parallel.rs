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

/// Pieces of columns that threads share.
pub trait Front: Send {
    /// Takes the first `n` particles off, or all if there are fewer.
    #[must_use]
    fn front(&mut self, n: usize) -> Self;
}

/// Takes the first `n` entries off a column, or all if there are fewer: of a column that isn't there, nothing.
pub fn cut<'a, T>(column: &mut &'a mut [T], n: usize) -> &'a mut [T] {
    let n = n.min(column.len());
    column.split_off_mut(..n).unwrap_or_default()
}

impl<A: Front, B: Front> Front for (A, B) {
    fn front(&mut self, n: usize) -> Self {
        (self.0.front(n), self.1.front(n))
    }
}

/// `visit(chunk, sums)` for chunks of [`CHUNK`] particles and what is summed over each.
pub fn for_each_chunk<P: Front, T: Send>(
    mut all: P,
    sums: &mut [T],
    visit: &(impl Fn(P, &mut T) + Sync),
) {
    if sums.len() > AT_ONCE {
        let (before, after) = sums.split_at_mut(sums.len() / 2);
        let front = all.front(before.len() * CHUNK);
        rayon::join(
            || for_each_chunk(front, before, visit),
            || for_each_chunk(all, after, visit),
        );
    } else {
        for sums in sums {
            visit(all.front(CHUNK), sums);
        }
    }
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
        let (Some(runs), Some(slabs)) = (nodes.get_mut(start..), slabs.get(colour..)) else {
            continue;
        };
        run_by_run(runs, start, RUN * plane, slabs, &kernel);
    }
}

/// Runs of `run` nodes of one colour, the first of which begins at node `first`, and the slabs from its own on. Slabs
/// are few and unlike, so each is for the next thread that is free.
fn run_by_run<T: Send>(
    nodes: &mut [T],
    first: usize,
    run: usize,
    slabs: &[Range<usize>],
    kernel: &(impl Fn(Range<usize>, &mut [T], usize) + Sync),
) {
    let runs = slabs.len().div_ceil(2);
    if runs > 1 {
        let half = runs / 2;
        let (before, after) = nodes.split_at_mut(nodes.len().min(half * run));
        let (slabs_before, slabs_after) = slabs.split_at(2 * half);
        rayon::join(
            || run_by_run(before, first, run, slabs_before, kernel),
            || run_by_run(after, first + half * run, run, slabs_after, kernel),
        );
    } else if let Some(particles) = slabs.first() {
        kernel(particles.clone(), nodes, first);
    }
}
