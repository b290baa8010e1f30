//! Paths of the laboratory, against closed forms and an integration of the rates.

use super::super::hencky_j2::{drive, sheared};
use super::*;
use std::iter::repeat_n;

/// Halves a bracket until no number is left between its ends; `below` tells whether a number is below the one sought.
fn bisect([mut low, mut high]: [f64; 2], below: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        *(if below(middle) { &mut low } else { &mut high }) = middle;
    }
    [low, high]
}

/// The elastic volume strain at a pressure, and the bulk modulus there, by secants of the closed form
/// p = −K v/n + ½ K v² (1 − n)/n².
fn elastic_volume(p: f64) -> f64 {
    let (k, n0) = (2e6, 0.5);
    let excess = |v: f64| {
        let n = 1.0 - (1.0 - n0) * (-v).exp();
        -k * v / n + 0.5 * k * v * v * (1.0 - n) / (n * n) - p
    };
    bisect([(1.0_f64 - n0).ln() * 0.99, 0.0], |v| excess(v) > 0.0)[0]
}

/// Volume strain since the start where the pressure is p and clay is preconsolidated to p_c.
fn volume(law: &CamClay, p: f64, pc: f64) -> f64 {
    elastic_volume(p) - initial_volume(law) - PSI * (pc / PRECONSOLIDATION).ln()
}

#[test]
fn undeformed_clay_is_under_its_pressure() {
    for pressure in [1.0, 30e3, PRECONSOLIDATION] {
        let law = clay(pressure);
        let (stress, state) = law.at_rest(&Matrix3::identity());
        // The strain is rounded as the identity is that it is added to; the bulk modulus is some 4 MPa.
        assert!((stress.mean() + pressure).abs() < 4.0 * f64::EPSILON * 4e6);
        assert!(stress.deviator().norm() < 4.0 * f64::EPSILON * 4e6);
        assert_eq!(state.plastic_strain, 0.0);
        assert!((initial_volume(&law) / elastic_volume(pressure) - 1.0).abs() < 1e-9);
    }
}

/// Isotropic compression, swelling and compression again: the slopes λ = κ + ψ and κ, the latter that of the
/// elasticity, for steps of any size.
#[test]
fn isotropic_compression_has_its_two_lines() {
    for (alpha, gamma) in shapes() {
        let law = clay(50e3).shaped(alpha, gamma).unwrap();
        let mut state = law.initial_state();
        let mut strain = 0.0;
        let mut largest = PRECONSOLIDATION;
        for end in [-0.01, -0.08, -0.15, -0.14, -0.149, -0.2_f64] {
            let increment = Matrix3::identity() * ((end - strain) / 3.0).exp();
            strain = end;
            state = law.response(&increment, 1.0, &state).1;
            let [p, q, pc] = stresses(&law, &state);
            largest = largest.max(p);
            assert!(q < 1e-9 * p && (pc / largest - 1.0).abs() < 1e-9);
            assert!((volume(&law, p, largest) - end).abs() < 1e-12, "{end}: {p}");
        }
        // λ: what the volume changes by over ln p.
        let slope = |p: f64| (volume(&law, p * 1.001, p * 1.001) - volume(&law, p, p)) / 1.001_f64.ln();
        let kappa = |p: f64| (elastic_volume(p * 1.001) - elastic_volume(p)) / 1.001_f64.ln();
        assert!((slope(2e5) - kappa(2e5) + PSI).abs() < 1e-9);
    }
}

/// Shortened along an axis and widened so that the volume stays.
fn undrained(step: f64) -> Matrix3<f64> {
    stretches([-step, 0.5 * step, 0.5 * step])
}

/// The volume stays: v_e + v_p is what it was, so p_c = p_c0 e^((v_e(p) − v_e0)/ψ), and q² = M² p (p_c − p) is a path
/// that does not depend on the steps. It ends where p_c = 2p.
#[test]
fn undrained_shear_follows_its_stress_path() {
    for start in [1.0, 0.8, 0.25] {
        let law = clay(start * PRECONSOLIDATION);
        let pc = |p: f64| PRECONSOLIDATION * ((elastic_volume(p) - initial_volume(&law)) / PSI).exp();
        // p_c falls as p grows.
        let [low, _] = bisect([1.0, 2.0 * PRECONSOLIDATION], |p| pc(p) > 2.0 * p);
        for steps in [5, 40] {
            let mut state = law.initial_state();
            let mut flown = 0;
            for _ in 0..steps {
                state = law.response(&undrained(0.3 / f64::from(steps)), 1.0, &state).1;
                let [p, q, found] = stresses(&law, &state);
                if state.plastic_strain > 0.0 {
                    flown += 1;
                    assert!((found / pc(p) - 1.0).abs() < 1e-9, "{found} {}", pc(p));
                    assert!((q / (RATIO * (p * (pc(p) - p)).sqrt()) - 1.0).abs() < 1e-8);
                } else {
                    // Elastic: the volume and with it p stays.
                    assert!((p / (start * PRECONSOLIDATION) - 1.0).abs() < 1e-9);
                }
            }
            let [p, q, _] = stresses(&law, &state);
            assert!(flown > 2);
            assert!((p / low - 1.0).abs() < 1e-3 && (q / (RATIO * p) - 1.0).abs() < 1e-3);
        }
    }
}

/// How much shear the undrained path takes: ε_s = q/3G + ∫ q/(M² (p − ρ)) dv_e along it, by the midpoint rule in ten
/// thousand parts, whose error is below 10⁻⁶. The return is of first order in the step.
#[test]
fn undrained_shear_strain_converges_with_first_order() {
    let law = clay(PRECONSOLIDATION);
    let end = 0.03_f64;
    let pressure = |v: f64| {
        let n = 1.0 - 0.5 * (-v).exp();
        -2e6 * v / n + 1e6 * v * v * (1.0 - n) / (n * n)
    };
    let pc = |v: f64| PRECONSOLIDATION * ((v - initial_volume(&law)) / PSI).exp();
    let shear = |v: f64| RATIO * (pressure(v) * (pc(v) - pressure(v))).sqrt();
    // ε_s at v: the integrand is singular like 1/√ at the start no more than q is zero there.
    let strain = |to: f64| {
        let parts = 10_000;
        let width = (to - initial_volume(&law)) / f64::from(parts);
        let flow: f64 = (0..parts)
            .map(|k| {
                let v = initial_volume(&law) + (f64::from(k) + 0.5) * width;
                shear(v) / (RATIO * RATIO * (pressure(v) - 0.5 * pc(v))) * width
            })
            .sum();
        shear(to) / (3.0 * SHEAR) + flow
    };
    let before = |v| pressure(v) >= 0.5 * pc(v) * (1.0 + 1e-9) && strain(v) <= end;
    let [low, _] = bisect([initial_volume(&law), initial_volume(&law) + 0.02], before);
    let exact = pressure(low);
    let errors = [40, 80, 160].map(|steps| {
        let (_, state) = drive(&law, repeat_n(undrained(end / f64::from(steps)), steps as usize));
        stresses(&law, &state)[0] / exact - 1.0
    });
    for pair in errors.windows(2) {
        assert!((1.8..2.3).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
    assert!(errors[2].abs() < 2e-3, "{errors:?}");
}

/// Shortened along an axis by `step` while the lateral Kirchhoff stress stays −`lateral`: the lateral strain by
/// secants.
fn drained(law: &CamClay, state: &VolumetricState, lateral: f64, step: f64) -> (f64, VolumetricState) {
    let at = |side: f64| {
        let after = law.response(&stretches([-step, side, side]), 1.0, state).1;
        let [p, q, _] = stresses(law, &after);
        (p - q / 3.0 - lateral, after)
    };
    // Widening lowers the lateral pressure.
    let [_, high] = bisect([-step, step], |side| at(side).0 > 0.0);
    (2.0 * high - step, at(high).1)
}

/// q = 3 (p − p₀): where clay flows, p_c = p + q²/(M² p) and the volume are known, for steps of any size; it ends at
/// p = 3 p₀/(3 − M), p_c = 2p.
#[test]
fn drained_shear_ends_in_the_critical_state() {
    for (start, steps) in [(1.0, 60), (1.0, 240), (0.7, 120)] {
        let lateral = start * PRECONSOLIDATION;
        let law = clay(lateral);
        let mut state = law.initial_state();
        let mut change = 0.0;
        for _ in 0..steps {
            let (volume_change, after) = drained(&law, &state, lateral, 0.6 / f64::from(steps));
            (change, state) = (change + volume_change, after);
            let [p, q, pc] = stresses(&law, &state);
            assert!((q - 3.0 * (p - lateral)).abs() < 1e-9 * p);
            if state.plastic_strain > 0.0 {
                let exact = p + (q / RATIO).powi(2) / p;
                assert!((pc / exact - 1.0).abs() < 1e-8, "{pc} {exact}");
            }
            assert!((volume(&law, p, pc) - change).abs() < 1e-10);
        }
        let [p, q, pc] = stresses(&law, &state);
        let critical = 3.0 * lateral / (3.0 - RATIO);
        assert!((p / critical - 1.0).abs() < 2e-3, "{p} {critical}");
        assert!((q / (RATIO * p) - 1.0).abs() < 3e-3 && (pc / (2.0 * p) - 1.0).abs() < 3e-3);
        assert!((change - volume(&law, critical, 2.0 * critical)).abs() < 2e-4);
    }
}

/// Simple shear, in which principal axes turn, ends at p = ρ and q = M p, whatever the shape.
#[test]
fn shear_ends_in_the_critical_state_of_any_shape() {
    for (alpha, gamma) in shapes() {
        for start in [0.2, 1.0] {
            let law = clay(start * PRECONSOLIDATION).shaped(alpha, gamma).unwrap();
            let (_, state) = drive(&law, repeat_n(sheared(2e-3), 1000));
            let [p, q, pc] = stresses(&law, &state);
            for ratio in [p / (0.5 * gamma * pc), q / (RATIO * p)] {
                assert!((ratio - 1.0).abs() < 1e-3, "{alpha} {gamma}: {ratio}");
            }
            let next = law.response(&sheared(2e-3), 1.0, &state).1;
            assert!((next.plastic_volume - state.plastic_volume).abs() < 1e-6);
        }
    }
}

/// The mean Kirchhoff stress and the bulk modulus (Pa) at an elastic volume strain.
fn volumetric(v: f64) -> [f64; 2] {
    let b = SymmetricTensor::identity().scale_add_identity((2.0 / 3.0 * v).exp(), 0.0);
    let stress = elasticity().response(&Matrix3::identity(), 1.0, &b).0;
    let modulus = elasticity().wave_modulus(v.exp(), &SymmetricTensor::default(), &b);
    [stress.mean() * v.exp(), modulus - 4.0 / 3.0 * SHEAR]
}

/// d(v_e, q)/dε of uniaxial compression by rates: ε_v = ε, ε_s = ⅔ ε, and the flow that keeps the stress on the
/// surface.
fn rates(v: f64, q: f64, pc: f64) -> [f64; 3] {
    let [mean, bulk] = volumetric(v);
    let (p, g) = (-mean, SHEAR);
    // Gradient of the ellipse f = q²/M² + p² − p p_c.
    let m2 = RATIO * RATIO;
    let [by_p, by_q, by_pc] = [2.0 * p - pc, 2.0 * q / m2, -p];
    let elastic = by_p * bulk + by_q * 2.0 * g;
    let hard = by_p * bulk * by_p + by_q * 3.0 * g * by_q - by_pc * pc / PSI * by_p;
    let flow = (elastic / hard).max(0.0);
    [-(1.0 - flow * by_p), 3.0 * g * (2.0 / 3.0 - flow * by_q), pc / PSI * flow * by_p]
}

/// One-dimensional compression from the surface, against the rates by the classical Runge–Kutta method in 4000 steps:
/// first order in the step.
#[test]
fn one_dimensional_compression_converges_to_its_rates() {
    let law = clay(PRECONSOLIDATION);
    let end = 0.1;
    let count = 4000;
    let step = end / f64::from(count);
    let mut y = [initial_volume(&law), 0.0, PRECONSOLIDATION];
    for _ in 0..count {
        let at = |y: [f64; 3], k: [f64; 3], part: f64| {
            let z: [f64; 3] = std::array::from_fn(|i| y[i] + part * step * k[i]);
            rates(z[0], z[1], z[2])
        };
        let k1 = at(y, [0.0; 3], 0.0);
        let k2 = at(y, k1, 0.5);
        let k3 = at(y, k2, 0.5);
        let k4 = at(y, k3, 1.0);
        y = std::array::from_fn(|i| y[i] + step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    let exact = [-volumetric(y[0])[0], y[1], y[2]];
    // The rates keep their surface.
    assert!(surface((1.0, 1.0), exact).0.abs() < 1e-6, "{exact:?}");
    let errors = [50, 100, 200].map(|steps| {
        let (_, state) = drive(&law, repeat_n(stretches([-end / f64::from(steps), 0.0, 0.0]), steps as usize));
        let found = stresses(&law, &state);
        [0, 1, 2].map(|i| found[i] / exact[i] - 1.0)
    });
    for i in 0..3 {
        for pair in errors.windows(2) {
            let ratio = pair[0][i] / pair[1][i];
            assert!((1.8..2.3).contains(&ratio), "{errors:?}");
        }
        assert!(errors[2][i].abs() < 3e-3, "{errors:?}");
    }
    assert!(exact[1] / exact[0] < RATIO);
}
