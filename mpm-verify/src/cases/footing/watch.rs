//! What is seen while the footing presses.

use super::geometry::{WIDTH, effective_width, mechanism_extent};
use super::metrics::{self as m, CURVE, MEAN_STRESSES};
use super::parameters::{PENETRATION, ROUGH, UNDRAINED_STRENGTH};
use super::reference::EXACT;
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
use crate::statistics::{fit_line, rms};
use mpm_core::{Field, Part, Simulation};
use serde::{Deserialize, Serialize};

/// The part of the surface (m from the axis) that is well inside of what Prandtl's mechanism pushes up.
const BESIDE: (f64, f64) = (0.75 * WIDTH, 1.25 * WIDTH);
/// The last share of the penetration, over which the plateau and the mechanism are observed.
const PLATEAU: f64 = 0.25;
/// Half of the window of penetration over B in which the curve is averaged.
const WINDOW: f64 = 5e-5;

/// One observation: means over the steps since the one before.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Row {
    /// Penetration over B; through a barrier, less how much that gives way in the mean.
    penetration: f64,
    /// Force of the ground on the footing per metre of depth, upward (N/m).
    force: f64,
    /// Force of the ground on its base, downward (N/m).
    base: f64,
}

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

    /// Pressure over the undrained strength of a force (N/m) on half of a footing of `width` (m).
    fn bearing_factor(&self, force: f64, width: f64) -> f64 {
        force / (0.5 * width) / self.strength()
    }

    /// Penetration over B from which on the plateau is observed.
    fn plateau(&self) -> f64 {
        // A row at its beginning is on it, however that is rounded.
        (1.0 - PLATEAU - 1e-9) * self.end
    }

    /// Relative growth of the load per 10⁻³ of penetration over B on the plateau.
    fn rise(&self, rows: &[Row], mean_force: f64) -> f64 {
        let on_plateau = rows.iter().filter(|r| r.penetration > self.plateau());
        let points: Vec<(f64, f64)> = on_plateau
            .map(|r| (r.penetration, r.force / mean_force))
            .collect();
        fit_line(&points).map_or(f64::NAN, |line| 1e-3 * line.slope)
    }

    /// d(q/s_u)/d(s/B), fitted after the start over all rows.
    fn slope(&self, rows: &[Row]) -> f64 {
        let begun = 2.0 * self.pace.begun();
        let points: Vec<(f64, f64)> = rows
            .iter()
            .filter(|r| r.penetration > begun)
            .map(|r| (r.penetration, self.bearing_factor(r.force, WIDTH)))
            .collect();
        fit_line(&points).map_or(f64::NAN, |line| line.slope)
    }

    /// Places (m) from the axis and rises (m) of the particles at the surface over the plateau, from the axis outward.
    fn surface(&self, seen: &Seen, run: &dyn Simulation<2>) -> Vec<(f64, f64)> {
        let spacing = self.discretisation.h / f64::from(self.discretisation.ppc).sqrt();
        let p = run.particles();
        let reference = p.seeded(|k| p.reference[k]);
        let on_surface = |x: &[f64; 2]| x[1] > -0.75 * spacing;
        let mut surface: Vec<(f64, f64)> = (reference.iter().zip(flow(seen, run)))
            .filter(|(x, _)| on_surface(x))
            .map(|(x, u)| (x[0], u[1]))
            .collect();
        surface.sort_by(|a, b| a.0.total_cmp(&b.0));
        surface
    }

    /// Half the width (in B) of the ground that rises while the footing sinks over the plateau: the outermost
    /// place where the surface rises by half of what it does in the mechanism of the limit load.
    fn mechanism_width(&self, surface: &[(f64, f64)]) -> f64 {
        // The ground does not change its volume: as much rises beside the footing as sinks under it.
        let beside = mechanism_extent(self.parameters.boolean(ROUGH)) - 0.5 * WIDTH;
        let half = 0.5 * sinking(surface) * 0.5 * WIDTH / beside;
        surface
            .windows(2)
            .rev()
            .find(|pair| pair[0].1 >= half && pair[1].1 < half)
            .map_or(f64::NAN, |pair| {
                let share = (pair[0].1 - half) / (pair[0].1 - pair[1].1);
                (pair[0].0 + share * (pair[1].0 - pair[0].0)) / WIDTH
            })
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

/// How far (m) the surface sinks at the axis.
fn sinking(surface: &[(f64, f64)]) -> f64 {
    surface.first().map_or(f64::NAN, |(_, rise)| -rise)
}

/// Mean rise of the surface within [`BESIDE`] over what the footing sinks.
fn heave(surface: &[(f64, f64)]) -> f64 {
    let beside = surface
        .iter()
        .filter(|(x, _)| (BESIDE.0..BESIDE.1).contains(x));
    let rises: Vec<f64> = beside.map(|(_, rise)| *rise).collect();
    rises.iter().sum::<f64>() / rises.len() as f64 / sinking(surface)
}

/// Mean of a quantity of the rows of which `keep` holds; NaN if there are none.
fn mean(rows: &[Row], keep: impl Fn(&Row) -> bool, f: impl Fn(&Row) -> f64) -> f64 {
    let kept: Vec<f64> = rows.iter().filter(|r| keep(r)).map(f).collect();
    kept.iter().sum::<f64>() / kept.len() as f64
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
        if seen.before_plateau.is_empty() && self.pace.stroke(stage.run.time()) >= self.plateau() {
            let p = stage.run.particles();
            seen.before_plateau = p.seeded(|k| p.position[k]);
        }
        let totals = stage.run.totals();
        Ok(vec![
            time / steps,
            row.penetration,
            row.force,
            row.base,
            self.bearing_factor(row.force, WIDTH),
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
        let rows = &seen.rows;
        let on_plateau = |r: &Row| r.penetration > self.plateau();
        let force = mean(rows, on_plateau, |r| r.force);
        let base = mean(rows, on_plateau, |r| r.base);
        let most = rows.iter().map(|r| r.force).fold(0.0, f64::max);
        let effective = effective_width(self.spec.scheme.basis(), h).0;
        let stress_rms = rms(mean_stress.iter().copied());
        let board = checkerboard(&mean_stress, &averaged);
        let surface = self.surface(seen, run);
        let by_width = self.bearing_factor(force, WIDTH);
        let mut values = vec![
            (m::NC_B, by_width),
            (m::NC_B_PLUS_H, self.bearing_factor(force, WIDTH + h)),
            (m::NC_EFFECTIVE, self.bearing_factor(force, effective)),
            (m::PRANDTL_ERROR, by_width / EXACT - 1.0),
            (m::NC_PEAK, self.bearing_factor(most, WIDTH)),
            (m::PLATEAU_RISE, self.rise(rows, force)),
            (m::ELASTIC_SLOPE, self.slope(rows)),
            (m::FORCE_IMBALANCE, base / force - 1.0),
            (m::MECHANISM_WIDTH, self.mechanism_width(&surface)),
            (m::HEAVE, heave(&surface)),
            (m::MEAN_STRESS_RMS, stress_rms),
            (m::CHECKERBOARD_RMS, board),
            (m::CHECKERBOARD_RATIO, board / stress_rms),
            (m::PLASTIC_STRAIN_MAX, plastic_strain.fold(0.0, f64::max)),
            (m::LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (m::MASS, totals.mass),
        ];
        // Steps of equilibrium are few, and one stands for itself.
        let implicit = self.spec.scheme.rule().is_some();
        if implicit {
            let work = run.work();
            values.extend([
                (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
                (m::LINEAR_ITERATIONS, work.linear_iterations as f64),
            ]);
        }
        let p = run.particles();
        let references = p.seeded(|k| p.reference[k]);
        for &(metric, point) in MEAN_STRESSES {
            let probe = PointProbe::new(&references, point, 2.0 * h);
            let value = probe.map_or(f64::NAN, |p| p.value(&mean_stress));
            values.push((metric, value / self.strength()));
        }
        let window = if implicit { 1e-9 } else { WINDOW };
        for &(metric, penetration) in CURVE {
            let near = |r: &Row| (r.penetration - penetration).abs() <= window;
            let reached = penetration + window <= self.end * (1.0 + 1e-9);
            let force = if reached {
                mean(rows, near, |r| r.force)
            } else {
                f64::NAN
            };
            values.push((metric, self.bearing_factor(force, WIDTH)));
        }
        values
    }
}
