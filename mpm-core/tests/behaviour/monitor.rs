//! Quantities that every run monitors.

use mpm_core::material::{Law, NeoHookean};
use mpm_core::{Particles, Totals};
use nalgebra::SMatrix;

#[test]
fn totals_are_sums_over_the_particles() {
    let law = NeoHookean::new(1e3, 0.3).unwrap();
    let places = vec![[0.0, 0.0], [1.0, 0.0]];
    let mut particles = Particles::<2>::new(places, 0.5, 4.0, [0.1; 2]).unwrap();
    particles.velocity = vec![[3.0, 0.0], [1.0, -2.0]];
    particles.jacobian = vec![1.0, 2.0];
    particles.j_bar = vec![1.0, 1.0];
    particles.reference_volume = vec![0.5, 3.0];
    particles.mass = vec![2.0, 5.0];
    let stretched = SMatrix::<f64, 3, 3>::from_diagonal_element(1.1);
    let (_, strained) = law.response(&stretched, 1.0, &law.initial_state());
    let energy = law.energy(&strained);
    let totals = Totals::of(&particles, 0..2, |p| [0.0, energy][p]);
    assert_eq!((totals.mass, totals.momentum), (7.0, [11.0, -10.0, 0.0]));
    assert_eq!(totals.kinetic_energy, 0.5 * (2.0 * 9.0 + 5.0 * 5.0));
    assert!(energy > 0.0 && (totals.stored_energy - 3.0 * energy).abs() < 1e-12 * energy);
    assert_eq!(totals.jacobian, (1.0, 2.0));
    let gap = std::f64::consts::LN_2;
    assert_eq!(totals.log_jacobian_gap_max, gap);
    assert!((totals.log_jacobian_gap_rms - gap / 2.0_f64.sqrt()).abs() < 1e-15);
}
