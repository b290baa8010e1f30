//! Quasi-static equilibrium by Newton's method: `docs/implicit.md` derives it, and equation numbers here are that
//! page's.
//!
//! Shape functions, particle positions, states and the F̄ average are frozen at the start of the step. The unknowns are
//! the increments of the nodes; a trial of them changes nothing, and the converged one is committed. Then the grid is
//! as before and the particles have moved.
//!
//! The law, its derivatives and the stages are those of the explicit solver; velocities, masses of nodes and transfers
//! do not exist here.

pub(crate) mod algebra;
mod average;
mod cause;
mod cells;
mod commit;
mod contact;
mod domains;
mod dynamics;
pub(crate) mod elements;
mod equilibrium;
pub(crate) mod failure;
mod functions;
mod ghost;
pub(crate) mod held;
mod inertia;
mod interpolation;
pub(crate) mod linear;
mod memory;
pub(crate) mod newton;
mod penalty;
mod pieces;
mod q8;
pub(crate) mod response;
mod settings;
mod soft;
pub(crate) mod start;
mod system;
pub(crate) mod unknowns;

pub use domains::{Domains, HalfSizes};
pub use functions::Functions;
pub use interpolation::{Interpolation, OfHats};
pub use penalty::{Moduli, Penalty};
pub use pieces::{AxisPieces, Pieces};
pub use q8::Serendipity;
pub use settings::{GHOST, Remedy, Settings, Stabilisation, TimeRule};

use crate::bodies::{Bodies, Body};
use crate::error::{Cause, Error};
use crate::ledger::Ledger;
use crate::memory::Saved;
use crate::parallel::{LIGHT, map};
use crate::scene::Scene;
use crate::simulation::{Field, Simulation};
use crate::space::embed;
use crate::tensor::SymmetricTensor;
use average::Average;
use contact::Obstacle;
use elements::Elements;
use equilibrium::Step;
use failure::{Failure, in_parts};
use held::Held;
use inertia::Inertia;
use linear::{Direct, Linear};
use nalgebra::{Matrix3, SVector};
use system::System;
use unknowns::{Pattern, Unknowns};

/// Least share of the elastic stiffness that the ghost penalty of ground that flows is made of.
const FLOWS: f64 = 1e-3;
/// Most steps that the penalty of one stands for, chosen: those of the finest runs that are kept (docs/cook.md).
const MOST_STEPS: f64 = 100.0;

/// Number of steps like that from loads `earlier` on (N) which raise the loads to these; one where none are raised.
fn steps_of_load<const D: usize>(earlier: &[SVector<f64, D>], loads: &[SVector<f64, D>]) -> f64 {
    let rise: f64 = loads.iter().zip(earlier).map(|(f, e)| (f - e).norm_squared()).sum();
    let whole: f64 = loads.iter().map(|f| f.norm_squared()).sum();
    if rise > 0.0 { (whole / rise).sqrt().clamp(1.0, MOST_STEPS) } else { 1.0 }
}

/// The implicit solver.
pub struct Solver<const D: usize> {
    scene: Scene<D>,
    settings: Settings,
    functions: Box<dyn Interpolation<D>>,
    /// Original of every node.
    originals: Vec<usize>,
    /// Constraint of every component of every node, if held.
    held: Vec<[Option<Held>; D]>,
    moduli: Moduli,
    direct: Direct,
    /// Increments of the nodes in the last part of a step, over its duration (m/s); empty before it.
    advance: Vec<[f64; D]>,
    ledger: Ledger,
}

/// Data of a part of a step.
struct Setting<const D: usize> {
    elements: Elements<D>,
    penalties: Vec<Penalty>,
    unknowns: Unknowns<D>,
    pattern: Pattern,
    average: Option<Average<D>>,
    inertia: Option<Inertia<D>>,
    obstacles: Vec<Obstacle<D>>,
}

impl<const D: usize> Simulation<D> for Solver<D> {
    /// A load step, in parts if the whole of it finds no equilibrium.
    fn step(&mut self) -> Result<(), Error> {
        let (start, dt) = (self.ledger.time, self.settings.dt);
        self.held = held::components(self.functions.as_ref(), &self.scene, start + 0.5 * dt)?;
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
        let setting = self.setting(self.settings.dt);
        let step = setting.step(&self.scene.bodies, self.settings.dt);
        let rest = vec![0.0; setting.unknowns.len()];
        match step.trial(&rest, self.functions.len()) {
            Err(_) => f64::NAN,
            Ok(trial) => {
                let values = step.stiffness(&step.tangents(&trial), &setting.pattern);
                linear::condition(contact::is_symmetric(&self.scene), &setting.pattern, &values)
            }
        }
    }

    fn force_stress(&mut self) -> Vec<SymmetricTensor> {
        let p = &self.scene.bodies.particles;
        if p.j_bar.is_empty() {
            return p.stress.clone();
        }
        let mut stress: Vec<SymmetricTensor> =
            (0..p.len()).map(|k| p.stress[k].scale_add_identity(p.j_bar[k] / p.jacobian[k], 0.0)).collect();
        let mean = |s: &SymmetricTensor| (0..D).map(|a| s.get(a, a)).sum::<f64>() / D as f64;
        let (elements, average) = self.averaging();
        let averaged = average.apply(&elements, &stress.iter().map(mean).collect::<Vec<_>>());
        for (stress, averaged) in stress.iter_mut().zip(averaged) {
            *stress = stress.scale_add_identity(1.0, averaged - mean(stress));
        }
        stress
    }

    fn field(&mut self, field: Field) -> Vec<f64> {
        match field {
            Field::PorePressure | Field::Porosity => Vec::new(),
            Field::PlasticStrain => self.scene.bodies.plastic_strain(),
            Field::MeanStress => self.force_stress().iter().map(|s| s.mean()).collect(),
            Field::AveragedMeanStress => {
                let mean = self.field(Field::MeanStress);
                let (elements, _) = self.averaging();
                let Bodies { particles, each } = &self.scene.bodies;
                let of_body = |body: &Body| {
                    let own = |p| if body.range().contains(&p) { particles.volume[p] } else { 0.0 };
                    let volume: Vec<f64> = (0..particles.len()).map(own).collect();
                    let average = Average::new(&elements, self.functions.len(), &volume, false);
                    average.project(&elements, &mean)[body.range()].to_vec()
                };
                each.iter().flat_map(of_body).collect()
            }
        }
    }

    fn body(&self) -> Result<Saved, Error> {
        Ok(self.scene.hand_over(self.scene.bodies.save()?)?)
    }

    fn take_over(&mut self, body: &Saved) -> Result<(), Error> {
        self.go_on_with(body)?;
        let started = self.start_accelerations();
        started.map_err(|failure| self.error(failure))
    }
}

impl<const D: usize> Setting<D> {
    /// The equations of a step of `dt` (s) of the body that this setting was made for.
    fn step<'a>(&'a self, bodies: &'a Bodies<D>, dt: f64) -> Step<'a, D> {
        Step {
            bodies,
            dt,
            elements: &self.elements,
            unknowns: &self.unknowns,
            penalties: &self.penalties,
            average: self.average.as_ref(),
            inertia: self.inertia.as_ref(),
            obstacles: &self.obstacles,
        }
    }
}

impl<const D: usize> Solver<D> {
    /// The functions at the particles, and the average.
    fn averaging(&self) -> (Elements<D>, Average<D>) {
        let particles = &self.scene.bodies.particles;
        let elements = Elements::new(self.functions.as_ref(), &self.originals, Domains::of(particles));
        let sharp = self.settings.remedy == Remedy::FbarConsistent;
        let average = Average::onto(self.settings.onto, self.functions.as_ref(), &elements, particles, sharp);
        (elements, average)
    }

    /// Setting of a step of `dt` (s) from the present state.
    fn setting(&self, dt: f64) -> Setting<D> {
        let particles = &self.scene.bodies.particles;
        let (elements, average) = self.averaging();
        let mut sizes = Vec::new();
        let within = Domains::of(particles).within(&mut sizes);
        let mut penalties = match self.settings.stabilisation {
            Stabilisation::None => Vec::new(),
            Stabilisation::Ghost(factor) => {
                let strength = factor * self.moduli.young();
                self.functions.ghost(strength, &self.kept_stiffness(&elements, dt), D, within)
            }
            Stabilisation::Soft(factor) => soft::penalties(self.functions.as_ref(), factor, self.moduli),
        };
        for node in penalties.iter_mut().flat_map(|p| &mut p.node) {
            *node = self.originals[*node];
        }
        let place = self.settings.rule.place();
        let travel = held::travel(&self.scene.constraints, self.ledger.time, dt);
        let prescribed = |node: usize, axis: usize| {
            let held = self.held[node][axis]?;
            Some(held.velocity * (place * travel[held.by]))
        };
        let nodes = self.functions.len();
        let unknowns = Unknowns::new((nodes, self.functions.grid().h), &elements, &penalties, prescribed);
        let average = Some(average).filter(|_| self.settings.remedy != Remedy::None);
        let width = D + usize::from(average.as_ref().is_some_and(Average::spreads));
        let cells = average.iter().flat_map(|average| &average.cells).map(|cell| &cell.node);
        let pattern = Pattern::new(width, &unknowns, &elements, penalties.iter().map(|p| &p.node).chain(cells));
        let inertia = Inertia::of(self.settings.rule, dt, &elements, nodes, particles);
        Setting {
            obstacles: self.obstacles(self.ledger.time + place * dt),
            inertia,
            elements,
            penalties,
            unknowns,
            pattern,
            average,
        }
    }

    /// Shares of the elastic shear stiffness that the particles of a body that yields keep along the increments of the
    /// part before: a ghost penalty of the elastic stiffness would resist flow. Empty where nothing has yielded.
    fn kept_stiffness(&self, elements: &Elements<D>, dt: f64) -> Vec<f64> {
        let (bodies, mu) = (&self.scene.bodies, self.moduli.mu);
        let flows = !self.advance.is_empty() && bodies.plastic_strain().iter().any(|strain| *strain != 0.0);
        if !flows {
            // Each of several bodies has the share that is its own.
            let several = bodies.each.iter().filter(|_| bodies.each.len() > 1);
            let share = |body: &Body| (start::moduli_of(body.law.as_ref(), dt).mu / mu).clamp(FLOWS, 1.0);
            return several.flat_map(|body| vec![share(body); body.range().len()]).collect();
        }
        let u: Vec<[f64; D]> = self.advance.iter().map(|rate| rate.map(|rate| rate * dt)).collect();
        let stress = |p: usize, f: &Matrix3<f64>| {
            let body = bodies.of(p);
            body.law.stress(f, dt, body.state(p)).to_matrix()
        };
        let deviator = |m: Matrix3<f64>| (m - Matrix3::identity() * (m.trace() / 3.0)).norm();
        map(bodies.particles.len(), LIGHT, |p| {
            let f = embed(&elements.deformation(p, &u));
            let change = deviator(stress(p, &f) - stress(p, &Matrix3::identity()));
            let elastic = mu * deviator(f + f.transpose());
            if elastic > 0.0 { (change / elastic).clamp(FLOWS, 1.0) } else { 1.0 }
        })
    }

    /// Puts the particles that the same nodes see side by side.
    fn sort(&mut self) {
        let bodies = &self.scene.bodies;
        let element = elements::of_domains(self.functions.as_ref(), Domains::of(&bodies.particles));
        let mut order: Vec<u32> = (0..element.len() as u32).collect();
        order.sort_by_key(|p| (bodies.place_of(*p as usize), element[*p as usize]));
        if !order.is_sorted() {
            self.scene.bodies.permute(&order);
            self.ledger.work.sorts += 1;
        }
    }

    /// The forces of the loads at `time` (s) on the nodes (N).
    fn external(&mut self, time: f64, elements: &Elements<D>) -> Vec<SVector<f64, D>> {
        let particles = &mut self.scene.bodies.particles;
        particles.external_force.fill([0.0; D]);
        for load in &self.scene.loads {
            load.add(time, particles);
        }
        elements.forces(self.functions.len(), &particles.external_force)
    }

    /// The increments (m) that a static step of `dt` (s) is looked for from: where something rigid moves, those of the
    /// step before, as a body that flows goes on to; else none.
    fn guess(&self, setting: &Setting<D>, dt: f64) -> Option<Vec<f64>> {
        let unknowns = &setting.unknowns;
        let pushed = setting.obstacles.iter().any(Obstacle::moves);
        let moves = pushed || unknowns.held.iter().flatten().any(|u| *u != 0.0);
        let goes_on = moves && self.settings.rule == TimeRule::Static && !self.advance.is_empty();
        let rates = unknowns.node.iter().flat_map(|node| self.advance[*node]);
        goes_on.then(|| rates.map(|rate| rate * dt).collect())
    }

    /// Norm of the forces (N) that rounding of stresses causes, by some last bits of the modulus of pressure waves: a
    /// nearly incompressible body has no smaller residual.
    fn rounding(&self, elements: &Elements<D>) -> f64 {
        let volume = &self.scene.bodies.particles.volume;
        let modulus = self.moduli.lambda + 2.0 * self.moduli.mu;
        elements.rounding(self.functions.len(), volume, modulus)
    }

    /// A part of a load step, of `dt` (s).
    fn part(&mut self, dt: f64) -> Result<(), Failure> {
        self.sort();
        let mut setting = self.setting(dt);
        let place = self.settings.rule.place();
        let earlier = self.external(self.ledger.time, &setting.elements);
        let external = self.external(self.ledger.time + place * dt, &setting.elements);
        if self.settings.rule == TimeRule::Static && matches!(self.settings.stabilisation, Stabilisation::Ghost(_)) {
            let steps = steps_of_load(&earlier, &external);
            setting.penalties.iter_mut().for_each(|penalty| penalty.stiffness *= steps);
        }
        let mut driving = external.clone();
        for (force, push) in driving.iter_mut().zip(setting.inertia.iter().flat_map(|i| &i.push)) {
            *force += push;
        }
        let rounding = self.rounding(&setting.elements);
        let guess = self.guess(&setting, dt);
        let mut linear = Linear { direct: &mut self.direct, ledger: &mut self.ledger };
        linear.analyse(&setting.pattern)?;
        let mut system = System {
            step: setting.step(&self.scene.bodies, place * dt),
            settings: &self.settings,
            rounding,
            external: &driving,
            pattern: &setting.pattern,
            linear,
            worn: true,
            start: 0.0,
        };
        let solution = system.solve(guess)?;
        let end = self.end_of_step(&setting, &solution, dt)?;
        let end = end.as_ref().unwrap_or(&solution.trial);
        let places = self.places_after(&setting.elements, end)?;
        self.accelerate(&setting, &solution, &external, dt)?;
        self.observe(&setting, &solution, end, [&earlier, &external], dt);
        self.advance = end.u.iter().map(|u| u.map(|u| u / dt)).collect();
        self.commit(end, &places, dt);
        self.stick(&end.pushes);
        self.ledger.convergence = Some(solution.convergence);
        Ok(())
    }

    fn error(&mut self, failure: Failure) -> Error {
        let cause = match failure {
            Failure::NoConvergence(..) => self.cause(true),
            Failure::Singular(_) => self.cause(false),
            Failure::Particle(..) | Failure::Lost(..) => Cause::Unknown,
        };
        failure.error(&self.ledger, &self.scene.bodies.particles.id, cause)
    }
}

#[cfg(test)]
mod tests;
