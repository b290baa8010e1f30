//! Where the motion begins.

use super::parameters::{
    AMPLITUDE, ANGULAR_FREQUENCY, CONDUCTIVITY, CONDUCTIVITY_LAW, CONSTANT, DIMENSION, DURATION,
    GRAVITY, POISSON_RATIO, POROSITY, PPC_PER_DIRECTION, PREDICTOR, PRESSURE, PROJECTION, RATES,
    SOURCE, STEPS, TOLERANCE, YOUNG_MODULUS, ZERO,
};
use crate::exact::poro::SolidAndWater;
use crate::parameter::Parameters;
use crate::scheme::{Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::material::ImprovedHencky;
use mpm_core::poro::{Conductivity, Gravity, Predictor, PressureSpace, Settings, Tangent, Water};
use mpm_core::stage::{BodyForce, End, Wall, WallKind};
use mpm_core::{Axis, Body, Error, Grid, Particles, Scene, Simulation};
use mpm_solvers::Soaked;

/// Weight of water (N/m³) that conductivities are told of.
const WATER_WEIGHT: f64 = 9810.0;
/// Densities of water and grains (kg/m³).
const DENSITIES: [f64; 2] = [1000.0, 2600.0];

/// Shear modulus (Pa).
fn shear(parameters: &Parameters) -> f64 {
    parameters.number(YOUNG_MODULUS) / (2.0 * (1.0 + parameters.number(POISSON_RATIO)))
}

/// κ (m²/(Pa s)) of undeformed material.
pub(super) fn kappa(parameters: &Parameters) -> f64 {
    parameters.number(CONDUCTIVITY) / WATER_WEIGHT
}

/// Oedometric modulus M (Pa) of undeformed material.
pub(super) fn modulus(parameters: &Parameters) -> f64 {
    let ratio = parameters.number(POISSON_RATIO);
    2.0 * shear(parameters) * (1.0 - ratio) / (1.0 - 2.0 * ratio)
}

/// The exact motion.
///
/// # Errors
/// Moduli or a porosity that are none.
pub(super) fn solution(parameters: &Parameters) -> Result<SolidAndWater, Error> {
    let number = |p| parameters.number(p);
    let porosity = number(POROSITY);
    let bulk = number(YOUNG_MODULUS) / (3.0 * (1.0 - 2.0 * number(POISSON_RATIO)));
    let kappa = kappa(parameters);
    let conductivity = if parameters.is(CONDUCTIVITY_LAW, CONSTANT) {
        Conductivity::Constant(kappa)
    } else {
        Conductivity::KozenyCarman(kappa * (1.0 - porosity).powi(2) / porosity.powi(3))
    };
    Ok(SolidAndWater {
        dimension: number(DIMENSION) as usize,
        law: ImprovedHencky::new(bulk * porosity, shear(parameters), porosity)?,
        porosity,
        conductivity,
        densities: DENSITIES,
        gravity: number(GRAVITY),
        amplitude: number(AMPLITUDE),
        pressure: number(PRESSURE),
        angular_frequency: number(ANGULAR_FREQUENCY),
    })
}

/// A place in three dimensions.
pub(super) fn place<const D: usize>(x: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|a| x.get(a).copied().unwrap_or(0.0))
}

/// How long a step is (s).
pub(super) fn duration_of_step(parameters: &Parameters) -> f64 {
    parameters.number(DURATION) / parameters.number(STEPS)
}

/// The simulation at its start: a body that fills its grid, between rollers, drained at its top.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin<const D: usize>(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<D>>, Error>
where
    ImprovedHencky: Soaked<D>,
{
    let number = |p| parameters.number(p);
    let (h, exact) = (spec.level.h, solution(parameters)?);
    let grid = Grid::new(h, [Axis::walls(0.0, (1.0 / h).round() as usize); D])?;
    let spacing = h / number(PPC_PER_DIRECTION);
    let along = (1.0 / spacing).round() as usize;
    let places = (0..along.pow(D as u32)).map(|k| {
        std::array::from_fn(|a| ((k / along.pow(a as u32) % along) as f64 + 0.5) * spacing)
    });
    let particles = Particles::new(
        spec.start_at(places.collect()),
        spacing.powi(D as i32),
        exact.dry_density(),
        [0.5 * spacing; D],
    )?;
    let rollers = (0..D).flat_map(|axis| {
        [End::Lo, End::Hi].map(|end| Wall {
            axis,
            end,
            kind: WallKind::Roller,
        })
    });
    let force = BodyForce(Box::new(move |x: &[f64; D], t| {
        let force = exact.at(place(x), t).body_force;
        std::array::from_fn(|a| force[a])
    }));
    let scene = Scene::new(grid, Body::new(exact.law, particles)?)
        .load(force)
        .constrain_all(rollers);
    let whole = !parameters.is(SOURCE, RATES);
    let mut acceleration = [0.0; D];
    acceleration[D - 1] = -exact.gravity;
    let water = Water::new(exact.porosity, exact.conductivity)
        .gravity(Gravity {
            water: DENSITIES[0],
            grains: DENSITIES[1],
            acceleration,
        })
        .start(move |x| exact.at(place(x), 0.0).pressure)
        .drained(move |x| x[D - 1] > 1.0 - 0.25 * h)
        .source(move |x, span| exact.inflow(place(x), span, whole));
    let pressure_space = match spec.scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => PressureSpace::TwoGrid,
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => PressureSpace::Projected {
            strength: number(PROJECTION) / (2.0 * shear(parameters)),
        },
        // Of another kind of scheme no solver is compiled.
        _ => PressureSpace::Equal,
    };
    let settings = Settings {
        pressure_space,
        tangent: Tangent::Consistent,
        predictor: if parameters.is(PREDICTOR, ZERO) {
            Predictor::Zero
        } else {
            Predictor::Particles
        },
        tolerance: number(TOLERANCE),
        ..Settings::new(duration_of_step(parameters))
    };
    mpm_solvers::poro(spec.scheme, scene, water, settings)
}
