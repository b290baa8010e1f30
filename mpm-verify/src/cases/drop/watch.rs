//! A block that is thrown at a floor, and what is seen of it step by step.

use super::metrics as m;
use super::parameters::{
    ALL, CFL, FRICTION, POISSON_RATIO, PPC_PER_DIRECTION, SLANT, SPEED, STEP_FACTOR, STIFFNESS,
};
use crate::cases::observe::{check_rule, column, implicit_settings, position_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::Scheme;
use crate::spec::RunSpec;
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::NeoHookean;
use mpm_core::stage::End;
use mpm_core::{Axis, Body, Error as Fault, Grid, Law, Part, Particles, Scene, Simulation};
use serde::{Deserialize, Serialize};

/// Side of the block, and its gap over the reach of the barrier at the start (m).
const SIDE: f64 = 0.5;
const CLEAR: f64 = 0.02;
/// Young's modulus (Pa) and density (kg/m³).
const YOUNG_MODULUS: f64 = 1e6;
const DENSITY: f64 = 1000.0;
/// Distance at which the barrier begins, in cells.
const REACH: f64 = 0.25;
/// How long it is watched, in times in which waves cross the block and come back, beside the time of its fall and as much
/// to part.
const CROSSINGS: f64 = 3.0;
/// Rows of the series.
const ROWS: u64 = 100;
/// Cells beside the block's way and above it.
const ROOM: f64 = 4.0;
const ROUNDING: f64 = 1e-12;

/// What has been seen.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Seen {
    rows: u64,
    gain: f64,
    stored: f64,
    least_gap: f64,
    excess: f64,
    across: f64,
    momentum: f64,
}

/// A block.
pub(super) struct Falling {
    spec: RunSpec,
    parameters: Parameters,
    law: NeoHookean,
    /// Speeds along and across the floor (m/s), step (s), steps.
    velocity: [f64; 2],
    dt: f64,
    steps: u64,
    /// Duration (s).
    duration: f64,
    /// Kinetic energy (J/m) and momentum (kg/s) of the start.
    energy: f64,
    momentum: [f64; 2],
}

impl Falling {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        check_rule(spec, parameters, &ALL)?;
        let number = |p| parameters.number(p);
        let law = NeoHookean::new(YOUNG_MODULUS, number(POISSON_RATIO))?;
        let waves = law.wave_speed(DENSITY);
        let fall = number(SPEED) * waves;
        let velocity = [number(SLANT) * fall, -fall];
        let factor: f64 = parameters.text(STEP_FACTOR).parse().unwrap_or(1.0);
        let longest = factor * courant_time_step(number(CFL), spec.level.h, waves);
        let duration = 2.0 * CLEAR / fall + CROSSINGS * 2.0 * SIDE / waves;
        let steps = (duration / longest).ceil();
        let mass = DENSITY * SIDE * SIDE;
        let falling = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            law,
            velocity,
            dt: duration / steps,
            steps: steps as u64,
            duration,
            energy: 0.5 * mass * (velocity[0] * velocity[0] + velocity[1] * velocity[1]),
            momentum: velocity.map(|v| mass * v),
        };
        let seen = Seen {
            least_gap: f64::INFINITY,
            ..Seen::default()
        };
        Ok(Drive::new(falling, seen)?)
    }

    fn spacing(&self) -> f64 {
        self.spec.level.h / self.parameters.number(PPC_PER_DIRECTION)
    }

    fn reach(&self) -> f64 {
        REACH * self.spec.level.h
    }

    /// Where the floor is (m): the lowest particles stand half a spacing above zero.
    fn floor(&self) -> f64 {
        0.5 * self.spacing() - self.reach() - CLEAR
    }

    /// The floor's barrier and friction.
    fn contact(&self) -> Result<RigidContact<2>, Fault> {
        let number = |p| self.parameters.number(p);
        let stress = DENSITY * self.law.wave_speed(DENSITY) * self.velocity[1].abs();
        let force = number(STIFFNESS) * stress * self.spacing();
        let barrier = Barrier::carrying(force, self.reach())?;
        let face = RigidFace::half_space(1, End::Lo, self.floor())?;
        let stick = barrier.stiffness(0.5 * self.reach());
        let friction = Friction::new(number(FRICTION), stick)?;
        Ok(RigidContact::new(face, barrier).with_friction(friction))
    }

    /// Takes note of the state after a step.
    fn note(&self, seen: &mut Seen, run: &dyn Simulation<2>) {
        let totals = run.totals();
        let energy = totals.kinetic_energy + totals.stored_energy;
        seen.gain = seen.gain.max(energy / self.energy - 1.0);
        seen.stored = seen.stored.max(totals.stored_energy / self.energy);
        let floor = self.floor();
        let gaps = run.particles().position.iter().map(|[_, y]| y - floor);
        let least = gaps.fold(f64::INFINITY, f64::min) / self.reach();
        seen.least_gap = seen.least_gap.min(least);
        let floor = run.on(Part::Contact(0));
        let [along, across, _] = floor.force.map(f64::abs);
        seen.excess = seen
            .excess
            .max(along - self.parameters.number(FRICTION) * across);
        seen.across = seen.across.max(across);
        let size = self.momentum[0].hypot(self.momentum[1]);
        let off = [0, 1].map(|a| totals.momentum[a] + floor.impulse[a] - self.momentum[a]);
        seen.momentum = seen.momentum.max(off[0].hypot(off[1]) / size);
    }

    /// Speed of turning (m/s) of the middle of a side.
    fn spin(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let count = p.len() as f64;
        let mean = |column: &[[f64; 2]], a: usize| column.iter().map(|v| v[a]).sum::<f64>() / count;
        let centre = [0, 1].map(|a| mean(&p.position, a));
        let moving = [0, 1].map(|a| mean(&p.velocity, a));
        let (mut moment, mut inertia) = (0.0, 0.0);
        for (x, v) in p.position.iter().zip(&p.velocity) {
            let arm = [x[0] - centre[0], x[1] - centre[1]];
            moment += arm[0] * (v[1] - moving[1]) - arm[1] * (v[0] - moving[0]);
            inertia += arm[0] * arm[0] + arm[1] * arm[1];
        }
        0.5 * SIDE * moment / inertia
    }
}

impl Watch<2> for Falling {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        let per_direction = self.parameters.number(PPC_PER_DIRECTION);
        Discretisation {
            dim: 2,
            h: self.spec.level.h,
            ppc: per_direction.powi(2) as u32,
            dt: self.dt,
            wall: "none".to_owned(),
        }
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, Fault> {
        let (h, spacing) = (self.spec.level.h, self.spacing());
        let count = (SIDE / spacing).round() as usize;
        let place = |k: usize| [k % count, k / count].map(|k| (k as f64 + 0.5) * spacing);
        let places = self.spec.start_at((0..count * count).map(place).collect());
        let mut particles = Particles::new(places, spacing * spacing, DENSITY, [0.5 * spacing; 2])?;
        particles.velocity.fill(self.velocity);
        let way = self.velocity.map(|v| (v * self.duration).abs());
        let cells = |length: f64| (length / h + ROOM).ceil() as usize;
        let axis = |a: usize| {
            let beside = cells(way[a]);
            Axis::open(-(beside as f64) * h, 2 * beside + cells(SIDE))
        };
        let grid = Grid::new(h, [axis(0), axis(1)])?;
        let body = Body::new(self.law, particles)?;
        let scene = Scene::new(grid, body).contact(self.contact()?);
        if let Some(settings) = implicit_settings(&self.spec, &self.parameters, self.dt) {
            return mpm_solvers::implicit(self.spec.scheme, scene, settings);
        }
        let settings = Settings::new(self.dt).remedy(self.spec.scheme.remedy().build());
        mpm_solvers::solver(self.spec.scheme, scene, settings)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "force_along (N/m)",
            "force_across (N/m)",
            "velocity_across (m/s)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, Fault> {
        let rows = ROWS.min(self.steps);
        seen.rows += 1;
        let to = (seen.rows * self.steps).div_ceil(rows);
        while stage.run.work().steps < to {
            stage.steps(1)?;
            self.note(seen, stage.run.as_ref());
        }
        let (totals, floor) = (stage.run.totals(), stage.run.on(Part::Contact(0)));
        Ok(vec![
            stage.run.time(),
            totals.kinetic_energy,
            totals.stored_energy,
            floor.force[0],
            -floor.force[1],
            totals.momentum[1] / totals.mass,
        ])
    }

    fn progress(&self, _: &Seen, stage: &Stage<2>) -> f64 {
        stage.run.work().steps as f64 / self.steps as f64
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend([
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("vy", "m/s", p.seeded(|k| p.velocity[k][1])),
            column("mean_stress", "Pa", p.seeded(|k| p.stress[k].mean())),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let (totals, floor) = (run.totals(), run.on(Part::Contact(0)));
        let fall = self.velocity[1].abs();
        let friction = self.parameters.number(FRICTION);
        let mut values = vec![
            (m::ENERGY_GAIN, seen.gain),
            (
                m::ENERGY_END,
                (totals.kinetic_energy + totals.stored_energy) / self.energy,
            ),
            (m::STORED_MOST, seen.stored),
            (m::LEAST_GAP, seen.least_gap),
            (m::COULOMB_EXCESS, seen.excess / seen.across),
            (m::MOMENTUM_ERROR, seen.momentum.max(ROUNDING)),
            (m::RESTITUTION, totals.momentum[1] / totals.mass / fall),
            (m::SPIN, self.spin(run) / fall),
        ];
        if friction > 0.0 {
            let ratio = (floor.impulse[0] / floor.impulse[1]).abs();
            values.push((m::FRICTION_RATIO, ratio / friction));
        }
        if !matches!(self.spec.scheme, Scheme::Explicit(_)) {
            values.push((m::NEWTON_ITERATIONS, run.work().newton_iterations as f64));
        }
        values
    }
}
