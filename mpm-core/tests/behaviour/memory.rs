//! A run that is saved, built anew and restored goes on bit for bit; what is not its memory is refused.

use crate::scenes::{DENSITY, block, remedies};
use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::explicit::remedy::{Fbar, Form, Standard};
use mpm_core::explicit::transfer::{Apic, Flip, Musl, Xpic};
use mpm_core::explicit::{Remedy, Settings, Solver, Transfer, courant_time_step};
use mpm_core::material::{HenckyJ2, NeoHookean, NewtonianFluid, Strength, shared};
use mpm_core::memory::{Memory, MemoryError, Saved};
use mpm_core::stage::{
    Amplitude, BodyForce, DeadForce, End, KineticDamping, LocalDamping, Observation, RestCriterion, RigidNodes, Wall,
    WallKind,
};
use mpm_core::{Axis, Basis, Bodies, Grid, Law, Part, Scene, Side, Simulation};

const H: f64 = 0.5;
const CELLS: usize = 20;
const STEPS: usize = 60;

fn solid() -> NeoHookean {
    NeoHookean::new(100.0, 0.4).unwrap()
}

/// A block `width` cells wide that is shaken along the floor, pressed, pulled and damped.
fn scene<M: Law + 'static, T>(
    law: M,
    transfer: T,
    remedy: Box<dyn Remedy<2>>,
    width: usize,
) -> (Scene<2>, Settings<2, T>) {
    let mut particles = block(H, 2, [1, 0], [1 + width, 6]);
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        *v = [3.0, 0.05 * x[0] * x[1]];
    }
    let dt = courant_time_step(0.2, H, law.wave_speed(DENSITY));
    let pull = DeadForce::shared([0.4, -0.2], Amplitude::Rise(10.0 * dt), &particles, |x| x[1] > 5.0 * H);
    let press = RigidNodes {
        extent: [[f64::NEG_INFINITY, f64::INFINITY], [6.0 * H, f64::INFINITY]],
        velocity: [None, Some(-0.2)],
        amplitude: Amplitude::Rise(70.0 * dt),
    };
    let lid = RigidFace::half_space(1, End::Hi, 0.0).unwrap().touching(&particles, 0.2);
    let drag = Friction::new(0.3, 0.5).unwrap();
    let upright = Axis::bounded(0.0, 8, (Side::Wall, Side::Open));
    let grid = Grid::new(H, [Axis::periodic(0.0, CELLS), upright]).unwrap();
    let scene = Scene::new(grid, Bodies::new(shared(law), particles).unwrap())
        .load(BodyForce(Box::new(|x: &[f64; 2], t| [100.0 * (15.0 * t).cos(), -0.2 * x[0]])))
        .load(pull)
        .constrain(Wall::new(1, End::Lo, WallKind::Roller))
        .constrain(press)
        .contact(RigidContact::new(lid, Barrier::new(0.2, 0.3).unwrap()).with_friction(drag));
    let settings = Settings::new(dt)
        .transfer(transfer)
        .remedy(remedy)
        .filter_forces(LocalDamping::new(0.1).unwrap())
        .filter_particles(KineticDamping::default());
    (scene, settings)
}

/// All that can be seen of a run. Debug writes every bit of a number.
fn seen(run: &mut dyn Simulation<2>) -> String {
    format!(
        "{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{:?}",
        run.time(),
        run.totals(),
        run.residual(),
        run.work(),
        [Part::Constraint(0), Part::Constraint(1), Part::Contact(0)].map(|part| run.on(part)),
        run.particles().clone(),
        run.force_stress()
    )
}

/// Straight on against stopped after every step: between any two sorts, and just before every strike of the
/// kinetic damping, when it matters what the energy was.
fn goes_on(name: &str, build: &dyn Fn() -> Box<dyn Simulation<2>>) {
    let (mut straight, mut pieces) = (build(), build());
    for step in 0..STEPS {
        straight.step().unwrap();
        pieces.step().unwrap();
        let saved = pieces.save().unwrap();
        pieces = build();
        pieces.restore(&saved).unwrap();
        assert!(pieces.save().unwrap() == saved, "{name}: saved again");
        if step % 12 == 0 || step + 1 == STEPS {
            let same = seen(pieces.as_mut()) == seen(straight.as_mut());
            assert!(same, "{name}: step {step}");
        }
    }
    assert!(straight.work().sorts > 1, "{name}: nothing was sorted");
    let struck = straight.totals().accumulated.filter_loss > 0.0;
    assert!(struck, "{name}: no kinetic damping");
}

fn of_basis<const S: usize, B: Basis<S> + 'static, T: Transfer<2> + Clone + 'static>(name: &str, transfer: &T) {
    for k in 0..remedies::<2>().len() {
        goes_on(&format!("{name}, remedy {k}"), &|| {
            let remedy = remedies().into_iter().nth(k).unwrap();
            let (scene, settings) = scene(solid(), transfer.clone(), remedy, 6);
            Box::new(Solver::<2, S, B, _>::new(scene, settings).unwrap())
        });
    }
}

fn of_transfer<T: Transfer<2> + Clone + 'static>(name: &str, transfer: &T) {
    of_basis::<2, Linear, T>(&format!("linear {name}"), transfer);
    of_basis::<3, Gimp, T>(&format!("gimp {name}"), transfer);
    of_basis::<3, QuadraticBSpline, T>(&format!("bspline2 {name}"), transfer);
    of_basis::<4, CubicBSpline, T>(&format!("bspline3 {name}"), transfer);
}

#[test]
fn every_basis_remedy_and_transfer_goes_on_bit_for_bit() {
    of_transfer("flip", &Flip::default());
    of_transfer("blend", &Flip::new(0.9).unwrap());
    of_transfer("apic", &Apic);
    of_transfer("xpic", &Xpic::new(3).unwrap());
    of_transfer("musl", &Musl::default());
}

#[test]
fn every_law_goes_on_bit_for_bit() {
    fn of_law<M: Law + Copy + 'static>(name: &str, law: M) {
        goes_on(name, &|| {
            let (scene, settings) = scene(law, Flip::default(), Box::new(Fbar::new(Form::Rate)), 6);
            Box::new(Solver::<2, 3, Gimp>::new(scene, settings).unwrap())
        });
    }
    let strength = Strength::softening(1.0, 0.5, 2.0).unwrap();
    of_law("plastic", HenckyJ2::new(100.0, 0.4, strength).unwrap());
    of_law("fluid", NewtonianFluid::new(200.0, 0.1).unwrap());
}

fn gimp(remedy: Box<dyn Remedy<2>>, width: usize) -> Solver<2, 3, Gimp> {
    let (scene, settings) = scene(solid(), Flip::default(), remedy, width);
    Solver::new(scene, settings).unwrap()
}

fn saved() -> Saved {
    let mut run = gimp(Box::new(Fbar::new(Form::Rate)), 6);
    run.advance(25).unwrap();
    run.save().unwrap()
}

fn refusal(mut run: impl Memory) -> MemoryError {
    run.restore(&saved()).unwrap_err()
}

#[test]
fn the_memory_of_another_scene_is_refused() {
    let rate = || Box::new(Fbar::new(Form::Rate));
    let size = |what, saved, expected| MemoryError::Size { what, saved, expected };
    assert_eq!(refusal(gimp(rate(), 7)), size("id", 144, 168));
    assert_eq!(refusal(gimp(Box::new(Standard), 6)), size("j_bar", 144, 0));
    let (flat, settings) = scene(solid(), Apic, rate(), 6);
    let apic = Solver::<2, 3, Gimp, _>::new(flat, settings).unwrap();
    assert_eq!(refusal(apic), size("affine", 0, 144));
    let (undamped, mut settings) = scene(solid(), Flip::default(), rate(), 6);
    settings.particle_filters.clear();
    let undamped = Solver::<2, 3, Gimp>::new(undamped, settings).unwrap();
    assert_eq!(refusal(undamped), size("particle filters", 1, 0));
    let (mut longer, settings) = scene(solid(), Flip::default(), rate(), 6);
    longer.grid = Grid::new(H, [Axis::periodic(0.0, CELLS + 8), longer.grid.axes[1]]).unwrap();
    let longer = Solver::<2, 3, Gimp>::new(longer, settings).unwrap();
    let of_nodes = matches!(refusal(longer), MemoryError::Size { what: "nodes", .. });
    assert!(of_nodes);
    let fluid = NewtonianFluid::new(200.0, 0.1).unwrap();
    let (fluid, settings) = scene(fluid, Flip::default(), rate(), 6);
    let fluid = Solver::<2, 3, Gimp>::new(fluid, settings).unwrap();
    assert_eq!(refusal(fluid), size("numbers of states", 6 * 144, 144));
    assert!(matches!(refusal(Standard), MemoryError::Surplus { .. }));
    assert!(matches!(refusal(KineticDamping::default()), MemoryError::Surplus { .. }));
    gimp(rate(), 6).restore(&saved()).unwrap();
}

/// Bytes that are damaged give an error or another motion, but no panic: here each byte of a memory in turn,
/// and every length.
#[test]
fn a_damaged_memory_gives_no_panic() {
    let sound = saved();
    let restored = |bytes: Vec<u8>| {
        let mut run = gimp(Box::new(Fbar::new(Form::Rate)), 6);
        let outcome = run.restore(&Saved::from_bytes(bytes));
        if outcome.is_ok() {
            // The motion may well break down.
            let _ = run.step();
        }
        outcome
    };
    for length in (0..sound.bytes().len()).step_by(97) {
        assert!(restored(sound.bytes()[..length].to_vec()).is_err());
    }
    assert!(restored([sound.bytes(), &[0]].concat()).is_err());
    for place in (0..sound.bytes().len()).step_by(7) {
        for flip in [0x01, 0x80, 0xff] {
            let mut bytes = sound.bytes().to_vec();
            bytes[place] ^= flip;
            let _ = restored(bytes);
        }
    }
    assert!(restored(sound.bytes().to_vec()).is_ok());
}

#[test]
fn rest_remembers_its_window() {
    let rest = || RestCriterion::new(1e-3, 1e-3, 1e-4, 1.0);
    let at = |k: u32| Observation { time: 0.3 * f64::from(k), force_ratio: 0.0, energy_ratio: 0.0, displacement: 1.0 };
    let (mut straight, mut pieces) = (rest(), rest());
    let rested: Vec<bool> = (0..8).map(|k| straight.observe(at(k))).collect();
    let again: Vec<bool> = (0..8)
        .map(|k| {
            let saved = pieces.save().unwrap();
            pieces = rest();
            pieces.restore(&saved).unwrap();
            pieces.observe(at(k))
        })
        .collect();
    assert!(rested[7] && rested == again && pieces == straight);
}
