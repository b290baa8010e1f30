//! Settings of the solver of solid and water.

use crate::error::{Error, positive, require};
use crate::implicit::newton::check_tolerance;

/// The functions of the pore pressure, beside those of the displacement on cells of size h.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PressureSpace {
    /// The same functions on cells of size 2h.
    TwoGrid,
    /// The same functions on the same cells: pressures that no change of volume sees are not held.
    Equal,
    /// The same functions on the same cells, with a penalty on the variation of a pressure's increment within a cell
    /// (Dohrmann & Bochev 2004, doi:10.1002/fld.752), with a strength τ (1/Pa) of about 1/(2G).
    Projected {
        /// τ (1/Pa).
        strength: f64,
    },
}

/// The change of volume of a step over its volume at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VolumeRate {
    /// J̃ − 1: what the volume changes by.
    Exact,
    /// J̃ ln J̃, Eq. (51) of Pretti et al. as we read it: ln J̃ at the end of the step.
    Logarithmic,
}

/// The matrix of Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tangent {
    /// The derivative of the equations: Newton's order is two, factors are LU.
    Consistent,
    /// Without what the conductivity and the mixture's weight change with the deformation: symmetric with the exact
    /// rate and a law with a potential, so that factors are LDLᵀ.
    Symmetric,
}

/// Initial guess of the pressure in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Predictor {
    /// At zero.
    Zero,
    /// At the volume average of the particles' pressures.
    Particles,
}

/// Settings of the solver of solid and water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Duration of the first step (s).
    pub dt: f64,
    /// Duration of a step over that of the step before.
    pub growth: f64,
    /// The functions of the pressure.
    pub pressure_space: PressureSpace,
    /// The change of volume.
    pub volume_rate: VolumeRate,
    /// The matrix.
    pub tangent: Tangent,
    /// Initial guess.
    pub predictor: Predictor,
    /// Ghost penalty of the displacement, over the shear modulus.
    pub ghost_displacement: f64,
    /// Ghost penalty of the pressure, over κ Δt of undeformed material: that of Pretti et al., on all of p. 0.01 is
    /// enough.
    pub ghost_pressure: f64,
    /// A step has converged when the residuals of both equations are at most this share of what they balance.
    pub tolerance: f64,
    /// A step that takes more Newton iterations is halved.
    pub most_iterations: u32,
    /// A step that was halved more often than this has no solution to be found.
    pub most_halvings: u32,
}

impl Settings {
    /// Equal steps of `dt` (s) on two grids, with the exact rate and its symmetric matrix, without ghost penalties.
    #[must_use]
    pub fn new(dt: f64) -> Self {
        Self {
            dt,
            growth: 1.0,
            pressure_space: PressureSpace::TwoGrid,
            volume_rate: VolumeRate::Exact,
            tangent: Tangent::Symmetric,
            predictor: Predictor::Particles,
            ghost_displacement: 0.0,
            ghost_pressure: 0.0,
            tolerance: 1e-9,
            most_iterations: 40,
            most_halvings: 8,
        }
    }

    /// The same in units of which a pascal is `stress`.
    #[must_use]
    pub fn in_units(self, stress: f64) -> Self {
        let pressure_space = match self.pressure_space {
            PressureSpace::Projected { strength } => PressureSpace::Projected { strength: strength / stress },
            space => space,
        };
        Self { pressure_space, ..self }
    }

    /// With a pressure space.
    #[must_use]
    pub fn pressure_space(self, pressure_space: PressureSpace) -> Self {
        Self { pressure_space, ..self }
    }

    /// With a matrix of Newton's method.
    #[must_use]
    pub fn tangent(self, tangent: Tangent) -> Self {
        Self { tangent, ..self }
    }

    /// With a rate of volume.
    #[must_use]
    pub fn volume_rate(self, volume_rate: VolumeRate) -> Self {
        Self { volume_rate, ..self }
    }

    /// With ghost penalties on displacement and pressure.
    #[must_use]
    pub fn ghosts(self, displacement: f64, pressure: f64) -> Self {
        Self { ghost_displacement: displacement, ghost_pressure: pressure, ..self }
    }

    /// Whether something acts on what pressures change by.
    pub(super) fn watches_increments(&self) -> bool {
        matches!(self.pressure_space, PressureSpace::Projected { .. })
    }

    pub(super) fn check(&self, conservative: bool) -> Result<(), Error> {
        positive(self.dt, "time step", "positive (s)")?;
        positive(self.growth, "growth of the time step", "positive")?;
        check_tolerance(self.tolerance)?;
        if let PressureSpace::Projected { strength } = self.pressure_space {
            positive(strength, "strength of the pressure projection", "positive (1/Pa)")?;
        }
        for (what, share) in [
            ("ghost penalty of the displacement", self.ghost_displacement),
            ("ghost penalty of the pressure", self.ghost_pressure),
        ] {
            require((0.0..=10.0).contains(&share), what, share, "from 0 to 10")?;
        }
        let exact = self.volume_rate == VolumeRate::Exact;
        require(
            self.tangent == Tangent::Consistent || (exact && conservative),
            "symmetric tangent with a logarithmic rate or a law without a potential",
            1.0,
            "a consistent tangent",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strength times a pressure has no unit.
    #[test]
    fn a_strength_has_the_unit_of_a_compliance() {
        let projected =
            |strength| Settings { pressure_space: PressureSpace::Projected { strength }, ..Settings::new(2.0) };
        let found = projected(6.0).in_units(4.0);
        assert_eq!(found.pressure_space, projected(1.5).pressure_space);
        assert_eq!(found.dt, 2.0);
    }
}
