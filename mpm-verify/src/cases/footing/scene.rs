//! Where the footing begins: ground, sides, base, and what presses.

use super::geometry::WIDTH;
use super::parameters::{
    ALL, BARRIER, CFL, CONTACT, DAMPING, DENSITY, DOMAIN_DEPTH, DOMAIN_WIDTH, FLIP, LOAD_STEPS,
    OF_EXPLICIT, OF_QUASI_STATIC, PENETRATION, PENETRATION_RATE, POISSON_RATIO, PPC_PER_DIRECTION,
    RAMP, ROUGH, UNDRAINED_STRENGTH, YOUNG_MODULUS,
};
use super::reference::EXACT;
use crate::cases::observe::{forbid, implicit_settings, settings};
use crate::error::Error as CaseError;
use crate::parameter::Parameters;
use crate::scheme::Scheme;
use crate::spec::RunSpec;
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::explicit::courant_time_step;
use mpm_core::explicit::transfer::Flip;
use mpm_core::implicit::Stabilisation;
use mpm_core::material::{HenckyJ2, Law, Strength};
use mpm_core::stage::{End, RigidNodes, Wall, WallKind, smooth_stroke};
use mpm_core::{Axis, Body, Error, Grid, Particles, Scene, Side, Simulation};
use mpm_solvers::{implicit, solver};

/// Cells of the grid above the surface.
const ROOM: usize = 3;
/// Places of constraints in the scene's list.
pub(super) const BASE: usize = 0;
pub(super) const FOOTING: usize = 3;
/// Reach d̂ of the barrier over the cell size.
const REACH: f64 = 0.25;
/// Penetration over B between two rows of the series.
const ROW: f64 = 1e-5;
/// Ghost penalty of a quasi-static run: particles that rise beside the footing come to functions that hardly see them.
/// It is on the increments: 16 and 40 steps have the same limit load to 10⁻⁵.
const RIM: f64 = 1e-7;
/// Share of its reach by which the barrier gives way under Prandtl's pressure.
const GIVES_WAY: f64 = 0.002;

/// What presses on the ground.
pub(super) enum Press {
    /// Held nodes.
    RigidNodes,
    /// A barrier on so many particles.
    Barrier(Barrier, f64),
}

impl Press {
    /// On cells of size `h` (m).
    pub(super) fn new(h: f64, parameters: &Parameters) -> Result<Self, Error> {
        if !parameters.is(CONTACT, BARRIER) {
            return Ok(Self::RigidNodes);
        }
        let spacing = h / parameters.number(PPC_PER_DIRECTION);
        let force = EXACT * parameters.number(UNDRAINED_STRENGTH) * spacing;
        let reach = REACH * h;
        let barrier = Barrier::carrying_at(force, (1.0 - GIVES_WAY) * reach, reach)?;
        Ok(Self::Barrier(barrier, (0.5 * WIDTH / spacing).round()))
    }
}

fn law(parameters: &Parameters) -> Result<HenckyJ2, Error> {
    let number = |p| parameters.number(p);
    let strength = Strength::undrained(number(UNDRAINED_STRENGTH))?;
    HenckyJ2::new(number(YOUNG_MODULUS), number(POISSON_RATIO), strength)
}

/// How the footing goes down.
pub(super) struct Pace {
    /// Speed (m/s) after its start, and the time (s) that this takes.
    rate: f64,
    ramp: f64,
    /// Duration of a step (s), and how many make a row of the series.
    pub(super) dt: f64,
    pub(super) steps_per_row: u64,
}

impl Pace {
    /// Of a run. Where there is no inertia, time is the penetration over B.
    ///
    /// # Errors
    /// A parameter that is not allowed, or that only another kind of solver has.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, CaseError> {
        let number = |p| parameters.number(p);
        if let Scheme::Implicit(_) = spec.scheme {
            forbid(spec, parameters, &ALL, &OF_EXPLICIT)?;
            return Ok(Self {
                rate: WIDTH,
                ramp: 0.0,
                dt: number(PENETRATION) / number(LOAD_STEPS),
                steps_per_row: 1,
            });
        }
        forbid(spec, parameters, &ALL, &OF_QUASI_STATIC)?;
        let speed = law(parameters)?.wave_speed(number(DENSITY));
        let (rate, dt) = (
            number(PENETRATION_RATE),
            courant_time_step(number(CFL), spec.level.h, speed),
        );
        let ramp = number(RAMP);
        let pressed = number(PENETRATION) * WIDTH / rate;
        let depth = number(DOMAIN_DEPTH) * WIDTH;
        if speed * (ramp + pressed) < depth {
            return Err(CaseError::Input(format!(
                "pressure waves of young_modulus = {} Pa go {:.3e} m until the end, with ramp, penetration and \
                 penetration_rate; allowed: at least the {depth} m to the base, which feels nothing sooner",
                number(YOUNG_MODULUS),
                speed * (ramp + pressed),
            )));
        }
        Ok(Self {
            rate,
            ramp,
            dt,
            steps_per_row: ((ROW * WIDTH / rate / dt).round() as u64).max(1),
        })
    }

    /// Penetration of the footing over B at `time` (s): the integral of its velocity.
    pub(super) fn stroke(&self, time: f64) -> f64 {
        self.rate * smooth_stroke(time, self.ramp) / WIDTH
    }

    /// Penetration over B at the end of the start.
    pub(super) fn begun(&self) -> f64 {
        self.stroke(self.ramp)
    }
}

/// The simulation at its start.
///
/// # Errors
/// The parameters don't make a scene.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
    press: &Press,
    pace: &Pace,
) -> Result<Box<dyn Simulation<2>>, Error> {
    let h = spec.level.h;
    let number = |p| parameters.number(p);
    let cells = |widths: f64| (widths * WIDTH / h).round() as usize;
    let (across, down) = (cells(number(DOMAIN_WIDTH)), cells(number(DOMAIN_DEPTH)));
    let upward = Axis::bounded(-(down as f64) * h, down + ROOM, (Side::Wall, Side::Open));
    let grid = Grid::new(h, [Axis::walls(0.0, across), upward])?;
    let per_direction = number(PPC_PER_DIRECTION);
    let spacing = h / per_direction;
    let particles = Particles::new(
        spec.start_at(seed(across, down, per_direction as usize, spacing)),
        spacing * spacing,
        number(DENSITY),
        [0.5 * spacing; 2],
    )?;
    let ground = Scene::new(grid, Body::new(law(parameters)?, particles)?).constrain_all(walls());
    let scene = match press {
        Press::RigidNodes => ground.constrain(held_nodes(parameters, pace, h)),
        Press::Barrier(barrier, _) => {
            let contact = barrier_contact(*barrier, (parameters, pace), h, &ground.body.particles)?;
            ground.contact(contact)
        }
    };
    if let Some(settings) = implicit_settings(spec, parameters, pace.dt) {
        return implicit(
            spec.scheme,
            scene,
            settings.stabilised(Stabilisation::Ghost(RIM)),
        );
    }
    let settings =
        settings(spec, parameters, pace.dt, number(DAMPING))?.transfer(Flip::new(number(FLIP))?);
    solver(spec.scheme, scene, settings)
}

/// Particles row by row from the surface down, in columns from the axis of symmetry.
fn seed(across: usize, down: usize, per_direction: usize, spacing: f64) -> Vec<[f64; 2]> {
    let coordinate = |k: usize| (k as f64 + 0.5) * spacing;
    (0..across * per_direction)
        .flat_map(|i| (0..down * per_direction).map(move |j| [coordinate(i), -coordinate(j)]))
        .collect()
}

/// The fixed base and rollers at the sides.
fn walls() -> [Wall; 3] {
    let wall = |axis, end, kind| Wall { axis, end, kind };
    [
        wall(1, End::Lo, WallKind::Fixed),
        wall(0, End::Lo, WallKind::Roller),
        wall(0, End::Hi, WallKind::Roller),
    ]
}

/// The footing as held nodes: those on and above the surface, and those of the splines with nodes in the middle of
/// cells that lie half a cell below, without which the surface would not be rigid.
fn held_nodes(parameters: &Parameters, pace: &Pace, h: f64) -> RigidNodes<2> {
    RigidNodes {
        extent: [[f64::NEG_INFINITY, 0.5 * WIDTH], [-0.5 * h, f64::INFINITY]],
        velocity: [parameters.boolean(ROUGH).then_some(0.0), Some(-pace.rate)],
        ramp: pace.ramp,
    }
}

/// The footing as a barrier on the particles that come near it.
fn barrier_contact(
    barrier: Barrier,
    (parameters, pace): (&Parameters, &Pace),
    h: f64,
    particles: &Particles<2>,
) -> Result<RigidContact<2>, Error> {
    let reach = REACH * h;
    let face = RigidFace::half_space(1, End::Hi, 0.0)?
        .within([[f64::NEG_INFINITY, 0.5 * WIDTH], [0.0; 2]])
        .touching(particles, reach)
        .moving([0.0, -pace.rate], pace.ramp)?;
    let contact = RigidContact::new(face, barrier);
    if !parameters.boolean(ROUGH) {
        return Ok(contact);
    }
    let stiffness = barrier.stiffness((1.0 - GIVES_WAY) * reach);
    Ok(contact.with_friction(Friction::rough(stiffness)?))
}
