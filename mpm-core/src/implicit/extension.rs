//! Extension (Höllig, Reif & Wipper 2001, doi:10.1137/S0036142900373208): a function that sees hardly any material is
//! no unknown of its own, but moves as a linear field through the nearest functions that see more.

use super::pieces::{AxisPieces, Pieces};
use crate::lattice::Lattice;

/// Share of a full function's volume below which a function is extended.
pub(super) const HARDLY: f64 = 0.1;
/// How far, in nodes along an axis, the functions that it follows may be.
const REACH: isize = 4;

/// Nodes that a node follows, with their shares; empty for a node with its own unknowns.
pub type Shares = Vec<Vec<(usize, f64)>>;

/// Nodes of a body; images stand for their originals.
#[derive(Debug)]
pub struct Nodes<'a> {
    /// Original of every node.
    pub originals: &'a [usize],
    /// Volume (m³) that it sees; NaN if no element has it.
    pub volume: &'a [f64],
    /// Whether a constraint holds it: such a node is never extended.
    pub held: &'a [bool],
}

/// The shares by which nodes that see hardly any material follow others.
pub(super) fn shares<const D: usize, const S: usize, B: Pieces<S>>(
    lattice: &Lattice<D, S, B>,
    nodes: &Nodes,
) -> Shares {
    let full: [Vec<f64>; D] = std::array::from_fn(|a| lengths(&B::pieces(&lattice.grid.axes[a], lattice.grid.h)));
    let mut indices = Vec::new();
    let mut place_of = std::collections::BTreeMap::new();
    let mut sees_enough = vec![false; nodes.volume.len()];
    lattice.for_each_node(|node, index| {
        let whole: f64 = (0..D).map(|a| full[a][index[a]]).product();
        sees_enough[node] = nodes.volume[nodes.originals[node]] >= HARDLY * whole;
        indices.push((node, *index));
        place_of.insert(*index, node);
    });
    let mut shares = vec![Vec::new(); nodes.volume.len()];
    for (node, index) in indices {
        let own = nodes.originals[node] != node || nodes.held[node] || nodes.volume[node].is_nan() || sees_enough[node];
        if own {
            continue;
        }
        let enough = |index: &[usize; D]| {
            let node = *place_of.get(index)?;
            sees_enough[node].then_some(node)
        };
        let blocks = blocks_around(&index).filter(|first| {
            let corners = corners::<D>();
            corners.into_iter().all(|c| enough(&moved(first, &c)).is_some())
        });
        let x = lattice.position(&index);
        let distance = |first: &[usize; D]| -> f64 {
            let (lo, hi) = (lattice.position(first), lattice.position(&moved(first, &[1; D])));
            (0..D).map(|a| (x[a] - 0.5 * (lo[a] + hi[a])).powi(2)).sum()
        };
        let Some(first) = blocks.min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
            continue;
        };
        for corner in corners::<D>() {
            let (lo, hi) = (lattice.position(&first), lattice.position(&moved(&first, &[1; D])));
            let share = (0..D).map(|a| {
                let t = (x[a] - lo[a]) / (hi[a] - lo[a]);
                if corner[a] == 0 { 1.0 - t } else { t }
            });
            if let Some(followed) = enough(&moved(&first, &corner)) {
                shares[node].push((nodes.originals[followed], share.product()));
            }
        }
    }
    shares
}

/// ∫ w dx (m) of the functions of an axis in full material.
fn lengths(pieces: &AxisPieces) -> Vec<f64> {
    let mut lengths = vec![0.0; pieces.mass.len() + pieces.degree];
    for (first, mass) in pieces.mass.iter().enumerate() {
        for k in 0..=pieces.degree {
            lengths[first + k] += mass[k].iter().sum::<f64>();
        }
    }
    lengths
}

/// The corners of a block of two nodes along every axis.
fn corners<const D: usize>() -> Vec<[usize; D]> {
    let corner = |k: usize| std::array::from_fn(|a| k >> a & 1);
    (0..1 << D).map(corner).collect()
}

fn moved<const D: usize>(index: &[usize; D], by: &[usize; D]) -> [usize; D] {
    std::array::from_fn(|a| index[a] + by[a])
}

/// The first nodes of the blocks within reach.
fn blocks_around<const D: usize>(index: &[usize; D]) -> impl Iterator<Item = [usize; D]> {
    let (index, width) = (*index, 2 * REACH as usize);
    (0..width.pow(D as u32)).filter_map(move |k| {
        let mut first = [0; D];
        for a in 0..D {
            let by = (k / width.pow(a as u32) % width) as isize - REACH;
            first[a] = index[a].checked_add_signed(by)?;
        }
        Some(first)
    })
}
