//! Derived quantities, scene and observations of the column.

use super::*;
use crate::cases::poro::*;
use crate::exact::terzaghi::FirstStep;
use mpm_core::poro::{Face, Settings};

/// Largest q/M: the finite part of the strain changes a distance by ten times as much.
const SMALL: f64 = 1e-6;
/// Largest change of an overshoot or a settlement by finite strain and Newton's tolerance.
pub(super) const FINITE: f64 = 10.0 * SMALL;

impl Setup<Terzaghi> {
    /// H²/c_v (s).
    fn time_scale(&self) -> f64 {
        HEIGHT * HEIGHT / (self.kappa() * self.oedometric_modulus())
    }

    /// q/M.
    pub(super) fn strain(&self) -> f64 {
        self.load / self.oedometric_modulus()
    }

    /// Duration of the first step over H²/c_v, and ratio of each step to the one before.
    pub(super) fn first_and_growth(&self) -> (f64, f64) {
        let first = self.first_step * (self.h / HEIGHT).powi(2);
        match (first, self.steps) {
            (0.0, count) => (self.time_end / f64::from(count), 1.0),
            (_, 1) => (first, 1.0),
            (_, count) => (first, growth(first, count, self.time_end)),
        }
    }

    /// Durations of all steps over H²/c_v.
    fn durations(&self) -> Vec<f64> {
        let (first, growth) = self.first_and_growth();
        (0..self.steps).map(|k| first * growth.powi(k)).collect()
    }

    pub(super) fn end(&self) -> f64 {
        self.durations().iter().sum()
    }

    /// c_v Δt/h² of the first step.
    pub(super) fn share(&self) -> f64 {
        self.first_and_growth().0 * (HEIGHT / self.h).powi(2)
    }

    /// Cells of a pressure space.
    fn cells(&self, space: SpaceName) -> u32 {
        let cells = (HEIGHT / self.h).round() as u32;
        if space == TwoGrid { cells / 2 } else { cells }
    }

    /// The discrete equations of a step with c_v Δt/h² = `share`.
    fn equations(&self, space: SpaceName, share: f64) -> FirstStep {
        match space {
            TwoGrid => FirstStep::two_grid(share),
            _ => FirstStep::same_cells(share, self.strength_in(space)),
        }
    }

    /// Overshoot of a first step with c_v Δt/h² = `share` by the discrete equations.
    pub(super) fn overshoot_by(&self, space: SpaceName, share: f64) -> f64 {
        self.equations(space, share).overshoot(self.cells(space))
    }

    /// Difference at the end between Terzaghi's settlement and that of the discrete equations.
    pub(super) fn settlement_distance(&self, space: SpaceName) -> f64 {
        let shares: Vec<f64> = self.durations().iter().map(|t| t * (HEIGHT / self.h).powi(2)).collect();
        let of = |r| self.equations(space, r);
        (exact::settlement_of_equations(of, self.cells(space) as usize, &shares) - exact::settlement(self.end())).abs()
    }

    /// The change of a settlement by finite strain, and by the last bits of J̃ in every step.
    pub(super) fn resolution(&self) -> f64 {
        FINITE + 4.0 * f64::EPSILON * f64::from(self.steps) / self.strain()
    }

    /// The largest of a number of the three pressure spaces.
    pub(super) fn largest(&self, of: impl Fn(SpaceName) -> f64) -> f64 {
        [TwoGrid, Equal, Ppp].map(of).into_iter().fold(0.0, f64::max)
    }

    /// Largest nodal pressure over the load, minus one.
    fn overshoot(&self, run: &dyn Simulation<1>) -> f64 {
        let most = run.pressure_nodes().iter().fold(0.0, |most: f64, (_, p)| most.max(*p));
        beyond_rounding(most / self.load - 1.0)
    }

    /// Settlement over the final one.
    fn settlement(&self, run: &dyn Simulation<1>) -> f64 {
        lost_volume(run) * self.oedometric_modulus() / (self.load * HEIGHT)
    }
}

impl Problem<1> for Setup<Terzaghi> {
    type Parameters = Terzaghi;
    /// The overshoot of the first step.
    type Seen = f64;

    fn new(setup: Self) -> Result<Self, Error> {
        let why = "below which rounding hides the answer and above which the strain is not small";
        let allowed = least_strain(f64::from(setup.steps))..=SMALL;
        let first = setup.first_and_growth().0;
        if setup.steps > 1 && first > setup.time_end {
            return Err(Error::Input(format!(
                "parameter first_step: {} of this level is a step of {first} H²/c_v; allowed: at most time_end = {}",
                setup.first_step, setup.time_end
            )));
        }
        require_quotient("load / M of young_modulus", setup.strain(), allowed, why)?;
        Ok(setup)
    }

    fn discretisation(&self) -> Discretisation {
        self.discretisation(1, PER_CELL, self.first_and_growth().0 * self.time_scale())
    }

    fn begin(&self, _: &f64) -> Begun<1> {
        let scene = column(self, Hencky::new(self.young_modulus, self.poisson_ratio)?)?;
        let (load, h) = (self.load, self.h);
        let top = Face::loaded(&scene.bodies.particles, topmost(h), (0, End::Hi), move |_| [-load]);
        let water = Water::new(self.porosity, Conductivity::Constant(self.kappa()))
            .drained(move |x| x[0] > HEIGHT - 0.25 * h)
            .face(top);
        let (first, growth) = self.first_and_growth();
        let settings = Settings {
            growth,
            pressure_space: self.pressure_space(self.projection_strength() / self.oedometric_modulus()),
            tolerance: self.tolerance,
            ..Settings::new(first * self.time_scale())
        };
        mpm_solvers::poro(self.scheme, scene, water, settings)
    }

    fn row(&self, overshoot_first_step: &mut f64, phase: &mut Phase<1>) -> Result<Row, Fault> {
        let iterations = phase.iterate(1)?;
        let run = phase.run.as_ref();
        if run.work().steps == 1 {
            *overshoot_first_step = self.overshoot(run);
        }
        let t = run.time() / self.time_scale();
        Ok(row! {
            "time (s)": run.time(),
            "time_factor (-)": t,
            "settlement (-)": self.settlement(run),
            "settlement_exact (-)": exact::settlement(t),
            "base_pressure (-)": base_pressure(run) / self.load,
            "base_pressure_exact (-)": exact::pressure(1.0, t),
            "overshoot (-)": self.overshoot(run),
            "outflow (m)": outflow(run),
            "newton_iterations (-)": iterations as f64,
        })
    }

    fn progress(&self, _: &f64, phase: &Phase<1>) -> f64 {
        phase.share_of(self.steps as u64)
    }

    fn particles<'a>(&self, _: &f64, columns: Columns<'a, 1>) -> Columns<'a, 1> {
        kept(columns).jacobian()
    }

    fn metrics(&self, overshoot_first_step: &f64, phase: &mut Phase<1>) -> Vec<(Metric, f64)> {
        let (steps, t) = (self.durations(), phase.run.time() / self.time_scale());
        let pressure = phase.run.field(Field::PorePressure);
        let run = phase.run.as_ref();
        let error = |exact: &dyn Fn(f64) -> f64| {
            let pairs = pressure.iter().zip(&run.particles().reference);
            rms(pairs.map(|(p, x)| p / self.load - exact(1.0 - x[0] / HEIGHT)))
        };
        vec![
            (PRESSURE_L2, error(&|z| exact::pressure(z, t))),
            (PRESSURE_L2_STEPS, error(&|z| exact::pressure_of_steps(z, &steps))),
            (OVERSHOOT_FIRST_STEP, *overshoot_first_step),
            (SETTLEMENT_ERROR, (self.settlement(run) - exact::settlement(t)).abs()),
            (MASS_ERROR, mass_error(run)),
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (ENTRIES, matrix_entries(run)),
        ]
    }
}
