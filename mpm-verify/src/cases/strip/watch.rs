//! What is seen of the strip, step by step.

use super::metrics as m;
use super::oedometer::settlement as settlement_of_clay;
use super::parameters::{ALPHA, GAMMA, HALF_WIDTH, LOAD, PENETRATION, STEPS};
use super::reference::solution;
use super::scene::{
    BASE, PER_CELL, SIDE, STRIP, begin, duration, is_driven, is_plastic, load, moduli, surcharge,
};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::{Column, Snapshot};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::{Error as Broken, Field, Part, Simulation};
use serde::{Deserialize, Serialize};

/// Least value of what is rounding.
const ROUNDING: f64 = 1e-9;
/// What is nearer to the strip's edge than this share of its half width is not smooth.
const NEAR: f64 = 0.5;
/// After so many quarters of the steps particles are kept.
const QUARTERS: u64 = 4;

/// What has been seen of the strip.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
    /// Whether a step had no solution.
    stopped: bool,
    turnover: f64,
    most: u64,
    /// Settlement (m) and load (Pa) after every step.
    path: Vec<[f64; 2]>,
}

impl Seen {
    /// Load (Pa) at a settlement (m), by a straight line between steps; NaN where it was not reached.
    fn load_at(&self, settlement: f64) -> f64 {
        let begun = [[0.0; 2]];
        let before = begun.iter().chain(&self.path);
        let mut parts = before.zip(&self.path);
        let part = parts.find(|(_, after)| after[0] >= settlement);
        part.map_or(f64::NAN, |([s, q], [t, r])| {
            q + (r - q) * (settlement - s) / (t - s)
        })
    }

    /// Growth of the load in the last quarter of all steps, over itself.
    fn growth(&self) -> f64 {
        let of = |k: usize| self.path.get(k).map_or(f64::NAN, |at| at[1]);
        let all = self.path.len();
        1.0 - of((3 * all / 4).saturating_sub(1)) / of(all.saturating_sub(1))
    }
}

/// A strip that settles.
pub(super) struct Strip {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
}

impl Strip {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let strip = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: Discretisation {
                dim: 2,
                h: spec.level.h,
                ppc: (PER_CELL * PER_CELL) as u32,
                dt: duration(parameters),
                wall: "open-knot".to_owned(),
            },
        };
        Ok(Drive::new(strip, Seen::default())?)
    }

    fn half_width(&self) -> f64 {
        self.parameters.number(HALF_WIDTH)
    }

    fn spacing(&self) -> f64 {
        self.spec.level.h / PER_CELL as f64
    }

    /// Column and row of a particle at the start.
    fn place(&self, reference: &[f64; 2]) -> [usize; 2] {
        reference.map(|x| (x / self.spacing()).floor() as usize)
    }

    /// Of the particle next to the axis at the surface, over the half width.
    fn settlement(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let top = (SIDE / self.spacing()).round() as usize - 1;
        let next = p.reference.iter().position(|x| self.place(x) == [0, top]);
        next.map_or(f64::NAN, |k| {
            (p.reference[k][1] - p.position[k][1]) / self.half_width()
        })
    }

    /// Load on the strip (Pa) beside what rests on the whole surface.
    fn load(&self, run: &dyn Simulation<2>) -> f64 {
        if is_driven(&self.parameters) {
            run.on(Part::Constraint(STRIP)).force[1] / self.half_width()
        } else {
            load(&self.parameters, run.time())
        }
    }

    /// Pressure of the particles over the load by their rows and columns at the start; NaN where there is none.
    fn pressures(&self, stage: &mut Stage<2>, over: f64) -> Vec<Vec<f64>> {
        let field = stage.run.field(Field::PorePressure);
        let row = (SIDE / self.spacing()).round() as usize;
        let mut all = vec![vec![f64::NAN; row]; row];
        for (p, x) in field.iter().zip(&stage.run.particles().reference) {
            let [i, j] = self.place(x);
            if let Some(value) = all.get_mut(j).and_then(|of| of.get_mut(i)) {
                *value = p / over;
            }
        }
        all
    }

    /// Whether the particle in this column and row was not near the strip's edge.
    fn is_far(&self, i: usize, j: usize) -> bool {
        let [x, y] = [i, j].map(|k| (k as f64 + 0.5) * self.spacing());
        (x - self.half_width()).hypot(y - SIDE) > NEAR * self.half_width()
    }

    /// Of clay under a load on its whole surface the settlement's relative error.
    fn uniform_error(&self, run: &dyn Simulation<2>) -> f64 {
        let own = |p| self.parameters.number(p) == 1.0;
        let whole = self.half_width() == SIDE;
        if !(whole && is_plastic(&self.parameters) && own(ALPHA) && own(GAMMA)) {
            return f64::NAN;
        }
        let p = run.particles();
        let volume = |of: &[f64]| of.iter().sum::<f64>();
        let settled = 1.0 - volume(&p.volume) / volume(&p.reference_volume);
        (settled / settlement_of_clay(&self.parameters) - 1.0).abs()
    }

    fn roughness(&self, all: &[Vec<f64>]) -> f64 {
        let inner = 1..all.len() - 1;
        let places = inner
            .clone()
            .flat_map(|j| inner.clone().map(move |i| (i, j)));
        rms(places.filter(|(i, j)| self.is_far(*i, *j)).map(|(i, j)| {
            let beside = all[j][i - 1] + all[j][i + 1] + all[j - 1][i] + all[j + 1][i];
            all[j][i] - 0.25 * beside
        }))
    }
}

/// Whether a step has no solution: of clay, that its limit is reached.
fn is_limit(error: &Broken) -> bool {
    matches!(
        error,
        Broken::NoConvergence { .. } | Broken::Singular { .. }
    )
}

impl Watch<2> for Strip {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, Broken> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "load (Pa)",
            "settlement (-)",
            "outflow (m²)",
            "newton_iterations (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, Broken> {
        let iterations = stage.run.work().newton_iterations;
        let before = volumes(stage.run.as_ref());
        match stage.steps(1) {
            // What the last parts came to is a state like others.
            Err(error) if is_plastic(&self.parameters) && is_limit(&error) => seen.stopped = true,
            other => other?,
        }
        seen.steps += 1;
        let run = stage.run.as_ref();
        let changes = before.iter().zip(volumes(run));
        seen.turnover += changes
            .map(|(before, after)| (after - before).abs())
            .sum::<f64>();
        let taken = run.work().newton_iterations - iterations;
        if !seen.stopped {
            seen.most = seen.most.max(taken);
        }
        let [settlement, load] = [self.settlement(run), self.load(run)];
        seen.path.push([settlement * self.half_width(), load]);
        Ok(vec![
            run.time(),
            load,
            settlement,
            run.water().map_or(f64::NAN, |w| w.outflow),
            taken as f64,
            run.convergence().map_or(f64::NAN, |c| c.parts.into()),
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        if seen.stopped {
            return 1.0;
        }
        seen.steps as f64 / self.parameters.number(STEPS)
    }

    fn snapshot(&self, seen: &Seen, stage: &mut Stage<2>) -> Option<Snapshot> {
        let all = self.parameters.number(STEPS) as u64;
        let quarter = all.is_multiple_of(QUARTERS) && seen.steps.is_multiple_of(all / QUARTERS);
        (quarter && seen.steps < all).then(|| Snapshot {
            time: stage.run.time(),
            columns: self.particles(seen, stage),
        })
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let pressure = stage.run.field(Field::PorePressure);
        let porosity = stage.run.field(Field::Porosity);
        let strain = stage.run.field(Field::PlasticStrain);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend(reference_columns(p));
        columns.extend([
            column("pore_pressure", "Pa", p.seeded(|k| pressure[k])),
            column("porosity", "-", p.seeded(|k| porosity[k])),
            column("effective_stress_xx", "Pa", p.seeded(|k| p.stress[k].xx)),
            column("effective_stress_yy", "Pa", p.seeded(|k| p.stress[k].yy)),
            column("effective_stress_xy", "Pa", p.seeded(|k| p.stress[k].xy)),
            column("plastic_strain", "-", p.seeded(|k| strain[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let last = self.load(stage.run.as_ref());
        let pressures = self.pressures(stage, last);
        let strain = stage.run.field(Field::PlasticStrain);
        let limit = match is_driven(&self.parameters) {
            true => last,
            false => seen.load_at(self.parameters.number(PENETRATION)),
        };
        let run = stage.run.as_ref();
        let settlement = self.settlement(run);
        let work = run.work();
        let swept = settlement * self.half_width().powi(2);
        let lost = run
            .water()
            .map_or(f64::NAN, |w| (w.imbalance / swept).abs());
        let all = last * self.half_width() + surcharge(&self.parameters) * SIDE;
        let held = -run.on(Part::Constraint(BASE)).force[1];
        // What is no number stays none.
        let above = |value: f64| if value < ROUNDING { ROUNDING } else { value };
        let least = |of: &[Vec<f64>]| of.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let most = |of: &[Vec<f64>]| {
            of.iter()
                .flatten()
                .copied()
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let known = solution(self.spec.level.h, &self.parameters);
        let ratio = known.map_or(f64::NAN, |s| {
            let [_, shear] = moduli(&self.parameters);
            settlement * self.half_width() * shear / (self.parameters.number(LOAD) * s.settlement)
        });
        let apart = |far: bool| {
            let rows = pressures.iter().enumerate();
            rows.flat_map(move |(j, row)| {
                let places = row.iter().enumerate().map(move |(i, p)| (i, j, *p));
                places.filter(move |(i, j, _)| !far || self.is_far(*i, *j))
            })
            .map(move |(i, j, p)| known.map_or(f64::NAN, |s| p - s.pressure(i, j)))
        };
        vec![
            (m::SETTLEMENT, settlement),
            (m::SETTLEMENT_RATIO, ratio),
            (m::PRESSURE_ERROR, rms(apart(false))),
            (
                m::PRESSURE_ERROR_LARGEST,
                known.map_or(f64::NAN, |_| apart(true).fold(0.0, |a, b| b.abs().max(a))),
            ),
            (m::ROUGHNESS, self.roughness(&pressures)),
            (m::LEAST_PRESSURE, least(&pressures)),
            (m::MOST_PRESSURE, most(&pressures)),
            (m::LAST_LOAD, last),
            (m::LIMIT_LOAD, limit),
            (
                m::GROWTH,
                if is_driven(&self.parameters) {
                    seen.growth()
                } else {
                    f64::NAN
                },
            ),
            (m::UNIFORM_ERROR, self.uniform_error(run)),
            (m::PLASTIC_STRAIN, strain.into_iter().fold(0.0, f64::max)),
            (m::SUPPORT_ERROR, above((held / all - 1.0).abs())),
            (m::MASS_ERROR, above(lost)),
            (m::TURNOVER, seen.turnover / swept),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (m::MOST_ITERATIONS, seen.most as f64),
            (
                m::ENTRIES,
                work.nonzeros as f64 / work.factorisations.max(1) as f64,
            ),
        ]
    }
}

/// Volumes of the particles (m²) by their identity.
fn volumes(run: &dyn Simulation<2>) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.volume[k])
}
