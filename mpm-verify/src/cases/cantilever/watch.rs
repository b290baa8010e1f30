//! What is seen of the cantilever, load step by load step.

use super::edge::{Edge, extremes};
use super::metrics as m;
use super::parameters::{LOAD_STEPS, POINTS_PER_DIRECTION, TOLERANCE, WEIGHT};
use super::scene::{DEPTH, LENGTH, begin, require_bearable};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::Simulation;
use mpm_core::simulation::Part;
use serde::{Deserialize, Serialize};

/// What has been seen of the beam.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
    cut: u64,
    /// The largest so far.
    force_ratio: f64,
    force_rounding: f64,
    energy_ratio: f64,
}

/// A beam under its growing weight.
pub(super) struct Bending {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    edge: Edge,
}

impl Bending {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene, or give too few particles to extrapolate from.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        require_bearable(parameters)?;
        let h = spec.level.h;
        let per_direction = parameters.number(POINTS_PER_DIRECTION);
        let bending = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: Discretisation {
                dim: 2,
                h,
                ppc: (per_direction * per_direction) as u32,
                dt: 1.0 / parameters.number(LOAD_STEPS),
                wall: "open-knot".to_owned(),
            },
            edge: Edge::new(spec, parameters),
        };
        Ok(Drive::new(bending, Seen::default())?)
    }

    /// Displacements along an axis: of the corner, and the mean over the right side.
    fn tip(&self, run: &dyn Simulation<2>, axis: usize) -> [f64; 2] {
        self.edge.tip(&displacement(run, axis))
    }

    /// The clamp's reaction over the weight (of the weight's share so far), less one.
    fn reaction_error(&self, run: &dyn Simulation<2>) -> f64 {
        let weight = self.parameters.number(WEIGHT) * run.time() * self.volume(run);
        (-run.on(Part::Constraint(0)).force[1] / weight - 1.0).abs()
    }

    fn volume(&self, run: &dyn Simulation<2>) -> f64 {
        run.particles().reference_volume.iter().sum()
    }
}

/// Displacement (m) along an axis, in seeding order.
fn displacement(run: &dyn Simulation<2>, axis: usize) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.position[k][axis] - p.reference[k][axis])
}

/// σ_xx (Pa), in seeding order.
fn stress_xx(run: &dyn Simulation<2>) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.stress[k].xx)
}

impl Watch<2> for Bending {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (-)",
            "weight (N/m³)",
            "corner_ux (m)",
            "corner_uy (m)",
            "edge_mean_ux (m)",
            "edge_mean_uy (m)",
            "stress_min (Pa)",
            "stress_max (Pa)",
            "newton_iterations (-)",
            "residual (-)",
            "residual_before (-)",
            "force_ratio (-)",
            "energy_ratio (-)",
            "parts (-)",
            "stored_energy (J/m)",
            "load_work (J/m)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let before = stage.run.work().newton_iterations;
        stage.steps(1)?;
        let run = stage.run.as_ref();
        let iterations = run.work().newton_iterations - before;
        let convergence = run.convergence().cloned().unwrap_or_default();
        seen.steps += 1;
        seen.cut += u64::from(convergence.parts > 1);
        seen.force_ratio = seen.force_ratio.max(convergence.force_ratio);
        seen.force_rounding = seen.force_rounding.max(convergence.force_rounding);
        seen.energy_ratio = seen.energy_ratio.max(convergence.energy_ratio);
        let last = |k: usize| {
            convergence
                .residuals
                .iter()
                .rev()
                .nth(k)
                .copied()
                .unwrap_or(0.0)
        };
        let [corner_x, mean_x] = self.tip(run, 0);
        let [corner_y, mean_y] = self.tip(run, 1);
        let [least, greatest] = extremes(&stress_xx(run));
        let totals = run.totals();
        Ok(vec![
            run.time(),
            self.parameters.number(WEIGHT) * run.time(),
            corner_x,
            corner_y,
            mean_x,
            mean_y,
            least,
            greatest,
            iterations as f64,
            last(0),
            last(1),
            convergence.force_ratio,
            convergence.energy_ratio,
            f64::from(convergence.parts),
            totals.stored_energy,
            totals.accumulated.load_work,
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        seen.steps as f64 / self.parameters.number(LOAD_STEPS)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let p = stage.run.particles();
        let of = |axis: usize| displacement(stage.run.as_ref(), axis);
        vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("reference_x", "m", p.seeded(|k| p.reference[k][0])),
            column("reference_y", "m", p.seeded(|k| p.reference[k][1])),
            column("ux", "m", of(0)),
            column("uy", "m", of(1)),
            column("stress_xx", "Pa", stress_xx(stage.run.as_ref())),
            column("stress_yy", "Pa", p.seeded(|k| p.stress[k].yy)),
            column("stress_xy", "Pa", p.seeded(|k| p.stress[k].xy)),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let [ux, uy] = [0, 1].map(|axis| displacement(run, axis));
        let mut values = self.edge.of_displacement([&ux, &uy], &self.parameters);
        values.extend(self.edge.of_stress(&stress_xx(run), &self.parameters));
        // What is less is rounding, which no golden should hold.
        let tolerance = self.parameters.number(TOLERANCE);
        values.extend([
            (m::NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (m::CUTS, seen.cut as f64),
            (m::LOG10_CONDITION, run.condition().log10()),
            (m::FORCE_RATIO, seen.force_ratio.max(tolerance)),
            (m::FORCE_ROUNDING, seen.force_rounding),
            (m::ENERGY_RATIO, seen.energy_ratio.max(tolerance)),
            (m::REACTION_ERROR, self.reaction_error(run).max(tolerance)),
            (m::MASS, run.totals().mass),
        ]);
        values
    }
}

/// The volume that is seeded (m³ per metre of depth).
pub(super) const VOLUME: f64 = LENGTH * DEPTH;
