//! Blocks that slide, stick and are taken along.

use super::*;
use mpm_core::stage::Amplitude;

/// A block with friction `mu` at the speed `speed`, under gravity of the slope `slope`.
pub(super) fn on_a_slope(mu: f64, slope: f64, speed: f64) -> Setting<2> {
    let mut particles = block::<2>(16);
    particles.velocity.fill([speed, 0.0]);
    let contact =
        RigidContact::new(floor(&particles, REST_GAP), barrier()).with_friction(Friction::new(mu, stick()).unwrap());
    under(scene(particles, vec![contact]), move |_| [slope * GRAVITY, -GRAVITY])
}

/// While all slide, the stick of each is on Coulomb's cone in every step: it stretches in a step by more than its limit
/// grows. So the momentum along the floor is that of the slope less μ times that of the floor, except for the first
/// step, in which no stick is stretched yet, or from rest the time t in which they are stretched to their limit u, u =
/// ½ a t² with an acceleration of at least that of the slide.
#[test]
fn a_sliding_block_follows_coulomb() {
    let mu = 0.3;
    let limit = mu * LOAD / stick();
    for (slope, speed) in [(0.0, 0.3), (0.5, 0.3), (0.5, 0.0)] {
        let scene = on_a_slope(mu, slope, speed);
        let stretching = match speed {
            0.0 => (2.0 * limit / ((slope - mu) * GRAVITY)).sqrt(),
            _ => scene.1.dt,
        };
        let mut solver = started(scene).unwrap();
        while solver.time() < 6.0 {
            solver.step().unwrap();
            let [along, across, _] = solver.on(Part::Contact(0)).force;
            assert!(along <= -mu * across * (1.0 + ROUNDING));
        }
        let (totals, time) = (solver.totals(), solver.time());
        let [u, v] = [0, 1].map(|a| totals.momentum[a] / totals.mass);
        let slid = speed + slope * GRAVITY * time - mu * (GRAVITY * time + v);
        let short = u - slid;
        assert!(short >= -ROUNDING && short <= mu * GRAVITY * stretching + ROUNDING, "{short}");
        assert!(solver.work().sorts > 1 || speed == 0.0);
    }
}

/// Below the angle of friction a block stays: the sticks give way elastically and come to rest.
#[test]
fn a_block_sticks_below_the_angle_of_friction() {
    let (mu, slope) = (0.6, 0.5);
    let mut solver = started(damped(on_a_slope(mu, slope, 0.0))).unwrap();
    run(&mut solver, 200.0);
    let (weight, left) = (solver.totals().mass * GRAVITY, out_of_balance(&solver));
    assert!(left < AT_REST * weight, "{left}");
    assert!((solver.on(Part::Contact(0)).force[0] - slope * weight).abs() <= left + ROUNDING * weight);
    let stretch = slope * LOAD / stick();
    let before = shift(&solver, 0);
    // Sticks may have given up some stretch in the oscillations before rest, at most their limit.
    assert!(before >= 0.999 * stretch && before < stretch + mu * LOAD / stick());
    run(&mut solver, 240.0);
    assert!((shift(&solver, 0) - before).abs() < 1e-6 * stretch);
}

/// A rough contact under a shear load that comes and goes: it gives way by the load over the stick's stiffness, then
/// stays, then comes back.
#[test]
fn a_rough_stick_does_not_creep() {
    let particles = block::<2>(16);
    let contact =
        RigidContact::new(floor(&particles, REST_GAP), barrier()).with_friction(Friction::rough(stick()).unwrap());
    let shear = 0.5 * GRAVITY;
    let scene = damped(under(scene(particles, vec![contact]), move |t| {
        let share = [40.0, 120.0].map(|begin: f64| Amplitude::Rise(5.0).at((t - begin).max(0.0)));
        let share = share[0] - share[1];
        [share * shear, -GRAVITY]
    }));
    let dt = scene.1.dt;
    let mut solver = started(scene).unwrap();
    let [start, early, late, back] = [40.0, 80.0, 120.0, 200.0].map(|until| {
        run(&mut solver, until);
        shift(&solver, 0)
    });
    let stretch = shear / GRAVITY * LOAD / stick();
    assert!((early - start - stretch).abs() < 1e-4 * stretch);
    // A friction by slip speed creeps by a step per step: τ Δt/(ρ l).
    let viscous = shear * LAYERS as f64 * dt;
    assert!((late - early).abs() < 1e-6 * viscous * 40.0);
    assert!((back - start).abs() < 1e-6 * stretch);
}

/// A rough plate takes along a block that is pulled back, and lifts it, across cells; then the block follows its
/// stroke, except that the stick and the barrier give way. The plate's ramp, of jerk 6 v/T² at its ends, leaves an
/// oscillation of at most four times the jerk over ω³. That of the lift is smaller, by the ratio of the speeds.
#[test]
fn a_moving_plate_takes_a_block_along() {
    let particles = block::<2>(16);
    let (speed, ramp, pull) = ([0.1, 0.02], 12.0, -0.05);
    let face = floor(&particles, REST_GAP).moving(speed, Amplitude::Rise(ramp)).unwrap();
    let contact = RigidContact::new(face.clone(), barrier()).with_friction(Friction::rough(stick()).unwrap());
    let mut solver =
        started(under(scene(particles, vec![contact]), move |t| [pull * Amplitude::Rise(12.0).at(t), -GRAVITY]))
            .unwrap();
    run(&mut solver, 30.0);
    assert!(solver.work().sorts > 3);
    let stroke = Amplitude::Rise(ramp).integral(solver.time());
    let moved = face.displacement(solver.time());
    assert_eq!(moved, [0.1 * stroke, 0.02 * stroke]);
    let mass_per_stick = LOAD / GRAVITY;
    let omega = (stick() / mass_per_stick).sqrt();
    let stretch = pull * mass_per_stick / stick();
    let swing = 4.0 * 6.0 * (speed[0] - pull / omega) / ramp.powi(2) / omega.powi(3);
    let slip = shift(&solver, 0) - moved[0] - stretch;
    assert!(slip.abs() < swing, "{slip} {swing}");
    assert!(swing < -0.5 * stretch);
    assert!((shift(&solver, 1) - moved[1]).abs() < swing);
    assert!(least(&gaps(&solver, &face, &moved)) > 0.0);
}

#[test]
fn a_stick_is_a_spring() {
    let friction = Friction::new(0.5, 100.0).unwrap();
    let mut stretch = [0.03, 0.0, -0.04];
    assert_eq!(friction.force(&mut stretch, 10.1), [-3.0, 0.0, 4.0]);
    assert_eq!(stretch, [0.03, 0.0, -0.04]);
}

#[test]
fn a_slip_returns_along_a_radius_to_coulombs_cone() {
    let friction = Friction::new(0.5, 100.0).unwrap();
    let mut stretch = [0.3, 0.0, -0.4];
    let force = friction.force(&mut stretch, 2.0);
    for (f, sought) in force.iter().zip([-0.6, 0.0, 0.8]) {
        assert!((f - sought).abs() < 1e-15);
    }
    assert!((stretch[0] - 0.006).abs() < 1e-17 && (stretch[2] + 0.008).abs() < 1e-17);
    // Stretch that was given up does not come back.
    assert_eq!(friction.force(&mut stretch, 20.0), force);
}

#[test]
fn bad_friction_is_refused() {
    assert!(Friction::new(-0.1, 1.0).is_err());
    assert!(Friction::new(f64::INFINITY, 1.0).is_err());
    assert!(Friction::new(0.1, 0.0).is_err());
    assert!(Friction::rough(f64::NAN).is_err());
}
