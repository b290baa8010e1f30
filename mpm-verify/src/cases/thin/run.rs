//! Scene and observations of a free beam that swings in its first mode, half of it by symmetry.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use crate::exact::free_beam::{Beam, Mode, stiffness};

/// Deflection of the middle (m), small enough for the linear beam.
const DEFLECTION: f64 = 1e-5;
/// Periods of a run, and rows in one of them.
const PERIODS: f64 = 5.0;
const ROWS: f64 = 40.0;
/// Cells of room beside the beam.
const ROOM: usize = 3;

pub(super) struct Swing {
    setup: Setup<Thin>,
    law: NeoHookean,
    /// The exact mode; the bending stiffness over the exact one, and the frequency with it, where known.
    mode: Mode,
    stiffness: Option<f64>,
    predicted: Option<f64>,
    dt: f64,
    steps: u64,
}

impl Swing {
    fn share(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let (mut along, mut squares) = (0.0, 0.0);
        for k in 0..p.len() {
            let shape = self.mode.deflection(p.reference[k][0]);
            along += shape * (p.position[k][1] - p.reference[k][1]);
            squares += shape * shape;
        }
        along / squares / DEFLECTION
    }
}

impl Problem<2> for Swing {
    type Parameters = Thin;
    type Seen = Rows;

    fn new(setup: Setup<Thin>) -> Result<Self, Error> {
        setup.check_rule()?;
        let (ratio, cfl) = (setup.poisson_ratio, setup.cfl);
        if setup.is_explicit() && cfl >= 1.0 {
            return Err(Error::Input(format!("cfl = {cfl} is out of range for the solver explicit; allowed: below 1")));
        }
        let law = NeoHookean::new(YOUNG_MODULUS, ratio)?;
        let first = |factor| Beam::new(YOUNG_MODULUS, ratio, DENSITY, factor).first();
        let (cells, per_direction) = (DEPTH / setup.h, setup.ppc_per_direction as f64);
        let stiffness = stiffness(setup.basis(), ratio, cells, per_direction, setup.shift > 0.0);
        let mode = first(1.0);
        let predicted = stiffness.map(|factor| first(factor).frequency);
        // With GIMP and with an average it is a bound.
        let bounds = setup.basis() == Gimp || setup.remedy() != RemedyName::None;
        let period = TAU / predicted.filter(|_| !bounds).unwrap_or(mode.frequency);
        let longest = courant_time_step(cfl, setup.h, law.wave_speed(DENSITY));
        let steps = (PERIODS * period / longest).ceil();
        Ok(Self { setup, law, mode, stiffness, predicted, dt: PERIODS * period / steps, steps: steps as u64 })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.dt)
    }

    fn begin(&self, _: &Rows) -> Begun<2> {
        let h = self.setup.h;
        let cells = |length: f64| (length / h).round() as usize;
        let along = Axis::bounded(0.0, cells(HALF) + ROOM, (Side::Wall, Side::Open));
        let up = Axis::open(-h * ROOM as f64, cells(DEPTH) + 2 * ROOM);
        let grid = Grid::new(h, [along, up])?;
        let (spacing, foot) = (self.setup.pitch(), h * self.setup.shift);
        let counts = [HALF, DEPTH].map(|l| (l / spacing).round() as usize);
        let places = by_rows(counts, spacing).map(|[x, y]| [x, foot + y]);
        let mut particles = self.setup.particles_at(places, spacing, DENSITY)?;
        let speed = DEFLECTION * self.mode.frequency;
        for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
            let above = x[1] - foot - 0.5 * DEPTH;
            *v = [-speed * above * self.mode.turn(x[0]), speed * self.mode.deflection(x[0])];
        }
        let scene = Scene::new(grid, Bodies::new(self.law, particles)?).constrain(roller(0, End::Lo));
        self.setup.moving(scene, self.dt, 0.0)
    }

    fn row(&self, seen: &mut Rows, phase: &mut Phase<2>) -> Result<Row, Fault> {
        seen.sample(phase, [self.steps, (PERIODS * ROWS) as u64], |run| {
            let totals = run.totals();
            row! {
                "time (s)": run.time(),
                "deflection (-)": self.share(run),
                "kinetic_energy (J/m)": totals.kinetic_energy,
                "stored_energy (J/m)": totals.stored_energy,
            }
        })
    }

    fn progress(&self, _: &Rows, phase: &Phase<2>) -> f64 {
        phase.share_of(self.steps)
    }

    fn particles<'a>(&self, _: &Rows, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.references().stress("stress_xx", [0, 0])
    }

    fn metrics(&self, seen: &Rows, _: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let points = seen.points(["time", "deflection"]);
        // The deflection at the start is zero.
        let half_period = half_period(&points[1..]).unwrap_or(f64::NAN);
        let ratio = 0.5 * TAU / half_period / self.mode.frequency;
        let period = ROWS as usize;
        let largest = |points: &[(f64, f64)]| points.iter().map(|(_, u)| u.abs()).fold(0.0, f64::max);
        let kept = largest(&points[points.len() - period..]) / largest(&points[..period]);
        let mut values =
            vec![(FREQUENCY_RATIO, ratio), (FREQUENCY_ERROR, (ratio - 1.0).abs()), (AMPLITUDE_RATIO, kept)];
        let predicted = self.predicted.map(|f| f / self.mode.frequency);
        values.extend(predicted.map(|f| (PREDICTED_RATIO, f)));
        values.extend(self.stiffness.map(|s| (STIFFNESS_RATIO, s)));
        values
    }
}
