//! Consolidation of a slab between rigid plates (Mandel 1953), exactly, in the steps of backward Euler's rule, and by the
//! difference equations of a space of the pressure; derived in `docs/mandel.md`.
//!
//! A slab of width 2a, in plane strain, of oedometric modulus M, shear modulus G and conductivity κ, lies between two
//! rigid plates without friction that a force 2F presses together from time zero; water leaves at its sides. With P = 2a
//! p/F, x over a, T = c t/a², c = κ M, θ = 1 − 2ν, and the mean P̄,
//!
//! P_T + θ P̄_T = P_xx, P = 1 at the start, P_x = 0 in the middle, P = 0 at the side,
//!
//! P = Σ A_k (cos α_k x − cos α_k) exp(−α_k² T), tan α = (1 + 1/θ) α, A = 2 sin α/(α − sin α cos α).

mod steps;

use std::f64::consts::PI;
pub use steps::of_particles;

/// Size below which terms of a series are left out.
const NOTHING: f64 = 1e-17;
/// Terms at most of steps that damp hardly: beyond them are 10⁻⁸ after one step of T = 0.01, 10⁻¹⁵ after two of 0.005.
const MOST: usize = 20_000;

/// cos αx − cos α: how much of it there is at the start, and how fast it fades.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mode {
    root: f64,
    size: f64,
    /// Its exponent over −T.
    rate: f64,
    /// Its mean over the slab.
    mean: f64,
}

/// State of a slab at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slab {
    /// Pressure in the middle over F/(2a), the undrained one.
    pub centre: f64,
    /// How far a plate has come, over F b/(G a) of a slab of height 2b.
    pub settlement: f64,
    /// How far a side has moved out, over F/G.
    pub bulge: f64,
}

/// Cells from the middle to the side, two particles each along it, and what the pressure has on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cells {
    /// Those of the displacement.
    of_solid: usize,
    /// Those of the pressure.
    of_water: usize,
    /// Strength τ of the projection times the modulus.
    projection: f64,
}

impl Cells {
    /// Pressures on cells twice as large as the `n` of the displacement, two at least.
    #[must_use]
    pub fn two_grid(n: usize) -> Self {
        let n = n.max(2);
        Self { of_solid: n, of_water: n / 2, projection: 0.0 }
    }

    /// Pressures on the same `n` cells, one at least, with a projection of strength τ times the modulus; zero without.
    #[must_use]
    pub fn same(n: usize, projection: f64) -> Self {
        let n = n.max(1);
        Self { of_solid: n, of_water: n, projection }
    }

    /// A cell's entry of the matrix of storage beside the diagonal, over its size and the modulus; with that on it ½.
    fn beside(self) -> f64 {
        if self.of_water < self.of_solid { 0.1875 } else { 0.25 - self.projection / 16.0 }
    }
}

/// The root of tan α = f(α), f positive and rising, between kπ and kπ + ½π: α = kπ + atan f(α), from the upper end down.
fn root(k: usize, f: impl Fn(f64) -> f64) -> f64 {
    let base = PI * k as f64;
    let mut root = base + 0.5 * PI;
    // atan f rises by less than 0.6 of what α does, for any ratio.
    for _ in 0..100 {
        root = base + f(root).atan();
    }
    root
}

/// A slab that consolidates, as the sum of what fades at different rates.
pub struct Mandel {
    /// 1 − 2ν.
    theta: f64,
    modes: Vec<Mode>,
}

impl Mandel {
    fn exact(ratio: f64, lasts: impl Fn(f64) -> f64) -> Self {
        let theta = 1.0 - 2.0 * ratio;
        let of = |k: usize| {
            let root = root(k, |a| (1.0 + 1.0 / theta) * a);
            let (sin, cos) = root.sin_cos();
            Mode { root, size: 2.0 * sin / (root - sin * cos), rate: root * root, mean: sin / root - cos }
        };
        let counts = |mode: &Mode| lasts(mode.rate) > NOTHING;
        Self { theta, modes: (0..MOST).map(of).take_while(counts).collect() }
    }

    /// With Poisson's ratio `ratio`, from −1 to below ½, exactly from the time `earliest` (T) on.
    #[must_use]
    pub fn new(ratio: f64, earliest: f64) -> Self {
        Self::exact(ratio, |rate| (-rate * earliest).exp())
    }

    /// As [`Mandel::new`], after `fewest` steps of duration `step` (T) of backward Euler's rule.
    #[must_use]
    pub fn of_steps(ratio: f64, step: f64, fewest: i32) -> Self {
        Self::exact(ratio, |rate| (1.0 + rate * step).powi(-fewest))
    }

    /// By the difference equations of some cells.
    #[must_use]
    pub fn of_cells(ratio: f64, cells: Cells) -> Self {
        let theta = 1.0 - 2.0 * ratio;
        let n = cells.of_water;
        let size = 1.0 / n as f64;
        // Hats sum up as the rule of trapezoids does.
        let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
            let inner: f64 = (1..n).map(|b| of(b as f64 * size)).sum();
            size * (inner + 0.5 * (of(0.0) + of(1.0)))
        };
        let of = |k: usize| {
            let half = 0.5 * size;
            let root = root(k, |a| (1.0 + 1.0 / theta) * (half * a).tan() / half);
            let cos = root.cos();
            let waves = sum(&|x| (root * x).cos());
            let squares = sum(&|x| (root * x).cos().powi(2));
            let mean = waves - cos;
            let sin = (half * root).sin();
            let storage = 1.0 - 4.0 * cells.beside() * sin * sin;
            Mode {
                root,
                size: (1.0 + theta) * mean / (storage * (squares - cos * waves)),
                rate: (sin / half).powi(2) / storage,
                mean,
            }
        };
        Self { theta, modes: (0..n).map(of).collect() }
    }

    fn slab(&self, left: impl Fn(&Mode) -> f64) -> Slab {
        let sum = |of: &dyn Fn(&Mode) -> f64| -> f64 {
            let parts = self.modes.iter().map(|m| m.size * left(m) * of(m));
            parts.sum()
        };
        let theta = self.theta;
        let mean = sum(&|m| m.mean);
        let settlement = 0.25 * (1.0 + theta * (1.0 - mean));
        Slab {
            centre: sum(&|m| 1.0 - m.root.cos()),
            settlement,
            bulge: (0.5 * theta * mean + (1.0 - theta) * settlement) / (1.0 + theta),
        }
    }

    /// The slab at the time `t` (T).
    #[must_use]
    pub fn at(&self, t: f64) -> Slab {
        self.slab(|m| (-m.rate * t).exp())
    }

    /// The slab after `steps` steps of duration `step` (T) of backward Euler's rule: each multiplies a mode that decays
    /// at the rate s by 1/(1 + s ΔT).
    #[must_use]
    pub fn after(&self, steps: i32, step: f64) -> Slab {
        self.slab(|m| (1.0 + m.rate * step).powi(-steps))
    }

    /// Pressure over F/(2a) at `x` over a from the middle, at the time `t` (T).
    #[must_use]
    pub fn pressure(&self, x: f64, t: f64) -> f64 {
        let part = |m: &Mode| {
            let wave = (m.root * x).cos() - m.root.cos();
            m.size * wave * (-m.rate * t).exp()
        };
        self.modes.iter().map(part).sum()
    }

    /// When the pressure in the middle is largest (T), and what it is then.
    #[must_use]
    pub fn peak(&self) -> (f64, f64) {
        let (mut lo, mut hi) = (EARLIEST, 1.0);
        let at = |t: f64| self.at(t).centre;
        // It rises until then, and falls after.
        for _ in 0..100 {
            let third = (hi - lo) / 3.0;
            if at(lo + third) < at(hi - third) {
                lo += third;
            } else {
                hi -= third;
            }
        }
        let t = 0.5 * (lo + hi);
        (t, at(t))
    }
}

/// No peak is earlier (T).
const EARLIEST: f64 = 1e-3;

#[cfg(test)]
mod tests;
