//! Averages onto cells and hats: what A keeps, energy, and bodies that would lock.

use super::*;
use mpm_core::basis::{Basis, WallTreatment};
use mpm_core::order::stencil_order;
use mpm_core::projection::space;

const AVERAGED: [Remedy; 2] = [Remedy::Bbar, Remedy::FbarConsistent];
/// How nearly Newton's residuals fall by squares before rounding ends it.
const SQUARED: f64 = 1.7;

/// A number in (−1, 1), the same every time.
fn noise(k: usize) -> f64 {
    let x = (k as f64 * 12.9898).sin() * 43_758.547;
    2.0 * (x - x.floor()) - 1.0
}

/// A body whose particles lie in disorder, of volumes that differ; one axis is periodic.
fn disordered() -> Scene<2> {
    let axes = [Axis::walls(0.0, 5), Axis::periodic(0.0, 4)];
    let grid = Grid::new(H, axes).unwrap();
    let positions =
        (0..90).map(|k| [1, 2].map(|a| 0.5 + 0.49 * noise(2 * k + a))).map(|[x, y]| [5.0 * H * x, 4.0 * H * y]);
    let particles = Particles::new(positions.collect(), 0.01, 1000.0, [0.25 * H; 2]).unwrap();
    let particles = particles.deformed(|x| (*x, SMatrix::identity() * (1.0 + 0.1 * (9.0 * x[0]).sin())));
    Scene::new(grid, Bodies::new(NeoHookean::new(YOUNG, POISSON).unwrap(), particles).unwrap())
}

/// A `field` of the disordered body, as the stress that enters the forces has it of a mean stress; and volumes.
fn averaged<I: Interpolation<2>>(remedy: Remedy, onto: Onto, field: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut scene = disordered();
    let pressures = scene.bodies.particles.stress.iter_mut().zip(field);
    pressures.for_each(|(stress, q)| *stress = SymmetricTensor::default().scale_add_identity(1.0, *q));
    let settings = Settings::new(1.0).remedy(remedy).onto(onto);
    let mut solver = Solver::<2>::new::<I>(scene, settings).unwrap();
    let averaged = solver.force_stress().iter().map(|s| 0.5 * (s.xx + s.yy)).collect();
    (averaged, solver.particles().volume.clone())
}

/// A1 = 1 and (r, V A q) = (q, V A r).
fn keeps_constants_and_is_symmetric<I: Interpolation<2>>() {
    let n = disordered().bodies.particles.len();
    let [q, r] = [1, 1000].map(|seed| (0..n).map(|k| noise(seed + k)).collect::<Vec<_>>());
    for remedy in AVERAGED {
        for onto in [Onto::Basis, Onto::Hats, Onto::Cells] {
            let (ones, volume) = averaged::<I>(remedy, onto, &vec![1.0; n]);
            assert!(ones.iter().all(|v| (v - 1.0).abs() < 1e-12), "{remedy:?} {onto:?}");
            let [aq, ar] = [&q, &r].map(|field| averaged::<I>(remedy, onto, field).0);
            let product = |a: &[f64], b: &[f64]| -> f64 { (0..n).map(|p| volume[p] * a[p] * b[p]).sum() };
            let [left, right] = [product(&r, &aq), product(&q, &ar)];
            assert!((left - right).abs() < 1e-12 * product(&q, &q), "{remedy:?} {onto:?}: {left} {right}");
            assert!(left.abs() > 1e-3 * product(&q, &q));
        }
    }
}

#[test]
fn the_average_keeps_constants_and_is_symmetric() {
    keeps_constants_and_is_symmetric::<Means<2>>();
    keeps_constants_and_is_symmetric::<Quadratics<2>>();
}

/// Π onto cells and hats is that of explicit runs.
fn averages_as_explicit_runs_do<const S: usize, B: Basis<S>>()
where
    Lattice<2, S, B>: Interpolation<2>,
{
    let Scene { grid, bodies, .. } = disordered();
    let mut particles = bodies.particles;
    let field: Vec<f64> = (0..particles.len()).map(noise).collect();
    let lattice = Lattice::<2, S, B>::new(grid, WallTreatment::OpenKnot);
    let (order, slabs) = stencil_order(&lattice, &particles.position, &particles.half_size, false);
    particles.permute(&order);
    for onto in [Onto::Hats, Onto::Cells] {
        let mut explicit: Vec<f64> = order.iter().map(|k| field[*k as usize]).collect();
        let mut space = space::<2, S, B>(grid, WallTreatment::OpenKnot, Some(onto));
        space.find_reach(&particles, &slabs);
        space.average(&particles, &mut explicit);
        let (implicit, _) = averaged::<Lattice<2, S, B>>(Remedy::Bbar, onto, &field);
        for (k, explicit) in order.iter().zip(explicit) {
            assert!((implicit[*k as usize] - explicit).abs() < 1e-13, "{onto:?}");
        }
    }
}

#[test]
fn implicit_runs_average_as_explicit_ones() {
    averages_as_explicit_runs_do::<3, Gimp>();
    averages_as_explicit_runs_do::<4, CubicBSpline>();
}

/// The stiffness is assembled, so that one solution by factors an iteration is Newton's correction: residuals fall by
/// squares as long as it is the exact derivative.
fn newton_squares_its_error<const D: usize, I: Interpolation<D>, M: Law + Clone + 'static>(law: M) {
    for remedy in AVERAGED {
        let settings = Settings { tolerance: 1e-11, ..Settings::new(1.0).stabilised(Stabilisation::Ghost(0.01)) };
        let scene = standing::<D, _>(4, Places::Uniform, law.clone(), 1e4);
        let mut solver = Solver::<D>::new::<I>(scene, settings.remedy(remedy).onto(Onto::Cells)).unwrap();
        solver.step().unwrap();
        let (work, convergence) = (solver.work(), solver.convergence().unwrap());
        assert_eq!([work.linear_iterations, work.factorisations], [work.newton_iterations; 2]);
        assert_eq!(convergence.parts, 1);
        let near: Vec<f64> = convergence.residuals.iter().copied().filter(|r| *r < 0.1).collect();
        let order = |r: &[f64]| (r[2] / r[1]).ln() / (r[1] / r[0]).ln();
        let most = near.windows(3).map(order).fold(0.0, f64::max);
        assert!(most > SQUARED, "{remedy:?}: {:?}", convergence.residuals);
    }
}

#[test]
fn newton_needs_no_conjugate_gradients_onto_cells() {
    every_basis!(newton_squares_its_error, 2, NeoHookean::new(YOUNG, 0.45).unwrap());
}

/// Work of the stress that is not stored, over what is, of a box under its weight in this number of steps.
fn lacking<I: Interpolation<2>>(remedy: Remedy, onto: Onto, steps: u32) -> f64 {
    let scene = standing::<2, _>(4, Places::Uniform, NeoHookean::new(YOUNG, 0.45).unwrap(), 1e4);
    let settings = Settings { tolerance: 1e-11, ..Settings::new(1.0 / f64::from(steps)).remedy(remedy).onto(onto) };
    let mut solver = Solver::<2>::new::<I>(scene, settings).unwrap();
    solver.advance(steps as usize).unwrap();
    let totals = solver.totals();
    (totals.accumulated.stress_work / totals.stored_energy - 1.0).abs()
}

/// The force is the derivative of what is stored: what the trapezoidal rule misses is a sum of cubes of the steps.
#[test]
fn what_the_stress_does_is_stored() {
    for remedy in AVERAGED {
        for onto in [Onto::Hats, Onto::Cells] {
            for [coarse, fine] in [
                [8, 16].map(|steps| lacking::<Means<2>>(remedy, onto, steps)),
                [8, 16].map(|steps| lacking::<Quadratics<2>>(remedy, onto, steps)),
            ] {
                let ratio = coarse / fine;
                assert!(fine < 1e-3 && (ratio - 4.0).abs() < 0.4, "{remedy:?} {onto:?}: {coarse} {fine}");
            }
        }
    }
}

/// The midpoint rule, as without a remedy: ΔT and what stress does, with what the lumped mass takes, are nothing.
#[test]
fn a_tumbling_block_keeps_momentum_and_the_balance_of_energy() {
    for remedy in AVERAGED {
        for rule in [TimeRule::Midpoint { lumped: 0.05 }, TimeRule::Newmark { alpha: 0.25, delta: 0.5 }] {
            let settings = Settings { tolerance: 1e-12, ..Settings::new(0.01).rule(rule).remedy(remedy) };
            let scene = dynamics::tumbling(NeoHookean::new(YOUNG, 0.49).unwrap());
            let mut solver = Solver::<2>::new::<Means<2>>(scene, settings.onto(Onto::Cells)).unwrap();
            let before = solver.totals();
            solver.advance(5).unwrap();
            let after = solver.totals();
            for a in 0..2 {
                assert!((after.momentum[a] - before.momentum[a]).abs() < 1e-12 * before.momentum[0], "{rule:?}");
            }
            if let TimeRule::Midpoint { .. } = rule {
                let sums = after.accumulated;
                let gap = after.kinetic_energy - before.kinetic_energy + sums.stress_work + sums.lumping_loss;
                assert!(gap.abs() < 1e-8 * before.kinetic_energy, "{gap}");
            }
        }
    }
}

/// How far the end of a beam of four by one metres, fixed at the other, sinks under its weight.
fn sinks<I: Interpolation<2>>(poisson: f64, remedy: Remedy, onto: Onto) -> f64 {
    let axes = [Axis::bounded(0.0, 18, (Side::Wall, Side::Open)), Axis::open(0.0, 12)];
    let places = (0..256).map(|k| [0.5 * H * ((k % 32) as f64 + 0.5), 4.0 * H + 0.5 * H * ((k / 32) as f64 + 0.5)]);
    let particles = Particles::new(places.collect(), 0.25 * H * H, 1000.0, [0.25 * H; 2]).unwrap();
    let law = NeoHookean::new(YOUNG, poisson).unwrap();
    let scene = Scene::new(Grid::new(H, axes).unwrap(), Bodies::new(law, particles).unwrap())
        .constrain(Wall::new(0, End::Lo, WallKind::Fixed))
        .load(BodyForce(Box::new(|_, t| [0.0, -0.01 * t])));
    let settings = Settings::new(1.0).stabilised(Stabilisation::Ghost(1e-3)).remedy(remedy).onto(onto);
    let mut solver = Solver::<2>::new::<I>(scene, settings).unwrap();
    solver.step().unwrap();
    let p = solver.particles();
    (0..p.len()).map(|k| p.reference[k][1] - p.position[k][1]).fold(0.0, f64::max)
}

/// A slender beam in plane strain sinks by (1 − ν²)/E: nearly incompressible by 0.82 of its sinking at ν = 0.3. It locks
/// without a remedy.
#[test]
fn a_beam_is_freed() {
    let locked =
        sinks::<Means<2>>(0.4999, Remedy::None, Onto::Basis) / sinks::<Means<2>>(0.3, Remedy::None, Onto::Basis);
    assert!(locked < 0.5, "{locked}");
    for remedy in AVERAGED {
        let free = [
            sinks::<Means<2>>(0.4999, remedy, Onto::Cells) / sinks::<Means<2>>(0.3, remedy, Onto::Cells),
            sinks::<Quadratics<2>>(0.4999, remedy, Onto::Cells) / sinks::<Quadratics<2>>(0.3, remedy, Onto::Cells),
        ];
        assert!(free.iter().all(|ratio| (ratio / 0.82 - 1.0).abs() < 0.1), "{remedy:?}: {free:?}");
    }
}
