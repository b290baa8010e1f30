//! What is watched: the water at rest behind the gate, then the flow.

use super::flow::{Flow, Row, Start};
use super::metrics::MASS;
use super::reference::{DEPTH, GRAVITY, LENGTH};
use super::scene::{BACK, Dam, FLOOR, FRONT, GATE, ROW, STAGE};
use crate::cases::observe::{checkerboard, column, position_columns};
use crate::drive::{Stage, Watch};
use crate::job::{Column, Snapshot};
use crate::metric::Metric;
use crate::record::Discretisation;
use crate::statistics::{fit_line, rms};
use mpm_core::{Error, Field, Part, Simulation};
use serde::{Deserialize, Serialize};

/// Rows between two frames of the animation, and the largest number of particles that is animated.
const FRAME: usize = 5;
const ANIMATED: usize = 5000;
/// Times (s) of the paper's snapshots.
const SNAPSHOTS: [f64; 4] = [0.4, 1.0, 1.5, 2.0];
/// How many of the longest periods of the water the forces behind the gate are averaged over.
const PERIODS: f64 = 3.0;

/// What has been seen of the water.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// Whether the gate is gone.
    free: bool,
    /// Rows behind it.
    held: usize,
    start: Start,
    flow: Flow,
}

type Run = dyn Simulation<2>;
/// Impulses (N s/m) on floor, back wall, front wall and gate.
type Impulses = [[f64; 3]; 4];

impl Dam {
    /// From the exact start: holds the water behind the gate for a while, to measure it. The flow begins anew.
    fn hold(&self, start: &mut Start, stage: &mut Stage<2>) -> Result<(), Error> {
        let steps = (PERIODS * self.period() / self.dt).round() as u64;
        let before = impulses(&*stage.run);
        stage.steps(1)?;
        self.measure_pressure(start, &mut *stage.run);
        stage.steps(steps.saturating_sub(1))?;
        measure_forces(start, &*stage.run, &before, steps as f64 * self.dt);
        stage.enter(self.released()?, None)
    }

    /// The pressure behind the gate.
    fn measure_pressure(&self, start: &mut Start, run: &mut Run) {
        let pressures = pressures(run, Field::MeanStress);
        let of_depth = || run.particles().reference.iter().zip(&pressures);
        let off = of_depth().map(|(x, pressure)| pressure - self.water.pressure(x[1]));
        start.profile_error = rms(off) / self.water.pressure(0.0);
        let lower: Vec<(f64, f64)> = of_depth()
            .filter(|(x, _)| x[1] < 0.5 * DEPTH)
            .map(|(x, pressure)| (x[1], *pressure))
            .collect();
        start.base_pressure = fit_line(&lower).map_or(f64::NAN, |line| line.intercept);
    }

    /// The row of now; the one before had the impulses `before`.
    fn observe(&self, run: &mut Run, before: &Impulses) -> Row {
        let now = impulses(run);
        let force = |place: usize, axis: usize| (now[place][axis] - before[place][axis]) / ROW;
        let pressures_now = pressures(run, Field::MeanStress);
        let averaged = pressures(run, Field::AveragedMeanStress);
        let board = checkerboard(&pressures_now, &averaged);
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
        let cell = self.discretisation().h;
        let near_back = p.position.iter().filter(|x| x[0] < cell);
        let level = near_back.map(|x| x[1]).fold(0.0, f64::max);
        Row {
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

impl Watch<2> for Dam {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation()
    }

    fn scene(&self, seen: &Seen) -> Result<Box<Run>, Error> {
        if seen.free {
            self.released()
        } else {
            self.behind_the_gate()
        }
    }

    fn columns(&self) -> Vec<&'static str> {
        Row::COLUMNS.map(|(name, _)| name).to_vec()
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, Error> {
        if !seen.free && self.stage_rows() == 0 {
            self.hold(&mut seen.start, stage)?;
            seen.free = true;
        }
        let before = impulses(&*stage.run);
        stage.steps(self.steps_per_row)?;
        let mut row = self.observe(&mut *stage.run, &before);
        if seen.free {
            seen.flow.rows.push(row);
            return Ok(row.values());
        }
        row.time -= STAGE;
        seen.held += 1;
        if seen.held == self.stage_rows() {
            self.measure_pressure(&mut seen.start, &mut *stage.run);
            measure_forces(&mut seen.start, &*stage.run, &before, ROW);
            let body = stage.run.body()?;
            stage.enter(self.released()?, Some(&body))?;
            seen.free = true;
        }
        Ok(row.values())
    }

    fn progress(&self, seen: &Seen, _stage: &Stage<2>) -> f64 {
        let rows = self.stage_rows() + self.free_rows();
        (seen.held + seen.flow.rows.len()) as f64 / rows as f64
    }

    fn snapshot(&self, seen: &Seen, stage: &mut Stage<2>) -> Option<Snapshot> {
        let row = seen.flow.rows.len();
        let time = row as f64 * ROW;
        let shown = SNAPSHOTS.iter().any(|t| (t - time).abs() < 0.5 * ROW);
        let few = stage.run.particles().len() <= ANIMATED;
        if row == 0 || !(shown || few && row.is_multiple_of(FRAME)) {
            return None;
        }
        let pressures = pressures(&mut *stage.run, Field::MeanStress);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.push(column("pressure", "Pa", p.seeded(|k| pressures[k])));
        Some(Snapshot { time, columns })
    }

    fn particles(&self, _seen: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let averaged = pressures(&mut *stage.run, Field::AveragedMeanStress);
        let pressures = pressures(&mut *stage.run, Field::MeanStress);
        let p = stage.run.particles();
        let own = vec![
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("vy", "m/s", p.seeded(|k| p.velocity[k][1])),
            column("pressure", "Pa", p.seeded(|k| pressures[k])),
            column("averaged_pressure", "Pa", p.seeded(|k| averaged[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ];
        [position_columns(p), own].concat()
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let density = self.water.density;
        let weight = density * GRAVITY * LENGTH * DEPTH;
        let mut values = seen.start.metrics(weight);
        values.extend(seen.flow.metrics(density, self.discretisation().h));
        values.push((MASS, stage.run.totals().mass));
        values
    }
}

/// Pressure (Pa), or its average, as it enters the forces, in the particles' order.
fn pressures(run: &mut Run, mean_stress: Field) -> Vec<f64> {
    run.field(mean_stress).into_iter().map(|s| -s).collect()
}

fn impulses(run: &Run) -> Impulses {
    [FLOOR, BACK, FRONT, GATE].map(|place| run.on(Part::Constraint(place)).impulse)
}

/// The mean forces behind the gate since the impulses were `before`, `span` (s) ago.
fn measure_forces(start: &mut Start, run: &Run, before: &Impulses, span: f64) {
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
    use super::super::scene::seed;
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
}
