//! How a scene is solved, and how well that went.

use crate::error::{Error, require};

/// What holds functions that see hardly any material. Penalties act on the increment of a step, so that what they add to
/// equilibrium vanishes with the steps; an extension adds nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stabilisation {
    /// Nothing.
    None,
    /// Jumps of the k-th normal derivative of the increment, k the degree, on the faces of cells at the edge of the
    /// body: γ E h^(2k−1) ∫ \[∂ₙᵏu\] · \[∂ₙᵏv\]. γ is given.
    Ghost(f64),
    /// The elastic stiffness of the whole mesh, integrated by Gauss' rule, times this factor: the paper's.
    Soft(f64),
    /// Functions that see less than a tenth of what a full one does move as a linear field through inner ones.
    Extension,
}

/// Locking remedies of a quasi-static run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuasiStaticRemedy {
    /// Standard MPM.
    None,
    /// F̄ in variational form, with A = I − (1 − ε)(I − Π)².
    FbarConsistent,
}

/// How the implicit solver solves a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuasiStatic {
    /// Duration of a load step (s), or its share of the load: whatever the loads take for time.
    pub dt: f64,
    /// The locking remedy.
    pub remedy: QuasiStaticRemedy,
    /// What holds functions that see hardly any material.
    pub stabilisation: Stabilisation,
    /// A step has converged when the free nodes' residual is at most this share of the loads; where a constraint moves, of
    /// reactions, if they are greater.
    pub tolerance: f64,
    /// A step that takes more Newton iterations is halved.
    pub most_iterations: u32,
    /// A step that was halved more often than this has no equilibrium to be found.
    pub most_halvings: u32,
}

/// Least and greatest tolerance: below the first rounding decides.
const TOLERANCES: [f64; 2] = [1e-13, 1e-2];

impl QuasiStatic {
    /// Steps of `dt` (s), without remedy and stabilisation.
    #[must_use]
    pub fn new(dt: f64) -> Self {
        Self {
            dt,
            remedy: QuasiStaticRemedy::None,
            stabilisation: Stabilisation::None,
            tolerance: 1e-9,
            most_iterations: 25,
            most_halvings: 8,
        }
    }

    /// With a stabilisation.
    #[must_use]
    pub fn stabilised(self, stabilisation: Stabilisation) -> Self {
        Self {
            stabilisation,
            ..self
        }
    }

    /// With a remedy.
    #[must_use]
    pub fn remedy(self, remedy: QuasiStaticRemedy) -> Self {
        Self { remedy, ..self }
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        require(self.dt > 0.0, "load step", self.dt, "positive (s)")?;
        let [least, greatest] = TOLERANCES;
        require(
            self.tolerance >= least && self.tolerance <= greatest,
            "tolerance of Newton's method",
            self.tolerance,
            "from 1e-13 to 1e-2",
        )?;
        match self.stabilisation {
            Stabilisation::None | Stabilisation::Extension => Ok(()),
            Stabilisation::Ghost(factor) | Stabilisation::Soft(factor) => require(
                factor > 0.0 && factor <= 1.0,
                "factor of the stabilisation",
                factor,
                "above 0, at most 1",
            ),
        }
    }
}
