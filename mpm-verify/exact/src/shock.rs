//! The exact front: Rankine and Hugoniot's conditions for a bar in uniaxial strain that runs into a wall.

use crate::root;
use mpm_core::Law;
use mpm_core::material::NeoHookean;
use nalgebra::Matrix3;

/// Slices of a front that are summed.
const SLICES: usize = 1000;
/// Relative step of derivatives.
const STEP: f64 = 1e-4;

/// The state behind the front.
#[derive(Debug, Clone, Copy)]
pub struct Jump {
    /// Stretch.
    pub stretch: f64,
    /// Stress of that stretch (Pa, tension positive).
    pub stress: f64,
    /// Speed of the front through the undeformed material (m/s).
    pub speed: f64,
    /// Energy that is lost per undeformed volume (J/m³).
    pub lost: f64,
    /// How far the mean stress can be off as the energy that should be lost rings, over the stress.
    pub bound: f64,
    law: NeoHookean,
    density: f64,
}

/// P = σ in uniaxial strain (Pa), and the energy (J/m³).
fn at_rest(law: &NeoHookean, stretch: f64) -> (f64, f64) {
    let (stress, state) = law.at_rest(&Matrix3::from_diagonal(&[stretch, 1.0, 1.0].into()));
    (stress.xx, law.energy(&state))
}

/// P = σ in uniaxial strain (Pa).
fn stress(law: &NeoHookean, stretch: f64) -> f64 {
    at_rest(law, stretch).0
}

impl Jump {
    /// The jump of a bar of this density (kg/m³) that runs into a wall at `speed` (m/s). Mass: V = S (1 − F). Momentum:
    /// −P = ρ₀ S V. So −P (1 − F) = ρ₀ V², whose left side falls as F rises.
    #[must_use]
    pub fn new(law: &NeoHookean, density: f64, speed: f64) -> Self {
        let stretch = root((0.0, 1.0), |f| -stress(law, f) * (1.0 - f) - density * speed * speed);
        let own = stress(law, stretch);
        let lost = 0.5 * density * speed * speed - at_rest(law, stretch).1;
        let d = STEP * stretch;
        let [less, more] = [-d, d].map(|d| stress(law, stretch + d));
        let (slope, curvature) = ((more - less) / (2.0 * d), (more - 2.0 * own + less) / (d * d));
        Self {
            stretch,
            stress: own,
            speed: speed / (1.0 - stretch),
            lost,
            bound: (0.5 * curvature * lost / slope / own).abs(),
            law: *law,
            density,
        }
    }

    /// The distance (m), in the undeformed bar, between the shares `from` and `to` of the jump in a steady front that an
    /// artificial viscosity with the coefficients c₁ and c₂ on cells of size `h` (m) makes: q = ρ₀ S² (1 − F) + P(F) is
    /// what it must bear, which gives the rate ε̇ = −Ḟ/F, and X = S t.
    #[must_use]
    pub fn width(&self, [linear, quadratic]: [f64; 2], h: f64, [from, to]: [f64; 2]) -> f64 {
        let c = self.law.wave_speed(self.density);
        let depth = 1.0 - self.stretch;
        let slice = (to - from) / SLICES as f64;
        let widths = (0..SLICES).map(|k| {
            let stretch = 1.0 - depth * (from + (k as f64 + 0.5) * slice);
            let line = self.density * self.speed * self.speed * (1.0 - stretch);
            let q = stretch * (line + stress(&self.law, stretch)) / (self.density * h);
            // q F/(ρ₀ h) = c₁ c ε̇ + c₂ h ε̇², whose root in this form is good for c₂ = 0 too.
            let rate = 2.0 * q / (linear * c + (linear * linear * c * c + 4.0 * quadratic * h * q).sqrt());
            self.speed * depth * slice / (stretch * rate)
        });
        widths.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mass_momentum_and_energy_balance_and_a_weak_front_is_sound() {
        let law = NeoHookean::new(1e6, 0.3).unwrap();
        let c = law.wave_speed(1000.0);
        for mach in [1e-3, 0.1, 1.0, 2.0] {
            let v = mach * c;
            let jump = Jump::new(&law, 1000.0, v);
            assert!((jump.speed * (1.0 - jump.stretch) / v - 1.0).abs() < 1e-9);
            assert!((-jump.stress / (1000.0 * jump.speed * v) - 1.0).abs() < 1e-6, "{jump:?}");
            // A front heats: nothing is gained.
            assert!(jump.lost > 0.0 && jump.lost < 500.0 * v * v, "{jump:?}");
        }
        // A weak front with ν = c₁ h c is Burgers': ν ln 19/(S − c) wide from a twentieth to nineteen twentieths.
        let weak = Jump::new(&law, 1000.0, 1e-2 * c);
        let burgers = 0.06 * 0.01 * c * 19.0_f64.ln() / (weak.speed - c);
        let width = weak.width([0.06, 0.0], 0.01, [0.05, 0.95]);
        assert!((width / burgers - 1.0).abs() < 0.02, "{width} {burgers}");
        // With a quadratic one alone, ρ₀ h² c₂ Ḟ² = κ (1 − F)(F − F₁): half a period of a sine, κ = ρ₀ (S² − c²)/(1 − F₁).
        let width = weak.width([0.0, 1.5], 0.01, [0.05, 0.95]);
        let kappa = (weak.speed * weak.speed - c * c) / (1.0 - weak.stretch) / (weak.speed * weak.speed);
        let sine = 2.0 * 0.9_f64.asin() * 0.01 * (1.5 / kappa).sqrt();
        assert!((width / sine - 1.0).abs() < 0.02, "{width} {sine}");
        let weak = Jump::new(&law, 1000.0, 1e-3 * c);
        assert!((weak.speed / c - 1.0).abs() < 2e-3 && weak.bound < 1e-6, "{weak:?}");
    }
}
