//! What transfers keep and what they take.

use crate::scenes::{angular_momentum, block, open_grid, scene, scene_with, swirl};
use mpm_core::basis::{Gimp, QuadraticBSpline};
use mpm_core::explicit::transfer::{Apic, Flip, Xpic};
use mpm_core::explicit::{Solver, Transfer};
use mpm_core::stage::{BodyForce, KineticDamping, ParticleFilter};
use mpm_core::{Basis, Simulation};
use nalgebra::SMatrix;
use std::f64::consts::PI;

#[test]
fn xpic_falls_as_galileo_says() {
    // Its positions are second order: x_n = x_0 + ½ g (n Δt)², exactly.
    let particles = block(0.5, 2, [4, 5], [8, 9]);
    let (mut scene, settings) =
        scene_with(open_grid::<2>(0.5, 12), particles, Xpic::new(2).unwrap());
    scene
        .loads
        .push(Box::new(BodyForce(Box::new(|_, _| [0.0, -1.0]))));
    let time = 100.0 * settings.dt;
    let mut solver = Solver::<2, 3, Gimp, _, Xpic>::new(scene, settings).unwrap();
    for _ in 0..100 {
        solver.step().unwrap();
    }
    let p = solver.particles();
    for (x, reference) in p.position.iter().zip(&p.reference) {
        assert!((x[1] - reference[1] + 0.5 * time * time).abs() < 1e-10);
    }
}

/// Turns a free block by a radian with angular velocity ½ rad/s; returns kinetic energy and angular
/// momentum over those of the start.
fn turn<T: Transfer<2>>(transfer: T) -> [f64; 2] {
    let spin = 0.5;
    let mut particles = block(0.25, 2, [8, 8], [16, 16]);
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        *v = [-spin * (x[1] - 3.0), spin * (x[0] - 3.0)];
    }
    let (scene, settings) = scene_with(open_grid::<2>(0.25, 24), particles, transfer);
    let steps = (1.0 / spin / settings.dt) as usize;
    let mut solver = Solver::<2, 3, QuadraticBSpline, _, T>::new(scene, settings).unwrap();
    let now = |solver: &Solver<2, 3, QuadraticBSpline, _, T>| {
        let momentum = angular_momentum(solver.particles())[0][1];
        [solver.totals().kinetic_energy, momentum]
    };
    let before = now(&solver);
    for _ in 0..steps {
        solver.step().unwrap();
    }
    let after = now(&solver);
    [after[0] / before[0], after[1] / before[1]]
}

#[test]
fn a_turning_block_keeps_its_angular_momentum_with_apic_alone() {
    let apic = turn(Apic);
    assert!((apic[1] - 1.0).abs() < 1e-11, "{apic:?}");
    let measured = [
        turn(Flip::default()),
        apic,
        turn(Xpic::new(3).unwrap()),
        turn(Xpic::new(2).unwrap()),
        turn(Flip::new(0.0).unwrap()),
    ];
    // As documented in `docs/method.md`, rounded there.
    let documented = [
        [0.949, 0.961],
        [0.909, 1.0],
        [0.278, 0.528],
        [0.077, 0.278],
        [0.0, 0.0],
    ];
    for (m, d) in measured.iter().flatten().zip(documented.iter().flatten()) {
        assert!((m - d).abs() < 1e-3, "{measured:?}");
    }
}

#[test]
fn kinetic_damping_stops_the_affine_motion_too() {
    let mut particles = block(0.5, 2, [4, 4], [8, 8]);
    swirl(&mut particles, 0.01);
    Apic.attach(&mut particles);
    particles.affine.fill(SMatrix::<f64, 2, 2>::repeat(0.1));
    let mut damping = KineticDamping::default();
    assert_eq!(damping.filter(1.0, &mut particles), 0.0);
    assert!(damping.filter(0.5, &mut particles) > 0.0);
    assert!(particles.affine.iter().all(|b| b.norm() == 0.0));
}

/// Share of the energy, kinetic and stored, that a free block of 16 by 16 cells has after 100 steps:
/// moving smoothly (a wave as long as twice the block), and with a random velocity at each particle.
fn energy_left<const S: usize, B: Basis<S> + 'static, T: Transfer<2> + Clone>(
    transfer: &T,
) -> [f64; 2] {
    [false, true].map(|noisy| {
        let mut particles = block(0.25, 2, [4, 4], [20, 20]);
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state) / f64::from(u32::MAX) - 0.5
        };
        for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
            *v = if noisy {
                [0.02 * random(), 0.02 * random()]
            } else {
                [1, 0].map(|a: usize| 0.01 * (PI * (x[a] - 1.0) / 4.0).sin())
            };
        }
        let (scene, settings) = scene_with(open_grid::<2>(0.25, 24), particles, transfer.clone());
        let mut solver = Solver::<2, S, B, _, T>::new(scene, settings).unwrap();
        let before = solver.totals().kinetic_energy;
        for _ in 0..100 {
            solver.step().unwrap();
        }
        let t = solver.totals();
        (t.kinetic_energy + t.stored_energy) / before
    })
}

/// The table of `docs/method.md`: FLIP, APIC, XPIC of order 5, 3 and 2, PIC.
#[test]
fn each_transfer_leaves_what_the_documentation_says() {
    check_energy_left::<3, Gimp>([
        [0.989, 0.729],
        [0.984, 0.031],
        [0.981, 0.024],
        [0.971, 0.018],
        [0.943, 0.011],
        [0.822, 0.001],
    ]);
    check_energy_left::<3, QuadraticBSpline>([
        [0.983, 0.715],
        [0.966, 0.013],
        [0.975, 0.022],
        [0.961, 0.015],
        [0.926, 0.009],
        [0.816, 0.001],
    ]);
}

fn check_energy_left<const S: usize, B: Basis<S> + 'static>(documented: [[f64; 2]; 6]) {
    let measured = [
        energy_left::<S, B, _>(&Flip::default()),
        energy_left::<S, B, _>(&Apic),
        energy_left::<S, B, _>(&Xpic::new(5).unwrap()),
        energy_left::<S, B, _>(&Xpic::new(3).unwrap()),
        energy_left::<S, B, _>(&Xpic::new(2).unwrap()),
        energy_left::<S, B, _>(&Flip::new(0.0).unwrap()),
    ];
    // Three printed digits, and as much again for other processors' rounding.
    for (m, d) in measured.iter().flatten().zip(documented.iter().flatten()) {
        assert!((m - d).abs() < 1e-3, "{measured:?}");
    }
}

#[test]
fn pic_dissipates_and_flip_does_not() {
    let energy = |flip: f64| {
        let mut particles = block(0.5, 2, [4, 4], [8, 8]);
        swirl(&mut particles, 0.01);
        let (scene, mut settings) = scene(open_grid::<2>(0.5, 12), particles);
        settings.transfer = Flip::new(flip).unwrap();
        let mut solver = Solver::<2, 3, Gimp, _>::new(scene, settings).unwrap();
        for _ in 0..40 {
            solver.step().unwrap();
        }
        let t = solver.totals();
        t.kinetic_energy + t.stored_energy
    };
    assert!(energy(0.0) < 0.8 * energy(1.0));
}
