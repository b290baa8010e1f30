//! Derived quantities, scene and observations of half of a strip on a square of soil, or of a quarter of a square on a cube.

use super::*;
use crate::cases::poro::{PER_CELL, above_rounding, kept, matrix_entries, outflow, volumes};
use crate::exact::clay::Clay;
use mpm_core::Error::{NoConvergence, Singular};
use mpm_core::material::CamClay;
use mpm_core::poro::{Face, Settings, Tangent};
use std::array::from_fn;

/// Side of the soil (m).
pub(super) const SIDE: f64 = 5.0;
/// Empty ground above the surface (m).
const ROOM: f64 = 1.0;
/// The base, among the scene's constraints.
const BASE: Part = Part::Constraint(0);
/// Distance from the strip's edge, over its half width, within which the solution is not smooth.
const NEAR: f64 = 0.5;
/// Particles are kept after each of this number of parts of the steps.
const QUARTERS: u64 = 4;

impl Setup<Strip> {
    /// Bulk modulus (Pa) of the soil at rest.
    pub(super) fn bulk(&self) -> f64 {
        self.young_modulus / (3.0 * (1.0 - 2.0 * self.poisson_ratio))
    }

    pub(super) fn is_plastic(&self) -> bool {
        self.law == Soil::CamClay
    }

    pub(super) fn is_driven(&self) -> bool {
        self.control == Control::Settlement
    }

    /// Load on the whole surface (Pa).
    fn surcharge(&self) -> f64 {
        if self.is_plastic() { self.initial_pressure } else { 0.0 }
    }

    fn elasticity(&self) -> Result<ImprovedHencky, Fault> {
        ImprovedHencky::new(self.bulk() * self.porosity, self.shear_modulus(), self.porosity)
    }

    pub(super) fn clay(&self) -> Result<CamClay, Fault> {
        let clay = CamClay::new(
            self.elasticity()?,
            self.critical_ratio,
            self.plastic_compressibility,
            self.preconsolidation,
            self.initial_pressure,
        )?;
        clay.shaped(self.shape_alpha, self.shape_gamma)
    }

    /// The clay by itself.
    pub(super) fn exact(&self) -> Clay {
        Clay {
            porosity: self.porosity,
            moduli: [self.bulk(), self.shear_modulus()],
            critical_ratio: self.critical_ratio,
            plastic_compressibility: self.plastic_compressibility,
            preconsolidation: self.preconsolidation,
            initial_pressure: self.initial_pressure,
            gamma: self.shape_gamma,
        }
    }

    /// Duration of a step (s).
    fn step(&self) -> f64 {
        self.duration / f64::from(self.steps)
    }

    /// Part of the strip, or of the square, in the scene (m or m²).
    fn area(&self, dimension: usize) -> f64 {
        self.half_width.powi(dimension as i32 - 1)
    }

    /// Distance of particles (m).
    fn spacing(&self) -> f64 {
        self.h / PER_CELL as f64
    }

    /// Particles along an edge.
    fn row(&self) -> usize {
        (SIDE / self.spacing()).round() as usize
    }

    /// Place of a particle along every axis at the start.
    fn place<const D: usize>(&self, reference: &[f64; D]) -> [usize; D] {
        reference.map(|x| (x / self.spacing()).floor() as usize)
    }

    /// Places of the particles, as their pressures are stored.
    fn places<const D: usize>(&self) -> impl Iterator<Item = [usize; D]> + use<D> {
        let row = self.row();
        (0..row.pow(D as u32)).map(move |k| from_fn(|a| k / row.pow(a as u32) % row))
    }

    /// Settlement of the particle next to the axis at the surface, over the half width.
    fn settlement<const D: usize>(&self, run: &dyn Simulation<D>) -> f64 {
        let p = run.particles();
        let mut top = [0; D];
        top[D - 1] = self.row() - 1;
        let next = p.reference.iter().position(|x| self.place(x) == top);
        next.map_or(f64::NAN, |k| (p.reference[k][D - 1] - p.position[k][D - 1]) / self.half_width)
    }

    /// Load on the strip (Pa) beside that on the whole surface.
    fn current_load<const D: usize>(&self, run: &dyn Simulation<D>) -> f64 {
        if self.is_driven() {
            // Among the scene's constraints the strip is behind the base and two sides an axis.
            run.on(Part::Constraint(1 + 2 * (D - 1))).force[D - 1] / self.area(D)
        } else {
            self.load * run.time() / self.duration
        }
    }

    /// Pressure over the load of the particles, row by row as they were at the start; NaN without a particle.
    fn pressures<const D: usize>(&self, run: &mut dyn Simulation<D>, over: f64) -> Vec<f64> {
        let field = run.field(Field::PorePressure);
        let row = self.row();
        let mut all = vec![f64::NAN; row.pow(D as u32)];
        for (p, x) in field.iter().zip(&run.particles().reference) {
            let k = self.place(x).iter().rev().fold(0, |k, i| k * row + i);
            if let Some(value) = all.get_mut(k) {
                *value = p / over;
            }
        }
        all
    }

    /// Whether a particle in this place was not near the strip's edge.
    fn is_far<const D: usize>(&self, place: [usize; D]) -> bool {
        let from_edge = place.map(|k| (k as f64 + 0.5) * self.spacing() - self.half_width);
        let across = &from_edge[..D - 1];
        let inside = across.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
        let outside = across.iter().map(|x| x.max(0.0).powi(2)).sum::<f64>();
        let across = if inside < 0.0 { inside } else { outside.sqrt() };
        let depth = from_edge[D - 1] + self.half_width - SIDE;
        across.hypot(depth) > NEAR * self.half_width
    }

    /// Relative error of the settlement of clay under a load on its whole surface.
    fn uniform_error<const D: usize>(&self, run: &dyn Simulation<D>) -> f64 {
        let is_ellipse = self.shape_alpha == 1.0 && self.shape_gamma == 1.0;
        if !(self.half_width == SIDE && self.is_plastic() && is_ellipse) {
            return f64::NAN;
        }
        let p = run.particles();
        let volume = |of: &[f64]| of.iter().sum::<f64>();
        let settled = 1.0 - volume(&p.volume) / volume(&p.reference_volume);
        (settled / self.exact().uniform_settlement(self.load) - 1.0).abs()
    }

    fn roughness<const D: usize>(&self, all: &[f64]) -> f64 {
        let row = self.row();
        let is_inner = |place: &[usize; D]| place.iter().all(|i| (1..row - 1).contains(i));
        let inner = self.places().enumerate().filter(|(_, place)| is_inner(place) && self.is_far(*place));
        rms(inner.map(|(k, _)| {
            let sum: f64 = (0..D).map(|a| row.pow(a as u32)).map(|next| all[k - next] + all[k + next]).sum();
            all[k] - sum / (2 * D) as f64
        }))
    }

    /// Distances of the pressures over the load from the reference's; of a square, of the particles next to a plane of symmetry.
    fn pressure_errors<const D: usize>(&self, pressures: &[f64], far: bool) -> impl Iterator<Item = f64> {
        let known = self.reference();
        let here = |place: &[usize; D]| place[1..D - 1].iter().all(|i| *i == 0);
        let places = self.places::<D>().zip(pressures);
        let places = places.filter(move |(place, _)| here(place) && (!far || self.is_far(*place)));
        places.map(move |(place, p)| known.map_or(f64::NAN, |s| p - s.pressure(place[0], place[D - 1])))
    }

    fn ground<const D: usize>(&self) -> Begun<D> {
        let law: SharedLaw = if self.is_plastic() { self.clay()?.into() } else { self.elasticity()?.into() };
        let (h, up) = (self.h, D - 1);
        let cells = |length: f64| (length / h).round() as usize;
        let mut axes = [Axis::walls(0.0, cells(SIDE)); D];
        axes[up] = Axis::bounded(0.0, cells(SIDE + ROOM), (Side::Wall, Side::Open));
        let grid = Grid::new(h, axes)?;
        let spacing = self.spacing();
        // Nothing moves by its weight: any density will do.
        let particles = self.particles_at(by_rows([cells(SIDE) * PER_CELL; D], spacing), spacing, 1000.0)?;
        let scene = Scene::new(grid, Bodies::new(law, particles)?)
            .constrain(clamp(up, End::Lo))
            .constrain_all((0..up).flat_map(|axis| [End::Lo, End::Hi].map(|end| roller(axis, end))));
        let (kappa, porosity) = (self.kappa(), self.porosity);
        // c n³/(1 − n)² is κ₀ at n₀.
        let c = kappa * (1.0 - porosity).powi(2) / porosity.powi(3);
        let surface = move |x: &[f64; D]| x[up] > SIDE - spacing;
        let downward = move |pressure: f64| from_fn(|a| if a == up { -pressure } else { 0.0 });
        let (particles, top) = (&scene.bodies.particles, (up, End::Hi));
        let drained = Face::drained(particles, surface, top, self.drain * kappa / h);
        let mut water = Water::new(porosity, Conductivity::KozenyCarman(c)).face(drained);
        let rests = self.surcharge();
        if rests > 0.0 {
            water = water.face(Face::loaded(particles, surface, top, move |_| downward(rests)));
        }
        let (half_width, load, duration) = (self.half_width, self.load, self.duration);
        let scene = if self.is_driven() {
            let mut extent = [[f64::NEG_INFINITY, half_width]; D];
            extent[up] = [SIDE, f64::INFINITY];
            let mut velocity = [None; D];
            velocity[up] = Some(-self.penetration / duration);
            scene.constrain(RigidNodes { extent, velocity, amplitude: Amplitude::Rise(0.0) })
        } else {
            let under = move |x: &[f64; D]| surface(x) && x[..up].iter().all(|x| *x < half_width);
            water = water.face(Face::loaded(particles, under, top, move |t| downward(load * t / duration)));
            scene
        };
        let settings = Settings {
            pressure_space: self.pressure_space(self.projection / (2.0 * self.shear_modulus())),
            tangent: Tangent::Consistent,
            tolerance: self.tolerance,
            ..Settings::new(self.step()).ghosts(self.ghost_displacement, self.ghost_pressure)
        };
        mpm_solvers::poro(self.scheme, scene, water, settings)
    }
}

#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
    /// Whether a step had no solution.
    stopped: bool,
    turnover: f64,
    most: u64,
    /// Settlement (m) and load (Pa) after every step.
    path: Vec<[f64; 2]>,
}

impl Seen {
    /// Load (Pa) at a settlement (m), by a straight line between steps; NaN where it was not reached.
    fn load_at(&self, settlement: f64) -> f64 {
        let begun = [[0.0; 2]];
        let mut parts = begun.iter().chain(&self.path).zip(&self.path);
        let part = parts.find(|(_, after)| after[0] >= settlement);
        part.map_or(f64::NAN, |([s, q], [t, r])| q + (r - q) * (settlement - s) / (t - s))
    }

    fn growth(&self) -> f64 {
        let of = |k: usize| self.path.get(k).map_or(f64::NAN, |at| at[1]);
        let all = self.path.len();
        1.0 - of((3 * all / 4).saturating_sub(1)) / of(all.saturating_sub(1))
    }
}

impl<const D: usize> Problem<D> for Setup<Strip> {
    type Parameters = Strip;
    type Seen = Seen;

    fn new(setup: Self) -> Result<Self, Error> {
        if !setup.is_plastic() && !setup.is_driven() {
            let strain = setup.load / (setup.bulk() + 4.0 / 3.0 * setup.shear_modulus());
            let why = "where soil that stays as stiff as at rest would keep no height";
            require_quotient("load / M of young_modulus", strain, 0.0..=1.0, why)?;
        }
        if D == 3 && setup.is_plastic() {
            return Err(Error::Input(format!(
                "{} = {} has no meaning with dimension = 3; allowed: {}",
                LAW.name,
                setup.values.text(LAW),
                LAW.default
            )));
        }
        Ok(setup)
    }

    fn discretisation(&self) -> Discretisation {
        self.discretisation(D, PER_CELL.pow(D as u32), self.step())
    }

    fn begin(&self, _: &Seen) -> Begun<D> {
        self.ground()
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<D>) -> Result<Row, Fault> {
        let iterations = phase.run.work().newton_iterations;
        let before = volumes(phase.run.as_ref());
        match phase.steps(1) {
            // The clay's limit is reached. The result of the last parts is a state like others.
            Err(NoConvergence { .. } | Singular { .. }) if self.is_plastic() => seen.stopped = true,
            other => other?,
        }
        seen.steps += 1;
        let run = phase.run.as_ref();
        let changes = before.iter().zip(volumes(run));
        seen.turnover += changes.map(|(before, after)| (after - before).abs()).sum::<f64>();
        let taken = run.work().newton_iterations - iterations;
        if !seen.stopped {
            seen.most = seen.most.max(taken);
        }
        let [settlement, load] = [self.settlement(run), self.current_load(run)];
        seen.path.push([settlement * self.half_width, load]);
        let water = if D == 2 { "outflow (m²)" } else { "outflow (m³)" };
        Ok(Row(vec![
            ("time (s)", run.time()),
            ("load (Pa)", load),
            ("settlement (-)", settlement),
            (water, outflow(run)),
            ("newton_iterations (-)", taken as f64),
            ("parts (-)", run.convergence().map_or(f64::NAN, |c| c.parts.into())),
        ]))
    }

    fn progress(&self, seen: &Seen, _: &Phase<D>) -> f64 {
        if seen.stopped {
            return 1.0;
        }
        seen.steps as f64 / f64::from(self.steps)
    }

    fn snapshot(&self, seen: &Seen, phase: &mut Phase<D>) -> Option<Snapshot> {
        let all = self.steps as u64;
        let quarter = all.is_multiple_of(QUARTERS) && seen.steps.is_multiple_of(all / QUARTERS);
        (quarter && (1..all).contains(&seen.steps)).then(|| self.snapshot_at(phase.run.time(), seen, phase))
    }

    fn particles<'a>(&self, _: &Seen, columns: Columns<'a, D>) -> Columns<'a, D> {
        kept(columns)
            .each("effective_stress_yy", "Pa", |p, k| p.stress[k].yy)
            .each("effective_stress_xy", "Pa", |p, k| p.stress[k].xy)
            .field("plastic_strain", "-", Field::PlasticStrain)
            .jacobian()
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let last = self.current_load(phase.run.as_ref());
        let pressures = self.pressures(phase.run.as_mut(), last);
        let strain = phase.run.field(Field::PlasticStrain);
        let (limit, growth) = match self.is_driven() {
            true => (last, seen.growth()),
            false => (seen.load_at(self.penetration), f64::NAN),
        };
        let run = phase.run.as_ref();
        let settlement = self.settlement(run);
        let swept = settlement * self.half_width * self.area(D);
        let lost = run.water().map_or(f64::NAN, |w| (w.imbalance / swept).abs());
        let rests = self.surcharge() * SIDE.powi(D as i32 - 1);
        let all = last * self.area(D) + rests;
        let held = -run.on(BASE).force[D - 1];
        let (ratio, largest) = self.reference().map_or((f64::NAN, f64::NAN), |s| {
            let far = self.pressure_errors::<D>(&pressures, true);
            (
                settlement * self.half_width * self.shear_modulus() / (self.load * s.settlement),
                far.fold(0.0, |a, b| b.abs().max(a)),
            )
        });
        let least = pressures.iter().copied().fold(f64::INFINITY, f64::min);
        let most = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        vec![
            (SETTLEMENT, settlement),
            (SETTLEMENT_RATIO, ratio),
            (PRESSURE_ERROR, rms(self.pressure_errors::<D>(&pressures, false))),
            (PRESSURE_ERROR_LARGEST, largest),
            (ROUGHNESS, self.roughness::<D>(&pressures)),
            (LEAST_PRESSURE, least),
            (MOST_PRESSURE, most),
            (LAST_LOAD, last),
            (LIMITING_LOAD, limit),
            (GROWTH, growth),
            (UNIFORM_ERROR, self.uniform_error(run)),
            (PLASTIC_STRAIN, strain.into_iter().fold(0.0, f64::max)),
            (SUPPORT_ERROR, above_rounding((held / all - 1.0).abs())),
            (MASS_ERROR, above_rounding(lost)),
            (TURNOVER, seen.turnover / swept),
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (MOST_ITERATIONS, seen.most as f64),
            (ENTRIES, matrix_entries(run)),
        ]
    }
}
