//! Where Cook's membrane begins: grid, clamp, load and damping.

use super::geometry::{LEFT_HEIGHT, LENGTH, RIGHT_HEIGHT, seed};
use super::parameters::{
    ALL, CFL, COLUMN, DAMPING, DENSITY, FLIP, GHOST, KINETIC_DAMPING, LOAD, LOAD_AT, LOAD_RAMP, LOAD_STEPS,
    MAX_PERIODS, OF_EXPLICIT, OF_QUASI_STATIC, POISSON_RATIO, PPC_PER_DIRECTION, REST_WINDOW, YOUNG_MODULUS,
};
use crate::cases::observe::{forbid, settings};
use crate::cases::parameters::require_quotient;
use crate::error::Error;
use crate::parameter::Parameters;
use crate::spec::RunSpec;
use mpm_core::explicit::courant_time_step;
use mpm_core::explicit::transfer::Flip;
use mpm_core::implicit::{Settings, Stabilisation};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::stage::{DeadForce, End, KineticDamping, Load, Wall, WallKind};
use mpm_core::{Axis, Body, Grid, Particles, Scene, Side, Simulation};
use mpm_solvers::solver;
use std::ops::RangeInclusive;

/// Room of the grid beyond the membrane (m): right, below, above.
const MARGIN: (f64, f64, f64) = (2.0, 2.0, 6.0);
/// Headroom (m) of a quasi-static run per load over Young's modulus.
const RISE: f64 = 20.0;
/// The fundamental period (s) at E = 70 Pa and ρ = 1 kg/m³, rounded; it scales as √(ρ/E).
const PERIOD: f64 = 60.0;
/// Allowed load per metre of depth over Young's modulus (m).
const LOAD_OVER_MODULUS: RangeInclusive<f64> = 1e-7..=100.0;

/// The fundamental period (s).
pub(super) fn period(parameters: &Parameters) -> f64 {
    let number = |p| parameters.number(p);
    PERIOD * (number(DENSITY) * 70.0 / number(YOUNG_MODULUS)).sqrt()
}

fn law(parameters: &Parameters) -> Result<NeoHookean, mpm_core::Error> {
    NeoHookean::new(parameters.number(YOUNG_MODULUS), parameters.number(POISSON_RATIO))
}

/// The time step (s) on cells of size `h` (m).
pub(super) fn time_step(h: f64, parameters: &Parameters) -> Result<f64, mpm_core::Error> {
    let speed = law(parameters)?.wave_speed(parameters.number(DENSITY));
    Ok(courant_time_step(parameters.number(CFL), h, speed))
}

/// What must hold of parameters together.
pub(super) fn check_together(parameters: &Parameters) -> Result<(), Error> {
    let number = |p| parameters.number(p);
    let strain = number(LOAD) / number(YOUNG_MODULUS);
    let why = "m; below, rounding hides the answer";
    require_quotient("load / young_modulus", strain, LOAD_OVER_MODULUS, why)?;
    for of in [REST_WINDOW, LOAD_RAMP] {
        if number(of) >= number(MAX_PERIODS) {
            return Err(Error::Input(format!(
                "{} = {} is not below max_periods = {}",
                of.name,
                number(of),
                number(MAX_PERIODS)
            )));
        }
    }
    Ok(())
}

/// That an explicit run changes nothing that only a quasi-static one has.
pub(super) fn forbid_static(spec: &RunSpec, parameters: &Parameters) -> Result<(), Error> {
    forbid(spec, parameters, &ALL, &OF_QUASI_STATIC)
}

/// That a quasi-static run changes nothing that only an explicit one has.
pub(super) fn forbid_explicit(spec: &RunSpec, parameters: &Parameters) -> Result<(), Error> {
    forbid(spec, parameters, &ALL, &OF_EXPLICIT)
}

/// The particles before anything moves, with the shares of the full load as their external forces.
///
/// # Errors
/// The parameters make no body.
pub(super) fn start(spec: &RunSpec, parameters: &Parameters) -> Result<Particles<2>, mpm_core::Error> {
    let mut particles = particles(spec, parameters)?;
    let spacing = spec.level.h / parameters.number(PPC_PER_DIRECTION);
    for load in loads(parameters, (spacing, 0.0), &particles) {
        load.add(0.0, &mut particles);
    }
    Ok(particles)
}

fn particles(spec: &RunSpec, parameters: &Parameters) -> Result<Particles<2>, mpm_core::Error> {
    let spacing = spec.level.h / parameters.number(PPC_PER_DIRECTION);
    Particles::new(spec.start_at(seed(spacing)), spacing * spacing, parameters.number(DENSITY), [0.5 * spacing; 2])
}

/// The membrane, its clamp and its load, which grows over `ramp` (s), with so much more `headroom` (m).
fn scene(
    spec: &RunSpec,
    parameters: &Parameters,
    (ramp, headroom): (f64, f64),
) -> Result<Scene<2, NeoHookean>, mpm_core::Error> {
    let h = spec.level.h;
    let spacing = h / parameters.number(PPC_PER_DIRECTION);
    let cells = |length: f64| (length / h).ceil() as usize;
    let (right, below, above) = MARGIN;
    let below = cells(below) as f64 * h;
    let grid = Grid::new(
        h,
        [
            Axis::bounded(0.0, cells(LENGTH + right), (Side::Wall, Side::Open)),
            Axis::open(-below, cells(below + LEFT_HEIGHT + RIGHT_HEIGHT + above + headroom)),
        ],
    )?;
    let particles = particles(spec, parameters)?;
    let loads = loads(parameters, (spacing, ramp), &particles);
    let scene = Scene::new(grid, Body::new(law(parameters)?, particles)?).constrain(Wall {
        axis: 0,
        end: End::Lo,
        kind: WallKind::Fixed,
    });
    Ok(loads.into_iter().fold(scene, Scene::load))
}

/// The simulation at its start.
///
/// # Errors
/// The parameters don't make a scene.
pub(super) fn begin(spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
    let number = |p| parameters.number(p);
    let dt = time_step(spec.level.h, parameters)?;
    let mut settings = settings(spec, parameters, dt, number(DAMPING))?.transfer(Flip::new(number(FLIP))?);
    if parameters.boolean(KINETIC_DAMPING) {
        settings = settings.filter_particles(KineticDamping::default());
    }
    let ramp = number(LOAD_RAMP) * period(parameters);
    solver(spec.scheme, scene(spec, parameters, (ramp, 0.0))?, settings)
}

/// The same by the quasi-static solver. Time is the share of the steps.
///
/// # Errors
/// As [`begin`].
pub(super) fn equilibrium(spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
    let mut settings = Settings::new(1.0 / parameters.number(LOAD_STEPS));
    if parameters.number(GHOST) > 0.0 {
        settings = settings.stabilised(Stabilisation::Ghost(parameters.number(GHOST)));
    }
    // The tip rises by 0.28 m a newton at first, and by less under larger loads.
    let strain = parameters.number(LOAD) / parameters.number(YOUNG_MODULUS);
    let headroom = (RISE * strain.abs()).max(MARGIN.2) - MARGIN.2;
    let scene = scene(spec, parameters, (1.0, headroom))?;
    mpm_solvers::implicit(spec.scheme, scene, settings)
}

/// The dead load: on the last column of particles, or on the last two with shares 3/2 and −1/2,
/// whose resultant acts on the side itself.
fn loads(parameters: &Parameters, (spacing, ramp): (f64, f64), particles: &Particles<2>) -> Vec<DeadForce<2>> {
    let total = parameters.number(LOAD);
    let column = |share: f64, from_edge: f64| {
        DeadForce::shared([0.0, share * total], ramp, particles, |x| {
            (x[0] - (LENGTH - from_edge * spacing)).abs() < 0.25 * spacing
        })
    };
    if parameters.is(LOAD_AT, COLUMN) { vec![column(1.0, 0.5)] } else { vec![column(1.5, 0.5), column(-0.5, 1.5)] }
}

#[cfg(test)]
mod tests {
    use super::super::parameters::ALL;
    use super::*;

    #[test]
    fn the_edge_load_has_its_resultant_on_the_side() {
        for name in ["edge", "column"] {
            let set = [format!("load_at={name}"), "load_ramp=0".to_owned()];
            let parameters = Parameters::new(&ALL, &set).unwrap();
            let mut particles = Particles::new(seed(0.5), 0.25, 1.0, [0.25; 2]).unwrap();
            for load in loads(&parameters, (0.5, 0.0), &particles.clone()) {
                load.add(0.0, &mut particles);
            }
            let force: f64 = particles.external_force.iter().map(|f| f[1]).sum();
            let moment: f64 = particles.external_force.iter().zip(&particles.reference).map(|(f, x)| f[1] * x[0]).sum();
            let arm = if name == "edge" { 48.0 } else { 47.75 };
            assert!((force - 1.0).abs() < 1e-12);
            assert!((moment - arm).abs() < 1e-10);
        }
    }
}
