//! Surfaces of rigid bodies, as places see them.

use crate::frame::Frame;
use nalgebra::{SMatrix, SVector};
use std::fmt::Debug;
use std::sync::Arc;

/// The surface of a rigid body as a place sees it, from the point that is nearest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap<const D: usize> {
    /// Distance (m), negative inside the body.
    pub size: f64,
    /// Outward unit normal.
    pub normal: SVector<f64, D>,
    /// Slope of the normal over the place (1/m): zero before a facet.
    pub bend: SMatrix<f64, D, D>,
}

/// The surface of a rigid body of any shape, at time zero.
pub trait Surface<const D: usize>: Debug + Send + Sync {
    /// The surface as what lies at `x` (m) sees it: none beyond `within` (m), and beside it, where a part of its rim is nearest.
    fn gap(&self, x: &[f64; D], within: f64) -> Option<Gap<D>>;

    /// Whether a part of it is within `distance` (m) of `x` (m).
    fn is_near(&self, x: &[f64; D], distance: f64) -> bool;

    /// Whether its normal has a part along `axis`.
    fn crosses(&self, axis: usize) -> bool;
}

/// A surface seen from a frame.
#[derive(Debug)]
pub(super) struct Seen<const D: usize> {
    pub(super) surface: Arc<dyn Surface<D>>,
    pub(super) frame: Frame<D>,
}

impl<const D: usize> Surface<D> for Seen<D> {
    fn gap(&self, x: &[f64; D], within: f64) -> Option<Gap<D>> {
        let (frame, length) = (&self.frame, self.frame.scale(0, 1));
        let own = self.surface.gap(&frame.place_of_scene(x), within / length)?;
        let normal = frame.vector(&own.normal.into(), 1.0).into();
        Some(Gap { size: own.size * length, normal, bend: frame.matrix(&own.bend, length.recip()) })
    }

    fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
        self.surface.is_near(&self.frame.place_of_scene(x), distance / self.frame.scale(0, 1))
    }

    fn crosses(&self, axis: usize) -> bool {
        (0..D).any(|own| self.frame.axis(own).0 == axis && self.surface.crosses(own))
    }
}
