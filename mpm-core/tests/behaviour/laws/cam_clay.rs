//! Clay on paths that have closed forms, and what thermodynamics asks of any.

use super::hencky_j2::{increments, stretches};
use super::*;
use mpm_core::material::VolumetricState;

mod paths;

/// K, G (Pa) and porosity, of clay whose shear and bulk moduli are alike.
fn elasticity() -> ImprovedHencky {
    ImprovedHencky::new(2e6, SHEAR, 0.5).unwrap()
}

const SHEAR: f64 = 1.5e6;
const RATIO: f64 = 0.9;
/// λ − κ.
const PSI: f64 = 0.06;
const PRECONSOLIDATION: f64 = 100e3;

fn clay(initial_pressure: f64) -> CamClay {
    CamClay::new(elasticity(), RATIO, PSI, PRECONSOLIDATION, initial_pressure).unwrap()
}

/// Ellipse, drops, and surfaces whose critical state lies low.
fn shapes() -> [(f64, f64); 4] {
    [(1.0, 1.0), (0.5, 1.0), (1.0, 0.6), (0.3, 0.8)]
}

/// The elastic volume strain of undeformed clay.
fn initial_volume(law: &CamClay) -> f64 {
    -law.initial_state().plastic_volume
}

/// p, q, p_c of a state.
fn stresses(law: &CamClay, state: &VolumetricState) -> [f64; 3] {
    let stress = elasticity().response(&Matrix3::identity(), 1.0, &state.elastic).0;
    let stress = stress.scale_add_identity(state.elastic.determinant().sqrt(), 0.0);
    let hardening = -(state.plastic_volume + initial_volume(law)) / PSI;
    [-stress.mean(), 1.5_f64.sqrt() * stress.deviator().norm(), PRECONSOLIDATION * hardening.exp()]
}

/// ((p − ρ)/A)² + (q/B)² − 1, with ρ, A and B.
fn surface((alpha, gamma): (f64, f64), [p, q, pc]: [f64; 3]) -> (f64, [f64; 3]) {
    let rho = 0.5 * gamma * pc;
    let a = (1.0 - gamma) * p + 0.5 * gamma * pc;
    let b = RATIO * ((1.0 - alpha) * p + 0.5 * alpha * gamma * pc);
    let value = ((p - rho) / a).powi(2) + (q / b).powi(2) - 1.0;
    (value, [rho, a, b])
}

/// The plastic strain of a step, tension positive: what the elastic trial strain is more than the elastic strain.
fn plastic_step(before: &VolumetricState, increment: &Matrix3<f64>, after: &VolumetricState) -> Matrix3<f64> {
    let trial = before.elastic.push_forward(increment).ln().to_matrix();
    (trial - after.elastic.ln().to_matrix()) * 0.5
}

proptest! {
    #[test]
    fn clay_stays_within_its_surface_flows_by_its_rule_and_dissipates(
        // Paths of many steps, and some of a step or two by a tenth.
        path in prop_oneof![increments(3e-3, 30), increments(0.02, 6), increments(0.1, 3)],
        overconsolidation in 1.0..8.0_f64,
    ) {
        for (alpha, gamma) in shapes() {
            let law = clay(PRECONSOLIDATION / overconsolidation).shaped(alpha, gamma).unwrap();
            let mut state = law.initial_state();
            let mut determinant = 1.0;
            for increment in &path {
                let before = state;
                let (stress, after) = law.response(increment, 1.0, &before);
                state = after;
                determinant *= increment.determinant();
                let volume = 0.5 * state.elastic.determinant().ln() + state.plastic_volume;
                prop_assert!((volume - determinant.ln()).abs() < 1e-12);
                // Elastic strains of a part in a hundred carry rounding of the identity; so do those of clay that
                // has softened, of its small stresses more.
                let [p, q, pc] = stresses(&law, &state);
                let rounding = 1e-13 * SHEAR / pc + 1e-11;
                let (outside, [rho, a, b]) = surface((alpha, gamma), [p, q, pc]);
                prop_assert!(outside < 10.0 * rounding, "{outside} {rounding}");
                prop_assert!((stress.mean() * determinant + p).abs() < rounding * pc);
                let flow = plastic_step(&before, increment, &state);
                let compression = -flow.trace();
                let deviator = flow - Matrix3::identity() * (flow.trace() / 3.0);
                let shear = (2.0_f64 / 3.0).sqrt() * deviator.norm();
                let grows = state.plastic_strain - before.plastic_strain;
                let norm = (2.0_f64 / 3.0).sqrt() * flow.norm();
                prop_assert!((grows - norm).abs() < 1e-13, "{grows} {norm}");
                if grows < 1e-9 {
                    continue;
                }
                prop_assert!(outside.abs() < 10.0 * rounding);
                // The rule: ε_v : ε_s = (p − ρ)/A² : q/B², along the deviator.
                let cross = compression * q / (b * b) - shear * (p - rho) / (a * a);
                let size = compression.abs() * q / (b * b) + shear * (p - rho).abs() / (a * a);
                prop_assert!(cross.abs() < (1e-12 / grows + rounding) * (size + grows / pc));
                let of_stress = stress.deviator().to_matrix();
                let off = of_stress * deviator.norm() - deviator * of_stress.norm();
                prop_assert!(off.norm() < (1e-12 / grows + 10.0 * rounding) * deviator.norm() * pc);
                // Dissipation: work less stored energy, and √(A² ε_v² + B² ε_s²).
                let dissipated = (p - rho) * compression + q * shear;
                let by_rate = ((a * compression).powi(2) + (b * shear).powi(2)).sqrt();
                prop_assert!((dissipated - by_rate).abs() < (1e-12 / grows + rounding) * by_rate);
                let elastic = VolumetricState {
                    elastic: before.elastic.push_forward(increment),
                    ..before
                };
                let released = law.energy(&elastic) - law.energy(&state);
                prop_assert!(released >= dissipated * (1.0 - 1e-9) - 1e-13 * law.energy(&elastic));
                prop_assert!(dissipated > 0.0);
            }
        }
    }
}

/// The gradient of ((p − ρ)/A)² + (q/B)² at fixed p_c, by p and q.
fn gradient(shape: (f64, f64), [p, q, pc]: [f64; 3]) -> [f64; 2] {
    let step = 1e-4 * pc;
    let by = |dp: f64, dq: f64| {
        let ends = [1.0, -1.0].map(|s| surface(shape, [p + s * dp, q + s * dq, pc]).0);
        (ends[0] - ends[1]) / (2.0 * step)
    };
    [by(step, 0.0), by(0.0, step)]
}

/// The ellipse's flow is along its normal; that of the other shapes is along the ellipse's on which the stress lies,
/// not along the normal of their surface.
#[test]
fn flow_is_associated_for_the_ellipse_alone() {
    for (alpha, gamma) in shapes() {
        for start in [0.3, 0.9] {
            let law = clay(start * PRECONSOLIDATION).shaped(alpha, gamma).unwrap();
            let increment = stretches([-0.05, 0.02, 0.02]);
            let state = law.response(&increment, 1.0, &law.initial_state()).1;
            let flow = plastic_step(&law.initial_state(), &increment, &state);
            let compression = -flow.trace();
            let shear = (flow[(1, 1)] - flow[(0, 0)]) * 2.0 / 3.0;
            assert!(shear > 0.01);
            let normal = gradient((alpha, gamma), stresses(&law, &state));
            let angle =
                (compression * normal[1] - shear * normal[0]) / (compression.hypot(shear) * normal[0].hypot(normal[1]));
            let associated = (alpha, gamma) == (1.0, 1.0);
            // Differences of a quadratic function are exact, of the others nearly so.
            assert_eq!(angle.abs() < 1e-8, associated, "{alpha} {gamma}: {angle}");
        }
    }
}

/// Eight side by side, some of which flow, are as one after the other.
#[test]
fn eight_are_as_one_where_some_flow() {
    for (alpha, gamma) in shapes() {
        let law = clay(60e3).shaped(alpha, gamma).unwrap();
        let increment = |k: usize| {
            let size = 10.0_f64.powi(-(k as i32) / 2 - 1);
            let mut f = stretches([-size, if k.is_multiple_of(3) { size } else { 0.0 }, 0.1 * size]);
            f[(0, 1)] = if k.is_multiple_of(2) { size } else { 0.0 };
            f
        };
        let mut states = [law.initial_state(); 8];
        for _ in 0..3 {
            let both = side_by_side(&law, &std::array::from_fn(increment), &mut states);
            for (k, [(stress, state), (alone, expected)]) in both.iter().enumerate() {
                let apart = (stress.to_matrix() - alone.to_matrix()).norm();
                assert!(apart < 1e-10 * PRECONSOLIDATION, "{k}: {apart}");
                assert!((state.plastic_volume - expected.plastic_volume).abs() < 1e-13);
                assert!((state.plastic_strain - expected.plastic_strain).abs() < 1e-13);
            }
        }
        let flown = states.iter().filter(|s| s.plastic_strain > 0.0).count();
        assert!((2..8).contains(&flown), "{flown}");
    }
}

#[test]
fn clay_that_cannot_be_is_refused_by_name() {
    let refused = |m: f64, psi: f64, pc: f64, p: f64, name: &str| {
        let error = CamClay::new(elasticity(), m, psi, pc, p).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(bad, 0.1, 2.0, 1.0, "critical state ratio M = ");
        refused(1.0, bad, 2.0, 1.0, "plastic compressibility λ − κ = ");
        refused(1.0, 0.1, bad, 1.0, "preconsolidation = ");
        refused(1.0, 0.1, 2.0, bad, "initial effective pressure = ");
    }
    refused(1.0, 0.1, 2.0, 2.1, "initial effective pressure = 2.1 is not allowed");
    for bad in [0.0, -0.5, 1.5, f64::NAN] {
        for (alpha, gamma, name) in [(bad, 1.0, "α = "), (1.0, bad, "γ = ")] {
            let error = clay(1e3).shaped(alpha, gamma).unwrap_err().to_string();
            assert!(error.contains(name), "{error}");
        }
    }
}
