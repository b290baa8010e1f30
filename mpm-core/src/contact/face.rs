//! Face of a rigid body with a prescribed motion.

use crate::error::{Error, require};
use crate::frame::Frame;
use crate::particles::Particles;
use crate::stage::{Amplitude, End};

/// The plane face of a rigid body, which may be limited across its normal (a footing) and may move.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidFace<const D: usize> {
    axis: usize,
    /// Sign of the outward normal along `axis`.
    sign: f64,
    position: f64,
    extent: [[f64; 2]; D],
    velocity: [f64; D],
    amplitude: Amplitude,
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
        Ok(Self {
            axis,
            sign,
            position,
            extent: [[f64::NEG_INFINITY, f64::INFINITY]; D],
            velocity: [0.0; D],
            amplitude: Amplitude::Rise(0.0),
        })
    }

    /// Limits the face to `extent`, lower and upper end along every axis (m) at time zero; that along the normal
    /// has no meaning. Particles beside the face do not feel it.
    #[must_use]
    pub fn within(self, extent: [[f64; 2]; D]) -> Self {
        Self { extent, ..self }
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

    /// Puts the face, at time zero, at the gap `gap` (m) from the nearest of the particles before it: at the
    /// distance d̂ of a barrier it just touches. With no particle before it, it stays.
    #[must_use]
    pub fn touching(self, particles: &Particles<D>, gap: f64) -> Self {
        let gaps = particles.position.iter().filter_map(|x| self.gap(x));
        let nearest = gaps.fold(f64::INFINITY, f64::min);
        if !nearest.is_finite() {
            return self;
        }
        Self { position: self.position + self.sign * (nearest - gap), ..self }
    }

    /// The same face seen from `frame`.
    #[must_use]
    pub fn seen_from(&self, frame: &Frame<D>) -> Self {
        let (axis, sign) = frame.axis(self.axis);
        let mut on_face = [0.0; D];
        on_face[self.axis] = self.position;
        Self {
            axis,
            sign: sign * self.sign,
            position: frame.place(&on_face)[axis],
            extent: frame.extent(&self.extent),
            velocity: frame.vector(&self.velocity, frame.scale(0, 1)),
            amplitude: self.amplitude.clone(),
        }
    }

    /// Axis of the normal.
    pub fn axis(&self) -> usize {
        self.axis
    }

    /// Component of the outward unit normal along [`Self::axis`].
    pub fn sign(&self) -> f64 {
        self.sign
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
        let mut ends = x.iter().zip(&self.extent).enumerate();
        let before = ends.all(|(a, (x, [lo, hi]))| a == self.axis || (x >= lo && x <= hi));
        before.then(|| self.sign * (x[self.axis] - self.position))
    }

    /// Whether what lies at `x` (m), less the face's displacement, is in the body or within `distance` (m) of the face
    /// along every axis.
    pub fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
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
