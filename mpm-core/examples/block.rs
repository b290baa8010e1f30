//! A block of nearly incompressible rubber, 1 m wide and 1 m high, sags under its weight: without a remedy, and with
//! F̄. Prints by how much the middle of its top has sunk and how rough the pressure is.
//!
//! `cargo run --release -p mpm-core --example block`

use mpm_core::basis::QuadraticBSpline;
use mpm_core::explicit::remedy::{Fbar, Form, Standard};
use mpm_core::explicit::{Remedy, Settings, Solver, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::stage::{BodyForce, End, LocalDamping, Wall, WallKind};
use mpm_core::{Axis, Bodies, Error, Field, Grid, Particles, Scene, Simulation};
use std::io::{Write, stdout};

const CELL: f64 = 0.125;
const PER_SIDE: usize = 16;
const DENSITY: f64 = 1000.0;
const GRAVITY: f64 = 9.81;
/// Time in which the block comes to rest (s).
const DURATION: f64 = 2.0;

/// How far the middle of the top sinks (m), and the rms of the pressure less its average, over that of the pressure.
fn sag(remedy: Box<dyn Remedy<2>>) -> Result<(f64, f64), Error> {
    // Two particles per direction and cell, in the middle of the grid.
    let size = 0.5 * CELL;
    let place = |k: usize| (k as f64 + 0.5) * size;
    let positions: Vec<[f64; 2]> =
        (0..PER_SIDE * PER_SIDE).map(|k| [1.0 + place(k % PER_SIDE), place(k / PER_SIDE)]).collect();
    let particles = Particles::new(positions, size * size, DENSITY, [0.5 * size; 2])?;
    let law = NeoHookean::new(1e5, 0.499)?;

    // The floor holds the lower end of the second axis; two cells are spare above.
    let grid = Grid::new(CELL, [Axis::walls(0.0, 24), Axis::walls(0.0, 10)])?;
    let floor = Wall::new(1, End::Lo, WallKind::Fixed);
    let dt = courant_time_step(0.3, CELL, law.wave_speed(DENSITY));
    let scene = Scene::new(grid, Bodies::new(law, particles)?)
        .load(BodyForce(Box::new(|_, _| [0.0, -GRAVITY])))
        .constrain(floor);
    let settings = Settings::new(dt).remedy(remedy).filter_forces(LocalDamping::new(0.1)?);

    // Three functions of a quadratic spline are non-zero at a point.
    let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings)?;
    while solver.time() < DURATION {
        solver.step()?;
    }

    let particles = solver.particles();
    let top = (0..particles.len()).filter(|&p| {
        let [x, y] = particles.reference[p];
        (x - 1.5).abs() < CELL && y > 1.0 - size
    });
    let sunk: Vec<f64> = top.map(|p| particles.reference[p][1] - particles.position[p][1]).collect();
    let [stress, smooth] = [Field::MeanStress, Field::AveragedMeanStress].map(|f| solver.field(f));
    let rough: f64 = stress.iter().zip(&smooth).map(|(s, a)| (s - a).powi(2)).sum();
    let all: f64 = stress.iter().map(|s| s * s).sum();
    Ok((sunk.iter().sum::<f64>() / sunk.len() as f64, (rough / all).sqrt()))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for (name, remedy) in
        [("none", Box::new(Standard) as Box<dyn Remedy<2>>), ("fbar-consistent", Box::new(Fbar::new(Form::Consistent)))]
    {
        let (sunk, rough) = sag(remedy)?;
        writeln!(stdout(), "{name:16} sinks by {:.2} mm, noise {rough:.2}", 1e3 * sunk)?;
    }
    Ok(())
}
