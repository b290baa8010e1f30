//! A free beam that swings in its first mode, half of it by symmetry, and what is seen of it.

use super::metrics as m;
use super::parameters::{ALL, CFL, POISSON_RATIO, PPC_PER_DIRECTION, SHIFT};
use super::theory::{Beam, DEPTH, HALF, Mode, stiffness};
use crate::cases::course::{Course, Watched};
use crate::cases::observe::{
    check_rule, column, implicit_settings, position_columns, reference_columns,
};
use crate::drive::Drive;
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::RunSpec;
use crate::statistics::fit_line;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::stage::{End, Wall, WallKind};
use mpm_core::{Axis, Body, Error as Fault, Grid, Particles, Scene, Side, Simulation};
use std::f64::consts::TAU;

/// Young's modulus (Pa) and density (kg/m³).
const YOUNG_MODULUS: f64 = 1e6;
const DENSITY: f64 = 1000.0;
/// Deflection of the middle (m): so small that nothing but the linear beam is seen.
const DEFLECTION: f64 = 1e-5;
/// Periods of a run, and rows in one of them.
const PERIODS: f64 = 5.0;
const ROWS: f64 = 40.0;
/// Cells of room beside the beam.
const ROOM: usize = 3;

/// A beam that swings.
pub(super) struct Swing {
    spec: RunSpec,
    parameters: Parameters,
    law: NeoHookean,
    /// The exact mode; the bending stiffness over the exact one, and the frequency with it, where known.
    mode: Mode,
    stiffness: Option<f64>,
    predicted: Option<f64>,
    dt: f64,
    steps: u64,
}

impl Swing {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Drive<2, Watched<Self>>, Error> {
        let number = |p| parameters.number(p);
        check_rule(spec, parameters, &ALL)?;
        let (ratio, cfl) = (number(POISSON_RATIO), number(CFL));
        if matches!(spec.scheme, Scheme::Explicit(_)) && cfl >= 1.0 {
            return Err(Error::Input(format!(
                "cfl = {cfl} is out of range for the solver explicit; allowed: below 1"
            )));
        }
        let law = NeoHookean::new(YOUNG_MODULUS, ratio)?;
        let first = |factor| Beam::new(YOUNG_MODULUS, ratio, DENSITY, factor).first();
        let stiffness = stiffness(
            spec.scheme.basis(),
            ratio,
            DEPTH / spec.level.h,
            number(PPC_PER_DIRECTION),
            number(SHIFT) > 0.0,
        );
        let mode = first(1.0);
        let predicted = stiffness.map(|factor| first(factor).frequency);
        // Of GIMP and an average it is a bound.
        let bounds =
            spec.scheme.basis() == BasisName::Gimp || spec.scheme.remedy() != RemedyName::None;
        let foretold = predicted.filter(|_| !bounds);
        let period = TAU / foretold.unwrap_or(mode.frequency);
        let longest = courant_time_step(cfl, spec.level.h, law.wave_speed(DENSITY));
        let steps = (PERIODS * period / longest).ceil();
        let swing = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            law,
            mode,
            stiffness,
            predicted,
            dt: PERIODS * period / steps,
            steps: steps as u64,
        };
        Ok(Drive::new(Watched(swing), Default::default())?)
    }

    fn per_direction(&self) -> usize {
        self.parameters.number(PPC_PER_DIRECTION) as usize
    }

    /// The deflection as a share of the mode.
    fn share(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let (mut along, mut squares) = (0.0, 0.0);
        for k in 0..p.len() {
            let shape = self.mode.deflection(p.reference[k][0]);
            along += shape * (p.position[k][1] - p.reference[k][1]);
            squares += shape * shape;
        }
        along / squares / DEFLECTION
    }
}

impl Course<2> for Swing {
    fn discretisation(&self) -> Discretisation {
        Discretisation {
            dim: 2,
            h: self.spec.level.h,
            ppc: self.per_direction().pow(2) as u32,
            dt: self.dt,
            wall: "open-knot".to_owned(),
        }
    }

    fn steps(&self) -> [u64; 2] {
        [self.steps, (PERIODS * ROWS) as u64]
    }

    fn begin(&self) -> Result<Box<dyn Simulation<2>>, Fault> {
        let h = self.spec.level.h;
        let cells = |length: f64| (length / h).round() as usize;
        let grid = Grid::new(
            h,
            [
                Axis::bounded(0.0, cells(HALF) + ROOM, (Side::Wall, Side::Open)),
                Axis::open(-h * ROOM as f64, cells(DEPTH) + 2 * ROOM),
            ],
        )?;
        let spacing = h / self.per_direction() as f64;
        let [along, across] = [HALF, DEPTH].map(|l| (l / spacing).round() as usize);
        let foot = h * self.parameters.number(SHIFT);
        let place = |k: usize| {
            let at = [k % along, k / along].map(|i| (i as f64 + 0.5) * spacing);
            [at[0], foot + at[1]]
        };
        let places = (0..along * across).map(place).collect();
        let mut particles = Particles::new(
            self.spec.start_at(places),
            spacing * spacing,
            DENSITY,
            [0.5 * spacing; 2],
        )?;
        let speed = DEFLECTION * self.mode.frequency;
        for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
            let above = x[1] - foot - 0.5 * DEPTH;
            *v = [
                -speed * above * self.mode.turn(x[0]),
                speed * self.mode.deflection(x[0]),
            ];
        }
        let scene = Scene::new(grid, Body::new(self.law, particles)?).constrain(Wall {
            axis: 0,
            end: End::Lo,
            kind: WallKind::Roller,
        });
        if let Some(settings) = implicit_settings(&self.spec, &self.parameters, self.dt) {
            return mpm_solvers::implicit(self.spec.scheme, scene, settings);
        }
        let settings = Settings::new(self.dt).remedy(self.spec.scheme.remedy().build());
        mpm_solvers::solver(self.spec.scheme, scene, settings)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "deflection (-)",
            "kinetic_energy (J/m)",
            "stored_energy (J/m)",
        ]
    }

    fn observe(&self, run: &mut dyn Simulation<2>) -> Vec<f64> {
        let totals = run.totals();
        vec![
            run.time(),
            self.share(run),
            totals.kinetic_energy,
            totals.stored_energy,
        ]
    }

    fn particles(&self, run: &mut dyn Simulation<2>) -> Vec<Column> {
        let stress = run.force_stress();
        let p = run.particles();
        let mut columns = [position_columns(p), reference_columns(p)].concat();
        columns.push(column("stress_xx", "Pa", p.seeded(|k| stress[k].get(0, 0))));
        columns
    }

    fn metrics(&self, rows: &[Vec<f64>], _: &mut dyn Simulation<2>) -> Vec<(Metric, f64)> {
        // The first row is that of the start, where the deflection is zero.
        let zeros = rows[1..].windows(2).filter_map(|pair| {
            let [t, u, after, then] = [pair[0][0], pair[0][1], pair[1][0], pair[1][1]];
            (u * then < 0.0).then(|| t + (after - t) * u / (u - then))
        });
        let zeros: Vec<(f64, f64)> = zeros.enumerate().map(|(k, t)| (k as f64, t)).collect();
        let half_period = fit_line(&zeros).map_or(f64::NAN, |line| line.slope);
        let ratio = 0.5 * TAU / half_period / self.mode.frequency;
        let period = ROWS as usize;
        let largest = |rows: &[Vec<f64>]| rows.iter().map(|row| row[1].abs()).fold(0.0, f64::max);
        let kept = largest(&rows[rows.len() - period..]) / largest(&rows[..period]);
        let mut values = vec![
            (m::FREQUENCY_RATIO, ratio),
            (m::FREQUENCY_ERROR, (ratio - 1.0).abs()),
            (m::AMPLITUDE_RATIO, kept),
        ];
        let predicted = self.predicted.map(|f| f / self.mode.frequency);
        values.extend(predicted.map(|f| (m::PREDICTED_RATIO, f)));
        values.extend(self.stiffness.map(|s| (m::STIFFNESS_RATIO, s)));
        values
    }
}
