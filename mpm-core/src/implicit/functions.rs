//! Functions at one place: nodes, values, gradients.

use crate::lattice::Stencil;

/// The functions that see a place, and which they are.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Functions<const D: usize> {
    /// Equal for all places that the same nodes see.
    pub element: usize,
    /// Their nodes.
    pub node: Vec<usize>,
    /// Values.
    pub w: Vec<f64>,
    /// Gradients (1/m).
    pub dw: Vec<[f64; D]>,
}

impl<const D: usize> Functions<D> {
    /// None yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Those of a stencil.
    pub(super) fn set<const S: usize>(&mut self, stencil: &Stencil<D, S>) {
        let last = stencil.last();
        self.element = stencil.first();
        self.node.clear();
        self.w.clear();
        self.dw.clear();
        let (lines, rows) = Stencil::<D, S>::OUTER;
        for r in 0..lines * rows {
            let row = stencil.row(r / rows, r % rows);
            for k in 0..S {
                let mut dw = row.gradient.map(|g| g * last.w[k]);
                dw[D - 1] = row.w * last.dw[k];
                self.node.push(row.node + k);
                self.w.push(row.w * last.w[k]);
                self.dw.push(dw);
            }
        }
    }
}
