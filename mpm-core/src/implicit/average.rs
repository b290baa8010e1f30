//! The average A of F̄ on the functions of a step: the volume average Π, or I − (1 − ε)(I − Π)².
//!
//! V A is symmetric, and so Aᵀ = V A V⁻¹ of the volumes V at the step's start.

use super::cells::{Cell, cells};
use super::domains::Domains;
use super::elements::Elements;
use super::interpolation::Interpolation;
use crate::basis::BSpline;
use crate::grid::Grid;
use crate::lattice::Lattice;
use crate::parallel::{LIGHT, map};
use crate::particles::Particles;
use crate::projection::Onto;

/// The share ε of a field that Π cannot see which A keeps, as the explicit remedy does.
const UNSEEN: f64 = 0.01;

/// A, frozen in a step.
pub(super) struct Average<const D: usize> {
    /// The functions that average, where these are not those of the basis.
    other: Option<Elements<D>>,
    /// Volume of every particle (m³).
    volume: Vec<f64>,
    /// One over the volume of every node, zero of nodes that see none.
    inverse: Vec<f64>,
    /// Whether A is I − (1 − ε)(I − Π)².
    sharp: bool,
    /// The cells, of an average onto their constants.
    pub(super) cells: Vec<Cell>,
}

/// The functions that average at `particles` on `grid`, and how many there are; none for those of the basis.
fn other<const D: usize>(onto: Onto, grid: Grid<D>, particles: &Particles<D>) -> Option<(Elements<D>, usize)> {
    fn at<I: Interpolation<D>, const D: usize>(functions: I, particles: &Particles<D>) -> (Elements<D>, usize) {
        (Elements::new(&functions, &functions.originals(), Domains::of(particles)), functions.len())
    }
    match onto {
        Onto::Basis => None,
        Onto::Hats => Some(at(Lattice::<D, 2, BSpline<2>>::new(grid, Default::default()), particles)),
        // The start refuses the last two.
        Onto::Cells | Onto::Blocks | Onto::Patches => {
            Some(at(Lattice::<D, 1, BSpline<1>>::new(grid, Default::default()), particles))
        }
    }
}

impl<const D: usize> Average<D> {
    /// A with the functions of the basis, of which there are as many as `nodes`, for particles of a `volume` (m³).
    pub(super) fn new(elements: &Elements<D>, nodes: usize, volume: &[f64], sharp: bool) -> Self {
        let of_nodes = elements.sums(nodes, volume);
        let inverse = |v: &f64| if *v > 0.0 { 1.0 / v } else { 0.0 };
        let inverse = of_nodes.iter().map(inverse).collect();
        Self { other: None, volume: volume.to_vec(), inverse, sharp, cells: Vec::new() }
    }

    /// A onto functions of `interpolation`, of its grid, or of its cells; `elements` has the former at the particles.
    pub(super) fn onto(
        onto: Onto,
        interpolation: &dyn Interpolation<D>,
        elements: &Elements<D>,
        particles: &Particles<D>,
        sharp: bool,
    ) -> Self {
        let volume = &particles.volume;
        match other(onto, *interpolation.grid(), particles) {
            None => Self::new(elements, interpolation.len(), volume, sharp),
            Some((other, functions)) => {
                let cells = if onto == Onto::Cells { cells(elements, &other, volume) } else { Vec::new() };
                let average = Self::new(&other, functions, volume, sharp);
                Self { other: Some(other), cells, ..average }
            }
        }
    }

    /// Whether it couples particles of several cells, so that a stiffness with it is not assembled.
    pub(super) fn spreads(&self) -> bool {
        self.cells.is_empty()
    }

    /// The share of a field that Π cannot see which A keeps.
    pub(super) fn unseen(&self) -> f64 {
        if self.sharp { UNSEEN } else { 0.0 }
    }

    /// Π `field`.
    pub(super) fn project(&self, elements: &Elements<D>, field: &[f64]) -> Vec<f64> {
        let elements = self.other.as_ref().unwrap_or(elements);
        let mut of_nodes = vec![0.0; self.inverse.len()];
        elements.scatter_values(0.0, &mut of_nodes, |p| self.volume[p] * field[p]);
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
    pub(super) fn apply(&self, elements: &Elements<D>, field: &[f64]) -> Vec<f64> {
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
    pub(super) fn transposed(&self, elements: &Elements<D>, field: &[f64]) -> Vec<f64> {
        let per_volume: Vec<f64> = field.iter().zip(&self.volume).map(|(f, v)| f / v).collect();
        let averaged = self.apply(elements, &per_volume);
        let pairs = averaged.iter().zip(&self.volume);
        pairs.map(|(a, v)| a * v).collect()
    }
}
