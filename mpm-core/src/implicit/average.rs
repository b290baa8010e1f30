//! The average A of F̄ on the functions of a step: the volume average Π, or I − (1 − ε)(I − Π)².
//!
//! V A is symmetric, and so Aᵀ = V A V⁻¹ of the volumes V at the step's start.

use super::elements::Elements;
use crate::parallel::{LIGHT, map};

/// The share ε of a field that Π cannot see which A keeps, as the explicit remedy does.
const UNSEEN: f64 = 0.01;

/// A, frozen in a step.
pub(super) struct Average {
    /// Volume of every particle (m³).
    volume: Vec<f64>,
    /// One over the volume of every node, zero of nodes that see none.
    inverse: Vec<f64>,
    /// Whether A is I − (1 − ε)(I − Π)².
    sharp: bool,
}

impl Average {
    pub(super) fn new<const D: usize>(elements: &Elements<D>, nodes: usize, volume: &[f64], sharp: bool) -> Self {
        let of_nodes = elements.sums(nodes, volume);
        let inverse = |v: &f64| if *v > 0.0 { 1.0 / v } else { 0.0 };
        Self { volume: volume.to_vec(), inverse: of_nodes.iter().map(inverse).collect(), sharp }
    }

    /// The share of a field that Π cannot see which A keeps.
    pub(super) fn unseen(&self) -> f64 {
        if self.sharp { UNSEEN } else { 0.0 }
    }

    /// Π `field`.
    pub(super) fn project<const D: usize>(&self, elements: &Elements<D>, field: &[f64]) -> Vec<f64> {
        let mut of_nodes = vec![0.0; self.inverse.len()];
        elements.scatter(0.0, &mut of_nodes, |p, sums| {
            let weighted = self.volume[p] * field[p];
            for (sum, w) in sums.iter_mut().zip(elements.seen(p).1) {
                *sum += w * weighted;
            }
        });
        for (value, inverse) in of_nodes.iter_mut().zip(&self.inverse) {
            *value *= inverse;
        }
        let gather = |p: usize| {
            let (nodes, w, _) = elements.seen(p);
            let pairs = nodes.iter().zip(w);
            pairs.map(|(node, w)| w * of_nodes[*node]).sum()
        };
        map(field.len(), LIGHT, gather)
    }

    /// A `field`.
    pub(super) fn apply<const D: usize>(&self, elements: &Elements<D>, field: &[f64]) -> Vec<f64> {
        let smooth = self.project(elements, field);
        if !self.sharp {
            return smooth;
        }
        let rough: Vec<f64> = field.iter().zip(&smooth).map(|(f, s)| f - s).collect();
        let seen = self.project(elements, &rough);
        let combine = |p: usize| smooth[p] + UNSEEN * rough[p] + (1.0 - UNSEEN) * seen[p];
        (0..field.len()).map(combine).collect()
    }

    /// Aᵀ `field`.
    pub(super) fn transposed<const D: usize>(&self, elements: &Elements<D>, field: &[f64]) -> Vec<f64> {
        let per_volume: Vec<f64> = field.iter().zip(&self.volume).map(|(f, v)| f / v).collect();
        let averaged = self.apply(elements, &per_volume);
        let pairs = averaged.iter().zip(&self.volume);
        pairs.map(|(a, v)| a * v).collect()
    }
}
