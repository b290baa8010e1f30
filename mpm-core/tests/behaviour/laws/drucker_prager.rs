//! Ground with friction, on paths that have closed forms.

use super::*;
use mpm_core::material::{ElastoplasticState, VolumetricState};

/// Young's modulus (Pa) and Poisson's ratio, and the moduli that follow.
const ELASTIC: (f64, f64) = (100.0, 0.3);
const SHEAR: f64 = 100.0 / 2.6;
const BULK: f64 = 100.0 / 1.2;
const COHESION: f64 = 0.05;

fn ground(degrees: [f64; 2], matched: Matched) -> DruckerPrager {
    DruckerPrager::new(ELASTIC, COHESION, degrees.map(f64::to_radians), matched).unwrap()
}

/// Kirchhoff's stress of a state.
fn stress(state: &VolumetricState) -> Matrix3<f64> {
    let logarithm = state.elastic.ln();
    let shear = logarithm.deviator().to_matrix() * SHEAR;
    shear + Matrix3::identity() * (0.5 * BULK * logarithm.trace())
}

fn stretches(axes: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(axes).map(f64::exp))
}

/// The state after `steps` increments of the logarithms of the stretches.
fn drive(law: &DruckerPrager, increment: [f64; 3], steps: usize) -> VolumetricState {
    let f = stretches(increment);
    (0..steps).fold(law.initial_state(), |state, _| law.response(&f, 1.0, &state).1)
}

/// Mohr and Coulomb: (τ₁ − τ₃)/2 = c cos φ − sin φ (τ₁ + τ₃)/2, of the two principal stresses that are named.
fn beyond_mohr_and_coulomb([greatest, least]: [f64; 2], phi: f64) -> f64 {
    0.5 * (greatest - least) - COHESION * phi.cos() + phi.sin() * 0.5 * (greatest + least)
}

const ANGLES: [[f64; 2]; 6] = [[30.0, 30.0], [30.0, 10.0], [30.0, 0.0], [10.0, 5.0], [45.0, 20.0], [0.0, 0.0]];

/// Flow in plane strain that grows as ψ says, until the stress no longer changes: its stresses are Mohr and Coulomb's.
#[test]
fn flow_in_plane_strain_has_mohr_and_coulombs_stress() {
    for [phi, psi] in ANGLES {
        let law = ground([phi, psi], Matched::PlaneStrain);
        let [phi, psi] = [phi, psi].map(f64::to_radians);
        // sin ψ = (ε̇₁ + ε̇₃)/(ε̇₁ − ε̇₃).
        let rate = 1e-4;
        let state = drive(&law, [rate * (1.0 + psi.sin()), rate * (psi.sin() - 1.0), 0.0], 4000);
        let s = stress(&state);
        let off = beyond_mohr_and_coulomb([s[(0, 0)], s[(1, 1)]], phi);
        assert!(off.abs() < 1e-9 * COHESION, "{phi} {psi}: {off}");
        // The third stress lies between.
        assert!(s[(2, 2)] < s[(0, 0)] && s[(2, 2)] > s[(1, 1)]);
    }
}

/// Two equal stresses: the cone's edges are those of the pyramid.
#[test]
fn triaxial_flow_has_mohr_and_coulombs_stress() {
    for [phi, psi] in ANGLES {
        let sin = psi.to_radians().sin();
        for (matched, side) in [(Matched::Compression, 1.0), (Matched::Extension, -1.0)] {
            let law = ground([phi, psi], matched);
            // Along (2, −1, −1), with η̄ times its length in volume.
            let dilation = 2.0_f64.sqrt() * 6.0 * sin / (3.0_f64.sqrt() * (3.0 - side * sin));
            let volume = dilation * 6.0_f64.sqrt() / 3.0;
            let axes = [2.0, -1.0, -1.0].map(|axis| 1e-4 * (volume - side * axis));
            let s = stress(&drive(&law, axes, 4000));
            let [axial, lateral] = [s[(0, 0)], s[(1, 1)]];
            let off = beyond_mohr_and_coulomb([axial.max(lateral), axial.min(lateral)], phi.to_radians());
            assert!(off.abs() < 1e-9 * COHESION, "{phi} {psi} {matched:?}: {off}");
        }
    }
}

/// Uniaxial strain: elastic, then along the cone; the direction of flow does not turn, so that one step is exact.
#[test]
fn an_oedometer_presses_along_a_line() {
    for [phi, psi] in ANGLES {
        let law = ground([phi, psi], Matched::Compression);
        let [sin_phi, sin_psi] = [phi, psi].map(|angle| angle.to_radians().sin());
        let edge = |sin: f64| 2.0_f64.sqrt() * 6.0 * sin / (3.0_f64.sqrt() * (3.0 - sin));
        let [friction, dilation] = [sin_phi, sin_psi].map(edge);
        let cohesion = 2.0_f64.sqrt() * 6.0 * COHESION * phi.to_radians().cos() / (3.0_f64.sqrt() * (3.0 - sin_phi));
        for strain in [-1e-4, -0.01, -0.05] {
            let (shear, mean) = (2.0 * SHEAR * (2.0_f64 / 3.0).sqrt() * -strain, BULK * strain);
            let beyond: f64 = shear + friction * mean - cohesion;
            let flow = beyond.max(0.0) / (2.0 * SHEAR + friction * dilation * BULK);
            let exact = [shear - 2.0 * SHEAR * flow, mean - BULK * dilation * flow];
            for steps in [1, 7] {
                let state = drive(&law, [strain / steps as f64, 0.0, 0.0], steps);
                let s = stress(&state);
                let found = [(s - Matrix3::identity() * (s.trace() / 3.0)).norm(), s.trace() / 3.0];
                assert!(
                    (found[0] - exact[0]).abs() < 1e-12 && (found[1] - exact[1]).abs() < 1e-12,
                    "{found:?} {exact:?}"
                );
                assert!((state.plastic_volume - dilation * flow).abs() < 1e-13);
            }
        }
    }
}

/// Beyond the tip, at c cot φ, only the volume grows; pressed together again by as much, it has no stress yet.
#[test]
fn ground_pulled_apart_ends_at_the_tip() {
    for matched in [Matched::PlaneStrain, Matched::Compression, Matched::Extension] {
        for [phi, psi] in ANGLES.into_iter().filter(|[phi, _]| *phi > 0.0) {
            let law = ground([phi, psi], matched);
            let tip = COHESION / phi.to_radians().tan();
            let state = drive(&law, [0.02, 0.03, 0.01], 5);
            let s = stress(&state);
            assert!((s - Matrix3::identity() * tip).norm() < 1e-13, "{s}");
            let elastic = tip / BULK;
            assert!((state.plastic_volume - (0.3 - elastic)).abs() < 1e-13);
            let cauchy = law.response(&Matrix3::identity(), 1.0, &state).0;
            assert!((cauchy.mean() - tip * (-0.3_f64).exp()).abs() < 1e-13);
        }
    }
}

proptest! {
    /// On any path the stress stays on the cone or within, and flow takes energy.
    #[test]
    fn stress_stays_within_and_flow_takes_energy(steps in prop::collection::vec(deformations(), 1..6), k in 0..6_usize) {
        let law = ground(ANGLES[k], Matched::PlaneStrain);
        let mut state = law.initial_state();
        let small = |f: &Matrix3<f64>| Matrix3::identity() + (f - Matrix3::identity()) * 0.1;
        for f in steps.iter().map(small) {
            let before = law.energy(&state);
            // The elastic trial, which a law without strength keeps.
            let trial = HenckyJ2::new(ELASTIC.0, ELASTIC.1, Strength::perfect(1e9).unwrap()).unwrap();
            let elastic = ElastoplasticState { elastic: state.elastic, plastic_strain: 0.0 };
            let unrelaxed = trial.energy(&trial.response(&f, 1.0, &elastic).1);
            let flown = state.plastic_strain;
            state = law.response(&f, 1.0, &state).1;
            let after = law.energy(&state);
            prop_assert!(after <= unrelaxed + 1e-14 && before >= 0.0 && state.plastic_strain >= flown);
            // Driven nowhere, it stays.
            let stays = law.response(&Matrix3::identity(), 1.0, &state).1;
            prop_assert!((stays.plastic_strain - state.plastic_strain).abs() < 1e-12);
        }
    }
}

#[test]
fn angles_and_cohesions_out_of_range_are_refused() {
    let new = |cohesion, angles| DruckerPrager::new(ELASTIC, cohesion, angles, Matched::PlaneStrain);
    for (cohesion, angles) in [
        (0.0, [0.0, 0.0]),
        (-1.0, [0.5, 0.0]),
        (f64::NAN, [0.5, 0.0]),
        (1.0, [-0.1, 0.0]),
        (1.0, [1.6, 0.0]),
        (1.0, [0.5, 0.6]),
        (1.0, [0.5, -0.1]),
        (1.0, [f64::NAN, 0.0]),
    ] {
        assert!(new(cohesion, angles).is_err(), "{cohesion} {angles:?}");
    }
    assert!(new(0.0, [0.5, 0.5]).is_ok());
}
