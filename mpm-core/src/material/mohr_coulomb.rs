//! Hencky elasticity with the yield pyramid of Mohr and Coulomb, for soil with friction.
//!
//! With the principal Kirchhoff stresses τ₁ ≥ τ₂ ≥ τ₃, extension positive, it yields at
//!
//! (τ₁ − τ₃) + (τ₁ + τ₃) sin φ = 2 c cos φ, and flows along the normal of the same plane with ψ in place of φ:
//! (1 + sin ψ, 0, sin ψ − 1) in the principal axes.
//!
//! c is the cohesion, φ the angle of friction, ψ that of dilation. Stresses return along straight lines in principal
//! space: to a plane, to an edge where two planes meet, or to the tip, τ₁ = τ₂ = τ₃ = c cot φ. (E. A. de Souza Neto,
//! D. Perić & D. R. J. Owen, *Computational Methods for Plasticity*, 2008, section 8.2, returns to each in turn and asks
//! which was right.) Without friction there is no tip, and the pyramid is Tresca's prism.
//!
//! c cos φ, sin φ and sin ψ may fall in straight lines with the plastic strain, and a particle may have a cohesion of its
//! own. A cut-off τ₁ ≤ T, whose flow is normal to it, may end the pyramid before its tip. A stress beyond both returns to
//! the cut-off first and from there to the pyramid, which leads away from the cut-off, so that both hold at the end of a
//! step. Where both flow, the division of a step between them converges at first order, as softening does.

use super::{Hencky, Law, Response, StateOf, VolumetricState};
use crate::error::{Error, positive, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use std::f64::consts::FRAC_PI_2;

/// Deviators below this have no direction: derivatives of what is divided by their square would be lost.
const NOTHING: f64 = 1e-60;

/// The least friction by which a cohesion is divided.
const SMOOTH: f64 = 1e-30;

/// A Hencky solid with friction, cohesion and dilation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MohrCoulomb {
    elasticity: Hencky,
    /// sin φ, sin ψ and c cos φ (Pa).
    peak: [f64; 3],
    /// The same after softening.
    residual: [f64; 3],
    /// Part of the softening per equivalent plastic strain.
    softening: f64,
    /// T (Pa).
    tension: f64,
}

/// sin φ, sin ψ and c cos φ.
fn strength(cohesion: f64, [phi, psi]: [f64; 2]) -> Result<[f64; 3], Error> {
    require((0.0..FRAC_PI_2).contains(&phi), "angle of friction φ", phi, "from 0 to below π/2 (rad)")?;
    require((0.0..=phi).contains(&psi), "angle of dilation ψ", psi, "from 0 to the angle of friction (rad)")?;
    let least = if phi > 0.0 { cohesion >= 0.0 } else { cohesion > 0.0 };
    require(least, "cohesion c", cohesion, "positive (Pa), or zero with friction")?;
    Ok([phi.sin(), psi.sin(), cohesion * phi.cos()])
}

impl MohrCoulomb {
    /// From Young's modulus (Pa), Poisson's ratio, the cohesion c (Pa), and the angles of friction φ and dilation ψ (rad).
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a cohesion that is negative, or zero without
    /// friction; a φ outside [0, π/2); a ψ outside [0, φ].
    pub fn new((young_modulus, poisson_ratio): (f64, f64), cohesion: f64, angles: [f64; 2]) -> Result<Self, Error> {
        let elasticity = Hencky::new(young_modulus, poisson_ratio)?;
        let peak = strength(cohesion, angles)?;
        Ok(Self { elasticity, peak, residual: peak, softening: 0.0, tension: f64::INFINITY })
    }

    /// The same, whose c cos φ, sin φ and sin ψ fall in straight lines to those of a residual cohesion (Pa) and of residual
    /// `angles` φ and ψ (rad), while the equivalent plastic strain grows to `strain`.
    ///
    /// # Errors
    /// As of [`Self::new`]; a residual above the peak; a strain that is not positive and finite.
    pub fn softening(self, cohesion: f64, angles: [f64; 2], strain: f64) -> Result<Self, Error> {
        let residual = strength(cohesion, angles)?;
        positive(strain, "plastic strain of the residual strength", "positive")?;
        let names = ["residual sin φ", "residual sin ψ", "residual c cos φ (Pa)"];
        for ((own, peak), name) in residual.iter().zip(self.peak).zip(names) {
            require(*own <= peak, name, *own, "at most that of the peak strength")?;
        }
        Ok(Self { residual, softening: strain.recip(), ..self })
    }

    /// The same, whose principal stresses are at most `tension` (Pa).
    ///
    /// # Errors
    /// A tension that is negative, or not below c cot φ, where the pyramid ends.
    pub fn cut_off(self, tension: f64) -> Result<Self, Error> {
        let [friction, _, cohesion] = self.peak;
        let within = (0.0..f64::INFINITY).contains(&tension) && tension * friction < cohesion;
        require(within, "tension cut-off", tension, "from 0 to below c cot φ (Pa)")?;
        Ok(Self { tension, ..self })
    }

    /// sin φ, sin ψ and c cos φ (Pa) at the start of a step.
    #[inline(always)]
    fn strength<T: Real>(&self, (state, own): &(VolumetricState<T>, T)) -> [T; 3] {
        let left = (T::splat(1.0) - T::splat(self.softening) * state.plastic_strain).at_least(0.0);
        let at = |k: usize| T::splat(self.residual[k]) + T::splat(self.peak[k] - self.residual[k]) * left;
        let cohesion = at(2);
        [at(0), at(1), cohesion + cohesion * *own]
    }
}

/// A deviator s as a M + D. M has the eigenvalues 1, −½ and −½, D has 0, r and −r, in the axes of s.
///
/// a is the eigenvalue that is farthest from the others. D is without it, so that r keeps its digits where the others
/// meet.
struct Split<T> {
    whole: SymmetricTensor<T>,
    /// M = `weight` (dev s² + a s).
    square: SymmetricTensor<T>,
    weight: T,
    single: T,
    apart: T,
}

impl<T: Real> Split<T> {
    /// a has the sign of the determinant J₃, and |a| = x m of m = √(J₂/3) with x³ − 3x = |J₃|/m³, x from √3 to 2. By
    /// Cayley and Hamilton the projection on the axis of a is (s² + a s + (a² − J₂) I)/(3a² − J₂).
    #[inline(always)]
    fn of(whole: SymmetricTensor<T>) -> Self {
        let number = T::splat;
        let square = whole.times_commuting(&whole);
        let (j2, j3) = (number(0.5) * square.trace(), whole.determinant());
        let size = (number(1.0 / 3.0) * j2).sqrt().at_least(NOTHING);
        let cube = j3.abs() / (size * size * size);
        // Newton's steps from the chord, which is off by 0.014 at most: by 10⁻⁴, 10⁻⁸ and rounding, as the slopes are.
        let chord = 3.0_f64.sqrt();
        let mut x = number(0.5 * (2.0 - chord)) * cube + number(chord);
        for _ in 0..3 {
            x += (x * (x * x - number(3.0)) - cube) / (number(3.0) * (number(1.0) - x * x));
        }
        let length = size * x;
        let single = j3.if_positive(length, -length);
        let weight = number(1.5) / (number(3.0) * single * single - j2);
        let square = square.deviator();
        let mut split = Self { whole, square, weight, single, apart: T::default() };
        split.apart = number(0.5_f64.sqrt()) * split.combined(number(0.0), number(1.0)).norm();
        split
    }

    /// `single` M + `apart` D.
    #[inline(always)]
    fn combined(&self, single: T, apart: T) -> SymmetricTensor<T> {
        let of_square = self.weight * (single - apart * self.single);
        let of_whole = apart + of_square * self.single;
        let whole = self.whole.scale_add_identity(of_whole, T::default());
        whole.add(&self.square.scale_add_identity(of_square, T::default()))
    }
}

impl Law for MohrCoulomb {
    /// The last number is what a particle has of cohesion beyond that of the law, as a share of it.
    type State = (VolumetricState, f64);

    /// With ψ < φ flow is not normal to the surface.
    const CONSERVATIVE: bool = false;

    fn in_units(&self, stress: f64) -> Self {
        let scaled = |[phi, psi, cohesion]: [f64; 3]| [phi, psi, stress * cohesion];
        Self {
            elasticity: self.elasticity.in_units(stress),
            peak: scaled(self.peak),
            residual: scaled(self.residual),
            tension: stress * self.tension,
            ..*self
        }
    }

    fn initial_state(&self) -> Self::State {
        (VolumetricState { elastic: SymmetricTensor::identity(), plastic_volume: 0.0, plastic_strain: 0.0 }, 0.0)
    }

    fn undeformed(&self, like: &Self::State) -> Self::State {
        (self.initial_state().0, like.1)
    }

    fn stronger(&self, (state, _): Self::State, share: f64) -> Option<Self::State> {
        Some((state, share - 1.0))
    }

    #[inline(always)]
    fn response<T: Real>(&self, delta_f: &Matrix3<T>, _dt: f64, before: &StateOf<Self, T>) -> Response<Self, T> {
        let number = T::splat;
        let Hencky { bulk_modulus, shear_modulus } = self.elasticity;
        let [friction, dilation, cohesion] = self.strength(before);
        let (state, own) = before;
        let mut after = VolumetricState { elastic: state.elastic.push_forward(delta_f), ..*state };
        // Twice the strain.
        let logarithm = after.elastic.ln();
        let (volume, mut deviator) = (number(0.5) * logarithm.trace(), logarithm.deviator());
        let inverse_jacobian = (-(volume + state.plastic_volume)).exp();
        let mut mean = number(bulk_modulus) * volume;
        let beyond_tip = |mean: T| number(2.0) * (friction * mean - cohesion);
        // Nothing yields within the cone that touches all planes, nor where no principal stress can be beyond T.
        let cone = number(shear_modulus * (2.0 + 2.0 / 3.0 * self.peak[0] * self.peak[0]).sqrt()) * deviator.norm();
        let pulled = mean + number(shear_modulus) * deviator.norm() - number(self.tension);
        if (cone + beyond_tip(mean)).any_positive() || pulled.any_positive() {
            let greater = |a: T, b: T| (a - b).if_positive(a, b);
            let (half, shear) = (number(0.5), number(shear_modulus));
            let split = Split::of(deviator);
            let single = split.single.abs();
            let opposite = half * single + split.apart;
            // The greatest principal value of twice the strain's deviator, and the least one's opposite.
            let swapped = |[a, b]: [T; 2]| [split.single.if_positive(a, b), split.single.if_positive(b, a)];
            let [greatest, least] = swapped([single, opposite]);
            // The cut-off takes a sum from twice the strain, over the n principal values that are T after it. With more of
            // them, or fewer, the sum would be smaller.
            let lame = 0.5 * (bulk_modulus - 2.0 / 3.0 * shear_modulus);
            let beyond = [greatest, least - greatest, -least].map(|p| mean + shear * p - number(self.tension));
            let taken = |sum: T, n: f64| sum * number((n * lame + shear_modulus).recip());
            let [first, second, third] = beyond;
            let sum = greater(taken(first, 1.0), taken(first + second, 2.0)).at_least(0.0);
            let sum = greater(sum, taken(first + second + third, 3.0));
            let of = |beyond: T| (beyond - number(lame) * sum).at_least(0.0) * number(shear_modulus.recip());
            let third_of_sum = number(1.0 / 3.0) * sum;
            let (greatest, least) = (greatest - of(first) + third_of_sum, least + of(third) - third_of_sum);
            let at_cut_off = mean - number(0.5 * bulk_modulus) * sum;
            // Flow takes these times `flow` away from them, and sin ψ times it from the volume.
            let [rate, rate_of_least] = [number(1.0), number(-1.0)].map(|sign| dilation * number(1.0 / 3.0) + sign);
            let rate_of_least = -rate_of_least;
            let flow_to = |[a, b]: [T; 2]| {
                let stiffness =
                    shear * (a * rate + b * rate_of_least) + number(2.0 * bulk_modulus) * friction * dilation;
                (shear * (a * greatest + b * least) + beyond_tip(at_cut_off)) / stiffness
            };
            let (none, edge) = (T::default(), half * friction);
            let to_plane = flow_to([number(1.0) + friction, number(1.0) - friction]);
            let to_edge = greater(flow_to([number(1.5) + edge, none]), flow_to([none, number(1.5) - edge]));
            let to_axis = greater(greatest / rate, least / rate_of_least);
            let flow = greater(to_plane, to_edge).at_least(0.0);
            let flow = (flow - to_axis).if_positive(to_axis, flow);
            let least = least - rate_of_least * flow;
            // Where the greatest would pass the middle one, both go on together. Where the least would, it is not the
            // single one, and nothing is left of what is apart.
            let greatest = greater(greatest - rate * flow, half * least);
            let [single, opposite] = swapped([greatest, least]);
            let left = (opposite - half * single).at_least(0.0) / split.apart.at_least(f64::MIN_POSITIVE);
            // Nothing goes farther apart; where nothing was, what is left is rounding.
            let left = left.at_most(1.0);
            let nearer = (flow + sum).if_positive(left - number(1.0), number(0.0));
            let single = split.single.if_positive(single, -single);
            let change = split.combined(single - split.single, nearer);
            let within = at_cut_off - number(bulk_modulus) * dilation * flow;
            let beyond = friction * within - cohesion;
            let within = beyond.if_positive(cohesion / friction.at_least(SMOOTH), within);
            let plastic_volume = (mean - within) * number(1.0 / bulk_modulus);
            let back = change.scale_add_identity(number(1.0), number(-2.0 / 3.0) * plastic_volume);
            after.elastic = after.elastic.times_commuting(&back.exp());
            after.plastic_volume += plastic_volume;
            after.plastic_strain += number(6.0_f64.sqrt().recip()) * back.norm();
            (deviator, mean) = (deviator.add(&change), within);
        }
        (deviator.scale_add_identity(number(shear_modulus) * inverse_jacobian, mean * inverse_jacobian), (after, *own))
    }

    fn plastic_strain(&self, (state, _): &Self::State) -> f64 {
        state.plastic_strain
    }

    fn energy(&self, (state, _): &Self::State) -> f64 {
        self.elasticity.energy(&state.elastic)
    }

    /// That of elastic material.
    #[inline(always)]
    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &StateOf<Self, T>) -> T {
        self.elasticity.wave_modulus(j, stress, &state.0.elastic)
    }
}
