//! The simulation of the dam break: water, tank, gate, observation.

use super::METRICS;
use super::flow::{Flow, Row, Start};
use super::reference::{DEPTH, GRAVITY, LENGTH, TANK};
use crate::case::{Column, Job, RunSpec, Snapshot, observed};
use crate::error::Error;
use crate::exact::hydrostatic::Hydrostatic;
use crate::parameter::Parameters;
use crate::record::{Discretisation, Metric, WorkDone};
use crate::scheme::BasisName;
use crate::statistics::{fit_line, rms};
use mpm_core::basis::WallTreatment;
use mpm_core::explicit::transfer::Flip;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{Law, NewtonianFluid};
use mpm_core::memory::{Memory, MemoryError, Saved};
use mpm_core::stage::{BodyForce, End, LocalDamping, RigidNodes, Wall, WallKind, smooth_rise};
use mpm_core::{Axis, Body, Field, Grid, Part, Particles, Scene, Side, Simulation};
use mpm_solvers::solver;
use nalgebra::{SMatrix, Vector3};
use std::collections::BTreeMap;

/// Height (m) of the grid: jets rise to 10 m.
const HEIGHT: f64 = 16.0;
/// Time (s) between two rows of the series.
const ROW: f64 = 0.005;
/// Rows between two frames of the animation, and the largest number of particles that is animated.
const FRAME: usize = 5;
const ANIMATED: usize = 5000;
/// Times (s) of the paper's snapshots.
const SNAPSHOTS: [f64; 4] = [0.4, 1.0, 1.5, 2.0];
/// Duration (s) of the gravity stage, and of the part in which gravity rises: ten and six of the longest periods of
/// the water behind the gate.
const STAGE: f64 = 0.06;
const RISE: f64 = 0.035;
/// How many of the longest periods of the water the forces behind the gate are averaged over.
const PERIODS: f64 = 3.0;
/// Local damping of the gravity stage.
const DAMPING: f64 = 0.2;
/// Places of constraints in the scene's list.
const FLOOR: usize = 0;
const BACK: usize = 1;
const FRONT: usize = 2;
const GATE: usize = 3;
/// How many last bits the starts of an ensemble differ by, at most.
const LAST_BITS: u64 = 3;

/// A running simulation: first behind the gate, then free.
pub(super) struct Simulated {
    simulation: Box<dyn Simulation<2>>,
    /// The scene without a gate, until that is removed.
    released: Option<Box<dyn Simulation<2>>>,
    /// Work behind the gate.
    stage_work: WorkDone,
    discretisation: Discretisation,
    parameters: Parameters,
    water: Hydrostatic,
    steps_per_row: u64,
    /// Steps behind the gate from the exact start, and rows of the series there with a gravity stage.
    held_steps: u64,
    stage_rows: usize,
    start: Start,
    flow: Flow,
}

impl Simulated {
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let h = spec.level.h;
        let number = |name| parameters.number(name);
        let water = Hydrostatic {
            density: number("density"),
            bulk_modulus: number("bulk_modulus"),
            gravity: GRAVITY,
            width: LENGTH,
            height: DEPTH,
        };
        let law = NewtonianFluid::new(water.bulk_modulus, number("viscosity"))?;
        // The largest step of the CFL number of which a whole number makes a row.
        let most = courant_time_step(number("cfl"), h, law.wave_speed(water.density));
        let steps_per_row = (ROW / most).ceil().max(1.0);
        let dt = ROW / steps_per_row;
        let per_direction = number("ppc_per_direction");
        let spacing = h / per_direction;
        let staged = parameters.is("start", "gravity-stage");
        let at_rest = |staged: bool| -> Result<Particles<2>, mpm_core::Error> {
            let places = spec.start_at(seed(spacing));
            let places = perturbed(places, number("seed") as u64);
            let half_size = [0.5 * spacing; 2];
            let particles = Particles::new(places, spacing * spacing, water.density, half_size)?;
            Ok(if staged {
                particles
            } else {
                particles.deformed(|x| compressed(&water, x))
            })
        };
        let build = |gate: bool| -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
            let rise = if gate && staged { RISE } else { 0.0 };
            let scene = Scene::new(tank(h)?, Body::new(law, at_rest(staged)?)?)
                .load(weight(rise))
                .constrain_all(walls(parameters))
                .constrain_all(gate.then(|| gate_of(spec.scheme.basis(), h)));
            let mut settings = Settings::new(dt)
                .wall(if parameters.is("wall", "wall-line") {
                    WallTreatment::WallLine
                } else {
                    WallTreatment::OpenKnot
                })
                .transfer(Flip::new((-number("pic_rate") * dt).exp())?)
                .remedy(spec.scheme.remedy().build());
            if gate && staged {
                settings = settings.filter_forces(LocalDamping::new(DAMPING)?);
            }
            solver(spec.scheme, scene, settings)
        };
        let period = 4.0 * DEPTH / law.wave_speed(water.density);
        let run = Self {
            simulation: build(true)?,
            released: Some(build(false)?),
            stage_work: WorkDone::default(),
            discretisation: Discretisation {
                dim: 2,
                h,
                ppc: (per_direction * per_direction) as u32,
                dt,
                wall: parameters.text("wall"),
            },
            parameters: parameters.clone(),
            water,
            steps_per_row: steps_per_row as u64,
            held_steps: (PERIODS * period / dt).round() as u64,
            stage_rows: if staged {
                (STAGE / ROW).round() as usize
            } else {
                0
            },
            start: Start::default(),
            flow: Flow::default(),
        };
        Ok(run)
    }

    /// From the exact start: holds the water behind the gate for a while, to measure it. The flow begins anew.
    fn hold(&mut self) -> Result<(), mpm_core::Error> {
        let before = self.impulses();
        self.simulation.step()?;
        self.observe_pressure();
        for _ in 1..self.held_steps {
            self.simulation.step()?;
        }
        self.observe_forces(&before, self.held_steps as f64 * self.discretisation.dt);
        if let Some(released) = self.released.take() {
            self.simulation = released;
        }
        Ok(())
    }

    /// Removes the gate after the gravity stage.
    fn release(&mut self) -> Result<(), mpm_core::Error> {
        if let Some(mut released) = self.released.take() {
            released.take_over(&self.simulation.body()?)?;
            self.stage_work = self.simulation.work().into();
            self.simulation = released;
        }
        Ok(())
    }

    /// Pressure (Pa) as it enters the forces, in the particles' order.
    fn pressures(&mut self) -> Vec<f64> {
        negated(self.simulation.field(Field::MeanStress))
    }

    /// Impulses (N s/m) on floor, back wall, front wall and gate so far.
    fn impulses(&self) -> [[f64; 3]; 4] {
        [FLOOR, BACK, FRONT, GATE].map(|place| self.simulation.on(Part::Constraint(place)).impulse)
    }

    /// The mean forces behind the gate since the impulses were `before`, `span` (s) ago.
    fn observe_forces(&mut self, before: &[[f64; 3]; 4], span: f64) {
        let now = self.impulses();
        let force = |place: usize, axis: usize| (now[place][axis] - before[place][axis]) / span;
        self.start.base_reaction = -force(FLOOR, 1);
        self.start.gate_force = force(GATE, 0);
        self.start.back_force = -force(BACK, 0);
        self.start.kinetic_energy = self.simulation.totals().kinetic_energy;
    }

    /// The pressure behind the gate.
    fn observe_pressure(&mut self) {
        let pressures = self.pressures();
        let p = self.simulation.particles();
        let of_depth = || p.reference.iter().zip(&pressures);
        let off = of_depth().map(|(x, pressure)| pressure - self.water.pressure(x[1]));
        let profile_error = rms(off) / self.water.pressure(0.0);
        let lower: Vec<(f64, f64)> = of_depth()
            .filter(|(x, _)| x[1] < 0.5 * DEPTH)
            .map(|(x, pressure)| (x[1], *pressure))
            .collect();
        self.start.profile_error = profile_error;
        self.start.base_pressure = fit_line(&lower).map_or(f64::NAN, |line| line.intercept);
    }

    fn observe(&mut self, before: &[[f64; 3]; 4]) -> Row {
        let h = self.discretisation.h;
        let spacing = h / f64::from(self.discretisation.ppc).sqrt();
        let now = self.impulses();
        let force = |place: usize, axis: usize| (now[place][axis] - before[place][axis]) / ROW;
        let pressures = self.pressures();
        let averaged = negated(self.simulation.field(Field::AveragedMeanStress));
        let board = rms(pressures.iter().zip(&averaged).map(|(p, a)| p - a));
        let in_tension = pressures.iter().filter(|p| **p < 0.0).count();
        let totals = self.simulation.totals();
        let p = self.simulation.particles();
        let mut first_moments = [0.0; 2];
        for (mass, x) in p.mass.iter().zip(&p.position) {
            for (moment, x) in first_moments.iter_mut().zip(x) {
                *moment += mass * x;
            }
        }
        let front = p.position.iter().map(|x| x[0]).fold(0.0, f64::max);
        let near_back = p.position.iter().filter(|x| x[0] < h);
        let level = near_back.map(|x| x[1]).fold(0.0, f64::max);
        Row {
            time: self.simulation.time(),
            front: front + 0.5 * spacing,
            back_level: level + 0.5 * spacing,
            centre: first_moments.map(|moment| moment / totals.mass),
            kinetic: totals.kinetic_energy,
            potential: GRAVITY * first_moments[1],
            stress_work: totals.accumulated.stress_work,
            stored: totals.stored_energy,
            floor_force: -force(FLOOR, 1),
            back_force: -force(BACK, 0),
            front_force: force(FRONT, 0),
            pressure_rms: rms(pressures.iter().copied()),
            checkerboard_rms: board,
            tension: in_tension as f64 / p.len() as f64,
            covered: covered(&p.position, spacing),
            jacobian: totals.jacobian,
            log_jacobian_gap: totals.log_jacobian_gap_rms,
        }
    }

    fn duration(&self) -> f64 {
        self.parameters.number("duration")
    }

    /// Rows of the whole run.
    fn rows(&self) -> usize {
        self.stage_rows + (self.duration() / ROW).round() as usize
    }

    /// Rows so far.
    fn done(&self) -> usize {
        let steps = self.stage_work.steps + self.simulation.work().steps;
        (steps / self.steps_per_row) as usize
    }
}

/// Area (m²) under the highest particles, strip by strip two particles wide; a strip between particles that has none
/// takes the mean of its neighbours.
fn covered(positions: &[[f64; 2]], spacing: f64) -> f64 {
    let width = 2.0 * spacing;
    let mut tops: Vec<f64> = Vec::new();
    for x in positions {
        let strip = (x[0] / width) as usize;
        if strip >= tops.len() {
            tops.resize(strip + 1, 0.0);
        }
        tops[strip] = tops[strip].max(x[1] + 0.5 * spacing);
    }
    for k in 1..tops.len().saturating_sub(1) {
        if tops[k] == 0.0 {
            tops[k] = 0.5 * (tops[k - 1] + tops[k + 1]);
        }
    }
    tops.iter().sum::<f64>() * width
}

/// The tank, open above.
fn tank(h: f64) -> Result<Grid<2>, mpm_core::Error> {
    let cells = |length: f64| (length / h).round() as usize;
    let upward = Axis::bounded(0.0, cells(HEIGHT), (Side::Wall, Side::Open));
    Grid::new(h, [Axis::walls(0.0, cells(TANK)), upward])
}

/// Particles row by row from the floor up, in columns from the back wall.
fn seed(spacing: f64) -> Vec<[f64; 2]> {
    let count = |length: f64| (length / spacing).round() as usize;
    let coordinate = |k: usize| (k as f64 + 0.5) * spacing;
    (0..count(LENGTH))
        .flat_map(|i| (0..count(DEPTH)).map(move |j| [coordinate(i), coordinate(j)]))
        .collect()
}

/// Places that differ from `places` in their last bits, at random, in a way of its own for every `seed` but zero,
/// which keeps them.
fn perturbed(mut places: Vec<[f64; 2]>, seed: u64) -> Vec<[f64; 2]> {
    if seed > 0 {
        let mut random = fastrand::Rng::with_seed(seed);
        for x in places.iter_mut().flatten() {
            for _ in 0..random.u64(0..=LAST_BITS) {
                *x = x.next_up();
            }
        }
    }
    places
}

/// Where water at rest from `x` (m) lies under its weight, and its deformation gradient.
fn compressed(water: &Hydrostatic, x: &[f64; 2]) -> ([f64; 2], SMatrix<f64, 2, 2>) {
    use crate::exact::Exact;
    let reference = Vector3::new(x[0], x[1], 0.0);
    let moved = reference + water.displacement(&reference, 0.0);
    let f = water.deformation_gradient(&reference, 0.0);
    ([moved.x, moved.y], f.fixed_view::<2, 2>(0, 0).into_owned())
}

fn negated(mean_stress: Vec<f64>) -> Vec<f64> {
    mean_stress.into_iter().map(|s| -s).collect()
}

/// Gravity, which rises over `rise` (s).
fn weight(rise: f64) -> BodyForce<2> {
    BodyForce(Box::new(move |_, time| {
        [0.0, -GRAVITY * smooth_rise(time, rise)]
    }))
}

/// Floor, back and front wall.
fn walls(parameters: &Parameters) -> [Wall; 3] {
    let kind = if parameters.is("wall_contact", "sticky") {
        WallKind::Roller
    } else {
        WallKind::Separable
    };
    [(1, End::Lo), (0, End::Lo), (0, End::Hi)].map(|(axis, end)| Wall { axis, end, kind })
}

/// The gate: it holds, across, all functions that reach it. Nothing flows through it then, and in water at rest, whose
/// pressure is the same all along a cell, the force on it is exact.
fn gate_of(basis: BasisName, h: f64) -> RigidNodes<2> {
    let reach = match basis {
        BasisName::Linear | BasisName::Gimp => 0.0,
        BasisName::Bspline2 => 0.5 * h,
        BasisName::Bspline3 => h,
    };
    RigidNodes {
        extent: [
            [LENGTH - reach, f64::INFINITY],
            [f64::NEG_INFINITY, f64::INFINITY],
        ],
        velocity: [Some(0.0), None],
        ramp: 0.0,
    }
}

impl Memory for Simulated {
    fn save(&self) -> Result<Saved, MemoryError> {
        let free = self.released.is_none();
        Saved::of(&(
            free,
            self.simulation.save()?,
            self.stage_work,
            self.start,
            &self.flow,
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (free, simulation, stage_work, start, flow): (bool, Saved, _, _, _) =
            saved.read("the dam break")?;
        if free && let Some(released) = self.released.take() {
            self.simulation = released;
        }
        self.simulation.restore(&simulation)?;
        (self.stage_work, self.start, self.flow) = (stage_work, start, flow);
        Ok(())
    }
}

impl Job for Simulated {
    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn series_columns(&self) -> Vec<&'static str> {
        Row::COLUMNS.to_vec()
    }

    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error> {
        if self.stage_rows == 0 && self.released.is_some() {
            self.hold()?;
        }
        let before = self.impulses();
        for _ in 0..self.steps_per_row {
            self.simulation.step()?;
        }
        let mut row = self.observe(&before);
        if self.released.is_none() {
            self.flow.rows.push(row);
            return Ok(row.values());
        }
        row.time -= STAGE;
        if self.done() >= self.stage_rows {
            self.observe_pressure();
            self.observe_forces(&before, ROW);
            self.release()?;
        }
        Ok(row.values())
    }

    fn finished(&self) -> bool {
        self.done() >= self.rows()
    }

    fn progress(&self) -> f64 {
        self.done() as f64 / self.rows() as f64
    }

    fn snapshot(&mut self) -> Option<Snapshot> {
        let row = self.flow.rows.len();
        let time = row as f64 * ROW;
        let shown = SNAPSHOTS.iter().any(|t| (t - time).abs() < 0.5 * ROW);
        let few = self.simulation.particles().len() <= ANIMATED;
        if row == 0 || !(shown || few && row.is_multiple_of(FRAME)) {
            return None;
        }
        let pressures = self.pressures();
        let column = |name, unit, values| Column { name, unit, values };
        let p = self.simulation.particles();
        let columns = vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("pressure", "Pa", p.seeded(|k| pressures[k])),
        ];
        Some(Snapshot { time, columns })
    }

    fn particles(&mut self) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let pressures = self.pressures();
        let averaged = negated(self.simulation.field(Field::AveragedMeanStress));
        let p = self.simulation.particles();
        vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("vy", "m/s", p.seeded(|k| p.velocity[k][1])),
            column("pressure", "Pa", p.seeded(|k| pressures[k])),
            column("averaged_pressure", "Pa", p.seeded(|k| averaged[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]
    }

    fn metrics(&mut self) -> BTreeMap<String, Metric> {
        let h = self.discretisation.h;
        let weight = self.water.density * GRAVITY * LENGTH * DEPTH;
        let mut values = self.start.metrics(weight);
        values.extend(self.flow.metrics(self.water.density, h));
        values.push(("mass", self.simulation.totals().mass));
        observed(METRICS, values)
    }

    fn work(&self) -> WorkDone {
        let now: WorkDone = self.simulation.work().into();
        now.after(self.stage_work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_under_the_particles_is_that_of_the_water() {
        let block = seed(0.05);
        assert_eq!(block.len(), 3200);
        assert!((covered(&block, 0.05) - 8.0).abs() < 1e-9);
        // A hole of one strip is closed.
        let holed: Vec<[f64; 2]> = (block.iter().copied())
            .filter(|x| !(1.0..1.1).contains(&x[0]))
            .collect();
        assert!((covered(&holed, 0.05) - 8.0).abs() < 1e-9);
    }

    #[test]
    fn an_ensemble_differs_in_last_bits() {
        let (places, other) = (seed(0.1), perturbed(seed(0.1), 3));
        assert_eq!(perturbed(seed(0.1), 0), places);
        for another in [0, 1, 2, 4, 7] {
            assert_ne!(perturbed(seed(0.1), another), other, "{another}");
        }
        let moved = places.iter().flatten().zip(other.iter().flatten());
        assert!(moved.clone().any(|(a, b)| a != b));
        assert!(moved.clone().all(|(a, b)| (a - b).abs() < 1e-14));
    }
}
