//! The barrier between a particle and a rigid body.

use crate::error::{Error, positive, require};

/// The barrier energy B(d) = −κ (d − d̂)² ln(d/d̂) of a particle at the gap d < d̂ from a body, zero beyond d̂
/// (Li et al. 2020, doi 10.1145/3386569.3392425): twice continuously differentiable, and without bound as the gap
/// closes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barrier {
    stiffness: f64,
    distance: f64,
}

/// Steps of Newton's method that no force needs: they double the digits once the gap is near.
const NEWTON_STEPS: usize = 64;

impl Barrier {
    /// The barrier of stiffness κ = `stiffness` (N/m; per metre of depth in plane strain) that begins at the gap
    /// d̂ = `distance` (m).
    ///
    /// # Errors
    /// A stiffness or distance that is not positive and finite.
    pub fn new(stiffness: f64, distance: f64) -> Result<Self, Error> {
        positive(stiffness, "barrier stiffness", "positive (N/m)")?;
        positive(distance, "barrier distance", "positive (m)")?;
        Ok(Self { stiffness, distance })
    }

    /// The barrier that carries `force` (N) at half of its `distance` d̂ (m).
    ///
    /// # Errors
    /// A force or distance that is not positive and finite.
    pub fn carrying(force: f64, distance: f64) -> Result<Self, Error> {
        Self::carrying_at(force, 0.5 * distance, distance)
    }

    /// The barrier that carries `force` (N) at the gap `gap` (m) of its `distance` d̂ (m): it gives way by
    /// `distance − gap` under that force.
    ///
    /// # Errors
    /// A force or distance that is not positive and finite, a gap outside (0, d̂).
    pub fn carrying_at(force: f64, gap: f64, distance: f64) -> Result<Self, Error> {
        positive(force, "force on a barrier", "positive (N)")?;
        require(
            gap > 0.0 && gap < distance,
            "gap of a barrier",
            gap,
            "positive and less than the barrier's distance (m)",
        )?;
        Self::new(force / Self::new(1.0, distance)?.force(gap), distance)
    }

    /// The same barrier in units of which a metre is `length`, its unit of stiffness `stiffness`.
    pub(super) fn in_units(self, length: f64, stiffness: f64) -> Self {
        Self { stiffness: stiffness * self.stiffness, distance: length * self.distance }
    }

    /// Gap d̂ (m) at which the barrier begins.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Energy B (J) at the gap `gap` (m); infinite at a closed one.
    pub fn energy(&self, gap: f64) -> f64 {
        self.within(gap, |x| {
            let d = self.distance * (1.0 - x);
            -self.stiffness * d * d * x.ln()
        })
    }

    /// Force −B′ (N) that pushes the particle away, at the gap `gap` (m); infinite at a closed one.
    pub fn force(&self, gap: f64) -> f64 {
        self.within(gap, |x| self.stiffness * self.distance * scaled_force(x))
    }

    /// Stiffness B″ (N/m) at the gap `gap` (m); infinite at a closed one.
    pub fn stiffness(&self, gap: f64) -> f64 {
        self.within(gap, |x| self.stiffness * scaled_stiffness(x))
    }

    /// The gap (m) at which the barrier carries `force` (N), the inverse of [`Self::force`]; d̂ for none.
    pub fn gap(&self, force: f64) -> f64 {
        let sought = force / (self.stiffness * self.distance);
        if sought <= 0.0 {
            return self.distance;
        }
        // The force falls and is convex, so from a smaller gap Newton's steps only grow towards the root. Both
        // starts are smaller: φ ≥ 3 (1 − x)² and φ ≥ 1/x − 2.
        let mut x = (1.0 - (sought / 3.0).sqrt()).max(1.0 / (sought + 2.0));
        for _ in 0..NEWTON_STEPS {
            let step = (scaled_force(x) - sought) / scaled_stiffness(x);
            if step <= f64::EPSILON * x {
                break;
            }
            x += step;
        }
        self.distance * x
    }

    /// `value` of x = d/d̂ in (0, 1); infinity at a closed gap and zero beyond d̂.
    fn within(&self, gap: f64, value: impl Fn(f64) -> f64) -> f64 {
        if gap <= 0.0 {
            f64::INFINITY
        } else if gap < self.distance {
            value(gap / self.distance)
        } else {
            0.0
        }
    }
}

/// φ(x) = −B′/(κ d̂).
fn scaled_force(x: f64) -> f64 {
    let closed = 1.0 - x;
    closed * (closed / x - 2.0 * x.ln())
}

/// −φ′(x) = B″/κ.
fn scaled_stiffness(x: f64) -> f64 {
    (1.0 - x) * (1.0 + 3.0 * x) / (x * x) - 2.0 * x.ln()
}
