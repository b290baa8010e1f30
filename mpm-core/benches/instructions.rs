//! Instructions of a step, counted by Callgrind: exact numbers to gate on, whatever else the machine does.
//!
//! `.ci/instructions BASE` compares them with those of another commit.

#![allow(missing_docs, reason = "what the macros make has no documentation")]

mod body;

use body::{fluid, sheared, soil, solid};
use gungraun::{library_benchmark, library_benchmark_group, main};
use mpm_core::basis::{Gimp, QuadraticBSpline};
use mpm_core::explicit::Remedy;
use mpm_core::explicit::remedy::{Fbar, Form, Standard};
use mpm_core::explicit::transfer::Flip;
use mpm_core::material::Law;
use mpm_core::{Basis, Error, Simulation};
use rayon::ThreadPoolBuilder;
use std::hint::black_box;

/// Steps that are counted.
const STEPS: usize = 10;
/// Particles of the body along each axis.
const PARTICLES: usize = 24;

/// A body that moves so fast that soil yields everywhere.
fn begin<const D: usize, B: Basis<3> + 'static>(
    law: Result<impl Law + 'static, Error>,
    remedy: impl Remedy<D> + 'static,
) -> Result<Box<dyn Simulation<D>>, Error> {
    // Everything on this thread, the one whose instructions are counted.
    let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    // The pool may stand already.
    let _ = pool.build_global();
    let mut simulation = sheared::<D, 3, B, _>(PARTICLES, 1.0, law?, remedy, Flip::default())?;
    // Plastic from here on.
    for _ in 0..STEPS {
        simulation.step()?;
    }
    Ok(Box::new(simulation))
}

type Begun<const D: usize> = Result<Box<dyn Simulation<D>>, Error>;

#[library_benchmark]
#[bench::soil_gimp(begin::<2, Gimp>(soil(), Standard))]
#[bench::soil_gimp_consistent(begin::<2, Gimp>(soil(), Fbar::new(Form::Consistent)))]
#[bench::soil_bspline2_recursive(begin::<2, QuadraticBSpline>(soil(), Fbar::new(Form::Recursive)))]
#[bench::fluid_bspline2(begin::<2, QuadraticBSpline>(fluid(), Standard))]
#[bench::solid_bspline2(begin::<2, QuadraticBSpline>(solid(), Standard))]
#[bench::solid_bspline2_recursive(begin::<2, QuadraticBSpline>(solid(), Fbar::new(Form::Recursive)))]
fn plane_strain(simulation: Begun<2>) -> Begun<2> {
    steps(simulation)
}

#[library_benchmark]
#[bench::soil_gimp(begin::<3, Gimp>(soil(), Standard))]
#[bench::soil_gimp_consistent(begin::<3, Gimp>(soil(), Fbar::new(Form::Consistent)))]
#[bench::soil_bspline2_recursive(begin::<3, QuadraticBSpline>(soil(), Fbar::new(Form::Recursive)))]
#[bench::solid_bspline2(begin::<3, QuadraticBSpline>(solid(), Standard))]
#[bench::solid_bspline2_recursive(begin::<3, QuadraticBSpline>(solid(), Fbar::new(Form::Recursive)))]
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
