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

use super::{Hencky, Law, Response, StateOf, VolumetricState};
use crate::error::{Error, require};
use crate::number::Real;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use std::f64::consts::FRAC_PI_2;

/// Deviators below this have no direction: derivatives of what is divided by their square would be lost.
const NOTHING: f64 = 1e-60;

/// A Hencky solid with friction, cohesion and dilation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MohrCoulomb {
    elasticity: Hencky,
    /// sin φ, sin ψ and c cos φ (Pa).
    friction: f64,
    dilation: f64,
    cohesion: f64,
}

impl MohrCoulomb {
    /// From Young's modulus (Pa), Poisson's ratio, the cohesion c (Pa), and the angles of friction φ and dilation ψ (rad).
    ///
    /// # Errors
    /// A modulus that is not positive and finite; a ratio outside (−1, 0.5); a cohesion that is negative, or zero without
    /// friction; a φ outside [0, π/2); a ψ outside [0, φ].
    pub fn new((young_modulus, poisson_ratio): (f64, f64), cohesion: f64, [phi, psi]: [f64; 2]) -> Result<Self, Error> {
        let elasticity = Hencky::new(young_modulus, poisson_ratio)?;
        require((0.0..FRAC_PI_2).contains(&phi), "angle of friction φ", phi, "from 0 to below π/2 (rad)")?;
        require((0.0..=phi).contains(&psi), "angle of dilation ψ", psi, "from 0 to the angle of friction (rad)")?;
        let least = if phi > 0.0 { cohesion >= 0.0 } else { cohesion > 0.0 };
        require(least, "cohesion c", cohesion, "positive (Pa), or zero with friction")?;
        Ok(Self { elasticity, friction: phi.sin(), dilation: psi.sin(), cohesion: cohesion * phi.cos() })
    }

    /// c cot φ (Pa): the mean Kirchhoff stress at the tip.
    fn tip(&self) -> f64 {
        if self.friction > 0.0 { self.cohesion / self.friction } else { f64::INFINITY }
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
        let Self { friction, dilation, .. } = *self;
        let mut after = VolumetricState { elastic: state.elastic.push_forward(delta_f), ..*state };
        // Twice the strain.
        let logarithm = after.elastic.ln();
        let (volume, mut deviator) = (number(0.5) * logarithm.trace(), logarithm.deviator());
        let inverse_jacobian = (-(volume + state.plastic_volume)).exp();
        let mut mean = number(bulk_modulus) * volume;
        let beyond_tip = number(2.0) * (number(friction) * mean - number(self.cohesion));
        // Nothing yields within the cone that touches all planes.
        let cone = shear_modulus * (2.0 + 2.0 / 3.0 * friction * friction).sqrt();
        if (number(cone) * deviator.norm() + beyond_tip).any_positive() {
            let greater = |a: T, b: T| (a - b).if_positive(a, b);
            let half = number(0.5);
            let split = Split::of(deviator);
            let single = split.single.abs();
            let opposite = half * single + split.apart;
            // The greatest principal value of twice the strain's deviator, and the least one's opposite.
            let swapped = |[a, b]: [T; 2]| [split.single.if_positive(a, b), split.single.if_positive(b, a)];
            let [greatest, least] = swapped([single, opposite]);
            // Flow takes these times `flow` away from them, and sin ψ times it from the volume.
            let [rate, rate_of_least] = [1.0 + dilation / 3.0, 1.0 - dilation / 3.0];
            let flow_to = |[a, b]: [f64; 2]| {
                let stiffness =
                    shear_modulus * (a * rate + b * rate_of_least) + 2.0 * friction * dilation * bulk_modulus;
                let shear = number(a * shear_modulus) * greatest + number(b * shear_modulus) * least;
                (shear + beyond_tip) * number(1.0 / stiffness)
            };
            let to_plane = flow_to([1.0 + friction, 1.0 - friction]);
            let to_edge = greater(flow_to([1.5 + 0.5 * friction, 0.0]), flow_to([0.0, 1.5 - 0.5 * friction]));
            let to_axis = greater(greatest * number(1.0 / rate), least * number(1.0 / rate_of_least));
            let flow = greater(to_plane, to_edge).at_least(0.0);
            let flow = (flow - to_axis).if_positive(to_axis, flow);
            let least = least - number(rate_of_least) * flow;
            // Where the greatest would pass the middle one, both go on together. Where the least would, it is not the
            // single one, and nothing is left of what is apart.
            let greatest = greater(greatest - number(rate) * flow, half * least);
            let [single, opposite] = swapped([greatest, least]);
            let left = (opposite - half * single).at_least(0.0) / split.apart.at_least(f64::MIN_POSITIVE);
            let nearer = flow.if_positive(left - number(1.0), number(0.0));
            let single = split.single.if_positive(single, -single);
            let change = split.combined(single - split.single, nearer);
            let within = (mean - number(dilation * bulk_modulus) * flow).at_most(self.tip());
            let plastic_volume = (mean - within) * number(1.0 / bulk_modulus);
            let back = change.scale_add_identity(number(1.0), number(-2.0 / 3.0) * plastic_volume);
            after.elastic = after.elastic.times_commuting(&back.exp());
            after.plastic_volume += plastic_volume;
            after.plastic_strain += number(6.0_f64.sqrt().recip()) * back.norm();
            (deviator, mean) = (deviator.add(&change), within);
        }
        (deviator.scale_add_identity(number(shear_modulus) * inverse_jacobian, mean * inverse_jacobian), after)
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
