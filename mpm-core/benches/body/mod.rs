//! A body to count and compare with.

use mpm_core::explicit::{Remedy, Settings, Solver, Transfer, courant_time_step};
use mpm_core::material::{HenckyJ2, Law, NeoHookean, NewtonianFluid, Strength, shared};
use mpm_core::{Axis, Basis, Bodies, Error, Grid, Particles, Scene};

/// Its density (kg/m³).
pub(crate) const DENSITY: f64 = 2000.0;
/// Cells of 1 m on every side of it.
const MARGIN: usize = 3;

/// A square or cube of `n` particles along each axis, two per cell, that is squeezed with `rate` (1/s) and sheared
/// with twice of it.
pub(crate) fn sheared<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>>(
    n: usize,
    rate: f64,
    law: impl Law + 'static,
    remedy: impl Remedy<D> + 'static,
    transfer: T,
) -> Result<Solver<D, S, B, T>, Error> {
    let place = |k: usize| MARGIN as f64 + 0.5 * (k as f64 + 0.55);
    let positions = (0..n.pow(D as u32)).map(|k| std::array::from_fn(|a| place(k / n.pow(a as u32) % n))).collect();
    let mut particles = Particles::new(positions, 0.5f64.powi(D as i32), DENSITY, [0.25; D])?;
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        v[0] = rate * (2.0 * x[1] - x[0]);
    }
    let grid = Grid::new(1.0, [Axis::open(0.0, n.div_ceil(2) + 2 * MARGIN); D])?;
    let dt = courant_time_step(0.3, 1.0, law.wave_speed(DENSITY));
    let settings = Settings::new(dt).transfer(transfer).remedy(Box::new(remedy));
    Solver::new(Scene::new(grid, Bodies::new(shared(law), particles)?), settings)
}

pub(crate) fn solid() -> Result<NeoHookean, Error> {
    NeoHookean::new(25e6, 0.3)
}

pub(crate) fn soil() -> Result<HenckyJ2, Error> {
    HenckyJ2::new(25e6, 0.49, Strength::softening(40.82e3, 2.45e3, 5.0)?)
}

pub(crate) fn fluid() -> Result<NewtonianFluid, Error> {
    NewtonianFluid::new(2e6, 1e-3)
}
