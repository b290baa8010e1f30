//! What is seen while the footing presses.

use super::curve::{LoadCurve, Row, Surface, WINDOW, bearing_factor, plateau};
use super::geometry::{WIDTH, effective_width};
use super::metrics::{self as m, MEAN_STRESSES};
use super::parameters::{PENETRATION, ROUGH, UNDRAINED_STRENGTH};
use super::scene::{BASE, FOOTING, Pace, Press, begin};
use crate::cases::observe::{
    checkerboard, column, discretisation, mean_stress, position_columns, reference_columns,
};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::probe::PointProbe;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::{Field, Part, Simulation};
use serde::{Deserialize, Serialize};

/// What has been seen of a footing.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    rows: Vec<Row>,
    /// Positions (m), in seeding order, where the observation of the plateau begins.
    before_plateau: Vec<[f64; 2]>,
}

/// A footing that presses.
pub(super) struct Pressing {
    spec: RunSpec,
    parameters: Parameters,
    press: Press,
    pace: Pace,
    discretisation: Discretisation,
    /// Penetration over B at the end.
    end: f64,
}

impl Pressing {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let pace = Pace::new(spec, parameters)?;
        let pressing = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            press: Press::new(spec.level.h, parameters)?,
            discretisation: discretisation(2, spec, parameters, pace.dt),
            pace,
            end: parameters.number(PENETRATION),
        };
        Ok(Drive::new(pressing, Seen::default())?)
    }

    /// By how much of B the footing is ahead of the ground under a force (N/m).
    fn lost(&self, force: f64) -> f64 {
        match &self.press {
            Press::RigidNodes => 0.0,
            Press::Barrier(barrier, particles) => {
                (barrier.distance() - barrier.gap(force.max(0.0) / particles)) / WIDTH
            }
        }
    }

    /// Force of the ground on the footing in the last step, upward (N/m).
    fn force_on_footing(&self, run: &dyn Simulation<2>) -> f64 {
        let part = match self.press {
            Press::RigidNodes => Part::Constraint(FOOTING),
            Press::Barrier(..) => Part::Contact(0),
        };
        run.on(part).force[1]
    }

    fn strength(&self) -> f64 {
        self.parameters.number(UNDRAINED_STRENGTH)
    }
}

/// Displacement (m) of every particle over the plateau, in seeding order; none before it begins.
fn flow(seen: &Seen, run: &dyn Simulation<2>) -> Vec<[f64; 2]> {
    let p = run.particles();
    let now = p.seeded(|k| p.position[k]);
    let displacement = |(k, x): (usize, &[f64; 2])| {
        let before = seen.before_plateau.get(k).unwrap_or(x);
        [x[0] - before[0], x[1] - before[1]]
    };
    now.iter().enumerate().map(displacement).collect()
}

/// The mean normal stress (Pa) of particles that start at `references` (m), over a strength (Pa), at the points of the
/// reference, and its rms.
pub(super) fn of_stress(
    references: &[[f64; 2]],
    mean_stress: &[f64],
    (h, strength): (f64, f64),
) -> Vec<(Metric, f64)> {
    let mut values = vec![(m::MEAN_STRESS_RMS, rms(mean_stress.iter().copied()))];
    for &(metric, point) in MEAN_STRESSES {
        let probe = PointProbe::new(references, point, 2.0 * h);
        let value = probe.map_or(f64::NAN, |p| p.value(mean_stress));
        values.push((metric, value / strength));
    }
    values
}

impl Watch<2> for Pressing {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters, &self.press, &self.pace)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "penetration (-)",
            "footing_force (N/m)",
            "base_force (N/m)",
            "pressure_over_strength (-)",
            "kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "stress_work (J/m)",
            "jacobian_min (-)",
            "jacobian_max (-)",
            "log_jacobian_gap_rms (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let (mut force, mut base, mut time) = (0.0, 0.0, 0.0);
        let implicit = self.spec.scheme.rule().is_some();
        for _ in 0..self.pace.steps_per_row {
            let start = stage.run.time();
            stage.steps(1)?;
            // Forces are those at the start of an explicit step, at the end of an implicit one.
            time += if implicit { stage.run.time() } else { start };
            force += self.force_on_footing(stage.run.as_ref());
            base -= stage.run.on(Part::Constraint(BASE)).force[1];
        }
        let steps = self.pace.steps_per_row as f64;
        let row = Row {
            penetration: self.pace.stroke(time / steps) - self.lost(force / steps),
            force: force / steps,
            base: base / steps,
        };
        seen.rows.push(row);
        if seen.before_plateau.is_empty() && self.pace.stroke(stage.run.time()) >= plateau(self.end)
        {
            let p = stage.run.particles();
            seen.before_plateau = p.seeded(|k| p.position[k]);
        }
        let totals = stage.run.totals();
        Ok(vec![
            time / steps,
            row.penetration,
            row.force,
            row.base,
            bearing_factor(row.force, WIDTH, self.strength()),
            totals.kinetic_energy,
            totals.stored_energy,
            totals.accumulated.stress_work,
            totals.jacobian.0,
            totals.jacobian.1,
            totals.log_jacobian_gap_rms,
        ])
    }

    fn progress(&self, _: &Seen, stage: &Stage<2>) -> f64 {
        (self.pace.stroke(stage.run.time()) / self.end * (1.0 + 1e-9)).min(1.0)
    }

    fn particles(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let run = stage.run.as_mut();
        let (mean_stress, averaged) = mean_stress(run);
        let plastic_strain = run.field(Field::PlasticStrain);
        let flow = flow(seen, run);
        let p = run.particles();
        let of = |axis: usize| flow.iter().map(|u| u[axis]).collect();
        let own = vec![
            column("plateau_ux", "m", of(0)),
            column("plateau_uy", "m", of(1)),
            column("mean_stress", "Pa", mean_stress),
            column("averaged_mean_stress", "Pa", averaged),
            column("plastic_strain", "-", p.seeded(|k| plastic_strain[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ];
        [position_columns(p), reference_columns(p), own].concat()
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_mut();
        let (mean_stress, averaged) = mean_stress(run);
        let plastic_strain = run.field(Field::PlasticStrain).into_iter();
        let (totals, h) = (run.totals(), self.discretisation.h);
        // Steps of equilibrium are few, and one stands for itself.
        let implicit = self.spec.scheme.rule().is_some();
        let curve = LoadCurve {
            rows: &seen.rows,
            strength: self.strength(),
            end: self.end,
            begun: self.pace.begun(),
            h,
            effective: effective_width(self.spec.scheme.basis(), h).0,
            window: if implicit { 1e-9 } else { WINDOW },
        };
        let stress_rms = rms(mean_stress.iter().copied());
        let board = checkerboard(&mean_stress, &averaged);
        let p = run.particles();
        let references = p.seeded(|k| p.reference[k]);
        let spacing = h / f64::from(self.discretisation.ppc).sqrt();
        let surface = Surface::new(&references, &flow(seen, run), spacing);
        let mut values = curve.metrics();
        values.extend(surface.metrics(self.parameters.boolean(ROUGH)));
        values.extend(of_stress(&references, &mean_stress, (h, self.strength())));
        values.extend([
            (m::FORCE_IMBALANCE, curve.imbalance()),
            (m::CHECKERBOARD_RMS, board),
            (m::CHECKERBOARD_RATIO, board / stress_rms),
            (m::PLASTIC_STRAIN_MAX, plastic_strain.fold(0.0, f64::max)),
            (m::LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (m::MASS, totals.mass),
        ]);
        if implicit {
            let work = run.work();
            values.extend([
                (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
                (m::LINEAR_ITERATIONS, work.linear_iterations as f64),
            ]);
        }
        values
    }
}
