//! Scene and observations of the column, step by step; the time is the share of the load.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use crate::exact::uniaxial::{Body as Uniaxial, Column as Exact};
use mpm_core::implicit;
use std::f64::consts::E;

/// Height of the column (m), and cells across it.
const HEIGHT: f64 = 1.0;
const ACROSS: usize = 4;
/// Place among the constraints of what holds the upper end.
const UPPER_END: usize = 2;
/// Share of the barrier's distance at which it carries the weight.
const CARRIES: f64 = 0.5;

/// Observations: whether a step found no equilibrium, and the most parts of a step.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Found {
    stopped: bool,
    parts: u32,
    rate: Option<f64>,
}

impl Setup<Newton> {
    pub(super) fn stands(&self) -> bool {
        self.support == Support::Stands
    }
}

pub(super) struct Loaded {
    setup: Setup<Newton>,
    law: Hencky,
    /// M (Pa), and the weight per area (Pa).
    modulus: f64,
    weight: f64,
}

impl Loaded {
    fn settings(&self) -> implicit::Settings {
        implicit::Settings::new(1.0 / f64::from(self.setup.load_steps))
    }

    /// Shear modulus G (Pa).
    fn shear(&self) -> f64 {
        0.5 * YOUNG_MODULUS / (1.0 + self.setup.poisson_ratio)
    }

    fn uniaxial(&self) -> Uniaxial {
        let yields = self.setup.yield_strain;
        Uniaxial {
            yields: if yields > 0.0 { yields } else { f64::INFINITY },
            bulk: 1.0 - 4.0 / 3.0 * self.shear() / self.modulus,
        }
    }

    /// Largest error of the differences of J σ_yy from J σ_xx and J σ_zz where the exact column flows, over 2G times the
    /// strain of yield: √(3/2) κ. Above is a cell, of whose strains particles have means; nothing if none flows.
    fn flow_error(&self, run: &dyn Simulation<2>, share: f64) -> Option<f64> {
        let yields = self.setup.yield_strain;
        let left = 2.0 * self.shear() * yields;
        let depth = HEIGHT * yields * yields.exp() * self.modulus / (share * self.weight) + self.setup.h;
        let p = run.particles();
        let volume = if p.j_bar.is_empty() { &p.jacobian } else { &p.j_bar };
        let errors = (0..p.len()).filter(|k| HEIGHT - p.reference[*k][1] > depth).flat_map(|k| {
            let (s, j) = (&p.stress[k], volume[k]);
            [s.xx, s.zz].map(|lateral| (j * (lateral - s.yy) / left - 1.0).abs())
        });
        errors.reduce(f64::max)
    }

    /// The exact column at a share of the load, if there is one.
    fn exact(&self, share: f64) -> Option<Exact> {
        let sign = if self.setup.stands() { -1.0 } else { 1.0 };
        Exact::new(self.uniaxial(), sign * share * self.weight / self.modulus)
    }

    /// The barrier that carries the weight of a column of particles at a part of its distance.
    fn barrier(&self) -> Result<Barrier, Fault> {
        let reach = REACH * self.setup.h;
        Barrier::carrying_at(self.weight * self.setup.pitch(), CARRIES * reach, reach)
    }

    /// Gaps of the lowest particles (m): their mean, and the exact one at a share of the load.
    fn gaps(&self, run: &dyn Simulation<2>, share: f64) -> Result<[f64; 2], Fault> {
        let (p, floor) = (run.particles(), self.floor());
        let lowest = p.reference.iter().zip(&p.position).filter(|([_, y], _)| *y < self.setup.pitch());
        let mean = mean(lowest.map(|(_, [_, y])| y - floor));
        Ok([mean, self.barrier()?.gap(share * self.weight * self.setup.pitch())])
    }

    /// Height of the floor (m).
    fn floor(&self) -> f64 {
        0.5 * self.setup.pitch() - self.setup.gap * REACH * self.setup.h
    }

    /// Rms error of the displacements over the height; nothing if there is no exact equilibrium.
    fn error(&self, run: &dyn Simulation<2>, share: f64) -> Option<f64> {
        let exact = self.exact(share)?;
        let p = run.particles();
        let each = p.reference.iter().zip(&p.position);
        let moved: Vec<[f64; 2]> = each
            .map(|([_, from], [_, to])| {
                let distance = if self.setup.stands() { HEIGHT - from } else { *from };
                let away = exact.at(distance / HEIGHT) * HEIGHT;
                let along = if self.setup.stands() { away } else { -away };
                [to - from, along]
            })
            .collect();
        // A standing column moves with the gap as well, which is judged by itself.
        let shift = if self.setup.stands() { mean(moved.iter().map(|[u, exact]| u - exact)) } else { 0.0 };
        Some(rms(moved.iter().map(|[u, exact]| (u - exact - shift) / HEIGHT)))
    }

    /// The column of a law at its start.
    fn simulation(&self, law: impl Into<SharedLaw>) -> Begun<2> {
        let (h, spacing) = (self.setup.h, self.setup.pitch());
        let cells = (HEIGHT / h).round() as usize;
        let upward = if self.setup.stands() {
            Axis::open(-HEIGHT, 3 * cells)
        } else {
            // Room for a column that has been stretched to e times its height.
            Axis::bounded(-2.0 * HEIGHT, 3 * cells, (Side::Open, Side::Wall))
        };
        let grid = Grid::new(h, [Axis::walls(0.0, ACROSS), upward])?;
        let counts = [ACROSS as f64 * h, HEIGHT].map(|l| (l / spacing).round() as usize);
        let particles = self.setup.particles_at(by_rows(counts, spacing), spacing, DENSITY)?;
        let gravity = self.weight / (DENSITY * HEIGHT);
        let mut scene = Scene::new(grid, Bodies::new(law, particles)?)
            .load(Gravity(Box::new(move |share| [0.0, -share * gravity])))
            .constrain(roller(0, End::Lo))
            .constrain(roller(0, End::Hi));
        if self.setup.stands() {
            let face = RigidFace::half_space(1, End::Lo, self.floor())?;
            scene = scene.contact(RigidContact::new(face, self.barrier()?));
        } else {
            scene = scene.constrain(roller(1, End::Hi));
        }
        mpm_solvers::implicit(self.setup.scheme, scene, self.settings())
    }
}

impl Problem<2> for Loaded {
    type Parameters = Newton;
    type Seen = Found;

    fn new(setup: Setup<Newton>) -> Result<Self, Error> {
        if !setup.stands() {
            setup.forbid(&["yield_strain"])?;
        }
        let law = Hencky::new(YOUNG_MODULUS, setup.poisson_ratio)?;
        let modulus = DENSITY * law.wave_speed(DENSITY).powi(2);
        let weight = setup.load * modulus / E;
        Ok(Self { setup, law, modulus, weight })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, 1.0 / f64::from(self.setup.load_steps))
    }

    fn begin(&self, _: &Found) -> Begun<2> {
        let yields = self.setup.yield_strain;
        if yields == 0.0 {
            return self.simulation(self.law);
        }
        // The deviator of uniaxial strain v has the norm √(2/3) v.
        let strength = Strength::perfect((2.0 / 3.0_f64).sqrt() * 2.0 * self.shear() * yields)?;
        self.simulation(HenckyJ2::new(YOUNG_MODULUS, self.setup.poisson_ratio, strength)?)
    }

    fn row(&self, seen: &mut Found, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let before = phase.work().newton_iterations;
        // Without an equilibrium the run stays at the last one found.
        seen.stopped = !finds_equilibrium(phase.steps(1))?;
        let run = phase.run.as_ref();
        let parts = run.convergence().map_or(0, |c| c.parts);
        seen.parts = seen.parts.max(parts);
        let rate = run.convergence().and_then(|of| newton_rate(of, self.settings().tolerance));
        seen.rate = rate.into_iter().chain(seen.rate).reduce(f64::max);
        // A step that was not taken is a row of its end.
        let ahead = if seen.stopped { self.settings().dt } else { 0.0 };
        Ok(row! {
            "load (-)": run.time() + ahead,
            "equilibrium_error (-)": self.error(run, run.time()).unwrap_or(f64::NAN),
            "newton_iterations (-)": (phase.work().newton_iterations - before) as f64,
            "parts (-)": f64::from(parts),
        })
    }

    fn progress(&self, seen: &Found, phase: &Phase<2>) -> f64 {
        let share = phase.share_of(self.setup.load_steps as u64);
        if seen.stopped { 1.0 } else { share }
    }

    fn particles<'a>(&self, _: &Found, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.stress("stress_yy", [1, 1])
    }

    fn metrics(&self, seen: &Found, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        let carried = run.time();
        let bearable = if self.setup.stands() { 1.0 } else { (1.0 / self.setup.load).min(1.0) };
        let mut values = vec![
            (CARRIED, carried),
            (BEARABLE, bearable),
            (NEWTON_ITERATIONS, phase.work().newton_iterations as f64),
            (PARTS, f64::from(seen.parts)),
        ];
        if carried > 0.0 {
            values.extend(self.error(run, carried).map(|e| (EQUILIBRIUM_ERROR, e)));
            values.extend(self.exact(carried).map(|e| (BOUND, (self.setup.h / HEIGHT).powi(2) * e.curvature)));
            let held = if self.setup.stands() { Part::Contact(0) } else { Part::Constraint(UPPER_END) };
            let weight = carried * self.weight * ACROSS as f64 * self.setup.h;
            let force = run.on(held).force[1].abs();
            values.push((REACTION_ERROR, force / weight - 1.0));
            values.extend(seen.rate.map(|rate| (NEWTON_RATE, rate)));
            if self.setup.yield_strain > 0.0 {
                values.extend(self.flow_error(run, carried).map(|error| (FLOW_ERROR, error)));
            }
            if self.setup.stands()
                && let Ok([mean, exact]) = self.gaps(run, carried)
            {
                values.push((GAP_ERROR, (mean - exact) / (REACH * self.setup.h)));
            }
        }
        values
    }
}
