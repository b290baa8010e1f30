//! The solver as a whole: conservation, exact motions, errors.

use crate::scenes::{
    DENSITY, angular_momentum, block, law, open_grid, remedies, scene, scene_with, swirl, with_threads,
};
use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::contact::{Barrier, RigidContact, RigidFace};
use mpm_core::explicit::remedy::{Columns, Fbar, Filled, Form, Known, Mean, Onto, Standard};
use mpm_core::explicit::transfer::{Apic, Flip, Musl, Xpic};
use mpm_core::explicit::{Remedy, Settings, Solver, Transfer, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::parallel::CHUNK;
use mpm_core::simulation::Part;
use mpm_core::stage::Load;
use mpm_core::stage::{
    Amplitude, BodyForce, Constraint, End, Gravity, KineticDamping, LocalDamping, RigidNodes, Wall, WallKind,
};
use mpm_core::{Axis, Basis, Error, Fault, Grid, Memoryless, Particles, Side, Simulation};
use std::f64::consts::PI;

fn free_body_conserves<const D: usize, const S: usize, B: Basis<S> + 'static>() {
    conserves::<D, S, B, _>(&Flip::default(), false);
    conserves::<D, S, B, _>(&Apic, true);
    conserves::<D, S, B, _>(&Xpic::new(3).unwrap(), false);
    conserves::<D, S, B, _>(&Musl::default(), false);
}

fn conserves<const D: usize, const S: usize, B: Basis<S> + 'static, T: Transfer<D> + Clone>(
    transfer: &T,
    angular: bool,
) {
    for remedy in remedies::<D>() {
        let mut particles = block(0.5, 2, [4; D], [8; D]);
        swirl(&mut particles, 0.3);
        let (scene, mut settings) = scene_with(open_grid(0.5, 12), particles, transfer.clone());
        settings.remedy = remedy;
        let mut solver = Solver::<D, S, B, T>::new(scene, settings).unwrap();
        let before = solver.totals();
        let spin = angular_momentum(solver.particles());
        solver.advance(50).unwrap();
        let after = solver.totals();
        if angular {
            let now = angular_momentum(solver.particles());
            for (p, q) in spin.iter().flatten().zip(now.iter().flatten()) {
                // Arms of a few metres.
                assert!((p - q).abs() < 1e-10 * before.mass, "angular momentum {p} became {q}");
            }
        }
        assert_eq!(before.mass, after.mass);
        // Internal forces sum to zero at every step to rounding of forces of order E h^(D−1).
        for (p, q) in before.momentum.iter().zip(after.momentum) {
            assert!((p - q).abs() < 1e-11 * before.mass, "momentum {p} became {q}");
        }
    }
}

#[test]
fn a_free_body_keeps_mass_and_momentum_in_every_basis_dimension_and_remedy() {
    free_body_conserves::<1, 2, Linear>();
    free_body_conserves::<1, 4, CubicBSpline>();
    free_body_conserves::<2, 2, Linear>();
    free_body_conserves::<2, 3, Gimp>();
    free_body_conserves::<2, 3, QuadraticBSpline>();
    free_body_conserves::<2, 4, CubicBSpline>();
    free_body_conserves::<3, 3, Gimp>();
    free_body_conserves::<3, 4, CubicBSpline>();
}

#[test]
fn rigid_translation_is_exact_and_free_of_stress_across_cells_and_a_periodic_end() {
    for remedy in remedies::<2>() {
        let grid = Grid::new(0.5, [Axis::periodic(0.0, 8), Axis::open(0.0, 12)]).unwrap();
        let mut particles = block(0.5, 2, [1, 4], [7, 8]);
        particles.velocity.fill([3.0, 0.2]);
        let (scene, mut settings) = scene(grid, particles);
        settings.remedy = remedy;
        let dt = settings.dt;
        let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
        let steps = 400;
        solver.advance(steps).unwrap();
        let travelled = 3.0 * dt * steps as f64;
        assert!(travelled > 4.0, "the body must pass the periodic end");
        let p = solver.particles();
        for k in 0..p.len() {
            let x = (p.reference[k][0] + travelled).rem_euclid(4.0);
            let gap = (p.position[k][0] - x).abs();
            assert!(gap.min(4.0 - gap) < 1e-10);
            assert!(p.stress[k].trace().abs() < 1e-10);
            assert!((p.velocity[k][0] - 3.0).abs() < 1e-10);
        }
    }
}

#[test]
fn free_fall_is_exact() {
    // Symplectic Euler under a constant force: x_n = x_0 + g Δt² n (n + 1)/2, exactly.
    let (mut scene, settings) = scene(open_grid::<2>(0.5, 12), block(0.5, 2, [4, 5], [8, 9]));
    scene = scene.load(BodyForce(Box::new(|_, _| [0.0, -1.0])));
    let dt = settings.dt;
    let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
    solver.advance(100).unwrap();
    let drop = -dt * dt * 100.0 * 101.0 / 2.0;
    let p = solver.particles();
    for (x, reference) in p.position.iter().zip(&p.reference) {
        assert!((x[1] - reference[1] - drop).abs() < 1e-10);
        assert!((x[0] - reference[0]).abs() < 1e-10);
    }
}

/// The fundamental period of a bar held at one end and free at the other is 4L/c.
#[test]
fn a_bar_vibrates_at_its_fundamental_frequency() {
    let (h, cells) = (0.05, 20);
    let length = h * f64::from(cells);
    let grid = Grid::new(h, [Axis::bounded(0.0, 24, (Side::Wall, Side::Open))]).unwrap();
    let mut particles = block(h, 2, [0], [cells as usize]);
    let speed = 1e-4;
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        v[0] = speed * (0.5 * PI * x[0] / length).sin();
    }
    let (mut scene, settings) = scene(grid, particles);
    scene = scene.constrain(Wall::new(0, End::Lo, WallKind::Fixed));
    let dt = settings.dt;
    let period = 4.0 * length / law().wave_speed(DENSITY);
    let mut solver = Solver::<1, 3, QuadraticBSpline>::new(scene, settings).unwrap();
    let tip = |s: &Solver<1, 3, QuadraticBSpline>| {
        let p = s.particles();
        let last = (0..p.len()).max_by(|a, b| p.reference[*a][0].total_cmp(&p.reference[*b][0]));
        last.map(|k| p.position[k][0] - p.reference[k][0]).unwrap()
    };
    // Time of the first downward passage through zero: half a period.
    let (mut before, mut now) = (0.0, 0.0);
    while now >= 0.0 || solver.time() < 0.25 * period {
        solver.step().unwrap();
        before = now;
        now = tip(&solver);
    }
    let passage = solver.time() - dt * now / (now - before);
    // Second-order dispersion of 20 cells, (π h / 2 L)²/24 ≈ 3e-4, and the first-order half step of
    // the starting velocity, ½ Δt / (½ T) ≈ 4e-3.
    assert!((passage / (0.5 * period) - 1.0).abs() < 6e-3, "{passage} {period}");
}

#[test]
fn walls_hold_what_they_say() {
    let run = |kind| {
        let grid = Grid::new(0.5, [Axis::walls(0.0, 4), Axis::walls(0.0, 4)]).unwrap();
        let mut particles = block(0.5, 2, [0, 0], [4, 4]);
        particles.velocity.fill([0.1, 0.2]);
        let (mut scene, settings) = scene(grid, particles);
        let wall = |axis, end| -> Box<dyn Constraint<2>> { Box::new(Wall::new(axis, end, kind)) };
        scene.constraints = vec![wall(0, End::Lo), wall(0, End::Hi)];
        let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
        solver.step().unwrap();
        let p = solver.particles();
        // The particle in the corner cell nearest to the wall x = 0.
        let k = (0..p.len()).find(|k| p.reference[*k] == [0.125, 1.125]).unwrap();
        let (x, reference) = (p.position[k], p.reference[k]);
        let moved: [f64; 2] = std::array::from_fn(|a| x[a] - reference[a]);
        (moved, solver.totals().momentum)
    };
    let (rolling, momentum) = run(WallKind::Roller);
    let (fixed, _) = run(WallKind::Fixed);
    let dt = courant_time_step(0.3, 0.5, law().wave_speed(DENSITY));
    // A difference of places of order one.
    assert!((rolling[1] - 0.2 * dt).abs() < 1e-15, "rollers let slide");
    assert!(rolling[0] < 0.1 * dt && fixed[0] < 0.1 * dt, "both stop");
    assert!(fixed[1] < 0.2 * dt, "fixed walls let nothing slide");
    assert!((momentum[1] - 0.2 * 8.0).abs() < 1e-12);
}

#[test]
fn damping_takes_energy_and_says_how_much() {
    let run = |local: bool| {
        let mut particles = block(0.5, 2, [4, 4], [8, 8]);
        swirl(&mut particles, 0.01);
        let (scene, mut settings) = scene(open_grid::<2>(0.5, 12), particles);
        settings = match local {
            true => settings.filter_forces(LocalDamping::new(0.5).unwrap()),
            false => settings.filter_particles(KineticDamping::default()),
        };
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
        let before = solver.totals().kinetic_energy;
        solver.advance(200).unwrap();
        let t = solver.totals();
        let lost = before - t.kinetic_energy - t.stored_energy;
        (before, lost, t.accumulated.damping + t.accumulated.filter_loss)
    };
    for local in [true, false] {
        let (before, lost, accounted) = run(local);
        assert!(lost > 0.3 * before, "{local}: {lost} of {before}");
        assert!(accounted > 0.0 && accounted <= 1.2 * before, "{local}: {accounted} of {before}");
    }
    assert!(LocalDamping::new(1.0).is_err());
    assert!(LocalDamping::new(f64::NAN).is_err());
}

/// A body in a box has the same positions, work of its weight and force on the floor, whether nodes or particles take
/// the weight.
#[test]
fn nodes_take_the_weight_as_particles_do() {
    let run = |load: Box<dyn Load<2>>| {
        let particles = block(0.5, 2, [0, 0], [8, 6]);
        let grid = Grid::new(0.5, [Axis::walls(0.0, 8); 2]).unwrap();
        let (mut scene, settings) = scene(grid, particles);
        scene.loads.push(load);
        for axis in 0..2 {
            let kind = WallKind::Roller;
            scene = scene.constrain(Wall::new(axis, End::Lo, kind));
        }
        let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
        let forces = solver.particles().external_force.len();
        solver.advance(40).unwrap();
        let y: Vec<f64> = solver.particles().position.iter().map(|x| x[1]).collect();
        let floor = solver.on(Part::Constraint(1)).force[1];
        (forces, y, solver.totals().accumulated.load_work, floor)
    };
    let weight = |t: f64| [0.1 * t, -1.0 - t];
    let on_nodes = run(Box::new(Gravity(Box::new(weight))));
    let on_particles = run(Box::new(BodyForce(Box::new(move |_, t| weight(t)))));
    assert_eq!((on_nodes.0, on_particles.0), (0, on_particles.1.len()));
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-11, "{a} for {b}");
    for (a, b) in on_nodes.1.iter().zip(&on_particles.1) {
        near(*a, *b);
    }
    near(on_nodes.2, on_particles.2);
    near(on_nodes.3, on_particles.3);
    assert!(on_nodes.2 > 0.0 && on_nodes.3 < 0.0);
}

/// A long body that falls, with nodes enough for several threads: their energy is that of the particles, their
/// out-of-balance force what damping leaves of the weight, the power of damping the rest of it.
#[test]
fn sums_over_nodes_are_those_of_a_falling_body_however_many_nodes() {
    const ALPHA: f64 = 0.25;
    const SPEED: f64 = 0.5;
    const GRAVITY: f64 = 10.0;
    let mut particles = block(0.5, 2, [2, 4], [398, 8]);
    particles.velocity.fill([0.0, -SPEED]);
    let grid = Grid::new(0.5, [Axis::open(0.0, 400), Axis::open(0.0, 60)]).unwrap();
    let (mut scene, mut settings) = scene(grid, particles);
    scene = scene.load(Gravity(Box::new(|_| [0.0, -GRAVITY])));
    settings = settings.filter_forces(LocalDamping::new(ALPHA).unwrap());
    let dt = settings.dt;
    let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
    let weight = GRAVITY * solver.totals().mass;
    let (mut speed, mut damped) = (SPEED, 0.0);
    for _ in 0..3 {
        solver.step().unwrap();
        damped += dt * ALPHA * weight * speed;
        speed += dt * (1.0 - ALPHA) * GRAVITY;
        let (nodes, total) = (solver.residual(), solver.totals());
        for (sum, exact) in [
            (nodes.kinetic_energy, total.kinetic_energy),
            (nodes.kinetic_energy, 0.5 * total.mass * speed * speed),
            (nodes.free_force, (1.0 - ALPHA) * weight),
            (total.accumulated.damping, damped),
        ] {
            // Rounding of sums over 25 thousand nodes.
            assert!((sum / exact - 1.0).abs() < 1e-11, "{sum} for {exact}");
        }
    }
}

/// A body at v is stopped to w all over while g pulls: M (½ (v² − w²) + g Δt w) is what the constraint takes in the
/// first step, and M g Δt w, which it holds against the pull, in each of those after it.
#[test]
fn what_constraints_take_is_known() {
    let [v, w, g] = [2.0, 0.5, 3.0];
    let mut particles = block(0.5, 2, [4, 4], [8, 8]);
    particles.velocity.fill([v, 0.0]);
    let (scene, mut settings) = scene(open_grid::<2>(0.5, 12), particles);
    settings.remedy = Box::new(Standard);
    let plate = RigidNodes {
        extent: [[f64::NEG_INFINITY, f64::INFINITY]; 2],
        velocity: [Some(w), None],
        amplitude: Amplitude::Rise(0.0),
    };
    let scene = scene.load(Gravity(Box::new(move |_| [g, 0.0]))).constrain(plate);
    let dt = settings.dt;
    let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
    let mass = solver.totals().mass;
    let mut exact = 0.5 * mass * (v * v - w * w);
    for _ in 0..3 {
        solver.step().unwrap();
        exact += mass * g * dt * w;
        let taken = solver.totals().accumulated.constraint_loss;
        assert!((taken / exact - 1.0).abs() < 1e-12, "{taken} for {exact}");
    }
}

fn fault(change: impl FnOnce(&mut Particles<2>, &mut Settings<2>)) -> (u32, Fault) {
    let (mut scene, mut settings) = scene(open_grid::<2>(0.5, 12), block(0.5, 2, [4, 4], [8, 8]));
    change(&mut scene.bodies.particles, &mut settings);
    let outcome =
        Solver::<2, 3, Gimp>::new(scene, settings).and_then(|mut solver| (0..2000).try_for_each(|_| solver.step()));
    match outcome {
        Err(Error::Breakdown { particle, fault, time, .. }) => {
            assert!(time.is_finite());
            (particle, fault)
        }
        other => panic!("expected a breakdown, got {other:?}"),
    }
}

#[test]
fn breakdowns_are_typed_and_name_the_particle() {
    let (_, not_finite) = fault(|p, _| p.velocity[7] = [f64::NAN, 0.0]);
    let typed = matches!(not_finite, Fault::NotFinite { .. });
    assert!(typed, "{not_finite:?}");

    let (_, collapsed) = fault(|p, s| {
        // A velocity field that turns the body inside out within one step.
        let rate = -1.1 / s.dt;
        s.transfer = Flip::new(0.0).unwrap();
        s.dt *= 1e-3;
        for (v, x) in p.velocity.iter_mut().zip(&p.position) {
            *v = [1e3 * rate * (x[0] - 3.0), 0.0];
        }
    });
    let typed = matches!(collapsed, Fault::NonPositiveJacobian(j) if j <= 0.0);
    assert!(typed, "{collapsed:?}");

    let (_, gone) = fault(|p, _| p.velocity.fill([0.0, -5.0]));
    assert!(matches!(gone, Fault::OffGrid { axis: 1, .. }), "{gone:?}");

    let (_, unstable) = fault(|_, s| s.dt *= 4.0);
    assert!(matches!(unstable, Fault::UnstableTimeStep { cfl, .. } if cfl > 1.0));

    let (particle, outside) = fault(|p, _| p.position[3] = [-1.0, 2.0]);
    assert_eq!(particle, 3);
    assert!(matches!(outside, Fault::OffGrid { axis: 0, .. }));
}

#[test]
fn bad_input_is_refused_with_its_range() {
    let refuse = |change: fn(&mut Particles<2>, &mut Settings<2>)| {
        let (mut scene, mut settings) = scene(open_grid::<2>(0.5, 12), block(0.5, 2, [4, 4], [8, 8]));
        change(&mut scene.bodies.particles, &mut settings);
        let error = Solver::<2, 3, Gimp>::new(scene, settings).err().unwrap();
        assert!(matches!(error, Error::Input { .. }), "{error}");
    };
    refuse(|_, s| s.dt = 0.0);
    refuse(|_, s| s.dt = f64::NAN);
    refuse(|p, _| p.half_size = [0.3, 0.1]);
    for eta in [1.5, -0.1, f64::NAN] {
        assert!(matches!(Flip::new(eta), Err(Error::Input { .. })));
    }
    assert!(Xpic::new(0).is_err() && Xpic::new(6).is_err());
    assert!(Grid::new(0.0, [Axis::open(0.0, 8)]).is_err());
    assert!(Grid::new(1.0, [Axis::open(0.0, 3)]).is_err());
    assert!(Particles::new(vec![[f64::NAN]], 1.0, 1.0, [0.1]).is_err());
    assert!(Particles::new(vec![[0.0]], -1.0, 1.0, [0.1]).is_err());
}

/// A face that nothing touches keeps the averages of all particles apart from the pass. More particles than a pass takes
/// at once; some are sorted again on the way.
#[test]
fn averages_in_one_pass_have_the_bits_of_averages_over_all() {
    let run = |form: Form, far: bool, threads: usize| {
        let mut particles = block(0.5, 2, [4, 4], [24, 22]);
        swirl(&mut particles, 1.2);
        let (mut scene, settings) = scene(open_grid::<2>(0.5, 28), particles);
        if far {
            let barrier = Barrier::carrying_at(1.0, 0.1, 0.125).unwrap();
            scene = scene.contact(RigidContact::new(RigidFace::half_space(1, End::Lo, 0.0).unwrap(), barrier));
        }
        let remedy = Fbar::new(form).onto(Onto::Patches);
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings.remedy(Box::new(remedy))).unwrap();
        with_threads(threads, || solver.advance(40).unwrap());
        let (p, work) = (solver.particles().clone(), solver.work());
        assert!(p.len() > CHUNK && work.sorts > 1, "{} sorts", work.sorts);
        ((p.position, p.j_bar, p.stress), work.projections)
    };
    for form in [Form::Recursive, Form::Total, Form::Rate, Form::Bbar, Form::Consistent] {
        let (pass, counted) = run(form, false, 1);
        assert!(pass == run(form, true, 1).0, "{form:?}");
        assert!((pass, counted) == run(form, false, 3), "{form:?} on three threads");
        let each = if matches!(form, Form::Bbar) { 2 } else { 1 };
        assert!(counted == 40 * each || form == Form::Consistent, "{form:?}: {counted} averages");
    }
}

/// A remedy that changes the pressure of the force: here the force sees no mean stress at all.
struct WithoutPressure;

impl Memoryless for WithoutPressure {}

impl Remedy<2> for WithoutPressure {
    fn columns(&self, n: usize) -> Columns {
        Columns { next: vec![0.0; n], mean: vec![0.0; n], ..Columns::default() }
    }

    fn force_mean(&self, _: Known<'_>, filled: &mut Filled<'_>, average: Mean<'_>) {
        average(filled.mean);
    }

    fn next_j_bar(&self, known: Known<'_>, filled: &mut Filled<'_>, _: Mean<'_>) {
        filled.next.copy_from_slice(known.jacobian);
    }
}

#[test]
fn a_remedy_may_change_the_stress_that_enters_the_force() {
    // A uniform expansion has a mean stress only, so without it nothing decelerates.
    let run = |remedy: Box<dyn Remedy<2>>| {
        let mut particles = block(0.5, 2, [4, 4], [8, 8]);
        for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
            *v = [0.01 * (x[0] - 3.0), 0.01 * (x[1] - 3.0)];
        }
        let (mut scene, mut settings) = scene(open_grid::<2>(0.5, 12), particles);
        scene.bodies.each[0].law = NeoHookean { lambda: 100.0, mu: 1e-9 }.into();
        settings.remedy = remedy;
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
        let before = solver.totals().kinetic_energy;
        solver.advance(20).unwrap();
        (solver.totals().kinetic_energy / before, solver.work().projections)
    };
    let (decelerated, none) = run(Box::new(Standard));
    let (free, projections) = run(Box::new(WithoutPressure));
    assert!(decelerated < 0.9, "{decelerated}");
    // The plane part of the deviator of a plane expansion, of order μ, remains.
    assert!((free - 1.0).abs() < 1e-6, "{free}");
    assert_eq!((none, projections), (0, 20));
}
