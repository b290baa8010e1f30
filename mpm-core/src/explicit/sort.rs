//! The order of the particles, and the nodes that they see.

use super::{Solver, Transfer};
use crate::basis::Basis;
use crate::nodes::NodalState;
use crate::order::stencil_order;
use crate::reach::Reach;

/// Cells that a particle and a rigid body move towards each other until the particles are sorted again, at most: one,
/// and up to one each in the steps that begin and end it.
const MOTION: f64 = 3.0;

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// After the particles' motion: sorts them when one may have left the neighbours of the cell where it was.
    pub(super) fn sort_if_needed(&mut self) {
        self.spaces.iter_mut().for_each(|space| space.expire());
        let mut largest = 0.0_f64;
        for sums in &self.chunk_sums {
            let jump = if sums.wrapped { f64::INFINITY } else { 0.0 };
            largest = largest.max(sums.largest_increment + jump);
        }
        let (time, dt) = (self.ledger.time, self.settings.dt);
        let faces = self.scene.contacts.iter().map(|c| c.motion(time, dt));
        self.drift += largest + faces.fold(0.0, f64::max);
        if self.drift > self.scene.grid.h {
            self.sort();
            if self.in_one_pass {
                self.average_stress();
            }
        }
    }

    pub(super) fn sort(&mut self) {
        let bodies = &self.scene.bodies;
        let mut order: Vec<u32> = (0..bodies.particles.len() as u32).collect();
        for field in &mut self.fields {
            for (body, slabs) in field.bodies.iter().zip(&mut field.slabs) {
                let (p, range) = (&bodies.particles, bodies.each[*body].range());
                let by_cell = self.spaces[*body].patches().is_some();
                let (own, here) = stencil_order(&self.lattice, &p.position[range.clone()], &p.half_size, by_cell);
                *slabs = here.into_iter().map(|slab| slab.start + range.start..slab.end + range.start).collect();
                for (place, from) in order[range.clone()].iter_mut().zip(own) {
                    *place = range.start as u32 + from;
                }
            }
        }
        self.scene.bodies.permute(&order);
        for (space, body) in self.spaces.iter_mut().zip(&self.scene.bodies.each) {
            if let Some(patches) = space.patches_mut() {
                patches.find(&self.scene.grid, &self.scene.bodies.particles, body.range());
            }
        }
        self.drift = 0.0;
        self.ledger.work.sorts += 1;
        self.find_reach();
    }

    /// Finds the nodes that the particles see, and the particles that may touch a rigid body, until they are sorted
    /// again.
    pub(super) fn find_reach(&mut self) {
        self.mean_is_current = false;
        let p = &self.scene.bodies.particles;
        for contact in &mut self.scene.contacts {
            contact.find_near(self.ledger.time, MOTION * self.scene.grid.h, p);
        }
        for field in &mut self.fields {
            let ranges = field.bodies.iter().map(|body| self.scene.bodies.each[*body].range());
            field.reach = Reach::of(&self.lattice, ranges.map(|range| &p.position[range]), &p.half_size);
            field.nodes.fill(NodalState::default());
            for (body, slabs) in field.bodies.iter().zip(&field.slabs) {
                self.spaces[*body].find_reach(p, slabs);
            }
        }
        self.find_prescribed();
    }

    /// Finds, among all prescribed velocities, those of nodes that particles see.
    pub(super) fn find_prescribed(&mut self) {
        for field in &mut self.fields {
            let within = self.declared.iter().filter(|c| field.reach.contains(c.node));
            field.prescribed.clear();
            field.prescribed.extend(within);
        }
    }
}
