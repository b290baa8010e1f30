//! The simulation of the strip footing: ground, footing, observation.

use super::METRICS;
use super::reference::{CURVE, EXACT, mean_stresses};
use crate::case::{Column, Job, RunSpec, observed};
use crate::error::Error;
use crate::parameter::Parameters;
use crate::probe::PointProbe;
use crate::record::{Discretisation, Metric, WorkDone};
use crate::scheme::BasisName;
use crate::statistics::{fit_line, rms};
use mpm_core::basis::WallTreatment;
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::explicit::transfer::Flip;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{HenckyJ2, Law, Strength};
use mpm_core::memory::{Memory, MemoryError, Saved};
use mpm_core::stage::{End, LocalDamping, RigidNodes, Wall, WallKind, smooth_stroke};
use mpm_core::{Axis, Body, Field, Grid, Part, Particles, Scene, Side, Simulation};
use mpm_solvers::solver;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Width B of the footing (m); its right half is simulated.
pub(super) const WIDTH: f64 = 1.0;
/// The part of the surface (m from the axis) that is well inside of what Prandtl's mechanism pushes up.
const BESIDE: (f64, f64) = (0.75 * WIDTH, 1.25 * WIDTH);
/// Cells of the grid above the surface.
const ROOM: usize = 3;
/// Penetration over B between two rows of the series.
const ROW: f64 = 1e-5;
/// The last share of the penetration, over which the plateau and the mechanism are observed.
const PLATEAU: f64 = 0.25;
/// Half of the window of penetration over B in which the curve is averaged.
const WINDOW: f64 = 5e-5;
/// Places of constraints in the scene's list.
const BASE: usize = 0;
const FOOTING: usize = 3;
/// Reach d̂ of the barrier over the cell size.
const REACH: f64 = 0.25;
/// Share of its reach by which the barrier gives way under Prandtl's pressure.
const GIVES_WAY: f64 = 0.002;

/// What presses on the ground.
enum Press {
    /// Held nodes.
    RigidNodes,
    /// A barrier on so many particles.
    Barrier(Barrier, f64),
}

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

/// A running simulation.
pub(super) struct Simulated {
    simulation: Box<dyn Simulation<2>>,
    press: Press,
    discretisation: Discretisation,
    parameters: Parameters,
    effective_width: f64,
    steps_per_row: u64,
    end: f64,
    rows: Vec<Row>,
    /// Positions (m), in seeding order, where the observation of the plateau begins.
    before_plateau: Vec<[f64; 2]>,
}

/// Cells of size `h` (m) in a domain of `widths` footings.
fn cells(widths: f64, h: f64) -> usize {
    (widths * WIDTH / h).round() as usize
}

/// The width (m) that a footing of held nodes acts with, and how well it is known: up to the middle between the last
/// held node and the first free one. Quadratic splines have their nodes in the middle of cells, the others on grid
/// lines. Between cubic splines the velocity falls from that of the footing a cell inside of its edge to that of the
/// free ground two cells outside: the place is known to half a cell at either end.
pub(super) fn effective_width(basis: BasisName, h: f64) -> (f64, f64) {
    match basis {
        BasisName::Bspline2 => (WIDTH, 0.0),
        BasisName::Linear | BasisName::Gimp => (WIDTH + h, 0.0),
        BasisName::Bspline3 => (WIDTH + 0.5 * h, 0.5 * h),
    }
}

/// How far (m) from the axis of a footing of [`WIDTH`] the ground rises at the limit load: Prandtl's mechanism under a
/// rough one, Hill's, half as large, under a smooth one.
pub(super) fn mechanism_extent(rough: bool) -> f64 {
    WIDTH * if rough { 1.5 } else { 1.0 }
}

impl Simulated {
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let h = spec.level.h;
        let number = |name| parameters.number(name);
        let strength = Strength::undrained(number("undrained_strength"))?;
        let law = HenckyJ2::new(number("young_modulus"), number("poisson_ratio"), strength)?;
        let density = number("density");
        let dt = courant_time_step(number("cfl"), h, law.wave_speed(density));
        let (across, down) = (
            cells(number("domain_width"), h),
            cells(number("domain_depth"), h),
        );
        let grid = Grid::new(
            h,
            [
                Axis::walls(0.0, across),
                Axis::bounded(-(down as f64) * h, down + ROOM, (Side::Wall, Side::Open)),
            ],
        )?;
        let per_direction = number("ppc_per_direction");
        let spacing = h / per_direction;
        let particles = Particles::new(
            spec.start_at(seed(across, down, per_direction as usize, spacing)),
            spacing * spacing,
            density,
            [0.5 * spacing; 2],
        )?;
        let rate = number("penetration_rate");
        let mut settings = Settings::new(dt)
            .wall(if parameters.is("wall", "wall-line") {
                WallTreatment::WallLine
            } else {
                WallTreatment::OpenKnot
            })
            .transfer(Flip::new(number("flip"))?)
            .remedy(spec.scheme.remedy().build());
        if number("damping") > 0.0 {
            settings = settings.filter_forces(LocalDamping::new(number("damping"))?);
        }
        let ground = Scene::new(grid, Body::new(law, particles)?).constrain_all(walls());
        let (scene, press) = if parameters.is("contact", "barrier") {
            let force = EXACT * number("undrained_strength") * spacing;
            let reach = REACH * h;
            let gap = (1.0 - GIVES_WAY) * reach;
            let barrier = Barrier::carrying_at(force, gap, reach)?;
            let face = RigidFace::half_space(1, End::Hi, 0.0)?
                .within([[f64::NEG_INFINITY, 0.5 * WIDTH], [0.0; 2]])
                .touching(&ground.body.particles, reach)
                .moving([0.0, -rate], number("ramp"))?;
            let mut contact = RigidContact::new(face, barrier);
            if parameters.boolean("rough") {
                contact = contact.with_friction(Friction::rough(barrier.stiffness(gap))?);
            }
            let pressing = (0.5 * WIDTH / spacing).round();
            (ground.contact(contact), Press::Barrier(barrier, pressing))
        } else {
            (ground.constrain(footing(parameters, h)), Press::RigidNodes)
        };
        let simulation = solver(spec.scheme, scene, settings)?;
        Ok(Self {
            simulation,
            press,
            discretisation: Discretisation {
                dim: 2,
                h,
                ppc: (per_direction * per_direction) as u32,
                dt,
                wall: parameters.text("wall"),
            },
            parameters: parameters.clone(),
            effective_width: effective_width(spec.scheme.basis(), h).0,
            steps_per_row: ((ROW * WIDTH / rate / dt).round() as u64).max(1),
            end: number("penetration"),
            rows: Vec::new(),
            before_plateau: Vec::new(),
        })
    }

    /// Penetration of the footing over B at `time` (s): the integral of its velocity.
    fn stroke(&self, time: f64) -> f64 {
        let number = |name| self.parameters.number(name);
        number("penetration_rate") * smooth_stroke(time, number("ramp")) / WIDTH
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
    fn force_on_footing(&self) -> f64 {
        match self.press {
            Press::RigidNodes => self.simulation.on(Part::Constraint(FOOTING)).force[1],
            Press::Barrier(..) => self.simulation.on(Part::Contact(0)).force[1],
        }
    }

    fn strength(&self) -> f64 {
        self.parameters.number("undrained_strength")
    }

    /// Pressure over the undrained strength of a force (N/m) on half of a footing of `width` (m).
    fn bearing_factor(&self, force: f64, width: f64) -> f64 {
        force / (0.5 * width) / self.strength()
    }

    fn on_plateau(&self) -> impl Iterator<Item = &Row> {
        let first = (1.0 - PLATEAU) * self.end;
        self.rows.iter().filter(move |r| r.penetration > first)
    }

    /// Mean of a quantity of the rows of which `keep` holds; NaN if there are none.
    fn mean(&self, keep: impl Fn(&Row) -> bool, f: impl Fn(&Row) -> f64) -> f64 {
        let kept: Vec<f64> = self.rows.iter().filter(|r| keep(r)).map(f).collect();
        kept.iter().sum::<f64>() / kept.len() as f64
    }

    /// Relative growth of the load per 10⁻³ of penetration over B on the plateau.
    fn rise(&self, mean_force: f64) -> f64 {
        let points: Vec<(f64, f64)> = self
            .on_plateau()
            .map(|r| (r.penetration, r.force / mean_force))
            .collect();
        fit_line(&points).map_or(f64::NAN, |line| 1e-3 * line.slope)
    }

    /// d(q/s_u)/d(s/B), fitted after the start over all rows.
    fn slope(&self) -> f64 {
        let begun = 2.0 * self.stroke(self.parameters.number("ramp"));
        let points: Vec<(f64, f64)> = self
            .rows
            .iter()
            .filter(|r| r.penetration > begun)
            .map(|r| (r.penetration, self.bearing_factor(r.force, WIDTH)))
            .collect();
        fit_line(&points).map_or(f64::NAN, |line| line.slope)
    }

    /// Displacement (m) of every particle over the plateau, in seeding order; none before it begins.
    fn flow(&self) -> Vec<[f64; 2]> {
        let p = self.simulation.particles();
        let now = p.seeded(|k| p.position[k]);
        let displacement = |k: usize, x: &[f64; 2]| {
            let before = self.before_plateau.get(k).unwrap_or(x);
            [x[0] - before[0], x[1] - before[1]]
        };
        now.iter()
            .enumerate()
            .map(|(k, x)| displacement(k, x))
            .collect()
    }

    /// Places (m) from the axis and rises (m) of the particles at the surface over the plateau, from the axis outward.
    fn surface(&self) -> Vec<(f64, f64)> {
        let spacing = self.discretisation.h / f64::from(self.discretisation.ppc).sqrt();
        let p = self.simulation.particles();
        let reference = p.seeded(|k| p.reference[k]);
        let on_surface = |x: &[f64; 2]| x[1] > -0.75 * spacing;
        let mut surface: Vec<(f64, f64)> = (reference.iter().zip(self.flow()))
            .filter(|(x, _)| on_surface(x))
            .map(|(x, u)| (x[0], u[1]))
            .collect();
        surface.sort_by(|a, b| a.0.total_cmp(&b.0));
        surface
    }

    /// Half the width (in B) of the ground that rises while the footing sinks over the plateau: the outermost
    /// place where the surface rises by half of what it does in the mechanism of the limit load.
    fn mechanism_width(&self) -> f64 {
        let surface = self.surface();
        // The ground does not change its volume: as much rises beside the footing as sinks under it.
        let beside = mechanism_extent(self.parameters.boolean("rough")) - 0.5 * WIDTH;
        let sinking = surface.first().map_or(f64::NAN, |(_, rise)| -rise);
        let half = 0.5 * sinking * 0.5 * WIDTH / beside;
        surface
            .windows(2)
            .rev()
            .find(|pair| pair[0].1 >= half && pair[1].1 < half)
            .map_or(f64::NAN, |pair| {
                let share = (pair[0].1 - half) / (pair[0].1 - pair[1].1);
                (pair[0].0 + share * (pair[1].0 - pair[0].0)) / WIDTH
            })
    }

    /// Mean rise of the surface within [`BESIDE`] over the plateau, over what the footing sinks.
    fn heave(&self) -> f64 {
        let surface = self.surface();
        let sinking = surface.first().map_or(f64::NAN, |(_, rise)| -rise);
        let rises: Vec<f64> = (surface.iter())
            .filter(|(x, _)| (BESIDE.0..BESIDE.1).contains(x))
            .map(|(_, rise)| *rise)
            .collect();
        rises.iter().sum::<f64>() / rises.len() as f64 / sinking
    }

    /// Mean normal stress as it enters the forces and its average Π, in seeding order.
    fn mean_stress(&mut self) -> (Vec<f64>, Vec<f64>) {
        let mean = self.simulation.field(Field::MeanStress);
        let averaged = self.simulation.field(Field::AveragedMeanStress);
        let p = self.simulation.particles();
        (p.seeded(|k| mean[k]), p.seeded(|k| averaged[k]))
    }
}

/// Particles row by row from the surface down, in columns from the axis of symmetry.
fn seed(across: usize, down: usize, per_direction: usize, spacing: f64) -> Vec<[f64; 2]> {
    let coordinate = |k: usize| (k as f64 + 0.5) * spacing;
    (0..across * per_direction)
        .flat_map(|i| (0..down * per_direction).map(move |j| [coordinate(i), -coordinate(j)]))
        .collect()
}

/// The fixed base and rollers at the sides.
fn walls() -> [Wall; 3] {
    let wall = |axis, end, kind| Wall { axis, end, kind };
    [
        wall(1, End::Lo, WallKind::Fixed),
        wall(0, End::Lo, WallKind::Roller),
        wall(0, End::Hi, WallKind::Roller),
    ]
}

/// The footing as held nodes: those on and above the surface, and those of the splines with nodes in the middle of
/// cells that lie half a cell below, without which the surface would not be rigid.
fn footing(parameters: &Parameters, h: f64) -> RigidNodes<2> {
    RigidNodes {
        extent: [[f64::NEG_INFINITY, 0.5 * WIDTH], [-0.5 * h, f64::INFINITY]],
        velocity: [
            parameters.boolean("rough").then_some(0.0),
            Some(-parameters.number("penetration_rate")),
        ],
        ramp: parameters.number("ramp"),
    }
}

impl Memory for Simulated {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.simulation.save()?, &self.rows, &self.before_plateau))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let simulation: Saved;
        (simulation, self.rows, self.before_plateau) = saved.read("the strip footing")?;
        self.simulation.restore(&simulation)
    }
}

impl Job for Simulated {
    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn series_columns(&self) -> Vec<&'static str> {
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

    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error> {
        let (mut force, mut base, mut time) = (0.0, 0.0, 0.0);
        for _ in 0..self.steps_per_row {
            time += self.simulation.time();
            self.simulation.step()?;
            force += self.force_on_footing();
            base -= self.simulation.on(Part::Constraint(BASE)).force[1];
        }
        let steps = self.steps_per_row as f64;
        // Forces are those at the start of a step.
        let row = Row {
            penetration: self.stroke(time / steps) - self.lost(force / steps),
            force: force / steps,
            base: base / steps,
        };
        self.rows.push(row);
        let reached = self.stroke(self.simulation.time());
        if self.before_plateau.is_empty() && reached >= (1.0 - PLATEAU) * self.end {
            let p = self.simulation.particles();
            self.before_plateau = p.seeded(|k| p.position[k]);
        }
        let totals = self.simulation.totals();
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

    fn finished(&self) -> bool {
        self.progress() >= 1.0
    }

    fn progress(&self) -> f64 {
        (self.stroke(self.simulation.time()) / self.end).min(1.0)
    }

    fn particles(&mut self) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let (mean_stress, averaged) = self.mean_stress();
        let plastic_strain = self.simulation.field(Field::PlasticStrain);
        let flow = self.flow();
        let p = self.simulation.particles();
        let of = |axis: usize| flow.iter().map(|u| u[axis]).collect();
        vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("reference_x", "m", p.seeded(|k| p.reference[k][0])),
            column("reference_y", "m", p.seeded(|k| p.reference[k][1])),
            column("plateau_ux", "m", of(0)),
            column("plateau_uy", "m", of(1)),
            column("mean_stress", "Pa", mean_stress),
            column("averaged_mean_stress", "Pa", averaged),
            column("plastic_strain", "-", p.seeded(|k| plastic_strain[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]
    }

    fn metrics(&mut self) -> BTreeMap<String, Metric> {
        let (mean_stress, averaged) = self.mean_stress();
        let totals = self.simulation.totals();
        let first = (1.0 - PLATEAU) * self.end;
        let force = self.mean(|r| r.penetration > first, |r| r.force);
        let base = self.mean(|r| r.penetration > first, |r| r.base);
        let most = self.rows.iter().map(|r| r.force).fold(0.0, f64::max);
        let h = self.discretisation.h;
        let effective = self.bearing_factor(force, self.effective_width);
        let stress_rms = rms(mean_stress.iter().copied());
        let board = rms(mean_stress.iter().zip(&averaged).map(|(s, a)| s - a));
        let mut values = vec![
            ("nc_b".to_owned(), self.bearing_factor(force, WIDTH)),
            (
                "nc_b_plus_h".to_owned(),
                self.bearing_factor(force, WIDTH + h),
            ),
            ("nc_effective".to_owned(), effective),
            (
                "prandtl_error".to_owned(),
                self.bearing_factor(force, WIDTH) / EXACT - 1.0,
            ),
            ("nc_peak".to_owned(), self.bearing_factor(most, WIDTH)),
            ("plateau_rise".to_owned(), self.rise(force)),
            ("elastic_slope".to_owned(), self.slope()),
            ("force_imbalance".to_owned(), base / force - 1.0),
            ("mechanism_width".to_owned(), self.mechanism_width()),
            ("heave".to_owned(), self.heave()),
            ("mean_stress_rms".to_owned(), stress_rms),
            ("checkerboard_rms".to_owned(), board),
            ("checkerboard_ratio".to_owned(), board / stress_rms),
            (
                "plastic_strain_max".to_owned(),
                self.simulation
                    .field(Field::PlasticStrain)
                    .into_iter()
                    .fold(0.0, f64::max),
            ),
            ("log_jacobian_gap".to_owned(), totals.log_jacobian_gap_rms),
            ("mass".to_owned(), totals.mass),
        ];
        let p = self.simulation.particles();
        let references = p.seeded(|k| p.reference[k]);
        for point in mean_stresses() {
            let probe = PointProbe::new(&references, [point.x, point.y], 2.0 * h);
            let value = probe.map_or(f64::NAN, |p| p.value(&mean_stress));
            values.push((point.metric(), value / self.strength()));
        }
        for (name, penetration) in CURVE {
            let near = |r: &Row| (r.penetration - penetration).abs() <= WINDOW;
            let force = if penetration + WINDOW <= self.end {
                self.mean(near, |r| r.force)
            } else {
                f64::NAN
            };
            values.push(((*name).to_owned(), self.bearing_factor(force, WIDTH)));
        }
        observed(METRICS, values)
    }

    fn work(&self) -> WorkDone {
        self.simulation.work().into()
    }
}
