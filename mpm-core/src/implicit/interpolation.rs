//! Interface of the functions on a grid for the implicit solver.

use super::domains::Domains;
use super::functions::Functions;
use super::ghost;
use super::penalty::Penalty;
use super::pieces::Pieces;
use super::settings::Stabilisation;
use crate::basis::{Gimp, Linear, WallTreatment};
use crate::error::Error;
use crate::grid::Grid;
use crate::lattice::Lattice;

/// Functions on a grid.
pub trait Interpolation<const D: usize>: Send + Sync + 'static {
    /// The functions on `grid`.
    ///
    /// # Errors
    /// A grid that these functions do not live on.
    fn on(grid: Grid<D>) -> Result<Self, Error>
    where
        Self: Sized;

    /// The grid.
    fn grid(&self) -> &Grid<D>;

    /// Cells of an element along each axis.
    fn span(&self) -> [usize; D] {
        [1; D]
    }

    /// Length of a nodal array.
    fn len(&self) -> usize;

    /// Never: a grid has nodes.
    fn is_empty(&self) -> bool {
        false
    }

    /// How many functions see a place.
    fn support(&self) -> usize;

    /// Calls `visit` with every node and its position (m).
    fn for_each_node(&self, visit: &mut dyn FnMut(usize, [f64; D]));

    /// Original of every node that is a periodic image; other nodes are their own.
    fn originals(&self) -> Vec<usize>;

    /// Puts the functions that see a particle at `x` (m) with half sizes `half_size` (m) in `functions`.
    fn functions(&self, x: &[f64; D], half_size: &[f64; D], functions: &mut Functions<D>);

    /// How far (m) a particle of half size `half_size` (m) may pass a wall.
    fn beyond_wall(&self, half_size: f64) -> f64;

    /// Whether these functions offer a stabilisation.
    fn offers(&self, stabilisation: Stabilisation) -> Result<(), Error>;

    /// Gauss points along an axis that integrate the stiffness of an element.
    fn points(&self) -> usize;

    /// Ghost penalty of a field of this many `components` where `domains` are, with γ E the `strength` (Pa, or the
    /// equivalent of a field of another kind) and the `share` of it at every particle, or all, of functions that offer it.
    fn ghost(&self, strength: f64, share: &[f64], components: usize, domains: Domains<D>) -> Vec<Penalty>;
}

/// Hats, or their means over the domains of particles.
pub trait OfHats<const D: usize>: Interpolation<D> {
    /// Whether they are means.
    fn means(&self) -> bool;

    /// The hats of the same nodes at a point `x` (m).
    fn hats(&self, x: &[f64; D], functions: &mut Functions<D>);
}

macro_rules! of_hats {
    ($nodes:literal, $basis:ty, means: $means:literal) => {
        impl<const D: usize> OfHats<D> for Lattice<D, $nodes, $basis> {
            fn means(&self) -> bool {
                $means
            }

            fn hats(&self, x: &[f64; D], functions: &mut Functions<D>) {
                functions.set(&self.stencil_of_point(x));
            }
        }
    };
}

of_hats!(2, Linear, means: false);
of_hats!(3, Gimp, means: true);

impl<const D: usize, const S: usize, B: Pieces<S>> Interpolation<D> for Lattice<D, S, B> {
    fn on(grid: Grid<D>) -> Result<Self, Error> {
        Ok(Self::new(grid, WallTreatment::OpenKnot))
    }

    fn grid(&self) -> &Grid<D> {
        &self.grid
    }

    fn len(&self) -> usize {
        Self::len(self)
    }

    fn support(&self) -> usize {
        S.pow(D as u32)
    }

    fn for_each_node(&self, visit: &mut dyn FnMut(usize, [f64; D])) {
        Self::for_each_node(self, |node, index| visit(node, self.position(index)));
    }

    fn originals(&self) -> Vec<usize> {
        let mut original: Vec<usize> = (0..Self::len(self)).collect();
        self.unfold(&mut original);
        original
    }

    fn functions(&self, x: &[f64; D], half_size: &[f64; D], functions: &mut Functions<D>) {
        functions.set(&self.stencil(x, half_size));
    }

    fn beyond_wall(&self, half_size: f64) -> f64 {
        B::beyond_wall(half_size)
    }

    fn offers(&self, stabilisation: Stabilisation) -> Result<(), Error> {
        match stabilisation {
            Stabilisation::Soft(factor) if !B::POINTWISE => Err(Error::Input {
                what: "soft stiffness for functions that depend on a particle's size, factor",
                value: factor,
                allowed: "none or ghost; soft with linear functions and B-splines",
            }),
            _ => Ok(()),
        }
    }

    fn points(&self) -> usize {
        S
    }

    fn ghost(&self, strength: f64, share: &[f64], components: usize, domains: Domains<D>) -> Vec<Penalty> {
        ghost::penalties(self, strength, share, components, domains)
    }
}
