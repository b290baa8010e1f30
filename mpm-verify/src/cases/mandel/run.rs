//! Derived quantities, scene and observations of the slab.

use super::*;
use crate::cases::poro::{PER_CELL, above_rounding, mass_error, matrix_entries, outflow};
use crate::exact::mandel::{self as exact, Cells, Slab, of_particles};
use mpm_core::poro::{Plate, Settings};

/// Half the width a, and half the height b (m).
pub(super) const WIDTH: f64 = 1.0;
pub(super) const HEIGHT: f64 = 0.25;
/// T = c t/a² at the end.
pub(super) const END: f64 = 0.3;
/// T from which on errors are measured: a first step is still far from any exact solution.
const FROM: f64 = 0.01;
/// Empty cells beside and above it: of eight cells of the displacement an axis has four of the pressure, the fewest.
const ROOM: [usize; 2] = [2, 6];
/// Largest F/(G a): the finite part of the strain adds at most ten times as much, a percent, to a distance.
const SMALL: f64 = 1e-3;
/// Largest contribution of finite strain to a distance, over F/(G a).
const FINITE: f64 = 10.0;
/// The plane of symmetry below, among the scene's constraints.
const BELOW: Part = Part::Constraint(1);

impl Setup<Mandel> {
    /// a²/c (s).
    fn time_scale(&self) -> f64 {
        WIDTH * WIDTH / (self.kappa() * self.oedometric_modulus())
    }

    /// F/(G a).
    pub(super) fn strain(&self) -> f64 {
        self.load / (self.shear_modulus() * WIDTH)
    }

    /// Finite part of the strain, and its rounding.
    pub(super) fn finite(&self) -> f64 {
        FINITE * self.strain() + self.rounding()
    }

    /// The last bits of positions and J̃, which are of the order of one, in every step, over the strain.
    pub(super) fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON * f64::from(self.steps) / self.strain()
    }

    /// Nodes of the displacement.
    pub(super) fn nodes(&self) -> f64 {
        (WIDTH / self.h + 1.0) * (HEIGHT / self.h + 1.0)
    }

    /// Duration of a step (T).
    fn step(&self) -> f64 {
        END / f64::from(self.steps)
    }

    /// The step after which errors are measured.
    fn first_measured(&self) -> i32 {
        (FROM / self.step() * (1.0 - 1e-9)).ceil() as i32
    }

    /// Whether the run is one of those whose steps shrink as h², 60 of them at n8.
    pub(super) fn shrinks_together(&self) -> bool {
        let count = 60.0 * (WIDTH / self.h / 8.0).powi(2);
        (f64::from(self.steps) - count).abs() < 1e-6 && self.set.iter().all(|set| set.starts_with("steps="))
    }

    /// The exact slab, from the first step on.
    pub(super) fn exact(&self) -> exact::Mandel {
        exact::Mandel::new(self.poisson_ratio, self.step())
    }

    /// Cells of the difference equations.
    fn cells(&self) -> Cells {
        let n = (WIDTH / self.h).round() as usize;
        match self.space() {
            Some(TwoGrid) => Cells::two_grid(n),
            _ => Cells::same(n, self.projection_strength()),
        }
    }

    /// The slab by the difference equations after every step. Means of hats give the outermost particles strains of their own.
    fn of_run(&self) -> Vec<Slab> {
        let apart = self.basis() == Gimp;
        of_particles(self.poisson_ratio, self.cells(), apart, self.step(), self.steps)
    }

    /// Largest distances of the solution of the difference equations from the series, where errors are measured.
    pub(super) fn errors_of_equations(&self) -> Slab {
        let (exact, first) = (self.exact(), self.first_measured());
        let steps = (1..=self.steps).zip(self.of_run()).skip(first as usize - 1);
        let pairs: Vec<_> = steps.map(|(k, own)| (own, exact.at(f64::from(k) * self.step()))).collect();
        let most = |of: fn(&Slab) -> f64| pairs.iter().map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max);
        Slab { centre: most(|s| s.centre), settlement: most(|s| s.settlement), bulge: most(|s| s.bulge) }
    }

    /// The peak of the series, and its loss between steps.
    pub(super) fn peak_between_steps(&self) -> (f64, f64) {
        let (step, series) = (self.step(), self.exact());
        let (t, peak) = series.peak();
        let at = |k: f64| series.at(k * step).centre;
        let best = at((t / step).floor()).max(at((t / step).ceil()));
        (peak, peak - best)
    }
}

/// Observations of the slab: largest distances, and the peak.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: i32,
    whole: f64,
    space: f64,
    time: f64,
    equations: f64,
    settlement: f64,
    bulge: f64,
    support: f64,
    peak: (f64, f64),
}

pub(super) struct Consolidation {
    setup: Setup<Mandel>,
    exact: exact::Mandel,
    of_steps: exact::Mandel,
    of_cells: exact::Mandel,
    of_run: Vec<Slab>,
}

impl Consolidation {
    /// The current slab, in the units of the exact one.
    fn slab(&self, run: &dyn Simulation<2>) -> Slab {
        let pressures = run.pressure_nodes();
        let middle = pressures.iter().filter(|(x, _)| x[0].abs() < 1e-9 * self.setup.h);
        let p = run.particles();
        let strain = mean((0..p.len()).map(|k| p.position[k][1] / p.reference[k][1] - 1.0));
        let change = mean((0..p.len()).map(|k| p.volume[k] / p.reference_volume[k] - 1.0));
        let unit = self.setup.strain();
        Slab {
            centre: mean(middle.map(|(_, p)| *p)) * 2.0 * WIDTH / self.setup.load,
            settlement: -strain / unit,
            bulge: (change - strain) / unit,
        }
    }
}

/// Raises `most` to |a − b|; NaN stays NaN.
fn raise(most: &mut f64, a: f64, b: f64) {
    let distance = (a - b).abs();
    if distance > *most || distance.is_nan() {
        *most = distance;
    }
}

impl Problem<2> for Consolidation {
    type Parameters = Mandel;
    type Seen = Seen;

    fn new(setup: Setup<Mandel>) -> Result<Self, Error> {
        let why = "below which rounding hides the answer and above which the strain is not small";
        let allowed = least_strain(f64::from(setup.steps))..=SMALL;
        require_quotient("load / (a G) of young_modulus", setup.strain(), allowed, why)?;
        let ratio = setup.poisson_ratio;
        Ok(Self {
            exact: setup.exact(),
            of_steps: exact::Mandel::of_steps(ratio, setup.step(), setup.first_measured()),
            of_cells: exact::Mandel::of_cells(ratio, setup.cells()),
            of_run: setup.of_run(),
            setup,
        })
    }

    fn discretisation(&self) -> Discretisation {
        let dt = self.setup.step() * self.setup.time_scale();
        self.setup.discretisation(2, PER_CELL * PER_CELL, dt)
    }

    fn begin(&self, _: &Seen) -> Begun<2> {
        let c = &self.setup;
        let (h, load) = (c.h, c.load);
        let cells = [WIDTH, HEIGHT].map(|length| (length / h).round() as usize);
        let axis = |a: usize| Axis::bounded(0.0, cells[a] + ROOM[a], (Side::Wall, Side::Open));
        let grid = Grid::new(h, [axis(0), axis(1)])?;
        let spacing = h / PER_CELL as f64;
        // Nothing moves by its weight: any density will do.
        let particles = c.particles_at(by_rows(cells.map(|n| n * PER_CELL), spacing), spacing, 1000.0)?;
        let law = Hencky::new(c.young_modulus, c.poisson_ratio)?;
        let scene =
            Scene::new(grid, Bodies::new(law, particles)?).constrain_all([0, 1].map(|axis| roller(axis, End::Lo)));
        let plate = Plate::new(1, move |x| x[1] > HEIGHT - 0.25 * h, move |_| -load);
        let water = Water::new(c.porosity, Conductivity::Constant(c.kappa()))
            .drained(move |x| x[0] > WIDTH - 0.25 * h)
            .plate(plate);
        let settings = Settings {
            pressure_space: c.pressure_space(c.projection_strength() / c.oedometric_modulus()),
            tolerance: c.tolerance,
            ..Settings::new(c.step() * c.time_scale())
        };
        mpm_solvers::poro(c.scheme, scene, water, settings)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let iterations = phase.iterate(1)?;
        let run = phase.run.as_ref();
        seen.steps += 1;
        let step = self.setup.step();
        let t = f64::from(seen.steps) * step;
        let (own, exact) = (self.slab(run), self.exact.at(t));
        let of_run = self.of_run[seen.steps as usize - 1];
        raise(&mut seen.equations, own.centre, of_run.centre);
        raise(&mut seen.equations, own.settlement, of_run.settlement);
        raise(&mut seen.equations, own.bulge, of_run.bulge);
        raise(&mut seen.support, -run.on(BELOW).force[1] / self.setup.load, 1.0);
        if seen.steps >= self.setup.first_measured() {
            let of_steps = self.of_steps.after(seen.steps, step);
            raise(&mut seen.whole, own.centre, exact.centre);
            raise(&mut seen.space, own.centre, of_steps.centre);
            raise(&mut seen.time, own.centre, self.of_cells.at(t).centre);
            raise(&mut seen.settlement, own.settlement, exact.settlement);
            raise(&mut seen.bulge, own.bulge, exact.bulge);
        }
        if own.centre > seen.peak.0 {
            seen.peak = (own.centre, t);
        }
        Ok(row! {
            "time (s)": run.time(),
            "time_factor (-)": t,
            "centre_pressure (-)": own.centre,
            "centre_pressure_exact (-)": exact.centre,
            "settlement (-)": own.settlement,
            "settlement_exact (-)": exact.settlement,
            "bulge (-)": own.bulge,
            "bulge_exact (-)": exact.bulge,
            "outflow (m²)": outflow(run),
            "newton_iterations (-)": iterations as f64,
        })
    }

    fn progress(&self, seen: &Seen, _: &Phase<2>) -> f64 {
        f64::from(seen.steps) / f64::from(self.setup.steps)
    }

    fn particles<'a>(&self, _: &Seen, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns
            .references()
            .field("pore_pressure", "Pa", Field::PorePressure)
            .each("effective_stress_xx", "Pa", |p, k| p.stress[k].xx)
            .each("effective_stress_yy", "Pa", |p, k| p.stress[k].yy)
            .jacobian()
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        vec![
            (CENTRE_PRESSURE_ERROR, seen.whole),
            (CENTRE_PRESSURE_ERROR_SPACE, seen.space),
            (CENTRE_PRESSURE_ERROR_TIME, seen.time),
            (EQUATIONS_DISTANCE, seen.equations),
            (PEAK, seen.peak.0),
            (PEAK_TIME, seen.peak.1),
            (SETTLEMENT_ERROR, seen.settlement),
            (BULGE_ERROR, seen.bulge),
            (SUPPORT_ERROR, above_rounding(seen.support)),
            (MASS_ERROR, mass_error(run)),
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (ENTRIES, matrix_entries(run)),
        ]
    }
}
