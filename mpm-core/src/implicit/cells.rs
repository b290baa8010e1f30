//! Stiffness of F̄ onto constants of cells. It couples no particles but those of one cell, so that it is assembled.

use super::algebra::dot;
use super::elements::Elements;
use super::response::Tangent;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// A cell with particles.
#[derive(Default)]
pub(super) struct Cell {
    /// The nodes that its particles see, in order.
    pub(super) node: Vec<usize>,
    particles: Vec<usize>,
    /// Volume of its particles (m³).
    volume: f64,
}

/// The cells of particles of a `volume` (m³), of which `of_cells` has one function each, and `elements` the nodes.
pub(super) fn cells<const D: usize>(elements: &Elements<D>, of_cells: &Elements<D>, volume: &[f64]) -> Vec<Cell> {
    let mut cells: BTreeMap<usize, Cell> = BTreeMap::new();
    for (p, volume) in volume.iter().enumerate() {
        for cell in of_cells.seen(p).0 {
            let cell = cells.entry(*cell).or_default();
            cell.particles.push(p);
            cell.volume += volume;
            cell.node.extend(elements.seen(p).0);
        }
    }
    let mut cells: Vec<Cell> = cells.into_values().collect();
    for cell in &mut cells {
        cell.node.sort_unstable();
        cell.node.dedup();
    }
    cells
}

impl Cell {
    /// Stiffness (N/m) that couples the particles of the cell, of volumes `volume` (m³), where A = εI + (1 − ε)Π with
    /// the share ε = `unseen`. Eq. (11) of `docs/implicit.md` is the sum of this and of a share of each particle alone.
    /// With G = Σ V D, S = Σ (∂P/∂a + ε ∂q/∂a cof) ∇w and T = Σ (∂q/∂ΔF + ε ∂q/∂a cof) ∇w it is
    /// (1 − ε)/V (S Gᵀ + G Tᵀ) + ((1 − ε)/V)² Σ ∂q/∂a G Gᵀ.
    pub(super) fn stiffness<const D: usize>(
        &self,
        elements: &Elements<D>,
        volume: &[f64],
        tangents: &[Tangent<D>],
        unseen: f64,
    ) -> DMatrix<f64> {
        let [mut change, mut stress, mut pull] = [(); 3].map(|()| DVector::zeros(self.node.len() * D));
        let mut modulus = 0.0;
        for p in &self.particles {
            let t = &tangents[*p];
            let own = unseen * t.pull_by_a;
            modulus += t.pull_by_a;
            let (nodes, _, dw) = elements.seen(*p);
            for (node, dw) in nodes.iter().zip(dw) {
                let Ok(place) = self.node.binary_search(node) else { continue };
                for a in 0..D {
                    let by = dot(&t.cofactor[a], dw);
                    change[place * D + a] += volume[*p] * by;
                    stress[place * D + a] += dot(&t.stress_by_a[a], dw) + own * by;
                    pull[place * D + a] += dot(&t.pull_by_f[a], dw) + own * by;
                }
            }
        }
        let share = (1.0 - unseen) / self.volume;
        // G (Tᵀ + c Gᵀ) with c = (1 − ε)/V Σ ∂q/∂a.
        pull.axpy(share * modulus, &change, 1.0);
        (&stress * change.transpose() + &change * pull.transpose()) * share
    }
}
