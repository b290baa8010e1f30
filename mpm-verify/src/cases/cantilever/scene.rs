//! Where the cantilever begins: grid, clamp and weight.

use super::parameters::{
    EXTENSION, GAUSS, GHOST, HENCKY, JAUMANN, LAW, LOAD_STEPS, NEO_HOOKEAN, POINTS,
    POINTS_PER_DIRECTION, POISSON_RATIO, SOFT, STABILISATION, STABILISATION_FACTOR, TOLERANCE,
    WEIGHT, YOUNG_MODULUS,
};
use crate::cases::parameters::require_quotient;
use crate::error::Error;
use crate::parameter::Parameters;
use crate::spec::RunSpec;
use mpm_core::implicit::{Settings, Stabilisation};
use mpm_core::material::{Hencky, Hypoelastic, JaumannUpdate, Law, NeoHookean};
use mpm_core::stage::{BodyForce, End, Wall, WallKind};
use mpm_core::{Axis, Body, Error as Refusal, Grid, Particles, Scene, Side, Simulation};
use mpm_solvers::{Solved, implicit};
use std::ops::RangeInclusive;

/// Length and depth (m).
pub(super) const LENGTH: f64 = 1.0;
pub(super) const DEPTH: f64 = 0.3;
/// Room of the grid (m): beyond the tip, below and above.
const ROOM: (f64, f64, f64) = (0.2, 0.9, 0.2);
/// Allowed weight over Young's modulus (1/m) in units of 1/(1 + ν): at the greatest the shear w L²/(2 G) of the beam alone
/// moves the tip by the room below, and at the least the rounding of stresses is a percent of the loads.
const WEIGHT_OVER_MODULUS: RangeInclusive<f64> = 1e-9..=ROOM.1 / (LENGTH * LENGTH);
/// Density (kg/m³) that the weight is told by; nothing moves.
const DENSITY: f64 = 1000.0;

/// Particles along an axis of so many cells of size `h` (m): their coordinates.
fn along(cells: usize, h: f64, per_cell: usize, gauss: bool) -> Vec<f64> {
    let offset = 0.5 - 0.5 / 3.0_f64.sqrt();
    let spacing = h / per_cell as f64;
    let place = |k: usize| match (gauss, k % 2) {
        (false, _) => spacing * (k as f64 + 0.5),
        (true, 0) => spacing * (k as f64 + 2.0 * offset),
        (true, _) => spacing * (k as f64 + 1.0 - 2.0 * offset),
    };
    (0..cells * per_cell).map(place).collect()
}

/// How many cells of size `h` (m) a length has.
fn cells(length: f64, h: f64) -> usize {
    (length / h - 1e-9).ceil() as usize
}

/// Particles along the length and the depth.
pub(super) fn counts(h: f64, parameters: &Parameters) -> [usize; 2] {
    let per_cell = parameters.number(POINTS_PER_DIRECTION) as usize;
    [cells(LENGTH, h) * per_cell, cells(DEPTH, h) * per_cell]
}

/// Where the particles are seeded (m), column by column.
pub(super) fn seed(h: f64, parameters: &Parameters) -> Vec<[f64; 2]> {
    let per_cell = parameters.number(POINTS_PER_DIRECTION) as usize;
    // Of an odd number one stands in the middle either way.
    let gauss = parameters.is(POINTS, GAUSS) && per_cell.is_multiple_of(2);
    let [xs, ys] = [LENGTH, DEPTH].map(|l| along(cells(l, h), h, per_cell, gauss));
    let column = |x: &f64| ys.iter().map(|y| [*x, *y]).collect::<Vec<_>>();
    xs.iter().flat_map(column).collect()
}

/// Checks that the beam can bear its weight within the grid.
///
/// # Errors
/// It can't, or rounding hides the answer.
pub(super) fn require_bearable(parameters: &Parameters) -> Result<(), Error> {
    let number = |p| parameters.number(p);
    let strain = number(WEIGHT) * (1.0 + number(POISSON_RATIO)) / number(YOUNG_MODULUS);
    let why =
        "1/m: below, rounding hides the answer, and above, shear alone takes the tip off the grid";
    let what = "weight (1 + poisson_ratio) / young_modulus";
    require_quotient(what, strain, WEIGHT_OVER_MODULUS, why)
}

/// How the run is solved.
pub(super) fn settings(parameters: &Parameters) -> Settings {
    let factor = parameters.number(STABILISATION_FACTOR);
    let stabilisation = if parameters.is(STABILISATION, GHOST) {
        Stabilisation::Ghost(factor)
    } else if parameters.is(STABILISATION, SOFT) {
        Stabilisation::Soft(factor)
    } else if parameters.is(STABILISATION, EXTENSION) {
        Stabilisation::Extension
    } else {
        Stabilisation::None
    };
    Settings {
        tolerance: parameters.number(TOLERANCE),
        ..Settings::new(1.0 / parameters.number(LOAD_STEPS)).stabilised(stabilisation)
    }
}

/// The simulation at its start. Time is the share of the weight.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<2>>, Refusal> {
    let number = |p| parameters.number(p);
    let (young, ratio) = (number(YOUNG_MODULUS), number(POISSON_RATIO));
    let law = |update| Hypoelastic::new(young, ratio, update);
    if parameters.is(LAW, HENCKY) {
        of_law(spec, parameters, Hencky::new(young, ratio)?)
    } else if parameters.is(LAW, NEO_HOOKEAN) {
        of_law(spec, parameters, NeoHookean::new(young, ratio)?)
    } else if parameters.is(LAW, JAUMANN) {
        of_law(spec, parameters, law(JaumannUpdate::Split)?)
    } else {
        of_law(spec, parameters, law(JaumannUpdate::Linear)?)
    }
}

fn of_law<M: Law + Solved<2>>(
    spec: &RunSpec,
    parameters: &Parameters,
    law: M,
) -> Result<Box<dyn Simulation<2>>, Refusal> {
    let h = spec.level.h;
    let (beyond, below, above) = ROOM;
    let lower = cells(below, h);
    let grid = Grid::new(
        h,
        [
            Axis::bounded(0.0, cells(LENGTH + beyond, h), (Side::Wall, Side::Open)),
            Axis::open(-h * lower as f64, lower + cells(DEPTH + above, h)),
        ],
    )?;
    let spacing = h / parameters.number(POINTS_PER_DIRECTION);
    let particles = Particles::new(
        spec.start_at(seed(h, parameters)),
        spacing * spacing,
        DENSITY,
        [0.5 * spacing; 2],
    )?;
    let weight = parameters.number(WEIGHT) / DENSITY;
    let scene = Scene::new(grid, Body::new(law, particles)?)
        .constrain(Wall {
            axis: 0,
            end: End::Lo,
            kind: WallKind::Fixed,
        })
        .load(BodyForce(Box::new(move |_, share| [0.0, -weight * share])));
    implicit(spec.scheme, scene, settings(parameters))
}
