//! Scene and observations of the body, twice in a cell.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use crate::exact::lattice::{force, symbol, transform};

/// Cells of a period along the motion and across it.
pub(super) const PERIOD: usize = 8;
const ACROSS: usize = 4;
/// Waves of the lattice whose forces are summed.
const WAVES: i32 = 3;
/// Rows in a cell.
const ROWS: f64 = 2.0;
/// Less noise is rounding.
const LEAST_NOISE: f64 = 1e-10;

pub(super) struct Translation {
    setup: Setup<Translate>,
    law: NeoHookean,
    /// Speed of the body (m/s), time step (s), steps.
    speed: f64,
    dt: f64,
    steps: u64,
    /// The exact stress σ_xx (Pa).
    stress: f64,
}

impl Translation {
    /// Mean of σ_xx over the particles, and rms of the deviations from it, both over the exact value.
    fn stresses(&self, run: &mut dyn Simulation<2>) -> [f64; 2] {
        let stress = run.force_stress();
        let stress: Vec<f64> = stress.iter().map(|s| s.get(0, 0) / self.stress).collect();
        let mean = mean(stress.iter().copied());
        [mean, rms(stress.iter().map(|s| s - mean))]
    }

    /// Predicted noise of the stress under the forces of the lattice: see `docs/translate.md`.
    fn predicted(&self) -> f64 {
        let per_cell = self.setup.particles as f64 / PERIOD as f64;
        let basis = self.setup.basis();
        let of_basis = |k: f64| transform(basis, per_cell, k);
        let answers = (1..=WAVES).map(|k| {
            let waves = per_cell * f64::from(k);
            // The nodes see the wave of the lattice as one of this angle from node to node. `driven` are the radians by which it
            // passes the body in the time that sound takes through a cell; half-way between two waves it is both.
            let passes = |whole: f64| {
                let [stiffness, kept] = symbol(TAU * (waves - whole), &of_basis);
                let driven = self.setup.speed * TAU * whole;
                let answer = 1.0 / (1.0 - driven * driven / (kept * stiffness)).abs();
                (2.0 * stiffness).sqrt().recip() * answer
            };
            let (below, above) = (waves.floor(), waves.ceil());
            let nearest = waves.round();
            force(waves, &of_basis)
                * if waves - below == 0.5 { 0.5 * (passes(below) + passes(above)) } else { passes(nearest) }
        });
        answers.map(|a| a * a).sum::<f64>().sqrt()
    }
}

impl Problem<2> for Translation {
    type Parameters = Translate;
    type Seen = Rows;

    fn new(setup: Setup<Translate>) -> Result<Self, Error> {
        let law = NeoHookean::new(YOUNG_MODULUS, setup.poisson_ratio)?;
        let waves = law.wave_speed(DENSITY);
        let along = 0.5 * PERIOD as f64 / setup.particles as f64;
        let cfl = setup.cfl_number(2, along.min(0.5 / setup.ppc_per_direction as f64))?;
        let dt = courant_time_step(cfl, setup.h, waves);
        let mut stretched = Matrix3::identity() * setup.stretch;
        stretched[(2, 2)] = 1.0;
        let distance = setup.cells * setup.h;
        Ok(Self {
            law,
            speed: setup.speed * waves,
            dt,
            steps: (distance / (setup.speed * waves) / dt).ceil() as u64,
            stress: law.at_rest(&stretched).0.get(0, 0),
            setup,
        })
    }

    fn discretisation(&self) -> Discretisation {
        let particles = self.setup.particles * self.setup.ppc_per_direction;
        self.setup.discretisation(2, (particles as f64 / PERIOD as f64).round() as usize, self.dt)
    }

    fn begin(&self, _: &Rows) -> Begun<2> {
        let (h, stretch, across) = (self.setup.h, self.setup.stretch, self.setup.ppc_per_direction);
        let grid = Grid::new(h, [Axis::periodic(0.0, PERIOD), Axis::periodic(0.0, ACROSS)])?;
        let counts = [self.setup.particles, ACROSS * across];
        let size = [PERIOD as f64 * h / counts[0] as f64, h / across as f64];
        let places = lattice([0, 1].map(|a| middles(counts[a], size[a])));
        let volume = size[0] * size[1] / (stretch * stretch);
        let mut particles = Particles::new(self.setup.start_at(places), volume, DENSITY, size.map(|s| 0.5 * s))?
            .deformed(|x| (*x, Matrix2::identity() * stretch));
        particles.velocity.fill([self.speed, 0.0]);
        self.setup.explicit(Scene::new(grid, Bodies::new(self.law, particles)?), self.dt, 0.0)
    }

    fn row(&self, seen: &mut Rows, phase: &mut Phase<2>) -> Result<Row, Fault> {
        seen.sample(phase, [self.steps, (ROWS * self.setup.cells).ceil() as u64], |run| {
            let [mean, noise] = self.stresses(run);
            let totals = run.totals();
            let off = |v: &[f64; 2]| (v[0] / self.speed - 1.0).hypot(v[1] / self.speed);
            row! {
                "time (s)": run.time(),
                "stress_noise (-)": noise,
                "velocity_noise (-)": rms(run.particles().velocity.iter().map(off)),
                "momentum (kg/s)": totals.momentum[0],
                "kinetic_energy (J/m)": totals.kinetic_energy,
                "stored_energy (J/m)": totals.stored_energy,
                "stress_kept (-)": mean,
            }
        })
    }

    fn progress(&self, _: &Rows, phase: &Phase<2>) -> f64 {
        phase.share_of(self.steps)
    }

    fn particles<'a>(&self, _: &Rows, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.each("vx", "m/s", |p, k| p.velocity[k][0]).stress("stress_xx", [0, 0])
    }

    fn metrics(&self, seen: &Rows, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let [noise, kept, of_velocity, momentum, kinetic, stored] =
            ["stress_noise", "stress_kept", "velocity_noise", "momentum", "kinetic_energy", "stored_energy"]
                .map(|name| seen.column(name));
        let rows = 0..noise.len();
        let largest = |of: &dyn Fn(usize) -> f64| rows.clone().map(of).fold(0.0, f64::max);
        let mean = mean(noise[noise.len() / 2..].iter().copied());
        let energy = |k: usize| kinetic[k] + stored[k];
        let rise = |k: usize| (energy(k) - energy(0)) / kinetic[0];
        let mut values = vec![
            (STRESS_NOISE, largest(&|k| noise[k]).max(LEAST_NOISE)),
            (STRESS_NOISE_MEAN, mean.max(LEAST_NOISE)),
            (STRESS_KEPT, kept.last().copied().unwrap_or(f64::NAN)),
            (VELOCITY_NOISE, largest(&|k| of_velocity[k]).max(LEAST_NOISE)),
            (MOMENTUM_ERROR, largest(&|k| (momentum[k] / momentum[0] - 1.0).abs()).max(LEAST_ERROR)),
            (ENERGY_GAIN, largest(&rise)),
            (ENERGY_LOSS, largest(&|k| -rise(k))),
            (MASS, phase.run.totals().mass),
        ];
        if self.setup.remedy() == RemedyName::None && self.setup.transfer() == TransferName::Flip {
            values.push((PREDICTED_NOISE, self.predicted()));
        }
        values
    }
}
