//! The two problems: a standing wave and a dam break.

use crate::Options;
use crate::fluid::{Axis, Basis, Fluid, GRAVITY};
use std::f64::consts::PI;

/// The two problems.
#[derive(Clone, Copy)]
pub enum Problem {
    Wave(Basis, usize),
    Dam,
}

const WAVE: (f64, f64, f64) = (PI, 0.5, 0.01);

pub fn wave_frequency() -> f64 {
    (GRAVITY * WAVE.0 * (WAVE.0 * WAVE.1).tanh()).sqrt()
}

pub fn wave_shape([x, y]: [f64; 2]) -> [f64; 2] {
    let (k, depth, _) = WAVE;
    let scale = 1.0 / (k * depth).sinh();
    [
        -scale * (k * y).cosh() * (k * x).sin(),
        scale * (k * y).sinh() * (k * x).cos(),
    ]
}

/// A fluid at the start of a problem, the number of steps and their length (s).
pub fn begin(problem: Problem, options: &Options) -> (Fluid, usize, f64) {
    let (basis, h, width, length, depth, density, modulus, own) = match problem {
        Problem::Wave(basis, n) => (basis, 1.0 / n as f64, 1.0, 1.0, WAVE.1, 1000.0, 2.5e6, 4.0),
        Problem::Dam => (Basis::Gimp, 0.25, 6.0, 4.0, 2.0, 997.5, 2e9, 5.0),
    };
    let per_cell = if options.particles > 0.0 {
        options.particles
    } else {
        own
    };
    let (spacing, cells) = (h / per_cell, |length: f64| (length / h).round() as usize);
    let most = 0.3 * h / f64::sqrt(modulus / density);
    let (steps, dt) = match problem {
        Problem::Wave(..) => {
            let n = (24.0 / most).ceil();
            (n as usize, 24.0 / n)
        }
        Problem::Dam => {
            let row = (0.005 / most).ceil();
            ((200.0 * options.duration * row).round() as usize, 0.005 / row)
        }
    };
    let up = match problem {
        Problem::Wave(..) => cells(depth) + 4,
        Problem::Dam => cells(16.0),
    };
    let axis = |cells, far_wall| Axis {
        basis,
        cells,
        h,
        half: 0.5 * spacing,
        far_wall,
    };
    let count = |length: f64| (length / spacing).round() as usize;
    let place = |i: usize| (i as f64 + 0.5) * spacing;
    let start: Vec<[f64; 2]> = (0..count(length))
        .flat_map(|i| (0..count(depth)).map(move |j| [place(i), place(j)]))
        .collect();
    let weight = density * GRAVITY;
    let moving = match problem {
        Problem::Wave(..) => options.amplitude * WAVE.2 * wave_frequency() * (0.5 * wave_frequency() * dt).cos(),
        Problem::Dam => 0.0,
    };
    let j: Vec<f64> = start.iter().map(|x| 1.0 - weight * (depth - x[1]) / modulus).collect();
    let sunk = |x: &[f64; 2]| [x[0], x[1] - weight * x[1] * (2.0 * depth - x[1]) / (2.0 * modulus)];
    let fluid = Fluid {
        axes: [axis(cells(width), true), axis(up, false)],
        density,
        modulus,
        x: start.iter().map(sunk).collect(),
        v: start.iter().map(|x| wave_shape(*x).map(|u| u * moving)).collect(),
        volume0: spacing * spacing,
        j_bar: j.clone(),
        j,
        seen: vec![[(0, [0.0; 3], [0.0; 3]); 2]; start.len()],
        start,
        node_volume: Vec::new(),
    };
    (fluid, steps, dt)
}
