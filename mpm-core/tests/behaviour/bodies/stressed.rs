//! Bodies that begin under a stress.

use super::*;
use mpm_core::SymmetricTensor;
use mpm_core::material::{DruckerPrager, HenckyJ2, Matched, Strength};

const GRAVITY: f64 = 10.0;
/// Top of the ground (m).
const TOP: f64 = 4.0;

/// Stress of level ground, σ_h = K₀ σ_v.
fn geostatic(x: &[f64; 2], k0: f64) -> SymmetricTensor {
    let vertical = -DENSITY * GRAVITY * (TOP - x[1]);
    SymmetricTensor { xx: k0 * vertical, yy: vertical, zz: k0 * vertical, ..SymmetricTensor::default() }
}

fn ground<L: Into<mpm_core::material::SharedLaw>>(law: L, k0: f64) -> Result<Scene<2>, Error> {
    let soil = block::<2>(H, 2, [0, 0], [8, 8]);
    let bodies = Bodies::new(law, soil)?.under(|_, x| geostatic(x, k0))?;
    let axes = [Axis::walls(0.0, 8), Axis::bounded(0.0, 11, (Side::Wall, Side::Open))];
    let scene = Scene::new(Grid::new(H, axes)?, bodies).load(Gravity(Box::new(|_| [0.0, -GRAVITY])));
    let wall = |axis, end| Wall::new(axis, end, WallKind::Roller);
    Ok(scene.constrain(wall(0, End::Lo)).constrain(wall(0, End::Hi)).constrain(wall(1, End::Lo)))
}

/// Every law has the stress that it begins under, to rounding, and goes on from it.
#[test]
fn every_law_begins_under_the_stress_that_is_given() {
    let cohesive = DruckerPrager::new((1e4, 0.3), 0.0, [0.5, 0.1], Matched::PlaneStrain).unwrap();
    let laws: [mpm_core::material::SharedLaw; 5] = [
        Hencky::new(1e4, 0.3).unwrap().into(),
        NeoHookean::new(1e4, 0.3).unwrap().into(),
        HenckyJ2::new(1e4, 0.3, Strength::perfect(1e3).unwrap()).unwrap().into(),
        cohesive.into(),
        NewtonianFluid::new(1e5, 0.0).unwrap().into(),
    ];
    for (n, law) in laws.into_iter().enumerate() {
        // A fluid bears no difference of stresses.
        let k0 = if n == 4 { 1.0 } else { 0.5 };
        let scene = ground(law, k0).unwrap();
        let p = &scene.bodies.particles;
        for (x, s) in p.position.iter().zip(&p.stress) {
            assert_eq!(*s, geostatic(x, k0));
        }
        assert!(p.position.iter().zip(&p.reference).all(|(x, at)| x == at) && p.jacobian.iter().all(|j| *j == 1.0));
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings(400.0)).unwrap();
        solver.step().unwrap();
        let p = solver.particles();
        let apart = |(x, s): (&[f64; 2], &SymmetricTensor)| (s.to_matrix() - geostatic(x, k0).to_matrix()).norm();
        let most = p.position.iter().zip(&p.stress).map(apart).fold(0.0, f64::max);
        assert!(most < 0.05 * DENSITY * GRAVITY * H, "{n}: {most}");
    }
}

/// Ground that begins under its weight stays: GIMP and splines balance a linear stress within, and at the surface what a
/// row of particles of half a cell weighs is known to a share of itself.
#[test]
fn ground_begins_at_rest_under_its_weight() {
    let law = || DruckerPrager::new((1e4, 0.3), 1.0, [0.5, 0.0], Matched::PlaneStrain).unwrap();
    // Settlement of the ground under a weight that comes on: ρ g H²/(2 M).
    let modulus = 1e4 * 0.7 / (1.3 * 0.4);
    let settles = DENSITY * GRAVITY * TOP * TOP / (2.0 * modulus);
    let mut moved = [0.0; 2];
    fn farthest<B: Basis<3> + 'static>(scene: Scene<2>) -> f64 {
        let mut solver = Solver::<2, 3, B>::new(scene, settings(120.0)).unwrap();
        let mut most = 0.0_f64;
        while solver.time() < 2.0 {
            solver.step().unwrap();
            let p = solver.particles();
            let ways = p.position.iter().zip(&p.reference).map(|(x, from)| (x[0] - from[0]).hypot(x[1] - from[1]));
            most = ways.fold(most, f64::max);
        }
        most
    }
    moved[0] = farthest::<Gimp>(ground(law(), 0.5).unwrap());
    moved[1] = farthest::<QuadraticBSpline>(ground(law(), 0.5).unwrap());
    for moved in moved {
        told("movement of ground that begins under its weight (m)", moved, 0.0);
        // A cell of the surface that is out of balance by its own weight, over the ground's: h²/H².
        assert!(moved < settles * (H / TOP) * (H / TOP), "{moved} of {settles}");
    }
    let scene = ground(law(), 0.5).unwrap();
    let settings = implicit::Settings::new(1.0);
    let mut solver = implicit::Solver::<2>::new::<Lattice<2, 3, Gimp>>(scene, settings).unwrap();
    solver.step().unwrap();
    let p = solver.particles();
    let most = p.position.iter().zip(&p.reference).map(|(x, from)| (x[1] - from[1]).abs()).fold(0.0, f64::max);
    told("movement of the same in a static step (m)", most, 0.0);
    assert!(most < settles * (H / TOP) * (H / TOP), "{most} of {settles}");
}

#[test]
fn a_stress_seen_along_other_axes_is_the_same() {
    let scene = ground(Hencky::new(1e4, 0.3).unwrap(), 0.5).unwrap();
    let frame = Frame::along([(1, -1.0), (0, 1.0)]).in_units(3.0, 0.25);
    let seen = scene.bodies.seen_from(&frame).unwrap();
    for (own, turned) in scene.bodies.particles.stress.iter().zip(&seen.particles.stress) {
        let back = frame.stress_of_scene(turned);
        assert!((back.to_matrix() - own.to_matrix()).norm() < 1e-12 * (1.0 + own.norm()));
        assert!((turned.norm() - 0.25 * own.norm()).abs() < 1e-12 && turned.xx != own.xx * 0.25 || own.norm() == 0.0);
    }
}

#[test]
fn a_stress_beyond_the_strength_is_refused() {
    let weak = HenckyJ2::new(1e4, 0.3, Strength::perfect(1.0).unwrap()).unwrap();
    let refused = ground(weak, 0.5).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(refused.contains("at the start") && refused.contains("without flow"), "{refused}");
    // Above Rankine's active pressure, and below.
    let sand = || DruckerPrager::new((1e4, 0.3), 0.0, [0.5, 0.5], Matched::Compression).unwrap();
    let active = (1.0 - 0.5_f64.sin()) / (1.0 + 0.5_f64.sin());
    assert!(ground(sand(), 1.02 * active).is_ok());
    assert!(ground(sand(), 0.98 * active).is_err());
    assert!(ground(NewtonianFluid::new(1e5, 0.0).unwrap(), 0.5).is_err());
}
