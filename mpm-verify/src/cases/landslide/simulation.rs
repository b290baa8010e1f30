//! The simulation of a landslide in plane strain or in three dimensions: gravity, reduced strength, observation.

use super::METRICS;
use super::ground::{BASE, DAMPING, Ground, RISE, ROW, STAGE, strength};
use super::observation::{Look, Released, Row, Series, potential, spread_over_width};
use super::section::GRAVITY;
use crate::case::{Column, Job, RunSpec, Snapshot, observed};
use crate::error::Error;
use crate::parameter::Parameters;
use crate::record::{Discretisation, Metric, WorkDone};
use crate::statistics::rms;
use mpm_core::material::{HenckyJ2, Strength};
use mpm_core::memory::{Memory, MemoryError, Saved};
use mpm_core::{Field, Part, Simulation};
use mpm_solvers::{Solvable, solver};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
    /// Work since the start.
    work: WorkDone,
    /// Time (s) and steps since the reduction began.
    time: f64,
    steps: u64,
    /// Stress work (J) since then.
    stress_work: f64,
    /// Of every particle, in seeding order: what flow had dissipated (J/m³), and the plastic strain.
    dissipated: Vec<f64>,
    plastic_strain: Vec<f64>,
}

/// A slide: first under rising gravity with its full strength, then with the reduced one.
struct Slide<const D: usize> {
    simulation: Box<dyn Simulation<D>>,
    spec: RunSpec,
    parameters: Parameters,
    ground: Ground<D>,
    strength: Strength,
    /// Factor by which the peak has been divided; none under rising gravity.
    reduction: Option<f64>,
    before: Before,
    reference: Vec<[f64; 2]>,
    at_rest: AtRest,
    released: Released,
    series: Series,
    early_spread: f64,
    /// Rms of σ_m − Πσ_m over γ H in the flow.
    checkerboard: f64,
}

impl<const D: usize> Slide<D>
where
    HenckyJ2: Solvable<D>,
{
    fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let ground = Ground::new(spec, parameters)?;
        // What is wrong with the reduced strength is said before anything moves.
        strength(parameters, parameters.number("reduction"))?;
        let strength = strength(parameters, 1.0)?;
        let (scene, settings) = ground.scene(spec, parameters, strength, (RISE, DAMPING))?;
        let simulation = solver(spec.scheme, scene, settings)?;
        let p = simulation.particles();
        let reference: Vec<[f64; 2]> = p.seeded(|k| section_of(&p.reference[k]));
        Ok(Self {
            before: Before {
                dissipated: vec![0.0; reference.len()],
                plastic_strain: vec![0.0; reference.len()],
                ..Before::default()
            },
            reference,
            simulation,
            spec: spec.clone(),
            parameters: parameters.clone(),
            ground,
            strength,
            reduction: None,
            at_rest: AtRest::default(),
            released: Released::default(),
            series: Series::default(),
            early_spread: f64::NAN,
            checkerboard: f64::NAN,
        })
    }

    fn step_row(&mut self) -> Result<Row, mpm_core::Error> {
        let before = self.simulation.on(Part::Constraint(BASE)).impulse[1];
        for _ in 0..self.ground.steps_per_row {
            self.simulation.step().map_err(|e| self.since_release(e))?;
        }
        let mut row = self.observe();
        row.base_force = -(self.simulation.on(Part::Constraint(BASE)).impulse[1] - before)
            / ROW
            / self.ground.width;
        if self.reduction.is_none() {
            row.time -= STAGE;
            self.at_rest.row = row;
            if row.time > -0.5 * ROW {
                self.release()?;
            }
        } else {
            self.series.rows.push(row);
            if self.reduction != Some(self.next_reduction()) {
                self.reduce()?;
            }
            if (row.time - EARLY).abs() < 0.5 * ROW {
                self.early_spread = spread_over_width(&self.moved(), self.ground.across);
            }
            if (row.time - FLOWING).abs() < 0.5 * ROW {
                self.checkerboard = self.checkerboard();
            }
        }
        Ok(row)
    }

    /// A breakdown, with time and steps of the strengths that held before since the release.
    fn since_release(&self, error: mpm_core::Error) -> mpm_core::Error {
        match error {
            mpm_core::Error::Breakdown {
                time,
                step,
                particle,
                fault,
            } => mpm_core::Error::Breakdown {
                time: self.before.time + time,
                step: self.before.steps + step,
                particle,
                fault,
            },
            other => other,
        }
    }

    /// Ends the gravity stage.
    fn release(&mut self) -> Result<(), mpm_core::Error> {
        self.measure_rest();
        self.released = Released {
            positions: self.positions(),
        };
        self.reduce()?;
        // All count anew from here.
        self.at_rest.row.stress_work = 0.0;
        (self.before.time, self.before.steps, self.before.stress_work) = (0.0, 0, 0.0);
        Ok(())
    }

    /// The factor by which the peak strength is divided during the next row.
    fn next_reduction(&self) -> f64 {
        let number = |name| self.parameters.number(name);
        let share = (self.series.rows.len() + 1) as f64 * ROW / number("release").max(ROW);
        match number("reduction") {
            whole if share > 1.0 - 1e-9 => whole,
            whole => 1.0 + (whole - 1.0) * share,
        }
    }

    /// Reduces the strength to that of the next row.
    fn reduce(&mut self) -> Result<(), mpm_core::Error> {
        let (time, totals) = (self.simulation.time(), self.simulation.totals());
        let plastic_strain = self.plastic_strain();
        self.before = Before {
            work: self.work(),
            time: self.before.time + time,
            steps: self.before.steps + self.simulation.work().steps,
            stress_work: self.before.stress_work + totals.accumulated.stress_work,
            dissipated: self.dissipated(&plastic_strain),
            plastic_strain,
        };
        let body = self.simulation.body()?;
        self.weaken(self.next_reduction())?;
        self.simulation.take_over(&body)
    }

    /// A scene with the peak strength divided by `reduction`, at the start, in place of the one that was.
    fn weaken(&mut self, reduction: f64) -> Result<(), mpm_core::Error> {
        self.reduction = Some(reduction);
        self.strength = strength(&self.parameters, reduction)?;
        let stages = (0.0, self.parameters.number("damping"));
        let (scene, settings) =
            self.ground
                .scene(&self.spec, &self.parameters, self.strength, stages)?;
        self.simulation = solver(self.spec.scheme, scene, settings)?;
        Ok(())
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        let p = self.simulation.particles();
        p.seeded(|k| section_of(&p.position[k]))
    }

    fn plastic_strain(&mut self) -> Vec<f64> {
        let strain = self.simulation.field(Field::PlasticStrain);
        self.simulation.particles().seeded(|k| strain[k])
    }

    /// How far (m) every particle is from its reference position, in seeding order.
    fn moved(&self) -> Vec<f64> {
        let p = self.simulation.particles();
        let distance = |k: usize| {
            let pairs = p.position[k].iter().zip(&p.reference[k]);
            pairs
                .map(|(x, reference)| (x - reference).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        p.seeded(distance)
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

    fn observe(&mut self) -> Row {
        let (positions, plastic_strain) = (self.positions(), self.plastic_strain());
        let look = self.look(&positions, &plastic_strain);
        let totals = self.simulation.totals();
        let per_metre = 1.0 / self.ground.width;
        let volume = self.ground.spacing.powi(D as i32);
        let p = self.simulation.particles();
        Row {
            time: self.before.time + self.simulation.time(),
            toe: look.toe(),
            bulk_toe: look.bulk_toe(),
            settlement: look.settlement(),
            kinetic: per_metre * totals.kinetic_energy,
            potential: per_metre * potential(p),
            stress_work: per_metre * (self.before.stress_work + totals.accumulated.stress_work),
            stored: per_metre * totals.stored_energy,
            dissipated: per_metre * (volume * self.dissipated(&plastic_strain).iter().sum::<f64>()),
            base_force: 0.0,
            failed: look.failed(&self.released),
            retrogression: look.retrogression(&self.released),
            bands: look.bands().len() as f64,
            jacobian: totals.jacobian,
            log_jacobian_gap: totals.log_jacobian_gap_rms,
        }
    }

    /// What flow has dissipated (J/m³) at every particle: with strengths that were, then with that of now.
    fn dissipated(&self, plastic_strain: &[f64]) -> Vec<f64> {
        let work = |strain: f64| self.strength.plastic_work(strain);
        let Before {
            dissipated,
            plastic_strain: before,
            ..
        } = &self.before;
        (dissipated.iter().zip(plastic_strain).zip(before))
            .map(|((dissipated, now), before)| dissipated + work(*now) - work(*before))
            .collect()
    }

    /// Rms of σ_m − Πσ_m over γ H.
    fn checkerboard(&mut self) -> f64 {
        let mean = self.simulation.field(Field::MeanStress);
        let averaged = self.simulation.field(Field::AveragedMeanStress);
        let scale = self.ground.density * GRAVITY * self.ground.section.height;
        rms(mean.iter().zip(&averaged).map(|(s, a)| s - a)) / scale
    }

    fn measure_rest(&mut self) {
        let weight = self.ground.density * GRAVITY;
        let scale = weight * self.ground.section.height;
        let (section, stress) = (self.ground.section, self.simulation.force_stress());
        let p = self.simulation.particles();
        let far = |k: &usize| p.reference[*k][0] < FAR * section.height;
        let error = |k: usize| stress[k].get(1, 1) + weight * (section.height - p.reference[k][1]);
        let overburden_error = rms((0..p.len()).filter(far).map(error)) / scale;
        let strain = self.plastic_strain();
        let yielded = strain.iter().filter(|e| **e > 0.0).count();
        self.at_rest = AtRest {
            row: self.at_rest.row,
            kinetic_share: self.simulation.residual().kinetic_energy
                / self.simulation.totals().stored_energy,
            overburden_error,
            checkerboard: self.checkerboard(),
            yielded: yielded as f64 / strain.len() as f64,
            width_spread: spread_over_width(&self.moved(), self.ground.across),
        };
    }

    fn work(&self) -> WorkDone {
        let now: WorkDone = self.simulation.work().into();
        now.after(self.before.work)
    }

    fn metrics(&mut self) -> Vec<(&'static str, f64)> {
        let (positions, plastic_strain) = (self.positions(), self.plastic_strain());
        let (rest, totals) = (&self.at_rest, self.simulation.totals());
        let weight = totals.mass * GRAVITY / self.ground.width;
        let bands = self.look(&positions, &plastic_strain).bands();
        let mut values = self.series.metrics(&self.ground.section, &rest.row);
        values.extend([
            (
                "rearmost_band_end",
                bands.into_iter().fold(f64::NAN, f64::max),
            ),
            ("particles", self.reference.len() as f64),
            ("particles_across", self.ground.across as f64),
            ("mass", totals.mass / self.ground.width),
            ("base_reaction_ratio", rest.row.base_force / weight),
            ("kinetic_share_at_rest", rest.kinetic_share),
            ("overburden_error", rest.overburden_error),
            ("checkerboard_at_rest", rest.checkerboard),
            ("checkerboard_2.5s", self.checkerboard),
            ("yielded_at_rest", rest.yielded),
            ("settlement_at_rest", rest.row.settlement),
        ]);
        if D == 3 {
            let end = spread_over_width(&self.moved(), self.ground.across);
            values.extend([
                ("width_spread_at_rest", rest.width_spread),
                ("width_spread_0.5s", self.early_spread),
                ("width_spread_end", end),
            ]);
        }
        values
    }

    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(
            self.reduction,
            self.simulation.save()?,
            &self.before,
            self.at_rest,
            &self.released,
            &self.series,
            self.early_spread,
            self.checkerboard,
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (reduction, simulation): (Option<f64>, Saved);
        (
            reduction,
            simulation,
            self.before,
            self.at_rest,
            self.released,
            self.series,
            self.early_spread,
            self.checkerboard,
        ) = saved.read("the landslide")?;
        if let Some(reduction) = reduction {
            self.weaken(reduction).map_err(|_| MemoryError::Value {
                what: "reduction",
                value: reduction,
                allowed: "a factor that the strength can be divided by",
            })?;
        }
        self.simulation.restore(&simulation)
    }
}

/// The place in the section.
fn section_of<const D: usize>(x: &[f64; D]) -> [f64; 2] {
    [x[0], x[1]]
}

/// A running simulation; one in three dimensions has the same section in plane strain beside it.
pub(super) struct Simulated<const D: usize> {
    slide: Slide<D>,
    plane: Option<Slide<2>>,
    discretisation: Discretisation,
    duration: f64,
}

impl<const D: usize> Simulated<D>
where
    HenckyJ2: Solvable<D>,
{
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let slide = Slide::<D>::new(spec, parameters)?;
        let plane = if D == 3 {
            Some(Slide::<2>::new(spec, parameters)?)
        } else {
            None
        };
        let per_direction = parameters.number("ppc_per_direction");
        Ok(Self {
            discretisation: Discretisation {
                dim: D,
                h: spec.level.h,
                ppc: per_direction.powi(D as i32) as u32,
                dt: slide.ground.dt,
                wall: parameters.text("wall"),
            },
            slide,
            plane,
            duration: parameters.number("duration"),
        })
    }

    /// Rows of the whole run and rows so far.
    fn rows(&self) -> (u64, u64) {
        let all = ((STAGE + self.duration) / ROW).round() as u64;
        (
            all,
            self.slide.work().steps / self.slide.ground.steps_per_row,
        )
    }

    /// Positions, plastic strain and mean stress.
    fn columns(&mut self) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let plastic_strain = self.slide.plastic_strain();
        let mean_stress = self.slide.simulation.field(Field::MeanStress);
        let p = self.slide.simulation.particles();
        let mut columns: Vec<Column> = ["x", "y", "z"]
            .into_iter()
            .take(D)
            .enumerate()
            .map(|(a, name)| column(name, "m", p.seeded(|k| p.position[k][a])))
            .collect();
        columns.push(column("plastic_strain", "-", plastic_strain));
        columns.push(column("mean_stress", "Pa", p.seeded(|k| mean_stress[k])));
        columns
    }
}

impl<const D: usize> Memory for Simulated<D>
where
    HenckyJ2: Solvable<D>,
{
    fn save(&self) -> Result<Saved, MemoryError> {
        let plane = self.plane.as_ref().map(Slide::<2>::save).transpose()?;
        Saved::of(&(self.slide.save()?, plane))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (slide, plane): (Saved, Option<Saved>) = saved.read("the landslide")?;
        self.slide.restore(&slide)?;
        match (&mut self.plane, plane) {
            (Some(mine), Some(saved)) => mine.restore(&saved),
            _ => Ok(()),
        }
    }
}

impl<const D: usize> Job for Simulated<D>
where
    HenckyJ2: Solvable<D>,
{
    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn series_columns(&self) -> Vec<&'static str> {
        let mut columns = Row::COLUMNS.to_vec();
        if self.plane.is_some() {
            columns.extend(["plane_strain_toe (m)", "plane_strain_settlement (m)"]);
        }
        columns
    }

    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error> {
        let mut values = self.slide.step_row()?.values();
        if let Some(plane) = &mut self.plane {
            let row = plane.step_row()?;
            values.extend([row.toe, row.settlement]);
        }
        Ok(values)
    }

    fn finished(&self) -> bool {
        let (all, done) = self.rows();
        done >= all
    }

    fn progress(&self) -> f64 {
        let (all, done) = self.rows();
        done as f64 / all as f64
    }

    fn snapshot(&mut self) -> Option<Snapshot> {
        let rows = self.slide.series.rows.len();
        let time = self.slide.series.rows.last()?.time;
        let shown = SNAPSHOTS.iter().any(|t| (t - time).abs() < 0.5 * ROW);
        let few = self.slide.reference.len() <= ANIMATED;
        let kept = shown || few && rows.is_multiple_of(FRAME);
        kept.then(|| Snapshot {
            time,
            columns: self.columns(),
        })
    }

    fn particles(&mut self) -> Vec<Column> {
        let mut columns = self.columns();
        let p = self.slide.simulation.particles();
        for (a, name) in ["reference_x", "reference_y", "reference_z"]
            .into_iter()
            .enumerate()
            .take(D)
        {
            let values = p.seeded(|k| p.reference[k][a]);
            columns.push(Column {
                name,
                unit: "m",
                values,
            });
        }
        let (name, unit) = ("jacobian", "-");
        let values = p.seeded(|k| p.jacobian[k]);
        columns.push(Column { name, unit, values });
        columns
    }

    fn metrics(&mut self) -> BTreeMap<String, Metric> {
        let mut values = self.slide.metrics();
        if let Some(plane) = &self.plane {
            let (rest, plane_rest) = (&self.slide.at_rest.row, &plane.at_rest.row);
            let early = |slide: &Series| slide.at(EARLY).map_or(f64::NAN, |row| row.settlement);
            let [here, there] = [early(&self.slide.series), early(&plane.series)];
            let toe = |slide: &Series| slide.rows.last().map_or(f64::NAN, |row| row.toe);
            let relative = |a: f64, b: f64| (a - b) / b;
            values.extend([
                (
                    "off_plane_strain_at_rest",
                    relative(rest.settlement, plane_rest.settlement),
                ),
                ("off_plane_strain_0.5s", relative(here, there)),
                (
                    "off_plane_strain_end",
                    toe(&self.slide.series) - toe(&plane.series),
                ),
            ]);
        }
        observed(METRICS, values)
    }

    fn work(&self) -> WorkDone {
        self.slide.work()
    }
}

#[cfg(test)]
mod tests;
