//! The consistent tangent against difference quotients.

use super::*;

/// Largest change of a component of ΔF.
const STEP: f64 = 1e-3;
/// Units in the last place by which rounding may move a stress.
const UNITS: f64 = 20.0;
/// Duration (s).
const DT: f64 = 1e-3;

/// By how much `f` multiplies rounding: by the condition of its left Cauchy–Green tensor in the inverse or logarithm of
/// that, by 1/J in what is a stress of the Kirchhoff stress, by J in a pressure K (J − 1).
fn condition(f: &Matrix3<f64>) -> f64 {
    let j = f.determinant();
    (f.norm() * f.try_inverse().unwrap().norm()).powi(2) * j.max(1.0 / j)
}

/// ∂σ/∂ΔF_ij is what central differences of three steps extrapolate to, as closely as the last extrapolation changes
/// it, and as rounding of the stress, in units of `scale` (Pa), allows at the smallest step. The stress beside
/// it has the bits of the update.
fn tangent_is_the_slope<M: Law>(law: &M, delta_f: &Matrix3<f64>, state: &M::State, scale: f64) {
    let tangent = super::tangent(law, delta_f, DT, state);
    let stress = |f: &Matrix3<f64>| law.response(f, DT, state).0;
    let slope = |k: usize| Matrix3::from_fn(|i, j| tangent.get(i, j).slope[k]);
    for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)] {
        assert_eq!(tangent.get(i, j).value, stress(delta_f).get(i, j));
    }
    for (i, j) in [0, 1, 2].into_iter().flat_map(|i| [(i, 0), (i, 1), (i, 2)]) {
        let quotient = |step: f64| {
            let mut change = Matrix3::zeros();
            change[(i, j)] = step;
            let ends = [delta_f + change, delta_f - change].map(|f| stress(&f).to_matrix());
            (ends[0] - ends[1]) / (2.0 * step)
        };
        let [coarse, middle, fine] = [STEP, STEP / 2.0, STEP / 4.0].map(quotient);
        let [first, second] = [(middle * 4.0 - coarse) / 3.0, (fine * 4.0 - middle) / 3.0];
        let exact = (second * 16.0 - first) / 15.0;
        let uncertain = (exact - second).norm() + UNITS * f64::EPSILON * scale / (STEP / 4.0);
        let error = (slope(3 * i + j) - exact).norm();
        assert!(error <= uncertain, "{i}{j}: off by {error}, known to {uncertain}");
    }
}

/// Without strain, with equal stretches, and far away: along axes and in planes, where some of σ vanishes but not its
/// derivative.
fn special() -> Vec<Matrix3<f64>> {
    let mut shear = Matrix3::identity();
    shear[(0, 1)] = 0.7;
    let axes =
        [[1.0, 1.0, 1.0], [1.0001, 1.0, 1.0], [1.2, 1.2, 1.2], [1.3, 1.3, 0.8], [0.2, 1.0, 5.0], [5.0, 0.2, 0.2]];
    let stretched = axes.map(|a| Matrix3::from_diagonal(&Vector3::from(a)));
    stretched.into_iter().chain([shear]).collect()
}

/// Stretches from 0.2 to 5 along any axes, and turned.
fn far() -> impl Strategy<Value = Matrix3<f64>> {
    let stretches = prop::array::uniform3(-5.0_f64.ln()..5.0_f64.ln());
    (rotations(), stretches, rotations())
        .prop_map(|(q, e, r)| q * Matrix3::from_diagonal(&Vector3::from(e).map(f64::exp)) * r)
}

/// Tangent of an elastic law after a deformation and a further one.
fn elastic<M: Law>(law: &M, first: &Matrix3<f64>, second: &Matrix3<f64>) {
    let scale = modulus(law) * condition(&(second * first));
    tangent_is_the_slope(law, second, &deform(law, first).1, scale);
}

macro_rules! every_law_has_a_tangent {
    ($name:ident, $law:expr) => {
        mod $name {
            use super::*;

            #[test]
            fn at_special_strains() {
                for f in special() {
                    elastic(&$law, &Matrix3::identity(), &f);
                    elastic(&$law, &f, &Matrix3::identity());
                }
            }

            proptest! {
                #[test]
                fn near_and_far(f in deformations(), g in deformations(), far in far()) {
                    elastic(&$law, &f, &g);
                    elastic(&$law, &Matrix3::identity(), &far);
                }
            }
        }
    };
}

every_law_has_a_tangent!(neo_hookean, NeoHookean { lambda: 5.0, mu: 2.0 });
every_law_has_a_tangent!(hencky_solid, HenckyJ2::new(70.0, 0.4, Strength::perfect(1e9).unwrap()).unwrap());
every_law_has_a_tangent!(hencky_law, Hencky::new(70.0, 0.4).unwrap());

proptest! {
    /// As far as pores stay open.
    #[test]
    fn of_a_porous_solid(f in deformations(), g in deformations()) {
        let law = ImprovedHencky::new(70.0, 40.0, 0.9).unwrap();
        elastic(&law, &f, &g);
    }
}

every_law_has_a_tangent!(inviscid_fluid, NewtonianFluid::new(5.0, 0.0).unwrap());

#[test]
fn of_a_viscous_fluid() {
    let law = NewtonianFluid::new(5.0, 0.3).unwrap();
    for f in special() {
        tangent_is_the_slope(&law, &f, &1.1, condition(&f) * (modulus(&law) + 0.6 / DT));
    }
}

#[test]
fn of_an_artificial_viscosity() {
    let own = NeoHookean { lambda: 5.0, mu: 2.0 };
    let law = Viscous::new(own, 1.0, 1e-3, [0.06, 1.5]).unwrap();
    let state = law.initial_state();
    let swells = |f: &Matrix3<f64>| (f.determinant() - 1.0).abs() > 1e-3;
    for f in special().into_iter().filter(swells) {
        tangent_is_the_slope(&law, &f, &state, condition(&f) * modulus(&law));
    }
}

/// Ground that yields at an elastic strain of half a percent.
fn strengths() -> [Strength; 3] {
    [
        Strength::perfect(0.4).unwrap(),
        Strength::softening(0.4, 0.024, 5.0).unwrap(),
        // Slopes change where the residual strength is reached: beyond what the paths here flow.
        Strength::softening_linearly(0.4, 0.01, 1e-3).unwrap(),
    ]
}

fn ground() -> [HenckyJ2; 3] {
    strengths().map(|strength| HenckyJ2::new(100.0, 0.3, strength).unwrap())
}

fn hypoelastic_ground() -> [HypoelasticJ2; 3] {
    let law = |strength| HypoelasticJ2::new(100.0, 0.3, JaumannUpdate::Split, strength).unwrap();
    strengths().map(law)
}

/// Tangent of ground that flows in the second deformation; whether it flows far enough to tell.
fn plastic<M: Law>(law: &M, first: &Matrix3<f64>, second: &Matrix3<f64>) -> bool {
    let before = deform(law, first).1;
    let after = law.response(second, DT, &before).1;
    let flow = law.plastic_strain(&after) - law.plastic_strain(&before);
    // Far enough from the yield surface for differences.
    if flow > 4.0 * STEP {
        tangent_is_the_slope(law, second, &before, modulus(law) * condition(second));
    }
    flow > 4.0 * STEP
}

/// Ground that has not yielded yet, the norm of whose deviator is zero.
#[test]
fn of_ground_at_rest() {
    for law in ground() {
        let initial = law.initial_state();
        tangent_is_the_slope(&law, &Matrix3::identity(), &initial, modulus(&law));
    }
}

#[test]
fn of_flow_along_axes_and_in_planes() {
    for law in ground() {
        let flows = |f: &&Matrix3<f64>| plastic(&law, &Matrix3::identity(), f);
        assert_eq!(special().iter().filter(flows).count(), 4);
    }
}

proptest! {
    #[test]
    fn of_flow(f in deformations(), g in deformations(), far in far()) {
        for law in ground() {
            prop_assume!(plastic(&law, &f, &g) && plastic(&law, &f, &far));
        }
        for law in hypoelastic_ground() {
            prop_assume!(plastic(&law, &f, &g));
        }
    }
}

/// Ground that yields as its pressure says, or is pulled beyond its tip.
fn frictional() -> [DruckerPrager; 3] {
    [[0.5, 0.5], [0.5, 0.1], [0.8, 0.0]]
        .map(|angles| DruckerPrager::new((100.0, 0.3), 0.3, angles, Matched::PlaneStrain).unwrap())
}

#[test]
fn of_friction_along_axes_and_in_planes() {
    for law in frictional() {
        let flows = |f: &&Matrix3<f64>| plastic(&law, &Matrix3::identity(), f);
        assert!(special().iter().filter(flows).count() >= 4);
    }
}

fn pyramids() -> [MohrCoulomb; 3] {
    [[0.5, 0.5], [0.5, 0.1], [0.8, 0.0]].map(|angles| MohrCoulomb::new((100.0, 0.3), 0.3, angles).unwrap())
}

/// Which of the differences between neighbouring principal stresses vanish: where the return changes from a plane to an
/// edge, or to the tip, slopes jump.
fn meeting<M: Law>(law: &M, delta_f: &Matrix3<f64>, state: &M::State) -> [bool; 2] {
    let principal = law.response(delta_f, DT, state).0.to_matrix().symmetric_eigenvalues();
    let mut sorted: [f64; 3] = principal.into();
    sorted.sort_by(f64::total_cmp);
    [sorted[1] - sorted[0], sorted[2] - sorted[1]].map(|apart| apart < 1e-9)
}

/// Tangent of ground within a pyramid that flows in the second deformation, as that changes to all sides, to the same
/// part of it; which one.
fn within_a_pyramid(law: &MohrCoulomb, first: &Matrix3<f64>, second: &Matrix3<f64>) -> Option<[bool; 2]> {
    let before = deform(law, first).1;
    let part = meeting(law, second, &before);
    let stays = (0..18).all(|k| {
        let mut change = Matrix3::zeros();
        change[k / 2] = if k % 2 == 0 { 1.5 * STEP } else { -1.5 * STEP };
        meeting(law, &(second + change), &before) == part
    });
    (stays && plastic(law, first, second)).then_some(part)
}

#[test]
fn of_a_pyramid_along_axes_and_in_planes() {
    for law in pyramids() {
        let pressed = Matrix3::from_diagonal(&Vector3::new(0.5, 1.2, 1.2));
        let all = special().into_iter().chain([pressed]);
        let parts: Vec<_> = all.filter_map(|f| within_a_pyramid(&law, &Matrix3::identity(), &f)).collect();
        for part in [[false, false], [true, false], [false, true], [true, true]] {
            assert!(parts.contains(&part), "{parts:?}");
        }
    }
}

/// Clay that yields and hardens or softens at strains of a few parts in a hundred.
fn clays() -> [CamClay; 3] {
    let elasticity = ImprovedHencky::new(70.0, 40.0, 0.9).unwrap();
    [(1.0, 1.0), (0.5, 0.8), (1.0, 0.6)].map(|(alpha, gamma)| {
        let law = CamClay::new(elasticity, 1.2, 0.4, 6.0, 3.0).unwrap();
        law.shaped(alpha, gamma).unwrap()
    })
}

/// Equal stretches under pressure, turned out of all planes, in which other digits are lost.
#[test]
fn of_clay_at_rest() {
    let turned = Rotation3::new(Vector3::new(0.3, 0.5, 0.7)).into_inner();
    for law in clays() {
        tangent_is_the_slope(&law, &turned, &law.initial_state(), modulus(&law));
    }
}

proptest! {
    #[test]
    fn of_friction(f in deformations(), g in deformations()) {
        for law in frictional() {
            // Where the return changes from the cone to its tip, slopes jump: deviators tell.
            let before = deform(&law, &f).1;
            let shear = |scale: f64| law.response(&(g * scale), DT, &before).0.deviator().norm();
            let [less, more] = [shear(1.0 - 4.0 * STEP), shear(1.0 + 4.0 * STEP)];
            prop_assume!((less > 0.1 && more > 0.1) || (less < 1e-9 && more < 1e-9));
            prop_assume!(plastic(&law, &f, &g));
        }
    }

    #[test]
    fn of_a_pyramid(f in deformations(), g in deformations()) {
        let parts = pyramids().map(|law| within_a_pyramid(&law, &f, &g));
        prop_assume!(parts.iter().any(Option::is_some));
    }

    #[test]
    fn of_clay_within_its_surface(f in deformations(), g in deformations()) {
        elastic(&strong_clay(), &f, &g);
    }

    #[test]
    fn of_clay_that_flows(f in deformations(), g in deformations()) {
        for law in clays() {
            prop_assume!(plastic(&law, &f, &g));
        }
    }
}

#[test]
fn strength_has_a_unit_of_stress() {
    for f in special() {
        for law in ground() {
            stress_has_the_unit_of_the_law(&law, &f);
        }
        for law in hypoelastic_ground() {
            stress_has_the_unit_of_the_law(&law, &f);
        }
    }
}
