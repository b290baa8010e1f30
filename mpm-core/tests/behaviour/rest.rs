//! Rest, by forces, energies and displacements.

use mpm_core::stage::{Observation, RestCriterion};

fn at(time: f64, force_ratio: f64, displacement: f64) -> Observation {
    Observation { time, force_ratio, energy_ratio: 0.0, displacement }
}

#[test]
fn a_still_motion_rests_after_one_window() {
    let mut rest = RestCriterion::new(1e-3, 1e-3, 1e-4, 1.0);
    let rested: Vec<bool> = (0..5).map(|k| rest.observe(at(0.5 * f64::from(k), 1e-4, 1.0))).collect();
    assert_eq!(rested, [false, false, true, true, true]);
}

#[test]
fn creep_never_rests_though_forces_balance() {
    let mut rest = RestCriterion::new(1e-3, 1e-3, 1e-4, 1.0);
    assert!((0..100).all(|k| {
        let t = 0.1 * f64::from(k);
        !rest.observe(at(t, 0.0, 1.0 + 2e-4 * t))
    }));
}

#[test]
fn one_large_force_in_the_window_forbids_rest() {
    let mut rest = RestCriterion::new(1e-3, 1e-3, 1e-4, 1.0);
    rest.observe(at(0.0, 1e-4, 1.0));
    rest.observe(at(0.6, 1e-2, 1.0));
    assert!(!rest.observe(at(1.1, 1e-4, 1.0)));
    assert!(!rest.observe(at(1.6, 1e-4, 1.0)));
    assert!(rest.observe(at(2.7, 1e-4, 1.0)));
}
