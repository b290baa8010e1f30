//! Contact with rigid bodies: barrier, friction, reactions, the time step.

mod barrier;
mod face;
mod friction;
mod mesh;

use crate::scenes::with_threads;
use friction::on_a_slope;
use mpm_core::basis::Gimp;
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::explicit::{Settings, Solver, contact_cfl, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::stage::{Amplitude, End, Gravity, LocalDamping};
use mpm_core::{Axis, Bodies, Error, Fault, Grid, Part, Particles, Scene, Simulation};

const H: f64 = 0.5;
const SPACING: f64 = 0.5 * H;
const DENSITY: f64 = 2.0;
const CFL: f64 = 0.3;
/// Where the barrier begins, d̂ = h/4.
const DISTANCE: f64 = 0.25 * H;
const GRAVITY: f64 = 0.1;
/// Layers of particles in a block.
const LAYERS: usize = 4;
/// Weight on a particle of the lowest layer (N).
const LOAD: f64 = DENSITY * SPACING * SPACING * LAYERS as f64 * GRAVITY;
/// Gap (m) of a block at rest.
const REST_GAP: f64 = 0.9 * DISTANCE;

type Block<const D: usize> = Solver<D, 3, Gimp>;

fn law() -> NeoHookean {
    NeoHookean::new(100.0, 0.3).unwrap()
}

/// A block from two cells above zero on every axis, four layers high along the last, `long` particles along the others.
fn block<const D: usize>(long: usize) -> Particles<D> {
    let count: [usize; D] = std::array::from_fn(|a| if a == D - 1 { LAYERS } else { long });
    let positions = (0..count.iter().product())
        .map(|k| {
            let mut rest = k;
            std::array::from_fn(|a| {
                let i = rest % count[a];
                rest /= count[a];
                2.0 * H + (i as f64 + 0.5) * SPACING
            })
        })
        .collect();
    let volume = SPACING.powi(D as i32);
    Particles::new(positions, volume, DENSITY, [0.5 * SPACING; D]).unwrap()
}

/// A barrier that carries a block of the plane at the gap of rest.
fn barrier() -> Barrier {
    Barrier::carrying_at(LOAD, REST_GAP, DISTANCE).unwrap()
}

/// A stick as stiff as the barrier at rest.
fn stick() -> f64 {
    barrier().stiffness(REST_GAP)
}

/// The floor, at the gap `gap` from the block.
fn floor<const D: usize>(particles: &Particles<D>, gap: f64) -> RigidFace<D> {
    RigidFace::half_space(D - 1, End::Lo, 0.0).unwrap().touching(particles, gap)
}

type Setting<const D: usize> = (Scene<D>, Settings<D>);

fn scene<const D: usize>(particles: Particles<D>, contacts: Vec<RigidContact<D>>) -> Setting<D> {
    let law = law();
    let dt = courant_time_step(CFL, H, law.wave_speed(DENSITY));
    let grid = Grid::new(H, [Axis::open(0.0, 24); D]).unwrap();
    let scene = Scene::new(grid, Bodies::new(law, particles).unwrap());
    (contacts.into_iter().fold(scene, Scene::contact), Settings::new(dt))
}

/// The scene under gravity `b` (m/s²).
fn under<const D: usize>(
    (scene, settings): Setting<D>,
    b: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
) -> Setting<D> {
    let gravity = Gravity(Box::new(b));
    (scene.load(gravity), settings)
}

const ALPHA: f64 = 0.5;

/// The scene with local damping.
fn damped<const D: usize>((scene, settings): Setting<D>) -> Setting<D> {
    let damping = LocalDamping::new(ALPHA).unwrap();
    (scene, settings.filter_forces(damping))
}

fn started<const D: usize>((scene, settings): Setting<D>) -> Result<Block<D>, Error> {
    Block::new(scene, settings)
}

fn run<const D: usize>(solver: &mut Block<D>, until: f64) {
    while solver.time() < until {
        solver.step().unwrap();
    }
}

/// Places of the particles of the lowest layer.
fn lowest<const D: usize>(solver: &Block<D>) -> Vec<usize> {
    let p = solver.particles();
    let low = |k: &usize| p.reference[*k][D - 1] < 2.0 * H + SPACING;
    (0..p.len()).filter(low).collect()
}

/// Gaps of the lowest layer (m) to a floor that has moved by `moved`.
fn gaps<const D: usize>(solver: &Block<D>, face: &RigidFace<D>, moved: &[f64; D]) -> Vec<f64> {
    let p = solver.particles();
    let now = |k: usize| std::array::from_fn(|a| p.position[k][a] - moved[a]);
    let lowest = lowest(solver).into_iter();
    lowest.map(|k| face.gap(&now(k)).unwrap()).collect()
}

/// Mean displacement of the lowest layer along `axis` (m).
fn shift<const D: usize>(solver: &Block<D>, axis: usize) -> f64 {
    let (p, lowest) = (solver.particles(), lowest(solver));
    let sum: f64 = (lowest.iter()).map(|&k| p.position[k][axis] - p.reference[k][axis]).sum();
    sum / lowest.len() as f64
}

/// Bound of the sum of the nodal forces (N): damping leaves at least 1 − α of each.
fn out_of_balance<const D: usize>(solver: &Block<D>) -> f64 {
    solver.residual().free_force / (1.0 - ALPHA)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// At rest, by the forces that are left over the weight.
const AT_REST: f64 = 1e-4;
/// Rounding of a sum of some hundred terms.
const ROUNDING: f64 = 1e-12;

/// The residual of the nodal forces is the difference of weight and reaction.
#[test]
fn a_block_rests_with_its_weight_on_the_floor() {
    let particles = block::<2>(16);
    let face = floor(&particles, DISTANCE);
    let contact = RigidContact::new(face.clone(), barrier());
    let scene = under(scene(particles, vec![contact]), |_| [0.0, -GRAVITY]);
    let mut solver = started(damped(scene)).unwrap();
    let weight = solver.totals().mass * GRAVITY;
    while solver.time() < 200.0 {
        solver.step().unwrap();
        assert!(least(&gaps(&solver, &face, &[0.0; 2])) > 0.0);
    }
    let (left, reaction) = (out_of_balance(&solver), solver.on(Part::Contact(0)).force);
    assert!(left < AT_REST * weight, "{left}");
    assert!((reaction[1] + weight).abs() <= left + ROUNDING * weight);
    assert_eq!((reaction[0], reaction[2]), (0.0, 0.0));
    assert!(solver.on(Part::Contact(1)).force[1].is_nan());
}

/// A periodic row is the same everywhere, so every particle of the lowest layer carries the same; the force that is
/// missing moves none by more than it moves a single one.
#[test]
fn the_gap_is_the_one_at_which_the_barrier_carries_the_load() {
    let particles = block::<2>(16);
    let face = floor(&particles, DISTANCE);
    let contact = RigidContact::new(face.clone(), barrier());
    let mut scene = damped(under(scene(particles, vec![contact]), |_| [0.0, -GRAVITY]));
    scene.0.grid.axes[0] = Axis::periodic(2.0 * H, 8);
    let mut solver = started(scene).unwrap();
    run(&mut solver, 200.0);
    let left = out_of_balance(&solver);
    assert!(left < AT_REST * 16.0 * LOAD, "{left}");
    for gap in gaps(&solver, &face, &[0.0; 2]) {
        assert!((gap - REST_GAP).abs() <= left / stick());
    }
}

/// Each of n + 4ᴰ terms of a sum is rounded at most as often as there are terms.
fn momentum_balances<const D: usize>(face: impl Fn(&Particles<D>) -> RigidFace<D>, friction: Option<Friction>) {
    let particles = block::<D>(6);
    let face = face(&particles);
    let tilted = !face.is_plane();
    let velocity = std::array::from_fn(|a| 0.05 * (1.0 + a as f64));
    let mut contact = RigidContact::new(face.moving(velocity, Amplitude::Rise(0.5)).unwrap(), barrier());
    if let Some(friction) = friction {
        contact = contact.with_friction(friction);
    }
    let pull: [f64; D] = std::array::from_fn(|a| if a == D - 1 { -GRAVITY } else { 0.02 });
    let scene = under(scene(particles, vec![contact]), move |_| pull);
    let dt = scene.1.dt;
    let mut solver = started(scene).unwrap();
    let terms = (solver.particles().len() + 4_usize.pow(D as u32)) as f64;
    let mut met = [false; D];
    for _ in 0..200 {
        let before = solver.totals();
        solver.step().unwrap();
        let (after, reaction) = (solver.totals(), solver.on(Part::Contact(0)).force);
        for a in 0..D {
            let impulse = dt * (after.mass * pull[a] - reaction[a]);
            let error = after.momentum[a] - before.momentum[a] - impulse;
            let scale: f64 =
                (solver.particles().velocity.iter()).map(|v| v[a].abs() * DENSITY * SPACING.powi(D as i32)).sum();
            let scale = scale + dt * (after.mass * pull[a].abs() + reaction[a].abs());
            assert!(error.abs() <= terms * f64::EPSILON * scale, "{a}: {error}");
            met[a] |= reaction[a] != 0.0;
        }
    }
    let rubs = friction.is_some();
    assert!((0..D).all(|a| met[a] == (a == D - 1 || rubs || tilted && a == 0)), "{met:?}");
}

#[test]
fn action_is_reaction_to_rounding() {
    momentum_balances::<1>(|particles| floor(particles, 0.95 * DISTANCE), None);
    momentum_balances::<2>(|particles| floor(particles, 0.95 * DISTANCE), None);
    for friction in [Friction::new(0.2, stick()), Friction::rough(stick())].map(Result::unwrap) {
        momentum_balances::<2>(|particles| floor(particles, 0.95 * DISTANCE), Some(friction));
        momentum_balances::<3>(|particles| floor(particles, 0.95 * DISTANCE), Some(friction));
    }
}

/// A block thrown at the floor from the gap d̂.
fn thrown(speed: f64) -> (RigidFace<2>, Block<2>) {
    let mut particles = block::<2>(8);
    particles.velocity.fill([0.0, -speed]);
    let face = floor(&particles, DISTANCE);
    let contact = RigidContact::new(face.clone(), barrier());
    (face, started(scene(particles, vec![contact])).unwrap())
}

/// Slow ones bounce; fast ones meet a barrier too stiff for the step, or would cross it within one. In no state
/// that can be seen, the last one included, is a gap closed.
#[test]
fn a_body_driven_too_hard_is_a_typed_error_and_never_inside() {
    let mut kinds = Vec::new();
    for k in 0..60 {
        let (face, mut solver) = thrown(0.02 * 1.12_f64.powi(k));
        let outcome = (0..400).try_for_each(|_| {
            let outcome = solver.step();
            let gap = least(&gaps(&solver, &face, &[0.0; 2]));
            assert!(gap > 0.0, "{gap}");
            outcome
        });
        let kind = match outcome {
            Ok(()) => "bounces",
            Err(Error::Breakdown { fault, .. }) => fault.kind(),
            Err(other) => panic!("{other}"),
        };
        if kinds.last() != Some(&kind) {
            kinds.push(kind);
        }
    }
    assert_eq!(kinds.first(), Some(&"bounces"));
    for kind in ["unstable-time-step", "gap-closed"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
}

#[test]
fn a_closed_gap_names_time_particle_and_gap() {
    let (face, mut solver) = thrown(8.0);
    let error = solver.step().unwrap_err();
    let Error::Breakdown { time, step, particle, fault } = error else {
        panic!("{error}");
    };
    assert_eq!((time, step), (0.0, 0));
    let p = solver.particles();
    let lowest = p.id.iter().position(|&id| id == particle).unwrap();
    let Fault::GapClosed(gap) = fault else {
        panic!("{fault}");
    };
    let sought = DISTANCE + p.increment[lowest][1];
    assert!((gap - sought).abs() < ROUNDING && gap < 0.0, "{gap} {sought}");
    assert!(least(&gaps(&solver, &face, &[0.0; 2])) > 0.0);

    let particles = block::<2>(8);
    let inside = RigidContact::new(floor(&particles, -0.1), barrier());
    let Err(Error::Breakdown { fault, .. }) = started(scene(particles, vec![inside])) else {
        panic!("it starts in the body");
    };
    assert_eq!(fault.kind(), "gap-closed");
}

/// A face that comes by three d̂ in the first step, to a body at a gap of two, is d̂ inside at its end.
#[test]
fn a_gap_is_that_to_where_the_face_is_at_the_end_of_a_step() {
    let dt = courant_time_step(CFL, H, law().wave_speed(DENSITY));
    let particles = block::<2>(8);
    let face = floor(&particles, 2.0 * DISTANCE);
    let comes = face.moving([0.0, 3.0 * DISTANCE / dt], Amplitude::Rise(0.0)).unwrap();
    let contact = RigidContact::new(comes, barrier());
    let mut solver = started(scene(particles, vec![contact])).unwrap();
    match solver.step().unwrap_err() {
        Error::Breakdown { step: 0, fault: Fault::GapClosed(gap), .. } => {
            assert!((gap + DISTANCE).abs() < ROUNDING, "{gap}")
        }
        other => panic!("{other}"),
    }
}

/// A scene with sticks of stiffness over mass `ratio` (1/s²), and noise.
fn shaken(ratio: f64) -> Block<2> {
    let mut particles = block::<2>(8);
    for (k, v) in particles.velocity.iter_mut().enumerate() {
        *v = [1e-5 * (k as f64).sin(), 0.0];
    }
    let friction = Friction::rough(ratio * particles.mass[0]).unwrap();
    let contact = RigidContact::new(floor(&particles, REST_GAP), barrier()).with_friction(friction);
    let scene = under(scene(particles, vec![contact]), |_| [0.0, -GRAVITY]);
    started(scene).unwrap()
}

/// The stiffness enters the time step, and a step that it allows is stable.
#[test]
fn a_contact_too_stiff_for_the_step_is_refused() {
    let dt = courant_time_step(CFL, H, law().wave_speed(DENSITY));
    let limit = 4.0 * (1.0 - CFL * CFL) / (dt * dt);
    assert!((contact_cfl(CFL, limit, dt) - 1.0).abs() < ROUNDING);
    let error = shaken(1.01 * limit).step().unwrap_err();
    let Error::Breakdown { particle, fault: Fault::UnstableTimeStep { cfl, limit: one }, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(one, 1.0);
    assert!((cfl - contact_cfl(CFL, 1.01 * limit, dt)).abs() < ROUNDING);
    let mut solver = shaken(0.99 * limit);
    let p = solver.particles();
    let named = p.id.iter().position(|&id| id == particle).unwrap();
    assert!(p.reference[named][1] < 2.0 * H + SPACING);
    run(&mut solver, 60.0);
    let fastest = solver.particles().velocity.iter().map(|v| v[0].abs());
    let fastest = fastest.fold(0.0, f64::max);
    assert!(fastest < 0.1, "{fastest}");
}

/// Two contacts that share a particle may be as stiff together as one.
#[test]
fn the_stiffnesses_of_contacts_add_up() {
    let dt = courant_time_step(CFL, H, law().wave_speed(DENSITY));
    let limit = 4.0 * (1.0 - CFL * CFL) / (dt * dt);
    let stiff = |contacts: usize| {
        let particles = block::<2>(8);
        let stiffness = 0.6 * limit * particles.mass[0];
        let contact = RigidContact::new(floor(&particles, REST_GAP), barrier())
            .with_friction(Friction::rough(stiffness).unwrap());
        let contacts = vec![contact; contacts];
        started(scene(particles, contacts)).unwrap().step()
    };
    assert!(stiff(1).is_ok());
    assert!(stiff(2).is_err());
}

#[test]
fn particles_beside_a_face_do_not_feel_it() {
    let particles = block::<2>(16);
    let end = 2.0 * H + 7.0 * SPACING;
    let face = floor(&particles, REST_GAP).within([[0.0, end], [0.0; 2]]);
    let contact = RigidContact::new(face, barrier()).with_friction(Friction::rough(stick()).unwrap());
    let mut solver = started(scene(particles, vec![contact])).unwrap();
    solver.step().unwrap();
    let p = solver.particles();
    for k in 0..p.len() {
        let touched = p.reference[k][0] < end && p.reference[k][1] < 2.0 * H + SPACING;
        assert_eq!(p.external_force[k][1] > 0.0, touched);
        assert!(touched || p.external_force[k] == [0.0; 2]);
    }
    let sought = -7.0 * LOAD;
    assert!((solver.on(Part::Contact(0)).force[1] / sought - 1.0).abs() < 1e-9);
}

/// Bits of a block that slides on a floor in `threads` threads, and of the reactions.
fn bits(threads: usize, contacts: impl Fn(&Particles<2>) -> Vec<RigidContact<2>> + Sync) -> Vec<u64> {
    with_threads(threads, || {
        let mut particles = block::<2>(72);
        for (k, v) in particles.velocity.iter_mut().enumerate() {
            *v = [0.5 + 0.01 * (k as f64).sin(), 0.01 * (k as f64).cos()];
        }
        let contacts = contacts(&particles);
        let mut scene = under(scene(particles, contacts), |_| [0.0, -GRAVITY]);
        scene.0.grid = Grid::new(H, [Axis::open(0.0, 48), Axis::open(0.0, 12)]).unwrap();
        let mut solver = started(scene).unwrap();
        let mut reactions = Vec::new();
        for _ in 0..100 {
            solver.step().unwrap();
            let reaction = solver.on(Part::Contact(0)).force.into_iter();
            reactions.extend(reaction.filter(|r| r.is_finite() && *r != 0.0));
        }
        assert!(solver.work().sorts > 1);
        let p = solver.particles();
        let columns = p.position.iter().chain(&p.velocity).flatten();
        columns.chain(&reactions).map(|v| v.to_bits()).collect()
    })
}

#[test]
fn threads_change_no_bit() {
    let contacts = |particles: &Particles<2>| {
        let friction = Friction::new(0.3, stick()).unwrap();
        vec![RigidContact::new(floor(particles, REST_GAP), barrier()).with_friction(friction)]
    };
    let one = bits(1, contacts);
    assert_eq!(one, bits(2, contacts));
    assert_ne!(one, bits(1, |_| Vec::new()));
}

#[test]
fn a_face_out_of_reach_changes_no_bit() {
    let far = |particles: &Particles<2>| {
        let friction = Friction::rough(stick()).unwrap();
        vec![RigidContact::new(floor(particles, 1.0), barrier()).with_friction(friction)]
    };
    assert_eq!(bits(1, far), bits(1, |_| Vec::new()));
}

#[test]
fn contact_allocates_nothing() {
    with_threads(1, || {
        let mut solver = started(on_a_slope(0.3, 0.5, 0.0)).unwrap();
        solver.step().unwrap();
        let info = allocation_counter::measure(|| {
            solver.advance(20).unwrap();
        });
        assert_eq!(info.count_total, 0);
    });
}

#[test]
fn a_face_across_a_periodic_axis_is_refused() {
    let particles = block::<2>(8);
    let contact = RigidContact::new(floor(&particles, DISTANCE), barrier());
    let mut scene = scene(particles, vec![contact]);
    scene.0.grid.axes[1] = Axis::periodic(0.0, 24);
    assert!(matches!(started(scene), Err(Error::Input { .. })));
}
