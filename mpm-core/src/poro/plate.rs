//! Rigid plates on a body.

use super::face::{Force, OfPlace};
use crate::error::{Error, require};
use crate::frame::Frame;
use crate::grid::Grid;
use crate::implicit::OfHats;
use crate::implicit::held::Held;

/// A rigid plate without friction, which moves along an axis: of all nodes that it takes, that component of the
/// displacement is one unknown, on which a force acts that is given as a whole.
pub struct Plate<const D: usize> {
    pub(super) axis: usize,
    takes: OfPlace<D, bool>,
    pub(super) force: Force<f64>,
}

impl<const D: usize> Plate<D> {
    /// A plate on the nodes that `takes` says by their places (m), which moves along `axis` under a `force` (N; N/m in
    /// plane strain, Pa in 1D) that depends on the time (s). Nodes behind the plate belong to it too, where the body
    /// may come to reach beyond it.
    pub fn new(
        axis: usize,
        takes: impl Fn(&[f64; D]) -> bool + Send + Sync + 'static,
        force: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self { axis, takes: Box::new(takes), force: Box::new(force) }
    }

    /// The same plate on the nodes of `grid`, seen from `frame`.
    pub(super) fn seen_from(self, frame: &Frame<D>, grid: &Grid<D>) -> Self {
        let (axis, sign) = frame.axis(self.axis);
        let (frame, grid, takes, force) = (*frame, *grid, self.takes, self.force);
        Self::new(
            axis,
            move |place| takes(&frame.node_of_scene(&grid, place)),
            move |time| frame.force() * sign * force(time),
        )
    }
}

/// Plate of every component of every node of `functions`.
///
/// # Errors
/// A plate that moves along no axis, takes no node, or one that a constraint or another plate has too.
pub(super) fn ties<const D: usize>(
    plates: &[Plate<D>],
    functions: &dyn OfHats<D>,
    held: &[[Option<Held>; D]],
) -> Result<Vec<[Option<usize>; D]>, Error> {
    let mut ties = vec![[None; D]; functions.len()];
    for (k, plate) in plates.iter().enumerate() {
        let axis = plate.axis;
        require(axis < D, "axis of a plate", axis as f64, "one of the grid's")?;
        let (mut taken, mut shared) = (0_u32, 0_u32);
        functions.for_each_node(&mut |node, place| {
            if (plate.takes)(&place) {
                let other = held[node][axis].is_some() || ties[node][axis].is_some();
                shared += u32::from(other);
                taken += 1;
                ties[node][axis] = Some(k);
            }
        });
        let what = "nodes of a plate";
        require(taken > 0, what, taken.into(), "at least 1")?;
        let what = "nodes of a plate that a constraint or another plate has";
        require(shared == 0, what, shared.into(), "none: a plate moves as one")?;
    }
    Ok(ties)
}
