//! Face of a rigid body with a prescribed motion.

use super::surface::{Gap, Seen, Surface};
use crate::error::{Error, require};
use crate::frame::Frame;
use crate::particles::Particles;
use crate::stage::{Amplitude, End};
use nalgebra::{SMatrix, SVector};
use std::sync::Arc;

/// The face of a rigid body, which may move: a plane, which may be limited across its normal (a footing), or a surface
/// of any shape.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidFace<const D: usize> {
    shape: Shape<D>,
    velocity: [f64; D],
    amplitude: Amplitude,
}

/// Where a face is at time zero.
#[derive(Debug, Clone)]
enum Shape<const D: usize> {
    Plane(Plane<D>),
    Any(Arc<dyn Surface<D>>),
}

impl<const D: usize> PartialEq for Shape<D> {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Plane(own), Self::Plane(other)) => own == other,
            (Self::Any(own), Self::Any(other)) => Arc::ptr_eq(own, other),
            _ => false,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Plane<const D: usize> {
    axis: usize,
    /// Sign of the outward normal along `axis`.
    sign: f64,
    position: f64,
    extent: [[f64; 2]; D],
}

impl<const D: usize> RigidFace<D> {
    /// A rigid body at rest beyond `position` (m) of an axis, towards its `end`: at `Lo` the floor of what lies
    /// above, at `Hi` what presses from above.
    ///
    /// # Errors
    /// An axis that there is not, a position that is not finite.
    pub fn half_space(axis: usize, end: End, position: f64) -> Result<Self, Error> {
        require(axis < D, "axis of a rigid face", axis as f64, "less than the dimension")?;
        require(true, "position of a rigid face", position, "finite (m)")?;
        let sign = match end {
            End::Lo => 1.0,
            End::Hi => -1.0,
        };
        let extent = [[f64::NEG_INFINITY, f64::INFINITY]; D];
        Ok(Self::at_rest(Shape::Plane(Plane { axis, sign, position, extent })))
    }

    /// A rigid body at rest with this surface.
    #[must_use]
    pub fn surface(surface: Arc<dyn Surface<D>>) -> Self {
        Self::at_rest(Shape::Any(surface))
    }

    fn at_rest(shape: Shape<D>) -> Self {
        Self { shape, velocity: [0.0; D], amplitude: Amplitude::Rise(0.0) }
    }

    /// Limits a plane face to `extent`, lower and upper end along every axis (m) at time zero; that along the normal
    /// has no meaning. Particles beside the face do not feel it. A surface ends where its own rim is.
    #[must_use]
    pub fn within(mut self, extent: [[f64; 2]; D]) -> Self {
        if let Shape::Plane(plane) = &mut self.shape {
            plane.extent = extent;
        }
        self
    }

    /// Moves the face with `velocity` (m/s) times the `amplitude`.
    ///
    /// # Errors
    /// A velocity that is not finite.
    pub fn moving(self, velocity: [f64; D], amplitude: Amplitude) -> Result<Self, Error> {
        for v in velocity {
            require(true, "velocity of a rigid face", v, "finite (m/s)")?;
        }
        Ok(Self { velocity, amplitude, ..self })
    }

    /// Puts a plane face, at time zero, at the gap `gap` (m) from the nearest of the particles before it: at the
    /// distance d̂ of a barrier it just touches. With no particle before it, it stays, and so does a surface.
    #[must_use]
    pub fn touching(mut self, particles: &Particles<D>, gap: f64) -> Self {
        let gaps = particles.position.iter().filter_map(|x| self.gap(x));
        let nearest = gaps.fold(f64::INFINITY, f64::min);
        if let Shape::Plane(plane) = &mut self.shape
            && nearest.is_finite()
        {
            plane.position += plane.sign * (nearest - gap);
        }
        self
    }

    /// The same face seen from `frame`.
    #[must_use]
    pub fn seen_from(&self, frame: &Frame<D>) -> Self {
        let shape = match &self.shape {
            Shape::Plane(plane) => {
                let (axis, sign) = frame.axis(plane.axis);
                let mut on_face = [0.0; D];
                on_face[plane.axis] = plane.position;
                let position = frame.place(&on_face)[axis];
                Shape::Plane(Plane { axis, sign: sign * plane.sign, position, extent: frame.extent(&plane.extent) })
            }
            Shape::Any(surface) => Shape::Any(Arc::new(Seen { surface: surface.clone(), frame: *frame })),
        };
        let velocity = frame.vector(&self.velocity, frame.scale(0, 1));
        Self { shape, velocity, amplitude: self.amplitude.clone() }
    }

    /// Whether its normal is one and the same everywhere.
    pub fn is_plane(&self) -> bool {
        matches!(self.shape, Shape::Plane(_))
    }

    /// An axis along which its normal has a part, of those that `which` names.
    pub(crate) fn crosses(&self, which: impl Fn(usize) -> bool) -> Option<usize> {
        (0..D).filter(|axis| which(*axis)).find(|axis| match &self.shape {
            Shape::Plane(plane) => plane.axis == *axis,
            Shape::Any(surface) => surface.crosses(*axis),
        })
    }

    /// Displacement (m) since time zero: the exact integral of [`Self::velocity`].
    pub fn displacement(&self, time: f64) -> [f64; D] {
        let stroke = self.amplitude.integral(time);
        self.velocity.map(|v| v * stroke)
    }

    /// Velocity (m/s) at `time` (s), not negative.
    pub fn velocity(&self, time: f64) -> [f64; D] {
        let rise = self.amplitude.at(time);
        self.velocity.map(|v| v * rise)
    }

    /// Gap (m) between the face at time zero and what lies at `x` (m), less the face's displacement: negative
    /// inside the body, `None` beside the face.
    pub fn gap(&self, x: &[f64; D]) -> Option<f64> {
        self.seen_at(x, f64::INFINITY).map(|gap| gap.size)
    }

    /// The face at time zero as what lies at `x` (m), less the face's displacement, sees it: `None` beside the face, and
    /// farther than `within` (m) from a surface that is no plane.
    pub fn seen_at(&self, x: &[f64; D], within: f64) -> Option<Gap<D>> {
        match &self.shape {
            Shape::Plane(plane) => plane.gap(x),
            Shape::Any(surface) => surface.gap(x, within),
        }
    }

    /// Whether what lies at `x` (m), less the face's displacement, is within `distance` (m) of the face along every axis,
    /// a little farther from a surface, or anywhere inside a body with a plane face.
    pub fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
        match &self.shape {
            Shape::Plane(plane) => plane.is_near(x, distance),
            Shape::Any(surface) => surface.is_near(x, distance * (D as f64).sqrt()),
        }
    }
}

impl<const D: usize> Plane<D> {
    fn gap(&self, x: &[f64; D]) -> Option<Gap<D>> {
        let mut ends = x.iter().zip(&self.extent).enumerate();
        let before = ends.all(|(a, (x, [lo, hi]))| a == self.axis || (x >= lo && x <= hi));
        before.then(|| Gap {
            size: self.sign * (x[self.axis] - self.position),
            normal: SVector::from_fn(|a, _| if a == self.axis { self.sign } else { 0.0 }),
            bend: SMatrix::zeros(),
        })
    }

    fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
        let mut ends = x.iter().zip(&self.extent).enumerate();
        ends.all(|(a, (x, [lo, hi]))| {
            if a == self.axis {
                self.sign * (x - self.position) <= distance
            } else {
                *x >= lo - distance && *x <= hi + distance
            }
        })
    }
}
