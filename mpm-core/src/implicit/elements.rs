//! The functions that see the particles, as they are at a step's start and stay in all of it.

use super::extension::Shares;
use super::interpolation::{Functions, Interpolation};
use crate::particles::Particles;
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;
use std::mem::take;
use std::ops::{AddAssign, Range};

/// Elements that one thread sums at once.
const BATCH: usize = 64;

/// Particles in runs that the same nodes see, with values and gradients of the functions.
pub(super) struct Elements<const D: usize> {
    /// Particles of every element.
    pub(super) particles: Vec<Range<usize>>,
    /// Nodes of the elements, one after the other; images are their originals.
    node: Vec<usize>,
    /// Where the nodes of every element begin, and those of the last one end.
    first_node: Vec<usize>,
    /// Of every particle the element.
    element: Vec<usize>,
    /// Values of the functions that see a particle, one particle after the other.
    w: Vec<f64>,
    /// Gradients (1/m), likewise.
    dw: Vec<[f64; D]>,
    /// Where the functions of every particle begin, and those of the last one end.
    first: Vec<usize>,
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
            particles: Vec::new(),
            node: Vec::new(),
            first_node: vec![0],
            element: Vec::with_capacity(count),
            w: Vec::with_capacity(count * support),
            dw: Vec::with_capacity(count * support),
            first: vec![0],
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
                elements.first_node.push(elements.node.len());
            }
            if let Some(run) = elements.particles.last_mut() {
                run.end = p + 1;
            }
            elements.element.push(elements.particles.len() - 1);
            elements.w.extend_from_slice(&functions.w);
            elements.dw.extend_from_slice(&functions.dw);
            elements.first.push(elements.w.len());
        }
        elements
    }

    /// The same where nodes follow others by their shares: functions of those that are followed take up those of the
    /// followers.
    pub(super) fn extended(&self, shares: &Shares) -> Self {
        let mut extended = Self {
            particles: self.particles.clone(),
            node: Vec::new(),
            first_node: vec![0],
            element: self.element.clone(),
            w: Vec::new(),
            dw: Vec::new(),
            first: vec![0],
        };
        for (element, run) in self.particles.iter().enumerate() {
            // Of every function so far, whose it becomes a part of: place among the new ones, and share.
            let mut nodes: Vec<usize> = Vec::new();
            let mut place = |node: usize| {
                let known = nodes.iter().position(|n| *n == node);
                known.unwrap_or_else(|| {
                    nodes.push(node);
                    nodes.len() - 1
                })
            };
            let parts: Vec<Vec<(usize, f64)>> = self
                .nodes_of(element)
                .iter()
                .map(|node| match &shares[*node][..] {
                    [] => vec![(place(*node), 1.0)],
                    followed => followed.iter().map(|(n, s)| (place(*n), *s)).collect(),
                })
                .collect();
            for p in run.clone() {
                let begin = extended.w.len();
                extended.w.resize(begin + nodes.len(), 0.0);
                extended.dw.resize(begin + nodes.len(), [0.0; D]);
                let (_, w, dw) = self.seen(p);
                for ((w, dw), parts) in w.iter().zip(dw).zip(&parts) {
                    for (place, share) in parts {
                        extended.w[begin + place] += share * w;
                        for (sum, slope) in extended.dw[begin + place].iter_mut().zip(dw) {
                            *sum += share * slope;
                        }
                    }
                }
                extended.first.push(extended.w.len());
            }
            extended.node.extend(nodes);
            extended.first_node.push(extended.node.len());
        }
        extended
    }

    /// Σ w `of` of every one of `nodes` nodes, such as its volume or mass; NaN of one that no element has.
    pub(super) fn sums(&self, nodes: usize, of: &[f64]) -> Vec<f64> {
        let mut sums = vec![f64::NAN; nodes];
        for node in &self.node {
            sums[*node] = 0.0;
        }
        self.scatter(0.0, &mut sums, |p, sums| {
            for (sum, w) in sums.iter_mut().zip(self.seen(p).1) {
                *sum += w * of[p];
            }
        });
        sums
    }

    /// Σ w of a field on the nodes at a particle.
    pub(super) fn value(&self, particle: usize, field: &[SVector<f64, D>]) -> SVector<f64, D> {
        let (nodes, w, _) = self.seen(particle);
        let pairs = nodes.iter().zip(w);
        pairs.fold(SVector::zeros(), |sum, (node, w)| sum + field[*node] * *w)
    }

    /// Pairs of a particle and a function that sees it.
    pub(super) fn pairs(&self) -> usize {
        self.w.len()
    }

    /// The nodes of an element.
    pub(super) fn nodes_of(&self, element: usize) -> &[usize] {
        &self.node[self.first_node[element]..self.first_node[element + 1]]
    }

    /// The nodes that see a particle, with values and gradients of their functions.
    pub(super) fn seen(&self, particle: usize) -> (&[usize], &[f64], &[[f64; D]]) {
        let range = self.first[particle]..self.first[particle + 1];
        let nodes = self.nodes_of(self.element[particle]);
        (nodes, &self.w[range.clone()], &self.dw[range])
    }

    /// Values and gradients of the functions that see a particle.
    pub(super) fn gradients(&self, particle: usize) -> &[[f64; D]] {
        &self.dw[self.first[particle]..self.first[particle + 1]]
    }

    /// ΔF = I + Σ u ⊗ ∇w of a particle, Eq. (3) of `docs/implicit.md`, for the nodal increments `u` (m).
    pub(super) fn deformation(&self, particle: usize, u: &[[f64; D]]) -> SMatrix<f64, D, D> {
        self.gather(SMatrix::identity(), particle, u)
    }

    /// Σ u ⊗ ∇w at a particle, for nodal values `u`.
    pub(super) fn gradient(&self, particle: usize, u: &[[f64; D]]) -> SMatrix<f64, D, D> {
        self.gather(SMatrix::zeros(), particle, u)
    }

    fn gather(
        &self,
        mut f: SMatrix<f64, D, D>,
        particle: usize,
        u: &[[f64; D]],
    ) -> SMatrix<f64, D, D> {
        let (nodes, _, dw) = self.seen(particle);
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
        let mut sums = vec![zero; self.node.len()];
        let mut rest = &mut sums[..];
        let mut batches = Vec::new();
        for first in (0..self.particles.len()).step_by(BATCH) {
            let last = self.particles.len().min(first + BATCH);
            let count = self.first_node[last] - self.first_node[first];
            let (own, others) = take(&mut rest).split_at_mut(count);
            batches.push((first..last, own));
            rest = others;
        }
        batches.into_par_iter().for_each(|(elements, mut rest)| {
            for element in elements {
                let count = self.nodes_of(element).len();
                let (own, others) = take(&mut rest).split_at_mut(count);
                for p in self.particles[element].clone() {
                    of(p, own);
                }
                rest = others;
            }
        });
        for (node, sum) in self.node.iter().zip(sums) {
            nodes[*node] += sum;
        }
    }
}
