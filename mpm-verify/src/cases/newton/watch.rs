//! A column under its own weight in a few load steps, and what is seen of it.

use super::exact::Column as Exact;
use super::metrics as m;
use super::parameters::{GAP, LOAD, LOAD_STEPS, POISSON_RATIO, PPC_PER_DIRECTION, STANDS, SUPPORT};
use crate::cases::observe::{column, finds_equilibrium, position_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::contact::{Barrier, RigidContact, RigidFace};
use mpm_core::material::Hencky;
use mpm_core::stage::{End, Gravity, Wall, WallKind};
use mpm_core::{
    Axis, Body, Error as Fault, Grid, Law, Part, Particles, Scene, Side, Simulation, implicit,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::E;

/// Height of the column (m), and cells across it.
const HEIGHT: f64 = 1.0;
const ACROSS: usize = 4;
/// Young's modulus (Pa) and density (kg/m³).
const YOUNG_MODULUS: f64 = 1e6;
const DENSITY: f64 = 1000.0;
/// Place among the constraints of what holds the upper end.
const UPPER_END: usize = 2;
/// Distance at which the barrier begins, in cells, and the share of it at which it carries the weight.
const REACH: f64 = 0.25;
const CARRIES: f64 = 0.5;

/// What has been seen.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Seen {
    stopped: bool,
    parts: u32,
}

/// A column.
pub(super) struct Loaded {
    spec: RunSpec,
    parameters: Parameters,
    law: Hencky,
    /// M (Pa), and the weight per area (Pa).
    modulus: f64,
    weight: f64,
}

impl Loaded {
    /// A run at its start; its time is the share of the load.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let law = Hencky::new(YOUNG_MODULUS, parameters.number(POISSON_RATIO))?;
        let modulus = DENSITY * law.wave_speed(DENSITY).powi(2);
        let loaded = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            law,
            modulus,
            weight: parameters.number(LOAD) * modulus / E,
        };
        Ok(Drive::new(loaded, Seen::default())?)
    }

    fn stands(&self) -> bool {
        self.parameters.is(SUPPORT, STANDS)
    }

    fn spacing(&self) -> f64 {
        self.spec.level.h / self.parameters.number(PPC_PER_DIRECTION)
    }

    /// The exact column at a share of the load, if there is one.
    fn exact(&self, share: f64) -> Option<Exact> {
        let sign = if self.stands() { -1.0 } else { 1.0 };
        Exact::new(sign * share * self.weight / self.modulus)
    }

    /// The barrier that carries the weight of a column of particles at a part of its distance.
    fn barrier(&self) -> Result<Barrier, Fault> {
        let reach = REACH * self.spec.level.h;
        Barrier::carrying_at(self.weight * self.spacing(), CARRIES * reach, reach)
    }

    /// Gaps of the lowest particles (m): their mean, and the exact one at a share of the load.
    fn gaps(&self, run: &dyn Simulation<2>, share: f64) -> Result<[f64; 2], Fault> {
        let (p, floor) = (run.particles(), self.floor());
        let lowest = p.reference.iter().zip(&p.position);
        let lowest = lowest.filter(|([_, y], _)| *y < self.spacing());
        let gaps: Vec<f64> = lowest.map(|(_, [_, y])| y - floor).collect();
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        let exact = self.barrier()?.gap(share * self.weight * self.spacing());
        Ok([mean, exact])
    }

    /// Where the floor is (m).
    fn floor(&self) -> f64 {
        0.5 * self.spacing() - self.parameters.number(GAP) * REACH * self.spec.level.h
    }

    /// Rms over the particles of what the displacement differs from the exact one by, over the height.
    fn error(&self, run: &dyn Simulation<2>, share: f64) -> Option<f64> {
        let exact = self.exact(share)?;
        let p = run.particles();
        let each = p.reference.iter().zip(&p.position);
        let moved: Vec<[f64; 2]> = each
            .map(|([_, from], [_, to])| {
                let distance = if self.stands() { HEIGHT - from } else { *from };
                let away = exact.at(distance / HEIGHT) * HEIGHT;
                let along = if self.stands() { away } else { -away };
                [to - from, along]
            })
            .collect();
        // A column that stands moves with the gap as well, which is another matter.
        let count = moved.len() as f64;
        let shift = if self.stands() {
            moved.iter().map(|[u, exact]| u - exact).sum::<f64>() / count
        } else {
            0.0
        };
        Some(rms(moved
            .iter()
            .map(|[u, exact]| (u - exact - shift) / HEIGHT)))
    }
}

impl Watch<2> for Loaded {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        let per_direction = self.parameters.number(PPC_PER_DIRECTION);
        Discretisation {
            dim: 2,
            h: self.spec.level.h,
            ppc: per_direction.powi(2) as u32,
            dt: 1.0 / self.parameters.number(LOAD_STEPS),
            wall: "open-knot".to_owned(),
        }
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, Fault> {
        let (h, spacing) = (self.spec.level.h, self.spacing());
        let cells = (HEIGHT / h).round() as usize;
        let upward = if self.stands() {
            Axis::open(-HEIGHT, 3 * cells)
        } else {
            // Room for a column that has been stretched to e times its height.
            Axis::bounded(-2.0 * HEIGHT, 3 * cells, (Side::Open, Side::Wall))
        };
        let grid = Grid::new(h, [Axis::walls(0.0, ACROSS), upward])?;
        let counts = [ACROSS as f64 * h, HEIGHT].map(|l| (l / spacing).round() as usize);
        let place = |k: usize| [k % counts[0], k / counts[0]].map(|k| (k as f64 + 0.5) * spacing);
        let places = (0..counts[0] * counts[1]).map(place).collect();
        let places = self.spec.start_at(places);
        let particles = Particles::new(places, spacing * spacing, DENSITY, [0.5 * spacing; 2])?;
        let gravity = self.weight / (DENSITY * HEIGHT);
        let roller = |axis, end| Wall {
            axis,
            end,
            kind: WallKind::Roller,
        };
        let mut scene = Scene::new(grid, Body::new(self.law, particles)?)
            .load(Gravity(Box::new(move |share| [0.0, -share * gravity])))
            .constrain(roller(0, End::Lo))
            .constrain(roller(0, End::Hi));
        if self.stands() {
            let face = RigidFace::half_space(1, End::Lo, self.floor())?;
            scene = scene.contact(RigidContact::new(face, self.barrier()?));
        } else {
            scene = scene.constrain(roller(1, End::Hi));
        }
        let settings = implicit::Settings::new(1.0 / self.parameters.number(LOAD_STEPS));
        mpm_solvers::implicit(self.spec.scheme, scene, settings)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "load (-)",
            "equilibrium_error (-)",
            "newton_iterations (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, Fault> {
        let before = stage.work().newton_iterations;
        // A step that finds none has told what it should: the run stays at the last one found.
        seen.stopped = !finds_equilibrium(stage.steps(1))?;
        let run = stage.run.as_ref();
        let parts = run.convergence().map_or(0, |c| c.parts);
        seen.parts = seen.parts.max(parts);
        // A step that was not taken is a row of its end.
        let step = 1.0 / self.parameters.number(LOAD_STEPS);
        let ahead = if seen.stopped { step } else { 0.0 };
        Ok(vec![
            run.time() + ahead,
            self.error(run, run.time()).unwrap_or(f64::NAN),
            (stage.work().newton_iterations - before) as f64,
            f64::from(parts),
        ])
    }

    fn progress(&self, seen: &Seen, stage: &Stage<2>) -> f64 {
        if seen.stopped {
            return 1.0;
        }
        stage.run.work().steps as f64 / self.parameters.number(LOAD_STEPS)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let stress = stage.run.force_stress();
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.push(column("stress_yy", "Pa", p.seeded(|k| stress[k].get(1, 1))));
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let carried = run.time();
        let bearable = if self.stands() {
            1.0
        } else {
            (1.0 / self.parameters.number(LOAD)).min(1.0)
        };
        let cells = (self.spec.level.h / HEIGHT).powi(2);
        let mut values = vec![
            (m::CARRIED, carried),
            (m::BEARABLE, bearable),
            (m::NEWTON_ITERATIONS, stage.work().newton_iterations as f64),
            (m::PARTS, f64::from(seen.parts)),
        ];
        if carried > 0.0 {
            let error = self.error(run, carried);
            let exact = self.exact(carried);
            values.extend(error.map(|e| (m::EQUILIBRIUM_ERROR, e)));
            values.extend(exact.map(|e| (m::BOUND, cells * e.curvature)));
            let held = if self.stands() {
                Part::Contact(0)
            } else {
                Part::Constraint(UPPER_END)
            };
            let area = ACROSS as f64 * self.spec.level.h;
            let weight = carried * self.weight * area;
            let force = run.on(held).force[1].abs();
            values.push((m::REACTION_ERROR, force / weight - 1.0));
            if self.stands()
                && let Ok([mean, exact]) = self.gaps(run, carried)
            {
                let reach = REACH * self.spec.level.h;
                values.push((m::GAP_ERROR, (mean - exact) / reach));
            }
        }
        values
    }
}
