//! The stages of the explicit step, in its order.

use super::remedy::{self, Remedy};
use super::transfer::{Given, Transfer};
use super::{ChunkSums, NodeSums, Solver, check_cfl, stress_of};
use crate::basis::Basis;
use crate::body::check_jacobian;
use crate::error::Error;
use crate::material::Law;
use crate::monitor::Residual;
use crate::nodes::NodalState;
use crate::parallel::{AT_ONCE, CHUNK, chunks_if_present, scatter};
use crate::particles::Particles;
use crate::projection::{Average, Projection};
use crate::room::Room;
use crate::space;
use crate::stage::ForceFilter;
use nalgebra::SMatrix;
use rayon::prelude::*;

impl<const D: usize, const S: usize, B: Basis<S>, M: Law, T: Transfer<D>> Solver<D, S, B, M, T> {
    /// Sets the prescribed velocities to those in the middle of the step, and notes the forces on what they hold.
    pub(super) fn move_constraints(&mut self) {
        let middle = self.time + 0.5 * self.settings.dt;
        let now = self.scene.constraints.iter().map(|c| c.amplitude(middle));
        for (held, amplitude) in self.held.iter_mut().zip(now) {
            held.amplitude = amplitude;
            held.reaction.force = [0.0; 3];
        }
        for p in &mut self.prescribed {
            p.velocity = self.held[p.by].amplitude * p.full_velocity;
            p.force = self.nodes[p.node].change.as_array()[p.axis];
        }
    }

    pub(super) fn apply_loads(&mut self) {
        self.scene.body.particles.external_force.fill([0.0; D]);
        for load in &self.scene.loads {
            load.add(self.time, &mut self.scene.body.particles);
        }
    }

    /// Mass, momentum and forces to the nodes, Eqs. (7), (8), (10).
    pub(super) fn particles_to_grid(&mut self) {
        let lattice = &self.lattice;
        let (transfer, p) = (&self.settings.transfer, &self.scene.body.particles);
        let stress = stress_of(&p.stress, &self.adjusted_stress);
        self.reach.clear(&mut self.nodes);
        scatter(
            &mut self.nodes,
            lattice.plane(),
            &self.slabs,
            |slab, nodes, origin| {
                let x = &p.position[slab.clone()];
                let (mass, v) = (&p.mass[slab.clone()], &p.velocity[slab.clone()]);
                let affine = p.affine.get(slab.clone()).unwrap_or_default();
                let (volume, stress) = (&p.volume[slab.clone()], &stress[slab.clone()]);
                let external_force = p.external_force.get(slab).unwrap_or_default();
                lattice.for_each_stencil(x, &p.half_size, |k, stencil| {
                    let given = Given {
                        position: &x[k],
                        mass: mass[k],
                        velocity: &v[k],
                        affine: affine.get(k),
                        volume: volume[k],
                        stress: &stress[k],
                        external_force: external_force.get(k),
                    };
                    transfer.particle_to_grid(lattice, stencil, &given, nodes, origin);
                });
            },
        );
        lattice.fold(&mut self.nodes);
    }

    /// New nodal velocities, Eq. (9), with filters and constraints.
    pub(super) fn update_grid(&mut self) {
        let dt = self.settings.dt;
        let filters = &self.settings.force_filters;
        self.reach
            .chunks(&mut self.nodes)
            .zip(&mut self.node_sums)
            .for_each(|(parts, sums)| {
                *sums = NodeSums::default();
                parts
                    .flatten()
                    .for_each(|node| update_node::<D>(node, dt, filters, sums));
            });
        let mut residual = Residual::default();
        for sums in &self.node_sums {
            residual.free_force += sums.free_force;
            residual.kinetic_energy += sums.kinetic_energy;
            self.accumulated.damping += dt * sums.damping;
        }
        for c in &self.prescribed {
            let node = &mut self.nodes[c.node];
            let mass = node.mass();
            let free = node.motion.as_array()[c.axis];
            let Some(held) = c.held(free) else {
                continue;
            };
            residual.kinetic_energy -= node.kinetic_energy();
            let change = &mut node.change.as_mut_array()[c.axis];
            let velocity = &mut node.motion.as_mut_array()[c.axis];
            let before = free - *change;
            residual.free_force -= (mass * *change / dt).abs();
            residual.held_force[c.axis] += c.force;
            self.held[c.by].reaction.force[c.axis] += c.force;
            self.held[c.by].reaction.impulse[c.axis] += mass * (before - held) + dt * c.force;
            self.accumulated.constraint_loss +=
                mass * (0.5 * (before * before - held * held) + (free - before) * held);
            *change += held - free;
            *velocity = held;
            residual.kinetic_energy += node.kinetic_energy();
        }
        self.residual = residual;
        self.lattice.unfold(&mut self.nodes);
    }

    /// Velocity, displacement, ΔF and J of the particles, Eqs. (11)–(14), (16).
    pub(super) fn grid_to_particles(&mut self) -> Result<(), Error> {
        let (lattice, nodes, dt) = (&self.lattice, &self.nodes, self.settings.dt);
        let p = &mut self.scene.body.particles;
        let transfer = &mut self.settings.transfer;
        let passes = 1 + transfer.prepare(lattice, p, &self.slabs, nodes, &self.prescribed);
        let (transfer, chunks) = (&*transfer, self.chunk_sums.len());
        let (half_size, external_force) = (&p.half_size, &p.external_force);
        let stress = stress_of(&p.stress, &self.adjusted_stress);
        (
            self.chunk_sums.par_iter_mut(),
            p.velocity.par_chunks_mut(CHUNK),
            chunks_if_present(&mut p.affine, chunks),
            p.increment.par_chunks_mut(CHUNK),
            p.delta_f.par_chunks_mut(CHUNK),
            p.jacobian.par_chunks_mut(CHUNK),
            p.position.par_chunks(CHUNK),
            p.volume.par_chunks(CHUNK),
            stress.par_chunks(CHUNK),
        )
            .into_par_iter()
            .with_max_len(AT_ONCE)
            .enumerate()
            .for_each(
                |(c, (sums, v, affine, increment, delta_f, j, x, volume, stress))| {
                    let mut chunk = ChunkSums::default();
                    // All of one length: nothing is left to check between sums and what they are for.
                    let (v, increment) = (&mut v[..x.len()], &mut increment[..x.len()]);
                    let (delta_f, j) = (&mut delta_f[..x.len()], &mut j[..x.len()]);
                    let (volume, stress) = (&volume[..x.len()], &stress[..x.len()]);
                    lattice.for_each_stencil(x, half_size, |k, stencil| {
                        let (stress, volume) = (stress[k], volume[k]);
                        let b = affine.get_mut(k);
                        let got =
                            transfer.grid_to_particle(lattice, stencil, &x[k], nodes, &mut v[k], b);
                        let gradient = SMatrix::<f64, D, D>::from_fn(|a, b| got.gradient[a][b]);
                        delta_f[k] = SMatrix::identity() + gradient * dt;
                        j[k] *= space::determinant(&delta_f[k]);
                        if let Err(fault) = check_jacobian(j[k]) {
                            chunk.fault.get_or_insert((c * CHUNK + k, fault));
                        }
                        let mut stress_power = 0.0;
                        for a in 0..D {
                            increment[k][a] = dt * got.moving[a];
                            for b in 0..D {
                                stress_power += stress.get(a, b) * got.gradient[a][b];
                            }
                        }
                        if let Some(force) = external_force.get(c * CHUNK + k) {
                            let powers = force.iter().zip(&got.velocity).map(|(f, v)| f * v);
                            chunk.load_power += powers.sum::<f64>();
                        }
                        chunk.stress_power += volume * stress_power;
                    });
                    *sums = chunk;
                },
            );
        self.work.particle_node_pairs += passes * self.transfer_pairs * self.work.particles;
        for sums in &self.chunk_sums {
            self.accumulated.stress_work += dt * sums.stress_power;
            self.accumulated.load_work += dt * sums.load_power;
        }
        self.first_fault()
    }

    /// The stress that enters the forces, where the remedy has a share in it.
    pub(super) fn adjust_stress(&mut self) {
        let mut stress = std::mem::take(&mut self.adjusted_stress);
        self.with_remedy(|remedy, particles, average| {
            remedy.force_stress(particles, average, &mut stress);
        });
        self.adjusted_stress = stress;
    }

    /// ΔF to ΔF̄, Eqs. (19)–(21), (25), (26).
    pub(super) fn average_volume_change(&mut self) {
        self.with_remedy(|remedy, particles, average| {
            if let Some(next) = remedy.next_j_bar(particles, average) {
                remedy::commit(particles, next);
            }
        });
    }

    fn with_remedy(
        &mut self,
        act: impl FnOnce(&mut dyn Remedy<D>, &mut Particles<D>, &mut dyn Average<D>),
    ) {
        let before = self.work.projections;
        let mut projection = Projection {
            lattice: &self.lattice,
            slabs: &self.slabs,
            reach: &self.reach,
            averaging: &mut self.averaging,
            count: &mut self.work.projections,
        };
        act(
            self.settings.remedy.as_mut(),
            &mut self.scene.body.particles,
            &mut projection,
        );
        self.work.particle_node_pairs +=
            (self.work.projections - before) * self.transfer_pairs * self.work.particles;
    }

    /// Stress, state and volume of the particles, Eqs. (15), (22).
    pub(super) fn update_stress(&mut self) {
        self.averaging.expire();
        self.scene.body.update_stress(self.settings.dt);
    }

    /// New positions, Eq. (17).
    pub(super) fn move_particles(&mut self) -> Result<(), Error> {
        let grid = &self.scene.grid;
        let wave_distance = self.wave_speed * self.settings.dt;
        let p = &mut self.scene.body.particles;
        let room = Room::new(grid, p.half_size.map(B::beyond_wall));
        (
            self.chunk_sums.par_iter_mut(),
            p.position.par_chunks_mut(CHUNK),
            p.increment.par_chunks(CHUNK),
        )
            .into_par_iter()
            .with_max_len(AT_ONCE)
            .enumerate()
            .for_each(|(c, (sums, x, increment))| {
                let mut largest = 0.0_f64;
                for k in 0..x.len() {
                    let mut next = x[k];
                    let mut distance = 0.0_f64;
                    for a in 0..D {
                        next[a] += increment[k][a];
                        distance = distance.max(increment[k][a].abs());
                    }
                    // A particle that breaks down stays where it is, so the state can be inspected.
                    let checked = check_cfl(distance + wave_distance, grid.h)
                        .and_then(|()| room.place(&mut next));
                    match checked {
                        Ok(wrapped) => {
                            x[k] = next;
                            largest = largest.max(distance);
                            sums.wrapped |= wrapped;
                        }
                        Err(fault) => {
                            sums.fault.get_or_insert((c * CHUNK + k, fault));
                        }
                    }
                }
                sums.largest_increment = largest;
            });
        let mut wrapped = false;
        let mut largest = 0.0_f64;
        for sums in &self.chunk_sums {
            wrapped |= sums.wrapped;
            largest = largest.max(sums.largest_increment);
        }
        self.drift += if wrapped { f64::INFINITY } else { largest };
        let outcome = self.first_fault();
        self.averaging.expire();
        self.sort_if_needed();
        outcome
    }

    pub(super) fn filter_particles(&mut self) {
        for filter in &mut self.settings.particle_filters {
            self.accumulated.filter_loss +=
                filter.filter(self.residual.kinetic_energy, &mut self.scene.body.particles);
        }
    }
}

/// The new velocity of a node, Eq. (9), and its share in the sums.
fn update_node<const D: usize>(
    node: &mut NodalState,
    dt: f64,
    filters: &[Box<dyn ForceFilter>],
    sums: &mut NodeSums,
) {
    let mass = node.mass();
    if mass <= 0.0 {
        *node = NodalState::default();
        return;
    }
    for v in &mut node.motion.as_mut_array()[..D] {
        *v /= mass;
    }
    for filter in filters {
        sums.damping += filter.filter(node);
    }
    for f in &node.change.as_array()[..D] {
        sums.free_force += f.abs();
    }
    // The padding of the force is zero, so the mass stays what it is.
    node.change *= dt / mass;
    node.motion += node.change;
    sums.kinetic_energy += node.kinetic_energy();
}
