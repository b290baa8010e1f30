//! Scene of the block, and its observations step by step.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};

/// Side of the block, and its gap over the reach of the barrier at the start (m).
const SIDE: f64 = 0.5;
const CLEAR: f64 = 0.02;
/// Duration of the run, in times in which waves cross the block and come back, beside the time of its fall and as much to
/// part.
const CROSSINGS: f64 = 3.0;
const ROWS: u64 = 100;
/// Cells beside the block's way and above it.
const ROOM: f64 = 4.0;

#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Extremes {
    rows: u64,
    gain: f64,
    stored: f64,
    least_gap: f64,
    excess: f64,
    across: f64,
    momentum: f64,
}

pub(super) struct Falling {
    setup: Setup<Drop>,
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
    fn reach(&self) -> f64 {
        REACH * self.setup.h
    }

    /// Height of the floor (m): the lowest particles stand half a spacing above zero.
    fn floor(&self) -> f64 {
        0.5 * self.setup.pitch() - self.reach() - CLEAR
    }

    fn contact(&self) -> Result<RigidContact<2>, Fault> {
        let stress = DENSITY * self.law.wave_speed(DENSITY) * self.velocity[1].abs();
        let force = self.setup.stiffness * stress * self.setup.pitch();
        let barrier = Barrier::carrying(force, self.reach())?;
        let face = RigidFace::half_space(1, End::Lo, self.floor())?;
        let stick = barrier.stiffness(0.5 * self.reach());
        Ok(RigidContact::new(face, barrier).with_friction(Friction::new(self.setup.friction, stick)?))
    }

    fn note(&self, seen: &mut Extremes, run: &dyn Simulation<2>) {
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
        seen.excess = seen.excess.max(along - self.setup.friction * across);
        seen.across = seen.across.max(across);
        let size = self.momentum[0].hypot(self.momentum[1]);
        let off = [0, 1].map(|a| totals.momentum[a] + floor.impulse[a] - self.momentum[a]);
        seen.momentum = seen.momentum.max(off[0].hypot(off[1]) / size);
    }

    /// Speed of turning (m/s) of the middle of a side.
    fn spin(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let [centre, moving] = [&p.position, &p.velocity].map(|of| [0, 1].map(|a| mean(of.iter().map(|v| v[a]))));
        let (mut moment, mut inertia) = (0.0, 0.0);
        for (x, v) in p.position.iter().zip(&p.velocity) {
            let arm = [x[0] - centre[0], x[1] - centre[1]];
            moment += arm[0] * (v[1] - moving[1]) - arm[1] * (v[0] - moving[0]);
            inertia += arm[0] * arm[0] + arm[1] * arm[1];
        }
        0.5 * SIDE * moment / inertia
    }
}

impl Problem<2> for Falling {
    type Parameters = Drop;
    type Seen = Extremes;

    fn new(setup: Setup<Drop>) -> Result<Self, Error> {
        setup.check_rule()?;
        let law = NeoHookean::new(YOUNG_MODULUS, setup.poisson_ratio)?;
        let waves = law.wave_speed(DENSITY);
        let fall = setup.speed * waves;
        let velocity = [setup.slant * fall, -fall];
        let factor = [1.0, 10.0, 30.0][setup.step_factor as usize];
        let longest = factor * courant_time_step(setup.cfl, setup.h, waves);
        let duration = 2.0 * CLEAR / fall + CROSSINGS * 2.0 * SIDE / waves;
        let steps = (duration / longest).ceil();
        let mass = DENSITY * SIDE * SIDE;
        Ok(Self {
            setup,
            law,
            velocity,
            dt: duration / steps,
            steps: steps as u64,
            duration,
            energy: 0.5 * mass * (velocity[0] * velocity[0] + velocity[1] * velocity[1]),
            momentum: velocity.map(|v| mass * v),
        })
    }

    fn unseen(&self) -> Extremes {
        Extremes { least_gap: f64::INFINITY, ..Extremes::default() }
    }

    fn discretisation(&self) -> Discretisation {
        Discretisation { wall: "none".to_owned(), ..self.setup.regular(2, self.dt) }
    }

    fn begin(&self, _: &Extremes) -> Begun<2> {
        let (h, spacing) = (self.setup.h, self.setup.pitch());
        let count = (SIDE / spacing).round() as usize;
        let mut particles = self.setup.particles_at(by_rows([count; 2], spacing), spacing, DENSITY)?;
        particles.velocity.fill(self.velocity);
        let way = self.velocity.map(|v| (v * self.duration).abs());
        let cells = |length: f64| (length / h + ROOM).ceil() as usize;
        let axis = |a: usize| {
            let beside = cells(way[a]);
            Axis::open(-(beside as f64) * h, 2 * beside + cells(SIDE))
        };
        let grid = Grid::new(h, [axis(0), axis(1)])?;
        let scene = Scene::new(grid, Bodies::new(self.law, particles)?).contact(self.contact()?);
        self.setup.moving(scene, self.dt, 0.0)
    }

    fn row(&self, seen: &mut Extremes, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let rows = ROWS.min(self.steps);
        seen.rows += 1;
        let to = (seen.rows * self.steps).div_ceil(rows);
        while phase.run.work().steps < to {
            phase.steps(1)?;
            self.note(seen, phase.run.as_ref());
        }
        let (totals, floor) = (phase.run.totals(), phase.run.on(Part::Contact(0)));
        Ok(row! {
            "time (s)": phase.run.time(),
            "kinetic_energy (J/m)": totals.kinetic_energy,
            "stored_energy (J/m)": totals.stored_energy,
            "force_along (N/m)": floor.force[0],
            "force_across (N/m)": -floor.force[1],
            "velocity_across (m/s)": totals.momentum[1] / totals.mass,
        })
    }

    fn progress(&self, _: &Extremes, phase: &Phase<2>) -> f64 {
        phase.share_of(self.steps)
    }

    fn particles<'a>(&self, _: &Extremes, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.velocities().each("mean_stress", "Pa", |p, k| p.stress[k].mean())
    }

    fn metrics(&self, seen: &Extremes, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        let (totals, floor) = (run.totals(), run.on(Part::Contact(0)));
        let fall = self.velocity[1].abs();
        let friction = self.setup.friction;
        let mut values = vec![
            (ENERGY_GAIN, seen.gain),
            (ENERGY_END, (totals.kinetic_energy + totals.stored_energy) / self.energy),
            (STORED_MOST, seen.stored),
            (LEAST_GAP, seen.least_gap),
            (COULOMB_EXCESS, seen.excess / seen.across),
            (MOMENTUM_ERROR, seen.momentum.max(LEAST_ERROR)),
            (RESTITUTION, totals.momentum[1] / totals.mass / fall),
            (SPIN, self.spin(run) / fall),
        ];
        if friction > 0.0 {
            let ratio = (floor.impulse[0] / floor.impulse[1]).abs();
            values.push((FRICTION_RATIO, ratio / friction));
        }
        if !self.setup.is_explicit() {
            values.push((NEWTON_ITERATIONS, run.work().newton_iterations as f64));
        }
        values
    }
}
