//! Where a motion that is known in closed form begins: grid, walls, law, particles and time step.

use super::{Boundary, DURATION, HOLD, Manufactured, RELAXATION, STEP_POISSON_RATIO};
use crate::cases::observe::{implicit_settings, settings};
use crate::cases::parameters::{CFL, FLIP, PPC_PER_DIRECTION, STEP_SCALING, YOUNG_MODULUS, cfl};
use crate::error::Error;
use crate::exact::common::ANGULAR_FREQUENCY;
use crate::exact::{Exact, Material};
use crate::parameter::{Parameter, Parameters};
use crate::scheme::{RemedyName, Scheme};
use crate::spec::RunSpec;
use mpm_core::explicit::remedy::FbarConsistent;
use mpm_core::explicit::transfer::Flip;
use mpm_core::explicit::{Remedy, courant_time_step};
use mpm_core::implicit::Settings;
use mpm_core::material::{Law, NeoHookean, NewtonianFluid};
use mpm_core::stage::{BodyForce, End, Wall, WallKind};
use mpm_core::{Axis, Body, Grid, Particles, Scene, Side, Simulation};
use mpm_solvers::{Solvable, Solved, solver};
use nalgebra::Vector3;
use std::sync::Arc;

/// Cells per side at which Δt ∝ h and Δt ∝ h² coincide.
const COARSEST: f64 = 8.0;
/// The explicit solver's steps are shorter.
const EXPLICIT_CFL: f64 = 1.0;
/// Phase ωΔt (rad) of a motion in a step that an explicit run follows, at most.
const MOST_PHASE: f64 = 1.0;
/// Cells above a free surface.
const HEADROOM: usize = 4;

/// How the duration is divided.
pub(super) struct Timing {
    /// Number of steps, a whole one.
    pub(super) steps: f64,
    /// Time step (s).
    pub(super) dt: f64,
}

impl Timing {
    /// From the CFL number and the speed of the body's waves, or that at `step_poisson_ratio` if it is
    /// larger, so that runs at several ratios can take the same steps.
    pub(super) fn new(
        case: Manufactured,
        spec: &RunSpec,
        parameters: &Parameters,
        solution: &dyn Exact,
    ) -> Result<Self, Error> {
        let number = |p| parameters.number(p);
        if matches!(spec.scheme, Scheme::Explicit(_)) && number(CFL) >= EXPLICIT_CFL {
            return Err(Error::Input(format!(
                "cfl = {} is out of range for the solver explicit; allowed: below {EXPLICIT_CFL}",
                number(CFL)
            )));
        }
        let density = solution.material().density;
        let mut speed = Medium::new(case, solution).wave_speed(density);
        let ratio = number(STEP_POISSON_RATIO);
        if !ratio.is_nan() {
            let stiff = NeoHookean::new(number(YOUNG_MODULUS), ratio)?;
            speed = speed.max(stiff.wave_speed(density));
        }
        let side = solution.extent()[0][1] - solution.extent()[0][0];
        let finer = if parameters.is(STEP_SCALING, "h2") {
            COARSEST * spec.level.h / side
        } else {
            1.0
        };
        let cfl = cfl(
            spec,
            parameters,
            solution.dimension(),
            0.5 / number(PPC_PER_DIRECTION),
        )?;
        let longest = courant_time_step(cfl * finer, spec.level.h, speed);
        let steps = (number(DURATION) / longest).ceil();
        let dt = number(DURATION) / steps;
        let omega = number(ANGULAR_FREQUENCY);
        if matches!(spec.scheme, Scheme::Explicit(_)) && omega * dt > MOST_PHASE {
            return Err(Error::Input(format!(
                "angular_frequency = {omega} rad/s is too high to be followed by steps of {dt:e} s, which cfl = {cfl} and \
                 the body's waves of {speed:e} m/s make; allowed: at most {:e}",
                MOST_PHASE / dt
            )));
        }
        Ok(Self { steps, dt })
    }
}

/// Particle steps per unit of cost, without a remedy.
const STEPS_PER_COST: f64 = 5e7;

/// What Newton's method costs over an explicit step.
const NEWTON: f64 = 500.0;

/// Cost of a run, by its particle steps.
pub(super) fn cost(case: &Manufactured, known: &[Parameter], spec: &RunSpec) -> f64 {
    let steps = || {
        let p = Parameters::new(known, &spec.set).ok()?;
        let solution = (case.solution)(&p).ok()?;
        let timing = Timing::new(*case, spec, &p, solution.as_ref()).ok()?;
        let per_cell = p.number(PPC_PER_DIRECTION);
        let extent = solution.extent();
        let along = |a: usize| (extent[a][1] - extent[a][0]) / spec.level.h * per_cell;
        let particles: f64 = (0..solution.dimension()).map(along).product();
        Some(particles * timing.steps)
    };
    let remedy = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        RemedyName::FbarConsistent => 3.0,
        _ => 1.5,
    };
    let remedy = match spec.scheme {
        Scheme::Explicit(_) => remedy,
        Scheme::Implicit(_) | Scheme::Poro(_) => remedy * NEWTON,
    };
    steps().unwrap_or(0.0) * remedy / STEPS_PER_COST
}

/// A solver at time zero, of steps `dt` (s).
///
/// # Errors
/// A parameter out of range, or a scene that the solver refuses.
pub(super) fn begin<const D: usize>(
    case: Manufactured,
    spec: &RunSpec,
    parameters: &Parameters,
    solution: &Arc<dyn Exact>,
    dt: f64,
) -> Result<Box<dyn Simulation<D>>, mpm_core::Error>
where
    NeoHookean: Solvable<D> + Solved<D>,
    NewtonianFluid: Solvable<D> + Solved<D>,
{
    let number = |p| parameters.number(p);
    let (grid, walls) = surroundings(case.boundary, solution.as_ref(), spec.level.h)?;
    let forcing = forcing(solution);
    let particles = seed(spec, number(PPC_PER_DIRECTION), solution.as_ref(), dt)?;
    Ok(match Medium::new(case, solution.as_ref()) {
        Medium::Solid(law) => {
            let scene = Scene::new(grid, Body::new(law, particles)?);
            let scene = scene.load(forcing).constrain_all(walls);
            solved(spec, parameters, scene, dt)?
        }
        Medium::Fluid(law) => {
            let scene = Scene::new(grid, Body::new(law, particles)?);
            let scene = scene.load(forcing).constrain_all(walls);
            solved(spec, parameters, scene, dt)?
        }
    })
}

/// The solver of a scene, of steps `dt` (s).
fn solved<const D: usize, M: Solvable<D> + Solved<D>>(
    spec: &RunSpec,
    parameters: &Parameters,
    scene: Scene<D, M>,
    dt: f64,
) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
    if let Some(settings) = implicit_settings(spec, parameters, dt) {
        return mpm_solvers::implicit(spec.scheme, scene, settings);
    }
    let number = |p| parameters.number(p);
    let remedy: Box<dyn Remedy<D>> = match spec.scheme.remedy() {
        RemedyName::FbarConsistent => {
            let remedy = FbarConsistent::new(number(RELAXATION));
            Box::new(remedy.holding(number(HOLD), scene.body.wave_modulus())?)
        }
        other => other.build(),
    };
    let settings = settings(spec, parameters, dt, 0.0)?
        .transfer(Flip::new(number(FLIP))?)
        .remedy(remedy);
    solver(spec.scheme, scene, settings)
}

/// How long (s) velocities live before positions.
pub(super) fn lag(spec: &RunSpec, dt: f64) -> f64 {
    match spec.scheme {
        Scheme::Explicit(_) => 0.5 * dt,
        Scheme::Implicit(_) | Scheme::Poro(_) => 0.0,
    }
}

/// The quasi-static solver of a solid at time zero, of steps `dt` (s).
///
/// # Errors
/// As [`begin`].
pub(super) fn equilibrium<const D: usize>(
    case: Manufactured,
    spec: &RunSpec,
    parameters: &Parameters,
    solution: &Arc<dyn Exact>,
    dt: f64,
) -> Result<Box<dyn Simulation<D>>, mpm_core::Error>
where
    NeoHookean: Solved<D>,
{
    let (grid, walls) = surroundings(case.boundary, solution.as_ref(), spec.level.h)?;
    let per_direction = parameters.number(PPC_PER_DIRECTION);
    let particles = seed(spec, per_direction, solution.as_ref(), dt)?;
    let Material { mu, lambda, .. } = solution.material();
    let scene = Scene::new(grid, Body::new(NeoHookean { mu, lambda }, particles)?);
    let scene = scene.load(forcing(solution)).constrain_all(walls);
    mpm_solvers::implicit(spec.scheme, scene, Settings::new(dt))
}

/// The body force that the motion needs.
pub(in crate::cases) fn forcing<const D: usize>(solution: &Arc<dyn Exact>) -> BodyForce<D> {
    let exact = Arc::clone(solution);
    BodyForce(Box::new(move |x: &[f64; D], t| {
        components(&exact.body_force(&vector(x), t))
    }))
}

/// Components in three dimensions; those that are missing are zero.
pub(in crate::cases) fn vector<const D: usize>(x: &[f64; D]) -> Vector3<f64> {
    let mut v = Vector3::zeros();
    v.as_mut_slice()[..D].copy_from_slice(x);
    v
}

/// The first components.
fn components<const D: usize>(v: &Vector3<f64>) -> [f64; D] {
    std::array::from_fn(|a| v[a])
}

/// Cells of size `h` over a length, which they fill.
fn cells([lo, hi]: [f64; 2], h: f64) -> usize {
    ((hi - lo) / h).round() as usize
}

/// Checks that a body fills its cells: particles of the whole cells would be another body.
fn require_whole_cells(solution: &dyn Exact, h: f64) -> Result<(), mpm_core::Error> {
    for axis in 0..solution.dimension() {
        let [lo, hi] = solution.extent()[axis];
        let value = (hi - lo) / h;
        if value < 0.5 || (value - value.round()).abs() > 1e-9 * value {
            return Err(mpm_core::Error::Input {
                what: "length of the body over that of a cell",
                value,
                allowed: "a whole number",
            });
        }
    }
    Ok(())
}

/// The grid and what holds the body.
fn surroundings<const D: usize>(
    boundary: Boundary,
    solution: &dyn Exact,
    h: f64,
) -> Result<(Grid<D>, Vec<Wall>), mpm_core::Error> {
    require_whole_cells(solution, h)?;
    let mut walls = Vec::new();
    let mut hold = |axis, end, kind| walls.push(Wall { axis, end, kind });
    let extent = solution.extent();
    let axes = std::array::from_fn(|axis| {
        let (lo, n) = (extent[axis][0], cells(extent[axis], h));
        match boundary {
            Boundary::Walls(kind) => {
                hold(axis, End::Lo, kind);
                hold(axis, End::Hi, kind);
                Axis::walls(lo, n)
            }
            Boundary::Periodic => Axis::periodic(lo, n),
            Boundary::Vessel | Boundary::Slope if axis + 1 == D => {
                let slides = matches!(boundary, Boundary::Vessel);
                let kind = if slides {
                    WallKind::Roller
                } else {
                    WallKind::Fixed
                };
                hold(axis, End::Lo, kind);
                Axis::bounded(lo, n + HEADROOM, (Side::Wall, Side::Open))
            }
            Boundary::Slope => Axis::periodic(lo, n),
            Boundary::Vessel => {
                hold(axis, End::Lo, WallKind::Roller);
                hold(axis, End::Hi, WallKind::Roller);
                Axis::walls(lo, n)
            }
        }
    });
    Ok((Grid::new(h, axes)?, walls))
}

/// Particles on a lattice over the whole body, in the state of time zero; velocities are those of when they live.
fn seed<const D: usize>(
    spec: &RunSpec,
    per_direction: f64,
    solution: &dyn Exact,
    dt: f64,
) -> Result<Particles<D>, mpm_core::Error> {
    let spacing = spec.level.h / per_direction;
    let extent = solution.extent();
    let counts: [usize; D] = std::array::from_fn(|a| cells(extent[a], spacing));
    let positions = (0..counts.iter().product())
        .map(|mut k: usize| {
            let mut x = [0.0; D];
            for a in (0..D).rev() {
                x[a] = extent[a][0] + ((k % counts[a]) as f64 + 0.5) * spacing;
                k /= counts[a];
            }
            x
        })
        .collect();
    let mut particles = Particles::new(
        spec.start_at(positions),
        spacing.powi(D as i32),
        solution.material().density,
        [0.5 * spacing; D],
    )?
    .deformed(|x| {
        let x = vector(x);
        let f = solution.deformation_gradient(&x, 0.0);
        (
            components(&(x + solution.displacement(&x, 0.0))),
            f.fixed_view::<D, D>(0, 0).into_owned(),
        )
    });
    for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
        *v = components(&solution.velocity(&vector(x), -lag(spec, dt)));
    }
    Ok(particles)
}

/// The law of the body.
enum Medium {
    Solid(NeoHookean),
    Fluid(NewtonianFluid),
}

impl Medium {
    fn new(case: Manufactured, solution: &dyn Exact) -> Self {
        let Material { mu, lambda, .. } = solution.material();
        if case.fluid {
            Self::Fluid(NewtonianFluid {
                bulk_modulus: lambda,
                viscosity: mu,
            })
        } else {
            Self::Solid(NeoHookean { mu, lambda })
        }
    }

    fn wave_speed(&self, density: f64) -> f64 {
        match self {
            Self::Solid(law) => law.wave_speed(density),
            Self::Fluid(law) => law.wave_speed(density),
        }
    }
}
