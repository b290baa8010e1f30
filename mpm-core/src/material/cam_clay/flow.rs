//! The return to the yield surface: backward Euler's rule, for a step of any size.
//!
//! Flow along ε_v : ε_s = (p − ρ) : (A/B)² q leaves, with a multiplier μ ≥ 0 (1/Pa), compression positive,
//!
//! v = v_tr + μ (p − ρ), q = q_tr B²/(B² + 3G μ A²),
//!
//! where p, ρ, A and B are functions of the elastic volume strain v alone, as p_c grows by e^((v − v_tr)/ψ). The
//! dissipation is μ A². For a given μ the first equation has one solution, since p falls and ρ grows with v. Then N =
//! √(((p − ρ)/A)² + (q/B)²) is a function of μ, above 1 at 0 and zero far out: so that N = 1 has a solution, between
//! bounds that close in. 1 − 1/N is nearly linear in μ. Both equations are solved by Newton's method, which halves
//! where it would leave its bounds.

use super::CamClay;
use crate::number::Real;

/// Steps of each iteration: at most this many, should halving alone have to do it.
const MOST_STEPS: u32 = 120;
/// Accuracy of N = 1.
const ACCURACY: f64 = 1e-13;
/// Error of N that rounding allows.
const LOOSE: f64 = 1e-6;
/// Accuracy of a volume strain, relative to it and to what its equation has beside it: rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Result of an elastic step.
#[derive(Clone, Copy)]
pub(super) struct Trial<T> {
    /// Elastic volume strain, extension positive.
    pub(super) volume: T,
    /// q (Pa).
    pub(super) shear: T,
    /// p_c before flow (Pa).
    pub(super) preconsolidation: T,
}

/// Result of flow.
#[derive(Clone, Copy)]
pub(super) struct End<T> {
    /// Elastic volume strain, extension positive.
    pub(super) volume: T,
    /// The share of the deviator that remains.
    pub(super) shear_remains: T,
}

/// The surface at an elastic volume strain, with derivatives by that (Pa).
#[derive(Clone, Copy)]
struct Surface<T> {
    /// p − ρ.
    excess: T,
    excess_slope: T,
    a: T,
    a_slope: T,
    b: T,
    b_slope: T,
}

/// A bracket around a root of a function that grows, and the step to it.
#[derive(Clone, Copy)]
struct Bracket<T> {
    low: T,
    high: T,
}

impl<T: Real> Bracket<T> {
    /// The next place after `x`, at which the function has a value: a Newton step away, or half-way between the ends
    /// but within `reach` of the lower one.
    #[inline]
    fn next(&mut self, x: T, value: T, step: T, reach: T) -> T {
        self.low = value.if_positive(self.low, x);
        self.high = value.if_positive(x, self.high);
        let half = T::splat(0.5) * (self.high - self.low);
        let middle = self.low + (reach - half).if_positive(half, reach);
        let newton = x - step;
        let below = (self.high - newton).if_positive(newton, middle);
        (newton - self.low).if_positive(below, middle)
    }
}

impl CamClay {
    #[inline(always)]
    fn surface<T: Real>(&self, volume: T, trial: &Trial<T>) -> Surface<T> {
        let number = T::splat;
        let [_, mean, bulk] = self.elasticity.volumetric(volume);
        let p = -mean;
        let per_strain = number(1.0 / self.plastic_compressibility);
        let growth = ((volume - trial.volume) * per_strain).exp();
        let rho = number(0.5 * self.gamma) * trial.preconsolidation * growth;
        let rho_slope = rho * per_strain;
        let semi_axis = |p: T, rho: T| number(1.0 - self.gamma) * p + rho;
        let m = number(self.critical_ratio);
        let height = |p: T, rho: T| m * (number(1.0 - self.alpha) * p + number(self.alpha) * rho);
        Surface {
            excess: p - rho,
            excess_slope: -bulk - rho_slope,
            a: semi_axis(p, rho),
            a_slope: semi_axis(-bulk, rho_slope),
            b: height(p, rho),
            b_slope: height(-bulk, rho_slope),
        }
    }

    /// The elastic volume strain v = v_tr + μ (p − ρ), from `start`.
    #[inline(always)]
    fn volume_after<T: Real>(&self, multiplier: T, start: T, trial: &Trial<T>) -> T {
        let number = T::splat;
        let closed = number((1.0 - self.elasticity.porosity).ln());
        let excess = self.surface(trial.volume, trial).excess;
        // Towards p = ρ, where p > 0 and the strain is compression.
        let mut bracket = Bracket {
            low: excess.if_positive(trial.volume, closed),
            high: excess.if_positive(T::default(), trial.volume),
        };
        let mut volume = start;
        for _ in 0..MOST_STEPS {
            let here = self.surface(volume, trial);
            let value = volume - trial.volume - multiplier * here.excess;
            let slope = number(1.0) - multiplier * here.excess_slope;
            let step = value / slope;
            let rounding = number(ROUNDING) * (volume.abs() + trial.volume.abs() / slope);
            if !(step.abs() - rounding).any_positive() {
                return volume.with_slopes_of(-step);
            }
            volume = bracket.next(volume, value, step, number(f64::MAX));
        }
        volume
    }

    /// Where a trial stress beyond the yield surface flows to; nothing if none is.
    #[inline(always)]
    pub(super) fn flow<T: Real>(&self, trial: &Trial<T>) -> Option<End<T>> {
        let number = T::splat;
        let (one, stiffness) = (number(1.0), number(3.0 * self.elasticity.shear_modulus));
        // 1 − 1/N and its derivative by μ, and the share of the deviator that remains.
        let at = |multiplier: T, volume: T| {
            let here = self.surface(volume, trial);
            let rate = here.excess / (one - multiplier * here.excess_slope);
            let [excess_rate, a_rate, b_rate] =
                [here.excess_slope, here.a_slope, here.b_slope].map(|slope| slope * rate);
            let (a, b, x) = (here.a, here.b, here.excess / here.a);
            let divisor = b * b + stiffness * multiplier * a * a;
            let y = trial.shear * b / divisor;
            let x_rate = (excess_rate - x * a_rate) / a;
            let of_a = stiffness * a * (a + number(2.0) * multiplier * a_rate);
            let y_rate = (trial.shear * b_rate - y * (number(2.0) * b * b_rate + of_a)) / divisor;
            let n = (x * x + y * y).sqrt();
            let slope = (x * x_rate + y * y_rate) / (n * n * n);
            (one - one / n, slope, b * b / divisor)
        };
        let (mut multiplier, mut volume) = (T::default(), trial.volume);
        let (mut value, mut slope, _) = at(multiplier, volume);
        if !value.any_positive() {
            return None;
        }
        let yields = value;
        let mut bracket = Bracket { low: T::default(), high: number(f64::MAX) };
        for _ in 0..MOST_STEPS {
            if !(value.abs() - number(ACCURACY)).any_positive() {
                break;
            }
            // The function falls: its negative grows.
            let reach = number(4.0) * multiplier + one / stiffness;
            multiplier = bracket.next(multiplier, -value, value / slope, reach);
            volume = self.volume_after(multiplier, volume, trial);
            (value, slope, _) = at(multiplier, volume);
            value = yields.if_positive(value, T::default());
        }
        multiplier = multiplier.with_slopes_of(-value / slope);
        volume = self.volume_after(multiplier, volume, trial);
        let (_, _, remains) = at(multiplier, volume);
        // Without convergence there is no stress.
        let missed = value.abs() - number(LOOSE);
        volume = missed.if_positive(number(f64::NAN), volume);
        Some(End { volume: yields.if_positive(volume, trial.volume), shear_remains: yields.if_positive(remains, one) })
    }
}
