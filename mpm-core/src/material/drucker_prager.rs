//! Hencky elasticity with the yield cone of Drucker & Prager (1952, doi:10.1090/qam/48291), for soil with friction.
//!
//! With the Kirchhoff stress τ, s = dev τ and p = tr τ/3, extension positive, it yields at
//!
//! ‖s‖ = ξ − η p, and flows along s/‖s‖ + η̄ I/3: by ‖ε̇ᵖ‖ in shear and by η̄ times that in volume.
//!
//! With φ the angle of friction, ψ that of dilation and c the cohesion, η, η̄ and ξ make its limit loads those of Mohr
//! and Coulomb's law in one kind of deformation, [`Matched`]. The return, along a radius and the axis at once, is exact
//! for any size of the step where the direction of flow does not turn; beyond the cone's tip it ends at the tip, p = ξ/η
//! and s = 0 (E. A. de Souza Neto, D. Perić & D. R. J. Owen, *Computational Methods for Plasticity*, 2008, section 8.3).

use super::{Hencky, Law, Response, StateOf, VolumetricState};
use crate::error::{Error, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use std::f64::consts::{FRAC_PI_2, SQRT_2};

/// Where the cone gives the limit loads of Mohr and Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Matched {
    /// Flow in plane strain: sin ψ = η̄′/√(1 − η̄′²/3), sin φ = η′ √(1 − η̄′²/3)/(1 − η′ η̄′/3), ξ′ = η′ c cot φ, with η = √2 η′
    /// and alike.
    PlaneStrain,
    /// Triaxial compression: the cone goes through the outer edges of the pyramid.
    Compression,
    /// Triaxial extension: through the inner edges.
    Extension,
}

/// A Hencky solid with friction, cohesion and dilation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DruckerPrager {
    elasticity: Hencky,
    /// η, η̄ and ξ (Pa).
    friction: f64,
    dilation: f64,
    cohesion: f64,
}

impl DruckerPrager {
    /// From Young's modulus (Pa), Poisson's ratio, the cohesion c (Pa), and the angles of friction φ and dilation ψ (rad).
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a cohesion that is negative, or zero without
    /// friction; a φ outside [0, π/2); a ψ outside [0, φ].
    pub fn new(
        (young_modulus, poisson_ratio): (f64, f64),
        cohesion: f64,
        [phi, psi]: [f64; 2],
        matched: Matched,
    ) -> Result<Self, Error> {
        let elasticity = Hencky::new(young_modulus, poisson_ratio)?;
        require((0.0..FRAC_PI_2).contains(&phi), "angle of friction φ", phi, "from 0 to below π/2 (rad)")?;
        require((0.0..=phi).contains(&psi), "angle of dilation ψ", psi, "from 0 to the angle of friction (rad)")?;
        let least = if phi > 0.0 { cohesion >= 0.0 } else { cohesion > 0.0 };
        require(least, "cohesion c", cohesion, "positive (Pa), or zero with friction")?;
        // η′, η̄′ and ξ′ over sin φ, sin ψ and c cos φ.
        let [sin_phi, sin_psi] = [phi, psi].map(f64::sin);
        let edge = |sin: f64, side: f64| 6.0 / (3.0_f64.sqrt() * (3.0 - side * sin));
        let [friction, dilation] = match matched {
            Matched::PlaneStrain => {
                let own = 1.0 / (1.0 + sin_psi * sin_psi / 3.0).sqrt();
                let dilation = own * sin_psi;
                [1.0 / ((1.0 - dilation * dilation / 3.0).sqrt() + sin_phi * dilation / 3.0), own]
            }
            Matched::Compression => [edge(sin_phi, 1.0), edge(sin_psi, 1.0)],
            Matched::Extension => [edge(sin_phi, -1.0), edge(sin_psi, -1.0)],
        };
        Ok(Self {
            elasticity,
            friction: SQRT_2 * friction * sin_phi,
            dilation: SQRT_2 * dilation * sin_psi,
            cohesion: SQRT_2 * friction * cohesion * phi.cos(),
        })
    }

    /// ξ/η (Pa): the mean Kirchhoff stress at the tip.
    fn tip(&self) -> f64 {
        if self.friction > 0.0 { self.cohesion / self.friction } else { f64::INFINITY }
    }
}

impl Law for DruckerPrager {
    type State = VolumetricState;

    /// With ψ < φ flow is not normal to the surface.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        Self { elasticity: self.elasticity.in_units(stress), cohesion: stress * self.cohesion, ..*self }
    }

    fn initial_state(&self) -> VolumetricState {
        VolumetricState { elastic: SymmetricTensor::identity(), plastic_volume: 0.0, plastic_strain: 0.0 }
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, state: &StateOf<Self, T>) -> Response<Self, T> {
        let number = T::splat;
        let Hencky { bulk_modulus, shear_modulus } = self.elasticity;
        let mut after = VolumetricState { elastic: state.elastic.push_forward(delta_f), ..*state };
        // Twice the strain.
        let logarithm = after.elastic.ln();
        let (volume, direction) = (number(0.5) * logarithm.trace(), logarithm.deviator());
        let inverse_jacobian = (-(volume + state.plastic_volume)).exp();
        let (norm, mut shear) = (direction.norm(), number(shear_modulus));
        let mut mean = number(bulk_modulus) * volume;
        let beyond = shear * norm + number(self.friction) * mean - number(self.cohesion);
        if beyond.any_positive() {
            let stiffness = 2.0 * shear_modulus + self.friction * self.dilation * bulk_modulus;
            // Share of the shear that flow takes away: of all of it, what is left lies beyond the tip.
            let on_cone = beyond.at_least(0.0) * number(2.0 / stiffness);
            let share = (on_cone / norm.at_least(f64::MIN_POSITIVE)).at_most(1.0);
            let flow = number(0.5) * share * norm;
            let within = (mean - number(self.dilation * bulk_modulus) * flow).at_most(self.tip());
            let plastic_volume = (mean - within) * number(1.0 / bulk_modulus);
            let back = direction.scale_add_identity(-share, number(-2.0 / 3.0) * plastic_volume);
            after.elastic = after.elastic.times_commuting(&back.exp());
            after.plastic_volume += plastic_volume;
            let square = flow * flow + number(1.0 / 3.0) * plastic_volume * plastic_volume;
            after.plastic_strain += (number(2.0 / 3.0) * square).sqrt();
            (shear, mean) = (shear * (number(1.0) - share), within);
        }
        (direction.scale_add_identity(shear * inverse_jacobian, mean * inverse_jacobian), after)
    }

    fn plastic_strain(&self, state: &VolumetricState) -> f64 {
        state.plastic_strain
    }

    fn energy(&self, state: &VolumetricState) -> f64 {
        self.elasticity.energy(&state.elastic)
    }

    /// That of elastic material.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &StateOf<Self, T>) -> T {
        self.elasticity.wave_modulus(j, stress, &state.elastic)
    }
}
