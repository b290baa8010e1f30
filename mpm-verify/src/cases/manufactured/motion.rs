//! The simulation of a motion that is known in closed form, in any dimension and of any law.

use super::checks::moves;
use super::metrics::*;
use super::scenario::Timing;
use super::{Known, Own, Scenario, errors, vector};
use crate::cases::prelude::*;

/// Rows of the time series, and rows per period of a standing wave.
const ROWS: f64 = 200.0;
const ROWS_PER_PERIOD: f64 = 40.0;
/// Most steps between rows: checkpoints come with rows.
const MOST_STEPS: u64 = 100_000;
/// Times at which the exact displacement is measured for its scale.
const SCALE_TIMES: u32 = 20;

pub(in crate::cases) struct Motion<const D: usize, K> {
    scenario: Scenario<K>,
    pub(super) timing: Timing,
    steps_per_row: u64,
    /// Angular frequency (rad/s) of a solution that is one standing wave.
    frequency: Option<f64>,
}

#[derive(Default, Serialize, Deserialize)]
pub(in crate::cases) struct Seen {
    /// Means of J̄ and J over each cell at the start, of a body that is to stay at rest.
    at_start: Option<[Vec<f64>; 2]>,
    rows: Vec<Sample>,
}

/// Values of a row of the series that metrics need.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub(super) struct Sample {
    pub(super) time: f64,
    pub(super) kinetic: f64,
    /// Kinetic + stored energy − work of the loads.
    pub(super) energy: f64,
    /// Displacement in the shape of the standing wave, relative to its amplitude.
    pub(super) mode: f64,
}

fn peak(rows: &[Sample]) -> f64 {
    rows.iter().map(|r| r.kinetic).fold(0.0, f64::max)
}

/// An energy over the largest kinetic one. Where nothing moves nothing is gained.
fn share(gain: f64, peak: f64) -> f64 {
    if gain == 0.0 { 0.0 } else { gain / peak }
}

/// Metrics of the energies of rows, the first of which is the start.
pub(super) fn of_energies(rows: &[Sample]) -> Vec<(Metric, f64)> {
    let (start, peak) = (rows.first().map_or(f64::NAN, |r| r.energy), peak(rows));
    let gains = || rows.iter().map(|r| share(r.energy - start, peak));
    vec![
        (ENERGY_GAIN, gains().fold(0.0, f64::max)),
        (ENERGY_LOSS, gains().map(|g| -g).fold(0.0, f64::max)),
        (ENERGY_END, gains().next_back().unwrap_or(f64::NAN)),
        (KINETIC_ENERGY_PEAK, peak),
    ]
}

/// Growth of the kinetic energy from the middle third of the rows to the last.
pub(super) fn growth(rows: &[Sample]) -> (Metric, f64) {
    let third = rows.len() / 3;
    let (earlier, last) = rows.split_at(rows.len() - third);
    (KINETIC_GROWTH, peak(last) / peak(&earlier[earlier.len() - third..]))
}

/// Largest change of a cell's mean per 10⁵ steps.
pub(super) fn drift(before: &[f64], now: &[f64], steps: f64) -> f64 {
    before.iter().zip(now).map(|(before, now)| (now - before).abs()).fold(0.0, f64::max) * (1e5 / steps)
}

impl<const D: usize, K: Known> Motion<D, K> {
    /// Means over each cell of a value of particles that start at `references` (m).
    pub(super) fn cell_means(&self, references: &[[f64; D]], values: &[f64]) -> Vec<f64> {
        let (h, extent) = (self.scenario.setup.h, self.scenario.solution.extent());
        let mut sums: BTreeMap<Vec<usize>, (f64, f64)> = BTreeMap::new();
        for (x, value) in references.iter().zip(values) {
            let cell = |a: usize| ((x[a] - extent[a][0]) / h) as usize;
            let (sum, count) = sums.entry((0..D).map(cell).collect()).or_default();
            *sum += value;
            *count += 1.0;
        }
        sums.values().map(|(sum, count)| sum / count).collect()
    }

    /// Means of J̄ and J over each cell.
    fn volumes(&self, run: &dyn Simulation<D>) -> [Vec<f64>; 2] {
        let p = run.particles();
        let references: Vec<[f64; D]> = p.seeded(|k| k).into_iter().map(|k| p.reference[k]).collect();
        let averaged = p.seeded(|k| *p.j_bar.get(k).unwrap_or(&p.jacobian[k]));
        [averaged, p.seeded(|k| p.jacobian[k])].map(|values| self.cell_means(&references, &values))
    }

    /// The share of the displacement since the start that has the shape of the standing wave.
    fn mode(&self, run: &dyn Simulation<D>) -> f64 {
        let Some(omega) = self.frequency else { return f64::NAN };
        let (p, solution) = (run.particles(), &self.scenario.solution);
        let quarter = 0.5 * PI / omega;
        let (mut along, mut squares) = (0.0, 0.0);
        for k in 0..p.len() {
            let x = vector(&p.reference[k]);
            let rest = solution.displacement(&x, 0.0);
            let shape = solution.displacement(&x, quarter) - rest;
            along += (vector(&p.position[k]) - x - rest).dot(&shape);
            squares += shape.norm_squared();
        }
        along / squares
    }

    pub(super) fn sample(&self, run: &dyn Simulation<D>) -> Sample {
        let totals = run.totals();
        Sample {
            time: run.time(),
            kinetic: totals.kinetic_energy,
            energy: totals.kinetic_energy + totals.stored_energy - totals.accumulated.load_work,
            mode: self.mode(run),
        }
    }

    fn observe(&self, seen: &mut Seen, run: &dyn Simulation<D>) -> Row {
        let (sample, totals) = (self.sample(run), run.totals());
        let work = totals.accumulated;
        seen.rows.push(sample);
        let errors = errors::of_displacements(self.scenario.solution.as_ref(), run);
        let mut row = row! {
            "time (s)": sample.time,
            "displacement_l2 (m)": rms(errors.into_iter()),
            "kinetic_energy (J)": sample.kinetic,
            "nodal_kinetic_energy (J)": run.residual().kinetic_energy,
            "stored_energy (J)": totals.stored_energy,
            "stress_work (J)": work.stress_work,
            "load_work (J)": work.load_work,
            "energy (J)": sample.energy,
            "jacobian_min (-)": totals.jacobian.0,
            "jacobian_max (-)": totals.jacobian.1,
            "log_jacobian_gap_rms (-)": totals.log_jacobian_gap_rms,
        };
        if self.frequency.is_some() {
            row.0.push(("mode (-)", sample.mode));
        }
        row
    }

    /// The largest rms over the particles of the exact displacement since the start, over the duration.
    fn displacement_scale(&self, run: &dyn Simulation<D>) -> f64 {
        let (references, solution) = (&run.particles().reference, &self.scenario.solution);
        let scale = |t: f64| {
            rms(references.iter().map(|x| {
                let x = vector(x);
                (solution.displacement(&x, t) - solution.displacement(&x, 0.0)).norm()
            }))
        };
        let times = (0..=SCALE_TIMES).map(|k| f64::from(k) / f64::from(SCALE_TIMES));
        times.map(|s| scale(s * run.time())).fold(0.0, f64::max)
    }

    /// Velocity errors of all particles (m/s), and projections of displacement and velocity on the exact ones, over these.
    fn velocities(&self, run: &dyn Simulation<D>) -> (Vec<f64>, [f64; 2]) {
        let solution = self.scenario.solution.as_ref();
        let (p, t, lag) = (run.particles(), run.time(), self.scenario.lag(self.timing.dt));
        let mut errors = Vec::with_capacity(p.len());
        let mut projections = [(0.0, 0.0); 2];
        for k in 0..p.len() {
            let x = vector(&p.reference[k]);
            let exact = [solution.displacement(&x, t), solution.velocity(&x, t - lag)];
            let off = [errors::of_displacement(solution, p, k, t), vector(&p.velocity[k]) - exact[1]];
            for (sums, (exact, off)) in projections.iter_mut().zip(exact.iter().zip(&off)) {
                sums.0 += (exact + off).dot(exact);
                sums.1 += exact.norm_squared();
            }
            errors.push(off[1].norm());
        }
        (errors, projections.map(|(along, squares)| along / squares))
    }

    /// Metrics of a standing wave: frequency over the exact one from the zeros of the mode, and its amplitude in the last period
    /// over that in the first.
    pub(super) fn vibration(&self, rows: &[Sample]) -> Option<[(Metric, f64); 4]> {
        let (omega, end) = (self.frequency?, rows.last()?.time);
        let half_period = half_period(&rows.iter().map(|r| (r.time, r.mode)).collect::<Vec<_>>())?;
        let period = TAU / omega;
        let largest = |from: f64, to: f64| {
            rows.iter().filter(|r| (from..=to).contains(&r.time)).map(|r| r.mode.abs()).fold(0.0, f64::max)
        };
        let (frequency, amplitude) = (PI / half_period / omega, largest(end - period, end) / largest(0.0, period));
        Some([
            (FREQUENCY_RATIO, frequency),
            (FREQUENCY_ERROR, (frequency - 1.0).abs()),
            (AMPLITUDE_RATIO, amplitude),
            (DAMPING, -amplitude.ln()),
        ])
    }

    /// Pressure (Pa) at the base, by particles that start at these heights (m) and their mean stress (Pa).
    pub(super) fn base_pressure(&self, heights: &[f64], mean_stress: &[f64]) -> f64 {
        let [lo, hi] = self.scenario.solution.extent()[D - 1];
        let lower = heights.iter().zip(mean_stress).filter(|(y, _)| **y < 0.5 * (lo + hi));
        let profile: Vec<(f64, f64)> = lower.map(|(y, mean)| (y - lo, -mean)).collect();
        fit_line(&profile).map_or(f64::NAN, |line| line.intercept)
    }

    /// Metrics of a body at rest: drifts of the cells' means, and the pressure at the base.
    fn rest(&self, seen: &Seen, run: &mut dyn Simulation<D>) -> Vec<(Metric, f64)> {
        let Some([averaged, own]) = &seen.at_start else { return Vec::new() };
        let (now, stress) = (self.volumes(run), run.force_stress());
        let p = run.particles();
        let [heights, mean] = [p.seeded(|k| p.reference[k][D - 1]), p.seeded(|k| stress[k].mean())];
        vec![
            (J_DRIFT_PER_1E5_STEPS, drift(averaged, &now[0], self.timing.steps)),
            (TRUE_J_DRIFT_PER_1E5_STEPS, drift(own, &now[1], self.timing.steps)),
            (BASE_PRESSURE, self.base_pressure(&heights, &mean)),
            growth(&seen.rows),
        ]
    }
}

impl<const D: usize, K: Known> Problem<D> for Motion<D, K> {
    type Parameters = Own<K>;
    type Seen = Seen;

    fn new(setup: Setup<Own<K>>) -> Result<Self, Error> {
        let scenario = Scenario::new(setup)?;
        let setup = &scenario.setup;
        setup.check_rule()?;
        let timing = scenario.timing()?;
        let frequency = K::FREQUENCY.map(|of| of(&setup.values)).filter(|_| moves(&setup.values));
        let row = frequency.map_or(timing.steps / ROWS, |omega| TAU / omega / ROWS_PER_PERIOD / timing.dt);
        Ok(Self { scenario, timing, steps_per_row: (row as u64).clamp(1, MOST_STEPS), frequency })
    }

    fn discretisation(&self) -> Discretisation {
        self.scenario.setup.regular(D, self.timing.dt)
    }

    fn begin(&self, _: &Seen) -> Begun<D> {
        self.scenario.begin(self.timing.dt)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<D>) -> Result<Row, Fault> {
        if seen.rows.is_empty() {
            let start = phase.run.as_ref();
            seen.at_start = K::RESTS.then(|| self.volumes(start));
            self.observe(seen, start);
        }
        let left = self.timing.steps as u64 - phase.run.work().steps;
        phase.steps(self.steps_per_row.min(left))?;
        Ok(self.observe(seen, phase.run.as_ref()))
    }

    fn progress(&self, _: &Seen, phase: &Phase<D>) -> f64 {
        phase.share_of(self.timing.steps as u64)
    }

    fn particles<'a>(&self, _: &Seen, mut columns: Columns<'a, D>) -> Columns<'a, D> {
        let (run, solution) = (columns.run(), self.scenario.solution.as_ref());
        let [stress, mean_stress] = errors::of_stresses(solution, run);
        let displacement = errors::of_displacements(solution, run);
        let (velocity, _) = self.velocities(run);
        let force_stress = run.force_stress();
        columns
            .references()
            .each("displacement_error", "m", |_, k| displacement[k])
            .each("velocity_error", "m/s", |_, k| velocity[k])
            .each("stress_error", "Pa", |_, k| stress[k])
            .each("mean_stress", "Pa", |_, k| force_stress[k].mean())
            .each("mean_stress_error", "Pa", |_, k| mean_stress[k])
            .jacobian()
            .each("averaged_jacobian", "-", |p, k| p.j_bar.get(k).copied().unwrap_or(p.jacobian[k]))
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_mut();
        let (velocity, [displacement_ratio, velocity_ratio]) = self.velocities(run);
        let mut values = of_energies(&seen.rows);
        values.extend([
            (DISPLACEMENT_SCALE, self.displacement_scale(run)),
            (DISPLACEMENT_RATIO, displacement_ratio),
            (VELOCITY_RATIO, velocity_ratio),
        ]);
        values.extend(errors::norms([VELOCITY_L2, VELOCITY_LINF], &velocity));
        values.extend(errors::at_end(self.scenario.solution.as_ref(), run));
        if self.scenario.setup.rule() == Some(RuleName::Midpoint) {
            values.push((LUMPING_LOSS, share(run.totals().accumulated.lumping_loss, peak(&seen.rows))));
        }
        values.extend(self.vibration(&seen.rows).into_iter().flatten());
        values.extend(self.rest(seen, run));
        values
    }
}
