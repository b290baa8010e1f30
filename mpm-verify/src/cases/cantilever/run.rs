//! Scene and observations of the cantilever, load step by load step; the time is the share of the weight.

use super::edge::{Edge, extremes};
use super::*;
use crate::cases::build::DENSITY;
use mpm_core::implicit::{Serendipity, Settings};
use mpm_core::material::Hypoelastic;
use mpm_solvers::implicit;

/// Length and depth (m).
pub(super) const LENGTH: f64 = 1.0;
pub(super) const DEPTH: f64 = 0.3;
/// Room of the grid (m): beyond the tip, below and above.
const ROOM: (f64, f64, f64) = (0.2, 0.9, 0.2);
/// Allowed weight over Young's modulus (1/m) in units of 1/(1 + ν): at the greatest the shear w L²/(2 G) of the beam alone
/// moves the tip by the room below, and at the least the rounding of stresses is a percent of the loads.
const WEIGHT_OVER_MODULUS: RangeInclusive<f64> = 1e-9..=ROOM.1 / (LENGTH * LENGTH);

/// Coordinates (m) of `count` particles along an axis, which stand for `spacing` (m) each.
fn along(count: usize, spacing: f64, gauss: bool) -> Vec<f64> {
    let offset = 0.5 - 0.5 / 3.0_f64.sqrt();
    let place = |k: usize| match (gauss, k % 2) {
        (false, _) => spacing * (k as f64 + 0.5),
        (true, 0) => spacing * (k as f64 + 2.0 * offset),
        (true, _) => spacing * (k as f64 + 1.0 - 2.0 * offset),
    };
    (0..count).map(place).collect()
}

/// Number of pieces of size `h` (m) along a length (m).
fn cells(length: f64, h: f64) -> usize {
    (length / h - 1e-9).ceil() as usize
}

/// The volume that is seeded (m³ per metre of depth).
pub(super) const VOLUME: f64 = LENGTH * DEPTH;

impl Setup<Cantilever> {
    /// Length and depth (m) of an element: a cell, or a serendipity element of 2 by 3 cells.
    fn element(&self) -> [f64; 2] {
        if self.basis() == Q8 { Serendipity::SPAN.map(|cells| cells as f64 * self.cell()) } else { [self.h; 2] }
    }

    /// Cell size (m) of the grid.
    fn cell(&self) -> f64 {
        if self.basis() == Q8 { self.h / Serendipity::SPAN[0] as f64 } else { self.h }
    }

    /// Particles along the length and the depth.
    pub(super) fn counts(&self) -> [usize; 2] {
        let [length, depth] = self.element();
        [cells(LENGTH, length), cells(DEPTH, depth)].map(|elements| elements * self.points_per_direction)
    }

    /// Initial positions (m) of the particles, column by column.
    pub(super) fn seed(&self) -> Vec<[f64; 2]> {
        let per_cell = self.points_per_direction;
        // One of an odd number stands in the middle either way.
        let gauss = self.points == Points::Gauss && per_cell.is_multiple_of(2);
        let [xs, ys] = [0, 1].map(|a| along(self.counts()[a], self.element()[a] / per_cell as f64, gauss));
        self.start_at(xs.iter().flat_map(|x| ys.iter().map(|y| [*x, *y]).collect::<Vec<_>>()))
    }

    pub(super) fn scene(&self) -> Begun<2> {
        let (young, ratio) = (self.young_modulus, self.poisson_ratio);
        let law: SharedLaw = match self.law {
            LawName::Hencky => Hencky::new(young, ratio)?.into(),
            LawName::NeoHookean => NeoHookean::new(young, ratio)?.into(),
            LawName::Jaumann => Hypoelastic::new(young, ratio, JaumannUpdate::Split)?.into(),
            LawName::JaumannLinear => Hypoelastic::new(young, ratio, JaumannUpdate::Linear)?.into(),
        };
        let (h, element) = (self.cell(), self.element());
        let per_cell = self.points_per_direction as f64;
        let volume = element[0] * element[1] / (per_cell * per_cell);
        // Whole elements.
        let count = |axis: usize, length: f64| cells(length, element[axis]) * (element[axis] / h).round() as usize;
        let (beyond, below, above) = ROOM;
        let lower = count(1, below);
        let along = Axis::bounded(0.0, count(0, LENGTH + beyond), (Side::Wall, Side::Open));
        let up = Axis::open(-h * lower as f64, lower + count(1, DEPTH + above));
        let particles = Particles::new(self.seed(), volume, DENSITY, [0.5 * h / per_cell; 2])?;
        let weight = self.weight / DENSITY;
        let scene = Scene::new(Grid::new(h, [along, up])?, Bodies::new(law, particles)?)
            .constrain(clamp(0, End::Lo))
            .load(BodyForce(Box::new(move |_, share| [0.0, -weight * share])));
        let stabilisation = match self.stabilisation {
            Stabilised::None => Stabilisation::None,
            Stabilised::Soft => Stabilisation::Soft(self.stabilisation_factor),
            Stabilised::Ghost => Stabilisation::ghost(self.ghost),
        };
        let settings = Settings {
            tolerance: self.tolerance,
            ..Settings::new(1.0 / f64::from(self.load_steps)).stabilised(stabilisation)
        };
        implicit(self.scheme, scene, settings)
    }
}

pub(super) struct Bending {
    setup: Setup<Cantilever>,
    edge: Edge,
}

/// Observations of all steps so far: how many were cut, and the largest ratios.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Steps {
    cut: u64,
    force_ratio: f64,
    force_rounding: f64,
    energy_ratio: f64,
    rate: Option<f64>,
}

/// σ_xx (Pa), in seeding order.
fn stress_xx(run: &dyn Simulation<2>) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.stress[k].xx)
}

impl Problem<2> for Bending {
    type Parameters = Cantilever;
    type Seen = Steps;

    fn new(setup: Setup<Cantilever>) -> Result<Self, Error> {
        let strain = setup.weight * (1.0 + setup.poisson_ratio) / setup.young_modulus;
        let why = "1/m: below, rounding hides the answer, and above, shear alone takes the tip off the grid";
        require_quotient("weight (1 + poisson_ratio) / young_modulus", strain, WEIGHT_OVER_MODULUS, why)?;
        Ok(Self { edge: Edge::new(&setup), setup })
    }

    fn discretisation(&self) -> Discretisation {
        let ppc = self.setup.points_per_direction.pow(2);
        self.setup.discretisation(2, ppc, 1.0 / f64::from(self.setup.load_steps))
    }

    fn begin(&self, _: &Steps) -> Begun<2> {
        self.setup.scene()
    }

    fn row(&self, seen: &mut Steps, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let iterations = phase.iterate(1)?;
        let run = phase.run.as_ref();
        let convergence = run.convergence().cloned().unwrap_or_default();
        seen.cut += u64::from(convergence.parts > 1);
        seen.force_ratio = seen.force_ratio.max(convergence.force_ratio);
        seen.force_rounding = seen.force_rounding.max(convergence.force_rounding);
        seen.energy_ratio = seen.energy_ratio.max(convergence.energy_ratio);
        seen.rate = newton_rate(&convergence, self.setup.tolerance).into_iter().chain(seen.rate).reduce(f64::max);
        let last = |k: usize| convergence.residuals.iter().rev().nth(k).copied().unwrap_or(0.0);
        let [[corner_x, mean_x], [corner_y, mean_y]] = [0, 1].map(|axis| self.edge.tip(&displacement(run, axis)));
        let [least, greatest] = extremes(&stress_xx(run));
        let totals = run.totals();
        Ok(row! {
            "time (-)": run.time(),
            "weight (N/m³)": self.setup.weight * run.time(),
            "corner_ux (m)": corner_x,
            "corner_uy (m)": corner_y,
            "edge_mean_ux (m)": mean_x,
            "edge_mean_uy (m)": mean_y,
            "stress_min (Pa)": least,
            "stress_max (Pa)": greatest,
            "newton_iterations (-)": iterations as f64,
            "residual (-)": last(0),
            "residual_before (-)": last(1),
            "force_ratio (-)": convergence.force_ratio,
            "energy_ratio (-)": convergence.energy_ratio,
            "parts (-)": f64::from(convergence.parts),
            "stored_energy (J/m)": totals.stored_energy,
            "load_work (J/m)": totals.accumulated.load_work,
        })
    }

    fn progress(&self, _: &Steps, phase: &Phase<2>) -> f64 {
        phase.share_of(self.setup.load_steps as u64)
    }

    fn particles<'a>(&self, _: &Steps, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns
            .references()
            .displacements()
            .each("stress_xx", "Pa", |p, k| p.stress[k].xx)
            .each("stress_yy", "Pa", |p, k| p.stress[k].yy)
            .each("stress_xy", "Pa", |p, k| p.stress[k].xy)
            .jacobian()
    }

    fn metrics(&self, seen: &Steps, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        let [ux, uy] = [0, 1].map(|axis| displacement(run, axis));
        let mut values = self.edge.of_displacement([&ux, &uy], &self.setup);
        values.extend(self.edge.of_stress(&stress_xx(run), &self.setup));
        // The clamp's reaction over the share of the weight that acts, less one.
        let volume: f64 = run.particles().reference_volume.iter().sum();
        let weight = self.setup.weight * run.time() * volume;
        let reaction = (-run.on(Part::Constraint(0)).force[1] / weight - 1.0).abs();
        // Smaller values are rounding, which no golden should hold.
        let tolerance = self.setup.tolerance;
        values.extend([
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (CUTS, seen.cut as f64),
            (LOG10_CONDITION, run.condition().log10()),
            (FORCE_RATIO, seen.force_ratio.max(tolerance)),
            (FORCE_ROUNDING, seen.force_rounding),
            (ENERGY_RATIO, seen.energy_ratio.max(tolerance)),
            (REACTION_ERROR, reaction.max(tolerance)),
            (MASS, run.totals().mass),
        ]);
        values.extend(seen.rate.map(|rate| (NEWTON_RATE, rate)));
        values
    }
}
