//! Plastic flow against closed forms.

use super::*;
use crate::fixture::{drive, increments, side_by_side, stretches};
use crate::material::strength::ACCURACY;
use crate::number::{Dual, EIGHT};
use proptest::prelude::*;
use std::iter::repeat_n;

/// Young's modulus (Pa), Poisson's ratio and κ of a body that yields at an elastic strain of half a percent.
const YOUNG: f64 = 100.0;
const RATIO: f64 = 0.3;
const KAPPA: f64 = 0.4;

fn perfect() -> HenckyJ2 {
    HenckyJ2::new(YOUNG, RATIO, Strength::perfect(KAPPA).unwrap()).unwrap()
}

fn softening() -> HenckyJ2 {
    let strength = Strength::softening(KAPPA, 0.06 * KAPPA, 5.0).unwrap();
    HenckyJ2::new(YOUNG, RATIO, strength).unwrap()
}

fn softening_linearly() -> HenckyJ2 {
    let strength = Strength::softening_linearly(KAPPA, 0.06 * KAPPA, 2.0).unwrap();
    HenckyJ2::new(YOUNG, RATIO, strength).unwrap()
}

fn deviator(stress: &SymmetricTensor, f_determinant: f64) -> SymmetricTensor {
    stress.deviator().scale_add_identity(f_determinant, 0.0)
}

proptest! {
    #[test]
    fn flow_keeps_the_volume_dissipates_and_ends_on_the_surface(path in increments(0.05, 20)) {
        for law in [perfect(), softening(), softening_linearly()] {
            let mut state = law.initial_state();
            let mut determinant = 1.0;
            for increment in &path {
                let before = state;
                let (stress, after) = law.response(increment, 1.0, &before);
                state = after;
                determinant *= increment.determinant();
                // J² of the elastic part is that of the whole.
                prop_assert!((state.elastic.determinant() / determinant.powi(2) - 1.0).abs() < 1e-12);
                prop_assert!(state.plastic_strain >= before.plastic_strain);
                let kappa = law.strength.at(state.plastic_strain).0;
                let norm = deviator(&stress, determinant).norm();
                // The stress that is returned, and the one of the state that is kept: with strains of half a
                // percent, rounding of b_e is 1e-14 of them.
                prop_assert!(norm <= kappa * (1.0 + 1e-12));
                if state.plastic_strain > before.plastic_strain {
                    prop_assert!((norm / kappa - 1.0).abs() < 1e-12);
                    let kept = law.elasticity.shear_modulus * state.elastic.ln().deviator().norm();
                    prop_assert!((kept / kappa - 1.0).abs() < 1e-11);
                    // The energy that the return releases: what the elastic trial state had stored, less what
                    // is stored now.
                    let trial = ElastoplasticState {
                        elastic: before.elastic.push_forward(increment),
                        ..before
                    };
                    prop_assert!(law.energy(&trial) > law.energy(&state));
                }
            }
        }
    }

    /// Eight particles side by side, some of which flow, some of which have far strains and some of which do
    /// neither, are as one after the other: stress and flow to rounding of the strain's identity.
    #[test]
    fn eight_are_as_one(
        path in prop::collection::vec(prop::array::uniform8(prop::array::uniform9(-1.0..1.0_f64)), 1..6),
        size in prop::array::uniform8(-6.0..-0.7_f64),
        planar in prop::bool::ANY,
    ) {
        for law in [perfect(), softening(), softening_linearly()] {
            let mut states = [law.initial_state(); EIGHT];
            for step in &path {
                let increment: [_; EIGHT] = std::array::from_fn(|k| {
                    let mut gradient = Matrix3::from_row_slice(&step[k]);
                    if planar {
                        gradient.row_mut(2).fill(0.0);
                        gradient.column_mut(2).fill(0.0);
                    }
                    Matrix3::identity() + gradient * 10.0_f64.powf(size[k])
                });
                for [(stress, state), (alone, expected)] in side_by_side(&law, &increment, &mut states) {
                    let apart = (stress.to_matrix() - alone.to_matrix()).norm();
                    prop_assert!(apart < 1e-13 * YOUNG, "{apart}");
                    let apart = (state.elastic.to_matrix() - expected.elastic.to_matrix()).norm();
                    prop_assert!(apart < 1e-13 * expected.elastic.norm(), "{apart}");
                    prop_assert!((state.plastic_strain - expected.plastic_strain).abs() < 1e-14);
                }
            }
        }
    }
}

/// Softening in plane-strain shortening by ln λ: 2μ (√2 ln λ − √(3/2) ε) = κ(ε), by bisection here. The direction
/// of flow stays, so the return is exact for any step.
#[test]
fn softening_is_integrated_exactly_where_the_direction_stays() {
    for (law, end) in
        [softening(), softening_linearly()].into_iter().flat_map(|law| [0.01_f64, 0.1, 1.0].map(|end| (law, end)))
    {
        let left = |plastic: f64| {
            2.0 * law.elasticity.shear_modulus * (2.0_f64.sqrt() * end - 1.5_f64.sqrt() * plastic)
                - law.strength.at(plastic).0
        };
        let (mut lo, mut hi) = (0.0, 2.0 * end);
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            *(if left(middle) > 0.0 { &mut lo } else { &mut hi }) = middle;
        }
        for steps in [1, 10, 1000] {
            let step = end / f64::from(steps);
            let (stress, state) = drive(&law, repeat_n(stretches([-step, step, 0.0]), steps as usize));
            assert!((state.plastic_strain - lo).abs() < 1e-12, "{steps} {end}");
            let kappa = law.strength.at(lo).0;
            assert!(((stress.yy - stress.xx) / (2.0_f64.sqrt() * kappa) - 1.0).abs() < 1e-10);
        }
    }
}

/// The flow's derivative is that of its equation, dγ (2μ + √(2/3) κ′) = dτ, however far from it Newton's last step
/// began. It would lag most where one step is enough, close to the surface: by some 10⁻⁶.
#[test]
fn the_slope_of_the_flow_does_not_lag() {
    // Almost as steep as the elastic slope, of which four hundredths are left.
    let eta = 240.0;
    let strength = Strength::softening(KAPPA, 0.06 * KAPPA, eta).unwrap();
    let law = HenckyJ2::new(YOUNG, RATIO, strength).unwrap();
    let slope = |plastic: f64| PER_FLOW * law.strength.at(plastic).1;
    let left = |plastic: f64| 2.0 * law.elasticity.shear_modulus + slope(plastic);
    // How far the flow may be from the equation's, times the relative curvature there: both are greatest at the
    // surface.
    let tolerance = ACCURACY * KAPPA / left(0.0) * (PER_FLOW * eta * slope(0.0) / left(0.0)).abs();
    // Excess from 25 times the strength down to what counts as none.
    for k in 0..350 {
        let trial = KAPPA * (1.0 + 25.0 * 0.9_f64.powi(k));
        let flow =
            law.strength.flow(Dual::<1>::variable(trial, 0), 2.0 * law.elasticity.shear_modulus, Dual::splat(0.0));
        assert_eq!(flow.value, law.strength.flow(trial, 2.0 * law.elasticity.shear_modulus, 0.0));
        let off = flow.slope[0] * left(PER_FLOW * flow.value) - 1.0;
        assert!(off.abs() < tolerance, "{trial}: {off}");
    }
}

#[test]
fn flow_dissipates_its_strength() {
    for law in [perfect(), softening(), softening_linearly()] {
        let strength = law.strength;
        assert_eq!(strength.plastic_work(0.0), 0.0);
        for strain in [0.01, 0.3, 2.0] {
            // No kink between the ends: softening in a line ends at 0.188.
            let step = 1e-5;
            let ends = [strain + step, strain - step].map(|e| strength.plastic_work(e));
            let slope = (ends[0] - ends[1]) / (2.0 * step);
            let kappa = strength.at(strain).0;
            // ‖s‖ times the rate of flow √(3/2) ε̇.
            assert!((slope / (1.5_f64.sqrt() * kappa) - 1.0).abs() < 1e-8);
        }
    }
}
