//! Clay under a load on its whole surface that water leaves freely: the rates of Cam clay in uniaxial strain, integrated by
//! themselves.

use super::limit::pressure;
use super::parameters::{
    COMPRESSIBILITY, CRITICAL_RATIO, INITIAL_PRESSURE, LOAD, POROSITY, PRECONSOLIDATION,
};
use super::scene::moduli;
use crate::parameter::Parameters;

/// Logarithmic strain of a step of Runge and Kutta's rule: its errors are far below those of a run.
const STEP: f64 = 1e-5;
/// More strain than any load makes.
const MOST: f64 = 1.0;

/// What a particle of the classical law remembers, compression positive: elastic volume and shear strain, plastic volume
/// strain.
type State = [f64; 3];

struct Clay {
    bulk: f64,
    shear: f64,
    porosity: f64,
    ratio: f64,
    preconsolidation: f64,
    compressibility: f64,
}

impl Clay {
    fn new(parameters: &Parameters) -> Self {
        let number = |p| parameters.number(p);
        let [bulk, shear] = moduli(parameters);
        Self {
            bulk,
            shear,
            porosity: number(POROSITY),
            ratio: number(CRITICAL_RATIO),
            preconsolidation: number(PRECONSOLIDATION),
            compressibility: number(COMPRESSIBILITY),
        }
    }

    /// p, q and p_c (Pa), Kirchhoff's.
    fn stress(&self, [v, s, flowed]: State) -> [f64; 3] {
        let p = pressure(self.bulk, self.porosity, v);
        let hardened = self.preconsolidation * (flowed / self.compressibility).exp();
        [p, 3.0 * self.shear * s, hardened]
    }

    /// By the volume strain, of which ⅔ is shear strain where only one axis shortens.
    fn rates(&self, state: State) -> State {
        let [p, q, hardened] = self.stress(state);
        let square = self.ratio * self.ratio;
        let surface = q * q - square * p * (hardened - p);
        let (by_p, by_q) = (square * (2.0 * p - hardened), 2.0 * q);
        let tiny = 1e-7;
        let [above, below] =
            [tiny, -tiny].map(|d| pressure(self.bulk, self.porosity, state[0] + d));
        let bulk = (above - below) / (2.0 * tiny);
        let stiffness = by_p * bulk + by_q * 3.0 * self.shear * 2.0 / 3.0;
        if surface < 0.0 || stiffness <= 0.0 {
            return [1.0, 2.0 / 3.0, 0.0];
        }
        // Along the normal, and so that the surface is not left.
        let hardening = square * p * hardened / self.compressibility * by_p;
        let flow = stiffness / (by_p * bulk * by_p + by_q * 3.0 * self.shear * by_q + hardening);
        [1.0 - flow * by_p, 2.0 / 3.0 - flow * by_q, flow * by_p]
    }
}

/// Settlement over the height under the whole load, which is a dead one.
pub(super) fn settlement(parameters: &Parameters) -> f64 {
    let clay = Clay::new(parameters);
    let start = parameters.number(INITIAL_PRESSURE);
    let load = parameters.number(LOAD) + start;
    let begin = super::limit::volume(clay.bulk, clay.porosity, start);
    let mut state = [begin, 0.0, 0.0];
    let mut strain = 0.0;
    // Per undeformed area, as a uniaxial stretch changes none.
    let bears = |state: State, strain: f64| {
        let [p, q, _] = clay.stress(state);
        (p + 2.0 / 3.0 * q) * f64::exp(strain)
    };
    let mut before = bears(state, strain);
    while strain < MOST {
        let at = |k: State, share: f64| std::array::from_fn(|i| state[i] + share * STEP * k[i]);
        let first = clay.rates(state);
        let second = clay.rates(at(first, 0.5));
        let third = clay.rates(at(second, 0.5));
        let last = clay.rates(at(third, 1.0));
        state = std::array::from_fn(|i| {
            state[i] + STEP / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + last[i])
        });
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
