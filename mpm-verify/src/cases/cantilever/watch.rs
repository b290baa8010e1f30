//! What is seen of the cantilever, load step by load step.

use super::metrics as m;
use super::parameters::{LOAD_STEPS, POINTS_PER_DIRECTION, TOLERANCE, WEIGHT};
use super::reference::{solution, stresses};
use super::scene::{DEPTH, LENGTH, begin, counts, seed};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::probe::PointProbe;
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
    energy_ratio: f64,
}

/// A beam under its growing weight.
pub(super) struct Bending {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    references: Vec<[f64; 2]>,
    /// Particles along the length and the depth.
    counts: [usize; 2],
    stress: Vec<(Metric, [f64; 2], PointProbe)>,
}

impl Bending {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene, or give too few particles to extrapolate from.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let h = spec.level.h;
        let per_direction = parameters.number(POINTS_PER_DIRECTION);
        let references = spec.start_at(seed(h, parameters));
        let probes = m::STRESSES
            .iter()
            .filter_map(|&(metric, at)| Some((metric, at, PointProbe::new(&references, at, h)?)));
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
            stress: probes.collect(),
            references,
            counts: counts(h, parameters),
        };
        Ok(Drive::new(bending, Seen::default())?)
    }

    /// A field, in seeding order, extrapolated to the right side at every row of particles, from below.
    fn at_edge(&self, field: &[f64]) -> Vec<f64> {
        let [along, up] = self.counts;
        (0..up)
            .map(|row| {
                let [a, b] = [1, 2].map(|k| (along - k) * up + row);
                let [xa, xb] = [a, b].map(|k| self.references[k][0]);
                field[a] + (field[a] - field[b]) * (LENGTH - xa) / (xa - xb)
            })
            .collect()
    }

    /// Displacements along an axis: of the corner, and the mean over the right side.
    fn tip(&self, run: &dyn Simulation<2>, axis: usize) -> [f64; 2] {
        let p = run.particles();
        let edge = self.at_edge(&p.seeded(|k| p.position[k][axis] - p.reference[k][axis]));
        let [y0, y1] = [0, 1].map(|row| self.references[row][1]);
        let corner = edge[0] - (edge[1] - edge[0]) * y0 / (y1 - y0);
        [corner, edge.iter().sum::<f64>() / edge.len() as f64]
    }

    /// The clamp's reaction over the weight (of the weight's share so far), less one.
    fn reaction_error(&self, run: &dyn Simulation<2>) -> f64 {
        let weight = self.parameters.number(WEIGHT) * run.time() * self.volume(run);
        (-run.on(Part::Constraint(0)).force[1] / weight - 1.0).abs()
    }

    /// σ_xx (Pa) at the points of the reference, and its distance from there, as far as it is known.
    fn stress_at_points(&self, run: &dyn Simulation<2>) -> Vec<(Metric, f64)> {
        let p = run.particles();
        let field = p.seeded(|k| p.stress[k].xx);
        let mut values: Vec<(Metric, f64)> = Vec::new();
        let mut squares = [0.0; 2];
        let known = stresses(&self.parameters);
        for (metric, at, probe) in &self.stress {
            let value = probe.value(&field);
            values.push((*metric, value));
            if let Some(exact) = known.as_ref().ok().and_then(|known| known.at(*at)) {
                squares[0] += (value - exact.value).powi(2);
                squares[1] += exact.value.powi(2);
            }
        }
        if squares[1] > 0.0 {
            values.push((m::STRESS_ERROR, (squares[0] / squares[1]).sqrt()));
        }
        values
    }

    fn volume(&self, run: &dyn Simulation<2>) -> f64 {
        run.particles().reference_volume.iter().sum()
    }
}

/// Least and greatest σ_xx (Pa).
fn extremes(run: &dyn Simulation<2>) -> [f64; 2] {
    let stress = run.particles().stress.iter().map(|s| s.xx);
    stress.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], s| {
        [lo.min(s), hi.max(s)]
    })
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
        let [least, greatest] = extremes(run);
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
        let of = |axis: usize| p.seeded(|k| p.position[k][axis] - p.reference[k][axis]);
        vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("reference_x", "m", p.seeded(|k| p.reference[k][0])),
            column("reference_y", "m", p.seeded(|k| p.reference[k][1])),
            column("ux", "m", of(0)),
            column("uy", "m", of(1)),
            column("stress_xx", "Pa", p.seeded(|k| p.stress[k].xx)),
            column("stress_yy", "Pa", p.seeded(|k| p.stress[k].yy)),
            column("stress_xy", "Pa", p.seeded(|k| p.stress[k].xy)),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let [corner_x, mean_x] = self.tip(run, 0);
        let [corner_y, mean_y] = self.tip(run, 1);
        let [least, greatest] = extremes(run);
        // What is less is rounding, which no golden should hold.
        let tolerance = self.parameters.number(TOLERANCE);
        let mut values = vec![
            (m::CORNER_UX, corner_x),
            (m::CORNER_UY, corner_y),
            (m::EDGE_MEAN_UX, mean_x),
            (m::EDGE_MEAN_UY, mean_y),
            (m::STRESS_MIN, least),
            (m::STRESS_MAX, greatest),
            (m::NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (m::CUTS, seen.cut as f64),
            (m::LOG10_CONDITION, run.condition().log10()),
            (m::FORCE_RATIO, seen.force_ratio.max(tolerance)),
            (m::ENERGY_RATIO, seen.energy_ratio.max(tolerance)),
            (m::REACTION_ERROR, self.reaction_error(run).max(tolerance)),
            (m::MASS, run.totals().mass),
        ];
        values.extend(self.stress_at_points(run));
        if let Ok(truth) = solution(&self.parameters) {
            let [_, corner] = truth.bottom_right;
            values.push((m::CORNER_ERROR, (corner_y / corner - 1.0).abs()));
            if let Some([_, mean]) = truth.right_edge_mean {
                values.push((m::EDGE_MEAN_ERROR, (mean_y / mean - 1.0).abs()));
            }
        }
        values
    }
}

/// The volume that is seeded (m³ per metre of depth).
pub(super) const VOLUME: f64 = LENGTH * DEPTH;
