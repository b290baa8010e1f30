//! Scene and observations: the water at rest behind the gate, then the flow.

use super::flow::{Flow, Start, State};
use super::*;
use crate::exact::hydrostatic::Hydrostatic;
use mpm_core::explicit::Settings;
use mpm_solvers::solver;

/// Height (m) of the grid: jets rise to 10 m.
const HEIGHT: f64 = 16.0;
/// Time (s) between two rows of the series.
const ROW: f64 = 0.005;
/// Duration (s) of the gravity stage, and of the part in which gravity rises: ten and six of the longest periods of
/// the water behind the gate.
const STAGE: f64 = 0.06;
const RISE: f64 = 0.035;
/// Local damping of the gravity stage.
const DAMPING: f64 = 0.2;
/// Places of constraints in the scene's list.
const FLOOR: usize = 0;
const BACK: usize = 1;
const FRONT: usize = 2;
const GATE: usize = 3;
/// Largest number of last bits by which the starts of an ensemble differ.
const LAST_BITS: u64 = 3;

/// Rows between two frames of the animation, and the largest number of particles that is animated.
const FRAME: usize = 5;
const ANIMATED: usize = 5000;
/// Times (s) of the paper's snapshots.
const SNAPSHOTS: [f64; 4] = [0.4, 1.0, 1.5, 2.0];
/// Longest periods of the water over which the forces behind the gate are averaged.
const PERIODS: f64 = 3.0;

pub(super) struct Dam {
    setup: Setup<DamBreak>,
    law: NewtonianFluid,
    /// The exact state of rest.
    water: Hydrostatic,
    /// Distance (m) between particles.
    spacing: f64,
    steps_per_row: u64,
    /// Time step (s).
    dt: f64,
}

impl Dam {
    /// Rows of the series that a gravity stage has behind the gate.
    fn stage_rows(&self) -> usize {
        let rows = (STAGE / ROW).round() as usize;
        if self.is_staged() { rows } else { 0 }
    }

    fn is_staged(&self) -> bool {
        self.setup.start == Rest::GravityStage
    }

    pub(super) fn released(&self) -> Begun<2> {
        solver(self.setup.scheme, self.tank(0.0)?, self.settings(0.0)?)
    }

    /// The water in the tank, under gravity that rises over `rise` (s).
    fn tank(&self, rise: f64) -> Result<Scene<2>, Fault> {
        let kind = if self.setup.wall_contact == Contact::Sticky { WallKind::Roller } else { WallKind::Separable };
        let walls = [(1, End::Lo), (0, End::Lo), (0, End::Hi)];
        let weight = Gravity(Box::new(move |time| [0.0, -GRAVITY * Amplitude::Rise(rise).at(time)]));
        let body = Bodies::new(self.law, self.particles()?)?;
        let h = self.setup.h;
        let [along, up] = [TANK, HEIGHT].map(|length| (length / h).round() as usize);
        let grid = Grid::new(h, [Axis::walls(0.0, along), Axis::bounded(0.0, up, (Side::Wall, Side::Open))])?;
        Ok(Scene::new(grid, body).load(weight).constrain_all(walls.map(|(axis, end)| Wall::new(axis, end, kind))))
    }

    fn settings(&self, damping: f64) -> Result<Settings<2>, Fault> {
        let flip = (-self.setup.pic_rate * self.dt).exp();
        Ok(self.setup.settings(self.dt, damping)?.transfer(Flip::new(flip)?))
    }

    fn particles(&self) -> Result<Particles<2>, Fault> {
        let places = self.setup.start_at(seed(self.spacing));
        let places = perturbed(places, self.setup.seed as u64);
        let (volume, half_size) = (self.spacing * self.spacing, [0.5 * self.spacing; 2]);
        let particles = Particles::new(places, volume, self.water.density, half_size)?;
        Ok(if self.is_staged() { particles } else { particles.deformed(|x| compressed(&self.water, x)) })
    }

    /// From the exact start: holds the water behind the gate for a while, to measure it. The flow begins anew.
    fn hold(&self, start: &mut Start, phase: &mut Phase<2>) -> Result<(), Fault> {
        let longest_period = 4.0 * DEPTH / self.law.wave_speed(self.water.density);
        let steps = (PERIODS * longest_period / self.dt).round() as u64;
        let before = impulses(&*phase.run);
        phase.steps(1)?;
        start.pressures = seeded_pressures(&mut *phase.run);
        phase.steps(steps.saturating_sub(1))?;
        measure_forces(start, &*phase.run, &before, steps as f64 * self.dt);
        phase.enter(self.released()?, None)
    }

    /// Metrics of pressures (Pa) at these heights (m, before anything moves) behind the gate.
    pub(super) fn pressure_metrics(&self, heights: &[f64], pressures: &[f64]) -> Vec<(Metric, f64)> {
        let of_height = || heights.iter().copied().zip(pressures.iter().copied());
        let off = of_height().map(|(y, pressure)| pressure - self.water.pressure(y));
        let lower: Vec<(f64, f64)> = of_height().filter(|(y, _)| *y < 0.5 * DEPTH).collect();
        vec![
            (PRESSURE_PROFILE_ERROR, rms(off) / self.water.pressure(0.0)),
            (BASE_PRESSURE, fit_line(&lower).map_or(f64::NAN, |line| line.intercept)),
        ]
    }

    /// The current state; `before` are the impulses of the row before.
    fn observe(&self, run: &mut dyn Simulation<2>, before: &Impulses) -> State {
        let now = impulses(run);
        let force = |place: usize, axis: usize| (now[place][axis] - before[place][axis]) / ROW;
        let pressures_now = pressures(run, Field::MeanStress);
        let board = checkerboard(&pressures_now, &pressures(run, Field::AveragedMeanStress));
        let in_tension = pressures_now.iter().filter(|p| **p < 0.0).count();
        let totals = run.totals();
        let p = run.particles();
        let mut first_moments = [0.0; 2];
        for (mass, x) in p.mass.iter().zip(&p.position) {
            for (moment, x) in first_moments.iter_mut().zip(x) {
                *moment += mass * x;
            }
        }
        let front = p.position.iter().map(|x| x[0]).fold(0.0, f64::max);
        let cell = self.setup.h;
        let level = p.position.iter().filter(|x| x[0] < cell).map(|x| x[1]).fold(0.0, f64::max);
        State {
            time: run.time(),
            front: front + 0.5 * self.spacing,
            back_level: level + 0.5 * self.spacing,
            centre: first_moments.map(|moment| moment / totals.mass),
            kinetic: totals.kinetic_energy,
            potential: GRAVITY * first_moments[1],
            stress_work: totals.accumulated.stress_work,
            stored: totals.stored_energy,
            floor_force: -force(FLOOR, 1),
            back_force: -force(BACK, 0),
            front_force: force(FRONT, 0),
            pressure_rms: rms(pressures_now.iter().copied()),
            checkerboard_rms: board,
            tension: in_tension as f64 / p.len() as f64,
            covered: covered(&p.position, self.spacing),
            jacobian: totals.jacobian,
            log_jacobian_gap: totals.log_jacobian_gap_rms,
        }
    }
}

/// Particles row by row from the floor up, in columns from the back wall.
fn seed(spacing: f64) -> Vec<[f64; 2]> {
    by_columns([LENGTH, DEPTH].map(|length| (length / spacing).round() as usize), spacing).collect()
}

/// Positions that differ from `places` in their last bits, at random, by the `seed`; zero keeps them.
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

/// Position of water from `x` (m) at rest under its weight, and its deformation gradient.
fn compressed(water: &Hydrostatic, x: &[f64; 2]) -> ([f64; 2], SMatrix<f64, 2, 2>) {
    let reference = Vector3::new(x[0], x[1], 0.0);
    let moved = reference + water.displacement(&reference, 0.0);
    let f = water.deformation_gradient(&reference, 0.0);
    ([moved.x, moved.y], f.fixed_view::<2, 2>(0, 0).into_owned())
}

/// The gate: it holds, across, all functions that reach it. Nothing flows through it then, and in water at rest, whose
/// pressure is the same all along a cell, the force on it is exact.
fn gate_of(basis: BasisName, h: f64) -> RigidNodes<2> {
    let reach = match basis {
        Linear | Gimp | BasisName::Q8 => 0.0,
        Bspline2 => 0.5 * h,
        Bspline3 => h,
    };
    RigidNodes {
        extent: [[LENGTH - reach, f64::INFINITY], [f64::NEG_INFINITY, f64::INFINITY]],
        velocity: [Some(0.0), None],
        amplitude: Amplitude::Rise(0.0),
    }
}

#[derive(Default, Serialize, Deserialize)]
pub(super) struct Observed {
    /// Whether the gate is gone.
    free: bool,
    /// Rows behind it.
    held: usize,
    start: Start,
    flow: Flow,
}

/// Impulses (N s/m) on floor, back wall, front wall and gate.
type Impulses = [[f64; 3]; 4];

impl Problem<2> for Dam {
    type Parameters = DamBreak;
    type Seen = Observed;

    fn new(setup: Setup<DamBreak>) -> Result<Self, Error> {
        let water = Hydrostatic {
            density: setup.density,
            bulk_modulus: setup.bulk_modulus,
            gravity: GRAVITY,
            width: LENGTH,
            height: DEPTH,
        };
        let pressure = water.density * GRAVITY * DEPTH;
        let why =
            "above which weight compresses the water by more than the 0.1 % that the force on the gate is granted";
        require_quotient("density g H / bulk_modulus", pressure / water.bulk_modulus, 0.0..=1e-3, why)?;
        let law = NewtonianFluid::new(water.bulk_modulus, setup.viscosity)?;
        // The largest step of the CFL number of which a whole number makes a row.
        let most = courant_time_step(setup.cfl, setup.h, law.wave_speed(water.density));
        let steps_per_row = (ROW / most).ceil().max(1.0);
        Ok(Self {
            law,
            water,
            spacing: setup.h / setup.ppc_per_direction as f64,
            steps_per_row: steps_per_row as u64,
            dt: ROW / steps_per_row,
            setup,
        })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.dt)
    }

    fn begin(&self, seen: &Observed) -> Begun<2> {
        if seen.free {
            return self.released();
        }
        // Behind the gate: exactly at rest, or without weight yet.
        let (rise, damping) = if self.is_staged() { (RISE, DAMPING) } else { (0.0, 0.0) };
        let scene = self.tank(rise)?.constrain(gate_of(self.setup.basis(), self.setup.h));
        solver(self.setup.scheme, scene, self.settings(damping)?)
    }

    fn row(&self, seen: &mut Observed, phase: &mut Phase<2>) -> Result<Row, Fault> {
        if !seen.free && self.stage_rows() == 0 {
            self.hold(&mut seen.start, phase)?;
            seen.free = true;
        }
        let before = impulses(&*phase.run);
        phase.steps(self.steps_per_row)?;
        let mut row = self.observe(&mut *phase.run, &before);
        if seen.free {
            seen.flow.rows.push(row);
            return Ok(row.columns());
        }
        row.time -= STAGE;
        seen.held += 1;
        if seen.held == self.stage_rows() {
            seen.start.pressures = seeded_pressures(&mut *phase.run);
            measure_forces(&mut seen.start, &*phase.run, &before, ROW);
            let body = phase.run.body()?;
            phase.enter(self.released()?, Some(&body))?;
            seen.free = true;
        }
        Ok(row.columns())
    }

    fn progress(&self, seen: &Observed, _: &Phase<2>) -> f64 {
        let rows = self.stage_rows() + (self.setup.duration / ROW).round() as usize;
        (seen.held + seen.flow.rows.len()) as f64 / rows as f64
    }

    fn snapshot(&self, seen: &Observed, phase: &mut Phase<2>) -> Option<Snapshot> {
        let row = seen.flow.rows.len();
        let time = row as f64 * ROW;
        let shown = SNAPSHOTS.iter().any(|t| (t - time).abs() < 0.5 * ROW);
        let few = phase.run.particles().len() <= ANIMATED;
        if row == 0 || !(shown || few && row.is_multiple_of(FRAME)) {
            return None;
        }
        let pressures = pressures(&mut *phase.run, Field::MeanStress);
        let columns = Columns::positions(&mut *phase.run).each("pressure", "Pa", |_, k| pressures[k]).done();
        Some(Snapshot { time, columns })
    }

    fn particles<'a>(&self, seen: &Observed, mut columns: Columns<'a, 2>) -> Columns<'a, 2> {
        let averaged = pressures(columns.run(), Field::AveragedMeanStress);
        let pressures = pressures(columns.run(), Field::MeanStress);
        let at_start = |id: u32| seen.start.pressures.get(id as usize).copied().unwrap_or(f64::NAN);
        columns
            .references()
            .velocities()
            .each("start_pressure", "Pa", |p, k| at_start(p.id[k]))
            .each("pressure", "Pa", |_, k| pressures[k])
            .each("averaged_pressure", "Pa", |_, k| averaged[k])
            .jacobian()
    }

    fn metrics(&self, seen: &Observed, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let density = self.water.density;
        let weight = density * GRAVITY * LENGTH * DEPTH;
        let mut values = vec![
            (BASE_REACTION_RATIO, seen.start.base_reaction / weight),
            (GATE_FORCE, seen.start.gate_force),
            (BACK_FORCE, seen.start.back_force),
            (START_KINETIC_ENERGY, seen.start.kinetic_energy),
        ];
        values.extend(seen.flow.metrics(density, self.setup.h));
        let p = phase.run.particles();
        values.extend(self.pressure_metrics(&p.seeded(|k| p.reference[k][1]), &seen.start.pressures));
        values.push((MASS, phase.run.totals().mass));
        values
    }
}

/// Pressure (Pa), or its average, as it enters the forces, in the particles' order.
fn pressures(run: &mut dyn Simulation<2>, mean_stress: Field) -> Vec<f64> {
    run.field(mean_stress).into_iter().map(|s| -s).collect()
}

/// Pressure (Pa) in seeding order.
fn seeded_pressures(run: &mut dyn Simulation<2>) -> Vec<f64> {
    let pressures = pressures(run, Field::MeanStress);
    run.particles().seeded(|k| pressures[k])
}

fn impulses(run: &dyn Simulation<2>) -> Impulses {
    [FLOOR, BACK, FRONT, GATE].map(|place| run.on(Part::Constraint(place)).impulse)
}

/// The mean forces behind the gate since the impulses were `before`, `span` (s) ago.
fn measure_forces(start: &mut Start, run: &dyn Simulation<2>, before: &Impulses, span: f64) {
    let now = impulses(run);
    let force = |place: usize, axis: usize| (now[place][axis] - before[place][axis]) / span;
    start.base_reaction = -force(FLOOR, 1);
    start.gate_force = force(GATE, 0);
    start.back_force = -force(BACK, 0);
    start.kinetic_energy = run.totals().kinetic_energy;
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

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn the_area_under_the_particles_is_that_of_the_water() {
        let block = seed(0.05);
        assert_eq!(block.len(), 3200);
        assert!((covered(&block, 0.05) - 8.0).abs() < 1e-9);
        // A hole of one strip is closed.
        let holed: Vec<[f64; 2]> = (block.iter().copied()).filter(|x| !(1.0..1.1).contains(&x[0])).collect();
        assert!((covered(&holed, 0.05) - 8.0).abs() < 1e-9);
    }
}
