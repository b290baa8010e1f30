//! Scene and errors of the clouds: a row for each cloud.

use super::*;
use crate::cases::manufactured::{errors, forcing, vector};
use crate::exact::vortex_box::ENTRY;

/// Largest angle of the vortex (rad): so small that particles stay where they are.
const ANGLE: f64 = 0.01;
/// Time (s) to the largest angle of a body that moves, and of one that is always in equilibrium.
const MOVING: f64 = 0.5;
const SLOW: f64 = 1e6;

#[derive(Serialize, Deserialize)]
pub(super) struct Cloud {
    /// Relative errors of displacement and stress, and the displacement along the exact one; none of a cloud that breaks
    /// down.
    found: Option<[f64; 3]>,
    work: WorkDone,
}

pub(super) struct Clouds {
    setup: Setup<Sparse>,
    solution: Arc<dyn Exact>,
    law: NeoHookean,
    dt: f64,
    steps: u64,
}

impl Analysis for Clouds {
    type Parameters = Sparse;
    type Found = Cloud;

    fn new(setup: Setup<Sparse>) -> Result<Self, Error> {
        let slow = match setup.scheme {
            Scheme::Explicit(_) => false,
            Scheme::Implicit(parts) if parts.rule == RuleName::QuasiStatic => true,
            other => {
                return Err(Error::unknown("solver of clouds", other.solver(), ["explicit", "quasi-static"]));
            }
        };
        if setup.layout == Layout::Holes && setup.ppc_per_direction < 2 {
            return Err(Error::Input(
                "ppc_per_direction = 1 with layout = holes leaves no particle; allowed: from 2 on".to_owned(),
            ));
        }
        let duration = if slow { SLOW } else { MOVING };
        let set = [
            format!("poisson_ratio={}", setup.poisson_ratio),
            format!("angle={ANGLE}"),
            format!("angular_frequency={}", 0.5 * PI / duration),
        ];
        let solution: Arc<dyn Exact> = (ENTRY.build)(&Parameters::new(ENTRY.parameters, &set)?)?.into();
        let Material { mu, lambda, density } = solution.material();
        let law = NeoHookean { mu, lambda };
        let longest = match slow {
            true => duration,
            false => courant_time_step(setup.cfl, setup.h, law.wave_speed(density)),
        };
        let steps = (duration / longest).ceil();
        Ok(Self { solution, law, dt: duration / steps, steps: steps as u64, setup })
    }

    fn discretisation(&self) -> Discretisation {
        let full = self.setup.regular(2, self.dt);
        Discretisation { ppc: full.ppc - u32::from(self.setup.layout == Layout::Holes), ..full }
    }

    fn rows(&self) -> usize {
        if self.setup.layout == Layout::Lattice { 1 } else { self.setup.seeds }
    }

    fn analyse(&self, k: usize) -> Result<Cloud, Fault> {
        let mut run = self.begin(k)?;
        let found = finds_equilibrium((0..self.steps).try_for_each(|_| run.step()))?;
        let found = found.then(|| self.errors(run.as_mut()));
        Ok(Cloud { found, work: run.work().into() })
    }

    fn row(&self, k: usize, cloud: &Cloud) -> Row {
        let [displacement, stress, along] = cloud.found.unwrap_or([f64::NAN; 3]);
        row! {
            "seed (-)": k as f64,
            "displacement_error (-)": displacement,
            "stress_error (-)": stress,
            "along (-)": along,
        }
    }

    fn places(&self) -> Vec<[f64; 2]> {
        self.cloud(0)
    }

    fn metrics(&self, rows: &[Cloud]) -> Vec<(Metric, f64)> {
        let of = |which: usize, share: f64| {
            let value = |row: &Cloud| row.found.map_or(f64::INFINITY, |found| found[which]);
            quantile(rows.iter().map(value).collect(), share)
        };
        let broken = rows.iter().filter(|row| row.found.is_none()).count();
        vec![
            (ERROR_MEDIAN, of(0, 0.5)),
            (ERROR_HIGH, of(0, 0.9)),
            (STRESS_MEDIAN, of(1, 0.5)),
            (SOFTENING, of(2, 0.5) - 1.0),
            (BROKEN, broken as f64 / rows.len() as f64),
        ]
    }

    fn work(&self, rows: &[Cloud]) -> WorkDone {
        let add = |sum: WorkDone, row: &Cloud| row.work.after(sum);
        let none = WorkDone { particles: self.cloud(0).len() as u64, ..WorkDone::default() };
        rows.iter().fold(none, add)
    }
}

impl Clouds {
    fn cells(&self) -> usize {
        (1.0 / self.setup.h).round() as usize
    }

    fn per_direction(&self) -> usize {
        self.setup.ppc_per_direction
    }

    /// Places (m) of the `k`-th cloud.
    fn cloud(&self, k: usize) -> Vec<[f64; 2]> {
        let (cells, n, h) = (self.cells(), self.per_direction(), self.setup.h);
        let count = cells * cells * n * n;
        // A number from 0 to 1, of its own for every cloud, particle and axis.
        let chance = |p: usize, axis: usize| 0.5 + 0.5 * noise((k * count + p) * 3 + axis);
        let is = |layout| self.setup.layout == layout;
        let cell_of = |p: usize| [p / (n * n) % cells, p / (n * n) / cells];
        let part_of = |p: usize| [p % (n * n) % n, p % (n * n) / n];
        let place = |p: usize| {
            std::array::from_fn(|a| {
                let (cell, part) = (cell_of(p)[a] as f64, part_of(p)[a] as f64);
                if is(Layout::Scattered) {
                    chance(p, a)
                } else if is(Layout::Jittered) {
                    h * (cell + (part + chance(p, a)) / n as f64)
                } else if is(Layout::Lattice) || is(Layout::Holes) {
                    h * (cell + (part + 0.5) / n as f64)
                } else {
                    h * (cell + chance(p, a))
                }
            })
        };
        let stays = |p: &usize| {
            let lacks = (chance(p / (n * n), 2) * (n * n) as f64) as usize;
            !is(Layout::Holes) || p % (n * n) != lacks
        };
        (0..count).filter(stays).map(place).collect()
    }

    fn particles_of(&self, k: usize) -> Result<Particles<2>, Fault> {
        let places = self.cloud(k);
        let volume = 1.0 / places.len() as f64;
        let half = 0.5 * self.setup.h / self.per_direction() as f64;
        let density = self.solution.material().density;
        let mut particles = Particles::new(self.setup.start_at(places), volume, density, [half; 2])?;
        // Velocities of an explicit run live half a step before places.
        let since = -0.5 * self.dt;
        if let Scheme::Explicit(_) = self.setup.scheme {
            for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
                let exact = self.solution.velocity(&vector(x), since);
                *v = [exact.x, exact.y];
            }
        }
        Ok(particles)
    }

    fn begin(&self, k: usize) -> Begun<2> {
        let axis = Axis::walls(0.0, self.cells());
        let grid = Grid::new(self.setup.h, [axis, axis])?;
        let ends = [(0, End::Lo), (0, End::Hi), (1, End::Lo), (1, End::Hi)];
        let scene = Scene::new(grid, Bodies::new(self.law, self.particles_of(k)?)?)
            .load(forcing(&self.solution))
            .constrain_all(ends.map(|(axis, end)| roller(axis, end)));
        self.setup.moving(scene, self.dt, 0.0)
    }

    /// Relative errors of displacement and stress, and the displacement along the exact one.
    fn errors(&self, run: &mut dyn Simulation<2>) -> [f64; 3] {
        let (solution, t) = (self.solution.as_ref(), run.time());
        let stress = errors::of_stress(solution, run);
        let p = run.particles();
        let exact = |k: usize| solution.displacement(&vector(&p.reference[k]), t);
        let off = |k: usize| errors::of_displacement(solution, p, k, t);
        let stress_of = |k: usize| solution.first_piola(&vector(&p.reference[k]), t).norm();
        let all = || 0..p.len();
        let along: f64 = all().map(|k| (exact(k) + off(k)).dot(&exact(k))).sum();
        let squares: f64 = all().map(|k| exact(k).norm_squared()).sum();
        [
            rms(all().map(|k| off(k).norm())) / rms(all().map(|k| exact(k).norm())),
            rms(stress.iter().map(|s| s.norm())) / rms(all().map(stress_of)),
            along / squares,
        ]
    }
}

/// The least value that this share of all reaches.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = (share * values.len() as f64).ceil() as usize;
    values.get(place.max(1) - 1).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_reached_by_its_share() {
        let values: Vec<f64> = (1..=20).rev().map(f64::from).collect();
        assert_eq!(quantile(values.clone(), 0.5), 10.0);
        assert_eq!(quantile(values, 0.9), 18.0);
        assert!(quantile(vec![1.0, f64::INFINITY], 0.9).is_infinite());
    }
}
