//! J2 plasticity on Hencky's elasticity against closed forms.

use super::*;
use std::iter::repeat_n;

/// Young's modulus, shear modulus (Pa), Poisson's ratio and κ of a body that yields at an elastic strain of half a percent.
const YOUNG: f64 = 100.0;
const SHEAR: f64 = YOUNG / 2.6;
const RATIO: f64 = 0.3;
const KAPPA: f64 = 0.4;

fn perfect() -> HenckyJ2 {
    HenckyJ2::new(YOUNG, RATIO, Strength::perfect(KAPPA).unwrap()).unwrap()
}

fn softening() -> HenckyJ2 {
    HenckyJ2::new(YOUNG, RATIO, Strength::softening(KAPPA, 0.06 * KAPPA, 5.0).unwrap()).unwrap()
}

fn softening_linearly() -> HenckyJ2 {
    HenckyJ2::new(YOUNG, RATIO, Strength::softening_linearly(KAPPA, 0.06 * KAPPA, 2.0).unwrap()).unwrap()
}

pub(super) fn stretches(logarithms: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(logarithms).map(f64::exp))
}

pub(super) fn sheared(tangent: f64) -> Matrix3<f64> {
    let mut f = Matrix3::identity();
    f[(0, 1)] = tangent;
    f
}

/// The last stress and state of a path from undeformed material.
pub(super) fn drive<M: Law>(law: &M, path: impl IntoIterator<Item = Matrix3<f64>>) -> (SymmetricTensor, M::State) {
    let start = (SymmetricTensor::default(), law.initial_state());
    path.into_iter().fold(start, |(_, state), increment| law.response(&increment, 1.0, &state))
}

fn increments(size: f64, most: usize) -> impl Strategy<Value = Vec<Matrix3<f64>>> {
    let gradient = prop::array::uniform9(-size..size);
    prop::collection::vec(gradient.prop_map(|a| Matrix3::identity() + Matrix3::from_row_slice(&a)), 1..most)
}

proptest! {
    /// A turned path gives turned stresses, wherever on the path the turning happens.
    #[test]
    fn rotations_turn_the_stress_and_nothing_else(path in increments(0.05, 20), q in rotations()) {
        for law in [perfect(), softening(), softening_linearly()] {
            let (stress, state) = drive(&law, path.iter().copied());
            let mut turned = path.clone();
            turned[0] *= q;
            let half = path.len() / 2;
            turned[half] = q * turned[half];
            for increment in &mut turned[half + 1..] {
                *increment = q * *increment * q.transpose();
            }
            let (found, after) = drive(&law, turned);
            let expected = q * stress.to_matrix() * q.transpose();
            prop_assert!((found.to_matrix() - expected).norm() < 1e-11 * YOUNG);
            prop_assert!((after.plastic_strain - state.plastic_strain).abs() < 1e-12);
        }
    }
}

/// Uniaxial strain keeps the direction of flow: exact for steps of any size.
#[test]
fn uniaxial_strain_follows_its_closed_form() {
    let law = perfect();
    let (bulk, shear) = (YOUNG / 1.2, SHEAR);
    for steps in [1, 7] {
        for end in [0.003_f64, 0.02, 0.5, -0.5] {
            let (stress, state) = drive(&law, repeat_n(stretches([end / f64::from(steps), 0.0, 0.0]), steps as usize));
            let elastic = 2.0 * shear * (2.0_f64 / 3.0).sqrt() * end.abs();
            let norm = elastic.min(KAPPA);
            let axial = bulk * end + (2.0_f64 / 3.0).sqrt() * norm * end.signum();
            assert!((stress.xx * end.exp() / axial - 1.0).abs() < 1e-12);
            let flow = (elastic - norm) / (2.0 * shear);
            let plastic = (2.0_f64 / 3.0).sqrt() * flow;
            assert!((state.plastic_strain - plastic).abs() < 1e-13);
        }
    }
}

/// Uniaxial tension without lateral stress, isochoric beyond yield except for elasticity: σ_y = √(3/2) κ. Driven by
/// strains that a uniaxial stress has: e = σ/E along, −νe across until yield; then (1, −½, −½).
#[test]
fn a_bar_yields_at_the_uniaxial_strength_of_the_convention() {
    let law = perfect();
    let strength = (1.5_f64).sqrt() * KAPPA;
    let yielding = strength / YOUNG;
    let elastic = stretches([yielding, -RATIO * yielding, -RATIO * yielding]);
    let flowing = stretches([0.05, -0.025, -0.025]);
    let (stress, state) = drive(&law, [elastic, flowing]);
    let determinant = ((1.0 - 2.0 * RATIO) * yielding).exp();
    assert!((stress.xx * determinant / strength - 1.0).abs() < 1e-12);
    assert!(stress.yy.abs() < 1e-12 * strength && stress.zz.abs() < 1e-12 * strength);
    assert!((state.plastic_strain - 0.05).abs() < 1e-12);
}

/// Plane-strain shortening of a body of undrained strength s_u carries a stress difference of 2 s_u.
#[test]
fn plane_strain_yields_at_the_undrained_strength() {
    let shear_strength = 0.2;
    let strength = Strength::undrained(shear_strength).unwrap();
    let law = HenckyJ2::new(YOUNG, RATIO, strength).unwrap();
    let (stress, _) = drive(&law, [stretches([-0.1, 0.1, 0.0])]);
    assert!((stress.yy - stress.xx - 2.0 * shear_strength).abs() < 1e-13);
    assert!(stress.zz.abs() < 1e-13 && stress.xy == 0.0);
}

/// Steady simple shear: with h = κ/(2√2 μ) the elastic stretch, principal axes at tan φ = e^(−2h), so that
/// τ_xy = κ/(√2 cosh 2h) and τ_xx = −τ_yy = κ tanh(2h)/√2. The return is of first order in the step.
#[test]
fn simple_shear_flows_at_its_closed_form_and_converges_with_first_order() {
    let law = perfect();
    let stretch = KAPPA / (8.0_f64.sqrt() * SHEAR);
    let exact = [KAPPA / (2.0_f64.sqrt() * (2.0 * stretch).cosh()), KAPPA * (2.0 * stretch).tanh() / 2.0_f64.sqrt()];
    let errors = [2e-3, 1e-3, 5e-4].map(|step| {
        let (stress, _) = drive(&law, repeat_n(sheared(step), (0.5_f64 / step).round() as usize));
        // Rounding of a thousand steps, times the modulus.
        assert!((stress.yy + stress.xx).abs() < 1e-10 && stress.zz.abs() < 1e-10);
        [stress.xy - exact[0], stress.xx - exact[1]]
    });
    for which in [0, 1] {
        let [coarse, middle, fine] = errors.map(|e| e[which].abs());
        assert!(coarse < [1e-5, 1e-3][which] * KAPPA, "{which}: {coarse}");
        for ratio in [coarse / middle, middle / fine] {
            assert!((1.9..2.15).contains(&ratio), "{which}: {ratio}");
        }
    }
}

/// Softening while the direction turns, in simple shear: of first order in the step. With steps of one
/// per mille of strain the error is below 10⁻⁵ κ_p.
#[test]
fn softening_under_turning_flow_is_of_first_order() {
    let law = softening();
    let shear = |step: f64| drive(&law, repeat_n(sheared(step), (0.2 / step).round() as usize));
    let values = [2e-3, 1e-3, 5e-4, 2.5e-4].map(|step| shear(step).0.xy);
    let differences = [0, 1, 2].map(|k| values[k + 1] - values[k]);
    for pair in differences.windows(2) {
        assert!((1.7..2.5).contains(&(pair[0] / pair[1])), "{differences:?}");
    }
    // Error at a step: the next difference, and the geometric series after it.
    assert!(2.0 * differences[1].abs() < 1e-5 * KAPPA, "{differences:?}");
}

#[test]
fn strengths_out_of_range_are_refused() {
    assert!(Strength::perfect(0.0).is_err() && Strength::perfect(f64::NAN).is_err());
    assert!(Strength::softening(1.0, 2.0, 1.0).is_err());
    assert!(Strength::softening(1.0, 0.0, 1.0).is_err());
    assert!(Strength::softening(1.0, 0.5, -1.0).is_err());
    assert!(Strength::softening_linearly(1.0, 0.5, 0.0).is_err());
    assert!(Strength::softening_linearly(1.0, 2.0, 1.0).is_err());
    let brittle = Strength::softening_linearly(1.0, 0.5, 1e4).unwrap();
    assert!(HenckyJ2::new(YOUNG, RATIO, brittle).is_err());
    let brittle = Strength::softening(1.0, 0.5, 1e4).unwrap();
    assert!(HenckyJ2::new(YOUNG, RATIO, brittle).is_err());
    assert!(HenckyJ2::new(YOUNG, 0.5, Strength::perfect(1.0).unwrap()).is_err());
}
