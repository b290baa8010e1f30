//! What is seen of the membrane on its way to rest.

use super::geometry::seed;
use super::metrics as m;
use super::parameters::{DENSITY, LOAD_RAMP, MAX_PERIODS, PPC_PER_DIRECTION, REST_WINDOW};
use super::probes::Probes;
use super::scene::{begin, check_together, period, time_step};
use crate::cases::observe::{checkerboard, column, discretisation, mean_stress, position_columns, reference_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::RemedyName;
use crate::spec::RunSpec;
use crate::statistics::{Line, fit_line, rms};
use mpm_core::stage::{Observation, RestCriterion};
use mpm_core::{Memory, Saved, Simulation};
use serde::{Deserialize, Serialize};

/// Strain per period that counts as creep.
pub(super) const CREEP: f64 = 1e-4;
/// Observations per period.
const OBSERVATIONS: f64 = 240.0;
/// Criterion of rest: relative out-of-balance virtual work, kinetic over stored energy, relative
/// drift of the tip over the window.
const REST: (f64, f64, f64) = (1e-3, 1e-5, 1e-4);
/// What has been seen of the membrane.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// The criterion of rest, as it was; none before the first row.
    rest: Option<Saved>,
    at_rest: bool,
    /// (time, rms ln(J/J̄)).
    gaps: Vec<(f64, f64)>,
    /// Largest gain and largest loss of energy that nothing accounts for (J/m).
    energy_defect: (f64, f64),
    work_residuals: Vec<f64>,
}

/// A membrane that comes to rest, or doesn't.
pub(super) struct Loaded {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    references: Vec<[f64; 2]>,
    probes: Probes,
    max_time: f64,
    steps_per_observation: u64,
    period: f64,
}

impl Loaded {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        check_together(parameters)?;
        let number = |p| parameters.number(p);
        let (h, per_direction) = (spec.level.h, number(PPC_PER_DIRECTION));
        let (dt, period) = (time_step(h, parameters)?, period(parameters));
        let references = spec.start_at(seed(h / per_direction));
        let loaded = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: discretisation(2, spec, parameters, dt),
            probes: Probes::new(&references, 2.0 * h)?,
            references,
            max_time: number(MAX_PERIODS) * period,
            steps_per_observation: ((period / OBSERVATIONS / dt).round() as u64).max(1),
            period,
        };
        Ok(Drive::new(loaded, Seen::default())?)
    }

    /// The criterion of rest, with what it has seen.
    fn rest(&self, seen: &Seen) -> Result<RestCriterion, mpm_core::Error> {
        let (force_ratio, energy_ratio, drift) = REST;
        let window = self.parameters.number(REST_WINDOW) * self.period;
        let mut rest = RestCriterion::new(force_ratio, energy_ratio, drift, window);
        if let Some(saved) = &seen.rest {
            rest.restore(saved)?;
        }
        Ok(rest)
    }

    /// The time (s) over which the load grows.
    fn ramp(&self) -> f64 {
        self.parameters.number(LOAD_RAMP) * self.period
    }

    /// Whether the run has shown, over a whole period, that it will never rest.
    fn creeps(&self, seen: &Seen, time: f64) -> bool {
        self.spec.scheme.remedy() == RemedyName::FbarRecursive
            && time >= self.period.max(2.0 * self.ramp())
            && creep(seen, time).is_some_and(|line| line.slope * self.period > CREEP)
    }
}

/// What is measured of the membrane's shape and stress, whatever brought it there.
pub(super) fn of_shape(
    run: &mut dyn Simulation<2>,
    probes: &Probes,
    references: &[[f64; 2]],
    parameters: &Parameters,
) -> Vec<(Metric, f64)> {
    let [ux, uy] = [0, 1].map(|axis| displacement(run, axis));
    let (mean_stress, averaged) = mean_stress(run);
    let stress_rms = rms(mean_stress.iter().copied());
    let board = checkerboard(&mean_stress, &averaged);
    let mut values = probes.of_displacement([&ux, &uy], parameters);
    values.extend(probes.of_stress(references, &mean_stress, parameters));
    values.extend([(m::CHECKERBOARD_RMS, board), (m::CHECKERBOARD_RATIO, board / stress_rms)]);
    values
}

/// The particles as columns.
pub(super) fn shape_columns(run: &mut dyn Simulation<2>) -> Vec<Column> {
    let (mean_stress, averaged) = mean_stress(run);
    let [ux, uy] = [0, 1].map(|axis| displacement(run, axis));
    let p = run.particles();
    let averaged_jacobian = |k: usize| p.j_bar.get(k).copied().unwrap_or(p.jacobian[k]);
    let own = vec![
        column("ux", "m", ux),
        column("uy", "m", uy),
        column("mean_stress", "Pa", mean_stress),
        column("averaged_mean_stress", "Pa", averaged),
        column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        column("averaged_jacobian", "-", p.seeded(averaged_jacobian)),
    ];
    [position_columns(p), reference_columns(p), own].concat()
}

/// Displacement (m) along an axis, in seeding order.
pub(super) fn displacement(run: &dyn Simulation<2>, axis: usize) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.position[k][axis] - p.reference[k][axis])
}

/// One step, and the out-of-balance virtual work in it: Σ m a·u over Σ f·u of the load. In a
/// linear body this is the relative error of the displacement under the load (Betti).
fn step_and_weigh(run: &mut dyn Simulation<2>, dt: f64) -> Result<f64, mpm_core::Error> {
    let p = run.particles();
    let before = [0, 1].map(|a| p.seeded(|k| p.velocity[k][a]));
    run.step()?;
    let p = run.particles();
    let (mut imbalance, mut load) = (0.0, 0.0);
    for (k, id) in p.id.iter().enumerate() {
        for a in 0..2 {
            let u = p.position[k][a] - p.reference[k][a];
            let acceleration = (p.velocity[k][a] - before[a][*id as usize]) / dt;
            imbalance += p.mass[k] * acceleration * u;
            load += p.external_force[k][a] * u;
        }
    }
    Ok((imbalance / load).abs())
}

/// Energy (J/m) that nothing accounts for: gained, or, if negative, lost.
pub(super) fn energy_defect(kinetic: f64, stress_work: f64, losses: f64, load_work: f64) -> f64 {
    kinetic + stress_work + losses - load_work
}

fn has_stopped(run: &dyn Simulation<2>) -> bool {
    let mut velocities = run.particles().velocity.iter().flatten();
    velocities.all(|v| *v == 0.0)
}

/// The growth of rms ln(J/J̄) over the second half of the time (s) so far.
fn creep(seen: &Seen, time: f64) -> Option<Line> {
    let later = seen.gaps.iter().copied().filter(|(t, _)| *t >= 0.5 * time);
    fit_line(&later.collect::<Vec<_>>())
}

impl Watch<2> for Loaded {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "tip_uy (m)",
            "mid_edge_uy (m)",
            "kinetic_energy (J/m)",
            "nodal_kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "stress_work (J/m)",
            "load_work (J/m)",
            "damping_losses (J/m)",
            "momentum_x (kg/s)",
            "momentum_y (kg/s)",
            "mass (kg/m)",
            "jacobian_min (-)",
            "jacobian_max (-)",
            "log_jacobian_gap_rms (-)",
            "log_jacobian_gap_max (-)",
            "work_residual (-)",
            "free_force (N/m)",
            "reaction_y (N/m)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let mut rest = self.rest(seen)?;
        stage.steps(self.steps_per_observation - 1)?;
        let run = stage.run.as_mut();
        let dt = self.discretisation.dt;
        let mut work_residual = step_and_weigh(run, dt)?;
        if has_stopped(run) {
            // Kinetic damping struck in this very step: weigh the next one.
            work_residual = step_and_weigh(run, dt)?;
        }
        let (totals, residual) = (run.totals(), run.residual());
        let (uy, time) = (displacement(run, 1), run.time());
        let tip = self.probes.tip.value(&uy);
        let rests = rest.observe(Observation {
            time,
            force_ratio: work_residual,
            energy_ratio: residual.kinetic_energy / totals.stored_energy,
            displacement: tip,
        });
        seen.rest = Some(rest.save()?);
        seen.at_rest = rests && time >= self.ramp();
        seen.work_residuals.push(work_residual);
        seen.gaps.push((time, totals.log_jacobian_gap_rms));
        let work = totals.accumulated;
        let losses = work.damping + work.filter_loss + work.constraint_loss;
        let kinetic = totals.kinetic_energy;
        let defect = energy_defect(kinetic, work.stress_work, losses, work.load_work);
        let (gain, loss) = seen.energy_defect;
        seen.energy_defect = (gain.max(defect), loss.max(-defect));
        Ok(vec![
            time,
            tip,
            self.probes.mid_edge.value(&uy),
            totals.kinetic_energy,
            residual.kinetic_energy,
            totals.stored_energy,
            work.stress_work,
            work.load_work,
            losses,
            totals.momentum[0],
            totals.momentum[1],
            totals.mass,
            totals.jacobian.0,
            totals.jacobian.1,
            totals.log_jacobian_gap_rms,
            totals.log_jacobian_gap_max,
            work_residual,
            residual.free_force,
            -residual.held_force[1],
        ])
    }

    fn progress(&self, seen: &Seen, stage: &Stage<2>) -> f64 {
        let time = stage.run.time();
        if seen.at_rest || self.creeps(seen, time) {
            return 1.0;
        }
        (time / self.max_time).min(1.0)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        shape_columns(stage.run.as_mut())
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_mut();
        let mut values = of_shape(run, &self.probes, &self.references, &self.parameters);
        let (totals, time) = (run.totals(), run.time());
        let creep = creep(seen, time);
        let window = self.parameters.number(REST_WINDOW) * self.period;
        let residuals = &seen.work_residuals;
        let in_window = (window / time * residuals.len() as f64) as usize;
        let last = &residuals[residuals.len().saturating_sub(in_window + 1)..];
        let load_work = totals.accumulated.load_work;
        values.extend([
            (m::CREEP_RATE, creep.map_or(f64::NAN, |l| l.slope)),
            (m::CREEP_LINEARITY, creep.map_or(f64::NAN, |l| l.r_squared)),
            (m::LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (m::AT_REST, f64::from(u8::from(seen.at_rest))),
            (m::REST_TIME, time),
            (m::WORK_RESIDUAL, last.iter().copied().fold(0.0, f64::max)),
            (m::REACTION_UY, -run.residual().held_force[1]),
            (m::MASS, totals.mass),
            (m::SEEDED_VOLUME, totals.mass / self.parameters.number(DENSITY)),
            (m::ENERGY_GAIN, seen.energy_defect.0 / load_work),
            (m::ENERGY_LOSS, seen.energy_defect.1 / load_work),
            (m::PERIOD, self.period),
        ]);
        values
    }
}
