//! Serendipity elements with eight nodes, the paper's: to reproduce its cantilever, which they do not converge to.
//!
//! An element spans two cells by three, as the paper's of 0.1 m by 0.15 m does on cells of 0.05 m. Corners and mid-sides
//! stand on a lattice of half the elements' size, whose points in the middle of elements are no nodes.

use super::domains::Domains;
use super::functions::Functions;
use super::interpolation::Interpolation;
use super::penalty::Penalty;
use super::settings::Stabilisation;
use crate::error::{Error, require, require_none};
use crate::grid::Grid;

/// Nodes of an element.
const NODES: usize = 8;

/// Serendipity elements on blocks of a grid's cells.
#[derive(Debug, Clone)]
pub struct Serendipity {
    grid: Grid<2>,
    /// Size of an element (m).
    size: [f64; 2],
}

impl Serendipity {
    /// Cells of an element along each axis.
    pub const SPAN: [usize; 2] = [2, 3];

    /// Elements along an axis.
    fn elements(&self, axis: usize) -> usize {
        self.grid.axes[axis].cells / Self::SPAN[axis]
    }

    /// Points of the lattice along an axis.
    fn points(&self, axis: usize) -> usize {
        2 * self.elements(axis) + 1
    }
}

/// The eight nodes as coordinates −1, 0 and 1 in their cell, in the order of their places.
const CORNERS: [[i32; 2]; NODES] = [[-1, -1], [-1, 0], [-1, 1], [0, -1], [0, 1], [1, -1], [1, 0], [1, 1]];

/// Value and gradient of a node's function at local coordinates in −1..1.
fn function([x, y]: [f64; 2], [i, j]: [i32; 2]) -> (f64, [f64; 2]) {
    let (a, b) = (f64::from(i), f64::from(j));
    match (i, j) {
        (0, _) => {
            let (bubble, linear) = (1.0 - x * x, 1.0 + b * y);
            (0.5 * bubble * linear, [-x * linear, 0.5 * b * bubble])
        }
        (_, 0) => {
            let (bubble, linear) = (1.0 - y * y, 1.0 + a * x);
            (0.5 * bubble * linear, [0.5 * a * bubble, -y * linear])
        }
        _ => {
            let (p, q, r) = (1.0 + a * x, 1.0 + b * y, a * x + b * y - 1.0);
            let dx = 0.25 * a * q * (r + p);
            let dy = 0.25 * b * p * (r + q);
            (0.25 * p * q * r, [dx, dy])
        }
    }
}

impl Interpolation<2> for Serendipity {
    fn on(grid: Grid<2>) -> Result<Self, Error> {
        let periodic = grid.axes.iter().filter(|a| a.is_periodic()).count();
        require_none(periodic, "periodic axes of serendipity elements", "none")?;
        for (axis, span) in grid.axes.iter().zip(Self::SPAN) {
            let allowed = "a multiple of 2 along x, of 3 along y";
            require(axis.cells.is_multiple_of(span), "cells below serendipity elements", axis.cells as f64, allowed)?;
        }
        Ok(Self { grid, size: Self::SPAN.map(|cells| cells as f64 * grid.h) })
    }

    fn grid(&self) -> &Grid<2> {
        &self.grid
    }

    fn span(&self) -> [usize; 2] {
        Self::SPAN
    }

    fn len(&self) -> usize {
        self.points(0) * self.points(1)
    }

    fn support(&self) -> usize {
        NODES
    }

    fn for_each_node(&self, visit: &mut dyn FnMut(usize, [f64; 2])) {
        let place = |axis: usize, k: usize| self.grid.axes[axis].lo + 0.5 * self.size[axis] * k as f64;
        for i in 0..self.points(0) {
            for j in 0..self.points(1) {
                if i % 2 == 0 || j % 2 == 0 {
                    visit(i * self.points(1) + j, [place(0, i), place(1, j)]);
                }
            }
        }
    }

    fn originals(&self) -> Vec<usize> {
        (0..self.len()).collect()
    }

    fn functions(&self, x: &[f64; 2], _half_size: &[f64; 2], functions: &mut Functions<2>) {
        let element = [0, 1].map(|a| self.grid.cell(a, x[a]) / Self::SPAN[a]);
        let local = [0, 1].map(|a| {
            let lo = self.grid.axes[a].lo + self.size[a] * element[a] as f64;
            2.0 * (x[a] - lo) / self.size[a] - 1.0
        });
        functions.element = element[0] * self.elements(1) + element[1];
        functions.node.clear();
        functions.w.clear();
        functions.dw.clear();
        for corner in CORNERS {
            let [i, j] = [0, 1].map(|a| 2 * element[a] + (corner[a] + 1) as usize);
            let (w, dw) = function(local, corner);
            functions.node.push(i * self.points(1) + j);
            functions.w.push(w);
            functions.dw.push([0, 1].map(|a| 2.0 * dw[a] / self.size[a]));
        }
    }

    fn beyond_wall(&self, _half_size: f64) -> f64 {
        0.0
    }

    fn offers(&self, stabilisation: Stabilisation) -> Result<(), Error> {
        match stabilisation {
            Stabilisation::Ghost(factor) => Err(Error::Input {
                what: "ghost penalty of serendipity elements, factor",
                value: factor,
                allowed: "none or soft: their derivatives jump across all faces",
            }),
            _ => Ok(()),
        }
    }

    fn points(&self) -> usize {
        3
    }

    /// Not [offered](Self::offers).
    fn ghost(&self, _strength: f64, _share: &[f64], _components: usize, _domains: Domains<2>) -> Vec<Penalty> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Axis;

    /// They sum to one and reproduce quadratic fields but x²y², with their gradients.
    #[test]
    fn they_reproduce_quadratic_fields() {
        let grid = Grid::new(0.25, [Axis::open(-1.0, 10), Axis::open(0.5, 9)]).unwrap();
        let elements = Serendipity::on(grid).unwrap();
        let mut place = vec![[f64::NAN; 2]; elements.len()];
        elements.for_each_node(&mut |node, x| place[node] = x);
        let mut seen = Functions::new();
        let field = |[x, y]: [f64; 2]| 1.0 + x - 2.0 * y + x * x + 3.0 * x * y - y * y;
        for k in 0..40 {
            let x = [-0.99 + 0.06 * f64::from(k), 0.51 + 0.045 * f64::from(k)];
            elements.functions(&x, &[0.0; 2], &mut seen);
            let nodes = || seen.node.iter().map(|n| field(place[*n]));
            let value: f64 = nodes().zip(&seen.w).map(|(f, w)| f * w).sum();
            let slope = [0, 1].map(|a| -> f64 { nodes().zip(&seen.dw).map(|(f, d)| f * d[a]).sum() });
            assert!((value - field(x)).abs() < 1e-13);
            let exact = [1.0 + 2.0 * x[0] + 3.0 * x[1], -2.0 + 3.0 * x[0] - 2.0 * x[1]];
            assert!((slope[0] - exact[0]).abs() + (slope[1] - exact[1]).abs() < 1e-12);
        }
    }

    #[test]
    fn every_block_is_an_element_of_its_own() {
        let grid = Grid::new(0.25, [Axis::open(0.0, 10), Axis::open(0.0, 12)]).unwrap();
        let elements = Serendipity::on(grid).unwrap();
        let mut seen = Functions::new();
        let mut numbers = Vec::new();
        for k in 0..20 {
            let x = [0.5 * f64::from(k / 4) + 0.1, 0.75 * f64::from(k % 4) + 0.1];
            elements.functions(&x, &[0.0; 2], &mut seen);
            numbers.push(seen.element);
        }
        assert_eq!(numbers, (0..20).collect::<Vec<_>>());
    }
}
