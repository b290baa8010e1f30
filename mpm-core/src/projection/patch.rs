//! The nodal values of one stencil, in rows that are padded to vectors of four.
//!
//! Particles of one stencil stand side by side (see [`crate::order`]): their sums are formed in a patch, which is
//! added to the nodes once, and they read from a patch that was fetched once. The place after a row's last node
//! has no weight; it is added to and fetched, which changes nothing.

use crate::basis::Basis;
use crate::lattice::{Lattice, Stencil, Weights};
use wide::f64x4;

/// Length of a padded row.
pub(super) const ROW: usize = 4;

/// One row for each pair of places along the outer axes; in two dimensions only the first line of rows is used,
/// in one only the first row.
pub(super) struct Patch<const S: usize>([[f64x4; S]; S]);

/// Weights of the two outer axes, one for an absent axis, and of the last, padded.
#[inline(always)]
fn factors<const D: usize, const S: usize>(weights: &Weights<D, S>) -> ([f64; S], [f64; S], f64x4) {
    let mut last = [0.0; ROW];
    last[..S].copy_from_slice(weights.last());
    let (slow, fast) = match D {
        1 => ([1.0; S], [1.0; S]),
        2 => ([1.0; S], *weights.axis(0)),
        _ => (*weights.axis(0), *weights.axis(1)),
    };
    (slow, fast, f64x4::from(last))
}

/// The vector of a row.
#[inline(always)]
fn fetch(row: &[f64]) -> f64x4 {
    f64x4::new([row[0], row[1], row[2], row[3]])
}

impl<const S: usize> Patch<S> {
    /// A patch of zeros.
    #[inline(always)]
    pub(super) fn zero() -> Self {
        const { assert!(S <= ROW, "a row has at most four nodes") };
        Self([[f64x4::ZERO; S]; S])
    }

    /// Adds w_ip `value` for a particle's `weights`.
    #[inline(always)]
    pub(super) fn add<const D: usize>(&mut self, weights: &Weights<D, S>, value: f64) {
        let (lines, rows) = Stencil::<D, S>::OUTER;
        let (slow, fast, last) = factors(weights);
        for i in 0..lines {
            let line = last * (slow[i] * value);
            for j in 0..rows {
                self.0[i][j] = line.mul_add(f64x4::splat(fast[j]), self.0[i][j]);
            }
        }
    }

    /// Adds the patch to `nodes`, where its first node is `first`.
    #[inline(always)]
    pub(super) fn add_to<const D: usize, B: Basis<S>>(
        &self,
        lattice: &Lattice<D, S, B>,
        first: usize,
        nodes: &mut [f64],
    ) {
        let (lines, rows) = Stencil::<D, S>::OUTER;
        for i in 0..lines {
            for j in 0..rows {
                let begin = first + lattice.row_offset(i, j);
                let row = &mut nodes[begin..begin + ROW];
                let sum = fetch(row) + self.0[i][j];
                row.copy_from_slice(sum.as_array());
            }
        }
    }

    /// The patch of `nodes` whose first node is `first`.
    #[inline(always)]
    pub(super) fn of<const D: usize, B: Basis<S>>(lattice: &Lattice<D, S, B>, first: usize, nodes: &[f64]) -> Self {
        let (lines, rows) = Stencil::<D, S>::OUTER;
        let mut patch = Self::zero();
        for i in 0..lines {
            for j in 0..rows {
                let begin = first + lattice.row_offset(i, j);
                patch.0[i][j] = fetch(&nodes[begin..begin + ROW]);
            }
        }
        patch
    }

    /// Σ_i w_ip q_i for a particle's `weights`.
    #[inline(always)]
    pub(super) fn sum<const D: usize>(&self, weights: &Weights<D, S>) -> f64 {
        let (lines, rows) = Stencil::<D, S>::OUTER;
        let (slow, fast, last) = factors(weights);
        let mut sum = f64x4::ZERO;
        for i in 0..lines {
            let mut line = f64x4::ZERO;
            for j in 0..rows {
                line = self.0[i][j].mul_add(f64x4::splat(fast[j]), line);
            }
            sum = line.mul_add(f64x4::splat(slow[i]), sum);
        }
        // The order in which AVX adds them up, on every processor.
        let [a, b, c, d] = (sum * last).to_array();
        (a + c) + (b + d)
    }
}
