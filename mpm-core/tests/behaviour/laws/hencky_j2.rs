//! J2 plasticity on Hencky's elasticity against closed forms.

use super::*;
use mpm_core::material::ElastoplasticState;
use std::iter::repeat_n;

/// Young's modulus, shear modulus (Pa), Poisson's ratio and κ of a body that yields at an elastic strain of half a percent.
const YOUNG: f64 = 100.0;
const SHEAR: f64 = YOUNG / 2.6;
const RATIO: f64 = 0.3;
const KAPPA: f64 = 0.4;

/// Perfect, softening exponentially and softening in a line.
fn strengths() -> [Strength; 3] {
    [
        Strength::perfect(KAPPA),
        Strength::softening(KAPPA, 0.06 * KAPPA, 5.0),
        Strength::softening_linearly(KAPPA, 0.06 * KAPPA, 2.0),
    ]
    .map(Result::unwrap)
}

fn of(strength: Strength) -> HenckyJ2 {
    HenckyJ2::new(YOUNG, RATIO, strength).unwrap()
}

fn perfect() -> HenckyJ2 {
    of(strengths()[0])
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

pub(super) fn increments(size: f64, most: usize) -> impl Strategy<Value = Vec<Matrix3<f64>>> {
    let gradient = prop::array::uniform9(-size..size);
    prop::collection::vec(gradient.prop_map(|a| Matrix3::identity() + Matrix3::from_row_slice(&a)), 1..most)
}

proptest! {
    /// A turned path gives turned stresses, wherever on the path the turning happens.
    #[test]
    fn rotations_turn_the_stress_and_nothing_else(path in increments(0.05, 20), q in rotations()) {
        for law in strengths().map(of) {
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

proptest! {
    #[test]
    fn flow_keeps_the_volume_dissipates_and_ends_on_the_surface(path in increments(0.05, 20)) {
        for (law, strength) in strengths().map(|strength| (of(strength), strength)) {
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
                let kappa = strength.at(state.plastic_strain).0;
                let norm = stress.deviator().norm() * determinant;
                // The stress that is returned, and the one of the state that is kept: with strains of half a
                // percent, rounding of b_e is 1e-14 of them.
                prop_assert!(norm <= kappa * (1.0 + 1e-12));
                if state.plastic_strain > before.plastic_strain {
                    prop_assert!((norm / kappa - 1.0).abs() < 1e-12);
                    let kept = SHEAR * state.elastic.ln().deviator().norm();
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
        for law in strengths().map(of) {
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
    let [_, softening @ ..] = strengths();
    for (strength, end) in softening.into_iter().flat_map(|strength| [0.01_f64, 0.1, 1.0].map(|end| (strength, end))) {
        let law = of(strength);
        let left =
            |plastic: f64| 2.0 * SHEAR * (2.0_f64.sqrt() * end - 1.5_f64.sqrt() * plastic) - strength.at(plastic).0;
        let (mut lo, mut hi) = (0.0, 2.0 * end);
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            *(if left(middle) > 0.0 { &mut lo } else { &mut hi }) = middle;
        }
        for steps in [1, 10, 1000] {
            let step = end / f64::from(steps);
            let (stress, state) = drive(&law, repeat_n(stretches([-step, step, 0.0]), steps as usize));
            assert!((state.plastic_strain - lo).abs() < 1e-12, "{steps} {end}");
            let kappa = strength.at(lo).0;
            assert!(((stress.yy - stress.xx) / (2.0_f64.sqrt() * kappa) - 1.0).abs() < 1e-10);
        }
    }
}

#[test]
fn flow_dissipates_its_strength() {
    for strength in strengths() {
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
    let law = of(strengths()[1]);
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
