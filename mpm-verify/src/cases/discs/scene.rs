//! Where the discs begin: grid, particles and velocities.

use super::parameters::{
    FLIP, OFFSET, POISSON_RATIO, PPC_PER_DIRECTION, SPEED, STEP_FACTOR, YOUNG_MODULUS,
};
use crate::cases::observe::{implicit_settings, settings};
use crate::parameter::Parameters;
use crate::spec::RunSpec;
use mpm_core::explicit::transfer::Flip;
use mpm_core::material::NeoHookean;
use mpm_core::{Axis, Body, Grid, Particles, Scene, Simulation};

/// Radius (m) of the discs, and where their centres are.
pub(super) const RADIUS: f64 = 0.2;
pub(super) const CENTRES: [[f64; 2]; 2] = [[0.2, 0.2], [0.8, 0.8]];
/// The centre of symmetry (m).
pub(super) const MIDDLE: f64 = 0.5;
/// Side of the square of cells (m), and room around it.
const SIDE: f64 = 1.0;
const ROOM: f64 = 0.2;
/// Density (kg/m³).
const DENSITY: f64 = 1000.0;
/// The paper's cell size (m) and time step (s), and how long it runs at which speed (m/s).
pub(super) const CELL: f64 = 0.05;
const STEP: f64 = 0.0025;
const DURATION: f64 = 37.5;
/// Likewise with an offset: centres that fly freely are then half a metre beyond each other.
const DURATION_ASIDE: f64 = 95.0;
const AT_SPEED: f64 = 0.005;

/// How far a disc that flies freely comes in a run, along each axis (m).
fn way(parameters: &Parameters) -> f64 {
    let is_aside = parameters.number(OFFSET) > 0.0;
    let lasts = if is_aside { DURATION_ASIDE } else { DURATION };
    lasts * AT_SPEED
}

/// Time step (s) with cells of size `h` (m), and how many there are.
pub(super) fn timing(h: f64, parameters: &Parameters) -> (f64, u64) {
    let duration = way(parameters) / parameters.number(SPEED);
    let dt = STEP * (h / CELL) * step_factor(parameters);
    (dt, (duration / dt).ceil() as u64)
}

/// Time step over the paper's.
pub(super) fn step_factor(parameters: &Parameters) -> f64 {
    parameters.text(STEP_FACTOR).parse().unwrap_or(1.0)
}

/// How far each disc is shifted along each axis (m): half of the offset across the diagonal.
fn aside(parameters: &Parameters) -> f64 {
    0.5 * parameters.number(OFFSET) * std::f64::consts::FRAC_1_SQRT_2
}

/// The particles' places (m) of one disc after the other; those of the second are those of the first, mirrored about the
/// centre.
pub(super) fn seed(h: f64, parameters: &Parameters) -> Vec<[f64; 2]> {
    let spacing = h / parameters.number(PPC_PER_DIRECTION);
    let along = (2.0 * RADIUS / spacing).round() as usize;
    let place = |k: usize| (k as f64 + 0.5) * spacing;
    let [[x0, y0], _] = CENTRES;
    let first = (0..along * along).map(|k| [place(k / along), place(k % along)]);
    let first: Vec<[f64; 2]> = first
        .filter(|[x, y]| (x - x0).hypot(y - y0) <= RADIUS)
        .collect();
    let aside = aside(parameters);
    let first: Vec<[f64; 2]> = first.iter().map(|[x, y]| [x + aside, y - aside]).collect();
    let mirrored = |[x, y]: &[f64; 2]| [2.0 * MIDDLE - x, 2.0 * MIDDLE - y];
    let second: Vec<[f64; 2]> = first.iter().map(mirrored).collect();
    [first, second].concat()
}

/// The simulation at its start.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
    let number = |p| parameters.number(p);
    let h = spec.level.h;
    let beyond = way(parameters) - DURATION * AT_SPEED + aside(parameters);
    let room = (ROOM / h).round() + (beyond / h).ceil();
    let cells = (SIDE / h).round() + 2.0 * room;
    let grid = Grid::new(h, [Axis::open(-room * h, cells as usize); 2])?;
    let spacing = h / number(PPC_PER_DIRECTION);
    let places = spec.start_at(seed(h, parameters));
    let half = places.len() / 2;
    let mut particles = Particles::new(places, spacing * spacing, DENSITY, [0.5 * spacing; 2])?;
    let speed = number(SPEED);
    for (k, velocity) in particles.velocity.iter_mut().enumerate() {
        *velocity = if k < half { [speed; 2] } else { [-speed; 2] };
    }
    let law = NeoHookean::new(number(YOUNG_MODULUS), number(POISSON_RATIO))?;
    let scene = Scene::new(grid, Body::new(law, particles)?);
    let (dt, _) = timing(h, parameters);
    if let Some(settings) = implicit_settings(spec, parameters, dt) {
        return mpm_solvers::implicit(spec.scheme, scene, settings);
    }
    let settings = settings(spec, parameters, dt, 0.0)?;
    let settings = settings.transfer(Flip::new(number(FLIP))?);
    mpm_solvers::solver(spec.scheme, scene, settings)
}
