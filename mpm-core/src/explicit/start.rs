//! A solver at time zero.

use super::between::Touching;
use super::remedy::Deformation;
use super::second_half::SecondHalf;
use super::{ChunkSums, NodeSums, Settings, Solver, Transfer, VelocityField, check_cfl};
use crate::basis::Basis;
use crate::error::{Error, positive, require};
use crate::lattice::Lattice;
use crate::ledger::Ledger;
use crate::nodes::{NodalState, Node};
use crate::order::Slabs;
use crate::parallel::{CHUNK, NODE_CHUNK};
use crate::projection::{Onto, space};
use crate::reach::Reach;
use crate::room::Room;
use crate::scene::Scene;
use crate::stage::{Prescribed, holder, require_held};

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// A solver of `scene` with `settings` at time zero.
    ///
    /// # Errors
    /// A time step or particle that is not allowed; a particle off the grid; a time step beyond the CFL limit; a
    /// particle in a rigid body; a constraint that holds no node of its own; bodies that slide where an axis is periodic.
    pub fn new(mut scene: Scene<D>, mut settings: Settings<D, T>) -> Result<Self, Error> {
        positive(settings.dt, "time step", "positive (s)")?;
        scene.check_half_size()?;
        let particles = &mut scene.bodies.particles;
        let lattice = Lattice::new(scene.grid, settings.wall);
        settings.remedy.attach(particles);
        settings.transfer.attach(particles);
        let mut loads = scene.loads.iter();
        let on_nodes = loads.all(|load| load.acceleration(0.0).is_some());
        if on_nodes && scene.contacts.is_empty() {
            particles.external_force = Vec::new();
        }
        particles.delta_f = Vec::new();
        if scene.contacts.is_empty() {
            particles.increment = Vec::new();
        }
        let n = particles.len();
        let (bodies, onto) = (&scene.bodies, settings.remedy.averages_onto());
        let lengths: Vec<usize> = bodies.each.iter().map(|body| body.range().len()).collect();
        let in_one_pass = onto == Some(Onto::Patches) && scene.contacts.is_empty();
        let deformation = match (onto.is_some() || !scene.contacts.is_empty()) && !in_one_pass {
            true => Deformation::of(settings.remedy.as_ref(), &lengths),
            false => Deformation::default(),
        };
        let mut columns = settings.remedy.columns(n);
        if in_one_pass {
            (columns.next, columns.rest) = Default::default();
        }
        let (slide, stick): (Vec<usize>, _) = (0..lengths.len()).partition(|k| bodies.each[*k].slides.is_some());
        let groups = [stick].into_iter().chain(slide.into_iter().map(|body| vec![body]));
        let field = |bodies: Vec<usize>| VelocityField {
            slabs: vec![Slabs::new(); bodies.len()],
            bodies,
            nodes: vec![NodalState::default(); lattice.len()],
            reach: Reach::everything(&lattice),
            prescribed: Vec::new(),
            transfer: settings.transfer.clone(),
        };
        let fields: Vec<_> = groups.filter(|bodies| !bodies.is_empty()).map(field).collect();
        let several = fields.len() > 1;
        let field_of = |body| fields.iter().position(|field| field.bodies.contains(&body)).unwrap_or_default();
        let density: Vec<f64> = bodies.each.iter().map(|body| body.least_density(&bodies.particles)).collect();
        let half_size = &bodies.particles.half_size;
        let second_half = |density| SecondHalf::of::<S, B>(&scene.grid, settings.dt, density, half_size);
        require(!(several && lattice.has_images()), "bodies that slide, on axes that are periodic", 1.0, "0")?;
        let mut solver = Self {
            touching: Touching::new(if several { lattice.len() } else { 0 }),
            field_of: (0..lengths.len()).map(field_of).collect(),
            second_half: density.iter().copied().map(second_half).collect(),
            fields,
            gravity: Node::ZERO,
            spaces: lengths.iter().map(|_| space::<D, S, B>(scene.grid, settings.wall, onto)).collect(),
            declared: Vec::new(),
            amplitudes: vec![0.0; scene.constraints.len()],
            shifts: vec![[0.0; D]; scene.constraints.len()],
            columns,
            in_one_pass,
            scratch: Vec::new(),
            mean_is_current: false,
            deformation,
            chunk_sums: vec![ChunkSums::default(); lengths.iter().map(|n| n.div_ceil(CHUNK)).sum()],
            node_sums: vec![NodeSums::default(); lattice.len().div_ceil(NODE_CHUNK)],
            drift: 0.0,
            density,
            wave_modulus: bodies.wave_moduli(),
            ledger: Ledger::new([n, lattice.len()], scene.constraints.len(), bodies.each.len()),
            transfer_pairs: 2 * (S as u64).pow(D as u32),
            lattice,
            scene,
            settings,
        };
        solver.check_positions()?;
        solver.attach_contacts()?;
        solver.declare_constraints(0.0)?;
        solver.sort();
        Ok(solver)
    }

    /// Declares what constraints hold at `time` (s).
    pub(super) fn declare_constraints(&mut self, time: f64) -> Result<(), Error> {
        let (lattice, scene) = (&self.lattice, &self.scene);
        let declared = &mut self.declared;
        declared.clear();
        lattice.for_each_node(|node, index| {
            let position = lattice.position(index);
            for axis in 0..D {
                let first = holder(&scene.constraints, &scene.grid, &position, (axis, time));
                declared.extend(first.map(|(by, full_velocity)| Prescribed {
                    node,
                    axis,
                    velocity: full_velocity,
                    full_velocity,
                    bound: scene.constraints[by].bound(),
                    friction: scene.constraints[by].friction(),
                    force: 0.0,
                    by,
                }));
            }
        });
        // Friction slows a node before another constraint holds it; the order has no ties, and needs no room.
        if declared.iter().any(|held| held.friction > 0.0) {
            declared.sort_unstable_by(|a, b| {
                let places = (a.node, a.axis).cmp(&(b.node, b.axis));
                b.friction.total_cmp(&a.friction).then(places)
            });
        }
        require_held(scene.constraints.len(), declared.iter().map(|held| held.by))
    }

    fn check_positions(&mut self) -> Result<(), Error> {
        check_cfl(self.wave_speed() * self.settings.dt, self.scene.grid.h).map_err(|fault| self.breakdown(0, fault))?;
        let beyond = self.scene.bodies.particles.half_size.map(B::beyond_wall);
        let room = Room::new(&self.scene.grid, beyond);
        for k in 0..self.scene.bodies.particles.len() {
            let mut x = self.scene.bodies.particles.position[k];
            room.place(&mut x).map_err(|fault| self.breakdown(k, fault))?;
            self.scene.bodies.particles.position[k] = x;
        }
        Ok(())
    }
}
