//! Where the column begins.

use super::parameters::{
    CONDUCTIVITY, FIRST_STEP, LOAD, POISSON_RATIO, POROSITY, PROJECTION, STEPS, TIME_END,
    TOLERANCE, YOUNG_MODULUS,
};
use crate::cases::growth;
use crate::parameter::Parameters;
use crate::scheme::{Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::material::Hencky;
use mpm_core::poro::{Conductivity, Face, PressureSpace, Settings, Water};
use mpm_core::stage::{End, Wall, WallKind};
use mpm_core::{Axis, Body, Error, Grid, Particles, Scene, Side, Simulation};

/// Height of the column (m).
pub(super) const HEIGHT: f64 = 1.0;
/// Particles a cell.
pub(super) const PER_CELL: usize = 2;
/// Empty cells above it.
const ROOM: usize = 2;
/// The largest q/M: what is finite of the strain adds ten times as much to a distance.
pub(super) const SMALL: f64 = 1e-6;
/// Weight of water (N/m³).
const WATER_WEIGHT: f64 = 9810.0;

/// Oedometric modulus M (Pa) and shear modulus G (Pa).
pub(super) fn moduli(parameters: &Parameters) -> [f64; 2] {
    let (young, ratio) = (
        parameters.number(YOUNG_MODULUS),
        parameters.number(POISSON_RATIO),
    );
    let shear = young / (2.0 * (1.0 + ratio));
    [2.0 * shear * (1.0 - ratio) / (1.0 - 2.0 * ratio), shear]
}

/// κ (m²/(Pa s)).
fn kappa(parameters: &Parameters) -> f64 {
    parameters.number(CONDUCTIVITY) / WATER_WEIGHT
}

/// H²/c_v (s).
pub(super) fn time_scale(parameters: &Parameters) -> f64 {
    HEIGHT * HEIGHT / (kappa(parameters) * moduli(parameters)[0])
}

/// τ M of a run's projection; zero of one without.
pub(super) fn projection(scheme: Scheme, parameters: &Parameters) -> f64 {
    let [modulus, shear] = moduli(parameters);
    match scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => {
            parameters.number(PROJECTION) * modulus / (2.0 * shear)
        }
        _ => 0.0,
    }
}

/// Duration of the first step over H²/c_v, and of a step over that of the one before.
pub(super) fn steps(h: f64, parameters: &Parameters) -> (f64, f64) {
    let count = parameters.number(STEPS) as i32;
    let first = parameters.number(FIRST_STEP) * (h / HEIGHT).powi(2);
    let whole = parameters.number(TIME_END);
    if first == 0.0 {
        return (whole / f64::from(count), 1.0);
    }
    if count == 1 {
        return (first, 1.0);
    }
    (first, growth::factor(first, count, whole))
}

/// The durations of all steps over H²/c_v.
pub(super) fn durations(h: f64, parameters: &Parameters) -> Vec<f64> {
    let (first, growth) = steps(h, parameters);
    let count = parameters.number(STEPS) as i32;
    (0..count).map(|k| first * growth.powi(k)).collect()
}

/// The simulation at its start: the floor at zero, upwards.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<1>>, Error> {
    let number = |p| parameters.number(p);
    let h = spec.level.h;
    let cells = (HEIGHT / h).round() as usize;
    let axis = Axis::bounded(0.0, cells + ROOM, (Side::Wall, Side::Open));
    let grid = Grid::new(h, [axis])?;
    let spacing = h / PER_CELL as f64;
    let places = (0..cells * PER_CELL).map(|k| [(k as f64 + 0.5) * spacing]);
    // Nothing moves by its weight: any density will do.
    let particles = Particles::new(
        spec.start_at(places.collect()),
        spacing,
        1000.0,
        [0.5 * spacing],
    )?;
    let law = Hencky::new(number(YOUNG_MODULUS), number(POISSON_RATIO))?;
    let scene = Scene::new(grid, Body::new(law, particles)?).constrain(Wall {
        axis: 0,
        end: End::Lo,
        kind: WallKind::Roller,
    });
    let load = number(LOAD);
    let topmost = move |x: &[f64; 1]| x[0] > HEIGHT - spacing;
    let top = Face::loaded(&scene.body.particles, topmost, (0, End::Hi), move |_| {
        [-load]
    });
    let water = Water::new(number(POROSITY), Conductivity::Constant(kappa(parameters)))
        .drained(move |x| x[0] > HEIGHT - 0.25 * h)
        .face(top);
    let [modulus, _] = moduli(parameters);
    let (first, growth) = steps(h, parameters);
    let pressure_space = match spec.scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => PressureSpace::TwoGrid,
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => PressureSpace::Projected {
            strength: projection(spec.scheme, parameters) / modulus,
        },
        // Of another kind of scheme no solver is compiled.
        _ => PressureSpace::Equal,
    };
    let settings = Settings {
        growth,
        pressure_space,
        tolerance: number(TOLERANCE),
        ..Settings::new(first * time_scale(parameters))
    };
    mpm_solvers::poro(spec.scheme, scene, water, settings)
}
