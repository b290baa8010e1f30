//! The clay by itself: the limit load of undrained clay without weight, and clay in uniaxial strain that water leaves freely.

use crate::root;
use std::f64::consts::PI;

/// Logarithmic strain of a step of Runge and Kutta's rule: its errors are far below those of a run.
const STEP: f64 = 1e-5;
/// More strain than any load makes.
const MOST: f64 = 1.0;

/// Elastic volume and shear strain and plastic volume strain of the classical law, compression positive.
type State = [f64; 3];

/// Constants of Cam clay, and the isotropic pressure under which it begins.
#[derive(Debug, Clone, Copy)]
pub struct Clay {
    /// Share of pores.
    pub porosity: f64,
    /// Bulk and shear modulus at rest (Pa).
    pub moduli: [f64; 2],
    /// q/p at the critical state, M.
    pub critical_ratio: f64,
    /// Plastic compressibility ψ.
    pub plastic_compressibility: f64,
    /// Pressure p_c0 at which it yields first (Pa).
    pub preconsolidation: f64,
    /// Pressure p₀ at the start (Pa).
    pub initial_pressure: f64,
    /// Shape γ of the surface.
    pub gamma: f64,
}

impl Clay {
    /// Effective pressure (Pa) at an elastic volume strain `v`, compression positive, of the improved Hencky law.
    fn effective_pressure(&self, v: f64) -> f64 {
        let n = 1.0 - (1.0 - self.porosity) * v.exp();
        self.moduli[0] * self.porosity * (v / n + v * v * (1.0 - n) / (2.0 * n * n))
    }

    /// Volume strain at which no pores are left.
    fn closed(&self) -> f64 {
        -(1.0 - self.porosity).ln()
    }

    /// The volume strain at an effective pressure (Pa).
    fn volume_strain(&self, p: f64) -> f64 {
        root((0.0, self.closed()), |v| p - self.effective_pressure(v))
    }

    /// Undrained shear strength (Pa) of the clay in plane strain: M p/√3 at the critical state. There flow alone shears, so
    /// that the stress across the plane is the mean one and q = √3 s_u. With a constant volume the elastic strain v and the
    /// plastic one add up to nothing, hence p_c = p_c0 e^((v(p₀) − v(p))/ψ), compression positive, where p_c = 2p/γ.
    fn strength(&self) -> f64 {
        let start = self.volume_strain(self.initial_pressure);
        let lacks = |v: f64| {
            let hardened = ((start - v) / self.plastic_compressibility).exp() * self.preconsolidation;
            hardened - 2.0 * self.effective_pressure(v) / self.gamma
        };
        self.critical_ratio * self.effective_pressure(root((0.0, self.closed()), lacks)) / 3.0_f64.sqrt()
    }

    /// Prandtl's limit load of a strip on it (Pa), (2 + π) s_u beside the load on the whole surface.
    #[must_use]
    pub fn prandtl(&self) -> f64 {
        (2.0 + PI) * self.strength()
    }

    /// p, q and p_c (Pa), Kirchhoff's.
    fn clay_stress(&self, [v, s, flowed]: State) -> [f64; 3] {
        let p = self.effective_pressure(v);
        let hardened = self.preconsolidation * (flowed / self.plastic_compressibility).exp();
        [p, 3.0 * self.moduli[1] * s, hardened]
    }

    /// Rates by the volume strain, of which ⅔ is shear strain where only one axis shortens.
    fn clay_rates(&self, state: State) -> State {
        let [p, q, hardened] = self.clay_stress(state);
        let square = self.critical_ratio * self.critical_ratio;
        let surface = q * q - square * p * (hardened - p);
        let (by_p, by_q) = (square * (2.0 * p - hardened), 2.0 * q);
        let tiny = 1e-7;
        let [above, below] = [tiny, -tiny].map(|d| self.effective_pressure(state[0] + d));
        let bulk = (above - below) / (2.0 * tiny);
        let stiffness = by_p * bulk + by_q * 3.0 * self.moduli[1] * 2.0 / 3.0;
        if surface < 0.0 || stiffness <= 0.0 {
            return [1.0, 2.0 / 3.0, 0.0];
        }
        // Along the normal, and so that the surface is not left.
        let hardening = square * p * hardened / self.plastic_compressibility * by_p;
        let flow = stiffness / (by_p * bulk * by_p + by_q * 3.0 * self.moduli[1] * by_q + hardening);
        [1.0 - flow * by_p, 2.0 / 3.0 - flow * by_q, flow * by_p]
    }

    /// Settlement over the height of clay under a dead load (Pa) on its whole surface: the rates of Cam clay in uniaxial
    /// strain, integrated by themselves.
    #[must_use]
    pub fn uniform_settlement(&self, load: f64) -> f64 {
        let load = load + self.initial_pressure;
        let mut state = [self.volume_strain(self.initial_pressure), 0.0, 0.0];
        let mut strain = 0.0;
        // Per undeformed area, as a uniaxial stretch changes none.
        let bears = |state: State, strain: f64| {
            let [p, q, _] = self.clay_stress(state);
            (p + 2.0 / 3.0 * q) * f64::exp(strain)
        };
        let mut before = bears(state, strain);
        while strain < MOST {
            let at = |k: State, share: f64| std::array::from_fn(|i| state[i] + share * STEP * k[i]);
            let first = self.clay_rates(state);
            let second = self.clay_rates(at(first, 0.5));
            let third = self.clay_rates(at(second, 0.5));
            let last = self.clay_rates(at(third, 1.0));
            state =
                std::array::from_fn(|i| state[i] + STEP / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + last[i]));
            strain += STEP;
            let now = bears(state, strain);
            if now >= load {
                let share = (load - before) / (now - before);
                return 1.0 - (-(strain - STEP * (1.0 - share))).exp();
            }
            before = now;
        }
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_core::Law;
    use mpm_core::material::{CamClay, ImprovedHencky};
    use nalgebra::Matrix3;

    /// The law itself, sheared at a constant volume until nothing changes.
    #[test]
    fn strength_is_what_the_law_comes_to() {
        for (initial_pressure, preconsolidation, bulk) in [(1e4, 6e4, 1e7), (4e4, 6e4, 1e6), (4e4, 1e5, 1e7)] {
            let clay = Clay {
                porosity: 0.4,
                moduli: [bulk, 0.4 * bulk],
                critical_ratio: 1.1,
                plastic_compressibility: 0.05,
                preconsolidation,
                initial_pressure,
                gamma: 1.0,
            };
            let elasticity = ImprovedHencky::new(bulk * 0.4, 0.4 * bulk, 0.4).unwrap();
            let law = CamClay::new(elasticity, 1.1, 0.05, preconsolidation, initial_pressure).unwrap();
            let mut state = law.initial_state();
            let mut shear = 0.0;
            let stretch = |k: f64| Matrix3::from_diagonal(&[k.exp(), (-k).exp(), 1.0].into());
            for _ in 0..4000 {
                let (stress, after) = law.response(&stretch(5e-4), 1.0, &state);
                (state, shear) = (after, 0.5 * (stress.xx - stress.yy));
            }
            let exact = clay.strength();
            assert!((shear / exact - 1.0).abs() < 1e-3, "{shear} {exact}");
        }
    }
}
