//! The simulation of a motion that is known in closed form, in any dimension and of any law.

use super::checks::moves;
use super::metrics as m;
use super::scene::{Timing, begin, lag, vector};
use super::{Manufactured, errors};
use crate::cases::observe::{
    check_rule, column, discretisation, position_columns, reference_columns,
};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::exact::Exact;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::{Parameter, Parameters};
use crate::record::Discretisation;
use crate::scheme::RuleName;
use crate::spec::RunSpec;
use crate::statistics::{fit_line, rms};
use mpm_core::Simulation;
use mpm_core::material::{NeoHookean, NewtonianFluid};
use mpm_solvers::{Solvable, Solved};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Rows of the time series, and rows per period of a standing wave.
const ROWS: f64 = 200.0;
const ROWS_PER_PERIOD: f64 = 40.0;
/// Steps between rows, at most: what is said and kept comes with rows.
const MOST_STEPS: u64 = 100_000;
/// Times at which the size of the exact displacement is looked up.
const SCALE_TIMES: u32 = 20;

/// A motion, watched beside its exact solution.
pub(super) struct Motion<const D: usize> {
    case: Manufactured,
    spec: RunSpec,
    parameters: Parameters,
    solution: Arc<dyn Exact>,
    discretisation: Discretisation,
    steps: u64,
    steps_per_row: u64,
    /// Angular frequency (rad/s) of a solution that is one standing wave.
    frequency: Option<f64>,
}

/// What has been seen of a motion.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// Means of J̄ and J over each cell at the start, of a body that is to stay at rest.
    at_start: Option<Vec<[f64; 2]>>,
    rows: Vec<Row>,
}

/// What is kept of a row of the series.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct Row {
    time: f64,
    kinetic: f64,
    /// Kinetic + stored energy − work of the loads.
    energy: f64,
    /// Displacement in the shape of the standing wave, relative to its amplitude.
    mode: f64,
}

impl<const D: usize> Motion<D>
where
    NeoHookean: Solvable<D> + Solved<D>,
    NewtonianFluid: Solvable<D> + Solved<D>,
{
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        case: Manufactured,
        spec: &RunSpec,
        parameters: &Parameters,
        known: &[Parameter],
    ) -> Result<Drive<D, Self>, Error> {
        let solution: Arc<dyn Exact> = (case.solution)(parameters)?.into();
        check_rule(spec, parameters, known)?;
        let Timing { steps, dt } = Timing::new(case, spec, parameters, solution.as_ref())?;
        let frequency = case.frequency.map(|f| f(parameters));
        let frequency = frequency.filter(|_| moves(parameters));
        let row = match frequency {
            Some(omega) => std::f64::consts::TAU / omega / ROWS_PER_PERIOD / dt,
            None => steps / ROWS,
        };
        let motion = Self {
            case,
            spec: spec.clone(),
            parameters: parameters.clone(),
            solution,
            discretisation: discretisation(D, spec, parameters, dt),
            steps: steps as u64,
            steps_per_row: (row as u64).clamp(1, MOST_STEPS),
            frequency,
        };
        Ok(Drive::new(motion, Seen::default())?)
    }
}

impl<const D: usize> Motion<D> {
    /// Means of J̄ and J over each cell, by the particles' reference positions.
    fn cell_means(&self, run: &dyn Simulation<D>) -> Vec<[f64; 2]> {
        let (p, h, extent) = (
            run.particles(),
            self.discretisation.h,
            self.solution.extent(),
        );
        let mut sums: BTreeMap<Vec<usize>, ([f64; 2], f64)> = BTreeMap::new();
        for k in 0..p.len() {
            let cell = |a: usize| ((p.reference[k][a] - extent[a][0]) / h) as usize;
            let (sum, count) = sums.entry((0..D).map(cell).collect()).or_default();
            sum[0] += p.j_bar.get(k).unwrap_or(&p.jacobian[k]);
            sum[1] += p.jacobian[k];
            *count += 1.0;
        }
        sums.values().map(|(s, n)| s.map(|s| s / n)).collect()
    }

    /// The share of the displacement since the start that has the shape of the standing wave.
    fn mode(&self, run: &dyn Simulation<D>) -> f64 {
        let Some(omega) = self.frequency else {
            return f64::NAN;
        };
        let quarter = 0.5 * std::f64::consts::PI / omega;
        let p = run.particles();
        let (mut along, mut squares) = (0.0, 0.0);
        for k in 0..p.len() {
            let x = vector(&p.reference[k]);
            let rest = self.solution.displacement(&x, 0.0);
            let shape = self.solution.displacement(&x, quarter) - rest;
            along += (vector(&p.position[k]) - x - rest).dot(&shape);
            squares += shape.norm_squared();
        }
        along / squares
    }

    fn observe(&self, seen: &mut Seen, run: &dyn Simulation<D>) -> Vec<f64> {
        let totals = run.totals();
        let work = totals.accumulated;
        let row = Row {
            time: run.time(),
            kinetic: totals.kinetic_energy,
            energy: totals.kinetic_energy + totals.stored_energy - work.load_work,
            mode: self.mode(run),
        };
        seen.rows.push(row);
        let (p, solution) = (run.particles(), self.solution.as_ref());
        let errors = (0..p.len()).map(|k| errors::of_displacement(solution, p, k, row.time).norm());
        let mut values = vec![
            row.time,
            rms(errors),
            row.kinetic,
            run.residual().kinetic_energy,
            totals.stored_energy,
            work.stress_work,
            work.load_work,
            row.energy,
            totals.jacobian.0,
            totals.jacobian.1,
            totals.log_jacobian_gap_rms,
        ];
        if self.frequency.is_some() {
            values.push(row.mode);
        }
        values
    }

    /// The largest rms over the particles of the exact displacement since the start, over the
    /// duration.
    fn displacement_scale(&self, run: &dyn Simulation<D>) -> f64 {
        let references = &run.particles().reference;
        let scale = |t: f64| {
            rms(references.iter().map(|x| {
                let x = vector(x);
                (self.solution.displacement(&x, t) - self.solution.displacement(&x, 0.0)).norm()
            }))
        };
        let times = (0..=SCALE_TIMES).map(|k| f64::from(k) / f64::from(SCALE_TIMES));
        times.map(|s| scale(s * run.time())).fold(0.0, f64::max)
    }

    /// Errors of displacement, velocity, stress and mean stress of every particle, and the projections
    /// of displacement and velocity on the exact ones.
    fn errors(&self, run: &mut dyn Simulation<D>) -> ([Vec<f64>; 4], [f64; 2]) {
        let (t, lag) = (run.time(), lag(&self.spec, self.discretisation.dt));
        let stresses = errors::of_stress(self.solution.as_ref(), run);
        let p = run.particles();
        let mut found = [const { Vec::new() }; 4];
        let mut projections = [(0.0, 0.0); 2];
        for (k, stress) in stresses.iter().enumerate() {
            let x = vector(&p.reference[k]);
            let exact = [
                self.solution.displacement(&x, t),
                self.solution.velocity(&x, t - lag),
            ];
            let off = [
                errors::of_displacement(self.solution.as_ref(), p, k, t),
                vector(&p.velocity[k]) - exact[1],
            ];
            for (sums, (exact, off)) in projections.iter_mut().zip(exact.iter().zip(&off)) {
                sums.0 += (exact + off).dot(exact);
                sums.1 += exact.norm_squared();
            }
            let values = [
                off[0].norm(),
                off[1].norm(),
                stress.norm(),
                (stress.trace() / 3.0).abs(),
            ];
            for (errors, value) in found.iter_mut().zip(values) {
                errors.push(value);
            }
        }
        (found, projections.map(|(along, squares)| along / squares))
    }

    /// Frequency over the exact one from the zeros of the mode, and its amplitude in the last period
    /// over that in the first.
    fn vibration(&self, seen: &Seen, run: &dyn Simulation<D>) -> Option<[f64; 2]> {
        let omega = self.frequency?;
        let zeros = seen.rows.windows(2).filter_map(|pair| {
            let ([a, b], crosses) = ([pair[0], pair[1]], pair[0].mode * pair[1].mode < 0.0);
            crosses.then(|| a.time + (b.time - a.time) * a.mode / (a.mode - b.mode))
        });
        let zeros: Vec<(f64, f64)> = zeros.enumerate().map(|(k, t)| (k as f64, t)).collect();
        let half_period = fit_line(&zeros)?.slope;
        let period = std::f64::consts::TAU / omega;
        let end = run.time();
        let largest = |from: f64, to: f64| {
            let inside = seen.rows.iter().filter(|r| (from..=to).contains(&r.time));
            inside.map(|r| r.mode.abs()).fold(0.0, f64::max)
        };
        Some([
            std::f64::consts::PI / half_period / omega,
            largest(end - period, end) / largest(0.0, period),
        ])
    }

    /// Of a body at rest: largest drift of the cells' means of J̄ and J per 10⁵ steps, largest kinetic
    /// energy of the last third over that of the middle third, and the pressure at the base.
    fn rest(&self, seen: &Seen, run: &mut dyn Simulation<D>) -> Option<[f64; 4]> {
        let start = seen.at_start.clone()?;
        let per = 1e5 / self.steps as f64;
        let now = self.cell_means(run);
        let drift = |which: usize| {
            let moved = start
                .iter()
                .zip(&now)
                .map(|(a, b)| (b[which] - a[which]).abs());
            moved.fold(0.0, f64::max) * per
        };
        let third = seen.rows.len() / 3;
        let peak = |rows: &[Row]| rows.iter().map(|r| r.kinetic).fold(0.0, f64::max);
        let (earlier, last) = seen.rows.split_at(seen.rows.len() - third);
        let growth = peak(last) / peak(&earlier[earlier.len() - third..]);
        let stress = run.force_stress();
        let height = self.solution.extent()[D - 1];
        let below = |y: f64| y < 0.5 * (height[0] + height[1]);
        let references = &run.particles().reference;
        let profile: Vec<(f64, f64)> = references
            .iter()
            .zip(&stress)
            .filter(|(x, _)| below(x[D - 1]))
            .map(|(x, s)| (x[D - 1] - height[0], -s.mean()))
            .collect();
        let base = fit_line(&profile).map_or(f64::NAN, |line| line.intercept);
        Some([drift(0), drift(1), growth, base])
    }
}

impl<const D: usize> Watch<D> for Motion<D>
where
    NeoHookean: Solvable<D> + Solved<D>,
    NewtonianFluid: Solvable<D> + Solved<D>,
{
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        let dt = self.discretisation.dt;
        begin(self.case, &self.spec, &self.parameters, &self.solution, dt)
    }

    fn columns(&self) -> Vec<&'static str> {
        let mut columns = vec![
            "time (s)",
            "displacement_l2 (m)",
            "kinetic_energy (J)",
            "nodal_kinetic_energy (J)",
            "stored_energy (J)",
            "stress_work (J)",
            "load_work (J)",
            "energy (J)",
            "jacobian_min (-)",
            "jacobian_max (-)",
            "log_jacobian_gap_rms (-)",
        ];
        if self.frequency.is_some() {
            columns.push("mode (-)");
        }
        columns
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, mpm_core::Error> {
        if seen.rows.is_empty() {
            let start = stage.run.as_ref();
            seen.at_start = self.case.rests.then(|| self.cell_means(start));
            self.observe(seen, start);
        }
        let left = self.steps - stage.run.work().steps;
        stage.steps(self.steps_per_row.min(left))?;
        Ok(self.observe(seen, stage.run.as_ref()))
    }

    fn progress(&self, _: &Seen, stage: &Stage<D>) -> f64 {
        stage.run.work().steps as f64 / self.steps as f64
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<Column> {
        let run = stage.run.as_mut();
        let [displacement, velocity, stress, mean_stress] = {
            let (errors, _) = self.errors(run);
            let p = run.particles();
            errors.map(|values| p.seeded(|k| values[k]))
        };
        let force_stress = run.force_stress();
        let p = run.particles();
        let mut columns = [position_columns(p), reference_columns(p)].concat();
        columns.extend([
            column("displacement_error", "m", displacement),
            column("velocity_error", "m/s", velocity),
            column("stress_error", "Pa", stress),
            column("mean_stress", "Pa", p.seeded(|k| force_stress[k].mean())),
            column("mean_stress_error", "Pa", mean_stress),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
            column(
                "averaged_jacobian",
                "-",
                p.seeded(|k| p.j_bar.get(k).copied().unwrap_or(p.jacobian[k])),
            ),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<D>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_mut();
        let (errors, [displacement_ratio, velocity_ratio]) = self.errors(run);
        let totals = run.totals();
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let peak = seen.rows.iter().map(|r| r.kinetic).fold(0.0, f64::max);
        let start = seen.rows.first().map_or(f64::NAN, |r| r.energy);
        // Where nothing moves nothing is gained.
        let share = |gain: f64| if gain == 0.0 { 0.0 } else { gain / peak };
        let gains = || seen.rows.iter().map(|r| share(r.energy - start));
        let mut values = vec![
            (m::DISPLACEMENT_SCALE, self.displacement_scale(run)),
            (m::DISPLACEMENT_RATIO, displacement_ratio),
            (m::VELOCITY_RATIO, velocity_ratio),
            (m::ENERGY_GAIN, gains().fold(0.0, f64::max)),
            (m::ENERGY_LOSS, gains().map(|g| -g).fold(0.0, f64::max)),
            (m::ENERGY_END, gains().next_back().unwrap_or(f64::NAN)),
            (m::LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (m::KINETIC_ENERGY_PEAK, peak),
            (m::MASS, totals.mass),
            (m::BODY_MASS, errors::mass::<D>(self.solution.as_ref())),
        ];
        if self.spec.scheme.rule() == Some(RuleName::Midpoint) {
            let taken = totals.accumulated.lumping_loss;
            values.push((m::LUMPING_LOSS, share(taken)));
        }
        let names = [
            [m::DISPLACEMENT_L2, m::DISPLACEMENT_LINF],
            [m::VELOCITY_L2, m::VELOCITY_LINF],
            [m::STRESS_L2, m::STRESS_LINF],
            [m::MEAN_STRESS_L2, m::MEAN_STRESS_LINF],
        ];
        for ([l2, linf], errors) in names.into_iter().zip(&errors) {
            values.push((l2, rms(errors.iter().copied())));
            values.push((linf, largest(errors)));
        }
        if let Some([frequency, amplitude]) = self.vibration(seen, run) {
            values.push((m::FREQUENCY_RATIO, frequency));
            values.push((m::FREQUENCY_ERROR, (frequency - 1.0).abs()));
            values.push((m::AMPLITUDE_RATIO, amplitude));
            values.push((m::DAMPING, -amplitude.ln()));
        }
        if let Some([j_bar, j, growth, base]) = self.rest(seen, run) {
            values.push((m::J_DRIFT_PER_1E5_STEPS, j_bar));
            values.push((m::TRUE_J_DRIFT_PER_1E5_STEPS, j));
            values.push((m::KINETIC_GROWTH, growth));
            values.push((m::BASE_PRESSURE, base));
        }
        values
    }
}
