//! A solver at time zero.

use super::remedy::Deformation;
use super::{ChunkSums, NodeSums, Settings, Solver, Transfer, check_cfl};
use crate::basis::Basis;
use crate::error::{Error, positive};
use crate::lattice::Lattice;
use crate::ledger::Ledger;
use crate::nodes::{NodalState, Node};
use crate::parallel::{CHUNK, NODE_CHUNK};
use crate::projection::space;
use crate::reach::Reach;
use crate::room::Room;
use crate::scene::Scene;
use crate::stage::{Prescribed, require_held};

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// A solver of `scene` with `settings` at time zero.
    ///
    /// # Errors
    /// A time step or particle that is not allowed; a particle off the grid; a time step beyond the CFL limit; a
    /// particle in a rigid body; a constraint that holds no node of its own.
    pub fn new(mut scene: Scene<D>, mut settings: Settings<D, T>) -> Result<Self, Error> {
        positive(settings.dt, "time step", "positive (s)")?;
        scene.check_half_size()?;
        let particles = &mut scene.body.particles;
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
        let deformation = match settings.remedy.averages_onto().is_some() || !scene.contacts.is_empty() {
            true => Deformation::of(settings.remedy.as_ref(), n),
            false => Deformation::default(),
        };
        let mut solver = Self {
            slabs: Vec::new(),
            nodes: vec![NodalState::default(); lattice.len()],
            gravity: Node::ZERO,
            space: space::<D, S, B>(scene.grid, settings.wall, settings.remedy.averages_onto()),
            reach: Reach::everything(&lattice),
            declared: Vec::new(),
            prescribed: Vec::new(),
            amplitudes: vec![0.0; scene.constraints.len()],
            force_mean: Vec::new(),
            deformation,
            chunk_sums: vec![ChunkSums::default(); n.div_ceil(CHUNK)],
            node_sums: vec![NodeSums::default(); lattice.len().div_ceil(NODE_CHUNK)],
            drift: 0.0,
            density: scene.body.least_density(),
            wave_modulus: scene.body.wave_modulus(),
            ledger: Ledger::new(n, lattice.len(), scene.constraints.len()),
            transfer_pairs: 2 * (S as u64).pow(D as u32),
            lattice,
            scene,
            settings,
        };
        solver.check_positions()?;
        solver.attach_contacts()?;
        solver.declare_constraints();
        require_held(solver.scene.constraints.len(), solver.declared.iter().map(|held| held.by))?;
        solver.sort();
        solver.keep_gaps_open(0.0)?;
        Ok(solver)
    }

    fn declare_constraints(&mut self) {
        let (lattice, scene) = (&self.lattice, &self.scene);
        let declared = &mut self.declared;
        lattice.for_each_node(|node, index| {
            let position = lattice.position(index);
            for axis in 0..D {
                let first = scene.constraints.iter().enumerate().find_map(|(by, c)| {
                    let full_velocity = c.prescribe(&scene.grid, &position, axis)?;
                    Some(Prescribed {
                        node,
                        axis,
                        velocity: full_velocity,
                        full_velocity,
                        bound: c.bound(),
                        force: 0.0,
                        by,
                    })
                });
                declared.extend(first);
            }
        });
    }

    fn check_positions(&mut self) -> Result<(), Error> {
        check_cfl(self.wave_speed() * self.settings.dt, self.scene.grid.h).map_err(|fault| self.breakdown(0, fault))?;
        let beyond = self.scene.body.particles.half_size.map(B::beyond_wall);
        let room = Room::new(&self.scene.grid, beyond);
        for k in 0..self.scene.body.particles.len() {
            let mut x = self.scene.body.particles.position[k];
            room.place(&mut x).map_err(|fault| self.breakdown(k, fault))?;
            self.scene.body.particles.position[k] = x;
        }
        Ok(())
    }
}
