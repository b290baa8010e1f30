//! A motion so slow that it is always in equilibrium, load step by load step, beside its exact solution.

use super::metrics as m;
use super::scene::equilibrium;
use super::{DURATION, LOAD_STEPS, Manufactured, PPC_PER_DIRECTION, errors};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::exact::Exact;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::Simulation;
use mpm_core::material::NeoHookean;
use mpm_solvers::Solved;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What has been seen of it.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
}

/// A slow motion.
pub(super) struct Slow<const D: usize> {
    case: Manufactured,
    spec: RunSpec,
    parameters: Parameters,
    solution: Arc<dyn Exact>,
    discretisation: Discretisation,
}

impl<const D: usize> Slow<D>
where
    NeoHookean: Solved<D>,
{
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        case: Manufactured,
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Drive<D, Self>, Error> {
        let slow = Self {
            case,
            spec: spec.clone(),
            parameters: parameters.clone(),
            solution: (case.solution)(parameters)?.into(),
            discretisation: Discretisation {
                dim: D,
                h: spec.level.h,
                ppc: parameters.number(PPC_PER_DIRECTION).powi(D as i32) as u32,
                dt: parameters.number(DURATION) / parameters.number(LOAD_STEPS),
                wall: "open-knot".to_owned(),
            },
        };
        Ok(Drive::new(slow, Seen::default())?)
    }

    /// Errors of displacement (m), stress and mean stress (Pa) of every particle, in the particles' order.
    fn errors(&self, run: &mut dyn Simulation<D>) -> [Vec<f64>; 3] {
        let solution = self.solution.as_ref();
        let stress = errors::of_stress(solution, run);
        let p = run.particles();
        let displacement = |k| errors::of_displacement(solution, p, k, run.time()).norm();
        [
            (0..p.len()).map(displacement).collect(),
            stress.iter().map(|s| s.norm()).collect(),
            stress.iter().map(|s| (s.trace() / 3.0).abs()).collect(),
        ]
    }

    /// Rms over the particles of the exact displacement (m).
    fn scale(&self, run: &dyn Simulation<D>) -> f64 {
        let references = run.particles().reference.iter().map(super::scene::vector);
        rms(references.map(|x| self.solution.displacement(&x, run.time()).norm()))
    }
}

impl<const D: usize> Watch<D> for Slow<D>
where
    NeoHookean: Solved<D>,
{
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        let dt = self.discretisation.dt;
        equilibrium(self.case, &self.spec, &self.parameters, &self.solution, dt)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "displacement_l2 (m)",
            "stored_energy (J)",
            "stress_work (J)",
            "load_work (J)",
            "jacobian_min (-)",
            "jacobian_max (-)",
            "log_jacobian_gap_rms (-)",
            "newton_iterations (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, mpm_core::Error> {
        let before = stage.run.work().newton_iterations;
        stage.steps(1)?;
        seen.steps += 1;
        let [displacement, ..] = self.errors(stage.run.as_mut());
        let (totals, work) = (stage.run.totals(), stage.run.work());
        let parts = stage.run.convergence().map_or(0, |c| c.parts);
        Ok(vec![
            stage.run.time(),
            rms(displacement.into_iter()),
            totals.stored_energy,
            totals.accumulated.stress_work,
            totals.accumulated.load_work,
            totals.jacobian.0,
            totals.jacobian.1,
            totals.log_jacobian_gap_rms,
            (work.newton_iterations - before) as f64,
            f64::from(parts),
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<D>) -> f64 {
        seen.steps as f64 / self.parameters.number(LOAD_STEPS)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<Column> {
        let run = stage.run.as_mut();
        let [displacement, stress, mean_stress] = {
            let errors = self.errors(run);
            let p = run.particles();
            errors.map(|values| p.seeded(|k| values[k]))
        };
        let force_stress = run.force_stress();
        let p = run.particles();
        let mut columns = [position_columns(p), reference_columns(p)].concat();
        columns.extend([
            column("displacement_error", "m", displacement),
            column("stress_error", "Pa", stress),
            column("mean_stress", "Pa", p.seeded(|k| force_stress[k].mean())),
            column("mean_stress_error", "Pa", mean_stress),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_mut();
        let errors = self.errors(run);
        let (totals, work) = (run.totals(), run.work());
        let mut values = vec![
            (m::DISPLACEMENT_SCALE, self.scale(run)),
            (m::LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (m::MASS, totals.mass),
            (m::BODY_MASS, errors::mass::<D>(self.solution.as_ref())),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (m::LINEAR_ITERATIONS, work.linear_iterations as f64),
        ];
        let names = [
            [m::DISPLACEMENT_L2, m::DISPLACEMENT_LINF],
            [m::STRESS_L2, m::STRESS_LINF],
            [m::MEAN_STRESS_L2, m::MEAN_STRESS_LINF],
        ];
        for ([l2, linf], errors) in names.into_iter().zip(&errors) {
            values.push((l2, rms(errors.iter().copied())));
            values.push((linf, errors.iter().copied().fold(0.0, f64::max)));
        }
        values
    }
}
