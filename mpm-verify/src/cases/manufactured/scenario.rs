//! The scene of a motion that is known in closed form: grid, walls, law, particles and time step.

use super::{Boundary, DURATION, HOLD, Known, Own, RELAXATION, STEP_POISSON_RATIO};
use crate::cases::parameters::{CFL, FLIP, PPC_PER_DIRECTION, STEP_SCALING, YOUNG_MODULUS};
use crate::cases::prelude::*;
use crate::exact::common::ANGULAR_FREQUENCY;
use mpm_core::explicit::Remedy;

/// Cells per side at which Δt ∝ h and Δt ∝ h² coincide.
const COARSEST: f64 = 8.0;
/// The explicit solver's steps are shorter.
const EXPLICIT_CFL: f64 = 1.0;
/// Phase ωΔt (rad) of a motion in a step that an explicit run follows, at most.
const MOST_PHASE: f64 = 1.0;
/// Cells above a free surface.
const HEADROOM: usize = 4;
/// Particle steps per unit of cost, without a remedy.
const STEPS_PER_COST: f64 = 5e7;
/// Cost of a step of Newton's method over that of an explicit one.
const NEWTON: f64 = 500.0;

pub(super) struct Timing {
    /// Number of steps, a whole one.
    pub(super) steps: f64,
    /// Time step (s).
    pub(super) dt: f64,
}

pub(in crate::cases) struct Scenario<K> {
    pub(in crate::cases) setup: Setup<Own<K>>,
    pub(in crate::cases) solution: Arc<dyn Exact>,
}

impl<K: Known> Scenario<K> {
    pub(in crate::cases) fn new(setup: Setup<Own<K>>) -> Result<Self, Error> {
        let solution = (K::SOLUTION)(&setup.values)?.into();
        Ok(Self { setup, solution })
    }

    /// Steps by the CFL number and the speed of the body's waves, or that at `step_poisson_ratio` if it is larger, so that runs at
    /// several ratios can take the same steps.
    pub(super) fn timing(&self) -> Result<Timing, Error> {
        let is_explicit = self.setup.is_explicit();
        if is_explicit && self.setup.number(CFL) >= EXPLICIT_CFL {
            return Err(Error::Input(format!(
                "cfl = {} is out of range for the solver explicit; allowed: below {EXPLICIT_CFL}",
                self.setup.number(CFL)
            )));
        }
        let density = self.solution.material().density;
        let mut speed = self.medium().wave_speed(density);
        let ratio = self.setup.number(STEP_POISSON_RATIO);
        if !ratio.is_nan() {
            let stiff = NeoHookean::new(self.setup.number(YOUNG_MODULUS), ratio)?;
            speed = speed.max(stiff.wave_speed(density));
        }
        let side = self.solution.extent()[0][1] - self.solution.extent()[0][0];
        let finer = if self.setup.values.is(STEP_SCALING, "h2") { COARSEST * self.setup.h / side } else { 1.0 };
        let half_size = 0.5 / self.setup.number(PPC_PER_DIRECTION);
        let cfl = self.setup.cfl_number(self.solution.dimension(), half_size)?;
        let longest = courant_time_step(cfl * finer, self.setup.h, speed);
        let steps = (self.setup.number(DURATION) / longest).ceil();
        let dt = self.setup.number(DURATION) / steps;
        let omega = self.setup.number(ANGULAR_FREQUENCY);
        if is_explicit && omega * dt > MOST_PHASE {
            return Err(Error::Input(format!(
                "angular_frequency = {omega} rad/s is too high to be followed by steps of {dt:e} s, which cfl = {cfl} and \
                 the body's waves of {speed:e} m/s make; allowed: at most {:e}",
                MOST_PHASE / dt
            )));
        }
        Ok(Timing { steps, dt })
    }

    /// Time (s) by which velocities live before positions.
    pub(super) fn lag(&self, dt: f64) -> f64 {
        if self.setup.is_explicit() { 0.5 * dt } else { 0.0 }
    }

    fn medium(&self) -> SharedLaw {
        let Material { mu, lambda, .. } = self.solution.material();
        if K::FLUID {
            NewtonianFluid { bulk_modulus: lambda, viscosity: mu }.into()
        } else {
            NeoHookean { mu, lambda }.into()
        }
    }

    /// The simulation at its start, with steps of `dt` (s).
    pub(super) fn begin<const D: usize>(&self, dt: f64) -> Begun<D> {
        let (setup, scene) = (&self.setup, self.scene(self.medium(), dt)?);
        if let Some(settings) = setup.implicit_settings(dt) {
            return mpm_solvers::implicit(setup.scheme, scene, settings);
        }
        let remedy: Box<dyn Remedy<D>> = match setup.remedy().fbar() {
            Some(fbar) if fbar.keeps_unseen() => {
                let fbar = fbar.relaxing(self.setup.number(RELAXATION));
                Box::new(fbar.holding(self.setup.number(HOLD), scene.bodies.wave_moduli()[0])?)
            }
            _ => setup.remedy().build(),
        };
        let settings = setup.settings(dt, 0.0)?.transfer(Flip::new(self.setup.number(FLIP))?);
        mpm_solvers::solver(setup.scheme, scene, settings.remedy(remedy))
    }

    /// The body at its start, with what holds and drives it.
    pub(in crate::cases) fn scene<const D: usize>(
        &self,
        law: impl Into<SharedLaw>,
        dt: f64,
    ) -> Result<Scene<D>, Fault> {
        let (grid, walls) = self.surroundings()?;
        let body = Bodies::new(law, self.seed(dt)?)?;
        Ok(Scene::new(grid, body).load(forcing(&self.solution)).constrain_all(walls))
    }

    /// The grid and what holds the body, which must fill its cells: particles of the whole cells would be another body.
    fn surroundings<const D: usize>(&self) -> Result<(Grid<D>, Vec<Wall>), Fault> {
        let (extent, h) = (self.solution.extent(), self.setup.h);
        for [lo, hi] in &extent[..self.solution.dimension()] {
            let value = (hi - lo) / h;
            if value < 0.5 || (value - value.round()).abs() > 1e-9 * value {
                return Err(mpm_core::Error::Input {
                    what: "length of the body over that of a cell",
                    value,
                    allowed: "a whole number",
                });
            }
        }
        let mut walls = Vec::new();
        let mut hold = |axis, end, kind| walls.push(Wall::new(axis, end, kind));
        let axes = std::array::from_fn(|axis| {
            let (lo, n) = (extent[axis][0], cells(extent[axis], h));
            let (sides, floor) = match K::BOUNDARY {
                Boundary::Walls(kind) => (Some(kind), None),
                Boundary::Periodic => (None, None),
                Boundary::Vessel => (Some(WallKind::Roller), Some(WallKind::Roller)),
                Boundary::Slope => (None, Some(WallKind::Fixed)),
            };
            match (sides, floor) {
                (_, Some(kind)) if axis + 1 == D => {
                    hold(axis, End::Lo, kind);
                    Axis::bounded(lo, n + HEADROOM, (Side::Wall, Side::Open))
                }
                (Some(kind), _) => {
                    hold(axis, End::Lo, kind);
                    hold(axis, End::Hi, kind);
                    Axis::walls(lo, n)
                }
                (None, _) => Axis::periodic(lo, n),
            }
        });
        Ok((Grid::new(h, axes)?, walls))
    }

    /// Particles on a lattice over the whole body, in the state of time zero; velocities are those of when they live.
    fn seed<const D: usize>(&self, dt: f64) -> Result<Particles<D>, Fault> {
        let solution = self.solution.as_ref();
        let spacing = self.setup.pitch();
        let extent = solution.extent();
        let counts: [usize; D] = std::array::from_fn(|a| cells(extent[a], spacing));
        let places = by_columns(counts, spacing).map(|x| std::array::from_fn(|a| extent[a][0] + x[a]));
        let particles = self.setup.particles_at(places, spacing, solution.material().density)?;
        let mut particles = particles.deformed(|x| {
            let x = vector(x);
            let f = solution.deformation_gradient(&x, 0.0);
            (components(&(x + solution.displacement(&x, 0.0))), f.fixed_view::<D, D>(0, 0).into_owned())
        });
        for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
            *v = components(&solution.velocity(&vector(x), -self.lag(dt)));
        }
        Ok(particles)
    }
}

/// Cost of a run, by its particle steps.
pub(super) fn cost<K: Known>(spec: &RunSpec) -> f64 {
    let particle_steps = || {
        let scenario = Scenario::<K>::new(Setup::of_plan(spec).ok()?).ok()?;
        let steps = scenario.timing().ok()?.steps;
        let (solution, per_cell) = (&scenario.solution, scenario.setup.number(PPC_PER_DIRECTION));
        let extent = solution.extent();
        let along = |a: usize| (extent[a][1] - extent[a][0]) / spec.level.h * per_cell;
        let particles: f64 = (0..solution.dimension()).map(along).product();
        Some(particles * steps)
    };
    let remedy = remedy_cost(spec, [1.0, 1.5, 1.5, 1.5, 3.0]);
    let solver = if matches!(spec.scheme, Scheme::Explicit(_)) { 1.0 } else { NEWTON };
    particle_steps().unwrap_or(0.0) * (remedy * solver) / STEPS_PER_COST
}

/// The body force that the motion needs.
pub(in crate::cases) fn forcing<const D: usize>(solution: &Arc<dyn Exact>) -> BodyForce<D> {
    let exact = Arc::clone(solution);
    BodyForce(Box::new(move |x: &[f64; D], t| components(&exact.body_force(&vector(x), t))))
}

/// Components in three dimensions; those that are missing are zero.
pub(in crate::cases) fn vector<const D: usize>(x: &[f64; D]) -> Vector3<f64> {
    let mut v = Vector3::zeros();
    v.as_mut_slice()[..D].copy_from_slice(x);
    v
}

fn components<const D: usize>(v: &Vector3<f64>) -> [f64; D] {
    std::array::from_fn(|a| v[a])
}

/// Cells of size `h` over a length, which they fill.
fn cells([lo, hi]: [f64; 2], h: f64) -> usize {
    ((hi - lo) / h).round() as usize
}
