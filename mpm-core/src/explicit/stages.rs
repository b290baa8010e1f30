//! The stages of the explicit step, in its order.

use super::remedy::Known;
use super::scratch::Scratch;
use super::second_half::{ForceStress, force_stress_of, known};
use super::transfer::{Given, Received, Transfer};
use super::{ChunkSums, NodeSums, Solver, VelocityField};
use crate::basis::Basis;
use crate::bodies::Bodies;
use crate::eights::{AHEAD, Eights, block, blocks, components, entries, numbers, store, store_numbers, store_vectors};
use crate::error::Error;
use crate::lattice::{Lattice, Stencils};
use crate::monitor::Residual;
use crate::nodes::{NodalState, Node, padded};
use crate::number::{EIGHT, Eight};
use crate::parallel::{CHUNK, NODE_CHUNK, PerPiece, for_each_chunk, for_each_piece, scatter_all};
use crate::projection::{Average, Projection};
use crate::space::determinant_of_entries;
use crate::stage::ForceFilter;
use std::sync::Mutex;

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// Sets the prescribed velocities to those in the middle of the step, and notes the forces on what they hold.
    pub(super) fn move_constraints(&mut self) -> Result<(), Error> {
        let middle = self.ledger.time + 0.5 * self.settings.dt;
        let mut moved = false;
        for (c, shift) in self.scene.constraints.iter().zip(&mut self.shifts) {
            let before = std::mem::replace(shift, c.shift(&self.scene.grid, middle));
            moved |= before != *shift;
        }
        if moved {
            self.declare_constraints(middle)?;
            self.find_prescribed();
        }
        let now = self.scene.constraints.iter().map(|c| c.amplitude(middle));
        let held = self.amplitudes.iter_mut().zip(&mut self.ledger.reactions);
        for ((held, reaction), amplitude) in held.zip(now) {
            *held = amplitude;
            reaction.force = [0.0; 3];
        }
        for VelocityField { prescribed, nodes, .. } in &mut self.fields {
            for p in prescribed {
                p.velocity = self.amplitudes[p.by] * p.full_velocity;
                let node = &nodes[p.node];
                p.force = (node.change + self.gravity * node.mass()).as_array()[p.axis];
            }
        }
        Ok(())
    }

    /// Forces on particles; of what accelerates all material alike, its share in the nodes' update.
    pub(super) fn apply_loads(&mut self) {
        self.scene.bodies.particles.external_force.fill([0.0; D]);
        self.gravity = Node::ZERO;
        for load in &self.scene.loads {
            match load.acceleration(self.ledger.time) {
                Some(acceleration) => self.gravity += padded(&acceleration),
                None => load.add(self.ledger.time, &mut self.scene.bodies.particles),
            }
        }
    }

    /// Mass, momentum and forces to the nodes, Eqs. (7), (8), (10).
    pub(super) fn particles_to_grid(&mut self) {
        let lattice = &self.lattice;
        let (p, force_mean) = (&self.scene.bodies.particles, &self.columns.mean);
        for VelocityField { transfer, reach, slabs, nodes, .. } in &mut self.fields {
            reach.clear(nodes);
            scatter_all(nodes, lattice.plane(), slabs, |slab, nodes, origin| {
                let x = Eights::of(&p.position[slab.clone()]);
                let v = Eights::of(&p.velocity[slab.clone()]);
                let mass = Eights::of(&p.mass[slab.clone()]);
                let volume = Eights::of(&p.volume[slab.clone()]);
                let affine = p.affine.get(slab.clone()).map(Eights::of);
                let external_force = p.external_force.get(slab.clone()).map(Eights::of);
                let stress = ForceStress::of(p, force_mean, slab.clone());
                let mut stencils = Stencils::on(lattice);
                let mut given = Given::default();
                for k in 0..blocks(slab.len()) {
                    x.fetch(k + AHEAD);
                    v.fetch(k + AHEAD);
                    mass.fetch(k + AHEAD);
                    volume.fetch(k + AHEAD);
                    stress.fetch(k + AHEAD);
                    let (x, mass) = (components(x.at(k)), Eight::new(*mass.at(k)));
                    let functions = lattice.functions(&x, &p.half_size);
                    lattice.stencils(&functions, &mut stencils);
                    given.set(
                        mass,
                        &components(v.at(k)),
                        Eight::new(*volume.at(k)),
                        &stress.at::<D>(k),
                        external_force.as_ref().map(|force| components(force.at(k))),
                    );
                    let affine = affine.as_ref().map(|affine| affine.at(k));
                    let gives = transfer.give(lattice, &functions, &x, mass, affine);
                    for l in 0..entries(slab.len(), k) {
                        transfer.particle_to_grid(stencils.at(l), &given, &gives, nodes, origin);
                    }
                }
            });
            lattice.fold(nodes);
        }
    }

    /// New nodal velocities, Eq. (9), with filters and constraints.
    pub(super) fn update_grid(&mut self) {
        let (dt, gravity) = (self.settings.dt, self.gravity);
        let filters = &self.settings.force_filters;
        let mut residual = Residual::default();
        let mut momentum = Node::ZERO;
        for VelocityField { reach, nodes, prescribed, .. } in &mut self.fields {
            let (reach, n) = (&*reach, nodes.len());
            let pieces = (&mut nodes[..], PerPiece(&mut self.node_sums));
            for_each_piece(pieces, n, NODE_CHUNK, &|begin, (nodes, sums)| {
                let mut of_piece = NodeSums::default();
                for node in reach.within(begin, nodes.len()).flatten() {
                    update_node::<D>(&mut nodes[node], dt, gravity, filters, &mut of_piece);
                }
                sums.0.fill(of_piece);
            });
            for sums in &self.node_sums {
                momentum += sums.momentum;
                residual.free_force += sums.free_force;
                residual.kinetic_energy += sums.kinetic_energy;
                self.ledger.accumulated.damping += dt * sums.damping;
            }
            for c in prescribed {
                let node = &mut nodes[c.node];
                let mass = node.mass();
                let free = node.motion.as_array()[c.axis];
                let Some(held) = c.held(free) else {
                    continue;
                };
                residual.kinetic_energy -= node.kinetic_energy();
                let reaction = &mut self.ledger.reactions[c.by];
                let across = |a: &usize| c.friction > 0.0 && *a != c.axis;
                let slides = (0..D).filter(across).map(|a| node.motion.as_array()[a].powi(2)).sum::<f64>().sqrt();
                let stops = (c.friction * (held - free).abs() / slides.max(f64::MIN_POSITIVE)).min(1.0);
                for a in (0..D).filter(across) {
                    let by = -stops * node.motion.as_array()[a];
                    self.ledger.accumulated.constraint_loss += push(node, a, by, dt, &mut residual);
                    reaction.force[a] -= mass * by / dt;
                    reaction.impulse[a] -= mass * by;
                    momentum.as_mut_array()[a] += mass * by;
                }
                let change = &mut node.change.as_mut_array()[c.axis];
                let velocity = &mut node.motion.as_mut_array()[c.axis];
                let before = free - *change;
                residual.free_force -= (mass * *change / dt).abs();
                residual.held_force[c.axis] += c.force;
                reaction.force[c.axis] += c.force;
                reaction.impulse[c.axis] += mass * (before - held) + dt * c.force;
                self.ledger.accumulated.constraint_loss += constraint_loss(mass, before, free, held);
                *change += held - free;
                *velocity = held;
                momentum.as_mut_array()[c.axis] += mass * (held - free);
                residual.kinetic_energy += node.kinetic_energy();
            }
        }
        self.ledger.residual = residual;
        for (g, momentum) in gravity.as_array()[..D].iter().zip(momentum.as_array()) {
            self.ledger.accumulated.load_work += dt * g * momentum;
        }
    }

    /// Once nodes move as they will: what particles see of nodes that have no mass or are images.
    fn complete_nodes(&mut self) {
        for field in &mut self.fields {
            if S == 2 {
                carry_along(&self.lattice, field);
            }
            self.lattice.unfold(&mut field.nodes);
        }
    }

    /// Velocity, displacement, ΔF and J of the particles, Eqs. (11)–(14), (16). The same pass goes on with their
    /// [`SecondHalf`](super::SecondHalf), unless what stands between needs it of all particles.
    pub(super) fn grid_to_particles(&mut self) -> Result<(), Error> {
        self.complete_nodes();
        let lattice = &self.lattice;
        let half_size = self.scene.bodies.particles.half_size;
        let dt = Eight::splat(self.settings.dt);
        let mut passes = 0;
        for VelocityField { transfer, bodies, slabs, nodes, prescribed, .. } in &mut self.fields {
            let extra = transfer.prepare(lattice, &self.scene.bodies.particles, slabs, nodes, prescribed);
            let particles = bodies.iter().map(|body| self.scene.bodies.each[*body].range().len() as u64);
            passes += (1 + extra) * particles.sum::<u64>();
        }
        let remedy = self.settings.remedy.as_ref();
        if self.in_one_pass {
            self.scratch.resize_with(rayon::current_num_threads(), Mutex::default);
        }
        let scratch = &self.scratch;
        let mut columns = (self.deformation.chunk(), self.columns.all());
        let mut sums = &mut self.chunk_sums[..];
        for (body, field) in self.field_of.iter().enumerate() {
            let VelocityField { transfer, nodes, .. } = &self.fields[*field];
            let second_half = &self.second_half[body];
            let averages = self.scene.bodies.each[body].averages;
            let patches = self.spaces[body].patches();
            let at = |k| patches.map_or(k * CHUNK, |patches| patches.cut(k));
            let begin = self.scene.bodies.each[body].range().start;
            let (all, own) = self.scene.bodies.part(body, &mut columns, &mut sums);
            for_each_chunk(all, own, &at, &|(mut p, (mut deformation, mut filled)), sums| {
                *sums = ChunkSums::default();
                let mut lent = Scratch::lent(scratch);
                let one_pass = lent.is_some();
                if let Some(lent) = &mut lent {
                    (deformation, filled) = lent.part(remedy, p.len(), filled);
                }
                let (mut stress_power, mut load_power) = (Eight::ZERO, Eight::ZERO);
                let mut stencils = Stencils::on(lattice);
                let (mut received, mut receives) = (Received::default(), T::Receives::default());
                for k in 0..blocks(p.len()) {
                    p.fetch_motion(k + AHEAD);
                    if !deformation.is_there() {
                        p.fetch_second_half(k + AHEAD);
                    }
                    let x = components(block(p.position, k, &mut None));
                    let functions = lattice.functions(&x, &half_size);
                    lattice.stencils(&functions, &mut stencils);
                    let gives = transfer.give(lattice, &functions, &x, Eight::ZERO, None);
                    for l in 0..EIGHT {
                        let stencil = stencils.at(l);
                        transfer.grid_to_particle(stencil, &gives, nodes, &mut received, &mut receives);
                    }
                    let mut v = components(block(p.velocity, k, &mut None));
                    let mut affine = (!p.affine.is_empty()).then(|| *block(p.affine, k, &mut None));
                    let moving = transfer.receive(&received, &receives, &mut v, &mut affine);
                    store_vectors(p.velocity, k, &v);
                    if let Some(affine) = affine {
                        store(p.affine, k, |l| affine[l]);
                    }

                    let stress = force_stress_of(&p, filled.mean, k);
                    let mut delta_f = [[Eight::ZERO; D]; D];
                    let mut increment = [Eight::ZERO; D];
                    let mut power = Eight::ZERO;
                    for a in 0..D {
                        increment[a] = dt * moving[a];
                        for b in 0..D {
                            let gradient = received.gradient(a, b);
                            power = stress.get(a, b).mul_add(gradient, power);
                            let identity = Eight::splat(f64::from(u8::from(a == b)));
                            delta_f[a][b] = gradient.mul_add(dt, identity);
                        }
                    }
                    stress_power += p.present(k, power * numbers(p.volume, k));
                    if !p.external_force.is_empty() {
                        let force = components(block(p.external_force, k, &mut None));
                        let mut power = Eight::ZERO;
                        for a in 0..D {
                            power = force[a].mul_add(received.velocity(a), power);
                        }
                        load_power += p.present(k, power);
                    }
                    let volume_change = determinant_of_entries(&delta_f);
                    let j = numbers(p.jacobian, k) * volume_change;
                    store_numbers(p.jacobian, k, j);
                    if !p.increment.is_empty() {
                        store_vectors(p.increment, k, &increment);
                    }
                    if !sums.check_jacobians(&p, k, j) {
                        continue;
                    }
                    if deformation.is_there() {
                        deformation.keep(k, &delta_f, volume_change, &increment);
                    } else {
                        second_half.finish(&mut p, k, &delta_f, &increment, sums);
                    }
                }
                sums.stress_power = stress_power.reduce_add();
                sums.load_power = load_power.reduce_add();
                if let Some(patches) = patches.filter(|_| one_pass && sums.collapsed.is_none()) {
                    let first = p.begin - begin;
                    let mut count = 0;
                    let mut mean = |volume: &[f64], field: &mut [f64]| {
                        count += 1;
                        if averages {
                            patches.average(first, volume, field);
                        }
                    };
                    let known = known(&p, &deformation);
                    remedy.next_j_bar(known, &mut filled, &mut |field| mean(p.volume, field));
                    second_half.finish_all(&mut p, &deformation, filled.next, sums);
                    let known = self::known(&p, &deformation);
                    remedy.force_mean(known, &mut filled, &mut |field| mean(p.volume, field));
                    sums.averages = count;
                }
                Scratch::give_back(scratch, lent);
            });
        }
        self.ledger.work.particle_node_pairs += passes * self.transfer_pairs;
        if self.in_one_pass {
            self.count_averages();
        }
        for sums in &self.chunk_sums {
            self.ledger.accumulated.stress_work += self.settings.dt * sums.stress_power;
            self.ledger.accumulated.load_work += self.settings.dt * sums.load_power;
        }
        self.first_fault()
    }

    /// Counts the averages of the pass.
    fn count_averages(&mut self) {
        let count = self.chunk_sums.first().map_or(0, |sums| sums.averages);
        let averaging = self.spaces.iter().zip(&self.scene.bodies.each).filter(|(_, body)| body.averages);
        self.ledger.work.projections += count;
        self.ledger.work.particle_node_pairs += count * averaging.map(|(space, _)| space.pairs()).sum::<u64>();
        self.mean_is_current = true;
    }

    /// The mean stress of the forces, where the remedy has a share in it; a pass over the particles leaves that of the
    /// next step.
    pub(super) fn average_stress(&mut self) {
        let (in_one_pass, n) = (self.in_one_pass, self.scene.bodies.particles.len());
        if in_one_pass {
            if self.mean_is_current {
                return;
            }
            self.columns.rest = self.settings.remedy.columns(n).rest;
        }
        let before = self.ledger.work;
        let Bodies { particles, each } = &self.scene.bodies;
        let mut projection = Projection { spaces: &mut self.spaces, each, work: &mut self.ledger.work };
        let mut average = |field: &mut [f64]| projection.average(particles, field);
        let known = Known::of(particles, &self.deformation);
        self.settings.remedy.force_mean(known, &mut self.columns.all(), &mut average);
        if in_one_pass {
            // The average was counted in the step that ended.
            (self.ledger.work, self.mean_is_current) = (before, true);
            self.columns.rest = Vec::new();
        }
    }

    /// ΔF to ΔF̄, Eqs. (19)–(21), (25), (26), where the remedy averages; then the [`SecondHalf`](super::SecondHalf) of the
    /// particles' step, unless it is done.
    pub(super) fn average_volume_change(&mut self) -> Result<(), Error> {
        if !self.deformation.chunk().is_there() {
            return Ok(());
        }
        let Bodies { particles, each } = &self.scene.bodies;
        let mut projection = Projection { spaces: &mut self.spaces, each, work: &mut self.ledger.work };
        let mut average = |field: &mut [f64]| projection.average(particles, field);
        let known = Known::of(particles, &self.deformation);
        self.settings.remedy.next_j_bar(known, &mut self.columns.all(), &mut average);
        let mut columns = (self.deformation.chunk(), self.columns.all());
        let mut sums = &mut self.chunk_sums[..];
        for (body, second_half) in self.second_half.iter().enumerate() {
            let (all, own) = self.scene.bodies.part(body, &mut columns, &mut sums);
            for_each_chunk(all, own, &|k| k * CHUNK, &|(mut p, (deformation, filled)), sums| {
                second_half.finish_all(&mut p, &deformation, filled.next, sums);
            });
        }
        self.first_fault()
    }

    pub(super) fn filter_particles(&mut self) {
        for filter in &mut self.settings.particle_filters {
            self.ledger.accumulated.filter_loss +=
                filter.filter(self.ledger.residual.kinetic_energy, &mut self.scene.bodies.particles);
        }
    }
}

/// Gives nodes without mass the mean velocity of those beside them: a particle that stands on a node sees the next one by
/// its gradient alone, where functions are not smooth.
fn carry_along<const D: usize, const S: usize, B: Basis<S>, T>(
    lattice: &Lattice<D, S, B>,
    VelocityField { nodes, reach, .. }: &mut VelocityField<T>,
) {
    for node in reach.within(0, nodes.len()).flatten() {
        if nodes[node].mass() <= 0.0 {
            let (mut sum, mut count) = (Node::ZERO, 0.0);
            for k in lattice.beside(node).filter(|k| nodes[*k].mass() > 0.0) {
                (sum, count) = (sum + nodes[k].motion, count + 1.0);
            }
            for a in 0..D {
                nodes[node].motion.as_mut_array()[a] = sum.as_array()[a] / f64::max(count, 1.0);
            }
        }
    }
}

/// Energy (J) that one who holds a component of a node's velocity removes: see
/// [`Accumulated::constraint_loss`](crate::monitor::Accumulated::constraint_loss).
fn constraint_loss(mass: f64, before: f64, free: f64, held: f64) -> f64 {
    mass * (0.5 * (before * before - held * held) + (free - before) * held)
}

/// Pushes a node along an axis `by` a change of its velocity (m/s) in a step of `dt` (s); returns the energy (J) that it
/// loses.
pub(super) fn push(node: &mut NodalState, axis: usize, by: f64, dt: f64, residual: &mut Residual) -> f64 {
    let mass = node.mass();
    let (velocity, change) = (&mut node.motion.as_mut_array()[axis], &mut node.change.as_mut_array()[axis]);
    let (free, before) = (*velocity, *velocity - *change);
    residual.free_force -= (mass * *change / dt).abs();
    *velocity += by;
    *change += *velocity - free;
    residual.free_force += (mass * *change / dt).abs();
    constraint_loss(mass, before, free, *velocity)
}

/// The new velocity of a node, Eq. (9), and its share in the sums.
fn update_node<const D: usize>(
    node: &mut NodalState,
    dt: f64,
    gravity: Node,
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
    node.change += gravity * mass;
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
    sums.momentum += node.motion * mass;
}
