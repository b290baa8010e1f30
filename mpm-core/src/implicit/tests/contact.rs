//! Contact by the barrier: its tangent, and gaps that stay open.

use super::stiffness::{REMEDIES, slope_of_the_forces, strained};
use super::*;
use crate::contact::{Barrier, Friction, RigidContact, RigidFace};
use crate::stage::Amplitude;

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
