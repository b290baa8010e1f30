//! The clay by itself: the limit load of undrained clay without weight, and clay in uniaxial strain that water leaves freely.

use super::*;

/// Logarithmic strain of a step of Runge and Kutta's rule: its errors are far below those of a run.
const STEP: f64 = 1e-5;
/// More strain than any load makes.
const MOST: f64 = 1.0;

/// Elastic volume and shear strain and plastic volume strain of the classical law, compression positive.
type State = [f64; 3];

impl Setup<Strip> {
    /// Effective pressure (Pa) at an elastic volume strain `v`, compression positive, of the improved Hencky law.
    fn effective_pressure(&self, v: f64) -> f64 {
        let n = 1.0 - (1.0 - self.porosity) * v.exp();
        self.bulk() * self.porosity * (v / n + v * v * (1.0 - n) / (2.0 * n * n))
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
            hardened - 2.0 * self.effective_pressure(v) / self.shape_gamma
        };
        self.critical_ratio * self.effective_pressure(root((0.0, self.closed()), lacks)) / 3.0_f64.sqrt()
    }

    /// Prandtl's limit load of a strip on it (Pa), (2 + π) s_u beside the load on the whole surface.
    pub(super) fn prandtl(&self) -> f64 {
        (2.0 + PI) * self.strength()
    }

    /// p, q and p_c (Pa), Kirchhoff's.
    fn clay_stress(&self, [v, s, flowed]: State) -> [f64; 3] {
        let p = self.effective_pressure(v);
        let hardened = self.preconsolidation * (flowed / self.plastic_compressibility).exp();
        [p, 3.0 * self.shear_modulus() * s, hardened]
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
        let stiffness = by_p * bulk + by_q * 3.0 * self.shear_modulus() * 2.0 / 3.0;
        if surface < 0.0 || stiffness <= 0.0 {
            return [1.0, 2.0 / 3.0, 0.0];
        }
        // Along the normal, and so that the surface is not left.
        let hardening = square * p * hardened / self.plastic_compressibility * by_p;
        let flow = stiffness / (by_p * bulk * by_p + by_q * 3.0 * self.shear_modulus() * by_q + hardening);
        [1.0 - flow * by_p, 2.0 / 3.0 - flow * by_q, flow * by_p]
    }

    /// Settlement over the height of clay under the whole load, a dead one, on its whole surface: the rates of Cam clay in uniaxial
    /// strain, integrated by themselves.
    pub(super) fn uniform_settlement(&self) -> f64 {
        let load = self.load + self.initial_pressure;
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
    use crate::parameter::Parameters;
    use mpm_core::Law;
    use nalgebra::Matrix3;

    /// The law itself, sheared at a constant volume until nothing changes.
    #[test]
    fn strength_is_what_the_law_comes_to() {
        let mut spec = case().runs(Quick).remove(0);
        for set in ["initial_pressure=1e4", "", "preconsolidation=1e5 young_modulus=1e7"] {
            spec.set = set.split_whitespace().map(str::to_owned).collect();
            let parameters = Parameters::new(&Strip::list(), &spec.set).unwrap();
            let strip = Setup::<Strip>::of_spec(&spec, &parameters).unwrap();
            let law = strip.clay().unwrap();
            let mut state = law.initial_state();
            let mut shear = 0.0;
            let stretch = |k: f64| Matrix3::from_diagonal(&[k.exp(), (-k).exp(), 1.0].into());
            for _ in 0..4000 {
                let (stress, after) = law.response(&stretch(5e-4), 1.0, &state);
                (state, shear) = (after, 0.5 * (stress.xx - stress.yy));
            }
            let exact = strip.strength();
            assert!((shear / exact - 1.0).abs() < 1e-3, "{shear} {exact}");
        }
    }
}
