//! The functions that see the particles, as they are at a step's start and stay in all of it.

use super::algebra::dot;
use super::domains::Domains;
use super::functions::Functions;
use super::interpolation::Interpolation;
use crate::parallel::for_each_piece;
use nalgebra::{SMatrix, SVector};
use std::mem::take;
use std::ops::{AddAssign, Mul, Range};

/// Units in the last place by which a stress is rounded.
pub(crate) const LAST_BITS: f64 = 4.0;
/// Smallest value, or slope over a cell, of a function that counts at a particle: less is rounding of a domain that
/// ends on a grid line.
const LEAST: f64 = 1e-12;
/// That slope over the share of a cell by which the domain, of an eighth of it or more, reaches over the line.
const PER_ROUNDING: f64 = 8.0;
/// Elements that one thread sums at once.
const BATCH: usize = 64;

/// Particles in runs that the same nodes see, with values and gradients of the functions.
pub(crate) struct Elements<const D: usize> {
    /// Particles of every element.
    pub(crate) particles: Vec<Range<usize>>,
    /// Nodes of the elements, one after the other; images are their originals.
    node: Vec<usize>,
    /// Where the nodes of every element begin, and those of the last one end.
    first_node: Vec<usize>,
    /// Element of every particle.
    element: Vec<usize>,
    /// Values of the functions that see a particle, one particle after the other.
    w: Vec<f64>,
    /// Gradients (1/m), in the same order.
    dw: Vec<[f64; D]>,
    /// Where the functions of every particle begin, and those of the last one end.
    first: Vec<usize>,
    /// Rounding of the particles' positions (m).
    rounding: f64,
}

/// The element of every domain.
pub(crate) fn of_domains<const D: usize>(functions_of: &dyn Interpolation<D>, domains: Domains<D>) -> Vec<usize> {
    let mut functions = Functions::new();
    let element = |(x, half_size): (&[f64; D], [f64; D])| {
        functions_of.functions(x, &half_size, &mut functions);
        functions.element
    };
    domains.iter().map(element).collect()
}

impl<const D: usize> Elements<D> {
    /// Elements of particles that stand in the order of [their numbers](of_domains).
    pub(crate) fn new(functions_of: &dyn Interpolation<D>, originals: &[usize], domains: Domains<D>) -> Self {
        let support = functions_of.support();
        let count = domains.centre.len();
        let mut elements = Self {
            particles: Vec::new(),
            node: Vec::new(),
            first_node: vec![0],
            element: Vec::with_capacity(count),
            w: Vec::with_capacity(count * support),
            dw: Vec::with_capacity(count * support),
            first: vec![0],
            rounding: domains.rounding(),
        };
        let mut functions = Functions::new();
        let mut last = None;
        for (p, (x, half_size)) in domains.iter().enumerate() {
            functions_of.functions(x, &half_size, &mut functions);
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

    /// Σ w `of` of every one of `nodes` nodes, such as its volume or mass; NaN of one that no element has.
    pub(crate) fn sums(&self, nodes: usize, of: &[f64]) -> Vec<f64> {
        let mut sums = vec![f64::NAN; nodes];
        for node in &self.node {
            sums[*node] = 0.0;
        }
        self.scatter_values(0.0, &mut sums, |p| of[p]);
        sums
    }

    /// Σ w f of every one of `nodes` nodes (N), for forces f on the particles, or none.
    pub(crate) fn forces(&self, nodes: usize, of: &[[f64; D]]) -> Vec<SVector<f64, D>> {
        let mut forces = vec![SVector::zeros(); nodes];
        if !of.is_empty() {
            self.scatter_values(SVector::zeros(), &mut forces, |p| SVector::from(of[p]));
        }
        forces
    }

    /// Norm of the forces (N) on `nodes` nodes that rounding of stresses by some last bits of a `modulus` (Pa) causes,
    /// for particles of these volumes (m³).
    pub(crate) fn rounding(&self, nodes: usize, volume: &[f64], modulus: f64) -> f64 {
        let mut reach = vec![0.0; nodes];
        self.scatter(0.0, &mut reach, |p, sums| {
            for (sum, dw) in sums.iter_mut().zip(self.gradients(p)) {
                *sum += volume[p] * dot(dw, dw).sqrt();
            }
        });
        LAST_BITS * f64::EPSILON * modulus * dot(&reach, &reach).sqrt()
    }

    /// The element of a particle.
    pub(crate) fn element_of(&self, particle: usize) -> usize {
        self.element[particle]
    }

    /// Σ w of a field on the nodes at a particle.
    pub(crate) fn value(&self, particle: usize, field: &[SVector<f64, D>]) -> SVector<f64, D> {
        let (nodes, w, _) = self.seen(particle);
        let pairs = nodes.iter().zip(w);
        pairs.fold(SVector::zeros(), |sum, (node, w)| sum + field[*node] * *w)
    }

    /// Whether a particle sees each of `nodes` nodes by more than rounding, on cells of size `h` (m). A function with
    /// no value but a gradient at a particle bears force and counts.
    pub(crate) fn seen_nodes(&self, nodes: usize, h: f64) -> Vec<bool> {
        let mut seen = vec![false; nodes];
        let least = LEAST + PER_ROUNDING * self.rounding / h;
        for p in 0..self.element.len() {
            let (nodes, w, dw) = self.seen(p);
            for ((node, w), dw) in nodes.iter().zip(w).zip(dw) {
                let slope = dw.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
                seen[*node] |= w + h * slope > least;
            }
        }
        seen
    }

    /// Pairs of a particle and a function that sees it.
    pub(crate) fn pairs(&self) -> usize {
        self.w.len()
    }

    /// The nodes of an element.
    pub(crate) fn nodes_of(&self, element: usize) -> &[usize] {
        &self.node[self.first_node[element]..self.first_node[element + 1]]
    }

    /// The nodes that see a particle, with values and gradients of their functions.
    pub(crate) fn seen(&self, particle: usize) -> (&[usize], &[f64], &[[f64; D]]) {
        let range = self.first[particle]..self.first[particle + 1];
        let nodes = self.nodes_of(self.element[particle]);
        (nodes, &self.w[range.clone()], &self.dw[range])
    }

    /// Values and gradients of the functions that see a particle.
    pub(crate) fn gradients(&self, particle: usize) -> &[[f64; D]] {
        &self.dw[self.first[particle]..self.first[particle + 1]]
    }

    /// ΔF = I + Σ u ⊗ ∇w of a particle, Eq. (3) of `docs/implicit.md`, for the nodal increments `u` (m).
    pub(crate) fn deformation(&self, particle: usize, u: &[[f64; D]]) -> SMatrix<f64, D, D> {
        self.gather(SMatrix::identity(), particle, u)
    }

    /// Σ u ⊗ ∇w at a particle, for nodal values `u`.
    pub(crate) fn gradient(&self, particle: usize, u: &[[f64; D]]) -> SMatrix<f64, D, D> {
        self.gather(SMatrix::zeros(), particle, u)
    }

    fn gather(&self, mut f: SMatrix<f64, D, D>, particle: usize, u: &[[f64; D]]) -> SMatrix<f64, D, D> {
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
    pub(crate) fn scatter<T: Copy + Send + Sync + AddAssign>(
        &self,
        zero: T,
        nodes: &mut [T],
        of: impl Fn(usize, &mut [T]) + Sync,
    ) {
        self.scatter_runs(zero, nodes, &|particles, sums| {
            for p in particles {
                of(p, sums);
            }
        });
    }

    /// Adds Σ w `of`(particle) to the nodes that see particles; `zero` is that of the type.
    pub(crate) fn scatter_values<T: Copy + Send + Sync + AddAssign + Mul<f64, Output = T>>(
        &self,
        zero: T,
        nodes: &mut [T],
        of: impl Fn(usize) -> T + Sync,
    ) {
        self.scatter(zero, nodes, |p, sums| {
            let value = of(p);
            for (sum, w) in sums.iter_mut().zip(self.seen(p).1) {
                *sum += value * *w;
            }
        });
    }

    /// [`Self::scatter`] by the runs of particles of elements: one instance a type.
    fn scatter_runs<T: Copy + Send + Sync + AddAssign>(
        &self,
        zero: T,
        nodes: &mut [T],
        of: &(dyn Fn(Range<usize>, &mut [T]) + Sync),
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
        let count = batches.len();
        for_each_piece(&mut batches[..], count, 1, &|_, batch: &mut [_]| {
            for (elements, rest) in batch {
                for element in elements.clone() {
                    let count = self.nodes_of(element).len();
                    let (own, others) = take(rest).split_at_mut(count);
                    of(self.particles[element].clone(), own);
                    *rest = others;
                }
            }
        });
        for (node, sum) in self.node.iter().zip(sums) {
            nodes[*node] += sum;
        }
    }
}
