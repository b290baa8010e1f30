//! The membrane in equilibrium, load step by load step, by the quasi-static solver.

use super::geometry::seed;
use super::metrics as m;
use super::parameters::{DENSITY, LOAD, LOAD_STEPS, PPC_PER_DIRECTION};
use super::probes::Probes;
use super::scene::{equilibrium, forbid_explicit};
use super::watch::{displacement, of_shape, shape_columns};
use crate::cases::observe::discretisation;
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::Simulation;
use serde::{Deserialize, Serialize};

/// An error of less is rounding, which no golden should hold.
const ROUNDING: f64 = 1e-9;

/// What has been seen of the membrane.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
}

/// A membrane under a load that grows in steps.
pub(super) struct Pressed {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    references: Vec<[f64; 2]>,
    probes: Probes,
}

impl Pressed {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene, or are of the explicit solver.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        forbid_explicit(spec, parameters)?;
        let h = spec.level.h;
        let references = spec.start_at(seed(h / parameters.number(PPC_PER_DIRECTION)));
        let dt = 1.0 / parameters.number(LOAD_STEPS);
        let pressed = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: discretisation(2, spec, parameters, dt),
            probes: Probes::new(&references, 2.0 * h)?,
            references,
        };
        Ok(Drive::new(pressed, Seen::default())?)
    }
}

impl Watch<2> for Pressed {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        equilibrium(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (-)",
            "tip_uy (m)",
            "mid_edge_uy (m)",
            "stored_energy (J/m)",
            "stress_work (J/m)",
            "load_work (J/m)",
            "jacobian_min (-)",
            "jacobian_max (-)",
            "log_jacobian_gap_rms (-)",
            "newton_iterations (-)",
            "residual (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let before = stage.run.work().newton_iterations;
        stage.steps(1)?;
        seen.steps += 1;
        let run = stage.run.as_ref();
        let uy = displacement(run, 1);
        let totals = run.totals();
        let convergence = run.convergence().cloned().unwrap_or_default();
        Ok(vec![
            run.time(),
            self.probes.tip.value(&uy),
            self.probes.mid_edge.value(&uy),
            totals.stored_energy,
            totals.accumulated.stress_work,
            totals.accumulated.load_work,
            totals.jacobian.0,
            totals.jacobian.1,
            totals.log_jacobian_gap_rms,
            (run.work().newton_iterations - before) as f64,
            convergence.residuals.last().copied().unwrap_or(0.0),
            f64::from(convergence.parts),
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        seen.steps as f64 / self.parameters.number(LOAD_STEPS)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        shape_columns(stage.run.as_mut())
    }

    fn metrics(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_mut();
        let mut values = of_shape(run, &self.probes, &self.references, &self.parameters);
        let totals = run.totals();
        let reaction = -run.residual().held_force[1];
        values.extend([
            (m::LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (m::REACTION_UY, reaction),
            (m::REACTION_ERROR, (reaction / self.parameters.number(LOAD) + 1.0).abs().max(ROUNDING)),
            (m::MASS, totals.mass),
            (m::SEEDED_VOLUME, totals.mass / self.parameters.number(DENSITY)),
            (m::NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (m::LINEAR_ITERATIONS, run.work().linear_iterations as f64),
        ]);
        values
    }
}
