//! Coulomb friction: its tangent, rest without creep, and a block on a slope that slides at its angle.

use super::contact::{DISTANCE, floor, rubber, tangent_has_contact};
use super::stiffness::REMEDIES;
use super::*;
use crate::contact::{Barrier, Friction, RigidContact};
use crate::simulation::Part;
use crate::stage::Amplitude;
use crate::stage::Gravity;

pub(super) const MU: f64 = 0.3;
/// Mass of a block (kg/m), whose weight is that of a gravity of 1 m/s² across the slope.
pub(super) const MASS: f64 = 1e3 * (H * CELLS as f64) * (H * CELLS as f64);
/// Load (N/m) of each particle that touches the slope, at half of the barrier's distance.
const EACH: f64 = MASS / (2 * CELLS) as f64;
pub(super) const TOLERANCE: f64 = 1e-12;
pub(super) const MIDPOINT: TimeRule = TimeRule::Midpoint { lumped: 0.1 };
pub(super) const NEWMARK: TimeRule = TimeRule::Newmark { alpha: 0.25, delta: 0.5 };

type Block = Solver<2>;

#[test]
fn the_tangent_of_a_stick_is_the_slope_of_its_forces() {
    let rough = Some(Friction::rough(3e3).unwrap());
    for remedy in [REMEDIES[0], REMEDIES[1], REMEDIES[4]] {
        every_basis!(tangent_has_contact, 2, rubber(), remedy, rough);
    }
    tangent_has_contact::<3, Means<3>, _>(rubber(), REMEDIES[0], rough);
}

#[test]
fn the_tangent_of_a_slip_is_the_slope_of_its_forces() {
    // μN/k_t is at most a few tenths of the stretch.
    let slippery = Some(Friction::new(MU, 1e6).unwrap());
    every_basis!(tangent_has_contact, 2, rubber(), REMEDIES[0], slippery);
    tangent_has_contact::<3, Means<3>, _>(rubber(), REMEDIES[0], slippery);
}

/// The stiffness of a stick (N/m), as that of the barrier where it works.
pub(super) fn stick(barrier: Barrier) -> f64 {
    barrier.stiffness(0.5 * DISTANCE)
}

/// A block on a slope whose tangent is `slope` from the time one (s) on and zero before, with 1 m/s² across it.
pub(super) fn block(slope: f64, friction: impl Fn(f64) -> Friction, settings: Settings) -> Block {
    let axes = [8 * CELLS, CELLS + 4].map(|cells| Axis::open(-2.0 * H, cells));
    let scene = filled(axes, CELLS, rubber());
    let contact = floor(&scene.bodies.particles, 0.5 * DISTANCE, EACH);
    let friction = friction(stick(contact.barrier()));
    let gravity = move |t: f64| [if t > 1.0 { slope } else { 0.0 }, -1.0];
    let settings = Settings { tolerance: TOLERANCE, ..settings.stabilised(Stabilisation::Ghost(1e-3)) };
    let scene = scene.contact(contact.with_friction(friction)).load(Gravity(Box::new(gravity)));
    Solver::new::<Quadratics<2>>(scene, settings).unwrap()
}

pub(super) fn coulomb(stiffness: f64) -> Friction {
    Friction::new(MU, stiffness).unwrap()
}

/// A block that rests under its weight at the time one (s).
fn resting(slope: f64) -> Block {
    let mut solver = block(slope, coulomb, Settings::new(1.0));
    solver.step().unwrap();
    solver
}

/// Static steps until one finds equilibrium as it is: particles that have moved see other values of the functions.
pub(super) fn settle(solver: &mut Block) {
    for _ in 0..20 {
        solver.step().unwrap();
        if solver.convergence().unwrap().residuals.len() == 1 {
            return;
        }
    }
    panic!("it doesn't come to rest");
}

/// Goes on by another rule, from rest.
fn go_on(solver: &mut Block, rule: TimeRule, dt: f64) {
    solver.settings = Settings { dt, ..solver.settings.rule(rule) };
    let particles = &mut solver.scene.bodies.particles;
    particles.velocity = vec![[0.0; 2]; particles.len()];
    particles.acceleration = particles.velocity.clone();
}

/// By id.
pub(super) fn places(solver: &Block) -> Vec<[f64; 2]> {
    let particles = solver.particles();
    particles.seeded(|k| particles.position[k])
}

/// A step leaves a residual force of Newton's tolerance, which all touching sticks hold: no step has moved the block by
/// more than that force stretches them.
pub(super) fn has_rested(solver: &Block, before: &[[f64; 2]], steps: usize) {
    let stiffness = (2 * CELLS) as f64 * stick(solver.scene.contacts[0].barrier());
    let bound = steps as f64 * TOLERANCE * MASS / stiffness;
    for (x, before) in places(solver).iter().zip(before) {
        let moved = (x[0] - before[0]).abs();
        assert!(moved <= bound, "{:?}: {moved} {bound}", solver.settings.rule);
    }
}

#[test]
fn below_the_angle_of_friction_a_block_rests_and_does_not_creep() {
    for share in [0.5, 0.9] {
        for rule in [TimeRule::Static, MIDPOINT, NEWMARK] {
            let slope = share * MU;
            let mut solver = resting(slope);
            settle(&mut solver);
            let force = solver.on(Part::Contact(0)).force;
            assert!((force[0] - slope * MASS).abs() < 1e-9 * MASS, "{force:?}");
            assert!((force[1] + MASS).abs() < 1e-9 * MASS, "{force:?}");
            go_on(&mut solver, rule, 0.02);
            let before = places(&solver);
            solver.advance(50).unwrap();
            has_rested(&solver, &before, 50);
        }
    }
}

/// No stick holds more than μ times what its particle presses.
fn slips_within_coulombs_law(solver: &Block) {
    let contact = &solver.scene.contacts[0];
    let friction = contact.friction().unwrap();
    let particles = solver.particles();
    for (x, id) in particles.position.iter().zip(&particles.id) {
        let gap = contact.face().gap(x).unwrap();
        let held = friction.stiffness() * contact.sticks()[*id as usize][0].abs();
        let normal = contact.barrier().force(gap);
        assert!(held <= MU * normal * (1.0 + 1e-9), "{held} {normal}");
    }
}

/// Σ friction is μ Σ N where all particles slip. So the mean acceleration along the slope is g_x − μ (g_y + Δv_y/T),
/// and a block that stays on the face swings by no more than a fall of 1/ω from rest gives, ω² = ΣB″/m: |Δv_y| ≤ 2
/// g_y/ω.
#[test]
fn beyond_the_angle_of_friction_a_block_slides_at_its_acceleration() {
    let slope = 2.0 * MU;
    for (rule, dt, steps) in [(MIDPOINT, 0.02, 300), (NEWMARK, 0.01, 80)] {
        let mut solver = resting(slope);
        go_on(&mut solver, rule, dt);
        solver.advance(20).unwrap();
        let (early, start) = (solver.totals().momentum, solver.time());
        let impulse = solver.on(Part::Contact(0)).impulse;
        for _ in 0..steps {
            solver.step().unwrap();
            slips_within_coulombs_law(&solver);
            let convergence = solver.convergence().unwrap();
            assert_eq!(convergence.parts, 1);
            let order = |r: &[f64]| (r[2] / r[1]).ln() / (r[1] / r[0]).ln();
            let orders = convergence.residuals.windows(3).map(order);
            // Two, less what the rounding of the last residual takes.
            assert!(orders.fold(0.0, f64::max) > 1.6);
        }
        let (late, time) = (solver.totals().momentum, solver.time() - start);
        let after = solver.on(Part::Contact(0)).impulse;
        let given = [0, 1].map(|a| after[a] - impulse[a]);
        assert!((given[0] + MU * given[1]).abs() < 1e-12 * MASS * time);
        let acceleration = (late[0] - early[0]) / (MASS * time);
        let stiffness = (2 * CELLS) as f64 * stick(solver.scene.contacts[0].barrier());
        let swing = 2.0 * MU * (MASS / stiffness).sqrt() / time;
        let exact = slope - MU;
        assert!((acceleration - exact).abs() < swing, "{acceleration}");
    }
}

/// No equilibrium exists, the state stays as it was, and goes on dynamically.
#[test]
fn beyond_the_angle_of_friction_a_static_step_is_a_typed_error() {
    let mut solver = resting(1.1 * MU);
    let (before, contact) = (places(&solver), solver.scene.contacts[0].clone());
    let error = solver.step().unwrap_err();
    let typed = matches!(error, Error::NoConvergence { .. } | Error::Singular { .. });
    assert!(typed, "{error}");
    assert_eq!(before, places(&solver));
    assert_eq!(contact, solver.scene.contacts[0]);
    go_on(&mut solver, MIDPOINT, 0.01);
    solver.advance(20).unwrap();
    assert!(solver.totals().momentum[0] > 0.0);
}

#[test]
fn a_sliding_block_that_was_stopped_goes_on_as_if_it_had_not() {
    let fresh = || block(2.0 * MU, coulomb, Settings::new(0.25).rule(MIDPOINT));
    let mut straight = fresh();
    straight.advance(5).unwrap();
    let saved = straight.save().unwrap();
    straight.advance(5).unwrap();
    let mut resumed = fresh();
    resumed.restore(&saved).unwrap();
    resumed.advance(5).unwrap();
    assert_eq!(straight.save().unwrap(), resumed.save().unwrap());
    assert_eq!(straight.scene.contacts, resumed.scene.contacts);
}

/// Sticks take a block along that nothing holds else, without a force.
#[test]
fn a_rough_face_that_moves_along_itself_takes_a_block_with_it() {
    let speed = 0.1 * H;
    let mut solver = block(0.0, |k| Friction::rough(k).unwrap(), Settings::new(1.0));
    settle(&mut solver);
    let contact = &solver.scene.contacts[0];
    let face = contact.face().clone().moving([speed, 0.0], Amplitude::Rise(0.0)).unwrap();
    let moving = RigidContact::new(face, contact.barrier());
    let mut moving = moving.with_friction(contact.friction().unwrap());
    moving.attach(solver.particles().len());
    moving.stick((0..).zip(contact.sticks().iter().copied()));
    solver.scene.contacts[0] = moving;
    let before = places(&solver);
    solver.step().unwrap();
    for (x, before) in places(&solver).iter().zip(&before) {
        assert!((x[0] - before[0] - speed).abs() < 1e-9 * speed);
        assert!((x[1] - before[1]).abs() < 1e-9 * speed);
    }
    assert!(solver.on(Part::Contact(0)).force[0].abs() < 1e-9 * MASS);
}

/// One that never slips is stretched by what its particle moves in the whole of a step, wherever the equations hold.
#[test]
fn a_stick_remembers_the_whole_of_a_step() {
    for rule in [TimeRule::Static, MIDPOINT, NEWMARK] {
        let mut solver = block(MU, |k| Friction::rough(k).unwrap(), Settings::new(1.0));
        solver.step().unwrap();
        go_on(&mut solver, rule, 0.02);
        let (before, sticks) = (places(&solver), solver.scene.contacts[0].sticks().to_vec());
        solver.step().unwrap();
        let contact = &solver.scene.contacts[0];
        let mut touching = 0;
        for ((x, before), (stick, first)) in
            (places(&solver).iter().zip(before)).zip(contact.sticks().iter().zip(sticks))
        {
            if contact.face().gap(x).unwrap() < DISTANCE {
                let (moved, stretched) = (x[0] - before[0], stick[0] - first[0]);
                assert!(moved.abs() > 1e-6 && (moved - stretched).abs() < 1e-14);
                touching += 1;
            }
        }
        assert_eq!(touching, 2 * CELLS);
    }
}

#[test]
fn a_stick_that_touches_nothing_is_forgotten() {
    let mut solver = block(0.0, coulomb, Settings::new(1.0));
    let contact = &mut solver.scene.contacts[0];
    contact.stick([(1, [0.1, 0.0]), (3, [0.2, 0.0])].into_iter());
    contact.stick([(3, [0.3, 0.0])].into_iter());
    let held: Vec<f64> = contact.sticks()[..4].iter().map(|u| u[0]).collect();
    assert_eq!(held, [0.0, 0.0, 0.0, 0.3]);
}

/// A contact that can slip has no potential for F̄; a rough one is solved with it.
#[test]
fn friction_with_f_bar_has_to_be_rough() {
    let settings = Settings::new(1.0).remedy(Remedy::FbarConsistent);
    let mut rough = block(2.0 * MU, |k| Friction::rough(k).unwrap(), settings);
    rough.advance(2).unwrap();
    let force = rough.on(Part::Contact(0)).force;
    let slope = 2.0 * MU * MASS;
    assert!((force[0] - slope).abs() < 1e-9 * MASS, "{force:?}");
    let scene =
        Scene { contacts: vec![rough.scene.contacts[0].clone().with_friction(coulomb(1.0))], ..full(CELLS, rubber()) };
    let error = Block::new::<Quadratics<2>>(scene, settings).err().unwrap().to_string();
    assert!(error.contains("friction coefficient") && error.contains("0.3"), "{error}");
}
