//! Walls that hold on to what touches them and walls that let go; a body handed from run to run.

use crate::scenes::{self, DENSITY};
use mpm_core::basis::{CubicBSpline, Gimp, QuadraticBSpline};
use mpm_core::explicit::remedy::{Fbar, Form};
use mpm_core::explicit::transfer::{Apic, Flip};
use mpm_core::explicit::{Settings, Solver, Transfer};
use mpm_core::material::NeoHookean;
use mpm_core::monitor::Accumulated;
use mpm_core::stage::{BodyForce, End, LocalDamping, Wall, WallKind};
use mpm_core::{Axis, Basis, Error, Grid, Part, Particles, Scene, Side, Simulation, SymmetricTensor};

const H: f64 = 0.5;
/// Speed (m/s) of the block, a hundredth of that of sound.
const SPEED: f64 = 0.1;
/// Left, lower, upper.
const WALLS: [(usize, End); 3] = [(0, End::Lo), (1, End::Lo), (1, End::Hi)];

/// A block of four by four cells, `gap` cells off the left wall and between walls above and below that it touches.
fn block(gap: usize, velocity: [f64; 2]) -> Particles<2> {
    let mut particles = scenes::block(H, 2, [gap, 0], [gap + 4, 4]);
    particles.velocity.fill(velocity);
    particles
}

fn scene<T>(particles: Particles<2>, kind: WallKind, transfer: T) -> (Scene<2>, Settings<2, T>) {
    let grid = Grid::new(H, [Axis::walls(0.0, 10), Axis::walls(0.0, 4)]).unwrap();
    let walls = WALLS.map(|(axis, end)| Wall::new(axis, end, kind));
    let (scene, settings) = scenes::scene_with(grid, particles, transfer);
    let scene = scene.constrain_all(walls);
    (scene, settings.remedy(Box::new(Fbar::new(Form::Rate))))
}

fn started<const S: usize, B: Basis<S>, T: Transfer<2>>(
    (scene, settings): (Scene<2>, Settings<2, T>),
) -> Solver<2, S, B, T> {
    Solver::new(scene, settings).unwrap()
}

/// Runs a block between walls that it meets at the left. In every step its momentum is that of the start less the
/// impulses on the walls, and its energy has not grown.
fn run<const S: usize, B: Basis<S>, T: Transfer<2>>(
    block: Particles<2>,
    kind: WallKind,
    transfer: T,
) -> Solver<2, S, B, T> {
    let mut solver = started(scene(block, kind, transfer));
    let start = solver.totals();
    let size = start.momentum[0].abs();
    let mut energy = start.kinetic_energy;
    for _ in 0..400 {
        solver.step().unwrap();
        let now = solver.totals();
        for axis in 0..2 {
            let given: f64 = (0..WALLS.len()).map(|w| solver.on(Part::Constraint(w)).impulse[axis]).sum();
            let lost = now.momentum[axis] + given - start.momentum[axis];
            assert!(lost.abs() < 1e-12 * size, "{kind:?}: {lost}");
        }
        let left = now.kinetic_energy + now.accumulated.stress_work;
        assert!(left <= energy * (1.0 + 1e-12), "{kind:?}: {left} {energy}");
        energy = left;
    }
    solver
}

fn leftmost(solver: &impl Simulation<2>) -> f64 {
    let x = solver.particles().position.iter().map(|x| x[0]);
    x.fold(f64::INFINITY, f64::min)
}

/// A block that is pulled off the wall (0.8 N s) leaves it, if that is separable, as if it were not there, except for
/// the push of the corner's rounding; one that is thrown at the wall comes back.
fn separates<const S: usize, B: Basis<S>, T: Transfer<2> + Copy>(transfer: T) {
    let pulled = || block(0, [SPEED, 0.3 * SPEED]);
    let free = run::<S, B, T>(pulled(), WallKind::Separable, transfer);
    let push = free.on(Part::Constraint(0)).impulse[0];
    assert!((-1e-5..=0.0).contains(&push), "{push}");
    assert!(leftmost(&free) > H, "{}", leftmost(&free));
    let held = run::<S, B, T>(pulled(), WallKind::Roller, transfer);
    assert!(held.on(Part::Constraint(0)).impulse[0] > 0.0);
    assert!(leftmost(&held) < H, "{}", leftmost(&held));
    let thrown = block(1, [-SPEED, 0.3 * SPEED]);
    let back = run::<S, B, T>(thrown, WallKind::Separable, transfer);
    assert!(back.on(Part::Constraint(0)).impulse[0] < 0.0 && back.totals().momentum[0] > 0.0);
}

#[test]
fn separable_walls_bear_no_tension_and_momentum_balances() {
    separates::<3, Gimp, _>(Flip::default());
    separates::<3, QuadraticBSpline, _>(Flip::default());
    separates::<3, QuadraticBSpline, _>(Apic);
    separates::<4, CubicBSpline, _>(Flip::default());
}

/// Damping opposes velocities by a share of the force; at a held node that is the reaction itself.
#[test]
fn damping_leaves_reactions_what_they_are() {
    let (still, settings) = scene(block(0, [0.0; 2]), WallKind::Roller, Flip::default());
    let (weight, dt) = (1.0, settings.dt);
    let mass: f64 = still.bodies.particles.mass.iter().sum();
    let pulled = still.load(BodyForce(Box::new(move |_: &[f64; 2], _| [-weight, 0.0])));
    let damped = settings.filter_forces(LocalDamping::new(0.3).unwrap());
    let mut solver = started::<3, Gimp, _>((pulled, damped));
    solver.advance(1000).unwrap();
    let before = solver.on(Part::Constraint(0)).impulse[0];
    solver.step().unwrap();
    let impulse = solver.on(Part::Constraint(0)).impulse[0] - before;
    let expected = -weight * mass;
    assert!((solver.on(Part::Constraint(0)).force[0] / expected - 1.0).abs() < 1e-3);
    assert!((impulse / dt / expected - 1.0).abs() < 1e-3);
}

#[test]
fn a_body_goes_on_in_another_run_bit_for_bit() {
    let thrown = || block(1, [-SPEED, 0.0]);
    let start = || scene(thrown(), WallKind::Separable, Flip::default());
    let mut first = started::<3, Gimp, _>(start());
    first.advance(150).unwrap();
    let mut second = started::<3, Gimp, _>(start());
    second.take_over(&first.body().unwrap()).unwrap();
    assert_eq!((second.time(), second.work().steps), (0.0, 0));
    first.advance(50).unwrap();
    second.advance(50).unwrap();
    assert_eq!(first.body().unwrap(), second.body().unwrap());
}

#[test]
fn a_body_of_other_particles_is_refused() {
    let with = |particles| scene(particles, WallKind::Separable, Flip::default());
    let mut few = block(0, [0.0; 2]);
    few.position.truncate(60);
    let few = Particles::new(few.position, 0.0625, DENSITY, [0.125; 2]).unwrap();
    let few = started::<3, Gimp, _>(with(few));
    let mut solver = started::<3, Gimp, _>(with(block(0, [0.0; 2])));
    let before = solver.body().unwrap();
    let error = solver.take_over(&few.body().unwrap()).unwrap_err();
    assert!(error.to_string().contains("60 in the saved state, 64"), "{error}");
    assert_eq!(solver.body().unwrap(), before);
}

/// A grain that hardly resists at `x` (cells from the left wall), which an `acceleration` (m/s²) pushes at the wall.
fn grain<B: Basis<3>>(x: f64, acceleration: f64) -> Result<Solver<2, 3, B, Flip>, Error> {
    let place = vec![[x * H, 2.0 * H]];
    let particle = Particles::new(place, H * H / 4.0, DENSITY, [0.25 * H; 2]).unwrap();
    let (mut scene, settings) = scene(particle, WallKind::Separable, Flip::default());
    scene.bodies.each[0].law = NeoHookean::new(1e-6, 0.0).unwrap().into();
    let pushed = scene.load(BodyForce(Box::new(move |_: &[f64; 2], _| [-acceleration, 0.0])));
    Solver::new(pushed, settings)
}

#[test]
fn gimp_may_pass_a_wall_by_half_a_particle_and_comes_to_rest_there() {
    let reach = 0.25;
    let mut solver = grain::<Gimp>(0.1, 1.0).unwrap();
    let mut passed: f64 = 0.0;
    for _ in 0..20_000 {
        solver.step().unwrap();
        passed = passed.min(solver.particles().position[0][0] / H);
    }
    assert!((-reach..-0.5 * reach).contains(&passed), "{passed}");
    assert!(grain::<Gimp>(-0.99 * reach, 1.0).is_ok());
    assert!(grain::<Gimp>(-1.01 * reach, 1.0).is_err());
    // Functions that vanish at the wall hold what touches it.
    assert!(grain::<QuadraticBSpline>(0.0, 1.0).is_ok());
    assert!(grain::<QuadraticBSpline>(-0.01, 1.0).is_err());
}

/// Weight per mass (m/s²) of a block on a floor at 20°, and its speed at the start (m/s).
const WEIGHT: f64 = 0.1;
const DOWN: f64 = 0.1;

/// A block of eight by four cells under its weight on a floor with a coefficient of friction, in a frame along the floor.
fn on_a_slope<B: Basis<3>, T: Transfer<2>>(friction: f64, speed: f64, transfer: T) -> Solver<2, 3, B, T> {
    let grid = Grid::new(H, [Axis::open(0.0, 24), Axis::bounded(0.0, 7, (Side::Wall, Side::Open))]).unwrap();
    let mut particles = scenes::block(H, 2, [2, 0], [10, 4]);
    particles.velocity.fill([speed, 0.0]);
    let (mut scene, settings) = scenes::scene_with(grid, particles, transfer);
    let (along, down) = (WEIGHT * 20.0_f64.to_radians().sin(), WEIGHT * 20.0_f64.to_radians().cos());
    let stress = |_, x: &[f64; 2]| SymmetricTensor { yy: -DENSITY * down * (4.0 * H - x[1]), ..Default::default() };
    scene.bodies = scene.bodies.under(stress).unwrap();
    let floor = Wall::new(1, End::Lo, WallKind::Separable).friction(friction).unwrap();
    let scene = scene.constrain(floor).load(BodyForce(Box::new(move |_: &[f64; 2], _| [along, -down])));
    started((scene, settings))
}

/// While all of its lowest nodes slide, the floor takes μ times the normal impulse, and the block loses the energy of it.
fn slides_by_coulomb<B: Basis<3>, T: Transfer<2>>(transfer: T) {
    let friction = 0.2;
    let mut solver = on_a_slope::<B, T>(friction, DOWN, transfer);
    let start = solver.totals();
    let (mut energy, mut worked, mut before) = (start.kinetic_energy, 0.0, 0.0);
    for _ in 0..400 {
        solver.step().unwrap();
        let (now, impulse) = (solver.totals(), solver.on(Part::Constraint(0)).impulse);
        // Nodes at its ends that carry next to nothing may stick.
        let most = -friction * impulse[1];
        assert!(impulse[0] <= most + 1e-12 * start.momentum[0] && impulse[0] > 0.999 * most, "{impulse:?}");
        let Accumulated { stress_work, load_work, constraint_loss, .. } = now.accumulated;
        let left = now.kinetic_energy + stress_work + constraint_loss - load_work;
        assert!(left <= energy + 1e-9 * start.kinetic_energy, "{left} {energy}");
        worked += (impulse[0] - before) * now.momentum[0] / now.mass;
        (energy, before) = (left, impulse[0]);
    }
    let (now, angle) = (solver.totals(), 20.0_f64.to_radians());
    let gained = WEIGHT * (angle.sin() - friction * angle.cos()) * solver.time();
    let error = (now.momentum[0] - start.momentum[0]) / (now.mass * gained) - 1.0;
    assert!(error.abs() < 0.03, "{error}");
    let lost = now.accumulated.constraint_loss / worked;
    assert!((lost - 1.0).abs() < 0.05, "{lost}");
}

#[test]
fn a_block_slides_on_a_wall_by_coulombs_friction() {
    slides_by_coulomb::<Gimp, _>(Flip::default());
    slides_by_coulomb::<QuadraticBSpline, _>(Flip::default());
}

/// It stays where the coefficient is above twice the slope's tangent, as a load that comes at once swings to twice itself;
/// and so does what it is sheared and bent by.
#[test]
fn a_block_stays_on_a_wall_that_holds_it() {
    let mut solver = on_a_slope::<Gimp, _>(0.8, 0.0, Flip::default());
    solver.advance(400).unwrap();
    let (height, width, pull) = (4.0 * H, 8.0 * H, DENSITY * WEIGHT * 20.0_f64.to_radians().sin());
    let sheared = 1.2 * pull * height.powi(2) / (2.0 * 100.0 / 2.6);
    let bent = pull * width * height.powi(4) / (8.0 * 100.0 / (1.0 - 0.09) * width.powi(3) / 12.0);
    let p = solver.particles();
    let moved = p.position.iter().zip(&p.reference).map(|(x, start)| (x[0] - start[0]).abs());
    let farthest = moved.fold(0.0, f64::max);
    assert!(farthest < 2.2 * (sheared + bent), "{farthest} {sheared} {bent}");
    let mut slides = on_a_slope::<Gimp, _>(0.3, 0.0, Flip::default());
    slides.advance(400).unwrap();
    assert!(slides.totals().momentum[0] > 10.0 * solver.totals().momentum[0].abs());
}

#[test]
fn friction_is_of_separable_walls() {
    let wall = |kind| Wall::new(0, End::Lo, kind);
    for kind in [WallKind::Fixed, WallKind::Roller] {
        assert!(wall(kind).friction(0.3).is_err() && wall(kind).friction(0.0).is_ok());
    }
    for friction in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(wall(WallKind::Separable).friction(friction).is_err());
    }
}
