//! Modified Cam clay at finite strain, with the two shape parameters of Collins & Hilder (2002, Int. J. Numer. Anal.
//! Methods Geomech. 26, 1313–1347) and the improved Hencky elasticity of [`ImprovedHencky`].
//!
//! With Kirchhoff's effective stress τ, compression positive, p = −tr τ/3 and q = √(3/2) ‖dev τ‖, it yields at
//!
//! ((p − ρ)/A)² + (q/B)² = 1, ρ = ½ γ p_c, A = (1 − γ) p + ½ γ p_c, B = M \[(1 − α) p + ½ α γ p_c\],
//!
//! where α = γ = 1 gives the ellipse q² = M² p (p_c − p) of Roscoe & Burland (1968). The dissipation of flow is
//!
//! Φ = √(A² ε̇_v² + B² ε̇_s²),
//!
//! hence ε̇_v : ε̇_s = (p − ρ)/A² : q/B²: along the ellipse's normal where α = γ = 1, elsewhere not along that of the
//! surface. The work of ρ is not dissipated but stored. Flow hardens: p_c grows by e^(ε_v/ψ) with ψ = λ − κ. The
//! critical state is at p = ρ, q = M p. `docs/cam-clay.md` derives it.

mod flow;

use super::{ImprovedHencky, Law, Response, StateOf, VolumetricState};
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use flow::Trial;
use nalgebra::Matrix3;

/// Halvings of a bracket: until no number is left between its ends.
const HALVINGS: u32 = 200;

/// Clay that yields, hardens and softens, and has a critical state. Undeformed, it is under an isotropic pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamClay {
    elasticity: ImprovedHencky,
    critical_ratio: f64,
    plastic_compressibility: f64,
    preconsolidation: f64,
    /// Elastic volume strain of undeformed material.
    initial_volume: f64,
    alpha: f64,
    gamma: f64,
}

impl CamClay {
    /// The classical law, α = γ = 1, from its elasticity, the ratio M = q/p of the critical state, the plastic
    /// compressibility ψ = λ − κ (slopes of ln V over ln p of first compression and of swelling; that of swelling
    /// itself is the elasticity's), and of undeformed material the preconsolidation p_c and the effective pressure
    /// that it rests under (Pa, both isotropic and as Kirchhoff stresses, which there are Cauchy's).
    ///
    /// # Errors
    /// A ratio, a compressibility or a preconsolidation that is not positive and finite; a pressure that is not
    /// positive, or above the preconsolidation.
    pub fn new(
        elasticity: ImprovedHencky,
        critical_ratio: f64,
        plastic_compressibility: f64,
        preconsolidation: f64,
        initial_pressure: f64,
    ) -> Result<Self, Error> {
        positive(critical_ratio, "critical state ratio M", "positive")?;
        positive(plastic_compressibility, "plastic compressibility λ − κ", "positive: λ is above κ")?;
        positive(preconsolidation, "preconsolidation", "positive (Pa)")?;
        require(
            initial_pressure > 0.0 && initial_pressure <= preconsolidation,
            "initial effective pressure",
            initial_pressure,
            "positive and at most the preconsolidation (Pa)",
        )?;
        Ok(Self {
            elasticity,
            critical_ratio,
            plastic_compressibility,
            preconsolidation,
            initial_volume: volume_at(&elasticity, initial_pressure),
            alpha: 1.0,
            gamma: 1.0,
        })
    }

    /// The same with other shape parameters: γ moves the critical state to p = ½ γ p_c, α < 1 turns the ellipse into a
    /// drop.
    ///
    /// # Errors
    /// One that is not above 0 and at most 1.
    pub fn shaped(self, alpha: f64, gamma: f64) -> Result<Self, Error> {
        for (what, value) in [("shape parameter α", alpha), ("shape parameter γ", gamma)] {
            require(value > 0.0 && value <= 1.0, what, value, "above 0 and at most 1")?;
        }
        Ok(Self { alpha, gamma, ..self })
    }

    /// p_c (Pa) after a plastic volume strain.
    #[inline(always)]
    fn preconsolidation_at<T: Real>(&self, plastic_volume: T) -> T {
        let since = plastic_volume + T::splat(self.initial_volume);
        T::splat(self.preconsolidation) * (since * T::splat(-1.0 / self.plastic_compressibility)).exp()
    }
}

/// The elastic volume strain at a pressure (Pa), which grows without bound as pores close: by bisection.
fn volume_at(elasticity: &ImprovedHencky, pressure: f64) -> f64 {
    let above = |volume: f64| -elasticity.volumetric(volume)[1] > pressure;
    bisect([(1.0 - elasticity.porosity).ln(), 0.0], above)[1]
}

/// Halves a bracket until no number is left between its ends; `below` tells whether a number is below the one sought.
fn bisect([mut low, mut high]: [f64; 2], below: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, high]
}

impl Law for CamClay {
    type State = VolumetricState;

    /// p_c of a step's end is in what the step dissipates, and with α or γ < 1 flow is not normal to the surface.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        Self { elasticity: self.elasticity.in_units(stress), preconsolidation: stress * self.preconsolidation, ..*self }
    }

    fn initial_state(&self) -> VolumetricState {
        let size = (2.0 / 3.0 * self.initial_volume).exp();
        VolumetricState {
            elastic: SymmetricTensor::identity().scale_add_identity(size, 0.0),
            plastic_volume: -self.initial_volume,
            plastic_strain: 0.0,
        }
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, state: &StateOf<Self, T>) -> Response<Self, T> {
        let (number, half) = (T::splat, T::splat(0.5));
        let shear_modulus = number(self.elasticity.shear_modulus);
        let elastic = state.elastic.push_forward(delta_f);
        // Twice the strain.
        let logarithm = elastic.ln();
        let (volume, direction) = (half * logarithm.trace(), logarithm.deviator());
        let inverse_jacobian = (-(volume + state.plastic_volume)).exp();
        let trial = Trial {
            volume,
            shear: number(1.5_f64.sqrt()) * shear_modulus * direction.norm(),
            preconsolidation: self.preconsolidation_at(state.plastic_volume),
        };
        let mut after = VolumetricState { elastic, ..*state };
        let (mut remains, mut elastic_volume) = (number(1.0), volume);
        if let Some(end) = self.flow(&trial) {
            (elastic_volume, remains) = (end.volume, end.shear_remains);
            let plastic_volume = volume - elastic_volume;
            let share = number(1.0) - remains;
            let back = direction.scale_add_identity(-share, number(-2.0 / 3.0) * plastic_volume);
            after.elastic = elastic.times_commuting(&back.exp());
            after.plastic_volume += plastic_volume;
            let shear = half * share * direction.norm();
            let square = shear * shear + number(1.0 / 3.0) * plastic_volume * plastic_volume;
            after.plastic_strain += (number(2.0 / 3.0) * square).sqrt();
        }
        let [_, mean, _] = self.elasticity.volumetric(elastic_volume);
        let stress = direction.scale_add_identity(shear_modulus * remains * inverse_jacobian, mean * inverse_jacobian);
        (stress, after)
    }

    fn plastic_strain(&self, state: &VolumetricState) -> f64 {
        state.plastic_strain
    }

    /// The elastic energy, and what the work of ρ has stored: ½ γ ψ (p_c − p_c of undeformed material).
    fn energy(&self, state: &VolumetricState) -> f64 {
        let hardened = self.preconsolidation_at(state.plastic_volume) - self.preconsolidation;
        self.elasticity.energy(&state.elastic) + 0.5 * self.gamma * self.plastic_compressibility * hardened
    }

    /// That of the elasticity at the elastic volume strain. Where α = γ = 1, flow makes no wave faster.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &StateOf<Self, T>) -> T {
        let [_, _, bulk] = self.elasticity.volumetric(j.ln() - state.plastic_volume);
        bulk + T::splat(4.0 / 3.0 * self.elasticity.shear_modulus) - j * stress.least_at_least()
    }
}

#[cfg(test)]
mod tests;
