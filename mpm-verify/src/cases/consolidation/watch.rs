//! What is seen of the column, step by step.

use super::errors::{of_base_pressure, of_settlement};
use super::metrics as m;
use super::reference::At;
use super::scene::{HEIGHT, PER_CELL, TIME_SCALE, begin, count, load, steps};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::{Field, Simulation};
use serde::{Deserialize, Serialize};

/// Least value of what is rounding.
pub(super) const ROUNDING: f64 = 1e-9;

/// What has been seen of the column.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// After every step T, settlement over H and base pressure over the load.
    rows: Vec<[f64; 3]>,
    /// ½ Σ V (J̃ − 1)² so far (m), and the largest |J̃ − 1|.
    rate_loss: f64,
    volume_step: f64,
}

impl Seen {
    fn at(&self) -> Vec<At> {
        let of = |&[t, settlement, base]: &[f64; 3]| At {
            t,
            settlement,
            base,
        };
        self.rows.iter().map(of).collect()
    }
}

/// A column that consolidates.
pub(super) struct Consolidation {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
}

impl Consolidation {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<1, Self>, Error> {
        let consolidation = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: Discretisation {
                dim: 1,
                h: spec.level.h,
                ppc: PER_CELL as u32,
                dt: steps(parameters).0 * TIME_SCALE,
                wall: "open-knot".to_owned(),
            },
        };
        Ok(Drive::new(consolidation, Seen::default())?)
    }

    /// Pressure at the lowest node, on the floor, over the load.
    fn base_pressure(&self, run: &dyn Simulation<1>) -> f64 {
        let nodes = run.pressure_nodes();
        let lowest = nodes.iter().min_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        lowest.map_or(f64::NAN, |(_, p)| p / load(&self.parameters))
    }
}

/// Settlement over H.
fn settlement(run: &dyn Simulation<1>) -> f64 {
    let p = run.particles();
    let volume = |of: &[f64]| of.iter().sum::<f64>();
    (volume(&p.reference_volume) - volume(&p.volume)) / HEIGHT
}

impl Watch<1> for Consolidation {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<1>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "time_factor (-)",
            "settlement (-)",
            "base_pressure (-)",
            "outflow (m)",
            "imbalance (m)",
            "newton_iterations (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<1>) -> Result<Vec<f64>, mpm_core::Error> {
        let iterations = stage.run.work().newton_iterations;
        let volumes = |run: &dyn Simulation<1>| {
            let p = run.particles();
            p.seeded(|k| p.volume[k])
        };
        let before = volumes(stage.run.as_ref());
        stage.steps(1)?;
        let run = stage.run.as_ref();
        for (before, after) in before.iter().zip(volumes(run)) {
            let change = after / before - 1.0;
            seen.rate_loss += 0.5 * before * change * change;
            seen.volume_step = seen.volume_step.max(change.abs());
        }
        let t = run.time() / TIME_SCALE;
        let row = [t, settlement(run), self.base_pressure(run)];
        seen.rows.push(row);
        let water = run.water();
        Ok(vec![
            run.time(),
            t,
            row[1],
            row[2],
            water.map_or(f64::NAN, |w| w.outflow),
            water.map_or(f64::NAN, |w| w.imbalance),
            (run.work().newton_iterations - iterations) as f64,
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<1>) -> f64 {
        seen.rows.len() as f64 / count(&self.parameters)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<1>) -> Vec<Column> {
        let pressure = stage.run.field(Field::PorePressure);
        let porosity = stage.run.field(Field::Porosity);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend(reference_columns(p));
        columns.extend([
            column("pore_pressure", "Pa", p.seeded(|k| pressure[k])),
            column("porosity", "-", p.seeded(|k| porosity[k])),
            column("effective_stress_xx", "Pa", p.seeded(|k| p.stress[k].xx)),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<1>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let work = run.work();
        let water = run.water();
        let over_outflow = |of: f64| water.map_or(f64::NAN, |w| (of / w.outflow).abs());
        let lost = over_outflow(water.map_or(f64::NAN, |w| w.imbalance));
        let entries = work.nonzeros as f64 / work.factorisations.max(1) as f64;
        let at = seen.at();
        let mut values = of_settlement(&at, &self.parameters);
        values.extend(of_base_pressure(&at, &self.parameters));
        values.extend([
            // What is no number stays none.
            (m::MASS_ERROR, if lost < ROUNDING { ROUNDING } else { lost }),
            (m::RATE_LOSS, over_outflow(seen.rate_loss)),
            (m::VOLUME_STEP, seen.volume_step),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (m::ENTRIES, entries),
        ]);
        values
    }
}
