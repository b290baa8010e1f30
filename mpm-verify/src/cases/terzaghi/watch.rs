//! What is seen of the column, step by step.

use super::metrics as m;
use super::parameters::{LOAD, STEPS};
use super::scene::{HEIGHT, PER_CELL, SMALL, begin, durations, moduli, steps, time_scale};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::cases::parameters::{least_strain, require_quotient};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::exact::terzaghi;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::{Field, Simulation};
use serde::{Deserialize, Serialize};

/// Least value of what is rounding.
const ROUNDING: f64 = 1e-9;

/// What has been seen of the column.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
    overshoot_first_step: f64,
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
        let strain = parameters.number(LOAD) / moduli(parameters)[0];
        let (least, why) = (
            least_strain(parameters.number(STEPS)),
            "below which rounding hides the answer and above which the strain is not small",
        );
        require_quotient("load / M of young_modulus", strain, least..=SMALL, why)?;
        let h = spec.level.h;
        let consolidation = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: Discretisation {
                dim: 1,
                h,
                ppc: PER_CELL as u32,
                dt: steps(h, parameters).0 * time_scale(parameters),
                wall: "open-knot".to_owned(),
            },
        };
        Ok(Drive::new(consolidation, Seen::default())?)
    }

    fn load(&self) -> f64 {
        self.parameters.number(LOAD)
    }

    /// Largest nodal pressure over the load, less one; zero of what is rounding.
    fn overshoot(&self, run: &dyn Simulation<1>) -> f64 {
        let nodes = run.pressure_nodes();
        let most = nodes.iter().fold(0.0, |most: f64, (_, p)| most.max(*p));
        let over = most / self.load() - 1.0;
        if over > ROUNDING { over } else { 0.0 }
    }

    /// Settlement over the final one.
    fn settlement(&self, run: &dyn Simulation<1>) -> f64 {
        let p = run.particles();
        let volume = |of: &[f64]| of.iter().sum::<f64>();
        let [modulus, _] = moduli(&self.parameters);
        (volume(&p.reference_volume) - volume(&p.volume)) * modulus / (self.load() * HEIGHT)
    }

    /// Pressure at the lowest node over the load.
    fn base_pressure(&self, run: &dyn Simulation<1>) -> f64 {
        let nodes = run.pressure_nodes();
        let lowest = nodes.iter().min_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        lowest.map_or(f64::NAN, |(_, p)| p / self.load())
    }

    /// Rms over the particles of p/q less what `exact` says of their depth over H.
    fn error(&self, stage: &mut Stage<1>, exact: impl Fn(f64) -> f64) -> f64 {
        let pressure = stage.run.field(Field::PorePressure);
        let reference = &stage.run.particles().reference;
        let pairs = pressure.iter().zip(reference);
        rms(pairs.map(|(p, x)| p / self.load() - exact(1.0 - x[0] / HEIGHT)))
    }
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
            "settlement_exact (-)",
            "base_pressure (-)",
            "base_pressure_exact (-)",
            "overshoot (-)",
            "outflow (m)",
            "newton_iterations (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<1>) -> Result<Vec<f64>, mpm_core::Error> {
        let before = stage.run.work().newton_iterations;
        stage.steps(1)?;
        let run = stage.run.as_ref();
        seen.steps += 1;
        if seen.steps == 1 {
            seen.overshoot_first_step = self.overshoot(run);
        }
        let t = run.time() / time_scale(&self.parameters);
        Ok(vec![
            run.time(),
            t,
            self.settlement(run),
            terzaghi::settlement(t),
            self.base_pressure(run),
            terzaghi::pressure(1.0, t),
            self.overshoot(run),
            run.water().map_or(f64::NAN, |w| w.outflow),
            (run.work().newton_iterations - before) as f64,
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<1>) -> f64 {
        seen.steps as f64 / self.parameters.number(STEPS)
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
        let steps = durations(self.spec.level.h, &self.parameters);
        let t = stage.run.time() / time_scale(&self.parameters);
        let of_steps = self.error(stage, |z| terzaghi::pressure_of_steps(z, &steps));
        let whole = self.error(stage, |z| terzaghi::pressure(z, t));
        let run = stage.run.as_ref();
        let work = run.work();
        let lost = run
            .water()
            .map_or(f64::NAN, |w| (w.imbalance / w.outflow).abs());
        let entries = work.nonzeros as f64 / work.factorisations.max(1) as f64;
        vec![
            (m::PRESSURE_L2, whole),
            (m::PRESSURE_L2_STEPS, of_steps),
            (m::OVERSHOOT_FIRST_STEP, seen.overshoot_first_step),
            (
                m::SETTLEMENT_ERROR,
                (self.settlement(run) - terzaghi::settlement(t)).abs(),
            ),
            // What is no number stays none.
            (m::MASS_ERROR, if lost < ROUNDING { ROUNDING } else { lost }),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (m::ENTRIES, entries),
        ]
    }
}
