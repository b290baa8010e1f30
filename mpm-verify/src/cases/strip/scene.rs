//! Where the strip begins: half of it, on a square of soil; or a quarter of a square, on a cube.

use super::parameters::{
    ALPHA, CAM_CLAY, COMPRESSIBILITY, CONDUCTIVITY, CONTROL, CRITICAL_RATIO, DRAIN, DURATION,
    GAMMA, GHOST_DISPLACEMENT, GHOST_PRESSURE, HALF_WIDTH, INITIAL_PRESSURE, LAW, LOAD,
    PENETRATION, POISSON_RATIO, POROSITY, PRECONSOLIDATION, PROJECTION, SETTLEMENT, STEPS,
    TOLERANCE, YOUNG_MODULUS,
};
use crate::parameter::Parameters;
use crate::scheme::{Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::material::{CamClay, ImprovedHencky};
use mpm_core::poro::{Conductivity, Face, PressureSpace, Settings, Tangent, Water};
use mpm_core::stage::{End, RigidNodes, Wall, WallKind};
use mpm_core::{Axis, Body, Error, Grid, Law, Particles, Scene, Side, Simulation};
use mpm_solvers::Soaked;
use std::array::from_fn;

/// Side of the soil (m).
pub(super) const SIDE: f64 = 5.0;
/// Particles a cell along an axis.
pub(super) const PER_CELL: usize = 2;
/// Empty ground above the surface (m).
const ROOM: f64 = 1.0;
/// Weight of water (N/m³).
const WATER_WEIGHT: f64 = 9810.0;
/// Place of the base in the scene's list of constraints.
pub(super) const BASE: usize = 0;

/// Likewise of a rigid strip in so many dimensions, behind the base and two sides an axis.
pub(super) const fn strip(dimension: usize) -> usize {
    1 + 2 * (dimension - 1)
}

/// Bulk modulus and shear modulus (Pa) of the soil at rest.
pub(super) fn moduli(parameters: &Parameters) -> [f64; 2] {
    let (young, ratio) = (
        parameters.number(YOUNG_MODULUS),
        parameters.number(POISSON_RATIO),
    );
    [
        young / (3.0 * (1.0 - 2.0 * ratio)),
        young / (2.0 * (1.0 + ratio)),
    ]
}

pub(super) fn is_plastic(parameters: &Parameters) -> bool {
    parameters.is(LAW, CAM_CLAY)
}

/// Whether the settlement is given, and not the load.
pub(super) fn is_driven(parameters: &Parameters) -> bool {
    parameters.is(CONTROL, SETTLEMENT)
}

/// What rests on the whole surface (Pa).
pub(super) fn surcharge(parameters: &Parameters) -> f64 {
    if is_plastic(parameters) {
        parameters.number(INITIAL_PRESSURE)
    } else {
        0.0
    }
}

/// Load on the strip (Pa) at the time `t` (s), where it is given.
pub(super) fn load(parameters: &Parameters, t: f64) -> f64 {
    parameters.number(LOAD) * t / parameters.number(DURATION)
}

/// The simulation at its start, of elastic soil.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn elastic<const D: usize>(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<D>>, Error>
where
    ImprovedHencky: Soaked<D>,
{
    ground(elasticity(parameters)?, spec, parameters)
}

/// Likewise of soil of any law, in the plane.
///
/// # Errors
/// As [`elastic`].
pub(super) fn plane(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<2>>, Error> {
    match is_plastic(parameters) {
        true => ground(clay(parameters)?, spec, parameters),
        false => elastic(spec, parameters),
    }
}

fn elasticity(parameters: &Parameters) -> Result<ImprovedHencky, Error> {
    let [bulk, shear] = moduli(parameters);
    let porosity = parameters.number(POROSITY);
    ImprovedHencky::new(bulk * porosity, shear, porosity)
}

pub(super) fn clay(parameters: &Parameters) -> Result<CamClay, Error> {
    let number = |p| parameters.number(p);
    let clay = CamClay::new(
        elasticity(parameters)?,
        number(CRITICAL_RATIO),
        number(COMPRESSIBILITY),
        number(PRECONSOLIDATION),
        number(INITIAL_PRESSURE),
    )?;
    clay.shaped(number(ALPHA), number(GAMMA))
}

fn ground<const D: usize, M: Law + Soaked<D>>(
    law: M,
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<D>>, Error> {
    let number = |p| parameters.number(p);
    let (h, up) = (spec.level.h, D - 1);
    let cells = |length: f64| (length / h).round() as usize;
    let mut axes = [Axis::walls(0.0, cells(SIDE)); D];
    axes[up] = Axis::bounded(0.0, cells(SIDE + ROOM), (Side::Wall, Side::Open));
    let grid = Grid::new(h, axes)?;
    let spacing = h / PER_CELL as f64;
    let row = cells(SIDE) * PER_CELL;
    let place = |k: usize| from_fn(|a| ((k / row.pow(a as u32) % row) as f64 + 0.5) * spacing);
    // Nothing moves by its weight: any density will do.
    let particles = Particles::new(
        spec.start_at((0..row.pow(D as u32)).map(place).collect()),
        spacing.powi(D as i32),
        1000.0,
        [0.5 * spacing; D],
    )?;
    let wall = |axis, end, kind| Wall { axis, end, kind };
    let roller = |axis| [End::Lo, End::Hi].map(|end| wall(axis, end, WallKind::Roller));
    let scene = Scene::new(grid, Body::new(law, particles)?)
        .constrain_all([wall(up, End::Lo, WallKind::Fixed)])
        .constrain_all((0..up).flat_map(roller));
    let kappa = number(CONDUCTIVITY) / WATER_WEIGHT;
    let porosity = number(POROSITY);
    // c n³/(1 − n)² is κ₀ at n₀.
    let c = kappa * (1.0 - porosity).powi(2) / porosity.powi(3);
    let surface = move |x: &[f64; D]| x[up] > SIDE - spacing;
    let downward = move |pressure: f64| from_fn(|a| if a == up { -pressure } else { 0.0 });
    let (particles, top) = (&scene.body.particles, (up, End::Hi));
    let mut water = Water::new(porosity, Conductivity::KozenyCarman(c)).face(Face::drained(
        particles,
        surface,
        top,
        number(DRAIN) * kappa / h,
    ));
    let rests = surcharge(parameters);
    if rests > 0.0 {
        water = water.face(Face::loaded(particles, surface, top, move |_| {
            downward(rests)
        }));
    }
    let half_width = number(HALF_WIDTH);
    let scene = if is_driven(parameters) {
        let mut extent = [[f64::NEG_INFINITY, half_width]; D];
        extent[up] = [SIDE, f64::INFINITY];
        let mut velocity = [None; D];
        velocity[up] = Some(-number(PENETRATION) / number(DURATION));
        scene.constrain(RigidNodes {
            extent,
            velocity,
            ramp: 0.0,
        })
    } else {
        let under = move |x: &[f64; D]| surface(x) && x[..up].iter().all(|x| *x < half_width);
        let given = parameters.clone();
        let load = Face::loaded(particles, under, top, move |t| downward(load(&given, t)));
        water = water.face(load);
        scene
    };
    let pressure_space = match spec.scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => PressureSpace::TwoGrid,
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => PressureSpace::Projected {
            strength: number(PROJECTION) / (2.0 * moduli(parameters)[1]),
        },
        // Of another kind of scheme no solver is compiled.
        _ => PressureSpace::Equal,
    };
    let settings = Settings {
        pressure_space,
        tangent: Tangent::Consistent,
        tolerance: number(TOLERANCE),
        ..Settings::new(duration(parameters))
            .ghosts(number(GHOST_DISPLACEMENT), number(GHOST_PRESSURE))
    };
    mpm_solvers::poro(spec.scheme, scene, water, settings)
}

/// Duration of a step (s).
pub(super) fn duration(parameters: &Parameters) -> f64 {
    parameters.number(DURATION) / parameters.number(STEPS)
}
