//! Map from nodes to particles and back, S⁺S without the division by mass, on a transfer's own nodes.

use crate::basis::Basis;
use crate::eights::{AHEAD, Eights, blocks, components, entries};
use crate::lattice::{Lattice, Stencil, StencilRef, Stencils};
use crate::nodes::{NodalState, Node};
use crate::number::EIGHT;
use crate::order::Slabs;
use crate::parallel::scatter_all;
use crate::particles::Particles;

/// Nodes whose `motion` goes to the particles and back.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Sweep {
    /// Per node u in `motion`.
    pub(super) nodes: Vec<NodalState>,
    /// Per node Σ_p w_ip m_p Σ_j w_jp u_j.
    pub(super) mapped: Vec<Node>,
}

impl Sweep {
    /// Begins with what `of` makes of every one of `nodes`.
    pub(super) fn begin(&mut self, nodes: &[NodalState], of: impl Fn(&NodalState) -> NodalState) {
        self.nodes.resize(nodes.len(), NodalState::default());
        self.mapped.resize(nodes.len(), Node::ZERO);
        for (own, node) in self.nodes.iter_mut().zip(nodes) {
            *own = of(node);
        }
    }

    /// Σ_p w_ip m_p Σ_j w_jp u_j into `mapped`.
    pub(super) fn there_and_back<const D: usize, const S: usize, B: Basis<S>>(
        &mut self,
        lattice: &Lattice<D, S, B>,
        particles: &Particles<D>,
        slabs: &[Slabs],
    ) {
        let (x, mass) = (&particles.position, &particles.mass);
        let nodes = &self.nodes;
        self.mapped.fill(Node::ZERO);
        scatter_all(&mut self.mapped, lattice.plane(), slabs, |slab, mapped, origin| {
            let mass = &mass[slab.clone()];
            let x = Eights::of(&x[slab]);
            let mut stencils = Stencils::on(lattice);
            for k in 0..blocks(mass.len()) {
                x.fetch(k + AHEAD);
                let functions = lattice.functions(&components(x.at(k)), &particles.half_size);
                lattice.stencils(&functions, &mut stencils);
                for l in 0..entries(mass.len(), k) {
                    let sum = mapped_velocity(stencils.at(l), nodes) * mass[k * EIGHT + l];
                    add_momentum(stencils.at(l), sum, mapped, origin);
                }
            }
        });
        lattice.fold(&mut self.mapped);
    }
}

/// Σ_i w_ip u_i.
#[inline(always)]
fn mapped_velocity<const D: usize, const S: usize>(stencil: StencilRef<'_, D, S>, nodes: &[NodalState]) -> Node {
    let (last, stride) = (stencil.last(), stencil.stride());
    let (lines, rows) = Stencil::<D, S>::OUTER;
    let mut sum = Node::ZERO;
    for slow in 0..lines {
        let (begin, length) = stencil.line(slow, 0);
        let line = &nodes[begin..begin + length];
        for fast in 0..rows {
            let mut row_sum = Node::ZERO;
            for k in 0..S {
                row_sum = line[fast * stride + k].motion.mul_add(last[k], row_sum);
            }
            let weight = Node::splat(stencil.row_weight(slow, fast));
            sum = row_sum.mul_add(weight, sum);
        }
    }
    sum
}

/// Adds w_ip `momentum` to `mapped`, which begins at node `origin`.
#[inline(always)]
fn add_momentum<const D: usize, const S: usize>(
    stencil: StencilRef<'_, D, S>,
    momentum: Node,
    mapped: &mut [Node],
    origin: usize,
) {
    let (last, stride) = (stencil.last(), stencil.stride());
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for slow in 0..lines {
        let (begin, length) = stencil.line(slow, origin);
        let line = &mut mapped[begin..begin + length];
        for fast in 0..rows {
            let row = momentum * stencil.row_weight(slow, fast);
            for k in 0..S {
                let node = &mut line[fast * stride + k];
                *node = row.mul_add(last[k], *node);
            }
        }
    }
}
