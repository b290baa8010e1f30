//! Settings of the implicit solver.

use super::newton::check_tolerance;
use crate::error::{Error, positive, require};
use crate::projection::Onto;

/// Stabilisation of functions that see hardly any material. It acts on the increment of a step, so that its contribution
/// to equilibrium vanishes with the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stabilisation {
    /// Nothing.
    None,
    /// Jumps of the k-th normal derivative of the increment, k the degree, on the faces of cells at the edge of the
    /// body: γ E h^(2k−1) ∫ \[∂ₙᵏu\] · \[∂ₙᵏv\]; where ground flows E is the share of it that the ground keeps. γ is given.
    Ghost(f64),
    /// The elastic stiffness of the whole mesh, integrated by Gauss' rule, times this factor: the paper's.
    Soft(f64),
}

impl Stabilisation {
    /// A ghost penalty γ; none of zero.
    #[must_use]
    pub fn ghost(factor: f64) -> Self {
        if factor == 0.0 { Self::None } else { Self::Ghost(factor) }
    }
}

/// γ of the ghost penalty of scenes and cases, a share of Young's modulus: derived in `docs/implicit.md`.
pub const GHOST: f64 = 1e-3;

/// Locking remedies of a quasi-static run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Remedy {
    /// Standard MPM.
    None,
    /// F̄ in variational form, with A = Π.
    Bbar,
    /// The same with A = I − (1 − ε)(I − Π)².
    FbarConsistent,
}

/// The equations of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeRule {
    /// Equilibrium at the end of the step: there are no velocities.
    Static,
    /// The implicit midpoint rule with the mass (1 − β) M_c + β M_l; the share β is given. Conservation of momentum to
    /// rounding, of energy to second order without gain: `docs/implicit.md`.
    Midpoint {
        /// β, the share of the lumped mass.
        lumped: f64,
    },
    /// Newmark's rule with the lumped mass, equilibrium at the end of the step, as Eqs. (22) to (32) of Wang et al.
    /// 2016, doi:10.1016/j.compgeo.2015.08.008, are printed.
    Newmark {
        /// α of Eq. (23).
        alpha: f64,
        /// δ of Eq. (22).
        delta: f64,
    },
}

impl TimeRule {
    /// Where in a step its equations hold, in shares of it.
    pub(super) fn place(self) -> f64 {
        match self {
            Self::Midpoint { .. } => 0.5,
            Self::Static | Self::Newmark { .. } => 1.0,
        }
    }

    /// Shares in a force's work over a step: of its value at the start, and of that where the equations hold.
    pub(super) fn shares(self) -> [f64; 2] {
        match self {
            Self::Midpoint { .. } => [0.0, 1.0],
            Self::Static | Self::Newmark { .. } => [0.5, 0.5],
        }
    }

    fn check(self) -> Result<(), Error> {
        match self {
            Self::Static => Ok(()),
            Self::Midpoint { lumped } => {
                require((0.0..=1.0).contains(&lumped), "share of the lumped mass", lumped, "from 0 to 1")
            }
            Self::Newmark { alpha, delta } => {
                require(delta >= 0.5, "delta of Newmark's rule", delta, "at least 0.5: less is unstable")?;
                let least = 0.25 * (delta + 0.5) * (delta + 0.5);
                require(
                    alpha >= least,
                    "alpha of Newmark's rule",
                    alpha,
                    "at least (delta + 1/2)²/4: less is unstable in long steps, or overdamped",
                )
            }
        }
    }
}

/// Settings of the implicit solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Duration of a load step (s), or its share of the load: whatever the loads take for time.
    pub dt: f64,
    /// The equations of a step.
    pub rule: TimeRule,
    /// The locking remedy.
    pub remedy: Remedy,
    /// The functions that the remedy averages with.
    pub onto: Onto,
    /// Stabilisation of functions that see hardly any material.
    pub stabilisation: Stabilisation,
    /// A step has converged when the free nodes' residual is at most this share of the loads; where a constraint moves,
    /// of reactions, if they are greater.
    pub tolerance: f64,
    /// A step that takes more Newton iterations is halved.
    pub most_iterations: u32,
    /// A step that was halved more often than this has no equilibrium to be found.
    pub most_halvings: u32,
}

impl Settings {
    /// Static steps of `dt` (s), without remedy and stabilisation.
    #[must_use]
    pub fn new(dt: f64) -> Self {
        Self {
            dt,
            rule: TimeRule::Static,
            remedy: Remedy::None,
            onto: Onto::Basis,
            stabilisation: Stabilisation::None,
            tolerance: 1e-9,
            most_iterations: 25,
            most_halvings: 8,
        }
    }

    /// With a time rule.
    #[must_use]
    pub fn rule(self, rule: TimeRule) -> Self {
        Self { rule, ..self }
    }

    /// With a stabilisation.
    #[must_use]
    pub fn stabilised(self, stabilisation: Stabilisation) -> Self {
        Self { stabilisation, ..self }
    }

    /// With a remedy.
    #[must_use]
    pub fn remedy(self, remedy: Remedy) -> Self {
        Self { remedy, ..self }
    }

    /// With averages onto other functions.
    #[must_use]
    pub fn onto(self, onto: Onto) -> Self {
        Self { onto, ..self }
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        positive(self.dt, "load step", "positive (s)")?;
        self.rule.check()?;
        check_tolerance(self.tolerance)?;
        match self.stabilisation {
            Stabilisation::None => Ok(()),
            Stabilisation::Ghost(factor) | Stabilisation::Soft(factor) => {
                require(factor > 0.0 && factor <= 1.0, "factor of the stabilisation", factor, "above 0, at most 1")
            }
        }
    }
}
