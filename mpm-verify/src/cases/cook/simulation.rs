//! The simulation of Cook's membrane: geometry, load, observation, rest.

use super::METRICS;
use super::checks::CREEP;
use super::reference::{self, solution, stress_points, stress_scale};
use crate::case::{Column, Job, RunSpec, observed};
use crate::error::Error;
use crate::parameter::Parameters;
use crate::probe::{PointProbe, nearest};
use crate::record::{Discretisation, Metric, WorkDone};
use crate::scheme::RemedyName;
use crate::statistics::{Line, fit_line, rms};
use mpm_core::basis::WallTreatment;
use mpm_core::explicit::transfer::Flip;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::stage::{
    DeadForce, End, KineticDamping, LocalDamping, Observation, RestCriterion, Wall, WallKind,
};
use mpm_core::{
    Axis, Body, Field, Grid, Memory, MemoryError, Particles, Saved, Scene, Side, Simulation,
};
use mpm_solvers::solver;
use std::collections::BTreeMap;

/// Corners: (0, 0), (48, 44), (48, 60), (0, 44) m.
pub(super) const LENGTH: f64 = 48.0;
pub(super) const LEFT_HEIGHT: f64 = 44.0;
pub(super) const RIGHT_HEIGHT: f64 = 16.0;
/// Room of the grid beyond the membrane (m): right, below, above.
const MARGIN: (f64, f64, f64) = (2.0, 2.0, 6.0);
/// Particles on a side count as inside (m).
const ON_SIDE: f64 = 1e-9;
/// The fundamental period (s) at E = 70 Pa and ρ = 1 kg/m³, rounded; it scales as √(ρ/E).
const PERIOD: f64 = 60.0;
/// Observations per period.
const OBSERVATIONS: f64 = 240.0;
/// Criterion of rest: relative out-of-balance virtual work, kinetic over stored energy, relative
/// drift of the tip over the window.
const REST: (f64, f64, f64) = (1e-3, 1e-5, 1e-4);
/// Allowed load per metre of depth over Young's modulus (m).
const LOAD_OVER_MODULUS: (f64, f64) = (1e-7, 100.0);
/// Points on the right side whose mean is `edge_mean_uy`.
const EDGE_POINTS: usize = 8;
/// Excluded from the stress error: x below this (m), and this far around the clamped corners.
const SINGULAR: f64 = 3.0;

struct Probes {
    mid_edge: PointProbe,
    tip: PointProbe,
    edge: Vec<PointProbe>,
    stress: Vec<(String, PointProbe)>,
    tip_particle: usize,
}

/// A running simulation.
pub(super) struct Simulated {
    simulation: Box<dyn Simulation<2>>,
    parameters: Parameters,
    discretisation: Discretisation,
    references: Vec<[f64; 2]>,
    probes: Probes,
    rest: RestCriterion,
    at_rest: bool,
    max_time: f64,
    steps_per_observation: u64,
    period: f64,
    ramp: f64,
    recursive: bool,
    density: f64,
    /// (time, rms ln(J/J̄)).
    gaps: Vec<(f64, f64)>,
    /// Largest gain and largest loss of energy that nothing accounts for (J/m).
    energy_defect: (f64, f64),
    work_residuals: Vec<f64>,
}

/// What must hold of parameters together.
fn check_together(parameters: &Parameters) -> Result<(), Error> {
    let number = |name| parameters.number(name);
    let strain = number("load") / number("young_modulus");
    let (least, most) = LOAD_OVER_MODULUS;
    if !(least..=most).contains(&strain) {
        return Err(Error::Input(format!(
            "load / young_modulus = {strain} m; allowed: {least} to {most} m, below which rounding hides the answer"
        )));
    }
    for name in ["rest_window", "load_ramp"] {
        if number(name) >= number("max_periods") {
            return Err(Error::Input(format!(
                "{name} = {} is not below max_periods = {}",
                number(name),
                number("max_periods")
            )));
        }
    }
    Ok(())
}

/// Particles of a lattice of the given spacing that lie inside the membrane or on its sides.
fn seed(spacing: f64) -> Vec<[f64; 2]> {
    let lower = |x: f64| LEFT_HEIGHT * x / LENGTH;
    let upper = |x: f64| LEFT_HEIGHT + RIGHT_HEIGHT * x / LENGTH;
    let count = |length: f64| (length / spacing).round() as usize;
    let mut positions = Vec::new();
    for i in 0..count(LENGTH) {
        let x = (i as f64 + 0.5) * spacing;
        for j in 0..count(LEFT_HEIGHT + RIGHT_HEIGHT) {
            let y = (j as f64 + 0.5) * spacing;
            if y >= lower(x) - ON_SIDE && y <= upper(x) + ON_SIDE {
                positions.push([x, y]);
            }
        }
    }
    positions
}

impl Simulated {
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        check_together(parameters)?;
        let h = spec.level.h;
        let number = |name| parameters.number(name);
        let per_direction = number("ppc_per_direction");
        let spacing = h / per_direction;
        let law = NeoHookean::new(number("young_modulus"), number("poisson_ratio"))?;
        let density = number("density");
        let dt = courant_time_step(number("cfl"), h, law.wave_speed(density));
        let period = PERIOD * (density * 70.0 / number("young_modulus")).sqrt();

        let cells = |length: f64| (length / h).ceil() as usize;
        let (right, below, above) = MARGIN;
        let below = cells(below) as f64 * h;
        let grid = Grid::new(
            h,
            [
                Axis::bounded(0.0, cells(LENGTH + right), (Side::Wall, Side::Open)),
                Axis::open(-below, cells(below + LEFT_HEIGHT + RIGHT_HEIGHT + above)),
            ],
        )?;
        let particles = Particles::new(
            spec.start_at(seed(spacing)),
            spacing * spacing,
            density,
            [0.5 * spacing; 2],
        )?;
        let references = particles.reference.clone();
        let wall = if parameters.is("wall", "wall-line") {
            WallTreatment::WallLine
        } else {
            WallTreatment::OpenKnot
        };
        let mut settings = Settings::new(dt)
            .wall(wall)
            .transfer(Flip::new(number("flip"))?)
            .remedy(spec.scheme.remedy().build());
        if number("damping") > 0.0 {
            settings = settings.filter_forces(LocalDamping::new(number("damping"))?);
        }
        if parameters.boolean("kinetic_damping") {
            settings = settings.filter_particles(KineticDamping::default());
        }
        let loads = loads(parameters, period, spacing, &particles);
        let scene = Scene::new(grid, Body::new(law, particles)?).constrain(Wall {
            axis: 0,
            end: End::Lo,
            kind: WallKind::Fixed,
        });
        let scene = loads.into_iter().fold(scene, Scene::load);
        let simulation = solver(spec.scheme, scene, settings)?;
        let (force_ratio, energy_ratio, drift) = REST;
        Ok(Self {
            simulation,
            parameters: parameters.clone(),
            discretisation: Discretisation {
                dim: 2,
                h,
                ppc: (per_direction * per_direction) as u32,
                dt,
                wall: parameters.text("wall"),
            },
            probes: Probes::new(&references, 2.0 * h)?,
            references,
            rest: RestCriterion::new(
                force_ratio,
                energy_ratio,
                drift,
                number("rest_window") * period,
            ),
            at_rest: false,
            max_time: number("max_periods") * period,
            steps_per_observation: ((period / OBSERVATIONS / dt).round() as u64).max(1),
            period,
            ramp: number("load_ramp") * period,
            recursive: spec.scheme.remedy() == RemedyName::FbarRecursive,
            density,
            gaps: Vec::new(),
            energy_defect: (0.0, 0.0),
            work_residuals: Vec::new(),
        })
    }

    fn displacement(&self, axis: usize) -> Vec<f64> {
        let p = self.simulation.particles();
        p.seeded(|k| p.position[k][axis] - p.reference[k][axis])
    }

    /// One step, and the out-of-balance virtual work in it: Σ m a·u over Σ f·u of the load. In a
    /// linear body this is the relative error of the displacement under the load (Betti).
    fn step_and_weigh(&mut self) -> Result<f64, mpm_core::Error> {
        let p = self.simulation.particles();
        let before = [0, 1].map(|a| p.seeded(|k| p.velocity[k][a]));
        self.simulation.step()?;
        let dt = self.discretisation.dt;
        let p = self.simulation.particles();
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

    fn stopped(&self) -> bool {
        self.simulation
            .particles()
            .velocity
            .iter()
            .flatten()
            .all(|v| *v == 0.0)
    }

    /// Mean normal stress as it enters the forces and its average Π, in seeding order.
    fn mean_stress(&mut self) -> (Vec<f64>, Vec<f64>) {
        let mean = self.simulation.field(Field::MeanStress);
        let averaged = self.simulation.field(Field::AveragedMeanStress);
        let p = self.simulation.particles();
        (p.seeded(|k| mean[k]), p.seeded(|k| averaged[k]))
    }

    /// The growth of rms ln(J/J̄) over the second half of the run so far.
    fn creep(&self) -> Option<Line> {
        let half = 0.5 * self.simulation.time();
        let later: Vec<(f64, f64)> = self
            .gaps
            .iter()
            .copied()
            .filter(|(t, _)| *t >= half)
            .collect();
        fit_line(&later)
    }

    /// Whether the run has shown, over a whole period, that it will never rest.
    fn creeps(&self) -> bool {
        self.recursive
            && self.simulation.time() >= self.period.max(2.0 * self.ramp)
            && self
                .creep()
                .is_some_and(|line| line.slope * self.period > CREEP)
    }

    fn stress_error(&self, mean_stress: &[f64]) -> f64 {
        if solution(&self.parameters).is_ok_and(|s| s.poisson_ratio == 0.499) {
            let (field, scale) = (reference::Field::stored(), stress_scale(&self.parameters));
            rms(self
                .references
                .iter()
                .zip(mean_stress)
                .filter(|(x, _)| away_from_singularities(x))
                .filter_map(|(x, s)| Some(s - scale * field.interpolate(*x)?)))
        } else {
            f64::NAN
        }
    }
}

/// Whether a material point counts in the stress error.
pub(super) fn away_from_singularities(x: &[f64; 2]) -> bool {
    x[0] > SINGULAR && x[0].hypot(x[1]) > SINGULAR && x[0].hypot(x[1] - LEFT_HEIGHT) > SINGULAR
}

/// The dead load: on the last column of particles, or on the last two with shares 3/2 and −1/2,
/// whose resultant acts on the side itself.
fn loads(
    parameters: &Parameters,
    period: f64,
    spacing: f64,
    particles: &Particles<2>,
) -> Vec<DeadForce<2>> {
    let total = parameters.number("load");
    let ramp = parameters.number("load_ramp") * period;
    let column = |share: f64, from_edge: f64| {
        DeadForce::shared([0.0, share * total], ramp, particles, |x| {
            (x[0] - (LENGTH - from_edge * spacing)).abs() < 0.25 * spacing
        })
    };
    if parameters.is("load_at", "column") {
        vec![column(1.0, 0.5)]
    } else {
        vec![column(1.5, 0.5), column(-0.5, 1.5)]
    }
}

impl Probes {
    fn new(references: &[[f64; 2]], radius: f64) -> Result<Self, Error> {
        let at = |x: f64, y: f64| {
            PointProbe::new(references, [x, y], radius)
                .ok_or_else(|| Error::Input(format!("no particles near ({x}, {y}) m to probe")))
        };
        let tip = LEFT_HEIGHT + RIGHT_HEIGHT;
        let share = |k: usize| (k as f64 + 0.5) / EDGE_POINTS as f64;
        Ok(Self {
            mid_edge: at(LENGTH, LEFT_HEIGHT + 0.5 * RIGHT_HEIGHT)?,
            tip: at(LENGTH, tip)?,
            edge: (0..EDGE_POINTS)
                .map(|k| at(LENGTH, LEFT_HEIGHT + RIGHT_HEIGHT * share(k)))
                .collect::<Result<_, _>>()?,
            stress: stress_points()
                .iter()
                .map(|p| Ok((p.metric(), at(p.x, p.y)?)))
                .collect::<Result<_, Error>>()?,
            tip_particle: nearest(references, [LENGTH, tip]),
        })
    }

    fn edge_mean(&self, uy: &[f64]) -> f64 {
        self.edge.iter().map(|p| p.value(uy)).sum::<f64>() / EDGE_POINTS as f64
    }
}

impl Memory for Simulated {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(
            self.simulation.save()?,
            self.rest.save()?,
            self.at_rest,
            &self.gaps,
            self.energy_defect,
            &self.work_residuals,
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let simulation: Saved;
        let rest: Saved;
        (
            simulation,
            rest,
            self.at_rest,
            self.gaps,
            self.energy_defect,
            self.work_residuals,
        ) = saved.read("Cook's membrane")?;
        self.simulation.restore(&simulation)?;
        self.rest.restore(&rest)
    }
}

impl Job for Simulated {
    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn series_columns(&self) -> Vec<&'static str> {
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

    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error> {
        for _ in 1..self.steps_per_observation {
            self.simulation.step()?;
        }
        let mut work_residual = self.step_and_weigh()?;
        if self.stopped() {
            // Kinetic damping struck in this very step: weigh the next one.
            work_residual = self.step_and_weigh()?;
        }
        let totals = self.simulation.totals();
        let residual = self.simulation.residual();
        let uy = self.displacement(1);
        let time = self.simulation.time();
        let tip = self.probes.tip.value(&uy);
        let rests = self.rest.observe(Observation {
            time,
            force_ratio: work_residual,
            energy_ratio: residual.kinetic_energy / totals.stored_energy,
            displacement: tip,
        });
        self.at_rest = rests && time >= self.ramp;
        self.work_residuals.push(work_residual);
        self.gaps.push((time, totals.log_jacobian_gap_rms));
        let work = totals.accumulated;
        let losses = work.damping + work.filter_loss + work.constraint_loss;
        let defect = totals.kinetic_energy + work.stress_work + losses - work.load_work;
        let (gain, loss) = self.energy_defect;
        self.energy_defect = (gain.max(defect), loss.max(-defect));
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

    fn finished(&self) -> bool {
        self.at_rest || self.simulation.time() >= self.max_time || self.creeps()
    }

    fn progress(&self) -> f64 {
        (self.simulation.time() / self.max_time).min(1.0)
    }

    fn particles(&mut self) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let (mean_stress, averaged) = self.mean_stress();
        let p = self.simulation.particles();
        vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("reference_x", "m", p.seeded(|k| p.reference[k][0])),
            column("reference_y", "m", p.seeded(|k| p.reference[k][1])),
            column("ux", "m", self.displacement(0)),
            column("uy", "m", self.displacement(1)),
            column("mean_stress", "Pa", mean_stress),
            column("averaged_mean_stress", "Pa", averaged),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
            column(
                "averaged_jacobian",
                "-",
                p.seeded(|k| p.j_bar.get(k).copied().unwrap_or(p.jacobian[k])),
            ),
        ]
    }

    fn metrics(&mut self) -> BTreeMap<String, Metric> {
        let (ux, uy) = (self.displacement(0), self.displacement(1));
        let (mean_stress, averaged) = self.mean_stress();
        let totals = self.simulation.totals();
        let time = self.simulation.time();
        let creep = self.creep();
        let stress_rms = rms(mean_stress.iter().copied());
        let board = rms(mean_stress.iter().zip(&averaged).map(|(s, a)| s - a));
        let window = (self.rest.window / time * self.work_residuals.len() as f64) as usize;
        let first_of_window = self.work_residuals.len().saturating_sub(window + 1);
        let mid_edge = self.probes.mid_edge.value(&uy);
        let edge_mean = self.probes.edge_mean(&uy);
        let tip = self.probes.tip.value(&uy);
        let mut values = vec![
            ("mid_edge_uy".to_owned(), mid_edge),
            ("edge_mean_uy".to_owned(), edge_mean),
            ("tip_uy".to_owned(), tip),
            ("tip_uy_nearest".to_owned(), uy[self.probes.tip_particle]),
            ("tip_ux".to_owned(), self.probes.tip.value(&ux)),
            (
                "mean_stress_rms_error".to_owned(),
                self.stress_error(&mean_stress),
            ),
            ("mean_stress_rms".to_owned(), stress_rms),
            ("checkerboard_rms".to_owned(), board),
            ("checkerboard_ratio".to_owned(), board / stress_rms),
            ("creep_rate".to_owned(), creep.map_or(f64::NAN, |l| l.slope)),
            (
                "creep_linearity".to_owned(),
                creep.map_or(f64::NAN, |l| l.r_squared),
            ),
            ("log_jacobian_gap".to_owned(), totals.log_jacobian_gap_rms),
            ("at_rest".to_owned(), f64::from(u8::from(self.at_rest))),
            ("rest_time".to_owned(), time),
            (
                "work_residual".to_owned(),
                self.work_residuals[first_of_window..]
                    .iter()
                    .copied()
                    .fold(0.0, f64::max),
            ),
            (
                "reaction_uy".to_owned(),
                -self.simulation.residual().held_force[1],
            ),
            ("mass".to_owned(), totals.mass),
            ("seeded_volume".to_owned(), totals.mass / self.density),
            (
                "energy_gain".to_owned(),
                self.energy_defect.0 / totals.accumulated.load_work,
            ),
            (
                "energy_loss".to_owned(),
                self.energy_defect.1 / totals.accumulated.load_work,
            ),
            ("period".to_owned(), self.period),
        ];
        for (name, probe) in &self.probes.stress {
            values.push((name.clone(), probe.value(&mean_stress)));
        }
        if let Ok(reference) = solution(&self.parameters) {
            for (name, value, exact) in [
                ("fem_mid_edge_error", mid_edge, reference.mid_edge.uy),
                ("fem_edge_mean_error", edge_mean, reference.edge_mean_uy),
                ("fem_tip_error", tip, reference.tip.uy),
            ] {
                values.push((name.to_owned(), value / exact - 1.0));
            }
        }
        observed(METRICS, values)
    }

    fn work(&self) -> WorkDone {
        self.simulation.work().into()
    }
}

#[cfg(test)]
mod tests {
    use super::super::PARAMETERS;
    use super::*;
    use mpm_core::stage::Load;

    #[test]
    fn the_papers_particle_counts_are_met_exactly() {
        assert_eq!(
            [2.0, 1.0, 0.5, 0.25].map(|h| seed(0.5 * h).len()),
            [1448, 5776, 23_072, 92_224]
        );
    }

    #[test]
    fn the_edge_load_has_its_resultant_on_the_side() {
        for name in ["edge", "column"] {
            let set = [format!("load_at={name}"), "load_ramp=0".to_owned()];
            let parameters = Parameters::new(&PARAMETERS, &set).unwrap();
            let mut particles = Particles::new(seed(0.5), 0.25, 1.0, [0.25; 2]).unwrap();
            for load in loads(&parameters, 1.0, 0.5, &particles.clone()) {
                load.add(0.0, &mut particles);
            }
            let force: f64 = particles.external_force.iter().map(|f| f[1]).sum();
            let moment: f64 = particles
                .external_force
                .iter()
                .zip(&particles.reference)
                .map(|(f, x)| f[1] * x[0])
                .sum();
            let arm = if name == "edge" { 48.0 } else { 47.75 };
            assert!((force - 1.0).abs() < 1e-12);
            assert!((moment - arm).abs() < 1e-10);
        }
    }
}
