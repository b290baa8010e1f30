//! Where the column begins.

use super::parameters::{
    DRAIN, GHOST_DISPLACEMENT, GHOST_PRESSURE, LOAD, LOGARITHMIC, PROJECTION, REFINE, TOLERANCE,
    VOLUME_RATE,
};
use crate::cases::growth;
use crate::parameter::Parameters;
use crate::scheme::{Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::material::ImprovedHencky;
use mpm_core::poro::{Conductivity, Face, PressureSpace, Settings, Tangent, VolumeRate, Water};
use mpm_core::stage::{End, Wall, WallKind};
use mpm_core::{Axis, Body, Error, Grid, Particles, Scene, Side, Simulation};

/// Height of the column (m).
pub(super) const HEIGHT: f64 = 1.0;
/// Particles a cell.
pub(super) const PER_CELL: usize = 2;
/// Empty cells above it.
const ROOM: usize = 2;
/// Bulk parameter K, shear modulus G (Pa) and porosity of the undeformed column.
const BULK: f64 = 50e3;
const SHEAR: f64 = 300e3;
const POROSITY: f64 = 0.5;
/// M₀ = K/n₀ + 4/3 G (Pa).
pub(super) const MODULUS: f64 = BULK / POROSITY + 4.0 / 3.0 * SHEAR;
/// κ₀ (m²/(Pa s)): water of 9810 N/m³ at 10⁻⁶ m/s.
const KAPPA: f64 = 1e-6 / 9810.0;
/// H²/c_v (s), c_v = κ₀ M₀.
pub(super) const TIME_SCALE: f64 = HEIGHT * HEIGHT / (KAPPA * MODULUS);
/// T at which the load is whole, and at the end.
const RAMP: f64 = 0.05;
const END: f64 = 2.0;
/// Steps, before each is cut, and T of the first.
const STEPS: i32 = 125;
const FIRST: f64 = 1e-3;

/// q (Pa).
pub(super) fn load(parameters: &Parameters) -> f64 {
    parameters.number(LOAD) * MODULUS
}

/// Steps of a run.
pub(super) fn count(parameters: &Parameters) -> f64 {
    f64::from(STEPS) * parameters.number(REFINE)
}

/// T of the first step, and the duration of a step over that of the one before.
pub(super) fn steps(parameters: &Parameters) -> (f64, f64) {
    let whole = growth::factor(FIRST, STEPS, END);
    let cut = whole.powf(1.0 / parameters.number(REFINE));
    (FIRST * (cut - 1.0) / (whole - 1.0), cut)
}

/// The simulation at its start: the floor at zero, upwards.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<1>>, Error> {
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
    let law = ImprovedHencky::new(BULK, SHEAR, POROSITY)?;
    let scene = Scene::new(grid, Body::new(law, particles)?).constrain(Wall {
        axis: 0,
        end: End::Lo,
        kind: WallKind::Roller,
    });
    let topmost = move |x: &[f64; 1]| x[0] > HEIGHT - spacing;
    let load = load(parameters);
    let traction = move |t: f64| [-load * (t / (RAMP * TIME_SCALE)).min(1.0)];
    let (particles, top) = (&scene.body.particles, (0, End::Hi));
    let loaded = Face::loaded(particles, topmost, top, traction);
    let drained = Face::drained(
        particles,
        topmost,
        top,
        parameters.number(DRAIN) * KAPPA / h,
    );
    // c n³/(1 − n)² is κ₀ at n₀.
    let c = KAPPA * (1.0 - POROSITY).powi(2) / POROSITY.powi(3);
    let water = Water::new(POROSITY, Conductivity::KozenyCarman(c))
        .face(loaded)
        .face(drained);
    let pressure_space = match spec.scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => PressureSpace::TwoGrid,
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => PressureSpace::Projected {
            strength: parameters.number(PROJECTION) / (2.0 * SHEAR),
        },
        // Of another kind of scheme no solver is compiled.
        _ => PressureSpace::Equal,
    };
    let volume_rate = if parameters.is(VOLUME_RATE, LOGARITHMIC) {
        VolumeRate::Logarithmic
    } else {
        VolumeRate::Exact
    };
    let (first, growth) = steps(parameters);
    let settings = Settings {
        growth,
        pressure_space,
        volume_rate,
        tangent: Tangent::Consistent,
        tolerance: parameters.number(TOLERANCE),
        ..Settings::new(first * TIME_SCALE).ghosts(
            parameters.number(GHOST_DISPLACEMENT),
            parameters.number(GHOST_PRESSURE),
        )
    };
    mpm_solvers::poro(spec.scheme, scene, water, settings)
}
