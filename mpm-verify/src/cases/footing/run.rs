//! Derived quantities, scene and observations of the footing.

use super::curve::{Load, LoadCurve, Surface, WINDOW, bearing_factor, plateau};
use super::*;
use crate::cases::observe::mean_stress;
use crate::statistics::oscillation;
use mpm_core::implicit::GHOST;

/// Width B of the footing (m); its right half is simulated.
pub(in crate::cases) const WIDTH: f64 = 1.0;
/// Cells of the grid above the surface.
const ROOM: usize = 3;
/// Places of constraints in the list of the scene.
pub(in crate::cases) const BASE: usize = 0;
pub(in crate::cases) const FOOTING: usize = 3;
/// Penetration over B between two rows of the series.
const ROW: f64 = 1e-5;
/// Share of its reach by which the barrier gives way under Prandtl's pressure.
const GIVES_WAY: f64 = 0.002;
/// Parameters of an explicit run only, and of a quasi-static run only.
const OF_EXPLICIT: [&str; 7] = ["density", "penetration_rate", "ramp", "damping", "cfl", "flip", "wall"];
const OF_QUASI_STATIC: [&str; 2] = ["load_steps", "tolerance"];

/// Penetration over time.
pub(super) struct Pace {
    /// Speed (m/s) after the start, and the duration (s) of the start.
    rate: f64,
    ramp: f64,
    /// Duration of a step (s), and steps of a row of the series.
    dt: f64,
    steps_per_row: u64,
}

impl Pace {
    /// Penetration of the footing over B at `time` (s): the integral of its velocity.
    fn stroke(&self, time: f64) -> f64 {
        self.rate * Amplitude::Rise(self.ramp).integral(time) / WIDTH
    }

    /// Penetration over B at the end of the start.
    pub(super) fn begun(&self) -> f64 {
        self.stroke(self.ramp)
    }
}

impl Setup<Footing> {
    /// Width (m) that the footing acts with, and its uncertainty. A barrier ends between the particles that it pushes and
    /// those that share nodes with them, up to a cell away.
    pub(super) fn effective_width(&self) -> (f64, f64) {
        if self.presses_by_barrier() {
            return (WIDTH + self.h, self.h);
        }
        held_width(self.basis(), self.wall, self.h)
    }

    pub(super) fn presses_by_barrier(&self) -> bool {
        self.contact == Contact::Barrier
    }

    /// s_u/E.
    pub(super) fn strength_ratio(&self) -> f64 {
        self.undrained_strength / self.young_modulus
    }

    fn law(&self) -> Result<HenckyJ2, Fault> {
        HenckyJ2::new(self.young_modulus, self.poisson_ratio, Strength::undrained(self.undrained_strength)?)
    }

    /// The pace of the footing. Where there is no inertia, time is the penetration over B.
    pub(super) fn pace(&self) -> Result<Pace, Error> {
        if self.is_implicit() {
            self.forbid(&OF_EXPLICIT)?;
            return Ok(Pace {
                rate: WIDTH,
                ramp: 0.0,
                dt: self.penetration / f64::from(self.load_steps),
                steps_per_row: 1,
            });
        }
        self.forbid(&OF_QUASI_STATIC)?;
        let speed = self.law()?.wave_speed(self.density);
        let (rate, ramp) = (self.penetration_rate, self.ramp);
        let dt = courant_time_step(self.cfl, self.h, speed);
        let pressed = self.penetration * WIDTH / rate;
        let depth = f64::from(self.domain_depth) * WIDTH;
        if speed * (ramp + pressed) < depth {
            return Err(Error::Input(format!(
                "pressure waves of young_modulus = {} Pa go {:.3e} m until the end, with ramp, penetration and \
                 penetration_rate; allowed: at least the {depth} m to the base, which feels nothing sooner",
                self.young_modulus,
                speed * (ramp + pressed),
            )));
        }
        Ok(Pace { rate, ramp, dt, steps_per_row: ((ROW * WIDTH / rate / dt).round() as u64).max(1) })
    }

    /// Load of the `rows` of a run with this penetration over B at the end of its start, averaged within `window`.
    pub(super) fn load_curve<'a>(&self, rows: &'a [Load], begun: f64, window: f64) -> LoadCurve<'a> {
        LoadCurve {
            rows,
            strength: self.undrained_strength,
            end: self.penetration,
            begun,
            h: self.h,
            effective: self.effective_width().0,
            window,
        }
    }

    /// Metrics of the surface of particles that start at `references` (m) and move by `flow` (m).
    pub(super) fn of_surface(&self, references: &[[f64; 2]], flow: &[[f64; 2]]) -> Vec<(Metric, f64)> {
        Surface::new(references, flow, self.pitch()).metrics(self.rough)
    }

    /// Rms of the mean normal stress (Pa) of particles that start at `references` (m), and its values over the strength at the
    /// points of the reference.
    pub(super) fn of_stress(&self, references: &[[f64; 2]], mean_stress: &[f64]) -> Vec<(Metric, f64)> {
        let whole = rms(mean_stress.iter().copied());
        let patch = oscillation(references, mean_stress, 2.0 * self.h);
        let mut values = vec![(MEAN_STRESS_RMS, whole), (OSCILLATION_RATIO, patch / whole)];
        for &(metric, point) in MEAN_STRESSES {
            let probe = PointProbe::new(references, point, 2.0 * self.h);
            let value = probe.map_or(f64::NAN, |p| p.value(mean_stress));
            values.push((metric, value / self.undrained_strength));
        }
        values
    }
}

/// Ground of these widths of the footing across and down, its base fixed, its sides on rollers.
pub(in crate::cases) fn ground<P: ParameterSet>(
    setup: &Setup<P>,
    widths: [i32; 2],
    law: SharedLaw,
) -> Result<Scene<2>, Fault> {
    let (h, spacing) = (setup.h, setup.pitch());
    let [across, down] = widths.map(|widths| (f64::from(widths) * WIDTH / h).round() as usize);
    let upward = Axis::bounded(-(down as f64) * h, down + ROOM, (Side::Wall, Side::Open));
    let grid = Grid::new(h, [Axis::walls(0.0, across), upward])?;
    let per_direction = setup.values.number(common::PPC_PER_DIRECTION) as usize;
    let downward = by_columns([across, down].map(|cells| cells * per_direction), spacing);
    let particles =
        setup.particles_at(downward.map(|[x, y]| [x, -y]), spacing, setup.values.number(common::DENSITY))?;
    let sides = [clamp(1, End::Lo), roller(0, End::Lo), roller(0, End::Hi)];
    Ok(Scene::new(grid, Bodies::new(law, particles)?).constrain_all(sides))
}

/// A footing of nodes that come to a velocity (m/s) in `ramp` (s): those on and above the surface, and those of splines
/// with nodes in the middle of cells that lie half a cell below, without which the surface would not be rigid.
pub(in crate::cases) fn held_nodes(h: f64, velocity: [Option<f64>; 2], ramp: f64) -> RigidNodes<2> {
    RigidNodes {
        extent: [[f64::NEG_INFINITY, 0.5 * WIDTH], [-0.5 * h, f64::INFINITY]],
        velocity,
        amplitude: Amplitude::Rise(ramp),
    }
}

/// Width (m) that a footing of held nodes acts with, and its uncertainty: up to the middle between the last held node and
/// the first free one. Quadratic splines of open knots have their nodes in the middle of cells, the others on grid lines.
/// Between those splines the velocity falls from that of the footing within a cell inside of its edge to that of the free
/// ground two cells outside: the place is known to half a cell at either end.
pub(in crate::cases) fn held_width(basis: BasisName, wall: common::Wall, h: f64) -> (f64, f64) {
    match basis {
        Bspline2 if wall == common::Wall::OpenKnot => (WIDTH, 0.0),
        Linear | Gimp | BasisName::Q8 => (WIDTH + h, 0.0),
        Bspline2 | Bspline3 => (WIDTH + 0.5 * h, 0.5 * h),
    }
}

#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    rows: Vec<Load>,
    /// Positions (m), in seeding order, where the observation of the plateau begins.
    before_plateau: Vec<[f64; 2]>,
}

impl Seen {
    /// Displacement (m) of every particle over the plateau, in seeding order; none before it begins.
    fn flow(&self, run: &dyn Simulation<2>) -> Vec<[f64; 2]> {
        let now = places(run);
        let displacement = |(k, x): (usize, &[f64; 2])| {
            let before = self.before_plateau.get(k).unwrap_or(x);
            [x[0] - before[0], x[1] - before[1]]
        };
        now.iter().enumerate().map(displacement).collect()
    }
}

pub(super) struct Pressing {
    setup: Setup<Footing>,
    pace: Pace,
    /// The barrier, and the number of particles that it presses on; none of held nodes.
    barrier: Option<(Barrier, f64)>,
}

impl Pressing {
    /// The footing as a barrier on the particles that come near it.
    fn contact(&self, barrier: Barrier, particles: &Particles<2>) -> Result<RigidContact<2>, Fault> {
        let reach = REACH * self.setup.h;
        let face = RigidFace::half_space(1, End::Hi, 0.0)?
            .within([[f64::NEG_INFINITY, 0.5 * WIDTH], [0.0; 2]])
            .touching(particles, reach)
            .moving([0.0, -self.pace.rate], Amplitude::Rise(self.pace.ramp))?;
        let contact = RigidContact::new(face, barrier);
        if !self.setup.rough {
            return Ok(contact);
        }
        Ok(contact.with_friction(Friction::rough(barrier.stiffness((1.0 - GIVES_WAY) * reach))?))
    }

    /// Lead of the footing over the ground, over B, under a force (N/m).
    fn lost(&self, force: f64) -> f64 {
        self.barrier
            .as_ref()
            .map_or(0.0, |(barrier, particles)| (barrier.distance() - barrier.gap(force.max(0.0) / particles)) / WIDTH)
    }
}

impl Problem<2> for Pressing {
    type Parameters = Footing;
    type Seen = Seen;

    fn new(setup: Setup<Footing>) -> Result<Self, Error> {
        let pace = setup.pace()?;
        let barrier = if setup.presses_by_barrier() {
            let spacing = setup.pitch();
            let force = EXACT * setup.undrained_strength * spacing;
            let reach = REACH * setup.h;
            let barrier = Barrier::carrying_at(force, (1.0 - GIVES_WAY) * reach, reach)?;
            Some((barrier, (0.5 * WIDTH / spacing).round()))
        } else {
            None
        };
        Ok(Self { setup, pace, barrier })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.pace.dt)
    }

    fn begin(&self, _: &Seen) -> Begun<2> {
        let setup = &self.setup;
        let ground = ground(setup, [setup.domain_width, setup.domain_depth], setup.law()?.into())?;
        let scene = match self.barrier {
            None => ground.constrain(held_nodes(
                setup.h,
                [setup.rough.then_some(0.0), Some(-self.pace.rate)],
                self.pace.ramp,
            )),
            Some((barrier, _)) => {
                let contact = self.contact(barrier, &ground.bodies.particles)?;
                ground.contact(contact)
            }
        };
        match setup.implicit_settings(self.pace.dt) {
            Some(own) => mpm_solvers::implicit(setup.scheme, scene, own.stabilised(Stabilisation::Ghost(GHOST))),
            None => setup.explicit(scene, self.pace.dt, setup.damping),
        }
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let footing = if self.barrier.is_none() { Part::Constraint(FOOTING) } else { Part::Contact(0) };
        let (mut force, mut base, mut time) = (0.0, 0.0, 0.0);
        for _ in 0..self.pace.steps_per_row {
            let start = phase.run.time();
            phase.steps(1)?;
            // Forces are those at the start of an explicit step, at the end of an implicit one.
            time += if self.setup.is_implicit() { phase.run.time() } else { start };
            force += phase.run.on(footing).force[1];
            base -= phase.run.on(Part::Constraint(BASE)).force[1];
        }
        let steps = self.pace.steps_per_row as f64;
        let load = Load {
            penetration: self.pace.stroke(time / steps) - self.lost(force / steps),
            force: force / steps,
            base: base / steps,
        };
        seen.rows.push(load);
        let stroke = self.pace.stroke(phase.run.time());
        if seen.before_plateau.is_empty() && stroke >= plateau(self.setup.penetration) {
            seen.before_plateau = places(phase.run.as_ref());
        }
        let totals = phase.run.totals();
        Ok(row! {
            "time (s)": time / steps,
            "penetration (-)": load.penetration,
            "footing_force (N/m)": load.force,
            "base_force (N/m)": load.base,
            "pressure_over_strength (-)": bearing_factor(load.force, WIDTH, self.setup.undrained_strength),
            "kinetic_energy (J/m)": totals.kinetic_energy,
            "stored_energy (J/m)": totals.stored_energy,
            "stress_work (J/m)": totals.accumulated.stress_work,
            "jacobian_min (-)": totals.jacobian.0,
            "jacobian_max (-)": totals.jacobian.1,
            "log_jacobian_gap_rms (-)": totals.log_jacobian_gap_rms,
        })
    }

    fn progress(&self, _: &Seen, phase: &Phase<2>) -> f64 {
        let stroke = self.pace.stroke(phase.run.time());
        (stroke / self.setup.penetration * (1.0 + 1e-9)).min(1.0)
    }

    fn particles<'a>(&self, seen: &Seen, mut columns: Columns<'a, 2>) -> Columns<'a, 2> {
        let (mean_stress, averaged) = mean_stress(columns.run());
        let flow = seen.flow(columns.run());
        let of = |axis: usize| flow.iter().map(|u| u[axis]).collect();
        columns
            .references()
            .seeded("plateau_ux", "m", of(0))
            .seeded("plateau_uy", "m", of(1))
            .seeded("mean_stress", "Pa", mean_stress)
            .seeded("averaged_mean_stress", "Pa", averaged)
            .field("plastic_strain", "-", Field::PlasticStrain)
            .jacobian()
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_mut();
        let (mean_stress, averaged) = mean_stress(run);
        let plastic_strain = run.field(Field::PlasticStrain).into_iter();
        let totals = run.totals();
        // Steps of equilibrium are few, and one stands for itself.
        let implicit = self.setup.is_implicit();
        let window = if implicit { 1e-9 } else { WINDOW };
        let curve = self.setup.load_curve(&seen.rows, self.pace.begun(), window);
        let stress_rms = rms(mean_stress.iter().copied());
        let board = checkerboard(&mean_stress, &averaged);
        let p = run.particles();
        let references = p.seeded(|k| p.reference[k]);
        let mut values = curve.metrics();
        values.extend(self.setup.of_surface(&references, &seen.flow(run)));
        values.extend(self.setup.of_stress(&references, &mean_stress));
        values.extend([
            (FORCE_IMBALANCE, curve.imbalance()),
            (CHECKERBOARD_RMS, board),
            (CHECKERBOARD_RATIO, board / stress_rms),
            (PLASTIC_STRAIN_MAX, plastic_strain.fold(0.0, f64::max)),
            (LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (MASS, totals.mass),
        ]);
        if implicit {
            let work = run.work();
            values.extend([
                (NEWTON_ITERATIONS, work.newton_iterations as f64),
                (LINEAR_ITERATIONS, work.linear_iterations as f64),
            ]);
        }
        values
    }
}
