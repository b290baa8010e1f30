//! What is seen of the disc, twenty times a turn.

use super::metrics as m;
use super::parameters::TURNS;
use super::scene::{Disc, RADIUS};
use crate::cases::course::{Course, Watched};
use crate::cases::observe::{column, discretisation, position_columns};
use crate::drive::Drive;
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::Simulation;
use std::f64::consts::TAU;

/// Rows in a turn.
const ROWS: f64 = 20.0;
/// Least value of what is rounding.
const ROUNDING: f64 = 1e-12;

/// A disc that turns.
pub(super) struct Spin {
    spec: RunSpec,
    parameters: Parameters,
    disc: Disc,
}

impl Spin {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Drive<2, Watched<Self>>, Error> {
        let spin = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            disc: Disc::new(spec, parameters)?,
        };
        Ok(Drive::new(Watched(spin), Default::default())?)
    }
}

impl Course<2> for Spin {
    fn discretisation(&self) -> Discretisation {
        discretisation(2, &self.spec, &self.parameters, self.disc.dt)
    }

    fn steps(&self) -> [u64; 2] {
        let rows = (ROWS * self.parameters.number(TURNS)).ceil() as u64;
        [self.disc.steps, rows]
    }

    fn begin(&self) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        self.disc.begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "angular_momentum (kg m/s)",
            "momentum (kg/s)",
            "kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "rms_radius (m)",
            "angle (rad)",
            "own_angular_momentum (kg m/s)",
        ]
    }

    fn observe(&self, run: &mut dyn Simulation<2>) -> Vec<f64> {
        let (totals, p) = (run.totals(), run.particles());
        let (mut own, mut affine, mut squares) = (0.0, 0.0, 0.0);
        let mut turned = [0.0; 2];
        for (k, mass) in p.mass.iter().enumerate() {
            let ([x, y], [u, v], [a, b]) = (p.position[k], p.velocity[k], p.reference[k]);
            own += mass * (x * v - y * u);
            if let Some(b) = p.affine.get(k) {
                affine += mass * (b[(1, 0)] - b[(0, 1)]);
            }
            squares += mass * (x * x + y * y);
            turned[0] += mass * (a * x + b * y);
            turned[1] += mass * (a * y - b * x);
        }
        let [px, py, _] = totals.momentum;
        vec![
            run.time(),
            own + affine,
            px.hypot(py),
            totals.kinetic_energy,
            totals.stored_energy,
            (squares / totals.mass).sqrt(),
            turned[1].atan2(turned[0]),
            own,
        ]
    }

    fn particles(&self, run: &mut dyn Simulation<2>) -> Vec<Column> {
        let p = run.particles();
        let mut columns = position_columns(p);
        columns.extend([
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("vy", "m/s", p.seeded(|k| p.velocity[k][1])),
            column("mean_stress", "Pa", p.seeded(|k| p.stress[k].mean())),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, rows: &[Vec<f64>], run: &mut dyn Simulation<2>) -> Vec<(Metric, f64)> {
        let (totals, p) = (run.totals(), run.particles());
        let start = &rows[0];
        let of = |row: &[f64], k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        let largest = |f: &dyn Fn(&[f64]) -> f64| {
            rows.iter()
                .map(|row| f(row))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let end = rows.last().unwrap_or(start);
        let energy = |row: &[f64]| of(row, 3) + of(row, 4);
        let gain = |row: &[f64]| energy(row) / energy(start) - 1.0;
        let spun = |row: &[f64]| of(row, 1) / of(start, 1);
        // What the turning adds to the rms radius of these particles.
        let squares = p
            .mass
            .iter()
            .zip(&p.reference)
            .map(|(m, [x, y])| m * (x * x + y * y));
        let rest = (squares.sum::<f64>() / totals.mass).sqrt();
        let exact = |row: &[f64]| (of(row, 7) / of(start, 7)).powi(2);
        let stretch = |row: &[f64]| (of(row, 5) - rest) / (of(start, 5) - rest) - exact(row);
        let late = &rows[rows.len() / 2..];
        let mean = late.iter().map(|row| stretch(row)).sum::<f64>() / late.len() as f64;
        // Rows are so close that the disc turns by less than half a turn between them.
        let steps = rows.windows(2).map(|pair| {
            let turned = of(&pair[1], 6) - of(&pair[0], 6);
            turned - TAU * (turned / TAU).round()
        });
        let rim = totals.mass * self.disc.omega * RADIUS;
        vec![
            (
                m::ANGULAR_MOMENTUM_ERROR,
                largest(&|r| (spun(r) - 1.0).abs()).max(ROUNDING),
            ),
            (m::ANGULAR_MOMENTUM_END, spun(end)),
            (
                m::MOMENTUM_ERROR,
                largest(&|r| of(r, 2) / rim).max(ROUNDING),
            ),
            (m::ENERGY_GAIN, largest(&gain)),
            (m::ENERGY_LOSS, largest(&|r| -gain(r))),
            (m::ENERGY_END, gain(end)),
            (m::STRETCH_ERROR, largest(&|r| stretch(r).abs())),
            (m::STRETCH_MEAN_ERROR, mean),
            (
                m::PHASE_ERROR,
                steps.sum::<f64>() / (self.disc.omega * run.time()) - 1.0,
            ),
            (m::STORED_SHARE, of(start, 4) / energy(start)),
            (m::MASS, totals.mass),
        ]
    }
}
