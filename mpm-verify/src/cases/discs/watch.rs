//! What is seen of the discs, four times a second at the paper's speed.

use super::flight::until_met;
use super::metrics as m;
use super::parameters::{ALL, SPEED};
use super::scene::{CELL, MIDDLE, RADIUS, begin, seed, step_factor, timing};
use crate::cases::observe::{check_rule, column, discretisation, position_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::{Column, Snapshot};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::Simulation;
use serde::{Deserialize, Serialize};

/// Paper's steps in a row.
const ROW: f64 = 100.0;
/// The row at which the particles are kept: the discs are at rest then, pressed together.
pub(super) const IN_CONTACT: u64 = 95;
/// Least value of what is rounding.
const ROUNDING: f64 = 1e-12;
const MIRRORED: f64 = 1e-9;

/// Sums over the particles.
#[derive(Default, Clone, Copy, Serialize, Deserialize)]
struct Sums {
    momentum: [f64; 2],
    angular: f64,
    /// Σ|p| (kg m/s).
    magnitude: f64,
    /// Velocity of the first disc against the second (m/s).
    relative: [f64; 2],
    /// Kinetic, stored, accumulated (J).
    energies: [f64; 3],
}

/// What has been seen of the collision.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
    start: Option<Sums>,
    gain: f64,
    loss: f64,
    accumulated: f64,
    momentum: f64,
    angular: f64,
    node_gap: f64,
    closest: f64,
    /// The stored energy of the last step (J), and the most that a step changed it by.
    stored: f64,
    exchanged: f64,
    /// Largest change of a velocity, and of a volume, in free flight.
    flight: [f64; 2],
    rows: u64,
}

/// Two discs that collide.
pub(super) struct Collision {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    steps: u64,
    /// Particles of a disc, the first ones in seeding order.
    half: usize,
    /// See [`m::FREE_UNTIL`].
    free: Option<f64>,
}

impl Collision {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        check_rule(spec, parameters, &ALL)?;
        let (dt, steps) = timing(spec.level.h, parameters);
        let collision = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: discretisation(2, spec, parameters, dt),
            steps,
            half: seed(spec.level.h, parameters).len() / 2,
            free: until_met(spec, parameters, steps as f64 * dt),
        };
        let seen = Seen {
            closest: f64::INFINITY,
            ..Seen::default()
        };
        Ok(Drive::new(collision, seen)?)
    }

    fn sums(&self, run: &dyn Simulation<2>) -> Sums {
        let totals = run.totals();
        let p = run.particles();
        let mut sums = Sums {
            energies: [
                totals.kinetic_energy,
                totals.stored_energy,
                totals.accumulated.stress_work,
            ],
            ..Sums::default()
        };
        for (k, ((x, v), m)) in p.position.iter().zip(&p.velocity).zip(&p.mass).enumerate() {
            let sign = self.sign(p.id[k]) / self.half as f64;
            for a in 0..2 {
                sums.momentum[a] += m * v[a];
                sums.relative[a] += sign * v[a];
            }
            sums.angular += m * ((x[0] - MIDDLE) * v[1] - (x[1] - MIDDLE) * v[0]);
            if let Some(b) = p.affine.get(k) {
                sums.angular += m * (b[(1, 0)] - b[(0, 1)]);
            }
            sums.magnitude += m * v[0].hypot(v[1]);
        }
        sums
    }

    /// 1 of the first disc, −1 of the second.
    fn sign(&self, id: u32) -> f64 {
        if (id as usize) < self.half { 1.0 } else { -1.0 }
    }

    /// Largest change of a particle's velocity, over its speed, and of its volume, over it.
    fn flight(&self, run: &dyn Simulation<2>) -> [f64; 2] {
        let p = run.particles();
        let speed = self.parameters.number(SPEED);
        let changes = p.velocity.iter().zip(&p.id).map(|(v, id)| {
            let own = self.sign(*id) * speed;
            (v[0] - own).hypot(v[1] - own) / (speed * 2f64.sqrt())
        });
        let strains = p.jacobian.iter().map(|j| (j - 1.0).abs());
        [changes.fold(0.0, f64::max), strains.fold(0.0, f64::max)]
    }

    /// Distance of the centres of mass (m).
    fn distance(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let mut apart = [0.0; 2];
        for (x, id) in p.position.iter().zip(&p.id) {
            for (sum, x) in apart.iter_mut().zip(x) {
                *sum += self.sign(*id) * x / self.half as f64;
            }
        }
        apart[0].hypot(apart[1])
    }

    /// Notes the extremes of a step.
    fn note(&self, seen: &mut Seen, run: &dyn Simulation<2>, start: &Sums) {
        let sums = self.sums(run);
        let energy = |[kinetic, other]: [f64; 2]| kinetic + other;
        let [k0, s0, a0] = start.energies;
        let [k, s, a] = sums.energies;
        let whole = energy([k0, s0]);
        let rise = energy([k, s]) / whole - 1.0;
        seen.gain = seen.gain.max(rise);
        seen.loss = seen.loss.max(-rise);
        seen.accumulated = seen.accumulated.max((energy([k, a - a0]) / k0 - 1.0).abs());
        seen.node_gap = seen
            .node_gap
            .max((k - run.residual().kinetic_energy) / whole);
        let change = [0, 1].map(|i| sums.momentum[i] - start.momentum[i]);
        let momentum = change[0].hypot(change[1]) / start.magnitude;
        seen.momentum = seen.momentum.max(momentum);
        let angular = (sums.angular - start.angular).abs() / (start.magnitude * 2.0 * RADIUS);
        seen.angular = seen.angular.max(angular);
        seen.closest = seen.closest.min(self.distance(run));
        seen.exchanged = seen.exchanged.max((s - seen.stored).abs() / whole);
        seen.stored = s;
        if self.free.is_none_or(|free| run.time() <= free) {
            let now = self.flight(run);
            seen.flight = [0, 1].map(|i| seen.flight[i].max(now[i]));
        }
    }

    /// See [`m::ASYMMETRY`].
    fn asymmetry(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let places = p.seeded(|k| p.position[k]);
        let (first, second) = places.split_at(self.half);
        let pairs = first.iter().zip(second);
        let gap = |(a, b): (&[f64; 2], &[f64; 2])| {
            let [x, y] = [0, 1].map(|i| a[i] + b[i] - 2.0 * MIDDLE);
            x.hypot(y) / RADIUS
        };
        pairs.map(gap).fold(0.0, f64::max)
    }
}

impl Watch<2> for Collision {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "kinetic_energy (J/m)",
            "node_kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "stress_work (J/m)",
            "energy_change (-)",
            "accumulated_change (-)",
            "momentum_x (kg/s)",
            "momentum_y (kg/s)",
            "angular_momentum (kg m/s)",
            "distance (m)",
            "newton_iterations (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let start = *seen
            .start
            .get_or_insert_with(|| self.sums(stage.run.as_ref()));
        let finer = CELL / self.spec.level.h;
        let steps = (ROW * finer / step_factor(&self.parameters)).round() as u64;
        let steps = steps.min(self.steps - seen.steps);
        let before = stage.run.work().newton_iterations;
        for _ in 0..steps {
            stage.steps(1)?;
            seen.steps += 1;
            self.note(seen, stage.run.as_ref(), &start);
        }
        seen.rows += 1;
        let run = stage.run.as_ref();
        let sums = self.sums(run);
        let [k0, s0, _] = start.energies;
        let [k, s, a] = sums.energies;
        Ok(vec![
            run.time(),
            k,
            run.residual().kinetic_energy,
            s,
            a,
            (k + s) / (k0 + s0) - 1.0,
            (k + a) / k0 - 1.0,
            sums.momentum[0],
            sums.momentum[1],
            sums.angular,
            self.distance(run),
            (run.work().newton_iterations - before) as f64,
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        seen.steps as f64 / self.steps as f64
    }

    fn snapshot(&self, seen: &Seen, stage: &mut Stage<2>) -> Option<Snapshot> {
        if seen.rows != IN_CONTACT {
            return None;
        }
        let columns = self.particles(seen, stage);
        Some(Snapshot {
            time: stage.run.time(),
            columns,
        })
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend([
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("vy", "m/s", p.seeded(|k| p.velocity[k][1])),
            column("mean_stress", "Pa", p.seeded(|k| p.stress[k].mean())),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let sums = self.sums(run);
        let start = seen.start.unwrap_or(sums);
        let [k0, s0, _] = start.energies;
        let [k, s, _] = sums.energies;
        let work = run.work();
        let [before, after] = [start.relative, sums.relative];
        let closing = before[0].hypot(before[1]);
        let mut values = vec![
            (m::ENERGY_GAIN, seen.gain),
            (m::ENERGY_LOSS, seen.loss),
            (m::ENERGY_END, (k + s) / (k0 + s0) - 1.0),
            (m::ENERGY_ERROR_ACCUMULATED, seen.accumulated),
            (
                m::LUMPING_LOSS,
                run.totals().accumulated.lumping_loss / (k0 + s0),
            ),
            (m::NODE_ENERGY_GAP, seen.node_gap),
            (m::MOMENTUM_ERROR, seen.momentum.max(ROUNDING)),
            (m::ANGULAR_MOMENTUM_ERROR, seen.angular.max(ROUNDING)),
            (m::ENERGY_EXCHANGED, seen.exchanged),
            (m::RESTITUTION, after[0].hypot(after[1]) / closing),
            (
                m::DEFLECTION,
                (after[0] - before[0]).hypot(after[1] - before[1]) / closing,
            ),
            (m::FLIGHT_ERROR, seen.flight[0].max(ROUNDING)),
            (m::FLIGHT_STRAIN, seen.flight[1].max(ROUNDING)),
            (m::ASYMMETRY, self.asymmetry(run).max(MIRRORED)),
            (m::CLOSEST, seen.closest),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (m::MASS, run.totals().mass),
        ];
        values.extend(self.free.map(|free| (m::FREE_UNTIL, free)));
        values
    }
}
