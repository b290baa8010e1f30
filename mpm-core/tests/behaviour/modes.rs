//! Effect of the averages on waves: the closed forms and tables of `docs/remedy.md`.

mod fluid;
mod model;

use fluid::{C, DENSITY, FLUID, scene};
use model::{Bloch, CELLS, H, KINDS, Kind, LENGTH, Moving, UNSEEN, Wave, add, noise, product, theta};
use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::remedy::{Fbar, Form};
use mpm_core::explicit::{Remedy, Solver};
use mpm_core::{Basis, Bodies, Particles, Simulation};
use nalgebra::Complex;
use std::f64::consts::TAU;

/// Identities between sums of a few weights.
const ROUNDING: f64 = 1e-12;

/// Π̂ as a polynomial in y = 1 − cos kh: the closed forms of `docs/remedy.md`.
fn hat(n: usize, y: f64) -> f64 {
    let n2 = (n * n) as f64;
    1.0 - (1.0 / 3.0 + 1.0 / (6.0 * n2)) * y
}

fn quadratic(n: usize, y: f64) -> f64 {
    let n4 = (n as f64).powi(4);
    1.0 - y / 2.0 + (1.0 / 30.0 + 7.0 / (240.0 * n4)) * y * y
}

fn cubic(n: usize, y: f64) -> f64 {
    let (n4, n6) = ((n as f64).powi(4), (n as f64).powi(6));
    let b = 1.0 / 10.0 - 7.0 / (720.0 * n4);
    let d = 1.0 / 630.0 - 7.0 / (2160.0 * n4) + 31.0 / (6048.0 * n6);
    1.0 - y * 2.0 / 3.0 + b * y * y - d * y.powi(3)
}

fn symbol_is<const S: usize, B: Basis<S> + 'static>(closed: fn(usize, f64) -> f64) {
    for n in 1..=5 {
        let (scene, settings) = scene(n, Kind::None, 0.3, 0.0);
        let solver = Solver::<2, S, B>::new(scene, settings);
        let mut solver = solver.unwrap();
        let ids: Vec<usize> = solver.particles().id.iter().map(|id| *id as usize).collect();
        for m in [[0, 0], [1, 0], [3, 2], [4, 7], [8, 0], [8, 8]] {
            let axes = m.map(|m| Bloch::<S, B>::new(n, theta(m)));
            let [x, y] = [0, 1].map(|a| axes[a].seen(0.0).0);
            let expected: f64 = m.iter().map(|m| closed(n, 1.0 - theta(*m).cos())).product();
            let count = CELLS * n;
            let place = |id: usize| [id % count, id / count];
            let on_particles = |factors: [&Wave; 2]| -> Vec<f64> {
                let of = |id| {
                    let k = place(id);
                    let q = [0, 1].map(|a| axes[a].carried(factors[a], k[a]));
                    // Neither part vanishes in general.
                    (q[0] * q[1] * Complex::cis(0.3)).re
                };
                ids.iter().map(|id| of(*id)).collect()
            };
            let field = on_particles([&x, &y]);
            let mut averaged = field.clone();
            solver.average(&mut averaged);
            for (a, q) in averaged.iter().zip(&field) {
                assert!((a - expected * q).abs() < ROUNDING, "{n} {m:?}: {a} {q}");
            }
            // A part orthogonal to φ along one axis is lost, whatever it is along the other.
            let mut null = noise(n, m[0]);
            let norm = product(&x, &x).re;
            if norm > ROUNDING {
                let share = product(&x, &null) / norm;
                add(&mut null, -share, &x);
            }
            let mut lost = on_particles([&null, &noise(n, m[1])]);
            solver.average(&mut lost);
            assert!(lost.iter().all(|a| a.abs() < ROUNDING), "{n} {m:?}");
        }
    }
}

#[test]
fn the_average_has_the_symbol_and_the_null_space_that_are_stated() {
    symbol_is::<2, Linear>(hat);
    symbol_is::<3, Gimp>(hat);
    symbol_is::<3, QuadraticBSpline>(quadratic);
    symbol_is::<4, CubicBSpline>(cubic);
}

/// Trace and determinant of the two by two matrix that advances a wave by a step, without a mean stress.
fn trace_and_determinant(kind: Kind, tau: f64, phi: &Wave, psi: &Wave) -> [f64; 2] {
    let pi = product(phi, phi).re;
    let gamma = product(psi, psi).re;
    let omega = product(phi, psi).norm_sqr();
    let seen = 1.0 - (1.0 - UNSEEN) * (1.0 - pi).powi(2);
    let g = tau
        * tau
        * match kind {
            Kind::None => gamma,
            Kind::Consistent => UNSEEN * UNSEEN * (gamma - omega / pi) + seen * seen * omega / pi,
            _ => omega,
        };
    match kind {
        Kind::Recursive => [1.0 + pi - g, pi - g * (1.0 - pi)],
        _ => [2.0 - g, 1.0 - g * (1.0 - pi)],
    }
}

/// Three waves at once on 16 cells, with a velocity that no node sees on top: each follows its two by two
/// matrix, the rest stays.
fn waves_at_rest<const S: usize, B: Basis<S> + 'static>(n: usize) {
    // Odd numbers: products of two are even, so that what is not linear stays apart.
    let axes = [1, 3, 7].map(|m| Bloch::<S, B>::new(n, theta(m)));
    let (tau, amplitude, steps) = (0.3, 1e-7 * C, 2000);
    for kind in KINDS {
        let (mut scene, settings) = scene::<1>(n, kind, tau, 0.0);
        let mut unseen = vec![0.0; scene.bodies.particles.len()];
        for axis in &axes {
            let (phi, _) = axis.seen(0.0);
            let mut null = noise(n, 0);
            let share = product(&phi, &null) / product(&phi, &phi).re;
            add(&mut null, -share, &phi);
            for (id, v) in scene.bodies.particles.velocity.iter_mut().enumerate() {
                unseen[id] += amplitude * axis.carried(&null, id).re;
                v[0] += amplitude * axis.carried(&phi, id).re;
            }
        }
        for (v, unseen) in scene.bodies.particles.velocity.iter_mut().zip(&unseen) {
            v[0] += unseen;
        }
        let mut solver = Solver::<1, S, B>::new(scene, settings).unwrap();
        solver.advance(steps).unwrap();
        let p = solver.particles();
        let mut rest: Vec<f64> = (0..p.len()).map(|k| p.velocity[k][0] - unseen[p.id[k] as usize]).collect();
        for axis in &axes {
            let (phi, psi) = axis.seen(0.0);
            let [trace, determinant] = trace_and_determinant(kind, tau, &phi, &psi);
            assert!(determinant <= 1.0 && trace.abs() <= 1.0 + determinant);
            // The first step finds no stress.
            let (mut before, mut now) = (1.0, 1.0);
            for _ in 1..steps {
                (before, now) = (now, trace * now - determinant * before);
            }
            for (k, v) in rest.iter_mut().enumerate() {
                *v -= now * amplitude * axis.carried(&phi, p.id[k] as usize).re;
            }
        }
        for v in rest {
            assert!(v.abs() < 1e-5 * amplitude, "{kind:?} {n}: {}", v / amplitude);
        }
    }
}

#[test]
fn waves_at_rest_follow_their_two_by_two_matrices() {
    waves_at_rest::<2, Linear>(3);
    waves_at_rest::<3, Gimp>(2);
    waves_at_rest::<3, QuadraticBSpline>(2);
    waves_at_rest::<4, CubicBSpline>(3);
}

/// The solver against the linear model while the particles cross two cells.
fn crossing_is_linear<const S: usize, B: Basis<S> + 'static>(n: usize, mean: f64) {
    let (tau, steps_per_cell, amplitude) = (0.3, 33, 1e-8);
    let move_of_step = H / f64::from(steps_per_cell);
    // No edge of a GIMP domain stands on a node, where ψ has a kink.
    let start = 0.37 * move_of_step;
    let axes = [1, 3, 7].map(|m| Bloch::<S, B>::new(n, theta(m)));
    for kind in KINDS {
        let (mut scene, settings) = scene::<1>(n, kind, tau, mean * DENSITY * C * C);
        for x in &mut scene.bodies.particles.position {
            x[0] += start;
        }
        let mut waves = axes.each_ref().map(|_| Moving::new(noise(n, 3)));
        for (id, v) in scene.bodies.particles.velocity.iter_mut().enumerate() {
            v[0] = move_of_step / settings.dt;
            for (axis, wave) in axes.iter().zip(&waves) {
                v[0] += amplitude * C * axis.carried(&wave.velocity, id).re;
            }
        }
        let mean_velocity = move_of_step / settings.dt;
        let mut solver = Solver::<1, S, B>::new(scene, settings).unwrap();
        for step in 0..2 * steps_per_cell {
            for (axis, wave) in axes.iter().zip(&mut waves) {
                let shift = start + f64::from(step) * move_of_step;
                wave.step(axis, kind, tau, mean, shift);
            }
            solver.step().unwrap();
        }
        let p = solver.particles();
        let scale: f64 = waves.iter().map(Moving::norm).sum();
        for k in 0..p.len() {
            let id = p.id[k] as usize;
            let carried = axes.iter().zip(&waves);
            let v: f64 = carried.map(|(a, w)| a.carried(&w.velocity, id).re).sum();
            let measured = (p.velocity[k][0] - mean_velocity) / (amplitude * C);
            assert!((measured - v).abs() < 1e-4 * scale, "{kind:?} {n} {mean}: {measured} {v}");
        }
    }
}

#[test]
fn particles_that_cross_cells_follow_the_linear_model() {
    for mean in [0.0, -0.1, 0.1] {
        crossing_is_linear::<3, Gimp>(2, mean);
        crossing_is_linear::<3, QuadraticBSpline>(2, mean);
        crossing_is_linear::<4, CubicBSpline>(3, mean);
    }
}

/// The largest factor by which a wave grows while particles, two per cell, cross a cell.
fn growth<const S: usize, B: Basis<S>>(kind: Kind, tau: f64, steps: usize, mean: f64) -> f64 {
    let of = |m| {
        let axis = Bloch::<S, B>::new(2, theta(m));
        let mut wave = Moving::new(noise(2, 3));
        let mut cross = |cells: usize| {
            for step in 0..cells * steps {
                let shift = H * ((step % steps) as f64 + 0.37) / steps as f64;
                wave.step(&axis, kind, tau, mean, shift);
            }
            wave.norm()
        };
        let cells = 50;
        (cross(cells).recip() * cross(cells)).powf(1.0 / cells as f64)
    };
    (1..=CELLS / 2).map(of).fold(0.0, f64::max)
}

/// The multipliers of `docs/remedy.md`: columns linear, uGIMP, quadratic, cubic.
#[test]
fn crossing_a_cell_feeds_waves_as_documented() {
    #[rustfmt::skip]
    let documented = [
        (0.0, Kind::None, [1.01, 1.01, 1.00, 1.00]),
        (0.0, Kind::Recursive, [1.00, 1.00, 1.00, 1.00]),
        (0.0, Kind::Total, [2.59, 2.62, 1.37, 1.07]),
        (0.0, Kind::Rate, [2.73, 2.68, 1.38, 1.08]),
        (0.0, Kind::Consistent, [1.03, 1.00, 1.00, 1.00]),
        (-0.01, Kind::None, [1.01, 1.01, 1.00, 1.00]),
        (-0.01, Kind::Recursive, [1.71, 1.07, 1.04, 1.01]),
        (-0.01, Kind::Total, [2.82, 2.62, 1.37, 1.07]),
        (-0.01, Kind::Rate, [2.97, 2.67, 1.38, 1.08]),
        (-0.01, Kind::Consistent, [1.67, 1.03, 1.02, 1.00]),
        (0.01, Kind::None, [1.01, 1.01, 1.00, 1.00]),
        (0.01, Kind::Recursive, [1.00, 1.10, 1.05, 1.01]),
        (0.01, Kind::Total, [2.36, 2.62, 1.37, 1.07]),
        (0.01, Kind::Rate, [2.50, 2.69, 1.38, 1.08]),
        (0.01, Kind::Consistent, [1.04, 1.11, 1.06, 1.01]),
    ];
    for (mean, kind, factors) in documented {
        let (tau, steps) = (0.3, 33);
        let found = [
            growth::<2, Linear>(kind, tau, steps, mean),
            growth::<3, Gimp>(kind, tau, steps, mean),
            growth::<3, QuadraticBSpline>(kind, tau, steps, mean),
            growth::<4, CubicBSpline>(kind, tau, steps, mean),
        ];
        for (found, factor) in found.iter().zip(factors) {
            // Eigenvalues there, a hundred cells here.
            assert!((found / factor - 1.0).abs() < 0.02, "{mean} {kind:?}: {found} {factor}");
        }
    }
}

/// A pressure that Π cannot see accelerates what Π cannot see either; the consistent force lets the share ε of
/// it through.
fn unseen_pressure_pushes<const S: usize, B: Basis<S> + 'static>() {
    let axis = Bloch::<S, B>::new(2, theta(7));
    let (phi, _) = axis.seen(0.0);
    let mut null = noise(2, 0);
    let share = product(&phi, &null) / product(&phi, &phi).re;
    add(&mut null, -share, &phi);
    // Small: volumes and gradients are those of the lattice to first order.
    let strain = 1e-6;
    let push = |kind| -> f64 {
        let (mut scene, settings) = scene::<1>(2, kind, 0.3, 0.0);
        let Bodies { each, mut particles } = scene.bodies;
        for (id, delta_f) in particles.delta_f.iter_mut().enumerate() {
            delta_f[(0, 0)] += strain * axis.carried(&null, id).re;
        }
        scene.bodies = Bodies::new(each[0].law.clone(), particles).unwrap();
        let mut solver = Solver::<1, S, B>::new(scene, settings).unwrap();
        solver.step().unwrap();
        let speeds = solver.particles().velocity.iter().map(|v| v[0].abs());
        speeds.fold(0.0, f64::max)
    };
    let full = push(Kind::None);
    assert!(full > 1e-2 * strain * C, "{full}");
    for kind in [Kind::Recursive, Kind::Total, Kind::Rate] {
        let share = push(kind) / full;
        assert!((share - 1.0).abs() < 1e-3, "{kind:?}: {share}");
    }
    let share = push(Kind::Consistent) / full;
    assert!((share - UNSEEN).abs() < 1e-3 * UNSEEN, "{share}");
}

#[test]
fn a_pressure_that_is_not_seen_hardly_pushes_if_the_force_is_consistent() {
    unseen_pressure_pushes::<2, Linear>();
    unseen_pressure_pushes::<3, Gimp>();
    unseen_pressure_pushes::<3, QuadraticBSpline>();
    unseen_pressure_pushes::<4, CubicBSpline>();
}

/// By how much the noise of 10⁻⁶ c in v_y grows in `steps` steps of the flow v_x = `speed` c sin(2πy/L), with
/// 2 × 2 particles per cell.
fn growth_of_noise<const S: usize, B: Basis<S> + 'static>(
    remedy: Box<dyn Remedy<2>>,
    mean: f64,
    speed: f64,
    steps: usize,
) -> f64 {
    let (mut scene, settings) = scene::<2>(2, Kind::None, 0.3, mean * DENSITY * C * C);
    let settings = settings.remedy(remedy);
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        1e-6 * C * (f64::from(state) / f64::from(u32::MAX) - 0.5)
    };
    let p = &mut scene.bodies.particles;
    for (v, x) in p.velocity.iter_mut().zip(&p.position) {
        *v = [speed * C * (TAU * x[1] / LENGTH).sin() + random(), random()];
    }
    let across = |p: &Particles<2>| -> f64 { p.velocity.iter().map(|v| v[1] * v[1]).sum() };
    let mut solver = Solver::<2, S, B>::new(scene, settings).unwrap();
    let before = across(solver.particles());
    solver.advance(steps).unwrap();
    (across(solver.particles()) / before).sqrt()
}

/// The tables of `docs/remedy.md`: the fastest particles cross twelve cells, or none moves.
#[test]
fn noise_grows_as_documented() {
    let gimp = [
        (0.0, 0.1, 396, [0.76, 0.96, 153.0, 84.3, 0.93]),
        (-0.01, 0.1, 396, [0.76, 149.0, 207.0, 170.0, 98.3]),
        (-0.01, 0.0, 300, [0.88, 27.2, 23.2, 23.2, 20.6]),
    ];
    for (mean, speed, steps, factors) in gimp {
        for (kind, factor) in KINDS.into_iter().zip(factors) {
            let found = growth_of_noise::<3, Gimp>(kind.remedy(), mean, speed, steps);
            assert!((found / factor - 1.0).abs() < 0.02, "{mean} {speed} {kind:?}: {found} {factor}");
        }
    }
    for kind in KINDS {
        let found = growth_of_noise::<3, QuadraticBSpline>(kind.remedy(), -0.01, 0.0, 300);
        assert!(found < 1.0, "{kind:?}: {found}");
    }
}

/// A pressure of a hundredth of K, and a multiple of it as the stiffness of modes that Π cannot see: the table of
/// `docs/remedy.md`. A quarter of the pressure is too little at rest.
#[test]
fn a_stiffness_above_the_pressure_stills_the_noise() {
    let growth = |times: f64, speed: f64, steps| {
        let remedy = Fbar::new(Form::Consistent).relaxing(0.0).holding(times, FLUID.bulk_modulus);
        growth_of_noise::<3, Gimp>(Box::new(remedy.unwrap()), -0.01, speed, steps)
    };
    let table = [(0.25, 0.0, 300, 3.63), (1.0, 0.0, 300, 1.02), (10.0, 0.0, 300, 0.89), (10.0, 0.1, 396, 0.84)];
    for (times, speed, steps, factor) in table {
        let found = growth(times, speed, steps);
        assert!((found / factor - 1.0).abs() < 0.02, "{times} {speed}: {found} {factor}");
    }
}

/// The wave of two cells at rest under a mean stress, where no average sees its strain: what is left of its
/// stiffness is `mean` times `geometric`.
fn shortest_wave_is_fed<const S: usize, B: Basis<S> + 'static>(n: usize, mean: f64, geometric: f64) {
    let axis = Bloch::<S, B>::new(n, theta(CELLS / 2));
    let (mut phi, psi) = axis.seen(0.0);
    let turn = phi[0].conj() / phi[0].norm();
    phi.iter_mut().for_each(|f| *f *= turn);
    let (tau, amplitude, steps) = (0.3, 1e-8 * C, 200);
    for kind in [Kind::Total, Kind::Rate, Kind::Consistent] {
        let (mut scene, settings) = scene::<1>(n, kind, tau, mean * DENSITY * C * C);
        for (id, v) in scene.bodies.particles.velocity.iter_mut().enumerate() {
            v[0] = amplitude * axis.carried(&phi, id).re;
        }
        let mut solver = Solver::<1, S, B>::new(scene, settings).unwrap();
        solver.advance(steps).unwrap();
        // J̄ takes the share ε of the strain, and the force that of the stress (J̄/J) σ.
        let held = if kind == Kind::Consistent {
            let square = UNSEEN * UNSEEN;
            product(&psi, &psi).re * (square + mean * (square - UNSEEN))
        } else {
            0.0
        };
        let g = tau * tau * (mean * geometric + held);
        let determinant = 1.0 - g * (1.0 - product(&phi, &phi).re);
        let (mut before, mut now) = (1.0, 1.0);
        for _ in 1..steps {
            (before, now) = (now, (2.0 - g) * now - determinant * before);
        }
        assert!(now > 5.0, "{now}");
        let p = solver.particles();
        for k in 0..p.len() {
            let expected = now * axis.carried(&phi, p.id[k] as usize).re;
            let measured = p.velocity[k][0] / amplitude;
            assert!((measured - expected).abs() < 1e-5 * now, "{kind:?} {n}: {measured} {expected}");
        }
    }
}

#[test]
fn a_mean_stress_feeds_the_shortest_wave_at_rest() {
    for n in [2, 3] {
        shortest_wave_is_fed::<2, Linear>(n, -0.01, 4.0);
        shortest_wave_is_fed::<3, QuadraticBSpline>(n, 0.1, -2.0 / (n * n) as f64);
    }
}
