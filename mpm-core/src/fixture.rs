//! Fixtures for the tests of several solvers.

use crate::grid::{Axis, Grid};
use crate::implicit::unknowns::Pattern;
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::stage::Constraint;
use nalgebra::SMatrix;

/// Moves the nodes at the faces of the grid, and beyond, as the field u = G x with this G does.
pub(crate) struct Affine<const D: usize>(pub(crate) SMatrix<f64, D, D>);

impl<const D: usize> Memoryless for Affine<D> {}

impl<const D: usize> Constraint<D> for Affine<D> {
    fn prescribe(&self, grid: &Grid<D>, position: &[f64; D], axis: usize) -> Option<f64> {
        let on_face = |(x, a): (&f64, &Axis)| *x < a.lo + 1e-9 || *x > a.hi(grid.h) - 1e-9;
        let at_edge = position.iter().zip(&grid.axes).any(on_face);
        at_edge.then(|| (0..D).map(|b| self.0[(axis, b)] * position[b]).sum())
    }

    fn seen_from(self: Box<Self>, _: &crate::Frame<D>) -> Box<dyn Constraint<D>> {
        self
    }
}

/// A number in (−1, 1), the same every time.
pub(crate) fn noise(k: usize) -> f64 {
    let x = (k as f64 * 12.9898).sin() * 43_758.547;
    2.0 * (x - x.floor()) - 1.0
}

/// The product of a sparse matrix and `x`.
pub(crate) fn multiply(pattern: &Pattern, values: &[f64], x: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; x.len()];
    for (column, x) in x.iter().enumerate() {
        for k in pattern.begin[column]..pattern.begin[column + 1] {
            out[pattern.row[k]] += values[k] * x;
        }
    }
    out
}

/// The derivative of `of` at zero: central differences extrapolated from three steps. Returns it, and by how much the
/// last extrapolation changes it.
pub(crate) fn slope(of: impl Fn(f64) -> Vec<f64>) -> (Vec<f64>, Vec<f64>) {
    let quotient = |s: f64| -> Vec<f64> {
        let ends = of(s).into_iter().zip(of(-s));
        ends.map(|(a, b)| (a - b) / (2.0 * s)).collect()
    };
    let [coarse, middle, fine] = [4e-3, 2e-3, 1e-3].map(quotient);
    let each = coarse.iter().zip(&middle).zip(&fine);
    each.map(|((coarse, middle), fine)| {
        let [first, second] = [(4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0];
        let exact = (16.0 * second - first) / 15.0;
        (exact, exact - second)
    })
    .unzip()
}

/// Norm of the difference of two vectors.
pub(crate) fn apart(a: &[f64], b: &[f64]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Particles of 1000 kg/m³ that fill a box: `count` along every axis, the first of which varies fastest, `spacing` (m)
/// apart from `origin` (m) on.
pub(crate) fn filling<const D: usize>(count: [usize; D], spacing: f64, origin: f64) -> Particles<D> {
    let place = |mut k: usize| {
        count.map(|along| {
            let i = k % along;
            k /= along;
            origin + spacing * (i as f64 + 0.5)
        })
    };
    let places = (0..count.iter().product()).map(place).collect();
    Particles::new(places, spacing.powi(D as i32), 1000.0, [0.5 * spacing; D]).unwrap()
}
