//! Solid and water, quasi-static, by Newton's method for displacements and pore pressures at once: the problem of
//! G. Pretti, R. E. Bird, N. D. Gavin, W. M. Coombs & C. E. Augarde, "A stable poro-mechanical formulation for material
//! point methods leveraging overlapping meshes and multi-field ghost penalisation" (doi:10.1002/nme.7630).
//! `docs/poromechanics.md` derives the scheme, and equation numbers here are that page's.
//!
//! A body with water has two lattices: one for displacements and one for pressures, of cells twice as large, or of the
//! same. Both are gathered at the step's start, as the quasi-static solver does, and share its Newton's parts. What
//! particles have beside those of a dry body are columns of this solver.

mod commit;
mod face;
mod memory;
mod outside;
mod plate;
mod pores;
mod response;
mod settings;
mod start;
mod step;
mod system;
mod unknowns;
mod water;

pub use face::{Face, OfPlace};
pub use plate::Plate;
pub use settings::{Predictor, PressureSpace, Settings, Tangent, VolumeRate};
pub use water::{Conductivity, Gravity, Medium, Source, Water};

use crate::bodies::Body;
use crate::error::{Cause, Error};
use crate::implicit::elements::{Elements, of_domains};
use crate::implicit::failure::{Failure, in_parts};
use crate::implicit::held::{self, Held};
use crate::implicit::linear::{self, Direct, Linear};
use crate::implicit::start::moduli_of;
use crate::implicit::{Functions, Moduli, OfHats};
use crate::ledger::Ledger;
use crate::memory::Saved;
use crate::monitor::WaterBalance;
use crate::scene::Scene;
use crate::simulation::{Field, Simulation};
use crate::tensor::SymmetricTensor;
use pores::Pores;
use step::{Setting, Step, solid_shares};
use system::System;
use unknowns::{Place, Unknowns};

/// Functions on a grid, and of every node the one that it is an image of.
struct Space<const D: usize> {
    functions: Box<dyn OfHats<D>>,
    originals: Vec<usize>,
}

/// The solver for bodies of solid and water, one or several that stick, with functions of one kind for displacement and pressure.
pub struct Solver<const D: usize> {
    scene: Scene<D>,
    water: Water<D>,
    settings: Settings,
    solid_space: Space<D>,
    water_space: Space<D>,
    pores: Pores<D>,
    /// Constraint of every component of every node of the displacement, if held.
    held: Vec<[Option<Held>; D]>,
    /// Plate of every component of every node of the displacement.
    tied: Vec<[Option<usize>; D]>,
    /// Whether a node of the pressure is held at zero.
    drained: Vec<bool>,
    moduli: Moduli,
    direct: Direct,
    ledger: Ledger,
    balance: WaterBalance,
    /// Pressures of the nodes after the last step (Pa); NaN of nodes that no particle sees.
    nodal_pressure: Vec<f64>,
}

impl<const D: usize> Simulation<D> for Solver<D> {
    /// A step, in parts if the whole of it finds no solution.
    fn step(&mut self) -> Result<(), Error> {
        let (start, dt) = (self.ledger.time, self.duration());
        self.held = held::components(self.solid_space.functions.as_ref(), &self.scene, start + 0.5 * dt)?;
        let parts = in_parts(self.settings.most_halvings, |done, size| {
            self.part(size * dt)?;
            self.ledger.time = start + (done + size) * dt;
            Ok(())
        })
        .map_err(|failure| self.error(failure))?;
        self.ledger.count_parts(parts);
        Ok(())
    }

    fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    fn scene(&self) -> &Scene<D> {
        &self.scene
    }

    fn condition(&self) -> f64 {
        let dt = self.duration();
        let of_rest = || {
            let setting = self.setting(dt, Vec::new()).ok()?;
            let step = self.equations(&setting, dt);
            let trial = step.trial(&setting.unknowns.begin(&self.predicted(&setting))).ok()?;
            let symmetric = self.settings.tangent == Tangent::Symmetric;
            let values = step.matrix(&trial);
            Some(linear::condition(symmetric, &setting.pattern, &values))
        };
        of_rest().unwrap_or(f64::NAN)
    }

    fn water(&self) -> Option<&WaterBalance> {
        Some(&self.balance)
    }

    fn pressure_nodes(&self) -> Vec<([f64; D], f64)> {
        let mut nodes = Vec::new();
        self.water_space.functions.for_each_node(&mut |node, place| {
            let pressure = self.nodal_pressure[node];
            if !pressure.is_nan() && self.water_space.originals[node] == node {
                nodes.push((place, pressure));
            }
        });
        nodes
    }

    /// The effective stress.
    fn force_stress(&mut self) -> Vec<SymmetricTensor> {
        self.scene.bodies.particles.stress.clone()
    }

    fn field(&mut self, field: Field) -> Vec<f64> {
        let particles = &self.scene.bodies.particles;
        match field {
            Field::PlasticStrain => self.scene.bodies.plastic_strain(),
            Field::MeanStress | Field::AveragedMeanStress => {
                particles.stress.iter().map(SymmetricTensor::mean).collect()
            }
            Field::PorePressure => self.pores.pressure.clone(),
            Field::Porosity => {
                let each = particles.jacobian.iter().zip(solid_shares(&self.scene.bodies, &self.water));
                each.map(|(j, solid)| 1.0 - solid / j).collect()
            }
        }
    }

    fn body(&self) -> Result<Saved, Error> {
        Ok(self.save_body()?)
    }

    fn take_over(&mut self, body: &Saved) -> Result<(), Error> {
        Ok(self.restore_body(body)?)
    }
}

impl<const D: usize> Solver<D> {
    /// Duration of the present step (s).
    fn duration(&self) -> f64 {
        self.settings.dt * self.settings.growth.powi(self.ledger.work.steps as i32)
    }

    fn equations<'a>(&'a self, setting: &'a Setting<D>, dt: f64) -> Step<'a, D> {
        Step { bodies: &self.scene.bodies, water: &self.water, settings: &self.settings, dt, setting }
    }

    /// Puts the particles that the same nodes see side by side.
    fn sort(&mut self) {
        let particles = &self.scene.bodies.particles;
        let domains = self.pores.domains(particles);
        let [of_solid, of_water] =
            [&self.solid_space, &self.water_space].map(|s| of_domains(s.functions.as_ref(), domains));
        let mut order: Vec<u32> = (0..particles.len() as u32).collect();
        let body = |p: u32| self.scene.bodies.place_of(p as usize);
        order.sort_by_key(|p| (body(*p), of_solid[*p as usize], of_water[*p as usize]));
        if !order.is_sorted() {
            self.scene.bodies.permute(&order);
            self.pores.permute(&order);
            self.ledger.work.sorts += 1;
        }
    }

    /// Functions of the pressure at every particle, less their means over the cell that holds its centre.
    fn fluctuations(&self, water: &Elements<D>) -> Vec<Vec<f64>> {
        let space = &self.water_space;
        let grid = space.functions.grid();
        let mut middle = Functions::new();
        let of = |(p, x): (usize, &[f64; D])| {
            let place = std::array::from_fn(|a| grid.axes[a].lo + grid.h * (grid.cell(a, x[a]) as f64 + 0.5));
            // In the middle of a cell a hat is its mean over the cell.
            space.functions.hats(&place, &mut middle);
            let (nodes, w, _) = water.seen(p);
            let mut own = w.to_vec();
            for (node, mean) in middle.node.iter().zip(&middle.w) {
                let place = nodes.iter().position(|n| *n == space.originals[*node]);
                if let Some(place) = place {
                    own[place] -= mean;
                }
            }
            own
        };
        let positions = &self.scene.bodies.particles.position;
        positions.iter().enumerate().map(of).collect()
    }

    /// The functions of displacement and pressure at the particles.
    fn elements(&self) -> [Elements<D>; 2] {
        let domains = self.pores.domains(&self.scene.bodies.particles);
        [&self.solid_space, &self.water_space]
            .map(|space| Elements::new(space.functions.as_ref(), &space.originals, domains))
    }

    /// The unknowns of a step of `dt` (s) on the functions of displacement and pressure.
    fn unknowns(&self, elements: [&Elements<D>; 2], dt: f64) -> Unknowns<D> {
        let spaces = [&self.solid_space, &self.water_space];
        let travel = held::travel(&self.scene.constraints, self.ledger.time, dt);
        Unknowns::new(
            elements,
            spaces.map(|s| s.functions.len()),
            spaces.map(|s| s.functions.grid().h),
            |node, axis| self.held[node][axis].map(|held| held.velocity * travel[held.by]),
            |node, axis| self.tied[node][axis],
            |node| self.drained[node].then_some(0.0),
        )
    }

    /// Setting of a step of `dt` (s) from the present state, under forces of loads on the particles (N).
    fn setting(&self, dt: f64, on_particles: Vec<[f64; D]>) -> Result<Setting<D>, Failure> {
        let particles = &self.scene.bodies.particles;
        let spaces = [&self.solid_space, &self.water_space];
        let [solid, water] = self.elements();
        let unknowns = self.unknowns([&solid, &water], dt);
        let mut runs: Vec<std::ops::Range<usize>> = Vec::new();
        for p in 0..particles.len() {
            let same = |p: usize, q: usize| {
                solid.element_of(p) == solid.element_of(q) && water.element_of(p) == water.element_of(q)
            };
            match runs.last_mut() {
                Some(run) if same(run.start, p) => run.end = p + 1,
                _ => runs.push(p..p + 1),
            }
        }
        let flow = self.water.greatest_conductivity() * dt;
        let shares = self.shares();
        let strengths = [self.settings.ghost_displacement * self.moduli.mu, self.settings.ghost_pressure * flow];
        // Cells that a domain touches by rounding alone are no part of the body: their nodes are no unknowns.
        let mut sizes = Vec::new();
        let within = self.pores.domains(particles).within(&mut sizes);
        let ghosts = [(0, D), (1, 1)].map(|(k, components)| {
            let space = spaces[k];
            if strengths[k] == 0.0 {
                return Vec::new();
            }
            let mut ghosts = space.functions.ghost(strengths[k], &shares[k], components, within);
            for node in ghosts.iter_mut().flat_map(|g| &mut g.node) {
                *node = space.originals[*node];
            }
            // Such a node would hold those beside it.
            ghosts.retain(|g| g.node.iter().all(|node| unknowns.sees(k, *node)));
            ghosts
        });
        let mut groups: Vec<Vec<Option<usize>>> =
            (runs.iter()).map(|run| unknowns.of(solid.seen(run.start).0, water.seen(run.start).0)).collect();
        groups.extend(ghosts[0].iter().map(|g| unknowns.of(&g.node, &[])));
        groups.extend(ghosts[1].iter().map(|g| unknowns.of(&[], &g.node)));
        let mut external = solid.forces(self.solid_space.functions.len(), &on_particles);
        let drains = self.outside(dt, &unknowns, &mut external)?;
        let mut all = groups.clone();
        all.extend(drains.iter().map(|d| d.unknown.clone()));
        let projects = matches!(self.settings.pressure_space, PressureSpace::Projected { .. });
        Ok(Setting {
            pattern: unknowns::pattern(unknowns.count, &all),
            inflow: self.inflow(&water, dt),
            before: self.before(&water, &unknowns),
            fluctuations: if projects { self.fluctuations(&water) } else { Vec::new() },
            solid,
            water,
            unknowns,
            runs,
            ghosts,
            groups,
            drains,
            external,
        })
    }

    /// Shares of their strengths that the ghost penalties on displacement and pressure have at every particle: its body's
    /// stiffness and conductivity over the greatest. Empty of one body.
    fn shares(&self) -> [Vec<f64>; 2] {
        let bodies = &self.scene.bodies;
        if bodies.each.len() == 1 {
            return [Vec::new(), Vec::new()];
        }
        let greatest = [self.moduli.mu, self.water.greatest_conductivity()];
        let of = |(body, medium): (&Body, &Medium)| {
            [moduli_of(body.law.as_ref(), self.settings.dt).mu, medium.initial_conductivity()]
        };
        let each: Vec<[f64; 2]> = bodies.each.iter().zip(&self.water.media).map(of).collect();
        [0, 1].map(|k| {
            let own = bodies.each.iter().zip(&each);
            own.flat_map(|(body, each)| vec![each[k] / greatest[k]; body.range().len()]).collect()
        })
    }

    /// Pressures of the nodes (Pa) at a step's start, from which increments are measured: those of the step before; of
    /// a node that no particle saw then what particles say of it. None where nothing acts on increments.
    fn before(&self, water: &Elements<D>, unknowns: &Unknowns<D>) -> Vec<f64> {
        let mut before = vec![0.0; self.water_space.functions.len()];
        if self.pores.slope.is_empty() {
            return before;
        }
        let functions = &self.water_space.functions;
        let told = unknowns::extrapolated(water, functions.as_ref(), &self.scene.bodies.particles, &self.pores);
        for (node, place) in unknowns.pressure.iter().enumerate() {
            if *place != Place::Unseen {
                let known = self.nodal_pressure[node];
                before[node] = if known.is_nan() { told[node] } else { known };
            }
        }
        before
    }

    /// Volumes of water (m³) that sources give to the nodes in a step of `dt` (s); none without sources.
    fn inflow(&self, water: &Elements<D>, dt: f64) -> Vec<f64> {
        let particles = &self.scene.bodies.particles;
        let span = [self.ledger.time, self.ledger.time + dt];
        let mut nodes = Vec::new();
        for source in &self.water.sources {
            nodes.resize(self.water_space.functions.len(), 0.0);
            let volume = |p: usize| source(&particles.reference[p], span) * particles.reference_volume[p];
            water.scatter_values(0.0, &mut nodes, volume);
        }
        nodes
    }

    /// Pressures of the nodes (Pa) to begin with.
    fn predicted(&self, setting: &Setting<D>) -> Vec<f64> {
        let nodes = self.water_space.functions.len();
        match self.settings.predictor {
            Predictor::Zero => vec![0.0; nodes],
            Predictor::Particles => {
                let particles = &self.scene.bodies.particles;
                unknowns::mapped(&setting.water, nodes, particles, &self.pores)
            }
        }
    }

    /// A part of a step, of `dt` (s).
    fn part(&mut self, dt: f64) -> Result<(), Failure> {
        self.sort();
        let particles = &mut self.scene.bodies.particles;
        particles.external_force.fill([0.0; D]);
        for load in &self.scene.loads {
            load.add(self.ledger.time + dt, particles);
        }
        let on_particles = particles.external_force.clone();
        let setting = self.setting(dt, on_particles)?;
        let begin = setting.unknowns.begin(&self.predicted(&setting));
        let rounding = self.rounding(&setting);
        let mut linear = Linear { direct: &mut self.direct, ledger: &mut self.ledger };
        linear.analyse(&setting.pattern)?;
        let mut system = System {
            step: Step {
                bodies: &self.scene.bodies,
                water: &self.water,
                settings: &self.settings,
                dt,
                setting: &setting,
            },
            rounding,
            linear,
            scales: Vec::new(),
        };
        let (trial, convergence) = system.solve(begin)?;
        self.commit(&setting, trial, dt)?;
        self.ledger.convergence = Some(convergence);
        Ok(())
    }

    /// Norm of the out-of-balance forces (N) that the last bits of the stresses leave.
    fn rounding(&self, setting: &Setting<D>) -> f64 {
        let volume = &self.scene.bodies.particles.volume;
        let modulus = self.moduli.lambda + 2.0 * self.moduli.mu;
        let nodes = self.solid_space.functions.len();
        setting.solid.rounding(nodes, volume, modulus)
    }

    fn error(&self, failure: Failure) -> Error {
        let ids = &self.scene.bodies.particles.id;
        failure.error(&self.ledger, ids, Cause::Unknown)
    }
}

#[cfg(test)]
mod tests;
