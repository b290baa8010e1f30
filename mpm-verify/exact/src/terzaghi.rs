//! Consolidation of a column at small strain (Terzaghi 1943), and what two discretisations of its first step do; derived
//! here and in `docs/poromechanics.md`.
//!
//! A column of height H, of oedometric modulus M and conductivity κ, stands on an impermeable base, full of water that may
//! leave at the top, and is loaded there by q at time zero. M ε = p − q in every cross-section, and ∂ε/∂t = κ ∂²p/∂z², so
//! that with the depth z below the top ∂p/∂t = c_v ∂²p/∂z², c_v = κ M, p = q at the start, p = 0 at the top, ∂p/∂z = 0 at
//! the base. Separated, with m_k = (k + ½) π, Z = z/H and T = c_v t/H²,
//!
//! p/q = Σ_k 2/m_k sin(m_k Z) exp(−m_k² T), and the settlement over q H/M is U = 1 − Σ_k 2/m_k² exp(−m_k² T).

use std::f64::consts::PI;

/// Size relative to the first term below which terms of the series are left out.
const NOTHING: f64 = 1e-17;
/// Below this T the series takes more terms than waves that are reflected at the ends.
const SHORT: f64 = 0.02;

/// Terms of the series: m_k with exp(−m_k² T).
fn terms(t: f64) -> impl Iterator<Item = (f64, f64)> {
    let of = move |k: u32| {
        let m = (f64::from(k) + 0.5) * PI;
        (m, (-m * m * t).exp())
    };
    (0..).map(of).take_while(|(_, decay)| *decay > NOTHING)
}

/// The complementary error function, by its series near zero and its continued fraction far from it.
fn erfc(x: f64) -> f64 {
    if x > 1.5 {
        let fraction = (1..60).rev().fold(x, |rest, k| x + 0.5 * f64::from(k) / rest);
        return (-x * x).exp() / (fraction * PI.sqrt());
    }
    let (mut term, mut sum) = (x, x);
    for k in 1..60 {
        term *= -x * x / f64::from(k);
        sum += term / f64::from(2 * k + 1);
    }
    1.0 - 2.0 / PI.sqrt() * sum
}

/// p/q at the depth `z` over H below the drained top, at the time `t` over H²/c_v.
#[must_use]
pub fn pressure(z: f64, t: f64) -> f64 {
    if t <= 0.0 {
        return if z > 0.0 { 1.0 } else { 0.0 };
    }
    if t < SHORT {
        // Images of the top at every 2H, of changing sign: 1 − Σ (−1)^k [erfc((2k + z)/2√t) + erfc((2k + 2 − z)/2√t)].
        let wave = |distance: f64| erfc(0.5 * distance / t.sqrt());
        let pairs = [0.0, 1.0, 2.0].map(|k| wave(2.0 * k + z) + wave(2.0 * k + 2.0 - z));
        return 1.0 - pairs[0] + pairs[1] - pairs[2];
    }
    let of = |(m, decay): (f64, f64)| 2.0 / m * (m * z).sin() * decay;
    terms(t).map(of).sum()
}

/// Terms at most of a solution whose steps damp hardly.
const MOST: u32 = 200_000;

/// p/q at the depth `z` (over H) after backward Euler steps of these durations (over H²/c_v), exactly in space: a step
/// multiplies what varies by sin(m z) by 1/(1 + m² ΔT).
#[must_use]
pub fn pressure_of_steps(z: f64, durations: &[f64]) -> f64 {
    let of = |k: u32| {
        let m = (f64::from(k) + 0.5) * PI;
        let damped = |left: f64, dt: &f64| left / (1.0 + m * m * dt);
        (m, durations.iter().fold(2.0 / m, damped))
    };
    let terms = (0..MOST).map(of).take_while(|(_, size)| *size > NOTHING);
    terms.map(|(m, size)| size * (m * z).sin()).sum()
}

/// The settlement over q H/M at the time `t` over H²/c_v.
#[must_use]
pub fn settlement(t: f64) -> f64 {
    if t < SHORT {
        // ∫ (1 − p/q) dz: of the first image, and of those after it what is less than rounding at this T.
        return 2.0 * (t / PI).sqrt();
    }
    1.0 - terms(t).map(|(m, decay)| 2.0 / (m * m) * decay).sum::<f64>()
}

/// The entries of a cell of the pressure, beside the diagonal and on it (over h/M), in the equations of one step of
/// backward Euler from the undrained state, with r = c_v Δt/h²: two particles a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstStep {
    /// Beside the diagonal: no overshoot where it is not positive.
    pub beside: f64,
    /// On it.
    pub diagonal: f64,
}

impl FirstStep {
    /// Pressures on cells twice as large.
    #[must_use]
    pub fn two_grid(r: f64) -> Self {
        Self { beside: 0.375 - 0.5 * r, diagonal: 0.625 + 0.5 * r }
    }

    /// Pressures on the same cells, with a projection of strength τ times the modulus; zero without.
    #[must_use]
    pub fn same_cells(r: f64, projection: f64) -> Self {
        let r = r + projection / 16.0;
        Self { beside: 0.25 - r, diagonal: 0.25 + r }
    }

    /// Largest p/q − 1 at the nodes of a column of `cells` pressure cells; zero where p is monotone.
    #[must_use]
    pub fn overshoot(self, cells: u32) -> f64 {
        let Self { beside: a, diagonal: b } = self;
        if a <= 0.0 {
            return 0.0;
        }
        let ratio = a / (b + (b * b - a * a).sqrt());
        let last = ratio.powi(2 * cells as i32 - 1);
        // d₁/q with the mirror image of the column below its base; both roots are negative.
        (ratio + last) / (1.0 + last * ratio)
    }
}

/// The settlement over q H/M after steps of the `shares` c_v Δt/h², by the equations of every step: `of` a share gives
/// their entries in one of the column's `cells` pressure cells. The pressure's deficit against the load is d: zero at
/// first, the load at the top from then on; M (d − d of the step before) + K d = 0, and a column settles by the mean of
/// d.
#[must_use]
pub fn settlement_of_equations(of: impl Fn(f64) -> FirstStep, cells: usize, shares: &[f64]) -> f64 {
    let stored = of(0.0);
    // A node has two cells, the one at the base only one.
    let own = |entries: FirstStep, j: usize| entries.diagonal * if j < cells { 2.0 } else { 1.0 };
    let mut d = vec![0.0; cells + 1];
    for share in shares {
        let now = of(*share);
        let mut right: Vec<f64> = (0..=cells)
            .map(|j| {
                let above = j.checked_sub(1).map_or(0.0, |above| d[above]);
                let below = d.get(j + 1).copied().unwrap_or(0.0);
                own(stored, j) * d[j] + stored.beside * (above + below)
            })
            .collect();
        // The top is known; the others are eliminated downwards.
        (d[0], right[0]) = (1.0, 1.0);
        let mut pivot = vec![1.0; cells + 1];
        for j in 1..=cells {
            let factor = now.beside / pivot[j - 1];
            let upper = if j == 1 { 0.0 } else { now.beside };
            pivot[j] = own(now, j) - factor * upper;
            right[j] -= factor * right[j - 1];
        }
        for j in (1..=cells).rev() {
            let below = d.get(j + 1).copied().unwrap_or(0.0);
            let known = if j == cells { 0.0 } else { now.beside * below };
            d[j] = (right[j] - known) / pivot[j];
        }
    }
    let ends = 0.5 * (d[0] + d[cells]);
    (d.iter().sum::<f64>() - ends) / cells as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One step of a long column: d falls by the factor ρ of the closed form from node to node, and what has left of a
    /// cell's h q/M is (a + b) (1 + ρ)/(1 − ρ) = √(b² − a²): of equal cells √ΔT H, as without cells.
    #[test]
    fn the_first_step_settles_as_its_closed_form() {
        let spaces: [fn(f64) -> FirstStep; 3] =
            [FirstStep::two_grid, |r| FirstStep::same_cells(r, 0.0), |r| FirstStep::same_cells(r, 1.5)];
        for of in spaces {
            for share in [0.01, 0.25, 2.0_f64] {
                let FirstStep { beside: a, diagonal: b } = of(share);
                let cells = 400;
                let settled = settlement_of_equations(of, cells, &[share]);
                let settled = settled * cells as f64 * 2.0 * (a + b);
                let exact = (b * b - a * a).sqrt();
                assert!((settled - exact).abs() < 1e-12, "{share}: {settled} {exact}");
            }
        }
        let equal = |r| FirstStep::same_cells(r, 0.0);
        let settled = settlement_of_equations(equal, 400, &[0.25]);
        assert!((400.0 * settled - 0.5).abs() < 1e-12);
    }

    /// Against the exact solution in space of the same steps, on cells of h and h/2: a quarter of the error; on cells of
    /// the pressure twice as large it is h²/8/√(πT) to leading order.
    #[test]
    fn the_equations_settle_to_the_second_order_as_the_column_does() {
        let (t, count) = (0.1, 2000);
        let durations = vec![t / f64::from(count); count as usize];
        let damped = |m: f64| durations.iter().fold(1.0, |left, dt| left / (1.0 + m * m * dt));
        let modes = (0..400).map(|k| (f64::from(k) + 0.5) * PI);
        let exact = 1.0 - modes.map(|m| 2.0 / (m * m) * damped(m)).sum::<f64>();
        // The modes left out have decayed to nothing.
        let error = |of: fn(f64) -> FirstStep, n: f64, cells: usize| {
            let shares: Vec<f64> = durations.iter().map(|dt| dt * n * n).collect();
            settlement_of_equations(of, cells, &shares) - exact
        };
        let coarse = error(FirstStep::two_grid, 20.0, 10);
        let fine = error(FirstStep::two_grid, 40.0, 20);
        assert!((coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
        let leading = 1.0 / (8.0 * 400.0 * (PI * t).sqrt());
        assert!((coarse / leading - 1.0).abs() < 0.05, "{coarse} {leading}");
        let equal = error(|r| FirstStep::same_cells(r, 0.0), 20.0, 20);
        assert!(equal.abs() < 0.02 * coarse, "{equal}");
        let whole = settlement(t);
        assert!((exact - whole).abs() < 1e-3, "{exact} {whole}");
    }

    /// Values of the series with fifty digits.
    const KNOWN: [(f64, f64, f64); 14] = [
        (0.05, 0.0001, 0.999_593_047_982_555),
        (0.05, 0.001, 0.736_447_522_717_027),
        (0.1, 0.001, 0.974_652_681_322_532),
        (0.05, 0.01, 0.276_326_390_168_237),
        (0.25, 0.02, 0.788_700_452_666_289),
        (1.0, 0.02, 0.999_998_853_393_712),
        (0.4, 0.05, 0.794_096_369_228_566),
        (1.0, 0.05, 0.996_869_195_483_995),
        (0.5, 0.1, 0.735_651_315_244_19),
        (1.0, 0.1, 0.949_305_362_684_47),
        (0.1, 0.2, 0.123_868_732_974_409),
        (1.0, 0.2, 0.772_311_606_858_591),
        (0.75, 0.3, 0.560_907_308_458_108),
        (1.0, 0.5, 0.370_777_429_799_524),
    ];

    #[test]
    fn the_series_has_its_known_values() {
        for (z, t, exact) in KNOWN {
            let own = pressure(z, t);
            assert!((own - exact).abs() < 1e-14, "{z} {t}: {own} {exact}");
        }
    }

    /// Both forms agree where they meet, and the equation and the ends hold.
    #[test]
    fn images_and_series_are_one_solution() {
        for z in [0.1, 0.5, 1.0] {
            let series: f64 = terms(SHORT).map(|(m, decay)| 2.0 / m * (m * z).sin() * decay).sum();
            assert!((pressure(z, SHORT - 1e-14) - series).abs() < 1e-12);
            for t in [0.01, 0.3] {
                let d = 1e-3;
                let rate = (pressure(z, t + d * d) - pressure(z, t - d * d)) / (2.0 * d * d);
                let here = pressure(z, t);
                let bend = (pressure(z + d, t) - 2.0 * here + pressure(z - d, t)) / (d * d);
                // The fourth derivative is of the order of the rate over t, and d²/12 of it is lost.
                let lost = d * d / t * (1.0 + rate.abs());
                assert!((rate - bend).abs() < lost, "{z} {t}: {rate} {bend}");
                assert!(pressure(0.0, t).abs() < 1e-14);
                assert!((pressure(1.0 + d, t) - pressure(1.0 - d, t)).abs() < 1e-14);
            }
        }
    }

    /// One step of backward Euler: p − ΔT p″ = 1, which hyperbolic functions solve; and small steps tend to the series.
    #[test]
    fn steps_are_those_of_backward_euler() {
        for (z, dt) in [(0.1, 0.01), (0.5, 0.01), (1.0, 0.3)] {
            let k = 1.0 / f64::sqrt(dt);
            let exact = 1.0 - (k * (1.0 - z)).cosh() / k.cosh();
            let own = pressure_of_steps(z, &[dt]);
            assert!((own - exact).abs() < 1e-10, "{own} {exact}");
        }
        let error = |n: usize| pressure_of_steps(0.5, &vec![0.1 / n as f64; n]) - pressure(0.5, 0.1);
        assert!((error(400) / error(800) - 2.0).abs() < 0.01);
    }

    /// The settlement is what has left: ∫ (1 − p/q) dz.
    #[test]
    fn the_column_settles_by_what_leaves() {
        for t in [0.01, 0.04, 0.1, 0.5] {
            let n = 2000;
            let cell = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
            let left: f64 = (0..n).map(|k| 1.0 - pressure(cell(k), t)).sum();
            assert!((settlement(t) - left / f64::from(n)).abs() < 1e-6, "{t}");
        }
    }

    /// The closed form of the overshoot solves the equations of the step: eliminated here row by row.
    #[test]
    fn the_overshoot_is_that_of_the_equations() {
        let spaces: [fn(f64) -> FirstStep; 3] =
            [FirstStep::two_grid, |r| FirstStep::same_cells(r, 0.0), |r| FirstStep::same_cells(r, 1.5)];
        for (space, bound) in spaces.into_iter().zip([0.75, 0.25, 0.25 - 1.5 / 16.0]) {
            for r in [0.001, 0.05, 0.1, 1.0 / 6.0, 0.35, 0.667, 0.75, 1.0] {
                for cells in [5_u32, 10, 40] {
                    let FirstStep { beside, diagonal } = space(r);
                    // d at the base is b₁ d_N + a d_(N−1) = 0; upwards d_(j−1) = −(2b d_j + a d_(j+1))/a.
                    let exact = if beside.abs() < 1e-12 {
                        0.0
                    } else {
                        let (mut below, mut here) = (1.0, -diagonal / beside);
                        for _ in 2..cells {
                            (below, here) = (here, -(2.0 * diagonal * here + beside * below) / beside);
                        }
                        let top = -(2.0 * diagonal * here + beside * below) / beside;
                        (-here / top).max(0.0)
                    };
                    let own = space(r).overshoot(cells);
                    assert!((own - exact).abs() < 1e-9, "{r} {cells}: {own} {exact}");
                    assert_eq!(own > 1e-12, r < bound - 1e-9);
                }
            }
        }
    }
}
