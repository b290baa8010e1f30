//! What is seen of a slide in plane strain or in three dimensions: gravity, then the reduced strength.

use super::ground::{BASE, Ground, RISE, ROW, STAGE, STAGE_DAMPING, strength};
use super::metrics as m;
use super::observation::{Look, Released, Row, Series, potential, spread_over_width};
use super::parameters::{DAMPING, DURATION, REDUCTION, RELEASE};
use super::section::GRAVITY;
use crate::cases::observe::{checkerboard, column, discretisation, position_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::{Column, Snapshot};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::material::{HenckyJ2, Strength};
use mpm_core::{Field, Part, Simulation};
use mpm_solvers::{Solvable, solver};
use serde::{Deserialize, Serialize};

/// Distance from the back wall, over the height, within which the stress is that of level ground.
const FAR: f64 = 0.5;
/// Times (s) of the snapshots.
const SNAPSHOTS: [f64; 5] = [0.5, 1.0, 2.5, 4.0, 5.5];
/// Rows between two frames of the animation, and the largest number of particles that is animated.
const FRAME: usize = 20;
const ANIMATED: usize = 20_000;
/// Times (s) at which the flow is still one slide, uniform over the width, and at which it is fastest.
const EARLY: f64 = 0.5;
const FLOWING: f64 = 2.5;

/// What is measured at the end of the gravity stage.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct AtRest {
    row: Row,
    /// Nodal kinetic energy over stored energy.
    kinetic_share: f64,
    /// Rms error of the vertical stress far from the face, over γ H.
    overburden_error: f64,
    /// Rms of σ_m − Πσ_m over γ H.
    checkerboard: f64,
    /// Share of the section that has yielded.
    yielded: f64,
    /// Spread of the displacements over the width.
    width_spread: f64,
}

/// What came before the strength that holds now.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Before {
    /// Time (s) and steps since the reduction began.
    time: f64,
    steps: u64,
    /// Stress work (J) since then.
    stress_work: f64,
    /// Of every particle, in seeding order: what flow had dissipated (J/m³), and the plastic strain.
    dissipated: Vec<f64>,
    plastic_strain: Vec<f64>,
}

/// What has been seen of a slide.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Seen {
    /// Factor by which the peak has been divided; none under rising gravity.
    reduction: Option<f64>,
    before: Before,
    at_rest: AtRest,
    released: Released,
    pub(super) series: Series,
    early_spread: f64,
    /// Rms of σ_m − Πσ_m over γ H in the flow.
    checkerboard: f64,
}

impl Seen {
    /// Of `particles` at the start.
    fn nothing(particles: usize) -> Self {
        Self {
            reduction: None,
            before: Before {
                dissipated: vec![0.0; particles],
                plastic_strain: vec![0.0; particles],
                ..Before::default()
            },
            at_rest: AtRest::default(),
            released: Released::default(),
            series: Series::default(),
            early_spread: f64::NAN,
            checkerboard: f64::NAN,
        }
    }

    /// The crest's settlement (m) at the end of the gravity stage, and 0.5 s after the reduction.
    pub(super) fn settlements(&self) -> [f64; 2] {
        let early = self.series.at(EARLY);
        let early = early.map_or(f64::NAN, |row| row.settlement);
        [self.at_rest.row.settlement, early]
    }
}

/// A slide: first under rising gravity with its full strength, then with the reduced one.
pub(super) struct Slide<const D: usize> {
    spec: RunSpec,
    parameters: Parameters,
    ground: Ground<D>,
    reference: Vec<[f64; 2]>,
}

impl<const D: usize> Slide<D>
where
    HenckyJ2: Solvable<D>,
{
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<D, Self>, Error> {
        let ground = Ground::new(spec, parameters)?;
        // What is wrong with the reduced strength is said before anything moves.
        strength(parameters, parameters.number(REDUCTION))?;
        let places = spec.start_at(ground.seed());
        let slide = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            ground,
            reference: places.iter().map(section_of).collect(),
        };
        let seen = Seen::nothing(places.len());
        Ok(Drive::new(slide, seen)?)
    }

    /// Ends the gravity stage.
    fn release(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<(), mpm_core::Error> {
        self.measure_rest(seen, stage.run.as_mut());
        seen.released = Released {
            positions: positions(stage.run.as_ref()),
        };
        self.reduce(seen, stage)?;
        // All count anew from here.
        seen.at_rest.row.stress_work = 0.0;
        (seen.before.time, seen.before.steps, seen.before.stress_work) = (0.0, 0, 0.0);
        Ok(())
    }

    /// Reduces the strength to that of the next row.
    fn reduce(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<(), mpm_core::Error> {
        let run = stage.run.as_mut();
        let (time, steps, totals) = (run.time(), run.work().steps, run.totals());
        let plastic_strain = plastic_strain(run);
        seen.before = Before {
            time: seen.before.time + time,
            steps: seen.before.steps + steps,
            stress_work: seen.before.stress_work + totals.accumulated.stress_work,
            dissipated: self.dissipated(seen, &plastic_strain)?,
            plastic_strain,
        };
        let body = run.body()?;
        seen.reduction = Some(self.next_reduction(seen));
        stage.enter(self.scene(seen)?, Some(&body))
    }
}

impl<const D: usize> Slide<D> {
    /// The strength that holds now.
    fn strength(&self, seen: &Seen) -> Result<Strength, mpm_core::Error> {
        strength(&self.parameters, seen.reduction.unwrap_or(1.0))
    }

    /// The factor by which the peak strength is divided during the next row.
    fn next_reduction(&self, seen: &Seen) -> f64 {
        let number = |p| self.parameters.number(p);
        let share = (seen.series.rows.len() + 1) as f64 * ROW / number(RELEASE).max(ROW);
        match number(REDUCTION) {
            whole if share > 1.0 - 1e-9 => whole,
            whole => 1.0 + (whole - 1.0) * share,
        }
    }

    /// What the slope looks like with these places (m) and plastic strains.
    fn look<'a>(&'a self, positions: &'a [[f64; 2]], plastic_strain: &'a [f64]) -> Look<'a> {
        Look {
            section: &self.ground.section,
            spacing: self.ground.spacing,
            across: self.ground.across,
            reference: &self.reference,
            positions,
            plastic_strain,
        }
    }

    fn observe(&self, seen: &Seen, run: &mut dyn Simulation<D>) -> Result<Row, mpm_core::Error> {
        let (positions, plastic_strain) = (positions(run), plastic_strain(run));
        let look = self.look(&positions, &plastic_strain);
        let totals = run.totals();
        let per_metre = 1.0 / self.ground.width;
        let volume = self.ground.spacing.powi(D as i32);
        let dissipated = self.dissipated(seen, &plastic_strain)?;
        Ok(Row {
            time: seen.before.time + run.time(),
            toe: look.toe(),
            bulk_toe: look.bulk_toe(),
            settlement: look.settlement(),
            kinetic: per_metre * totals.kinetic_energy,
            potential: per_metre * potential(run.particles()),
            stress_work: per_metre * (seen.before.stress_work + totals.accumulated.stress_work),
            stored: per_metre * totals.stored_energy,
            dissipated: per_metre * (volume * dissipated.iter().sum::<f64>()),
            base_force: 0.0,
            failed: look.failed(&seen.released),
            retrogression: look.retrogression(&seen.released),
            bands: look.bands().len() as f64,
            jacobian: totals.jacobian,
            log_jacobian_gap: totals.log_jacobian_gap_rms,
        })
    }

    /// What flow has dissipated (J/m³) at every particle: with strengths that were, then with that of now.
    fn dissipated(&self, seen: &Seen, now: &[f64]) -> Result<Vec<f64>, mpm_core::Error> {
        let strength = self.strength(seen)?;
        let work = |strain: f64| strength.plastic_work(strain);
        let before = seen
            .before
            .dissipated
            .iter()
            .zip(&seen.before.plastic_strain);
        let added = before.zip(now);
        Ok(added
            .map(|((dissipated, before), now)| dissipated + work(*now) - work(*before))
            .collect())
    }

    /// Rms of σ_m − Πσ_m over γ H.
    fn checkerboard(&self, run: &mut dyn Simulation<D>) -> f64 {
        let mean = run.field(Field::MeanStress);
        let averaged = run.field(Field::AveragedMeanStress);
        let scale = self.ground.density * GRAVITY * self.ground.section.height;
        checkerboard(&mean, &averaged) / scale
    }

    fn measure_rest(&self, seen: &mut Seen, run: &mut dyn Simulation<D>) {
        let weight = self.ground.density * GRAVITY;
        let scale = weight * self.ground.section.height;
        let (section, stress) = (self.ground.section, run.force_stress());
        let p = run.particles();
        let far = |k: &usize| p.reference[*k][0] < FAR * section.height;
        let error = |k: usize| stress[k].get(1, 1) + weight * (section.height - p.reference[k][1]);
        let overburden_error = rms((0..p.len()).filter(far).map(error)) / scale;
        let strain = plastic_strain(run);
        let yielded = strain.iter().filter(|e| **e > 0.0).count();
        seen.at_rest = AtRest {
            row: seen.at_rest.row,
            kinetic_share: run.residual().kinetic_energy / run.totals().stored_energy,
            overburden_error,
            checkerboard: self.checkerboard(run),
            yielded: yielded as f64 / strain.len() as f64,
            width_spread: spread_over_width(&moved(run), self.ground.across),
        };
    }
}

/// Places (m) in the section, in seeding order.
fn positions<const D: usize>(run: &dyn Simulation<D>) -> Vec<[f64; 2]> {
    let p = run.particles();
    p.seeded(|k| section_of(&p.position[k]))
}

fn plastic_strain<const D: usize>(run: &mut dyn Simulation<D>) -> Vec<f64> {
    let strain = run.field(Field::PlasticStrain);
    run.particles().seeded(|k| strain[k])
}

/// How far (m) every particle is from its reference position, in seeding order.
fn moved<const D: usize>(run: &dyn Simulation<D>) -> Vec<f64> {
    let p = run.particles();
    let distance = |k: usize| {
        let pairs = p.position[k].iter().zip(&p.reference[k]);
        let squares = pairs.map(|(x, reference)| (x - reference).powi(2));
        squares.sum::<f64>().sqrt()
    };
    p.seeded(distance)
}

/// The place in the section.
fn section_of<const D: usize>(x: &[f64; D]) -> [f64; 2] {
    [x[0], x[1]]
}

/// A breakdown, with time and steps of the strengths that held before since the release.
fn since_release(before: &Before, error: mpm_core::Error) -> mpm_core::Error {
    match error {
        mpm_core::Error::Breakdown {
            time,
            step,
            particle,
            fault,
        } => mpm_core::Error::Breakdown {
            time: before.time + time,
            step: before.steps + step,
            particle,
            fault,
        },
        other => other,
    }
}

/// Positions, plastic strain and mean stress.
fn columns<const D: usize>(run: &mut dyn Simulation<D>) -> Vec<Column> {
    let plastic_strain = plastic_strain(run);
    let mean_stress = run.field(Field::MeanStress);
    let p = run.particles();
    let mut columns = position_columns(p);
    columns.push(column("plastic_strain", "-", plastic_strain));
    columns.push(column("mean_stress", "Pa", p.seeded(|k| mean_stress[k])));
    columns
}

impl<const D: usize> Watch<D> for Slide<D>
where
    HenckyJ2: Solvable<D>,
{
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        discretisation(D, &self.spec, &self.parameters, self.ground.dt)
    }

    fn scene(&self, seen: &Seen) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        let stages = match seen.reduction {
            None => (RISE, STAGE_DAMPING),
            Some(_) => (0.0, self.parameters.number(DAMPING)),
        };
        let strength = self.strength(seen)?;
        let (scene, settings) =
            self.ground
                .scene(&self.spec, &self.parameters, strength, stages)?;
        solver(self.spec.scheme, scene, settings)
    }

    fn columns(&self) -> Vec<&'static str> {
        Row::COLUMNS.map(|(name, _)| name).to_vec()
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, mpm_core::Error> {
        let base = |stage: &Stage<D>| stage.run.on(Part::Constraint(BASE)).impulse[1];
        let before = base(stage);
        stage
            .steps(self.ground.steps_per_row)
            .map_err(|e| since_release(&seen.before, e))?;
        let mut row = self.observe(seen, stage.run.as_mut())?;
        row.base_force = -(base(stage) - before) / ROW / self.ground.width;
        if seen.reduction.is_none() {
            row.time -= STAGE;
            seen.at_rest.row = row;
            if row.time > -0.5 * ROW {
                self.release(seen, stage)?;
            }
            return Ok(row.values());
        }
        seen.series.rows.push(row);
        if seen.reduction != Some(self.next_reduction(seen)) {
            self.reduce(seen, stage)?;
        }
        if (row.time - EARLY).abs() < 0.5 * ROW {
            seen.early_spread = spread_over_width(&moved(stage.run.as_ref()), self.ground.across);
        }
        if (row.time - FLOWING).abs() < 0.5 * ROW {
            seen.checkerboard = self.checkerboard(stage.run.as_mut());
        }
        Ok(row.values())
    }

    fn progress(&self, _: &Seen, stage: &Stage<D>) -> f64 {
        let rows = ((STAGE + self.parameters.number(DURATION)) / ROW).round();
        (stage.work().steps / self.ground.steps_per_row) as f64 / rows
    }

    fn snapshot(&self, seen: &Seen, stage: &mut Stage<D>) -> Option<Snapshot> {
        let rows = seen.series.rows.len();
        let time = seen.series.rows.last()?.time;
        let shown = SNAPSHOTS.iter().any(|t| (t - time).abs() < 0.5 * ROW);
        let few = self.reference.len() <= ANIMATED;
        let kept = shown || few && rows.is_multiple_of(FRAME);
        kept.then(|| Snapshot {
            time,
            columns: columns(stage.run.as_mut()),
        })
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<Column> {
        let mut columns = columns(stage.run.as_mut());
        let p = stage.run.particles();
        let mut push = |name, unit, values| columns.push(Column { name, unit, values });
        let axes = ["reference_x", "reference_y", "reference_z"].into_iter();
        for (a, name) in axes.take(D).enumerate() {
            push(name, "m", p.seeded(|k| p.reference[k][a]));
        }
        push("jacobian", "-", p.seeded(|k| p.jacobian[k]));
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<D>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_mut();
        let (rest, totals) = (&seen.at_rest, run.totals());
        let weight = totals.mass * GRAVITY / self.ground.width;
        let (positions, plastic_strain) = (positions(run), plastic_strain(run));
        let bands = self.look(&positions, &plastic_strain).bands();
        let mut values = seen.series.metrics(&self.ground.section, &rest.row);
        let rearmost = bands.into_iter().fold(f64::NAN, f64::max);
        values.extend([
            (m::REARMOST_BAND_END, rearmost),
            (m::PARTICLES, self.reference.len() as f64),
            (m::PARTICLES_ACROSS, self.ground.across as f64),
            (m::MASS, totals.mass / self.ground.width),
            (m::BASE_REACTION_RATIO, rest.row.base_force / weight),
            (m::KINETIC_SHARE_AT_REST, rest.kinetic_share),
            (m::OVERBURDEN_ERROR, rest.overburden_error),
            (m::CHECKERBOARD_AT_REST, rest.checkerboard),
            (m::CHECKERBOARD_2_5S, seen.checkerboard),
            (m::YIELDED_AT_REST, rest.yielded),
            (m::SETTLEMENT_AT_REST, rest.row.settlement),
        ]);
        if D == 3 {
            let end = spread_over_width(&moved(run), self.ground.across);
            values.extend([
                (m::WIDTH_SPREAD_AT_REST, rest.width_spread),
                (m::WIDTH_SPREAD_0_5S, seen.early_spread),
                (m::WIDTH_SPREAD_END, end),
            ]);
        }
        values
    }
}

#[cfg(test)]
mod tests;
