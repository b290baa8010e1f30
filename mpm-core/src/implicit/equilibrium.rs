//! Forces and stiffness of a step: what its equations are made of.

use super::average::Average;
use super::elements::Elements;
use super::penalty::Penalty;
use super::response::{MOST, Particle, Tangent};
use super::unknowns::{Pattern, Unknowns};
use crate::body::{Body, check_jacobian};
use crate::error::Fault;
use crate::material::Law;
use crate::space::{determinant, embed};
use nalgebra::{DMatrix, SMatrix, SVector};
use rayon::prelude::*;

/// The share of the volumetric stiffness of F̄ that its preconditioner has locally.
const LOCAL_SHARE: f64 = 0.1;
/// Elements whose matrices are held at once.
const BATCH: usize = 256;

/// A step of a body: what stays as it is at its start.
pub(super) struct Step<'a, const D: usize, M: Law> {
    pub(super) body: &'a Body<D, M>,
    pub(super) dt: f64,
    pub(super) elements: &'a Elements<D>,
    pub(super) unknowns: &'a Unknowns<D>,
    pub(super) penalties: &'a [Penalty],
    /// A, with F̄.
    pub(super) average: Option<&'a Average>,
}

/// A trial: nodal increments and what they make of the body.
pub(super) struct Trial<const D: usize> {
    /// Increments of the nodes (m).
    pub(super) u: Vec<[f64; D]>,
    /// ΔF of every particle.
    pub(super) f: Vec<SMatrix<f64, D, D>>,
    /// A ΔJ of every particle; empty without F̄.
    pub(super) averaged: Vec<f64>,
    /// Aᵀ q of every particle (J); empty without F̄.
    share: Vec<f64>,
    /// Forces of the body's stress on the nodes (N).
    pub(super) internal: Vec<SVector<f64, D>>,
    /// Forces of the penalties (N).
    pub(super) penalty: Vec<SVector<f64, D>>,
}

impl<const D: usize, M: Law> Step<'_, D, M> {
    /// A particle at the start of the step.
    fn particle(&self, p: usize) -> Particle<'_, M> {
        let particles = &self.body.particles;
        let j = match self.average {
            None => particles.jacobian[p],
            Some(_) => particles.j_bar[p],
        };
        Particle {
            law: &self.body.law,
            state: &self.body.states()[p],
            dt: self.dt,
            volume: particles.reference_volume[p] * j,
        }
    }

    /// The trial with these increments of the unknowns, Eqs. (3) to (9) of `docs/implicit.md`.
    ///
    /// # Errors
    /// The first particle whose ΔJ, or its average, is not positive and finite, or whose stress is not finite.
    pub(super) fn trial(&self, values: &[f64], nodes: usize) -> Result<Trial<D>, (usize, Fault)> {
        let elements = self.elements;
        let mut u = vec![[0.0; D]; nodes];
        self.unknowns.spread(values, &mut u);
        let count = self.body.particles.len();
        let f: Vec<SMatrix<f64, D, D>> = (0..count)
            .into_par_iter()
            .map(|p| elements.deformation(p, &u))
            .collect();
        let check = |values: &[f64]| -> Result<(), (usize, Fault)> {
            let bad = |(p, j): (usize, &f64)| check_jacobian(*j).err().map(|fault| (p, fault));
            values.iter().enumerate().find_map(bad).map_or(Ok(()), Err)
        };
        let change: Vec<f64> = f.iter().map(determinant).collect();
        check(&change)?;
        let averaged = self.average.map(|a| a.apply(elements, &change));
        let averaged = averaged.unwrap_or_default();
        check(&averaged)?;
        let answers: Vec<_> = (0..count)
            .into_par_iter()
            .map(|p| {
                let averaged = averaged.get(p).copied();
                self.particle(p).respond::<f64, D>(&embed(&f[p]), averaged)
            })
            .collect();
        let finite = |(p, a): (usize, &super::response::Response<f64>)| {
            let value = a.stress.iter().copied().find(|s| !s.is_finite())?;
            let quantity = "stress";
            Some((p, Fault::NotFinite { quantity, value }))
        };
        if let Some(fault) = answers.iter().enumerate().find_map(finite) {
            return Err(fault);
        }
        let share = self.average.map(|a| {
            let pulls: Vec<f64> = answers.iter().map(|a| a.pull).collect();
            a.transposed(elements, &pulls)
        });
        let share = share.unwrap_or_default();
        let mut internal = vec![SVector::zeros(); nodes];
        elements.scatter(SVector::zeros(), &mut internal, |p, sums| {
            let (answer, share) = (&answers[p], share.get(p).copied().unwrap_or(0.0));
            let stress: [f64; MOST] =
                std::array::from_fn(|i| answer.stress[i] + share * answer.cofactor[i]);
            add_forces(&stress, elements.gradients(p), sums);
        });
        let penalty = self.penalty_forces(&u);
        Ok(Trial {
            u,
            f,
            averaged,
            share,
            internal,
            penalty,
        })
    }

    fn penalty_forces(&self, u: &[[f64; D]]) -> Vec<SVector<f64, D>> {
        let mut forces = vec![SVector::zeros(); u.len()];
        for Penalty { node, stiffness } in self.penalties {
            for (j, column) in node.iter().enumerate() {
                for (i, row) in node.iter().enumerate() {
                    for b in 0..D {
                        for a in 0..D {
                            forces[*row][a] += stiffness[(i * D + a, j * D + b)] * u[*column][b];
                        }
                    }
                }
            }
        }
        forces
    }

    /// The derivatives of every particle's answer at a trial.
    pub(super) fn tangents(&self, trial: &Trial<D>) -> Vec<Tangent> {
        (0..trial.f.len())
            .into_par_iter()
            .map(|p| {
                let averaged = trial.averaged.get(p).copied();
                let share = trial.share.get(p).copied().unwrap_or(0.0);
                self.particle(p).tangent::<D>(&trial.f[p], averaged, share)
            })
            .collect()
    }

    /// The entries of the stiffness matrix, Eq. (5); with F̄ of its local part, Eq. (13), which preconditions.
    pub(super) fn stiffness(&self, tangents: &[Tangent], pattern: &Pattern) -> Vec<f64> {
        let mut values = vec![0.0; pattern.entries()];
        let unknowns = self.unknowns;
        let mut add = |nodes: &[usize], stiffness: &DMatrix<f64>| {
            for (j, column) in nodes.iter().enumerate() {
                let Some(column) = unknowns.of(*column) else {
                    continue;
                };
                for b in 0..D {
                    if unknowns.held[column + b].is_some() {
                        continue;
                    }
                    for (i, row) in nodes.iter().enumerate() {
                        let Some(row) = unknowns.of(*row) else {
                            continue;
                        };
                        for a in 0..D {
                            if let Some(place) = pattern.place(row + a, column + b) {
                                values[place] += stiffness[(i * D + a, j * D + b)];
                            }
                        }
                    }
                }
            }
        };
        let elements = self.elements;
        for first in (0..elements.particles.len()).step_by(BATCH) {
            let batch = first..elements.particles.len().min(first + BATCH);
            let matrices: Vec<DMatrix<f64>> = batch
                .clone()
                .into_par_iter()
                .map(|element| self.of_element(element, tangents))
                .collect();
            for (element, matrix) in batch.zip(&matrices) {
                add(elements.nodes_of(element), matrix);
            }
        }
        for Penalty { node, stiffness } in self.penalties {
            add(node, stiffness);
        }
        // Held unknowns are eliminated; what stands for them is of the order of the others.
        let diagonal = |i: usize| pattern.place(i, i);
        let free = (0..pattern.len()).filter(|i| unknowns.held[*i].is_none());
        let greatest = free
            .filter_map(diagonal)
            .fold(0.0, |g: f64, k| g.max(values[k]));
        let stand_in = if greatest > 0.0 { greatest } else { 1.0 };
        for i in (0..pattern.len()).filter(|i| unknowns.held[*i].is_some()) {
            if let Some(place) = diagonal(i) {
                values[place] = stand_in;
            }
        }
        values
    }

    /// Σ ∇w · H · ∇w over the particles of an element.
    fn of_element(&self, element: usize, tangents: &[Tangent]) -> DMatrix<f64> {
        let size = self.elements.nodes_of(element).len() * D;
        let mut stiffness = DMatrix::zeros(size, size);
        for p in self.elements.particles[element].clone() {
            let t = &tangents[p];
            let volumetric = LOCAL_SHARE * t.pull_by_a;
            let h = |i: usize, k: usize| {
                t.stress_by_f[i][k] + volumetric * t.cofactor[i] * t.cofactor[k]
            };
            let dw = self.elements.gradients(p);
            for (j, g) in dw.iter().enumerate() {
                for b in 0..D {
                    let mut column = [0.0; MOST];
                    for (i, c) in column.iter_mut().enumerate().take(D * D) {
                        *c = (0..D).map(|d| h(i, D * b + d) * g[d]).sum();
                    }
                    for (i, f) in dw.iter().enumerate() {
                        for a in 0..D {
                            let k: f64 = (0..D).map(|c| f[c] * column[D * a + c]).sum();
                            stiffness[(i * D + a, j * D + b)] += k;
                        }
                    }
                }
            }
        }
        stiffness
    }

    /// K `x` with the exact stiffness of F̄, Eq. (12); `x` is zero at held unknowns, and so is the product.
    pub(super) fn apply(&self, tangents: &[Tangent], x: &[f64], nodes: usize) -> Vec<f64> {
        let elements = self.elements;
        let mut u = vec![[0.0; D]; nodes];
        self.unknowns.spread(x, &mut u);
        let change: Vec<SMatrix<f64, D, D>> = (0..tangents.len())
            .into_par_iter()
            .map(|p| elements.deformation(p, &u) - SMatrix::identity())
            .collect();
        let double = |with: &[f64; MOST], p: usize| -> f64 {
            (0..D * D)
                .map(|k| with[k] * change[p][(k / D, k % D)])
                .sum()
        };
        let count = tangents.len();
        let volume: Vec<f64> = (0..count)
            .map(|p| double(&tangents[p].cofactor, p))
            .collect();
        let averaged = self.average.map(|a| a.apply(elements, &volume));
        let share = averaged
            .as_ref()
            .zip(self.average)
            .map(|(averaged, average)| {
                let pull = |p: usize| {
                    double(&tangents[p].pull_by_f, p) + tangents[p].pull_by_a * averaged[p]
                };
                average.transposed(elements, &(0..count).map(pull).collect::<Vec<_>>())
            });
        let mut forces = self.penalty_forces(&u);
        elements.scatter(SVector::zeros(), &mut forces, |p, sums| {
            let t = &tangents[p];
            let of = |field: &Option<Vec<f64>>| field.as_ref().map_or(0.0, |f| f[p]);
            let (averaged, share) = (of(&averaged), of(&share));
            let stress: [f64; MOST] = std::array::from_fn(|i| {
                double(&t.stress_by_f[i], p) + averaged * t.stress_by_a[i] + share * t.cofactor[i]
            });
            add_forces(&stress, elements.gradients(p), sums);
        });
        self.free(&forces)
    }

    /// Nodal values at the unknowns, zero at those that are held.
    pub(super) fn free(&self, nodes: &[SVector<f64, D>]) -> Vec<f64> {
        let unknowns = self.unknowns;
        let all = unknowns
            .node
            .iter()
            .flat_map(|node| nodes[*node].iter().copied());
        let pairs = all.zip(&unknowns.held);
        pairs
            .map(|(value, held)| if held.is_some() { 0.0 } else { value })
            .collect()
    }
}

/// Adds P ∇w to the forces of an element's nodes.
fn add_forces<const D: usize>(stress: &[f64; MOST], dw: &[[f64; D]], sums: &mut [SVector<f64, D>]) {
    for (sum, dw) in sums.iter_mut().zip(dw) {
        for i in 0..D {
            for j in 0..D {
                sum[i] += stress[D * i + j] * dw[j];
            }
        }
    }
}
