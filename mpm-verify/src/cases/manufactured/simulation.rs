//! The simulation of a motion that is known in closed form, in any dimension and of any law.

use super::scene::{Timing, begin, vector};
use super::{METRICS, Manufactured};
use crate::case::{Column, Job, RunSpec, observed};
use crate::error::Error;
use crate::exact::Exact;
use crate::parameter::Parameters;
use crate::record::{Discretisation, Metric, WorkDone};
use crate::statistics::{fit_line, rms};
use mpm_core::material::{NeoHookean, NewtonianFluid};
use mpm_core::{Memory, MemoryError, Particles, Saved, Simulation};
use mpm_solvers::Solvable;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Rows of the time series, and rows per period of a standing wave.
const ROWS: f64 = 200.0;
const ROWS_PER_PERIOD: f64 = 40.0;
/// Times at which the size of the exact displacement is looked up.
const SCALE_TIMES: u32 = 20;
/// A running simulation.
pub(super) struct Simulated<const D: usize> {
    simulation: Box<dyn Simulation<D>>,
    solution: Arc<dyn Exact>,
    discretisation: Discretisation,
    steps: u64,
    steps_per_row: u64,
    /// Angular frequency (rad/s) of a solution that is one standing wave.
    frequency: Option<f64>,
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

impl<const D: usize> Simulated<D>
where
    NeoHookean: Solvable<D>,
    NewtonianFluid: Solvable<D>,
{
    pub(super) fn new(
        case: &Manufactured,
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Self, Error> {
        let solution: Arc<dyn Exact> = (case.solution)(parameters)?.into();
        let number = |name| parameters.number(name);
        let Timing { steps, dt } = Timing::new(case, spec.level, parameters, solution.as_ref())?;
        let simulation = begin(case, spec, parameters, &solution, dt)?;
        let frequency = case.frequency.map(|f| f(parameters));
        let row = match frequency {
            Some(omega) => std::f64::consts::TAU / omega / ROWS_PER_PERIOD / dt,
            None => steps / ROWS,
        };
        let mut run = Self {
            simulation,
            solution,
            discretisation: Discretisation {
                dim: D,
                h: spec.level.h,
                ppc: (number("ppc_per_direction") as u32).pow(D as u32),
                dt,
                wall: parameters.text("wall"),
            },
            steps: steps as u64,
            steps_per_row: (row as u64).max(1),
            frequency,
            at_start: None,
            rows: Vec::new(),
        };
        run.at_start = case.rests.then(|| run.cell_means());
        run.observe();
        Ok(run)
    }

    /// Displacement minus the exact one (m); across a periodic end the nearest image counts.
    fn displacement_error(&self, p: &Particles<D>, k: usize, t: f64) -> Vector3<f64> {
        let x = vector(&p.reference[k]);
        let exact = x + self.solution.displacement(&x, t);
        let mut error = vector(&p.position[k]) - exact;
        let grid_extent = self.solution.extent();
        for a in 0..D {
            let length = grid_extent[a][1] - grid_extent[a][0];
            error[a] -= length * (error[a] / length).round();
        }
        error
    }

    /// Means of J̄ and J over each cell, by the particles' reference positions.
    fn cell_means(&self) -> Vec<[f64; 2]> {
        let (p, h, extent) = (
            self.simulation.particles(),
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
    fn mode(&self) -> f64 {
        let Some(omega) = self.frequency else {
            return f64::NAN;
        };
        let quarter = 0.5 * std::f64::consts::PI / omega;
        let p = self.simulation.particles();
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

    fn observe(&mut self) -> Vec<f64> {
        let totals = self.simulation.totals();
        let work = totals.accumulated;
        let row = Row {
            time: self.simulation.time(),
            kinetic: totals.kinetic_energy,
            energy: totals.kinetic_energy + totals.stored_energy - work.load_work,
            mode: self.mode(),
        };
        self.rows.push(row);
        let p = self.simulation.particles();
        let errors = (0..p.len()).map(|k| self.displacement_error(p, k, row.time).norm());
        let mut values = vec![
            row.time,
            rms(errors),
            row.kinetic,
            self.simulation.residual().kinetic_energy,
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
    fn displacement_scale(&self) -> f64 {
        let references = &self.simulation.particles().reference;
        let scale = |t: f64| {
            rms(references.iter().map(|x| {
                let x = vector(x);
                (self.solution.displacement(&x, t) - self.solution.displacement(&x, 0.0)).norm()
            }))
        };
        let times = (0..=SCALE_TIMES).map(|k| f64::from(k) / f64::from(SCALE_TIMES));
        times
            .map(|s| scale(s * self.simulation.time()))
            .fold(0.0, f64::max)
    }

    /// Cauchy stress of the motion and of the exact solution (Pa), in the particles' order.
    fn stresses(&mut self) -> Vec<(Matrix3<f64>, Matrix3<f64>)> {
        let t = self.simulation.time();
        let stress = self.simulation.force_stress();
        let references = &self.simulation.particles().reference;
        let pairs = references.iter().zip(stress).map(|(x, s)| {
            let x = vector(x);
            let f = self.solution.deformation_gradient(&x, t);
            let p = self.solution.first_piola(&x, t);
            (s.to_matrix(), p * f.transpose() / f.determinant())
        });
        pairs.collect()
    }

    /// Errors of displacement, velocity, stress and mean stress of every particle, and the projections
    /// of displacement and velocity on the exact ones.
    fn errors(&mut self) -> ([Vec<f64>; 4], [f64; 2]) {
        let (t, dt) = (self.simulation.time(), self.discretisation.dt);
        let stresses = self.stresses();
        let p = self.simulation.particles();
        let mut errors = [const { Vec::new() }; 4];
        let mut projections = [(0.0, 0.0); 2];
        for (k, (stress, exact_stress)) in stresses.iter().enumerate() {
            let x = vector(&p.reference[k]);
            let exact = [
                self.solution.displacement(&x, t),
                self.solution.velocity(&x, t - 0.5 * dt),
            ];
            let off = [
                self.displacement_error(p, k, t),
                vector(&p.velocity[k]) - exact[1],
            ];
            for (sums, (exact, off)) in projections.iter_mut().zip(exact.iter().zip(&off)) {
                sums.0 += (exact + off).dot(exact);
                sums.1 += exact.norm_squared();
            }
            let stress_off = stress - exact_stress;
            let values = [
                off[0].norm(),
                off[1].norm(),
                stress_off.norm(),
                (stress_off.trace() / 3.0).abs(),
            ];
            for (errors, value) in errors.iter_mut().zip(values) {
                errors.push(value);
            }
        }
        (errors, projections.map(|(along, squares)| along / squares))
    }

    fn body_mass(&self) -> f64 {
        let extent = self.solution.extent();
        let volume: f64 = extent[..D].iter().map(|[lo, hi]| hi - lo).product();
        volume * self.solution.material().density
    }

    /// Frequency over the exact one from the zeros of the mode, and its amplitude in the last period
    /// over that in the first.
    fn vibration(&self) -> Option<[f64; 2]> {
        let omega = self.frequency?;
        let zeros = self.rows.windows(2).filter_map(|pair| {
            let ([a, b], crosses) = ([pair[0], pair[1]], pair[0].mode * pair[1].mode < 0.0);
            crosses.then(|| a.time + (b.time - a.time) * a.mode / (a.mode - b.mode))
        });
        let zeros: Vec<(f64, f64)> = zeros.enumerate().map(|(k, t)| (k as f64, t)).collect();
        let half_period = fit_line(&zeros)?.slope;
        let period = std::f64::consts::TAU / omega;
        let end = self.simulation.time();
        let largest = |from: f64, to: f64| {
            let inside = self.rows.iter().filter(|r| (from..=to).contains(&r.time));
            inside.map(|r| r.mode.abs()).fold(0.0, f64::max)
        };
        Some([
            std::f64::consts::PI / half_period / omega,
            largest(end - period, end) / largest(0.0, period),
        ])
    }

    /// Of a body at rest: largest drift of the cells' means of J̄ and J per 10⁵ steps, largest kinetic
    /// energy of the last third over that of the middle third, and the pressure at the base.
    fn rest(&mut self) -> Option<[f64; 4]> {
        let start = self.at_start.clone()?;
        let per = 1e5 / self.steps as f64;
        let now = self.cell_means();
        let drift = |which: usize| {
            let moved = start
                .iter()
                .zip(&now)
                .map(|(a, b)| (b[which] - a[which]).abs());
            moved.fold(0.0, f64::max) * per
        };
        let third = self.rows.len() / 3;
        let peak = |rows: &[Row]| rows.iter().map(|r| r.kinetic).fold(0.0, f64::max);
        let (earlier, last) = self.rows.split_at(self.rows.len() - third);
        let growth = peak(last) / peak(&earlier[earlier.len() - third..]);
        let stress = self.simulation.force_stress();
        let height = self.solution.extent()[D - 1];
        let below = |y: f64| y < 0.5 * (height[0] + height[1]);
        let references = &self.simulation.particles().reference;
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

impl<const D: usize> Memory for Simulated<D>
where
    NeoHookean: Solvable<D>,
    NewtonianFluid: Solvable<D>,
{
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.simulation.save()?, &self.rows))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let simulation: Saved;
        (simulation, self.rows) = saved.read("a motion known in closed form")?;
        self.simulation.restore(&simulation)
    }
}

impl<const D: usize> Job for Simulated<D>
where
    NeoHookean: Solvable<D>,
    NewtonianFluid: Solvable<D>,
{
    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn series_columns(&self) -> Vec<&'static str> {
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

    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error> {
        let left = self.steps - self.simulation.work().steps;
        for _ in 0..self.steps_per_row.min(left) {
            self.simulation.step()?;
        }
        Ok(self.observe())
    }

    fn finished(&self) -> bool {
        self.simulation.work().steps >= self.steps
    }

    fn progress(&self) -> f64 {
        self.simulation.work().steps as f64 / self.steps as f64
    }

    fn particles(&mut self) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let [displacement, velocity, stress, mean_stress] = {
            let (errors, _) = self.errors();
            let p = self.simulation.particles();
            errors.map(|values| p.seeded(|k| values[k]))
        };
        let force_stress = self.simulation.force_stress();
        let p = self.simulation.particles();
        let mut columns = Vec::new();
        for (a, name) in ["x", "y", "z"].into_iter().enumerate().take(D) {
            columns.push(column(name, "m", p.seeded(|k| p.position[k][a])));
        }
        for (a, name) in ["reference_x", "reference_y", "reference_z"]
            .into_iter()
            .enumerate()
            .take(D)
        {
            columns.push(column(name, "m", p.seeded(|k| p.reference[k][a])));
        }
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

    fn metrics(&mut self) -> BTreeMap<String, Metric> {
        let (errors, [displacement_ratio, velocity_ratio]) = self.errors();
        let totals = self.simulation.totals();
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let peak = self.rows.iter().map(|r| r.kinetic).fold(0.0, f64::max);
        let start = self.rows[0].energy;
        let gain = |row: &Row| (row.energy - start) / peak;
        let mut values: Vec<(&str, f64)> = vec![
            ("displacement_scale", self.displacement_scale()),
            ("displacement_ratio", displacement_ratio),
            ("velocity_ratio", velocity_ratio),
            (
                "energy_gain",
                self.rows.iter().map(gain).fold(0.0, f64::max),
            ),
            (
                "energy_loss",
                self.rows.iter().map(|r| -gain(r)).fold(0.0, f64::max),
            ),
            ("energy_end", self.rows.last().map_or(f64::NAN, gain)),
            ("log_jacobian_gap", totals.log_jacobian_gap_rms),
            ("kinetic_energy_peak", peak),
            ("mass", totals.mass),
            ("body_mass", self.body_mass()),
        ];
        let names = [
            ["displacement_l2", "displacement_linf"],
            ["velocity_l2", "velocity_linf"],
            ["stress_l2", "stress_linf"],
            ["mean_stress_l2", "mean_stress_linf"],
        ];
        for ([l2, linf], errors) in names.into_iter().zip(&errors) {
            values.push((l2, rms(errors.iter().copied())));
            values.push((linf, largest(errors)));
        }
        if let Some([frequency, amplitude]) = self.vibration() {
            values.push(("frequency_ratio", frequency));
            values.push(("frequency_error", (frequency - 1.0).abs()));
            values.push(("amplitude_ratio", amplitude));
            values.push(("damping", -amplitude.ln()));
        }
        if let Some([j_bar, j, growth, base]) = self.rest() {
            values.push(("j_drift_per_1e5_steps", j_bar));
            values.push(("true_j_drift_per_1e5_steps", j));
            values.push(("kinetic_growth", growth));
            values.push(("base_pressure", base));
        }
        observed(METRICS, values)
    }

    fn work(&self) -> WorkDone {
        self.simulation.work().into()
    }
}
