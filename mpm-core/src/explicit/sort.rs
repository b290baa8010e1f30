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
        self.space.expire();
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
        }
    }

    pub(super) fn sort(&mut self) {
        let p = &self.scene.body.particles;
        let (order, slabs) = stencil_order(&self.lattice, &p.position, &p.half_size);
        self.scene.body.permute(&order);
        self.slabs = slabs;
        self.drift = 0.0;
        self.ledger.work.sorts += 1;
        self.find_reach();
    }

    /// Finds the nodes that the particles see, and the particles that may touch a rigid body, until they are sorted
    /// again.
    pub(super) fn find_reach(&mut self) {
        let p = &self.scene.body.particles;
        self.reach = Reach::of(&self.lattice, &p.position, &p.half_size);
        for contact in &mut self.scene.contacts {
            contact.find_near(self.ledger.time, MOTION * self.scene.grid.h, p);
        }
        self.nodes.fill(NodalState::default());
        self.space.find_reach(p, &self.slabs);
        let within = self.declared.iter().filter(|c| self.reach.contains(c.node));
        self.prescribed.clear();
        self.prescribed.extend(within);
    }
}
