//! Momentum, energy and time order of what moves.

use super::*;
use mpm_core::stage::{Amplitude, Gravity, RigidNodes};

const MIDPOINT: TimeRule = TimeRule::Midpoint { lumped: 0.05 };
pub(super) const NEWMARK: TimeRule = TimeRule::Newmark { alpha: 0.25, delta: 0.5 };
/// A wave crosses a cell in 25 ms.
const DT: f64 = 0.01;

/// A block in the middle of a grid of `CELLS` + 4 cells that turns, stretches and drifts.
pub(super) fn tumbling<M: Law + 'static>(law: M) -> Scene<2> {
    let mut scene = filled([Axis::open(0.0, CELLS + 4); 2], CELLS, Places::Uniform, law);
    let shift = 2.0 * H;
    let p = &mut scene.bodies.particles;
    for k in 0..p.len() {
        let [x, y] = p.position[k];
        p.velocity[k] = [0.3 - 0.8 * (y - CENTRE) + 0.5 * (x - CENTRE), 0.1 + 1.1 * (x - CENTRE)];
        p.position[k] = [x + shift, y + shift];
        p.reference[k] = p.position[k];
    }
    scene
}

pub(super) fn rubber() -> NeoHookean {
    NeoHookean::new(YOUNG, POISSON).unwrap()
}

fn moving<I: Interpolation<2>, M: Law + 'static>(law: M, rule: TimeRule) -> Solver<2> {
    let settings = Settings { tolerance: 1e-12, ..Settings::new(DT).rule(rule) };
    Solver::new::<I>(tumbling(law), settings).unwrap()
}

/// Nothing outside acts: both rules keep linear momentum, and Newton's tolerance does not matter to the midpoint rule.
fn keeps_momentum<const D: usize, I: Interpolation<2>, M: Law + Clone + 'static>(law: M) {
    for rule in [MIDPOINT, NEWMARK] {
        let mut solver = moving::<I, M>(law.clone(), rule);
        let before = solver.totals().momentum;
        solver.advance(5).unwrap();
        let after = solver.totals().momentum;
        for a in 0..2 {
            let change = (after[a] - before[a]).abs();
            assert!(change < 1e-12 * before[0], "{rule:?}: {change}");
        }
    }
}

#[test]
fn momentum_is_kept() {
    every_basis!(keeps_momentum, 2, rubber());
}

/// ΔT + F_int · u = −½ β Δvᵀ (M_l − M_c) Δv, whatever the body does.
fn balances<const D: usize, I: Interpolation<2>, M: Law + 'static>(law: M) {
    let mut solver = moving::<I, M>(law, MIDPOINT);
    for _ in 0..5 {
        let before = solver.totals();
        solver.step().unwrap();
        let after = solver.totals();
        let [before_sums, after_sums] = [before.accumulated, after.accumulated];
        let gained = after.kinetic_energy - before.kinetic_energy;
        let given = after_sums.stress_work - before_sums.stress_work;
        let lost = after_sums.lumping_loss - before_sums.lumping_loss;
        assert!(lost > 0.0);
        let gap = gained + given + lost;
        assert!(gap.abs() < 1e-8 * before.kinetic_energy, "{gap}");
        assert!(lost > 1e3 * gap.abs(), "{lost}");
    }
}

#[test]
fn the_midpoint_rule_loses_what_the_lumped_mass_takes() {
    every_basis!(balances, 2, rubber());
}

/// Constant acceleration is exact with both rules.
#[test]
fn a_body_falls_freely() {
    for rule in [MIDPOINT, NEWMARK] {
        let mut scene = filled([Axis::open(0.0, 8); 2], CELLS, Places::Uniform, rubber());
        for x in &mut scene.bodies.particles.position {
            *x = x.map(|x| x + 3.0 * H);
        }
        let scene = scene.load(Gravity(Box::new(|_| [0.0, -9.81])));
        let settings = Settings { tolerance: 1e-13, ..Settings::new(DT).rule(rule) };
        let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
        solver.advance(10).unwrap();
        let time: f64 = 10.0 * DT;
        let p = solver.particles();
        for ((x0, x), v) in p.reference.iter().zip(&p.position).zip(&p.velocity) {
            let fallen = x[1] - (x0[1] + 3.0 * H);
            assert!((fallen + 0.5 * 9.81 * time * time).abs() < 1e-9, "{rule:?}");
            assert!((v[1] + 9.81 * time).abs() < 1e-9 && v[0].abs() < 1e-9, "{rule:?}");
        }
    }
}

/// A body that is held all over follows what holds it, whose speed rises meanwhile.
#[test]
fn what_is_held_moves_as_it_is_told_at_every_time() {
    const SPEED: f64 = 0.3;
    let amplitude = Amplitude::Rise(6.0 * DT);
    let extent = [[f64::NEG_INFINITY, f64::INFINITY]; 2];
    let plate = RigidNodes { extent, velocity: [Some(SPEED), None], amplitude: amplitude.clone() };
    let mut scene = tumbling(rubber());
    scene.bodies.particles.velocity.fill([0.0; 2]);
    let settings = Settings::new(DT).rule(MIDPOINT);
    let scene = scene.constrain(plate);
    let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
    for _ in 0..8 {
        solver.step().unwrap();
        let speed = SPEED * amplitude.at(solver.time());
        for [vx, vy] in &solver.particles().velocity {
            assert!((vx - speed).abs() < 1e-12 && vy.abs() < 1e-12, "{vx} {vy}");
        }
    }
}

/// A box between rollers that swings along its first axis.
fn swinging() -> Scene<2> {
    let mut scene = full::<2, _>(CELLS, Places::Uniform, rubber());
    let p = &mut scene.bodies.particles;
    for (x, v) in p.position.iter().zip(&mut p.velocity) {
        *v = [0.1 * (std::f64::consts::PI * x[0] / (H * CELLS as f64)).sin(), 0.0];
    }
    let roller = |axis, end| Wall::new(axis, end, WallKind::Roller);
    let ends = [0, 1].map(|axis| [roller(axis, End::Lo), roller(axis, End::Hi)]);
    scene.constrain_all(ends.into_iter().flatten())
}

/// Positions of the box's particles after 0.08 s in this number of steps, in seeding order.
fn swung(rule: TimeRule, steps: u32) -> Vec<[f64; 2]> {
    let settings = Settings { tolerance: 1e-12, ..Settings::new(0.08 / f64::from(steps)).rule(rule) };
    let mut solver = Solver::<2>::new::<Quadratics<2>>(swinging(), settings).unwrap();
    solver.advance(steps as usize).unwrap();
    let p = solver.particles();
    p.seeded(|k| p.position[k])
}

fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let squares = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// The error of the displacement falls with the square of the step.
#[test]
fn the_midpoint_rule_is_of_second_order() {
    let rule = TimeRule::Midpoint { lumped: 0.0 };
    let runs = [8, 16, 32].map(|steps| swung(rule, steps));
    let ratio = apart(&runs[0], &runs[1]) / apart(&runs[1], &runs[2]);
    assert!((ratio - 4.0).abs() < 0.3, "{ratio}");
}

/// Between walls, with the same mass, both rules swing alike: at small strains they differ only by what particles take
/// from the nodes.
#[test]
fn the_rules_agree_between_walls() {
    let start = swinging().bodies.particles.position;
    let both = [TimeRule::Midpoint { lumped: 1.0 }, NEWMARK].map(|rule| swung(rule, 32));
    let moved = apart(&both[0], &start);
    let gap = apart(&both[0], &both[1]) / moved;
    assert!(gap < 0.02, "{gap}");
}

#[test]
fn unstable_rules_are_refused() {
    let refused = |rule: TimeRule, what: &str| {
        let error = Solver::<2>::new::<Means<2>>(tumbling(rubber()), Settings::new(DT).rule(rule));
        let error = error.err().unwrap().to_string();
        assert!(error.contains(what), "{error}");
    };
    refused(TimeRule::Midpoint { lumped: 1.5 }, "lumped mass");
    let newmark = |alpha, delta| TimeRule::Newmark { alpha, delta };
    refused(newmark(0.25, 0.4), "delta");
    refused(newmark(0.1, 0.5), "alpha");
}

/// The roots of Newmark's step on a swing without damping, of trace 2 − q (½ + δ)/(1 + α q) and determinant
/// 1 − q (δ − ½)/(1 + α q) with q = ω²Δt², lie in the unit disc for every step if and only if the settings are allowed.
#[test]
fn newmarks_parameters_are_allowed_where_every_step_is_stable() {
    for k in 0..=20 {
        for l in 0..=20 {
            let (alpha, delta) = (0.05 * f64::from(k) + 1e-3, 0.3 + 0.05 * f64::from(l) + 1e-3);
            let stable = (-30..60).all(|power| {
                let q = 1.5_f64.powi(power);
                let trace = 2.0 - q * (0.5 + delta) / (1.0 + alpha * q);
                let determinant = 1.0 - q * (delta - 0.5) / (1.0 + alpha * q);
                determinant.abs() <= 1.0 && trace.abs() <= 1.0 + determinant
            });
            let settings = Settings::new(1.0).rule(TimeRule::Newmark { alpha, delta });
            let scene = filled([Axis::open(0.0, 4)], 1, Places::Uniform, rubber());
            let allowed = Solver::<1>::new::<Hats<1>>(scene, settings).is_ok();
            // Between δ/2 and this the roots of long steps are in the disc, and real.
            let least = 0.25 * (delta + 0.5) * (delta + 0.5);
            if allowed {
                assert!(stable, "{alpha} {delta}");
            }
            if delta < 0.5 || 2.0 * alpha < delta {
                assert!(!stable && !allowed, "{alpha} {delta}");
            }
            assert_eq!(allowed, delta >= 0.5 && alpha >= least);
        }
    }
}
