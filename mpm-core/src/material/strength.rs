//! The strength κ of J2 plasticity, how flow softens it, and the flow that takes a stress back to it.

use super::State;
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;

/// Newton steps for the flow: at most this many. The function is concave, so that from the second on the
/// iterates fall towards the root.
const MOST_STEPS: usize = 50;
/// Relative accuracy of ‖s‖ = κ.
pub(super) const ACCURACY: f64 = 1e-14;
/// √(2/3): equivalent plastic strain per flow.
pub(super) const PER_FLOW: f64 = 0.816_496_580_927_726;

/// The strength κ = ‖s‖ of J2 plasticity as a function of the equivalent plastic strain ε, ε̇ = √(2/3) γ̇ with the flow
/// γ̇ = ‖ε̇ᵖ‖.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    peak: f64,
    residual: f64,
    softening: Softening,
}

/// How strength falls.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Softening {
    None,
    /// κ = κ_r + (κ_p − κ_r) e^(−η ε) with this η.
    Exponential(f64),
    /// κ = max(κ_r, κ_p − h ε) with this h (Pa).
    Linear(f64),
}

impl Strength {
    /// Perfect plasticity with κ = ‖s‖ (Pa).
    ///
    /// # Errors
    /// κ not positive and finite.
    pub fn perfect(kappa: f64) -> Result<Self, Error> {
        Self::new(kappa, kappa, Softening::None)
    }

    /// Perfect plasticity with the undrained shear strength s_u (Pa) of plane strain: κ = √2 s_u.
    ///
    /// # Errors
    /// s_u not positive and finite.
    pub fn undrained(shear_strength: f64) -> Result<Self, Error> {
        Self::perfect(std::f64::consts::SQRT_2 * shear_strength)
    }

    /// From `peak` to `residual` (both ‖s‖, Pa) with the coefficient η (dimensionless), as e^(−η ε): Section 4.4 of
    /// Zhao, Jiang & Choo (2023), doi:10.1002/nme.7347.
    ///
    /// # Errors
    /// A strength that is not positive and finite, a residual strength above the peak, a negative η.
    pub fn softening(peak: f64, residual: f64, eta: f64) -> Result<Self, Error> {
        require(eta >= 0.0, "softening coefficient", eta, "zero or positive")?;
        let softening = if eta > 0.0 { Softening::Exponential(eta) } else { Softening::None };
        Self::new(peak, residual, softening)
    }

    /// From `peak` to `residual` (both ‖s‖, Pa) in a straight line that falls by `slope` (Pa, positive) per equivalent
    /// plastic strain: Fig. 8 of Wang, Vardon, Hicks & Chen (2016), doi:10.1016/j.compgeo.2015.08.008, whose c and
    /// H = dc/dε are, as a shear strength of plane strain, κ/√2 and −`slope`/√2.
    ///
    /// # Errors
    /// A strength that is not positive and finite, a residual strength above the peak, a slope that is not positive and
    /// finite.
    pub fn softening_linearly(peak: f64, residual: f64, slope: f64) -> Result<Self, Error> {
        positive(slope, "slope of softening", "positive (Pa)")?;
        Self::new(peak, residual, Softening::Linear(slope))
    }

    /// The same in units of which a pascal is `stress`.
    pub(super) fn in_units(&self, stress: f64) -> Self {
        Self {
            peak: stress * self.peak,
            residual: stress * self.residual,
            softening: match self.softening {
                Softening::Linear(slope) => Softening::Linear(stress * slope),
                softening => softening,
            },
        }
    }

    fn new(peak: f64, residual: f64, softening: Softening) -> Result<Self, Error> {
        positive(peak, "peak strength", "positive (Pa)")?;
        require(
            residual > 0.0 && residual <= peak,
            "residual strength",
            residual,
            "positive and at most the peak strength (Pa)",
        )?;
        Ok(Self { peak, residual, softening })
    }

    /// That the strength softens no faster than the stress of a solid with the shear modulus μ (Pa) can fall; the
    /// stress would jump at yield.
    ///
    /// # Errors
    /// √(2/3) |dκ/dε| ≥ 2μ at the peak, where all that soften are steepest.
    pub(super) fn require_gentler_than(&self, shear_modulus: f64) -> Result<(), Error> {
        let slope = -PER_FLOW * self.at(0.0).1;
        require(
            slope < 2.0 * shear_modulus,
            "slope of softening √(2/3) |dκ/dε|",
            slope,
            "less than twice the shear modulus (Pa)",
        )
    }

    /// κ (Pa) at an equivalent plastic strain, and its slope (Pa).
    #[inline]
    pub fn at<T: Real>(&self, plastic_strain: T) -> (T, T) {
        let difference = T::splat(self.peak - self.residual);
        let (excess, slope) = match self.softening {
            // Without softening an exponential would be the dearest part of the law.
            Softening::None => return (T::splat(self.peak), T::default()),
            Softening::Exponential(eta) => {
                let excess = difference * (T::splat(-eta) * plastic_strain).exp();
                (excess, T::splat(-eta) * excess)
            }
            Softening::Linear(slope) => {
                let excess = difference - T::splat(slope) * plastic_strain;
                let falls = excess.if_positive(T::splat(-slope), T::default());
                (excess.at_least(0.0), falls)
            }
        };
        (T::splat(self.residual) + excess, slope)
    }

    /// Dissipation up to an equivalent plastic strain per reference volume (J/m³): ∫ √(3/2) κ dε.
    pub fn plastic_work(&self, plastic_strain: f64) -> f64 {
        let difference = self.peak - self.residual;
        let above = match self.softening {
            Softening::None => difference * plastic_strain,
            Softening::Exponential(eta) => -difference * (-eta * plastic_strain).exp_m1() / eta,
            Softening::Linear(slope) => {
                let until = plastic_strain.min(difference / slope);
                until * (difference - 0.5 * slope * until)
            }
        };
        1.5_f64.sqrt() * (self.residual * plastic_strain + above)
    }

    /// The flow γ that takes a trial stress of norm `trial` (Pa) back to the surface:
    /// `trial` − `stiffness` γ = κ(ε + √(2/3) γ). Zero of a stress within it.
    #[inline(always)]
    pub(super) fn flow<T: Real>(&self, trial: T, stiffness: f64, plastic_strain: T) -> T {
        let per_flow = T::splat(PER_FLOW);
        let stiffness = T::splat(stiffness);
        let (mut kappa, mut slope) = self.at(plastic_strain);
        let mut excess = (trial - kappa).at_least(0.0);
        let mut flow = T::default();
        if !excess.any_positive() {
            return flow;
        }
        let yields = excess;
        for _ in 0..MOST_STEPS {
            if !(excess.abs() - T::splat(ACCURACY) * kappa).any_positive() {
                break;
            }
            flow += excess / (stiffness + per_flow * slope);
            (kappa, slope) = self.at(plastic_strain + per_flow * flow);
            excess = yields.if_positive(trial - stiffness * flow - kappa, T::default());
        }
        flow.with_slopes_of(excess / (stiffness + per_flow * slope))
    }
}

/// State of a particle of a solid that yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElastoplasticState<T = f64> {
    /// State of the elasticity: the elastic left Cauchy–Green tensor b_e of [`HenckyJ2`](super::HenckyJ2), the Cauchy
    /// stress (Pa) of [`HypoelasticJ2`](super::HypoelasticJ2).
    pub elastic: SymmetricTensor<T>,
    /// Equivalent plastic strain ε.
    pub plastic_strain: T,
}

impl State for ElastoplasticState {
    const NUMBERS: usize = 7;
    type Of<T: Real> = ElastoplasticState<T>;

    #[inline(always)]
    fn read<T: Real>(of: impl Fn(usize) -> T) -> ElastoplasticState<T> {
        ElastoplasticState { plastic_strain: of(6), elastic: SymmetricTensor::read(of) }
    }

    #[inline(always)]
    fn write<T: Real>(of: &ElastoplasticState<T>, mut put: impl FnMut(usize, &T)) {
        SymmetricTensor::write(&of.elastic, &mut put);
        put(6, &of.plastic_strain);
    }
}
