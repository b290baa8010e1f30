//! The unknowns of a step, and the pattern of its stiffness matrix.

use super::elements::Elements;
use super::penalty::Penalty;
use serde::{Deserialize, Serialize};

/// No unknown.
const NONE: usize = usize::MAX;

/// The components of displacement of the nodes that a step moves.
pub(crate) struct Unknowns<const D: usize> {
    /// Place of every node among those that move; `NONE` for one that sees nothing.
    place: Vec<usize>,
    /// The nodes, in their order.
    pub(crate) node: Vec<usize>,
    /// Prescribed increment (m) of every unknown that is held.
    pub(crate) held: Vec<Option<f64>>,
}

impl<const D: usize> Unknowns<D> {
    /// Components of the nodes that see a particle or a penalty, from the number of nodes and the cell size (m).
    pub(crate) fn new(
        (nodes, h): (usize, f64),
        elements: &Elements<D>,
        penalties: &[Penalty],
        prescribed: impl Fn(usize, usize) -> Option<f64>,
    ) -> Self {
        let mut seen = elements.seen_nodes(nodes, h);
        for node in penalties.iter().flat_map(|p| &p.node) {
            seen[*node] = true;
        }
        let node: Vec<usize> = (0..nodes).filter(|n| seen[*n]).collect();
        let mut place = vec![NONE; nodes];
        let mut held = Vec::with_capacity(node.len() * D);
        for (k, node) in node.iter().enumerate() {
            place[*node] = k;
            held.extend((0..D).map(|axis| prescribed(*node, axis)));
        }
        Self { place, node, held }
    }

    /// How many unknowns there are, held ones included.
    pub(crate) fn len(&self) -> usize {
        self.held.len()
    }

    /// The place of a node among those that move, if it does.
    pub(crate) fn of(&self, node: usize) -> Option<usize> {
        Some(self.place[node]).filter(|place| *place != NONE)
    }

    /// Whether a component of the node at a place is free: of a pressure, behind the displacements, always.
    pub(crate) fn is_free(&self, place: usize, component: usize) -> bool {
        component >= D || self.held[place * D + component].is_none()
    }

    /// The nodal increments with the values `u` of the unknowns (m).
    pub(crate) fn spread(&self, u: &[f64], nodes: &mut [[f64; D]]) {
        for (node, u) in self.node.iter().zip(u.as_chunks().0) {
            nodes[*node] = *u;
        }
    }
}

/// Where the entries of a matrix are: column by column, rows in order. Held unknowns have their diagonal alone.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Pattern {
    /// Components of a node: its displacements, and with F̄ a pressure.
    pub(crate) width: usize,
    /// Where each column begins, and the last one ends.
    pub(crate) begin: Vec<usize>,
    /// Row of every entry.
    pub(crate) row: Vec<usize>,
}

impl Pattern {
    /// Pattern of matrices with `width` components a node, which join the nodes of every element and `others`.
    pub(crate) fn new<'a, const D: usize>(
        width: usize,
        unknowns: &Unknowns<D>,
        elements: &Elements<D>,
        others: impl Iterator<Item = &'a Vec<usize>>,
    ) -> Self {
        let mut beside: Vec<Vec<usize>> = vec![Vec::new(); unknowns.node.len()];
        let mut join = |nodes: &[usize]| {
            let places: Vec<usize> = nodes.iter().filter_map(|n| unknowns.of(*n)).collect();
            for place in &places {
                beside[*place].extend_from_slice(&places);
            }
        };
        for element in 0..elements.particles.len() {
            join(elements.nodes_of(element));
        }
        others.for_each(|nodes| join(nodes));
        let mut pattern = Self { width, begin: vec![0], row: Vec::new() };
        for (k, beside) in beside.iter_mut().enumerate() {
            beside.sort_unstable();
            beside.dedup();
            for column in 0..width {
                if unknowns.is_free(k, column) {
                    let of_node = |node: usize| {
                        let free = (0..width).filter(move |a| unknowns.is_free(node, *a));
                        free.map(move |a| node * width + a)
                    };
                    pattern.row.extend(beside.iter().copied().flat_map(of_node));
                } else {
                    pattern.row.push(k * width + column);
                }
                pattern.begin.push(pattern.row.len());
            }
        }
        pattern
    }

    /// Unknowns.
    pub(crate) fn len(&self) -> usize {
        self.begin.len() - 1
    }

    /// Entries.
    pub(crate) fn entries(&self) -> usize {
        self.row.len()
    }

    /// The place of an entry, if it is one.
    pub(crate) fn place(&self, row: usize, column: usize) -> Option<usize> {
        let begin = self.begin[column];
        let rows = &self.row[begin..self.begin[column + 1]];
        rows.binary_search(&row).ok().map(|k| begin + k)
    }
}
