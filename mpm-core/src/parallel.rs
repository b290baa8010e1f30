//! Threads that leave every bit of a result unchanged.
//!
//! *Gathers* write to particles only: they run over chunks of [`CHUNK`] particles, and sums are
//! formed per chunk and added in the order of the chunks.
//!
//! Loops *node by node* run over chunks of [`NODE_CHUNK`] nodes in the same way ([`crate::reach`]).
//!
//! *Scatters* write to nodes. Particles are sorted by place, and slabs of [`SLAB`] cells along the
//! first axis hold contiguous runs of them. A slab's particles reach fewer than `2 SLAB` planes of
//! nodes, so slabs of even number can run side by side, each on its own run of planes, and then
//! those of odd number. A node thus receives its contributions in an order that the number of
//! threads does not change, without atomics and without private grids.

use std::ops::Range;

/// Particles per chunk of a gather.
pub const CHUNK: usize = 1024;
/// Chunks that a thread takes at once, at most: few, so that threads which are not equally fast end together.
pub const AT_ONCE: usize = 4;
/// Nodes per chunk in loops over nodes: a small scene is one chunk, which wakes no other thread.
pub const NODE_CHUNK: usize = 4096;
/// Entries a piece of a [`map`] whose entries cost little each, such as particles; elements are a piece each.
pub const LIGHT: usize = 64;
/// Cells per slab, along the first axis.
pub const SLAB: usize = 8;
/// Planes kept before the first node, so that the runs of planes of the first slab begin in the array.
pub const PLANES_BEFORE: usize = 2;
/// Planes in a run.
const RUN: usize = 2 * SLAB;

/// Both, side by side where a thread is free. All that is shared among threads goes through this one instance: what
/// lies behind it is compiled once, not with every kernel.
#[inline(never)]
fn join(a: &mut (dyn FnMut() + Send), b: &mut (dyn FnMut() + Send)) {
    rayon::join(a, b);
}

/// Columns that threads share in pieces.
pub trait Front: Send {
    /// Takes off the first `pieces` pieces, of `entries` together, or all if there are fewer.
    #[must_use]
    fn front(&mut self, pieces: usize, entries: usize) -> Self;
}

impl<T: Send> Front for &mut [T] {
    fn front(&mut self, _pieces: usize, entries: usize) -> Self {
        let n = self.len().min(entries);
        self.split_off_mut(..n).unwrap_or_default()
    }
}

impl<T: Sync> Front for &[T] {
    fn front(&mut self, _pieces: usize, entries: usize) -> Self {
        let n = self.len().min(entries);
        self.split_off(..n).unwrap_or_default()
    }
}

impl<A: Front, B: Front> Front for (A, B) {
    fn front(&mut self, pieces: usize, entries: usize) -> Self {
        (self.0.front(pieces, entries), self.1.front(pieces, entries))
    }
}

/// A column that has a row of several entries where others have one.
pub struct Rows<'a, T> {
    /// The rows, one after the other.
    pub entries: &'a mut [T],
    /// How many entries a row has.
    pub width: usize,
}

impl<T: Send> Front for Rows<'_, T> {
    fn front(&mut self, pieces: usize, entries: usize) -> Self {
        Self { entries: self.entries.front(pieces, entries * self.width), width: self.width }
    }
}

/// One entry a piece: what is summed over it.
pub struct PerPiece<'a, T>(pub &'a mut [T]);

impl<T: Send> Front for PerPiece<'_, T> {
    fn front(&mut self, pieces: usize, _entries: usize) -> Self {
        let n = self.0.len().min(pieces);
        Self(self.0.split_off_mut(..n).unwrap_or_default())
    }
}

/// `visit(first, piece)` for every piece of `size` entries of columns that have `n`; the piece begins at `first`.
pub fn for_each_piece<P: Front>(all: P, n: usize, size: usize, visit: &(impl Fn(usize, P) + Sync)) {
    in_pieces(all, 0..n.div_ceil(size), &|k| k * size, visit);
}

/// `of(k)` of every `k` below `n`, in order; `size` of them are a piece.
pub fn map<T: Send>(n: usize, size: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    of_pieces(n, size, &|piece| piece.map(&of).collect())
}

/// Results of `of` for every piece of `size` numbers below `n`, in their order: one instance a type.
fn of_pieces<T: Send>(n: usize, size: usize, of: &(dyn Fn(Range<usize>) -> Vec<T> + Sync)) -> Vec<T> {
    // One thread has no one to share with, and nothing to put together.
    if rayon::current_num_threads() == 1 {
        return of(0..n);
    }
    let pieces = n.div_ceil(size);
    let mut found: Vec<Vec<T>> = (0..pieces).map(|_| Vec::new()).collect();
    for_each_piece(&mut found[..], pieces, 1, &|k, found: &mut [Vec<T>]| {
        for found in found {
            *found = of(k * size..n.min((k + 1) * size));
        }
    });
    let mut all = Vec::with_capacity(n);
    for found in found {
        all.extend(found);
    }
    all
}

/// `visit(first, piece)` for these `pieces`; piece `k` begins at entry `at(k)` and ends where the next one begins.
pub fn in_pieces<P: Front>(
    mut all: P,
    pieces: Range<usize>,
    at: &(impl Fn(usize) -> usize + Sync),
    visit: &(impl Fn(usize, P) + Sync),
) {
    if pieces.len() > AT_ONCE {
        let middle = pieces.start + pieces.len() / 2;
        let mut before = Some(all.front(middle - pieces.start, at(middle) - at(pieces.start)));
        let mut after = Some(all);
        join(
            &mut || {
                if let Some(front) = before.take() {
                    in_pieces(front, pieces.start..middle, at, visit);
                }
            },
            &mut || {
                if let Some(rest) = after.take() {
                    in_pieces(rest, middle..pieces.end, at, visit);
                }
            },
        );
    } else {
        for piece in pieces {
            visit(at(piece), all.front(1, at(piece + 1) - at(piece)));
        }
    }
}

/// `visit(piece, sums)` for pieces of the particles of a body and what is summed over each; piece `k` begins at the
/// particle `at(k)` of the body.
pub fn for_each_chunk<P: Front, T: Send>(
    all: P,
    sums: &mut [T],
    at: &(impl Fn(usize) -> usize + Sync),
    visit: &(impl Fn(P, &mut T) + Sync),
) {
    let n = sums.len();
    in_pieces((all, PerPiece(sums)), 0..n, at, &|_, (piece, sums)| {
        if let Some(sums) = sums.0.first_mut() {
            visit(piece, sums);
        }
    });
}

/// [`scatter`] of one body after the other.
pub fn scatter_all<T: Send>(
    nodes: &mut [T],
    plane: usize,
    bodies: &[Vec<Range<usize>>],
    kernel: impl Fn(Range<usize>, &mut [T], usize) + Sync,
) {
    bodies.iter().for_each(|slabs| scatter(nodes, plane, slabs, &kernel));
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
/// are few and unlike, so each is for the next thread that is free; what has as few particles as a thread takes at once
/// anyhow wakes no other one.
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
        let particles = slabs.last().map_or(0, |s| s.end) - slabs.first().map_or(0, |s| s.start);
        let parts: [&mut (dyn FnMut() + Send); 2] =
            [&mut || run_by_run(before, first, run, slabs_before, kernel), &mut || {
                run_by_run(after, first + half * run, run, slabs_after, kernel)
            }];
        match parts {
            [a, b] if particles > AT_ONCE * CHUNK => join(a, b),
            parts => parts.into_iter().for_each(|part| part()),
        }
    } else if let Some(particles) = slabs.first() {
        kernel(particles.clone(), nodes, first);
    }
}
