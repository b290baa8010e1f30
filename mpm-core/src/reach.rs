//! The nodes that particles can reach before they are sorted again.
//!
//! Grids are mostly empty: a slide leaves most of a slope bare, a tank is higher than its water. Loops over nodes run
//! over those that a particle sees or may come to see; all other nodes hold zeros. Particles are sorted, and the runs
//! found anew, before one has moved farther than a cell.

use crate::basis::Basis;
use crate::lattice::Lattice;
use crate::parallel::{NODE_CHUNK, for_each_piece};
use std::ops::Range;

/// Runs of consecutive nodes, in their order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reach {
    runs: Vec<Range<usize>>,
}

/// Places of the first nodes of stencils on one row of nodes along the last axis; empty where there are none.
type Places = Range<usize>;

impl Reach {
    /// Nodes within reach of particles at `positions` (m) with half sizes `half_size` (m), if each moves by a cell at
    /// most.
    #[must_use]
    pub fn of<'a, const D: usize, const S: usize, B: Basis<S>>(
        lattice: &Lattice<D, S, B>,
        positions: impl IntoIterator<Item = &'a [[f64; D]]>,
        half_size: &[f64; D],
    ) -> Self {
        if D == 1 || lattice.has_images() {
            // An image's original is somewhere else.
            return Self::everything(lattice);
        }
        let length = lattice.row_length();
        let mut rows: Vec<Places> = vec![0..0; lattice.len() / length];
        for positions in positions {
            lattice.for_each_first_node(positions, half_size, |_, first| {
                let (row, place) = (first / length, first % length);
                rows[row] = union(&rows[row], &(place..place + 1));
            });
        }
        if D == 3 {
            // Runs over into the next plane, which costs a little and does no harm.
            rows = widened::<S>(&rows, 1);
        }
        rows = widened::<S>(&rows, lattice.plane() / length);
        let runs = rows
            .iter()
            .enumerate()
            .filter(|(_, places)| !places.is_empty())
            .map(|(row, places)| {
                let begin = places.start.saturating_sub(1);
                let end = (places.end + S).min(length);
                row * length + begin..row * length + end
            })
            .collect();
        Self { runs }
    }

    /// All nodes of a lattice.
    #[must_use]
    pub fn everything<const D: usize, const S: usize, B: Basis<S>>(lattice: &Lattice<D, S, B>) -> Self {
        Self { runs: std::iter::once(0..lattice.len()).collect() }
    }

    /// Whether `node` is one of them.
    pub fn contains(&self, node: usize) -> bool {
        let after = self.runs.partition_point(|run| run.start <= node);
        after > 0 && self.runs[after - 1].contains(&node)
    }

    /// Parts within reach of a piece of `n` nodes that begins at node `begin`, as places in the piece.
    pub fn within(&self, begin: usize, n: usize) -> impl Iterator<Item = Range<usize>> {
        let end = begin + n;
        let first = self.runs.partition_point(|run| run.end <= begin);
        self.runs[first..]
            .iter()
            .take_while(move |run| run.start < end)
            .map(move |run| run.start.max(begin) - begin..run.end.min(end) - begin)
    }

    /// Sets a nodal field to zero.
    pub fn clear<T: Copy + Default + Send>(&self, field: &mut [T]) {
        let n = field.len();
        for_each_piece(field, n, NODE_CHUNK, &|begin, piece| {
            for part in self.within(begin, piece.len()) {
                piece[part].fill(T::default());
            }
        });
    }
}

/// The smallest range that holds both.
fn union(a: &Places, b: &Places) -> Places {
    match (a.is_empty(), b.is_empty()) {
        (true, _) => b.clone(),
        (_, true) => a.clone(),
        _ => a.start.min(b.start)..a.end.max(b.end),
    }
}

/// For every row the union of those whose stencils touch it, also after a cell's motion to either side, along the
/// axis on which rows are `stride` apart.
fn widened<const S: usize>(rows: &[Places], stride: usize) -> Vec<Places> {
    let mut wide = vec![0..0; rows.len()];
    for (row, places) in rows.iter().enumerate() {
        if places.is_empty() {
            continue;
        }
        let first = row.saturating_sub(stride);
        for touched in (first..rows.len()).step_by(stride).take(S + 2) {
            wide[touched] = union(&wide[touched], places);
        }
    }
    wide
}
