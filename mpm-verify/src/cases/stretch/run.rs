//! Scene, observations and predictions of the body.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use crate::exact::stretched_lattice::{Lattice, Stretched};
use mpm_core::stage::Constraint;
use mpm_core::{Frame, Memoryless};

/// Cells of the body beside the free part, always.
const HELD: usize = 2;
/// The share of its exact value below which the mean stress of the free part says that it has torn.
const TORN: f64 = 0.5;

/// Observations: stretches at which the free part tore, neighbours lost their last common node, and the program stopped.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Observed {
    rows: u64,
    /// Stretch and error of the stress, row by row.
    errors: Vec<[f64; 2]>,
    torn: Option<f64>,
    parted: Option<f64>,
    stopped: Option<f64>,
    /// Mean stress of the free part, over the exact one.
    kept: f64,
}

pub(super) struct Stretching {
    setup: Setup<Stretch>,
    law: NeoHookean,
    /// Rate of the stretch (1/s), time step (s), steps.
    rate: f64,
    dt: f64,
    steps: u64,
}

/// The nodes beside the free part move as all would.
struct Held<const D: usize> {
    /// The middle (m), and how far from it the free part ends (m).
    middle: [f64; D],
    beyond: f64,
    rate: f64,
}

impl<const D: usize> Memoryless for Held<D> {}

impl<const D: usize> Constraint<D> for Held<D> {
    fn prescribe(&self, grid: &Grid<D>, x: &[f64; D], axis: usize) -> Option<f64> {
        let from_middle = |a: usize| x[a] - self.middle[a];
        let held = (0..D).any(|a| from_middle(a).abs() >= self.beyond - 1e-9 * grid.h);
        held.then(|| self.rate * from_middle(axis))
    }

    fn amplitude(&self, time: f64) -> f64 {
        1.0 / (1.0 + self.rate * time)
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Constraint<D>> {
        Box::new(Self { middle: frame.place(&self.middle), beyond: frame.scale(0, 1) * self.beyond, rate: self.rate })
    }
}

impl Stretching {
    /// The body as it should be stretched.
    fn exact(&self) -> Stretched {
        let covers = (FREE + HELD) as f64 / self.setup.end.min(1.0);
        Stretched {
            law: self.law,
            density: DENSITY,
            dimension: self.setup.dimension,
            lattice: Lattice { basis: self.setup.basis(), half_size: 0.5 / self.setup.ppc_per_direction as f64 },
            half_length: covers.ceil(),
            end: self.setup.end,
        }
    }

    /// The stretch of what is held: that of the last particle.
    fn stretch<const D: usize>(run: &dyn Simulation<D>) -> f64 {
        let p = run.particles();
        let last = p.reference.iter().zip(&p.jacobian).max_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
        last.map_or(f64::NAN, |(_, j)| j.powf((D as f64).recip()))
    }

    /// Mean over the free part of the stress over the exact one, and rms of what it differs from one by; of a free part
    /// without particles that of no stress.
    fn stresses<const D: usize>(&self, run: &mut dyn Simulation<D>) -> [f64; 2] {
        let exact = self.exact().state(Self::stretch::<D>(run))[0];
        let stress = run.force_stress();
        let end = FREE as f64 * self.setup.h;
        let free = run.particles().position.iter().zip(&stress).filter(|(x, _)| x.iter().all(|x| x.abs() < end));
        let shares: Vec<f64> = free.flat_map(|(_, s)| (0..D).map(move |a| s.get(a, a) / exact)).collect();
        if shares.is_empty() {
            return [0.0, 1.0];
        }
        let mean = mean(shares.iter().copied());
        [mean, rms(shares.iter().map(|s| s - 1.0))]
    }
}

impl<const D: usize> Problem<D> for Stretching {
    type Parameters = Stretch;
    type Seen = Observed;

    fn new(setup: Setup<Stretch>) -> Result<Self, Error> {
        let law = NeoHookean::new(YOUNG_MODULUS, setup.poisson_ratio)?;
        let waves = law.wave_speed(DENSITY);
        let stretch = setup.end - 1.0;
        let rate = (setup.speed * waves / (FREE as f64 * setup.h)).copysign(stretch);
        let duration = stretch / rate;
        let steps = match setup.is_explicit() {
            true => duration / courant_time_step(setup.cfl, setup.h, waves),
            false => f64::from(setup.rows),
        };
        let (dt, steps) = (duration / steps.ceil(), steps.ceil() as u64);
        Ok(Self { setup, law, rate, dt, steps })
    }

    fn discretisation(&self) -> Discretisation {
        Discretisation { wall: "none".to_owned(), ..self.setup.regular(D, self.dt) }
    }

    fn begin(&self, _: &Observed) -> Begun<D> {
        let h = self.setup.h;
        let size = h / self.setup.ppc_per_direction as f64;
        let along = |_| self.exact().places().iter().map(|x| x * h).collect();
        let places = self.setup.start_at(lattice(std::array::from_fn(along)));
        let mut particles = Particles::new(places, size.powi(D as i32), DENSITY, [0.5 * size; D])?;
        for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
            *v = x.map(|x| self.rate * x);
        }
        let longest = self.exact().half_length * self.setup.end.max(1.0);
        let room = longest as usize + HELD;
        let grid = Grid::new(h, [Axis::open(-(room as f64) * h, 2 * room); D])?;
        let held = Held { middle: [0.0; D], beyond: FREE as f64 * h, rate: self.rate };
        let scene = Scene::new(grid, Bodies::new(self.law, particles)?).constrain(held);
        self.setup.moving(scene, self.dt, 0.0)
    }

    fn row(&self, seen: &mut Observed, phase: &mut Phase<D>) -> Result<Row, Fault> {
        let rows = self.setup.rows as u64;
        seen.rows += 1;
        let to = (seen.rows * self.steps).div_ceil(rows);
        let done = phase.steps(to - phase.run.work().steps);
        let stretch = Self::stretch::<D>(phase.run.as_ref());
        // A run that stops is complete.
        if !finds_equilibrium(done)? {
            seen.stopped = Some(stretch);
        }
        let [mean, error] = self.stresses(phase.run.as_mut());
        let h = self.setup.h;
        let apart = self.exact().lattice.parted(phase.run.particles().position.iter().map(|x| x[0] / h).collect());
        seen.kept = mean;
        seen.errors.push([stretch, error]);
        if mean < TORN {
            seen.torn = seen.torn.or(Some(stretch));
        }
        if apart {
            seen.parted = seen.parted.or(Some(stretch));
        }
        // A step that was not taken is a row of its end.
        let ahead = seen.stopped.map_or(0.0, |_| self.dt);
        Ok(row! {
            "time (s)": phase.run.time() + ahead,
            "stretch (-)": stretch,
            "stress_kept (-)": mean,
            "stress_error (-)": error,
            "parted (-)": f64::from(u8::from(apart)),
        })
    }

    fn progress(&self, seen: &Observed, _: &Phase<D>) -> f64 {
        if seen.stopped.is_some() { 1.0 } else { seen.rows as f64 / f64::from(self.setup.rows) }
    }

    fn particles<'a>(&self, _: &Observed, columns: Columns<'a, D>) -> Columns<'a, D> {
        columns.stress("stress_xx", [0, 0])
    }

    fn metrics(&self, seen: &Observed, _: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let exact = self.exact();
        let (unstable, parting) = (exact.unstable(), exact.parting());
        let end = unstable.or(parting).unwrap_or(self.setup.end);
        let predicted = exact.noise(end);
        let unstable = unstable.map(|s| s * (1.0 - SWING * predicted));
        let end = unstable.unwrap_or(end);
        let sound = |s: f64| (s - 1.0).abs() < (end - 1.0).abs();
        let errors = seen.errors.iter().filter(|[s, _]| sound(*s));
        let stops = self.setup.is_explicit();
        let optional = [
            (TEAR_STRETCH, seen.torn),
            (PARTED_STRETCH, seen.parted),
            (UNSTABLE_STRETCH, unstable),
            (PREDICTED_TEAR_STRETCH, parting),
            (STOPPED_STRETCH, seen.stopped),
            (PREDICTED_STOP_STRETCH, exact.stop(self.rate, self.dt, self.setup.h).filter(|_| stops)),
            (STRESS_NOISE, Some(errors.map(|[_, e]| *e).fold(0.0, f64::max))),
            (PREDICTED_NOISE, Some(predicted)),
            (STRESS_KEPT, Some(seen.kept)),
        ];
        optional.into_iter().filter_map(|(m, v)| Some((m, v?))).collect()
    }
}
