//! The pyramid, on paths that have closed forms and beside projections in principal space.

use super::*;
use mpm_core::material::VolumetricState;

/// Young's modulus (Pa) and Poisson's ratio, and the moduli that follow.
const ELASTIC: (f64, f64) = (100.0, 0.3);
const SHEAR: f64 = 100.0 / 2.6;
const LAME: f64 = 30.0 / (1.3 * 0.4);
const BULK: f64 = 100.0 / 1.2;
const COHESION: f64 = 0.05;
/// Angles of friction and dilation (degrees).
const ANGLES: [[f64; 2]; 7] =
    [[30.0, 30.0], [30.0, 10.0], [30.0, 0.0], [10.0, 5.0], [45.0, 20.0], [60.0, 60.0], [0.0, 0.0]];
/// Largest error (Pa) of a stress that was trial less flow, of moduli times strains below one half: rounding of the left
/// Cauchy–Green tensor, whose condition is below eight, in a dozen operations.
const ROUNDING: f64 = 12.0 * 8.0 * f64::EPSILON * BULK;

fn ground([phi, psi]: [f64; 2]) -> MohrCoulomb {
    MohrCoulomb::new(ELASTIC, COHESION, [phi, psi].map(f64::to_radians)).unwrap()
}

fn sines(degrees: [f64; 2]) -> [f64; 2] {
    degrees.map(|angle| angle.to_radians().sin())
}

/// Kirchhoff's stress (Pa) of a state.
fn stress(state: &VolumetricState) -> Matrix3<f64> {
    let logarithm = state.elastic.ln();
    logarithm.to_matrix() * SHEAR + Matrix3::identity() * (0.5 * LAME * logarithm.trace())
}

/// Principal stresses (Pa) of principal logarithmic strains.
fn elastic(strain: Vector3<f64>) -> Vector3<f64> {
    strain * (2.0 * SHEAR) + Vector3::repeat(LAME * strain.sum())
}

fn stretches(axes: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(axes).map(f64::exp))
}

/// The state after `steps` equal increments of the logarithms of the stretches, which sum up to `strain`.
fn drive<M: Law>(law: &M, strain: [f64; 3], steps: usize) -> M::State {
    let f = stretches(strain.map(|axis| axis / steps as f64));
    (0..steps).fold(law.initial_state(), |state, _| law.response(&f, 1.0, &state).1)
}

/// The normal of the plane on which `greatest` and `least` are the extreme stresses.
fn normal(greatest: usize, least: usize, sine: f64) -> Vector3<f64> {
    let mut normal = Vector3::zeros();
    (normal[greatest], normal[least]) = (1.0 + sine, sine - 1.0);
    normal
}

/// 2 c cos φ (Pa).
fn strength([phi, _]: [f64; 2]) -> f64 {
    2.0 * COHESION * phi.to_radians().cos()
}

/// How far (Pa) a stress is beyond the plane that is nearest to it.
fn beyond(stress: &Matrix3<f64>, degrees: [f64; 2]) -> f64 {
    let principal = stress.symmetric_eigenvalues();
    let [phi, _] = sines(degrees);
    principal.max() * (1.0 + phi) - principal.min() * (1.0 - phi) - strength(degrees)
}

/// Strain along the normal of the flow: after yielding the stress stays, whatever the size of the step.
#[test]
fn flow_in_plane_strain_has_mohr_and_coulombs_stress() {
    for degrees in ANGLES {
        let [phi, psi] = sines(degrees);
        let along = normal(0, 1, psi);
        let exact = elastic(along) * (strength(degrees) / normal(0, 1, phi).dot(&elastic(along)));
        assert!(exact[2] < exact[0] && exact[2] > exact[1]);
        for steps in [1, 7, 100] {
            let (state, _) = drive(&ground(degrees), (along * 0.1).into(), steps);
            let error = (stress(&state) - Matrix3::from_diagonal(&exact)).norm();
            assert!(error < steps as f64 * ROUNDING, "{degrees:?}: {error}");
            assert!((state.plastic_volume - (0.2 * psi - exact.sum() / (3.0 * BULK))).abs() < 1e-13);
        }
    }
}

/// Simple shear in one step: the principal stretches are ±arsinh(γ/2), the axes at half the angle whose tangent is 2/γ.
#[test]
fn simple_shear_returns_to_a_plane() {
    for degrees in ANGLES {
        let [phi, psi] = sines(degrees);
        let shear = 0.02_f64;
        let mut f = Matrix3::identity();
        f[(0, 1)] = shear;
        let trial = elastic(Vector3::new(1.0, -1.0, 0.0) * (0.5 * shear).asinh());
        let (yields, flows) = (normal(0, 1, phi), elastic(normal(0, 1, psi)));
        let exact = trial - flows * ((yields.dot(&trial) - strength(degrees)) / yields.dot(&flows));
        let (mean, radius) = (0.5 * (exact[0] + exact[1]), 0.5 * (exact[0] - exact[1]));
        let law = ground(degrees);
        let s = stress(&law.response(&f, 1.0, &law.initial_state()).1.0);
        let angle = (2.0 / shear).atan();
        for (found, exact) in [
            (s[(0, 0)], mean + radius * angle.cos()),
            (s[(1, 1)], mean - radius * angle.cos()),
            (s[(0, 1)], radius * angle.sin()),
            (s[(2, 2)], exact[2]),
        ] {
            assert!((found - exact).abs() < ROUNDING, "{degrees:?}: {found} {exact}");
        }
    }
}

/// Uniaxial strain: elastic, then along the edge on which both other stresses are the greatest.
#[test]
fn an_oedometer_presses_along_an_edge() {
    for degrees in ANGLES {
        let [phi, psi] = sines(degrees);
        // Half of the flow on either plane.
        let [yields, flows] = [phi, psi].map(|sine| (normal(1, 0, sine) + normal(2, 0, sine)) * 0.5);
        for strain in [-1e-4, -0.01, -0.05] {
            let trial = elastic(Vector3::x() * strain);
            let flow = (yields.dot(&trial) - strength(degrees)) / yields.dot(&elastic(flows));
            let exact = trial - elastic(flows) * flow.max(0.0);
            for steps in [1, 7] {
                let (state, _) = drive(&ground(degrees), [strain, 0.0, 0.0], steps);
                let error = (stress(&state) - Matrix3::from_diagonal(&exact)).norm();
                assert!(error < steps as f64 * ROUNDING, "{degrees:?} {strain}: {error}");
            }
        }
    }
}

/// Two equal stresses, pressed, turned round and pulled apart: a cone through these edges has the same ones.
#[test]
fn triaxial_paths_are_those_of_the_cone_through_the_edges() {
    for degrees in ANGLES {
        for (matched, side) in [(Matched::Compression, -1.0), (Matched::Extension, 1.0)] {
            let pyramid = ground(degrees);
            let cone = DruckerPrager::new(ELASTIC, COHESION, degrees.map(f64::to_radians), matched).unwrap();
            let (mut own, mut other) = (pyramid.initial_state(), cone.initial_state());
            for (axial, lateral) in [(0.01, -0.004), (0.02, -0.02), (-1e-4, 0.0), (0.03, -0.01), (0.03, 0.01 * side)] {
                let f = stretches([side * axial, side * lateral, side * lateral]);
                own = pyramid.response(&f, 1.0, &own).1;
                other = cone.response(&f, 1.0, &other).1;
                let apart = (stress(&own.0) - stress(&other)).norm();
                assert!(apart < 5.0 * ROUNDING, "{degrees:?} {matched:?}: {apart}");
                assert!((own.0.plastic_strain - other.plastic_strain).abs() < 1e-13);
            }
        }
    }
}

/// Beyond the tip, at c cot φ, only the volume grows.
#[test]
fn ground_pulled_apart_ends_at_the_tip() {
    for degrees in ANGLES.into_iter().filter(|[phi, _]| *phi > 0.0) {
        let law = ground(degrees);
        let tip = COHESION / degrees[0].to_radians().tan();
        for strain in [[0.1, 0.15, 0.05], [0.1; 3]] {
            let (state, _) = drive(&law, strain, 5);
            assert!((stress(&state) - Matrix3::identity() * tip).norm() < 5.0 * ROUNDING);
            assert!((state.plastic_volume - (0.3 - tip / BULK)).abs() < 1e-13);
            let cauchy = law.response(&Matrix3::identity(), 1.0, &(state, 0.0)).0;
            assert!((cauchy.mean() - tip * (-0.3_f64).exp()).abs() < 5.0 * ROUNDING);
        }
    }
}

/// Principal stresses (Pa) that flow on one or two of the six planes leads to from `trial`, with the least of what is
/// left of the strength there and of the flow.
fn returns(trial: Vector3<f64>, degrees: [f64; 2]) -> Vec<(Vector3<f64>, f64)> {
    let planes = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];
    let [yields, flows] = sines(degrees).map(|sine| planes.map(|(i, j)| normal(i, j, sine)));
    let left = |stress: &Vector3<f64>, plane: usize| strength(degrees) - yields[plane].dot(stress);
    let stiffness = |i: usize, j: usize| yields[i].dot(&elastic(flows[j]));
    let mut found = Vec::new();
    for i in 0..6 {
        for j in i..6 {
            let [a, b] = [i, j].map(|plane| -left(&trial, plane));
            let determinant = stiffness(i, i) * stiffness(j, j) - stiffness(i, j) * stiffness(j, i);
            let flow = match i == j {
                true => [a / stiffness(i, i), 0.0],
                false => [stiffness(j, j) * a - stiffness(i, j) * b, stiffness(i, i) * b - stiffness(j, i) * a]
                    .map(|flow| flow / determinant),
            };
            let stress = trial - elastic(flows[i] * flow[0] + flows[j] * flow[1]);
            let least = (0..6).map(|plane| left(&stress, plane)).fold(f64::INFINITY, f64::min);
            if stress.iter().all(|s| s.is_finite()) {
                found.push((stress, least.min(flow[0] * SHEAR).min(flow[1] * SHEAR)));
            }
        }
    }
    found
}

/// Principal strains of which some may be equal or nearly so.
fn strains() -> impl Strategy<Value = Vector3<f64>> {
    let apart = prop_oneof![Just(0.0), (-16.0..-2.0_f64).prop_map(|digits| 10.0_f64.powf(digits)), -0.05..0.05_f64];
    (-0.05..0.05_f64, apart, -0.05..0.05_f64, 0..3_usize).prop_map(|(one, apart, other, place)| {
        let mut strain = [one, one + apart, other];
        strain.rotate_left(place);
        strain.into()
    })
}

/// The stress (Pa) along the axes `q` after a strain along them in one step from rest.
fn returned(strain: Vector3<f64>, q: &Matrix3<f64>, degrees: [f64; 2]) -> Matrix3<f64> {
    let law = ground(degrees);
    let f = q * stretches(strain.into()) * q.transpose();
    q.transpose() * stress(&law.response(&f, 1.0, &law.initial_state()).1.0) * q
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Associated flow ends at the point of the pyramid that is closest to the trial in the energy of the difference.
    #[test]
    fn associated_flow_ends_at_the_closest_point(strain in strains(), q in rotations(), phi in 1.0..60.0_f64) {
        let degrees = [phi, phi];
        let trial = elastic(strain);
        prop_assume!(beyond(&Matrix3::from_diagonal(&trial), degrees) > ROUNDING);
        let tip = Vector3::repeat(COHESION / phi.to_radians().tan());
        let energy = |stress: &Vector3<f64>| {
            let apart = stress - trial;
            (apart.norm_squared() - LAME / (3.0 * BULK) * apart.sum().powi(2)) / (4.0 * SHEAR)
        };
        let inside = |(stress, _): &(Vector3<f64>, f64)| {
            beyond(&Matrix3::from_diagonal(stress), degrees) < ROUNDING
        };
        let candidates = returns(trial, degrees).into_iter().filter(inside).map(|(stress, _)| stress).chain([tip]);
        let closest = candidates.min_by(|a, b| energy(a).total_cmp(&energy(b))).unwrap();
        let error = (returned(strain, &q, degrees) - Matrix3::from_diagonal(&closest)).norm();
        prop_assert!(error < 2.0 * ROUNDING / (1.0 - phi.to_radians().sin()), "{error}");
    }

    /// Any flow ends where none of the planes that it was on takes strain back, and else at the tip.
    #[test]
    fn flow_is_along_the_planes_it_ends_on(strain in strains(), q in rotations(), k in 0..7_usize) {
        let trial = elastic(strain);
        prop_assume!(beyond(&Matrix3::from_diagonal(&trial), ANGLES[k]) > ROUNDING);
        let of_flow = returns(trial, ANGLES[k]).into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        let expected = match of_flow {
            (stress, least) if least > -ROUNDING => stress,
            _ => Vector3::repeat(COHESION / ANGLES[k][0].to_radians().tan()),
        };
        let error = (returned(strain, &q, ANGLES[k]) - Matrix3::from_diagonal(&expected)).norm();
        prop_assert!(error < 10.0 * ROUNDING, "{error}");
    }

    /// On any path the stress stays on the pyramid or within, and flow takes energy.
    #[test]
    fn stress_stays_within_and_flow_takes_energy(steps in prop::collection::vec(deformations(), 1..6), k in 0..7_usize) {
        let (law, solid) = (ground(ANGLES[k]), Hencky::new(ELASTIC.0, ELASTIC.1).unwrap());
        let mut state = law.initial_state();
        let small = |f: &Matrix3<f64>| Matrix3::identity() + (f - Matrix3::identity()) * 0.1;
        for f in steps.iter().map(small) {
            let unrelaxed = solid.energy(&solid.response(&f, 1.0, &state.0.elastic).1);
            let flown = state.0.plastic_strain;
            state = law.response(&f, 1.0, &state).1;
            let off = beyond(&stress(&state.0), ANGLES[k]);
            prop_assert!(off < ROUNDING, "{off}");
            prop_assert!(law.energy(&state) <= unrelaxed + 1e-14 && state.0.plastic_strain >= flown);
            // Driven nowhere, it stays.
            let stays = law.response(&Matrix3::identity(), 1.0, &state).1;
            prop_assert!((stays.0.plastic_strain - state.0.plastic_strain).abs() < 1e-14);
            prop_assert!((stays.0.elastic.to_matrix() - state.0.elastic.to_matrix()).norm() < 1e-14);
        }
    }

    #[test]
    fn ground_that_flows_is_objective(f in deformations(), q in rotations(), k in 0..7_usize) {
        stress_turns_with_the_body(&ground(ANGLES[k]), &f, &q);
    }

    /// Some yield and some do not.
    #[test]
    fn eight_that_flow_are_as_one(
        f in prop::array::uniform8(deformations()),
        g in prop::array::uniform8(deformations()),
        size in prop::array::uniform8(-6.0..0.0_f64),
        k in 0..7_usize,
    ) {
        let [f, g] = [f, g].map(|gradients| std::array::from_fn(|i| {
            Matrix3::identity() + (gradients[i] - Matrix3::identity()) * 10.0_f64.powf(size[i])
        }));
        a_body_is_as_its_particles(&ground(ANGLES[k]), &f, &g);
    }
}

/// Stress that stays on a plane, in the axes of the strain: ∂σᵢ/∂εⱼ = (∂τᵢ/∂εⱼ)/J − σᵢ, of straight lines.
#[test]
fn slopes_on_a_plane_are_those_of_the_closed_form() {
    for degrees in ANGLES {
        let [yields, flows] = sines(degrees).map(|sine| normal(0, 2, sine));
        // Lode's angle is 20° from either edge, where the root that Newton's method finds is farthest from its start.
        for strain in [[9.4e-4, -1.7e-4, -7.7e-4], [7.7e-4, 1.7e-4, -9.4e-4]].map(Vector3::from) {
            let law = ground(degrees);
            let f = stretches(strain.into());
            let found = tangent(&law, &f, 1.0, &law.initial_state());
            let per_flow = elastic(flows) / yields.dot(&elastic(flows));
            for (i, j) in [0, 1, 2].into_iter().flat_map(|i| [(i, 0), (i, 1), (i, 2)]) {
                let elastic = elastic(Matrix3::identity().column(j).into_owned());
                let kirchhoff = elastic[i] - per_flow[i] * yields.dot(&elastic);
                let exact = kirchhoff / f.determinant() - found.get(i, i).value;
                let error = found.get(i, i).slope[4 * j] * f[(j, j)] - exact;
                assert!(error.abs() < 100.0 * ROUNDING, "{degrees:?} {strain} {i}{j}: {error}");
            }
        }
    }
}

proptest! {
    /// One that does not yield keeps its bits beside one that does, at strains whose series have as many terms.
    #[test]
    fn flow_leaves_neighbours_alone(gradient in prop::array::uniform9(-1e-4..1e-4_f64)) {
        let law = ground([30.0, 10.0]);
        let quiet = Matrix3::identity() + Matrix3::from_row_slice(&gradient);
        let flows = stretches([6e-4, -6e-4, 1e-4]);
        let beside = |other: Matrix3<f64>| {
            let particles = Particles::<3>::new(vec![[0.0; 3]; 8], 1.0, 1.0, [0.5; 3]).unwrap();
            let mut body = Bodies::new(shared(law), particles).unwrap();
            body.particles.delta_f.fill(quiet);
            body.particles.delta_f[3] = other;
            body.update_stress(1.0);
            body.particles.stress
        };
        let [alone, disturbed] = [quiet, flows].map(beside);
        prop_assert!(law.plastic_strain(&deform(&law, &flows).1) > 1e-5);
        prop_assert!((0..8).all(|k| (alone[k] == disturbed[k]) == (k != 3)));
    }
}

#[test]
fn angles_and_cohesions_out_of_range_are_refused() {
    let new = |cohesion, angles| MohrCoulomb::new(ELASTIC, cohesion, angles);
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

/// T (Pa) of the tests, below c cot φ at 30°.
const TENSION: f64 = 0.4 * COHESION;

fn cut_off(degrees: [f64; 2]) -> MohrCoulomb {
    ground(degrees).cut_off(TENSION).unwrap()
}

/// Pulled along one, two or three axes, in one step or seven: stresses along them are T, the others what elasticity leaves.
#[test]
fn ground_pulled_along_its_axes_has_the_tension() {
    for degrees in [[30.0, 30.0], [30.0, 0.0], [0.0, 0.0]] {
        for (pulled, strain) in [(1, [0.003, 0.0, 0.0]), (2, [0.003, 0.002, 0.0]), (3, [0.003, 0.002, 0.0015])] {
            let n = f64::from(pulled);
            // Elastic strain e along the axes that are pulled: (2G + nλ) e + λ of the others = T.
            let others: f64 = strain[pulled as usize..].iter().sum();
            let elastic_strain = (TENSION - LAME * others) / (2.0 * SHEAR + n * LAME);
            let across = LAME * (n * elastic_strain + others);
            let exact = Vector3::from_fn(|i, _| match i < pulled as usize {
                true => TENSION,
                false => across + 2.0 * SHEAR * strain[i],
            });
            assert!(beyond(&Matrix3::from_diagonal(&exact), degrees) < 0.0);
            for steps in [1, 7] {
                let (state, _) = drive(&cut_off(degrees), strain, steps);
                let error = (stress(&state) - Matrix3::from_diagonal(&exact)).norm();
                assert!(error < steps as f64 * ROUNDING, "{degrees:?} {pulled}: {error}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// A stress is beyond neither pyramid nor cut-off, flow takes energy, and where the way to the cut-off ends within the
    /// pyramid, it ends at the closest stress in the energy of the difference: no admissible one of many is closer.
    #[test]
    fn stress_stays_below_the_tension(strain in strains(), q in rotations(), k in 0..3_usize, s in strains()) {
        let degrees = [[30.0, 30.0], [30.0, 0.0], [0.0, 0.0]][k];
        let (law, trial) = (cut_off(degrees), elastic(strain));
        let f = q * stretches(strain.into()) * q.transpose();
        let state = law.response(&f, 1.0, &law.initial_state()).1.0;
        let found = stress(&state);
        let principal = found.symmetric_eigenvalues();
        prop_assert!(principal.max() - TENSION < ROUNDING && beyond(&found, degrees) < ROUNDING);
        let clipped = elastic(s).map(|s| s.min(TENSION));
        let energy = |stress: &Vector3<f64>| {
            let apart = stress - trial;
            (apart.norm_squared() - LAME / (3.0 * BULK) * apart.sum().powi(2)) / (4.0 * SHEAR)
        };
        let own = q.transpose() * found * q;
        let own = own.diagonal();
        if beyond(&found, degrees) < -ROUNDING {
            prop_assert!(energy(&own) <= energy(&clipped) + 1e-14);
        }
        if trial.max() < TENSION {
            let without = returned(strain, &q, degrees);
            prop_assert!((Matrix3::from_diagonal(&own) - without).norm() < ROUNDING);
        }
        let solid = Hencky::new(ELASTIC.0, ELASTIC.1).unwrap();
        let unrelaxed = solid.energy(&SymmetricTensor::symmetric_part(&(f * f.transpose())));
        prop_assert!(law.energy(&(state, 0.0)) <= unrelaxed + 1e-14);
    }

    #[test]
    fn ground_cut_off_and_softening_is_objective_and_eight_are_as_one(
        f in prop::array::uniform8(deformations()),
        g in prop::array::uniform8(deformations()),
        q in rotations(),
    ) {
        let law = softened().cut_off(TENSION).unwrap();
        stress_turns_with_the_body(&law, &f[0], &q);
        a_body_is_as_its_particles(&law, &f, &g);
    }
}

/// Residual cohesion (Pa) and angles (degrees), and the plastic strain at which they are reached.
const RESIDUAL: f64 = 0.3 * COHESION;
const RESIDUAL_ANGLES: [f64; 2] = [18.0, 0.0];
const SOFTENS: f64 = 0.05;

fn softened() -> MohrCoulomb {
    ground([30.0, 10.0]).softening(RESIDUAL, RESIDUAL_ANGLES.map(f64::to_radians), SOFTENS).unwrap()
}

/// Plane strain without a change of the flow's direction: after every step the stress is on the pyramid of the plastic
/// strain before it, and far beyond [`SOFTENS`] on the residual one.
#[test]
fn strength_falls_with_the_plastic_strain() {
    let law = softened();
    let f = stretches([1e-3, -1e-3, 0.0]);
    let mut state = law.initial_state();
    for _ in 0..200 {
        let left = (1.0 - state.0.plastic_strain / SOFTENS).max(0.0);
        state = law.response(&f, 1.0, &state).1;
        let [peak, residual] = [(30.0, COHESION), (RESIDUAL_ANGLES[0], RESIDUAL)].map(|(phi, c): (f64, f64)| {
            let phi = phi.to_radians();
            [phi.sin(), c * phi.cos()]
        });
        let [sine, c] = [0, 1].map(|k| residual[k] + (peak[k] - residual[k]) * left);
        let s = stress(&state.0).symmetric_eigenvalues();
        let off = s.max() * (1.0 + sine) - s.min() * (1.0 - sine) - 2.0 * c;
        assert!(state.0.plastic_strain == 0.0 || off.abs() < 200.0 * ROUNDING, "{off}");
    }
    assert!(state.0.plastic_strain > 2.0 * SOFTENS);
    // Dilation has ended: the volume changes elastically.
    let after = law.response(&f, 1.0, &state).1.0;
    assert!((after.plastic_volume - state.0.plastic_volume).abs() < 1e-13);
}

/// Particles with a share of the cohesion are those of a law with that cohesion, and begin under stresses that it bears.
#[test]
fn a_particle_has_its_own_cohesion() {
    let law = ground([0.0, 0.0]);
    let twice = MohrCoulomb::new(ELASTIC, 2.0 * COHESION, [0.0; 2]).unwrap();
    let own = |law: MohrCoulomb| {
        let particles = Particles::<3>::new(vec![[0.0; 3]; 2], 1.0, 1.0, [0.5; 3]).unwrap();
        Bodies::new(shared(law), particles).unwrap()
    };
    // A shear stress between the two strengths.
    let start = SymmetricTensor { xy: 1.5 * COHESION, ..SymmetricTensor::default() };
    let deformed = |bodies: Bodies<3>| {
        let mut bodies = bodies.under(|_, _| start).unwrap();
        bodies.particles.delta_f.fill(stretches([0.1, -0.1, 0.0]));
        bodies.update_stress(1.0);
        bodies.particles.stress
    };
    assert_eq!(deformed(own(law).stronger(|_| 2.0).unwrap()), deformed(own(twice)));
    assert!(own(law).under(|_, _| start).is_err());
    assert!(own(law).stronger(|_| 0.0).is_err());
    let elastic = Bodies::new(Hencky::new(1.0, 0.3).unwrap(), own(law).particles).unwrap();
    assert!(elastic.stronger(|_| 2.0).is_err());
}

#[test]
fn softening_and_tension_out_of_range_are_refused() {
    let law = ground([30.0, 10.0]);
    let radians = |degrees: [f64; 2]| degrees.map(f64::to_radians);
    assert!(law.softening(RESIDUAL, radians([31.0, 0.0]), 0.1).is_err());
    assert!(law.softening(RESIDUAL, radians([20.0, 11.0]), 0.1).is_err());
    assert!(law.softening(2.0 * COHESION, radians([30.0, 0.0]), 0.1).is_err());
    assert!(law.softening(RESIDUAL, radians([20.0, 0.0]), 0.0).is_err());
    assert!(law.softening(0.0, radians([0.0, 0.0]), 0.1).is_err());
    for tension in [-1.0, 1.001 * COHESION / 30.0_f64.to_radians().tan(), f64::NAN, f64::INFINITY] {
        assert!(law.cut_off(tension).is_err(), "{tension}");
    }
}
