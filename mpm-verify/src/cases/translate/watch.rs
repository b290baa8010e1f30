//! A prestressed body that moves through a periodic grid, and what is seen of it, twice in a cell.

use super::metrics as m;
use super::parameters::{CELLS, FLIP, PARTICLES, POISSON_RATIO, PPC_PER_DIRECTION, SPEED, STRETCH};
use crate::cases::course::{Course, Watched};
use crate::cases::lattice_waves::{force, symbol, transform};
use crate::cases::observe::{column, position_columns, settings};
use crate::cases::parameters::cfl;
use crate::drive::Drive;
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::{RemedyName, TransferName};
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::explicit::courant_time_step;
use mpm_core::explicit::transfer::Flip;
use mpm_core::material::NeoHookean;
use mpm_core::{Axis, Body, Error as Fault, Grid, Law, Particles, Scene, Simulation};
use nalgebra::{Matrix2, Matrix3};
use std::f64::consts::TAU;

/// Cells of a period along the motion and across it.
pub(super) const PERIOD: usize = 8;
const ACROSS: usize = 4;
/// Young's modulus (Pa) and density of the undeformed body (kg/m³).
const YOUNG_MODULUS: f64 = 1e6;
const DENSITY: f64 = 1000.0;
/// Waves of the lattice whose forces are summed.
const WAVES: i32 = 3;
/// Rows in a cell.
const ROWS: f64 = 2.0;
/// Least values of what is rounding.
const NOISE: f64 = 1e-10;
const ROUNDING: f64 = 1e-12;

/// A body under a uniform stress that moves.
pub(super) struct Translation {
    spec: RunSpec,
    parameters: Parameters,
    law: NeoHookean,
    /// Speed of waves (m/s), time step (s), steps.
    waves: f64,
    dt: f64,
    steps: u64,
    /// The exact stress σ_xx (Pa).
    stress: f64,
}

impl Translation {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Drive<2, Watched<Self>>, Error> {
        let number = |p| parameters.number(p);
        let law = NeoHookean::new(YOUNG_MODULUS, number(POISSON_RATIO))?;
        let waves = law.wave_speed(DENSITY);
        let along = 0.5 * PERIOD as f64 / number(PARTICLES);
        let cfl = cfl(
            spec,
            parameters,
            2,
            along.min(0.5 / number(PPC_PER_DIRECTION)),
        )?;
        let dt = courant_time_step(cfl, spec.level.h, waves);
        let mut stretched = Matrix3::identity() * number(STRETCH);
        stretched[(2, 2)] = 1.0;
        let distance = number(CELLS) * spec.level.h;
        let translation = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            law,
            waves,
            dt,
            steps: (distance / (number(SPEED) * waves) / dt).ceil() as u64,
            stress: law.at_rest(&stretched).0.get(0, 0),
        };
        Ok(Drive::new(Watched(translation), Default::default())?)
    }

    fn speed(&self) -> f64 {
        self.parameters.number(SPEED) * self.waves
    }

    /// Mean of σ_xx over the particles, and the rms of what they differ from it by, both over the exact value.
    fn stresses(&self, run: &mut dyn Simulation<2>) -> [f64; 2] {
        let stress: Vec<f64> = run
            .force_stress()
            .iter()
            .map(|s| s.get(0, 0) / self.stress)
            .collect();
        let mean = stress.iter().sum::<f64>() / stress.len() as f64;
        [mean, rms(stress.iter().map(|s| s - mean))]
    }

    /// What the lattice's forces of a uniform stress come to: see `docs/translate.md`.
    fn predicted(&self) -> f64 {
        let per_cell = self.parameters.number(PARTICLES) / PERIOD as f64;
        let basis = self.spec.scheme.basis();
        let of_basis = |k: f64| transform(basis, per_cell, k);
        let answers = (1..=WAVES).map(|k| {
            let waves = per_cell * f64::from(k);
            // The nodes see the wave of the lattice as one of this angle from node to node, which passes the body at so
            // many radians in the time that sound takes through a cell; half-way between two of them it is both.
            let passes = |whole: f64| {
                let [stiffness, kept] = symbol(TAU * (waves - whole), &of_basis);
                let driven = self.parameters.number(SPEED) * TAU * whole;
                let answer = 1.0 / (1.0 - driven * driven / (kept * stiffness)).abs();
                (2.0 * stiffness).sqrt().recip() * answer
            };
            let (below, above) = (waves.floor(), waves.ceil());
            let nearest = waves.round();
            force(waves, &of_basis)
                * if waves - below == 0.5 {
                    0.5 * (passes(below) + passes(above))
                } else {
                    passes(nearest)
                }
        });
        answers.map(|a| a * a).sum::<f64>().sqrt()
    }
}

impl Course<2> for Translation {
    fn discretisation(&self) -> Discretisation {
        let numbers = [PARTICLES, PPC_PER_DIRECTION].map(|p| self.parameters.number(p));
        Discretisation {
            dim: 2,
            h: self.spec.level.h,
            ppc: (numbers[0] * numbers[1] / PERIOD as f64).round() as u32,
            dt: self.dt,
            wall: "open-knot".to_owned(),
        }
    }

    fn steps(&self) -> [u64; 2] {
        [
            self.steps,
            (ROWS * self.parameters.number(CELLS)).ceil() as u64,
        ]
    }

    fn begin(&self) -> Result<Box<dyn Simulation<2>>, Fault> {
        let number = |p| self.parameters.number(p);
        let (h, stretch) = (self.spec.level.h, number(STRETCH));
        let grid = Grid::new(
            h,
            [Axis::periodic(0.0, PERIOD), Axis::periodic(0.0, ACROSS)],
        )?;
        let counts = [
            number(PARTICLES) as usize,
            ACROSS * number(PPC_PER_DIRECTION) as usize,
        ];
        let size = [
            PERIOD as f64 * h / counts[0] as f64,
            h / number(PPC_PER_DIRECTION),
        ];
        let place = |k: usize| {
            let at = [k % counts[0], k / counts[0]];
            std::array::from_fn(|a| (at[a] as f64 + 0.5) * size[a])
        };
        let places = (0..counts[0] * counts[1]).map(place).collect();
        let volume = size[0] * size[1] / (stretch * stretch);
        let half = size.map(|s| 0.5 * s);
        let mut particles = Particles::new(self.spec.start_at(places), volume, DENSITY, half)?
            .deformed(|x| (*x, Matrix2::identity() * stretch));
        particles.velocity.fill([self.speed(), 0.0]);
        let scene = Scene::new(grid, Body::new(self.law, particles)?);
        let settings = settings(&self.spec, &self.parameters, self.dt, 0.0)?;
        let settings = settings.transfer(Flip::new(number(FLIP))?);
        mpm_solvers::solver(self.spec.scheme, scene, settings)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "stress_noise (-)",
            "velocity_noise (-)",
            "momentum (kg/s)",
            "kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "stress_kept (-)",
        ]
    }

    fn observe(&self, run: &mut dyn Simulation<2>) -> Vec<f64> {
        let [mean, noise] = self.stresses(run);
        let totals = run.totals();
        let off = |v: &[f64; 2]| (v[0] / self.speed() - 1.0).hypot(v[1] / self.speed());
        vec![
            run.time(),
            noise,
            rms(run.particles().velocity.iter().map(off)),
            totals.momentum[0],
            totals.kinetic_energy,
            totals.stored_energy,
            mean,
        ]
    }

    fn particles(&self, run: &mut dyn Simulation<2>) -> Vec<Column> {
        let stress = run.force_stress();
        let p = run.particles();
        let mut columns = position_columns(p);
        columns.extend([
            column("vx", "m/s", p.seeded(|k| p.velocity[k][0])),
            column("stress_xx", "Pa", p.seeded(|k| stress[k].get(0, 0))),
        ]);
        columns
    }

    fn metrics(&self, rows: &[Vec<f64>], run: &mut dyn Simulation<2>) -> Vec<(Metric, f64)> {
        let of = |row: &[f64], k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        let start = &rows[0];
        let largest = |f: &dyn Fn(&[f64]) -> f64| rows.iter().map(|row| f(row)).fold(0.0, f64::max);
        let late = &rows[rows.len() / 2..];
        let mean = late.iter().map(|row| of(row, 1)).sum::<f64>() / late.len() as f64;
        let energy = |row: &[f64]| of(row, 4) + of(row, 5);
        let rise = |row: &[f64]| (energy(row) - energy(start)) / of(start, 4);
        let momentum = |row: &[f64]| (of(row, 3) / of(start, 3) - 1.0).abs();
        let mut values = vec![
            (m::STRESS_NOISE, largest(&|r| of(r, 1)).max(NOISE)),
            (m::STRESS_NOISE_MEAN, mean.max(NOISE)),
            (
                m::STRESS_KEPT,
                rows.last().map_or(f64::NAN, |row| of(row, 6)),
            ),
            (m::VELOCITY_NOISE, largest(&|r| of(r, 2)).max(NOISE)),
            (m::MOMENTUM_ERROR, largest(&momentum).max(ROUNDING)),
            (m::ENERGY_GAIN, largest(&rise)),
            (m::ENERGY_LOSS, largest(&|r| -rise(r))),
            (m::MASS, run.totals().mass),
        ];
        let scheme = self.spec.scheme;
        if scheme.remedy() == RemedyName::None && scheme.transfer() == TransferName::Flip {
            values.push((m::PREDICTED_NOISE, self.predicted()));
        }
        values
    }
}
