//! Derived quantities, scene and observations of the column.

use super::*;
use crate::cases::poro::*;
use crate::exact::consolidation::between;
use mpm_core::poro::{Face, Settings, Tangent, VolumeRate};

/// Bulk parameter K, shear modulus G (Pa) and porosity of the undeformed column.
const BULK: f64 = 50e3;
const SHEAR: f64 = 300e3;
const POROSITY: f64 = 0.5;
/// M₀ = K/n₀ + 4/3 G (Pa).
const MODULUS: f64 = BULK / POROSITY + 4.0 / 3.0 * SHEAR;
/// κ₀ (m²/(Pa s)): water of 9810 N/m³ at 10⁻⁶ m/s.
const KAPPA: f64 = 1e-6 / 9810.0;
/// H²/c_v (s), c_v = κ₀ M₀.
const TIME_SCALE: f64 = HEIGHT * HEIGHT / (KAPPA * MODULUS);
/// T at which the load is whole, and at the end.
const RAMP: f64 = 0.05;
const END: f64 = 2.0;
/// Steps, before each is cut, and T of the first.
const STEPS: i32 = 125;
const FIRST: f64 = 1e-3;

impl Setup<Consolidation> {
    /// q (Pa).
    fn whole_load(&self) -> f64 {
        self.load * MODULUS
    }

    pub(super) fn count(&self) -> f64 {
        f64::from(STEPS) * f64::from(self.refine)
    }

    /// T of the first step, and the ratio of each step to the one before.
    fn first_and_growth(&self) -> (f64, f64) {
        let whole = growth(FIRST, STEPS, END);
        let cut = whole.powf(1.0 / f64::from(self.refine));
        (FIRST * (cut - 1.0) / (whole - 1.0), cut)
    }

    /// The exact solution, and that of the same steps.
    fn exact(&self) -> [Vec<At>; 2] {
        [None, Some(f64::from(self.refine))].map(|steps| solution(self.load, steps))
    }

    pub(super) fn settlement_metrics(&self, seen: &[At]) -> Vec<(Metric, f64)> {
        let [whole, of_steps] = self.exact();
        let off = |own: &At, exact: &At| own.settlement / exact.settlement - 1.0;
        let [early, end] = [between(seen, 0.1), seen.last().copied()].map(|at| at.map_or(f64::NAN, |at| at.settlement));
        vec![
            (SETTLEMENT_ERROR, largest(seen, &whole, off)),
            (SETTLEMENT_ERROR_STEPS, largest(seen, &of_steps, off)),
            (SETTLEMENT_EARLY, early),
            (SETTLEMENT_END, end),
        ]
    }

    pub(super) fn base_pressure_metrics(&self, seen: &[At]) -> Vec<(Metric, f64)> {
        let [whole, of_steps] = self.exact();
        let off = |own: &At, exact: &At| own.base - exact.base;
        vec![
            (BASE_PRESSURE_ERROR, largest(seen, &whole, off)),
            (BASE_PRESSURE_ERROR_STEPS, largest(seen, &of_steps, off)),
        ]
    }

    /// Distances of the solution that is exact in space, of the same steps, from the exact one: of the settlement (relative) and
    /// of the base pressure over the load; zero where those steps have no reference.
    pub(super) fn errors_of_steps(&self) -> [f64; 2] {
        let [whole, of_steps] = self.exact();
        let pairs = || of_steps.iter().zip(&whole);
        let settlement = pairs().map(|(own, exact)| (own.settlement / exact.settlement - 1.0).abs());
        let base = pairs().map(|(own, exact)| (own.base - exact.base).abs());
        [settlement.fold(0.0, f64::max), base.fold(0.0, f64::max)]
    }
}

/// The largest difference from `exact`, at its times; NaN where there is no exact solution.
fn largest(seen: &[At], exact: &[At], of: impl Fn(&At, &At) -> f64) -> f64 {
    let distances = exact.iter().map(|exact| {
        let own = between(seen, exact.t);
        own.map_or(f64::NAN, |own| of(&own, exact).abs())
    });
    let greater = |most: f64, d: f64| if d > most || d.is_nan() { d } else { most };
    distances.reduce(greater).unwrap_or(f64::NAN)
}

#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// The column after every step.
    rows: Vec<At>,
    /// ½ Σ V (J̃ − 1)² so far (m), and the largest |J̃ − 1|.
    rate_loss: f64,
    volume_step: f64,
}

impl Problem<1> for Setup<Consolidation> {
    type Parameters = Consolidation;
    type Seen = Seen;

    fn new(setup: Self) -> Result<Self, Error> {
        Ok(setup)
    }

    fn discretisation(&self) -> Discretisation {
        self.discretisation(1, PER_CELL, self.first_and_growth().0 * TIME_SCALE)
    }

    fn begin(&self, _: &Seen) -> Begun<1> {
        let (h, topmost) = (self.h, topmost(self.h));
        let scene = column(self, ImprovedHencky::new(BULK, SHEAR, POROSITY)?)?;
        let load = self.whole_load();
        let traction = move |t: f64| [-load * (t / (RAMP * TIME_SCALE)).min(1.0)];
        let (particles, top) = (&scene.bodies.particles, (0, End::Hi));
        // c n³/(1 − n)² is κ₀ at n₀.
        let c = KAPPA * (1.0 - POROSITY).powi(2) / POROSITY.powi(3);
        let water = Water::new(POROSITY, Conductivity::KozenyCarman(c))
            .face(Face::loaded(particles, topmost, top, traction))
            .face(Face::drained(particles, topmost, top, self.drain * KAPPA / h));
        let (first, growth) = self.first_and_growth();
        let settings = Settings {
            growth,
            pressure_space: self.pressure_space(self.projection / (2.0 * SHEAR)),
            volume_rate: match self.volume_rate {
                Rate::Exact => VolumeRate::Exact,
                Rate::Logarithmic => VolumeRate::Logarithmic,
            },
            tangent: Tangent::Consistent,
            tolerance: self.tolerance,
            ..Settings::new(first * TIME_SCALE).ghosts(self.ghost_displacement, self.ghost_pressure)
        };
        mpm_solvers::poro(self.scheme, scene, water, settings)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<1>) -> Result<Row, Fault> {
        let before = volumes(phase.run.as_ref());
        let iterations = phase.iterate(1)?;
        let run = phase.run.as_ref();
        for (before, after) in before.iter().zip(volumes(run)) {
            let change = after / before - 1.0;
            seen.rate_loss += 0.5 * before * change * change;
            seen.volume_step = seen.volume_step.max(change.abs());
        }
        let at = At {
            t: run.time() / TIME_SCALE,
            settlement: lost_volume(run) / HEIGHT,
            base: base_pressure(run) / self.whole_load(),
        };
        seen.rows.push(at);
        Ok(row! {
            "time (s)": run.time(),
            "time_factor (-)": at.t,
            "settlement (-)": at.settlement,
            "base_pressure (-)": at.base,
            "outflow (m)": outflow(run),
            "imbalance (m)": run.water().map_or(f64::NAN, |w| w.imbalance),
            "newton_iterations (-)": iterations as f64,
        })
    }

    fn progress(&self, seen: &Seen, _: &Phase<1>) -> f64 {
        seen.rows.len() as f64 / self.count()
    }

    fn particles<'a>(&self, _: &Seen, columns: Columns<'a, 1>) -> Columns<'a, 1> {
        kept(columns).jacobian()
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<1>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        let mut values = self.settlement_metrics(&seen.rows);
        values.extend(self.base_pressure_metrics(&seen.rows));
        values.extend([
            (MASS_ERROR, mass_error(run)),
            (RATE_LOSS, over_outflow(run, seen.rate_loss)),
            (VOLUME_STEP, seen.volume_step),
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (ENTRIES, matrix_entries(run)),
        ]);
        values
    }
}
