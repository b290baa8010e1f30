//! Instructions of a step, counted by Callgrind: exact numbers to gate on, whatever else the machine does.
//!
//! `.ci/instructions BASE` compares them with those of another commit.

#![allow(missing_docs, reason = "what the macros make has no documentation")]

use gungraun::{library_benchmark, library_benchmark_group, main};
use mpm_core::basis::{Gimp, QuadraticBSpline, WallTreatment};
use mpm_core::material::{HenckyJ2, Law, NewtonianFluid, Strength};
use mpm_core::remedy::{FbarConsistent, FbarRecursive, Standard};
use mpm_core::solver::courant_time_step;
use mpm_core::transfer::Flip;
use mpm_core::{Axis, Basis, Error, Grid, Particles, Remedy, Scene, Simulation, Solver};
use rayon::ThreadPoolBuilder;
use std::hint::black_box;

/// Steps that are counted.
const STEPS: usize = 10;
/// Cells of the body along each axis.
const CELLS: usize = 12;
/// Cells on every side of it.
const MARGIN: usize = 3;

/// A square or cube that is sheared and squeezed, so that soil yields everywhere.
fn begin<const D: usize, B: Basis<3> + 'static, M: Law + 'static>(
    law: Result<M, Error>,
    remedy: impl Remedy<D> + 'static,
) -> Result<Box<dyn Simulation<D>>, Error> {
    // Everything on this thread, the one whose instructions are counted.
    let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    // The pool may stand already.
    let _ = pool.build_global();
    let law = law?;
    let density = 2000.0;
    let n = 2 * CELLS;
    let place = |k: usize| MARGIN as f64 + 0.5 * (k as f64 + 0.55);
    let positions = (0..n.pow(D as u32))
        .map(|k| std::array::from_fn(|a| place(k / n.pow(a as u32) % n)))
        .collect();
    let mut particles = Particles::new(positions, 0.5f64.powi(D as i32), density, [0.25; D])?;
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        v[0] = 2.0 * x[1] - x[0];
    }
    let dt = courant_time_step(0.3, 1.0, law.wave_speed(density));
    let scene = Scene {
        grid: Grid::new(1.0, [Axis::open(0.0, CELLS + 2 * MARGIN); D])?,
        wall: WallTreatment::OpenKnot,
        law,
        transfer: Flip::default(),
        particles,
        remedy: Box::new(remedy),
        loads: Vec::new(),
        contacts: Vec::new(),
        force_filters: Vec::new(),
        constraints: Vec::new(),
        particle_filters: Vec::new(),
        dt,
    };
    let mut simulation = Solver::<D, 3, B, M, Flip>::new(scene)?;
    // Plastic from here on.
    for _ in 0..STEPS {
        simulation.step()?;
    }
    Ok(Box::new(simulation))
}

fn soil() -> Result<HenckyJ2, Error> {
    HenckyJ2::new(25e6, 0.49, Strength::softening(40.82e3, 2.45e3, 5.0)?)
}

fn fluid() -> Result<NewtonianFluid, Error> {
    NewtonianFluid::new(2e6, 1e-3)
}

type Begun<const D: usize> = Result<Box<dyn Simulation<D>>, Error>;

#[library_benchmark]
#[bench::soil_gimp(begin::<2, Gimp, _>(soil(), Standard))]
#[bench::soil_gimp_consistent(begin::<2, Gimp, _>(soil(), FbarConsistent::default()))]
#[bench::soil_bspline2_recursive(begin::<2, QuadraticBSpline, _>(soil(), FbarRecursive::default()))]
#[bench::fluid_bspline2(begin::<2, QuadraticBSpline, _>(fluid(), Standard))]
fn plane_strain(simulation: Begun<2>) -> Begun<2> {
    steps(simulation)
}

#[library_benchmark]
#[bench::soil_gimp(begin::<3, Gimp, _>(soil(), Standard))]
#[bench::soil_gimp_consistent(begin::<3, Gimp, _>(soil(), FbarConsistent::default()))]
#[bench::soil_bspline2_recursive(begin::<3, QuadraticBSpline, _>(soil(), FbarRecursive::default()))]
fn space(simulation: Begun<3>) -> Begun<3> {
    steps(simulation)
}

/// The steps; an error stays what it is, and counts next to nothing.
fn steps<const D: usize>(simulation: Begun<D>) -> Begun<D> {
    let mut simulation = simulation?;
    for _ in 0..STEPS {
        simulation.step()?;
    }
    black_box(Ok(simulation))
}

library_benchmark_group!(name = step, benchmarks = [plane_strain, space]);
main!(library_benchmark_groups = step);
