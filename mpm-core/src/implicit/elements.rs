//! The functions that see the particles, as they are at a step's start and stay in all of it.

use super::interpolation::{Functions, Interpolation};
use crate::particles::Particles;
use nalgebra::SMatrix;
use rayon::prelude::*;
use std::ops::{AddAssign, Range};

/// Particles in runs that the same nodes see, with values and gradients of the functions.
pub(super) struct Elements<const D: usize> {
    /// Functions that see a particle.
    pub(super) support: usize,
    /// Particles of every element.
    pub(super) particles: Vec<Range<usize>>,
    /// Nodes of every element, `support` of them each; images are their originals.
    pub(super) node: Vec<usize>,
    /// Of every particle the element.
    element: Vec<usize>,
    /// Of every particle, `support` values.
    w: Vec<f64>,
    /// Of every particle, `support` gradients (1/m).
    dw: Vec<[f64; D]>,
}

/// The order of particles by element, stable within one.
pub(super) fn order<const D: usize, I: Interpolation<D>>(
    functions_of: &I,
    particles: &Particles<D>,
) -> Vec<u32> {
    let mut functions = Functions::new();
    let element = |x: &[f64; D]| {
        functions_of.functions(x, &particles.half_size, &mut functions);
        functions.element
    };
    let elements: Vec<usize> = particles.position.iter().map(element).collect();
    let mut order: Vec<u32> = (0..elements.len() as u32).collect();
    order.sort_by_key(|p| elements[*p as usize]);
    order
}

impl<const D: usize> Elements<D> {
    /// Of particles that stand in the [`order`] of elements.
    pub(super) fn new<I: Interpolation<D>>(
        functions_of: &I,
        originals: &[usize],
        particles: &Particles<D>,
    ) -> Self {
        let support = functions_of.support();
        let count = particles.len();
        let mut elements = Self {
            support,
            particles: Vec::new(),
            node: Vec::new(),
            element: Vec::with_capacity(count),
            w: Vec::with_capacity(count * support),
            dw: Vec::with_capacity(count * support),
        };
        let mut functions = Functions::new();
        let mut last = None;
        for (p, x) in particles.position.iter().enumerate() {
            functions_of.functions(x, &particles.half_size, &mut functions);
            if last != Some(functions.element) {
                last = Some(functions.element);
                elements.particles.push(p..p);
                let nodes = functions.node.iter().map(|node| originals[*node]);
                elements.node.extend(nodes);
            }
            if let Some(run) = elements.particles.last_mut() {
                run.end = p + 1;
            }
            elements.element.push(elements.particles.len() - 1);
            elements.w.extend_from_slice(&functions.w);
            elements.dw.extend_from_slice(&functions.dw);
        }
        elements
    }

    /// The nodes of an element.
    pub(super) fn nodes_of(&self, element: usize) -> &[usize] {
        &self.node[element * self.support..(element + 1) * self.support]
    }

    /// The nodes that see a particle, with values and gradients of their functions.
    pub(super) fn seen(&self, particle: usize) -> (&[usize], &[f64], &[[f64; D]]) {
        let range = particle * self.support..(particle + 1) * self.support;
        let nodes = self.nodes_of(self.element[particle]);
        (nodes, &self.w[range.clone()], &self.dw[range])
    }

    /// Values and gradients of the functions that see a particle.
    pub(super) fn gradients(&self, particle: usize) -> &[[f64; D]] {
        &self.dw[particle * self.support..(particle + 1) * self.support]
    }

    /// ΔF = I + Σ u ⊗ ∇w of a particle, Eq. (3) of `docs/implicit.md`, for the nodal increments `u` (m).
    pub(super) fn deformation(&self, particle: usize, u: &[[f64; D]]) -> SMatrix<f64, D, D> {
        let (nodes, _, dw) = self.seen(particle);
        let mut f = SMatrix::identity();
        for (node, dw) in nodes.iter().zip(dw) {
            for i in 0..D {
                for j in 0..D {
                    f[(i, j)] += u[*node][i] * dw[j];
                }
            }
        }
        f
    }

    /// Σ `of`(particle) over the particles of every element, in parallel, added to `nodes` in the order of elements:
    /// `of` adds to its element's nodal values, which begin at `zero`.
    pub(super) fn scatter<T: Copy + Send + Sync + AddAssign>(
        &self,
        zero: T,
        nodes: &mut [T],
        of: impl Fn(usize, &mut [T]) + Sync,
    ) {
        let sums: Vec<T> = self
            .particles
            .par_iter()
            .flat_map_iter(|run| {
                let mut sums = vec![zero; self.support];
                for p in run.clone() {
                    of(p, &mut sums);
                }
                sums
            })
            .collect();
        for (node, sum) in self.node.iter().zip(sums) {
            nodes[*node] += sum;
        }
    }
}
