//! Hypoelastic laws with Jaumann's rate against closed forms, elastic and with J2 plasticity.

use super::hencky_j2::{drive, sheared, stretches};
use super::*;
use std::iter::repeat_n;

/// Shear modulus (Pa) of the elastic law.
const MU: f64 = 1e5 / 2.4;
/// Young's modulus (Pa), and a strength κ (Pa) that yields at an elastic strain of half a percent.
const YOUNG: f64 = 100.0;
const KAPPA: f64 = 0.4;

fn law(update: JaumannUpdate) -> Hypoelastic {
    Hypoelastic::new(1e5, 0.2, update).unwrap()
}

fn stressed() -> SymmetricTensor {
    let f = Matrix3::new(1.1, 0.05, 0.0, -0.02, 0.95, 0.1, 0.0, 0.03, 1.02);
    law(JaumannUpdate::Split).at_rest(&f).1
}

/// A step that only turns turns the stress and adds none; the linear one errs by the square of the angle.
#[test]
fn a_rigid_turn_turns_the_stress() {
    let stress = stressed();
    let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
    let turn = |angle: f64| Rotation3::new(axis * angle).into_inner();
    let error = |update, angle: f64| {
        let turned = law(update).response(&turn(angle), 1.0, &stress).1;
        let exact = stress.push_forward(&turn(angle));
        (turned.to_matrix() - exact.to_matrix()).norm() / stress.norm()
    };
    assert!(error(JaumannUpdate::Split, 1.0) < 1e-14);
    let linear = [0.02, 0.01].map(|angle| error(JaumannUpdate::Linear, angle));
    assert!((linear[0] / linear[1] - 4.0).abs() < 0.1, "{linear:?}");
}

/// Simple shear with Jaumann's rate: σ_xy = μ sin γ, σ_xx = μ (1 − cos γ), in closed form (Dienes 1979).
#[test]
fn simple_shear_oscillates_and_errs_by_the_order_of_the_update() {
    let error = |update, steps: u32| {
        let (state, _) = drive(&law(update), repeat_n(sheared(2.0 / f64::from(steps)), steps as usize));
        let (xy, xx) = (MU * 2.0_f64.sin(), MU * (1.0 - 2.0_f64.cos()));
        (state.xy - xy).hypot(state.xx - xx) / MU
    };
    for (update, ratio) in [(JaumannUpdate::Split, 4.0), (JaumannUpdate::Linear, 2.0)] {
        let found = error(update, 80) / error(update, 160);
        assert!((found - ratio).abs() < 0.1, "{update:?}: {found}");
    }
}

fn softening() -> Strength {
    Strength::softening_linearly(KAPPA, 0.2 * KAPPA, 4.0).unwrap()
}

fn flowing(strength: Strength) -> HypoelasticJ2 {
    HypoelasticJ2::new(YOUNG, 0.3, JaumannUpdate::Split, strength).unwrap()
}

/// Plane-strain shortening: the stress difference is 2c = √2 κ(ε), with ε from 2μ (√2 e − √(3/2) ε) = κ(ε), a
/// linear equation until the residual strength. A step has the strain 2 tanh(e/2) at its middle, e + O(e³).
#[test]
fn shortening_follows_the_strength() {
    let law = flowing(softening());
    let mu = YOUNG / 2.6;
    for (end, softens) in [(0.02_f64, true), (0.3, false)] {
        let steps = 1000;
        let step = end / f64::from(steps);
        let (stress, state) = drive(&law, repeat_n(stretches([-step, step, 0.0]), steps as usize));
        let elastic = 2.0 * mu * 2.0_f64.sqrt() * end;
        let stiffness = 2.0 * mu * 1.5_f64.sqrt();
        let plastic = if softens { (elastic - KAPPA) / (stiffness - 4.0) } else { (elastic - 0.2 * KAPPA) / stiffness };
        let kappa = (KAPPA - 4.0 * plastic).max(0.2 * KAPPA);
        assert!((state.plastic_strain - plastic).abs() < end * step * step);
        assert!(((stress.yy - stress.xx) / (2.0_f64.sqrt() * kappa) - 1.0).abs() < 1e-3 * step);
    }
}

/// A body that turns while it flows carries the turned stress, and no other flow.
#[test]
fn a_rigid_turn_turns_the_stress_of_a_body_that_flows() {
    let law = flowing(softening());
    let (_, before) = drive(&law, repeat_n(sheared(0.02), 3));
    let turn = Rotation3::new(Vector3::new(0.3, -0.5, 0.8)).into_inner();
    let (stress, after) = law.response(&turn, 1.0, &before);
    let exact = before.elastic.push_forward(&turn);
    // Rounding of the strain, which is nothing, times the modulus.
    assert!((stress.to_matrix() - exact.to_matrix()).norm() < 1e-14 * YOUNG);
    assert!((after.plastic_strain - before.plastic_strain).abs() < 1e-14);
}

/// In simple shear the two laws differ by the elastic strain, half a percent.
#[test]
fn its_hyperelastic_counterpart_differs_by_the_elastic_strain() {
    let hyperelastic = HenckyJ2::new(YOUNG, 0.3, softening()).unwrap();
    let path = || repeat_n(sheared(1e-3), 100);
    let (stress, state) = drive(&flowing(softening()), path());
    let (other, after) = drive(&hyperelastic, path());
    assert!(state.plastic_strain > 0.04);
    assert!((state.plastic_strain / after.plastic_strain - 1.0).abs() < 0.005);
    assert!((stress.to_matrix() - other.to_matrix()).norm() < 0.01 * KAPPA);
}
