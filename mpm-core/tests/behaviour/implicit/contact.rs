//! Contact by the barrier: what it keeps, what it bears, and gaps that stay open.

use super::dynamics::{NEWMARK, rubber};
use super::*;
use mpm_core::contact::{Barrier, RigidContact, RigidFace};
use mpm_core::stage::Gravity;

/// Where the barrier begins (m).
const DISTANCE: f64 = 0.2 * H;
const SPEED: f64 = 0.5;
/// The force on a particle (N/m) that a wave of this speed c = 11.6 m/s brings: ρ c v per half a cell.
const FORCE: f64 = 1000.0 * 11.6 * SPEED * 0.5 * H;

/// A floor at the gap `gap` (m) below the particles, which carries `force` (N) a particle at half of its distance.
pub(super) fn floor(particles: &Particles<2>, gap: f64, force: f64) -> RigidContact<2> {
    let face = RigidFace::half_space(1, End::Lo, 0.0).unwrap();
    let barrier = Barrier::carrying(force, DISTANCE).unwrap();
    RigidContact::new(face.touching(particles, gap), barrier)
}

/// A block that flies at a floor from a gap (m).
fn thrown(rule: TimeRule, dt: f64, gap: f64) -> Solver<2> {
    let mut scene = filled([Axis::open(-2.0 * H, CELLS + 4); 2], CELLS, Places::Uniform, rubber());
    scene.bodies.particles.velocity.fill([0.1, -SPEED]);
    let contact = floor(&scene.bodies.particles, gap, FORCE);
    let settings = Settings { tolerance: 1e-12, ..Settings::new(dt).rule(rule) };
    Solver::new::<Quadratics<2>>(scene.contact(contact), settings).unwrap()
}

/// Energy of body and barrier, with what the lumped mass took (J), and the least gap (m).
fn energy_and_gap(solver: &Solver<2>) -> [f64; 2] {
    let totals = solver.totals();
    let contact = &solver.scene().contacts[0];
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
    assert!(bounced(NEWMARK, 2e-3) < 0.1);
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

/// Between rollers, on the barrier: the floor bears the weight to Newton's tolerance.
fn rests<const D: usize, I: Interpolation<2>, M: Law + 'static>(law: M, remedy: Remedy) {
    let scene = filled([Axis::walls(0.0, CELLS), Axis::open(-2.0 * H, CELLS + 4)], CELLS, Places::Uniform, law);
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
    let contact = &solver.scene().contacts[0];
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
    let scene = filled(axes, CELLS, Places::Uniform, rubber());
    let contact = floor(&scene.bodies.particles, 0.1, 1.0);
    let solver = Solver::<2>::new::<Quadratics<2>>(scene.contact(contact), Settings::new(1.0));
    assert!(solver.err().unwrap().to_string().contains("periodic"));
}
