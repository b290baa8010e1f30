//! What is seen of the motion, step by step, beside the exact one.

use super::metrics as m;
use super::parameters::{PPC_PER_DIRECTION, STEPS};
use super::scene::{begin, duration_of_step, place, solution};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::exact::poro::{Moment, SolidAndWater};
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::material::ImprovedHencky;
use mpm_core::{Field, Simulation};
use mpm_solvers::Soaked;
use serde::{Deserialize, Serialize};

/// What has been seen of it.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
}

/// A motion of solid and water.
pub(super) struct Motion<const D: usize> {
    spec: RunSpec,
    parameters: Parameters,
    solution: SolidAndWater,
    discretisation: Discretisation,
}

/// Errors of every particle, in the particles' order, and the exact values.
struct Errors {
    displacement: Vec<f64>,
    pressure: Vec<f64>,
    stress: Vec<f64>,
    exact: Vec<Moment>,
}

impl Errors {
    /// Rms of the exact p (Pa).
    fn pressure_scale(&self) -> f64 {
        rms(self.exact.iter().map(|e| e.pressure))
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

impl<const D: usize> Motion<D>
where
    ImprovedHencky: Soaked<D>,
{
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<D, Self>, Error> {
        let motion = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            solution: solution(parameters)?,
            discretisation: Discretisation {
                dim: D,
                h: spec.level.h,
                ppc: parameters.number(PPC_PER_DIRECTION).powi(D as i32) as u32,
                dt: duration_of_step(parameters),
                wall: "open-knot".to_owned(),
            },
        };
        Ok(Drive::new(motion, Seen::default())?)
    }

    fn errors(&self, run: &mut dyn Simulation<D>) -> Errors {
        let (t, pressure, stress) = (
            run.time(),
            run.field(Field::PorePressure),
            run.force_stress(),
        );
        let p = run.particles();
        let exact: Vec<Moment> = (p.reference.iter())
            .map(|x| self.solution.at(place(x), t))
            .collect();
        let off = |k: usize| {
            let (x, y, u) = (&p.reference[k], &p.position[k], &exact[k].displacement);
            let parts = (0..D).map(|a| (y[a] - x[a] - u[a]).powi(2));
            parts.sum::<f64>().sqrt()
        };
        Errors {
            displacement: (0..p.len()).map(off).collect(),
            pressure: (pressure.iter().zip(&exact))
                .map(|(p, e)| p - e.pressure)
                .collect(),
            stress: (stress.iter().zip(&exact))
                .map(|(s, e)| (s.to_matrix() - e.stress).norm())
                .collect(),
            exact,
        }
    }
}

impl<const D: usize> Watch<D> for Motion<D>
where
    ImprovedHencky: Soaked<D>,
{
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "displacement_l2 (m)",
            "pressure_l2 (-)",
            "jacobian_min (-)",
            "jacobian_max (-)",
            "inflow (m)",
            "outflow (m)",
            "water_made (m)",
            "newton_iterations (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, mpm_core::Error> {
        let before = stage.run.work().newton_iterations;
        stage.steps(1)?;
        seen.steps += 1;
        let errors = self.errors(stage.run.as_mut());
        let run = stage.run.as_ref();
        let jacobian = run.totals().jacobian;
        let water = run.water().copied().unwrap_or_default();
        Ok(vec![
            run.time(),
            rms(errors.displacement.iter().copied()),
            rms(errors.pressure.iter().copied()) / errors.pressure_scale(),
            jacobian.0,
            jacobian.1,
            water.inflow,
            water.outflow,
            water.imbalance,
            (run.work().newton_iterations - before) as f64,
            run.convergence().map_or(0.0, |c| f64::from(c.parts)),
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<D>) -> f64 {
        seen.steps as f64 / self.parameters.number(STEPS)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<Column> {
        let run = stage.run.as_mut();
        let errors = self.errors(run);
        let (pressure, porosity) = (run.field(Field::PorePressure), run.field(Field::Porosity));
        let p = run.particles();
        let mut columns = [position_columns(p), reference_columns(p)].concat();
        columns.extend([
            column(
                "displacement_error",
                "m",
                p.seeded(|k| errors.displacement[k]),
            ),
            column("pore_pressure", "Pa", p.seeded(|k| pressure[k])),
            column(
                "pore_pressure_error",
                "Pa",
                p.seeded(|k| errors.pressure[k]),
            ),
            column("stress_error", "Pa", p.seeded(|k| errors.stress[k])),
            column("porosity", "-", p.seeded(|k| porosity[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<(Metric, f64)> {
        let errors = self.errors(stage.run.as_mut());
        let scale = errors.pressure_scale();
        let moved = |e: &Moment| e.displacement.iter().map(|u| u * u).sum::<f64>().sqrt();
        let work = stage.run.work();
        vec![
            (m::DISPLACEMENT_L2, rms(errors.displacement.iter().copied())),
            (m::DISPLACEMENT_LINF, largest(&errors.displacement)),
            (m::DISPLACEMENT_SCALE, rms(errors.exact.iter().map(moved))),
            (m::PRESSURE_L2, rms(errors.pressure.iter().copied()) / scale),
            (m::PRESSURE_LINF, largest(&errors.pressure) / scale),
            (m::PRESSURE_SCALE, scale),
            (m::STRESS_L2, rms(errors.stress.iter().copied())),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (
                m::ENTRIES,
                work.nonzeros as f64 / work.factorisations.max(1) as f64,
            ),
        ]
    }
}
