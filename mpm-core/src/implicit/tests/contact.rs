//! Contact by the barrier: its tangent, what it keeps, and gaps that stay open.

use super::stiffness::{REMEDIES, slope_of_the_forces, strained};
use super::*;
use crate::contact::{Barrier, Friction, RigidContact, RigidFace};
use crate::simulation::Part;
use crate::stage::Amplitude;
use crate::stage::Gravity;

/// Where the barrier begins (m).
pub(super) const DISTANCE: f64 = 0.2 * H;
const SPEED: f64 = 0.5;
/// The force on a particle (N/m) that a wave of this speed c = 11.6 m/s brings: ρ c v per half a cell.
const FORCE: f64 = 1000.0 * 11.6 * SPEED * 0.5 * H;

pub(super) fn rubber() -> NeoHookean {
    NeoHookean::new(YOUNG, POISSON).unwrap()
}

/// A floor at the gap `gap` (m) below the particles, which carries `force` (N) a particle at half of its distance.
pub(super) fn floor(particles: &Particles<2>, gap: f64, force: f64) -> RigidContact<2> {
    let face = RigidFace::half_space(1, End::Lo, 0.0).unwrap();
    let barrier = Barrier::carrying(force, DISTANCE).unwrap();
    RigidContact::new(face.touching(particles, gap), barrier)
}

/// K with B″ is the slope of the forces with B′, of all bases and with F̄; and of sticks that were stretched before, so
/// far that no trial changes what they do: all particles that touch do the same.
pub(super) fn tangent_has_contact<const D: usize, I: Interpolation<D>, M: Law + 'static>(
    law: M,
    remedy: (Remedy, Onto),
    friction: Option<Friction>,
) {
    let mut solver = strained::<D, I, M>(law, remedy);
    // Deep enough that some particles are beyond it and gaps of others are near a tenth of it.
    let face = RigidFace::half_space(D - 1, End::Lo, 0.0).unwrap();
    let particles = &solver.scene.bodies.particles;
    let barrier = Barrier::carrying(1e3, 0.5 * H).unwrap();
    let mut contact = RigidContact::new(face.touching(particles, 0.2 * H), barrier);
    let along = [0.2 * H, -0.1 * H];
    let before = std::array::from_fn(|a| if a == D - 1 { 0.0 } else { along[a] });
    if let Some(friction) = friction {
        contact = contact.with_friction(friction);
        contact.attach(particles.len());
        contact.stick(particles.id.iter().map(|id| (*id, before)));
    }
    solver.scene.contacts.push(contact);
    let setting = solver.setting(1.0);
    let step = setting.step(&solver.scene.bodies, 1.0);
    let rest = vec![0.0; setting.unknowns.len()];
    let touching = step.trial(&rest, solver.functions.len()).unwrap().pushes;
    assert!(touching.len() > 4 && touching.len() < solver.particles().len());
    let slips = friction.is_some_and(|friction| friction.coefficient().is_some());
    for push in touching.iter().filter(|_| friction.is_some()) {
        assert_eq!(push.stretch != before, slips);
        assert!(push.force[0] < 0.0);
    }
    slope_of_the_forces(&solver);
}

#[test]
fn the_tangent_of_contact_is_the_slope_of_its_forces() {
    for remedy in [REMEDIES[0], REMEDIES[1], REMEDIES[4]] {
        every_basis!(tangent_has_contact, 2, rubber(), remedy, None);
    }
}

/// A block that flies at a floor from a gap (m).
fn thrown(rule: TimeRule, dt: f64, gap: f64) -> Solver<2> {
    let mut scene = filled([Axis::open(-2.0 * H, CELLS + 4); 2], CELLS, rubber());
    scene.bodies.particles.velocity.fill([0.1, -SPEED]);
    let contact = floor(&scene.bodies.particles, gap, FORCE);
    let settings = Settings { tolerance: 1e-12, ..Settings::new(dt).rule(rule) };
    Solver::new::<Quadratics<2>>(scene.contact(contact), settings).unwrap()
}

/// Energy of body and barrier, with what the lumped mass took (J), and the least gap (m).
fn energy_and_gap(solver: &Solver<2>) -> [f64; 2] {
    let totals = solver.totals();
    let contact = &solver.scene.contacts[0];
    let gaps = solver.particles().position.iter();
    let gaps: Vec<f64> = gaps.filter_map(|x| contact.face().gap(x)).collect();
    let stored: f64 = gaps.iter().map(|gap| contact.barrier().energy(*gap)).sum();
    let energy = totals.kinetic_energy + totals.stored_energy + stored;
    let least = gaps.into_iter().fold(f64::INFINITY, f64::min);
    [energy + totals.accumulated.lumping_loss, least]
}

/// The greatest change of the energy over its start, of a bounce of 0.4 s in steps of `dt` (s).
fn bounced(rule: TimeRule, dt: f64) -> f64 {
    let mut solver = thrown(rule, dt, 1.5 * DISTANCE);
    let [start, _] = energy_and_gap(&solver);
    let before = solver.totals();
    let (mut change, mut nearest) = (0.0_f64, f64::INFINITY);
    for _ in 0..(0.4 / dt).round() as usize {
        solver.step().unwrap();
        let [energy, gap] = energy_and_gap(&solver);
        change = change.max((energy / start - 1.0).abs());
        nearest = nearest.min(gap);
        assert!(gap > 0.0);
    }
    let after = solver.totals();
    assert!(nearest < 0.7 * DISTANCE, "{nearest}");
    assert!(after.momentum[1] > 0.5 * before.momentum[1].abs());
    let impulse = solver.on(Part::Contact(0)).impulse;
    if let TimeRule::Midpoint { .. } = rule {
        for a in 0..2 {
            let gap = after.momentum[a] - before.momentum[a] + impulse[a];
            assert!(gap.abs() < 1e-11 * before.mass * SPEED, "{gap}");
        }
        // (21): what particles gain is the work of the forces, to Newton's tolerance.
        let sums = after.accumulated;
        let gained = after.kinetic_energy - before.kinetic_energy + sums.lumping_loss;
        let given = sums.load_work - sums.stress_work;
        assert!((gained - given).abs() < 1e-8 * before.kinetic_energy);
    }
    change
}

/// Energy differs by the third derivative of the potentials along an increment: a sum of third order a step, second
/// order in all.
#[test]
fn a_block_bounces_on_the_barrier_and_keeps_its_energy() {
    let rule = TimeRule::Midpoint { lumped: 0.1 };
    let [coarse, middle, fine] = [8e-3, 4e-3, 2e-3].map(|dt| bounced(rule, dt));
    assert!(fine < 2e-4, "{coarse} {middle} {fine}");
    for ratio in [middle / fine, coarse / middle] {
        assert!((ratio - 4.0).abs() < 0.3, "{coarse} {middle} {fine}");
    }
}

#[test]
fn a_block_bounces_with_newmark_too() {
    let rule = TimeRule::Newmark { alpha: 0.25, delta: 0.5 };
    assert!(bounced(rule, 2e-3) < 0.1);
}

/// The middle of such a step is before the barrier, and its end would be in the floor.
#[test]
fn a_long_step_does_not_close_a_gap() {
    let mut solver = thrown(TimeRule::Midpoint { lumped: 0.1 }, 0.35, 3.0 * DISTANCE);
    const { assert!(0.5 * 0.35 * SPEED < 2.0 * DISTANCE && 0.35 * SPEED > 3.0 * DISTANCE) };
    solver.step().unwrap();
    assert!(energy_and_gap(&solver)[1] > 0.0);
    assert!(solver.convergence().unwrap().parts > 1);
}

/// A correction that would pass through the floor goes nine tenths of the way, and one that opens gaps all of it.
#[test]
fn a_correction_stops_before_the_first_gap_that_it_closes() {
    let solver = thrown(TimeRule::Static, 1.0, DISTANCE);
    let setting = solver.setting(1.0);
    let step = setting.step(&solver.scene.bodies, 1.0);
    let count = setting.unknowns.len();
    let rest = vec![[0.0; 2]; solver.functions.len()];
    let falls = |by: f64| -> Vec<f64> {
        let along = |k: usize| if k % 2 == 1 { -by } else { 0.0 };
        (0..count).map(along).collect()
    };
    let share = step.open_share(&rest, &falls(10.0 * DISTANCE));
    assert!((share - 0.09).abs() < 1e-12, "{share}");
    assert_eq!(step.open_share(&rest, &falls(0.5 * DISTANCE)), 1.0);
    assert_eq!(step.open_share(&rest, &falls(-10.0 * DISTANCE)), 1.0);
}

/// Between rollers, on the barrier: the floor bears the weight to Newton's tolerance.
fn rests<const D: usize, I: Interpolation<2>, M: Law + 'static>(law: M, remedy: Remedy) {
    let scene = filled([Axis::walls(0.0, CELLS), Axis::open(-2.0 * H, CELLS + 4)], CELLS, law);
    let weight = 1e3 * (H * CELLS as f64).powi(2);
    let each = weight / (2 * CELLS) as f64;
    let contact = floor(&scene.bodies.particles, 0.5 * DISTANCE, each);
    let rollers = [End::Lo, End::Hi].map(|end| Wall::new(0, end, WallKind::Roller));
    let scene = scene.constrain_all(rollers).contact(contact).load(Gravity(Box::new(|_| [0.0, -1.0])));
    let settings = Settings::new(1.0).remedy(remedy).stabilised(Stabilisation::Ghost(0.01));
    let mut solver = Solver::<2>::new::<I>(scene, settings).unwrap();
    solver.step().unwrap();
    let force = solver.on(Part::Contact(0)).force;
    assert!((force[1] + weight).abs() < 1e-8 * weight, "{force:?}");
    assert_eq!(force[0], 0.0);
    let sides: f64 = (0..2).map(|k| solver.on(Part::Constraint(k)).force[1]).sum();
    assert_eq!(sides, 0.0);
    let contact = &solver.scene.contacts[0];
    let gaps = solver.particles().position.iter();
    let gap = |x| contact.face().gap(x).unwrap();
    let mean = gaps.map(gap).filter(|gap| *gap < DISTANCE).sum::<f64>() / (2 * CELLS) as f64;
    assert!((mean / DISTANCE - 0.5).abs() < 0.05, "{mean}");
}

#[test]
fn a_floor_bears_the_weight_of_what_rests_on_it() {
    for remedy in [Remedy::None, Remedy::FbarConsistent] {
        every_basis!(rests, 2, rubber(), remedy);
    }
}

#[test]
fn a_face_across_a_periodic_axis_is_refused() {
    let axes = [Axis::walls(0.0, CELLS), Axis::periodic(0.0, CELLS)];
    let scene = filled(axes, CELLS, rubber());
    let contact = floor(&scene.bodies.particles, 0.1, 1.0);
    let solver = Solver::<2>::new::<Quadratics<2>>(scene.contact(contact), Settings::new(1.0));
    assert!(solver.err().unwrap().to_string().contains("periodic"));
}

/// A gap that no part of a step can keep open gives a typed error.
#[test]
fn a_face_that_jumps_on_the_body_is_a_typed_error() {
    let mut solver = thrown(TimeRule::Midpoint { lumped: 0.1 }, 0.01, 1.5 * DISTANCE);
    let contact = &solver.scene.contacts[0];
    let face = contact.face().clone().moving([0.0, 1e4], Amplitude::Rise(0.0)).unwrap();
    solver.scene.contacts[0] = RigidContact::new(face, contact.barrier());
    let error = solver.step().unwrap_err();
    let closed = matches!(
        error,
        Error::Breakdown {
            fault: crate::Fault::GapClosed(gap),
            ..
        } if gap <= 0.0
    );
    assert!(closed, "{error}");
}
