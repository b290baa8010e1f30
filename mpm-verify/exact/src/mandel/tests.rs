//! The series against its equations, independent solutions of them, and limits.

use super::*;
use crate::terzaghi;

const RATIOS: [f64; 6] = [-0.5, 0.0, 0.25, 0.4, 0.49, 0.499];

/// Values for ν = 0.25 with twelve digits, of a prototype's series in arithmetic of thirty digits, which was checked
/// against finite volumes with a matrix exponential: T, P(0), P(½), P(¾), bulge, −settlement.
const KNOWN: [[f64; 6]; 11] = [
    [0.001, 1.01200615915, 1.01200615915, 1.0120061364, 0.246998460213, -0.253001539787],
    [0.005, 1.02716171455, 1.02716113766, 1.01460742959, 0.243209571363, -0.256790428637],
    [0.01, 1.03875224112, 1.0383404509, 0.960168052789, 0.240311939718, -0.259688060282],
    [0.02, 1.05549470971, 1.04280388994, 0.837258022527, 0.236126032313, -0.263873967687],
    [0.05, 1.08676454559, 0.970803783407, 0.633654096572, 0.227503093794, -0.272496906206],
    [0.1, 1.07754507951, 0.845516453029, 0.496567822661, 0.217250212457, -0.282749787543],
    [0.2, 0.943043185921, 0.68755729062, 0.384350961108, 0.201751630303, -0.298248369697],
    [0.3, 0.795924407408, 0.574381372664, 0.318826339579, 0.189331022831, -0.310668977169],
    [0.5, 0.560992279158, 0.404189751078, 0.224105404451, 0.170293220201, -0.329706779799],
    [1.0, 0.233452641966, 0.168195182931, 0.0932547753715, 0.143848027196, -0.356151972804],
    [2.0, 0.0404266127287, 0.0291260850814, 0.0161487771015, 0.128263882083, -0.371736117917],
];

#[test]
fn the_series_has_its_known_values() {
    let series = Mandel::new(0.25, 0.001);
    for [t, centre, half, outer, bulge, strain] in KNOWN {
        let own = series.at(t);
        let pairs = [
            (own.centre, centre),
            (series.pressure(0.5, t), half),
            (series.pressure(0.75, t), outer),
            (own.bulge, bulge),
            (-own.settlement, strain),
        ];
        for (own, known) in pairs {
            assert!((own - known).abs() < 1e-11, "{t}: {own} {known}");
        }
    }
    let (t, peak) = series.peak();
    assert!((peak - 1.0922509286685).abs() < 1e-12, "{peak}");
    // The peak is flat: twelve digits of it are seven of its time.
    assert!((t - 0.068020709696036).abs() < 1e-6, "{t}");
}

/// Every root solves its equation, and there is one between kπ and kπ + ½π for every k: f − tan changes its sign there
/// once.
#[test]
fn roots_are_all_there_are() {
    for ratio in RATIOS {
        let rise = 1.0 + 1.0 / (1.0 - 2.0 * ratio);
        for (k, mode) in Mandel::new(ratio, 1e-4).modes.iter().enumerate() {
            let base = PI * k as f64;
            assert!(mode.root > base && mode.root < base + 0.5 * PI);
            let (sin, cos) = mode.root.sin_cos();
            // Rounding of α turns sin α by as much of α.
            let rounding = 8.0 * f64::EPSILON * rise * (1.0 + mode.root).powi(2);
            let error = (sin - rise * mode.root * cos).abs();
            assert!(error < rounding, "{ratio} {k}: {error}");
        }
    }
    let known = [1.32419444958, 4.64068363078, 7.81133447513, 10.9651844009];
    for (mode, known) in Mandel::new(0.25, 0.01).modes.iter().zip(known) {
        assert!((mode.root - known).abs() < 1e-10);
    }
}

/// The balance of the water in every cross-section, equilibrium along and across, and the ends, by difference quotients:
/// P_T + 4 e_T = P_xx with the strain −e of the plates, of which the quotients leave parts in h² and h⁴.
#[test]
fn the_series_solves_the_equations() {
    for ratio in RATIOS {
        let series = Mandel::new(ratio, 0.004);
        let theta = 1.0 - 2.0 * ratio;
        for (x, t) in [(0.0, 0.05), (0.3, 0.05), (0.8, 0.1), (0.95, 0.3)] {
            let residual = |d: f64| {
                let later = 0.1 * d;
                let rate = |of: &dyn Fn(f64) -> f64| (of(t + later) - of(t - later)) / (2.0 * later);
                let pressure = rate(&|t| series.pressure(x, t));
                let strain = -4.0 * rate(&|t| series.at(t).settlement);
                let here = series.pressure(x, t);
                let sides = series.pressure(x + d, t) + series.pressure(x - d, t);
                pressure + strain - (sides - 2.0 * here) / (d * d)
            };
            let [coarse, fine] = [residual(8e-3), residual(4e-3)];
            let error = ((4.0 * fine - coarse) / 3.0).abs();
            // h⁴ of the sixth derivative, π⁶ at most of what is left at such T, and rounding over h².
            assert!(error < 1e-6, "{ratio} {x} {t}: {error} {fine}");
        }
        for t in [0.01, 0.1, 0.5] {
            assert!(series.pressure(1.0, t).abs() < 1e-14);
            let cells = 4000;
            let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(cells);
            let mean: f64 = (0..cells).map(|k| series.pressure(middle(k), t)).sum();
            let mean = mean / f64::from(cells);
            let slab = series.at(t);
            // σ_yy over F/a, by Hooke's law with the strains over F/(G a): −1 over the whole width. σ_xx is zero.
            let [lame, modulus] = [(1.0 - theta) / theta, (1.0 + theta) / theta];
            let across = modulus * slab.bulge - lame * slab.settlement - 0.5 * mean;
            let along = lame * slab.bulge - modulus * slab.settlement - 0.5 * mean;
            // In half the mean the midpoint rule has an error of h²/48 times the slope at the side, a few 1/√(πT).
            let left = 4e-9 / t.sqrt() + 1e-12 * modulus;
            assert!(across.abs() < left, "{ratio} {t}: {across}");
            assert!((along + 1.0).abs() < left, "{ratio} {t}: {along}");
        }
    }
}

/// Solution of P_T = L P − θ/(1 + θ) × its mean, on nodes from the middle to the side: from P = 1 to the time `t` by
/// the classical Runge-Kutta rule.
fn integrated(ratio: f64, n: usize, t: f64) -> [f64; 2] {
    let theta = 1.0 - 2.0 * ratio;
    let h = 1.0 / n as f64;
    // Stable up to 2.78 over the largest rate, 4/h².
    let steps = (t / (0.6 * h * h)).ceil() as usize;
    let dt = t / steps as f64;
    let mean = |p: &[f64]| h * (p.iter().sum::<f64>() - 0.5 * (p[0] + p[n]));
    let rates = |p: &[f64]| -> Vec<f64> {
        let mut bend = vec![0.0; n + 1];
        for b in 0..n {
            let before = if b == 0 { p[1] } else { p[b - 1] };
            bend[b] = (before - 2.0 * p[b] + p[b + 1]) / (h * h);
        }
        // Contribution of the node at the side that keeps its pressure zero when the mean is subtracted.
        let inner = h * (bend.iter().sum::<f64>() - 0.5 * bend[0]);
        let fall = theta * inner / (1.0 + theta * (1.0 - 0.5 * h));
        bend[..n].iter().map(|b| b - fall).chain([0.0]).collect()
    };
    // The undrained state of these nodes: the one at the side has no pressure, and its share of the force is borne.
    let mut p = vec![(1.0 + theta) / (1.0 + theta * (1.0 - 0.5 * h)); n + 1];
    p[n] = 0.0;
    for _ in 0..steps {
        let moved = |k: &[f64], s: f64| -> Vec<f64> { p.iter().zip(k).map(|(p, k)| p + s * dt * k).collect() };
        let a = rates(&p);
        let b = rates(&moved(&a, 0.5));
        let c = rates(&moved(&b, 0.5));
        let d = rates(&moved(&c, 1.0));
        for (i, p) in p.iter_mut().enumerate() {
            *p += dt / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
        }
    }
    [p[0], mean(&p)]
}

/// An integration in time that knows nothing of modes: differences of second order, extrapolated twice in h², and a rule
/// of fourth order in time. What the second extrapolation changes is more than what is left.
#[test]
fn an_independent_integration_agrees() {
    for ratio in [0.0, 0.25, 0.4] {
        let series = Mandel::new(ratio, 0.01);
        for t in [0.02, 0.1, 0.3] {
            let [coarse, middle, fine] = [32, 64, 128].map(|n| integrated(ratio, n, t));
            let slab = series.at(t);
            let exact = [slab.centre, 1.0 - (4.0 * slab.settlement - 1.0) / (1.0 - 2.0 * ratio)];
            for i in 0..2 {
                let first = (4.0 * middle[i] - coarse[i]) / 3.0;
                let second = (4.0 * fine[i] - middle[i]) / 3.0;
                let limit = (16.0 * second - first) / 15.0;
                let known = (limit - second).abs().max(1e-10);
                let error = (limit - exact[i]).abs();
                assert!(error < known, "{ratio} {t}: {error:e} {known:e}");
                assert!(known < 1e-5, "{known:e}");
            }
        }
    }
}

/// At first nothing leaves, and in the end the slab is dry: −(1 − ν)/2 and ν/2 by Hooke's law.
#[test]
fn it_begins_undrained_and_ends_drained() {
    for ratio in RATIOS {
        let series = Mandel::new(ratio, 1e-7);
        let begin = series.at(1e-7);
        // What has left is of the order of √T.
        assert!((begin.centre - 1.0).abs() < 3e-3, "{}", begin.centre);
        assert!((begin.settlement - 0.25).abs() < 3e-3);
        assert!((begin.bulge - 0.25).abs() < 3e-3);
        let end = series.at(40.0);
        assert!(end.centre.abs() < 1e-12);
        assert!((end.settlement - 0.5 * (1.0 - ratio)).abs() < 1e-12);
        assert!((end.bulge - 0.5 * ratio).abs() < 1e-12);
    }
}

/// Where ν → ½ the total stress stays, and the slab is Terzaghi's column.
#[test]
fn without_compressibility_it_is_terzaghis_column() {
    let series = Mandel::new(0.5 - 1e-9, 0.01);
    for (x, t) in [(0.0, 0.05), (0.4, 0.1), (0.9, 0.5)] {
        let error = series.pressure(x, t) - terzaghi::pressure(1.0 - x, t);
        assert!(error.abs() < 1e-8, "{error}");
    }
}

/// The pressure in the middle rises before it falls, as Cryer's and Mandel's effect has it, the more the smaller ν.
#[test]
fn the_middle_rises_first() {
    let peaks = [0.0, 0.25, 0.4, 0.49].map(|ratio| Mandel::new(ratio, EARLIEST).peak());
    for (later, earlier) in peaks.iter().zip(&peaks[1..]) {
        assert!(later.1 > earlier.1 && earlier.1 > 1.0);
    }
}

/// One step of backward Euler: P + θ P̄ − ΔT P″ = 1 + θ, which hyperbolic functions solve; and small steps tend to the
/// series, in first order.
#[test]
fn steps_are_those_of_backward_euler() {
    for ratio in RATIOS {
        let theta = 1.0 - 2.0 * ratio;
        for dt in [0.01_f64, 0.3] {
            let k = 1.0 / dt.sqrt();
            let height = (1.0 + theta) / (1.0 + theta * (1.0 - k.tanh() / k));
            let exact = height * (1.0 - 1.0 / k.cosh());
            let own = Mandel::of_steps(ratio, dt, 1).after(1, dt).centre;
            assert!((own - exact).abs() < 2e-8, "{ratio} {dt}: {own} {exact}");
        }
    }
    let exact = Mandel::new(0.25, 0.1).at(0.1).centre;
    let error = |n: i32| {
        let dt = 0.1 / f64::from(n);
        Mandel::of_steps(0.25, dt, n).after(n, dt).centre - exact
    };
    assert!((error(400) / error(800) - 2.0).abs() < 0.01);
}

/// The closed form of the difference equations is what elimination gives, step by step.
#[test]
fn cells_have_their_closed_form() {
    for ratio in [-0.5, 0.0, 0.25, 0.4] {
        let theta = 1.0 - 2.0 * ratio;
        let own = 0.5 * (1.0 + theta) / theta;
        for cells in [Cells::two_grid(8), Cells::same(8, 0.0), Cells::same(8, own)] {
            let closed = Mandel::of_cells(ratio, cells);
            for dt in [1e-3, 0.01, 0.1] {
                let eliminated = of_particles(ratio, cells, false, dt, 5);
                for (k, exact) in (1..).zip(eliminated) {
                    let own = closed.after(k, dt);
                    for (own, exact) in
                        [(own.centre, exact.centre), (own.settlement, exact.settlement), (own.bulge, exact.bulge)]
                    {
                        assert!((own - exact).abs() < 1e-11, "{ratio} {cells:?}: {own} {exact}");
                    }
                }
            }
        }
    }
}

/// Particles with strains of their own change an outermost cell alone: what that does falls as the cells do, in second
/// order at least.
#[test]
fn strains_of_their_own_matter_less_on_finer_cells() {
    for cells in [Cells::two_grid, |n| Cells::same(n, 0.0)] {
        let change = |n: usize| {
            let [own, one] = [true, false].map(|apart| of_particles(0.25, cells(n), apart, 0.01, 10));
            (own[9].centre - one[9].centre).abs()
        };
        let [coarse, fine] = [change(16), change(32)];
        assert!(coarse > 0.0 && coarse / fine > 3.8, "{}", coarse / fine);
    }
}

/// Second-order convergence in the cells, exact in time.
#[test]
fn cells_tend_to_the_series() {
    let exact = Mandel::new(0.25, 0.1).at(0.1).centre;
    for cells in [Cells::two_grid, |n| Cells::same(n, 0.0), |n| Cells::same(n, 1.5)] {
        let error = |n: usize| Mandel::of_cells(0.25, cells(n)).at(0.1).centre - exact;
        assert!((error(32) / error(64) - 4.0).abs() < 0.1, "{}", error(32) / error(64));
    }
}
