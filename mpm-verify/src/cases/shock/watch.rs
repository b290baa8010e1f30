//! A bar that runs into a wall, and what is seen of it.

use super::jump::Jump;
use super::metrics as m;
use super::parameters::{CFL, FLIP, MACH, POISSON_RATIO, PPC_PER_DIRECTION, VISCOSITY};
use crate::cases::course::{Course, Watched};
use crate::cases::observe::{column, discretisation, position_columns, settings};
use crate::drive::Drive;
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::{fit_line, rms};
use mpm_core::explicit::courant_time_step;
use mpm_core::explicit::transfer::Flip;
use mpm_core::material::{NeoHookean, Viscous};
use mpm_core::stage::{End, Wall, WallKind};
use mpm_core::{Axis, Body, Error as Fault, Grid, Law, Part, Particles, Scene, Side, Simulation};
use mpm_solvers::Solvable;

/// Length (m), Young's modulus (Pa) and density (kg/m³) of the bar.
const LENGTH: f64 = 1.0;
const YOUNG_MODULUS: f64 = 1e6;
const DENSITY: f64 = 1000.0;
/// The share of the bar that the front goes through, and those of its way between which the state is taken.
pub(super) const WAY: f64 = 0.7;
const BEHIND: [f64; 2] = [0.1, 0.8];
/// The shares of the jump between which a front is as wide as it is said to be.
const FRONT: [f64; 2] = [0.05, 0.95];
/// Rows of the series.
const ROWS: u64 = 100;
/// Cells beyond the bar.
const ROOM: usize = 2;

/// A bar and its front.
pub(super) struct Bar {
    spec: RunSpec,
    parameters: Parameters,
    law: NeoHookean,
    /// Coefficients of the artificial viscosity.
    viscosity: [f64; 2],
    /// Speed of the bar (m/s), time step (s), steps.
    speed: f64,
    dt: f64,
    steps: u64,
    jump: Jump,
}

impl Bar {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Drive<1, Watched<Self>>, Error> {
        let number = |p| parameters.number(p);
        let law = NeoHookean::new(YOUNG_MODULUS, number(POISSON_RATIO))?;
        let waves = law.wave_speed(DENSITY);
        let speed = number(MACH) * waves;
        let jump = Jump::new(&law, DENSITY, speed);
        let viscosity = VISCOSITY.map(number);
        let [linear, quadratic] = viscosity;
        // The jump in one cell is the quickest compression; damping makes the step of the steepest wave shorter so much.
        let damping = linear + 2.0 * quadratic * number(MACH);
        let shorter = damping.hypot(1.0) + damping;
        let dt = courant_time_step(number(CFL) / shorter, spec.level.h, waves);
        let bar = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            law,
            viscosity,
            speed,
            dt,
            steps: (WAY * LENGTH / jump.speed / dt).ceil() as u64,
            jump,
        };
        Ok(Drive::new(Watched(bar), Default::default())?)
    }

    fn is_viscous(&self) -> bool {
        self.viscosity != [0.0; 2]
    }

    /// Where in the undeformed bar (m) a share of the jump is: from the free end, where the straight line through the mean
    /// stretches of two cells first reaches it.
    fn front(&self, run: &dyn Simulation<1>, share: f64) -> f64 {
        let (h, p) = (self.spec.level.h, run.particles());
        let cells = (LENGTH / h).round() as usize;
        let mut sums = vec![[0.0; 2]; cells];
        for ([x], j) in p.reference.iter().zip(&p.jacobian) {
            if let Some(sum) = sums.get_mut((x / h) as usize) {
                *sum = [sum[0] + j, sum[1] + 1.0];
            }
        }
        let sought = 1.0 - share * (1.0 - self.jump.stretch);
        let mean = |k: usize| sums[k][0] / sums[k][1];
        let reached = (0..cells).rev().find(|k| mean(*k) < sought);
        reached.map_or(0.0, |k| {
            let beyond = if k + 1 < cells { mean(k + 1) } else { 1.0 };
            (k as f64 + 0.5 + (sought - mean(k)) / (beyond - mean(k))) * h
        })
    }

    /// A simulation of the bar, made of `law`.
    fn of<M: Solvable<1>>(&self, law: M) -> Result<Box<dyn Simulation<1>>, Fault> {
        let h = self.spec.level.h;
        let size = h / self.parameters.number(PPC_PER_DIRECTION);
        let cells = (LENGTH / h).round() as usize;
        let axis = Axis::bounded(0.0, cells + ROOM, (Side::Wall, Side::Open));
        let count = (LENGTH / size).round() as usize;
        let places = (0..count).map(|k| [(k as f64 + 0.5) * size]).collect();
        let mut particles =
            Particles::new(self.spec.start_at(places), size, DENSITY, [0.5 * size])?;
        particles.velocity.fill([-self.speed]);
        let wall = Wall {
            axis: 0,
            end: End::Lo,
            kind: WallKind::Roller,
        };
        let scene = Scene::new(Grid::new(h, [axis])?, Body::new(law, particles)?).constrain(wall);
        let settings = settings(&self.spec, &self.parameters, self.dt, 0.0)?;
        let settings = settings.transfer(Flip::new(self.parameters.number(FLIP))?);
        mpm_solvers::solver(self.spec.scheme, scene, settings)
    }

    /// Stress (Pa) and velocity (m/s) of the particles behind the front, at the end.
    fn behind(&self, run: &mut dyn Simulation<1>) -> Vec<[f64; 2]> {
        let stress = run.force_stress();
        let p = run.particles();
        let front = self.jump.speed * run.time();
        let [from, to] = BEHIND.map(|share| share * front);
        let all = (0..p.len()).filter(|k| (from..to).contains(&p.reference[*k][0]));
        all.map(|k| [stress[k].get(0, 0), p.velocity[k][0]])
            .collect()
    }
}

impl Course<1> for Bar {
    fn discretisation(&self) -> Discretisation {
        discretisation(1, &self.spec, &self.parameters, self.dt)
    }

    fn steps(&self) -> [u64; 2] {
        [self.steps, ROWS.min(self.steps)]
    }

    fn begin(&self) -> Result<Box<dyn Simulation<1>>, Fault> {
        match self.is_viscous() {
            true => {
                let h = self.spec.level.h;
                self.of(Viscous::new(self.law, DENSITY, h, self.viscosity)?)
            }
            false => self.of(self.law),
        }
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "front (m)",
            "wall_impulse (N s/m²)",
            "kinetic_energy (J/m²)",
            "stored_energy (J/m²)",
        ]
    }

    fn observe(&self, run: &mut dyn Simulation<1>) -> Vec<f64> {
        let totals = run.totals();
        vec![
            run.time(),
            self.front(run, 0.5),
            run.on(Part::Constraint(0)).impulse[0],
            totals.kinetic_energy,
            totals.stored_energy,
        ]
    }

    fn particles(&self, run: &mut dyn Simulation<1>) -> Vec<Column> {
        let stress = run.force_stress();
        let p = run.particles();
        let mut columns = position_columns(p);
        columns.extend([
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("stress_xx", "Pa", p.seeded(|k| stress[k].get(0, 0))),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, rows: &[Vec<f64>], run: &mut dyn Simulation<1>) -> Vec<(Metric, f64)> {
        let of = |row: &[f64], k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        let behind = self.behind(run);
        let mean = |k: usize| behind.iter().map(|s| s[k]).sum::<f64>() / behind.len() as f64;
        let (stress, exact) = (mean(0), self.jump.stress);
        let late = &rows[rows.len() / 2..];
        let slope = |k: usize| {
            let points: Vec<(f64, f64)> = late.iter().map(|row| (of(row, 0), of(row, k))).collect();
            fit_line(&points).map_or(f64::NAN, |line| line.slope)
        };
        let energy = |row: &[f64]| of(row, 3) + of(row, 4);
        let start = energy(&rows[0]);
        let rise = |row: &Vec<f64>| energy(row) / start - 1.0;
        let lost = -rows.last().map_or(f64::NAN, rise);
        let taken = self.jump.lost * self.jump.speed * run.time() / start;
        let mut found = vec![
            (m::SHOCK_SPEED_ERROR, slope(1) / self.jump.speed - 1.0),
            (m::STRESS_ERROR, stress / exact - 1.0),
            (m::VELOCITY_ERROR, mean(1) / self.speed),
            (m::WALL_FORCE_ERROR, (slope(2) / exact).abs() - 1.0),
            (
                m::OVERSHOOT,
                behind.iter().map(|s| s[0] / exact).fold(0.0, f64::max) - 1.0,
            ),
            (
                m::RINGING,
                rms(behind.iter().map(|s| (s[0] - stress) / exact)),
            ),
            (m::ENERGY_LOSS, lost.max(0.0)),
            (m::ENERGY_GAIN, rows.iter().map(rise).fold(0.0, f64::max)),
            (m::ENERGY_LOSS_ERROR, lost / taken - 1.0),
            (m::JUMP_BOUND, self.jump.bound),
            (m::MASS, run.totals().mass),
        ];
        if self.is_viscous() {
            let [ahead, behind] = FRONT.map(|share| self.front(run, share));
            let predicted = self.jump.width(self.viscosity, self.spec.level.h, FRONT);
            let whole: Vec<(f64, f64)> = late.iter().map(|row| (of(row, 0), energy(row))).collect();
            let rate = fit_line(&whole).map_or(f64::NAN, |line| -line.slope);
            let exact = self.jump.lost * self.jump.speed;
            found.push((m::LOSS_RATE_ERROR, rate / exact - 1.0));
            found.push((m::FRONT_WIDTH, ahead - behind));
            found.push((m::PREDICTED_WIDTH, predicted));
        }
        found
    }
}
