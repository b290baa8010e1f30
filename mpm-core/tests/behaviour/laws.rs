//! The properties that every law must have.

use mpm_core::material::{
    Answers, CamClay, DruckerPrager, Hencky, HenckyJ2, Hypoelastic, HypoelasticJ2, ImprovedHencky, JaumannUpdate, Law,
    Matched, MohrCoulomb, NeoHookean, NewtonianFluid, State, Strength, Viscous, shared,
};
use mpm_core::monitor::Accumulated;
use mpm_core::number::{Dual, EIGHT, Eight};
use mpm_core::{Bodies, Particles, SymmetricTensor};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

mod cam_clay;
mod drucker_prager;
mod hencky_j2;
mod hypoelastic;
mod mohr_coulomb;
mod tangent;

/// Deformation gradients with stretches near one and a positive determinant.
fn deformations() -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform9(-0.2..0.2_f64).prop_map(|a| Matrix3::identity() + Matrix3::from_row_slice(&a))
}

fn rotations() -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform3(-3.0..3.0_f64).prop_map(|a| Rotation3::new(Vector3::from(a)).into_inner())
}

fn deform<M: Law>(law: &M, f: &Matrix3<f64>) -> (SymmetricTensor, M::State) {
    law.response(f, 1e-3, &law.initial_state())
}

/// Stress scale (Pa): the P-wave modulus.
fn modulus<M: Law>(law: &M) -> f64 {
    law.wave_speed(1.0).powi(2)
}

/// In units of a quarter of a pascal stress and energy have four times the number.
fn stress_has_the_unit_of_the_law<M: Law>(law: &M, f: &Matrix3<f64>) {
    let other = law.in_units(4.0);
    let [(own, of_own), (seen, of_seen)] = [deform(law, f), deform(&other, f)];
    let off = (seen.to_matrix() - own.to_matrix() * 4.0).norm();
    let scale = own.to_matrix().norm().max(modulus(law));
    assert!(off <= 1e-12 * scale, "{off}");
    let [energy, energy_seen] = [law.energy(&of_own), other.energy(&of_seen)];
    assert!((energy_seen - 4.0 * energy).abs() <= 1e-12 * modulus(law));
}

/// Cauchy stress from the stored energy: σ = (∂W/∂F) Fᵀ / J by central differences. With step d the
/// error is of order d² M from truncation and 1e-16 M/d from rounding: 1e-9 M at d = 1e-5.
fn stress_is_the_derivative_of_the_energy<M: Law>(law: &M, f: &Matrix3<f64>) {
    let d = 1e-5;
    let energy = |f: &Matrix3<f64>| law.energy(&deform(law, f).1);
    let first_piola = Matrix3::from_fn(|i, j| {
        let mut step = Matrix3::zeros();
        step[(i, j)] = d;
        (energy(&(f + step)) - energy(&(f - step))) / (2.0 * d)
    });
    let expected = first_piola * f.transpose() / f.determinant();
    let stress = deform(law, f).0.to_matrix();
    let error = (stress - expected).abs().max() / modulus(law);
    assert!(error < 1e-7, "stress {stress} but energy gives {expected}");
    let skew = (expected - expected.transpose()).abs().max() / modulus(law);
    assert!(skew < 1e-7, "stress is not symmetric: {expected}");
}

fn stress_turns_with_the_body<M: Law>(law: &M, f: &Matrix3<f64>, q: &Matrix3<f64>) {
    let turned = deform(law, &(q * f)).0.to_matrix();
    let expected = q * deform(law, f).0.to_matrix() * q.transpose();
    assert!((turned - expected).abs().max() < 1e-12 * modulus(law));
}

fn rest_is_free_of_stress<M: Law>(law: &M, q: &Matrix3<f64>) {
    let (stress, state) = deform(law, &Matrix3::identity());
    assert_eq!(stress, SymmetricTensor::default());
    assert_eq!(state, law.initial_state());
    assert_eq!(law.energy(&state), 0.0);
    let turned = deform(law, q).0.to_matrix();
    assert!(turned.abs().max() < 1e-12 * modulus(law));
}

/// A body at rest has the stress that ever slower deformation tends to.
fn rest_is_the_limit_of_slow_deformation<M: Law>(law: &M, f: &Matrix3<f64>) {
    let (stress, state) = law.at_rest(f);
    let (slow, after) = law.response(f, 1e30, &law.initial_state());
    assert!((stress.to_matrix() - slow.to_matrix()).abs().max() < 1e-15 * modulus(law));
    assert_eq!(state, after);
}

/// Two steps give what one gives: the state forgets nothing.
fn increments_compose<M: Law>(law: &M, first: &Matrix3<f64>, second: &Matrix3<f64>) {
    let half = deform(law, first).1;
    let stress = law.response(second, 1e-3, &half).0.to_matrix();
    let expected = deform(law, &(second * first)).0.to_matrix();
    assert!((stress - expected).abs().max() < 1e-11 * modulus(law));
}

/// The consistent tangent: the stress (Pa) and in `slope[3 i + j]` of its components the derivatives ∂σ/∂ΔF_ij.
fn tangent<M: Law>(law: &M, delta_f: &Matrix3<f64>, dt: f64, state: &M::State) -> SymmetricTensor<Dual<10>> {
    let mut row = [0.0; 16];
    M::State::write::<f64>(state, |i, number| row[i] = *number);
    Answers::stress(law, &Matrix3::from_fn(|i, j| Dual::variable(delta_f[(i, j)], 3 * i + j)), dt, &row)
}

/// The particles of a body, eight and three more, are as each of them alone, over two steps.
fn a_body_is_as_its_particles<M: Law + Copy + 'static>(law: &M, first: &[Matrix3<f64>; 8], second: &[Matrix3<f64>; 8]) {
    let particles = Particles::<3>::new(vec![[0.0; 3]; 11], 1.0, 1.0, [0.5; 3]).unwrap();
    let mut body = Bodies::new(shared(*law), particles).unwrap();
    let mut alone = [law.at_rest(&Matrix3::identity()); 11];
    for step in [first, second] {
        for (k, (stress, state)) in alone.iter_mut().enumerate() {
            body.particles.delta_f[k] = step[k % 8];
            (*stress, *state) = law.response(&step[k % 8], 1e-3, state);
        }
        body.update_stress(1e-3);
        for (k, (stress, _)) in alone.iter().enumerate() {
            let apart = (body.particles.stress[k].to_matrix() - stress.to_matrix()).abs().max();
            assert!(apart < 1e-13 * modulus(law), "{k}: {apart}");
        }
        let expected: f64 = alone.iter().map(|(_, state)| law.energy(state)).sum();
        let energy = body.totals(Accumulated::default()).stored_energy;
        assert!((energy - expected).abs() < 1e-12 * modulus(law));
    }
}

/// Stress and state of eight particles that deform by `delta_f` over a second: side by side, and each alone.
fn side_by_side<M: Law + 'static>(
    law: &M,
    delta_f: &[Matrix3<f64>; EIGHT],
    states: &mut [M::State; EIGHT],
) -> [[(SymmetricTensor, M::State); 2]; EIGHT] {
    let before = *states;
    let mut rows = Vec::new();
    before.iter().for_each(|state| M::State::write::<f64>(state, |_, number| rows.push(*number)));
    let entries: [_; 9] = std::array::from_fn(|n| Eight::new(delta_f.map(|f| f[(n / 3, n % 3)])));
    let mut stresses = [SymmetricTensor::default(); EIGHT];
    mpm_core::material::AnyLaw::update_eight(law, &entries, 1.0, Eight::ONE, &mut rows, &mut stresses);
    for (state, row) in states.iter_mut().zip(rows.chunks_exact(M::State::NUMBERS)) {
        *state = M::State::read(|i| row[i]);
    }
    std::array::from_fn(|k| [(stresses[k], states[k]), law.response(&delta_f[k], 1.0, &before[k])])
}

/// ρ₀ c² (Pa) of the pressure wave along `n`: J times the slope of the stress σ_nn in uniaxial strain. The present
/// stress adds σ_nn tr(n ⊗ n) − σ_nn = 0 to the slope of the force per area of the step's start.
fn modulus_along<M: Law>(law: &M, f: &Matrix3<f64>, n: &Vector3<f64>) -> f64 {
    // An hour: no viscosity acts.
    let tangent = tangent(law, &Matrix3::identity(), 3600.0, &deform(law, f).1);
    let mut sum = 0.0;
    for (i, j) in [0, 1, 2].into_iter().flat_map(|i| [(i, 0), (i, 1), (i, 2)]) {
        let component = tangent.get(i, j);
        for k in 0..9 {
            sum += n[i] * n[j] * component.slope[k] * n[k / 3] * n[k % 3];
        }
    }
    f.determinant() * sum
}

fn stated_modulus<M: Law>(law: &M, f: &Matrix3<f64>) -> f64 {
    let (stress, state) = deform(law, f);
    law.wave_modulus(f.determinant(), &stress, &state)
}

fn no_wave_is_faster_than_stated<M: Law>(law: &M, f: &Matrix3<f64>, n: &Vector3<f64>) {
    let stated = stated_modulus(law, f);
    let along = modulus_along(law, f, n);
    let bound = stated * (1.0 + 1e-12);
    assert!(along <= bound, "{along} along {n}, stated {stated}");
}

/// Pressed or stretched along an axis: the wave along it, or that across, has the stated speed.
fn a_wave_runs_at_the_stated_speed<M: Law>(law: &M) {
    for stretch in [0.7, 1.0, 1.3] {
        let f = Matrix3::from_diagonal(&Vector3::new(stretch, 1.0, 1.0));
        let of = [Vector3::x(), Vector3::y()].map(|n| modulus_along(law, &f, &n));
        let fastest = of[0].max(of[1]);
        assert!((stated_modulus(law, &f) / fastest - 1.0).abs() < 1e-12);
    }
}

/// Registers a law: all properties of one that is free of stress where it is undeformed, under the law's name.
macro_rules! every_law_must {
    ($name:ident, $law:expr) => {
        mod $name {
            use super::*;

            every_elastic_law_must!(elastic, $law);

            proptest! {
                #[test]
                fn rest_without_stress(q in rotations()) {
                    rest_is_free_of_stress(&$law, &q);
                }
            }
        }
    };
}

/// Registers a law: the properties that one has that may rest under a pressure.
macro_rules! every_elastic_law_must {
    ($name:ident, $law:expr) => {
        mod $name {
            use super::*;

            proptest! {
                #[test]
                fn derive_stress_from_energy(f in deformations()) {
                    stress_is_the_derivative_of_the_energy(&$law, &f);
                }

                #[test]
                fn be_objective(f in deformations(), q in rotations()) {
                    stress_turns_with_the_body(&$law, &f, &q);
                }

                #[test]
                fn rest_as_slow_deformation_ends(f in deformations()) {
                    rest_is_the_limit_of_slow_deformation(&$law, &f);
                }

                #[test]
                fn have_a_unit_of_stress(f in deformations()) {
                    stress_has_the_unit_of_the_law(&$law, &f);
                }

                #[test]
                fn treat_eight_as_one(
                    f in prop::array::uniform8(deformations()),
                    g in prop::array::uniform8(deformations()),
                ) {
                    a_body_is_as_its_particles(&$law, &f, &g);
                }

                #[test]
                fn bound_its_wave_speed(f in deformations(), q in rotations()) {
                    no_wave_is_faster_than_stated(&$law, &f, &q.column(0).into_owned());
                }

                #[test]
                fn compose_increments(f in deformations(), g in deformations()) {
                    increments_compose(&$law, &f, &g);
                }
            }

            #[test]
            fn know_its_wave_speed() {
                a_wave_runs_at_the_stated_speed(&$law);
            }
        }
    };
}

every_law_must!(neo_hookean, NeoHookean { lambda: 3.0, mu: 2.0 });
every_law_must!(nearly_incompressible_neo_hookean, NeoHookean::new(70.0, 0.499).unwrap());

// Flow is not elastic: what it does is tested in a file of each law.
every_law_must!(strong_hencky_solid, HenckyJ2::new(70.0, 0.4, Strength::perfect(1e9).unwrap()).unwrap());

every_law_must!(
    strong_ground_with_friction,
    DruckerPrager::new((70.0, 0.4), 1e9, [0.5, 0.3], Matched::Compression).unwrap()
);

every_law_must!(strong_ground_of_six_planes, MohrCoulomb::new((70.0, 0.4), 1e9, [0.5, 0.3]).unwrap());

every_law_must!(hencky_solid, Hencky::new(70.0, 0.4).unwrap());

every_law_must!(porous_solid, ImprovedHencky::new(70.0, 40.0, 0.9).unwrap());

/// Clay under pressure, far within its surface. Flow is tested in a file of its own.
fn strong_clay() -> CamClay {
    let elasticity = ImprovedHencky::new(70.0, 40.0, 0.99).unwrap();
    CamClay::new(elasticity, 50.0, 0.1, 1e9, 160.0).unwrap()
}

every_elastic_law_must!(strong_clay_under_pressure, strong_clay());

/// τ = K v/n − K v² (1 − n)/(2n²) in every direction, which keeps pores open: n = 1 − (1 − n₀)/J.
#[test]
fn pores_resist_all_the_more_the_less_is_left_of_them() {
    let (k, n0) = (5.0, 0.4);
    let law = ImprovedHencky::new(k, 2.0, n0).unwrap();
    let mut last = 0.0;
    for j in [1.3, 1.0, 0.8, 0.65, 0.61, 0.601_f64] {
        let f = Matrix3::identity() * j.cbrt();
        let mean = deform(&law, &f).0.mean();
        let (v, n) = (j.ln(), 1.0 - (1.0 - n0) / j);
        let exact = (k * v / n - 0.5 * k * v * v * (1.0 - n) / (n * n)) / j;
        let error = (mean / exact - 1.0).abs();
        assert!(error < 1e-9 || j == 1.0, "{mean} {exact}");
        assert!(mean < last || j >= 1.0);
        last = mean;
    }
    let closed = Matrix3::identity() * 0.59_f64.cbrt();
    assert!(deform(&law, &closed).0.mean().is_nan());
    assert!(last < -1e4 * k, "{last}");
    for (k, g, n) in [(0.0, 1.0, 0.5), (1.0, -1.0, 0.5), (1.0, 1.0, 0.0), (1.0, 1.0, 1.0), (1.0, 1.0, f64::NAN)] {
        assert!(ImprovedHencky::new(k, g, n).is_err());
    }
}

#[test]
fn the_rate_of_a_stress_has_waves_too() {
    for update in [JaumannUpdate::Split, JaumannUpdate::Linear] {
        a_wave_runs_at_the_stated_speed(&Hypoelastic::new(70.0, 0.4, update).unwrap());
    }
}

/// q = ρ h ε̇ (c₁ c + c₂ h ε̇), c² = 4/2, in compression and nowhere else; the law beside it is what it was.
#[test]
fn an_artificial_viscosity_resists_quick_compression_alone() {
    let own = NeoHookean { lambda: 2.0, mu: 1.0 };
    let law = Viscous::new(own, 2.0, 0.5, [0.1, 3.0]).unwrap();
    // Half of the volume is there: the density is twice that of undeformed material.
    let (state, dt) = (own.initial_state(), 1e-3);
    let squeezed = |rate: f64| {
        let mut f = Matrix3::identity();
        f[(0, 0)] = 1.0 - rate * dt;
        f
    };
    for rate in [-2.0, 0.0, 2.0_f64] {
        let f = squeezed(rate);
        let (stress, after) = law.response(&f, dt, &(state, 0.5 / f.determinant()));
        let (without, own_state) = own.response(&f, dt, &state);
        let compressed = rate.max(0.0);
        let q = 4.0 * 0.5 * compressed * (0.1 * 2.0_f64.sqrt() + 3.0 * 0.5 * compressed);
        let added = (stress.to_matrix() - without.to_matrix()).diagonal();
        assert!(added.iter().all(|added| (added + q).abs() < 1e-11), "{rate} {added} {q}");
        assert!(after.0 == own_state && law.energy(&after) == own.energy(&own_state));
        assert_eq!(law.at_rest(&f).0, own.at_rest(&f).0);
    }
    // In units of half a pascal all of it doubles.
    let of = |law: Viscous<_>| law.response(&squeezed(2.0), dt, &law.initial_state()).0.xx;
    assert!((of(law.in_units(2.0)) - 2.0 * of(law)).abs() < 1e-12);
    for (density, h, c) in
        [(0.0, 1.0, [0.0; 2]), (1.0, f64::NAN, [0.0; 2]), (1.0, 1.0, [-1.0, 0.0]), (1.0, 1.0, [0.0, f64::INFINITY])]
    {
        assert!(Viscous::new(own, density, h, c).is_err());
    }
}

// Viscosity is not elastic: what it adds is tested below.
every_law_must!(inviscid_fluid, NewtonianFluid::new(5.0, 0.0).unwrap());

#[test]
fn a_fluid_resists_the_rate_of_shear_and_of_nothing_else() {
    let law = NewtonianFluid::new(5.0, 0.3).unwrap();
    let dt = 1e-3;
    // Simple shear at the rate 2/s: σ_xy = μ γ̇, no pressure.
    let mut shear = Matrix3::identity();
    shear[(0, 1)] = 2.0 * dt;
    let (s, j) = law.response(&shear, dt, &1.0);
    assert!((s.xy - 0.6).abs() < 1e-12 && s.mean().abs() < 1e-12 && j == 1.0);
    // Dilation: pressure alone, whatever its rate.
    let (s, j) = law.response(&(Matrix3::identity() * 1.01), dt, &1.0);
    let pressure_part = 5.0 * (j - 1.0);
    assert!((j - 1.01_f64.powi(3)).abs() < 1e-15);
    for normal in [s.xx, s.yy, s.zz] {
        assert!((normal - pressure_part).abs() < 1e-12);
    }
    // The state remembers the volume, not the shear.
    let (s, _) = law.response(&Matrix3::identity(), dt, &j);
    assert!((s.mean() - pressure_part).abs() < 1e-15 && s.xy == 0.0);
    rest_is_the_limit_of_slow_deformation(&law, &(shear * 1.01));
    for (bulk_modulus, viscosity) in [(0.0, 0.0), (f64::NAN, 0.0), (1.0, -1.0), (1.0, f64::NAN)] {
        assert!(NewtonianFluid::new(bulk_modulus, viscosity).is_err());
    }
}

#[test]
fn neo_hookean_matches_its_closed_form_in_shear_and_uniaxial_strain() {
    let law = NeoHookean { lambda: 5.0, mu: 2.0 };
    let mut shear = Matrix3::identity();
    shear[(0, 1)] = 0.3;
    let s = deform(&law, &shear).0;
    for (value, exact) in [(s.xx, 2.0 * 0.09), (s.xy, 2.0 * 0.3), (s.yy, 0.0), (s.zz, 0.0)] {
        assert!((value - exact).abs() < 1e-14);
    }
    let stretch = Matrix3::from_diagonal(&Vector3::new(1.2, 1.0, 1.0));
    let s = deform(&law, &stretch).0;
    assert!((s.xx - (2.0 * (1.44 - 1.0) + 5.0 * 1.2_f64.ln()) / 1.2).abs() < 1e-14);
    assert!((s.zz - 5.0 * 1.2_f64.ln() / 1.2).abs() < 1e-14);
}

#[test]
fn elastic_constants_out_of_range_are_refused() {
    for (young, poisson) in
        [(0.0, 0.3), (f64::NAN, 0.3), (1.0, 0.5), (1.0, -1.0), (1.0, f64::NAN), (f64::INFINITY, 0.3)]
    {
        assert!(NeoHookean::new(young, poisson).is_err());
    }
}
