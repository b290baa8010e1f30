//! Forces and stiffness of a step.

use super::algebra::dot;
use super::average::Average;
use super::contact::{self, Obstacle, Push};
use super::elements::Elements;
use super::inertia::{Inertia, Mass};
use super::penalty::Penalty;
use super::response::{Particle, Square, Tangent};
use super::unknowns::{Pattern, Unknowns};
use crate::bodies::{Bodies, check_jacobian};
use crate::error::Fault;
use crate::parallel::{LIGHT, map};
use crate::space::{determinant, embed};
use nalgebra::{DMatrix, SMatrix, SVector};
use std::array::from_fn;

/// Share of the heaviest node's mass that the tangent gives to every node, and that none has in equilibrium: a function
/// that is zero at all its particles has gradients there, and may have fewer of them than unknowns.
const REGULAR: f64 = 1e-14;
/// Elements whose matrices are held at once.
const BATCH: usize = 256;

/// A step of the bodies: what stays as it is at its start.
pub(super) struct Step<'a, const D: usize> {
    pub(super) bodies: &'a Bodies<D>,
    pub(super) dt: f64,
    pub(super) elements: &'a Elements<D>,
    pub(super) unknowns: &'a Unknowns<D>,
    pub(super) penalties: &'a [Penalty],
    /// A, with F̄.
    pub(super) average: Option<&'a Average<D>>,
    /// Inertia, in dynamics.
    pub(super) inertia: Option<&'a Inertia<D>>,
    /// Rigid bodies where the equations hold.
    pub(super) obstacles: &'a [Obstacle<D>],
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
    /// Actions of rigid bodies on particles.
    pub(super) pushes: Vec<Push<D>>,
    /// Forces of the body's stress on the nodes less those of rigid bodies (N).
    pub(super) internal: Vec<SVector<f64, D>>,
    /// Forces of the penalties, and c M x of inertia (N).
    pub(super) resistance: Vec<SVector<f64, D>>,
}

impl<const D: usize> Step<'_, D> {
    /// A particle at the start of the step.
    fn particle(&self, p: usize) -> Particle<'_> {
        let particles = &self.bodies.particles;
        let j = match self.average {
            None => particles.jacobian[p],
            Some(_) => particles.j_bar[p],
        };
        Particle {
            law: &self.bodies.of(p).law,
            state: self.bodies.of(p).state(p),
            dt: self.dt,
            volume: particles.reference_volume[p] * j,
        }
    }

    /// The trial with these increments of the unknowns, Eqs. (3) to (9) of `docs/implicit.md`.
    ///
    /// # Errors
    /// The first particle whose ΔJ, or its average, is not positive and finite, whose gap is closed, or whose stress is not
    /// finite.
    pub(super) fn trial(&self, values: &[f64], nodes: usize) -> Result<Trial<D>, (usize, Fault)> {
        let elements = self.elements;
        let mut u = vec![[0.0; D]; nodes];
        self.unknowns.spread(values, &mut u);
        let pushes = self.pushes(&u)?;
        let count = self.bodies.particles.len();
        let f = map(count, LIGHT, |p| elements.deformation(p, &u));
        let check = |values: &[f64]| -> Result<(), (usize, Fault)> {
            let bad = |(p, j): (usize, &f64)| check_jacobian(*j).err().map(|fault| (p, fault));
            values.iter().enumerate().find_map(bad).map_or(Ok(()), Err)
        };
        let change: Vec<f64> = f.iter().map(determinant).collect();
        check(&change)?;
        let averaged = self.average.map(|a| a.apply(elements, &change));
        let averaged = averaged.unwrap_or_default();
        check(&averaged)?;
        let answers = map(count, LIGHT, |p| {
            let averaged = averaged.get(p).copied();
            self.particle(p).respond::<f64, D>(&embed(&f[p]), averaged)
        });
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
            let stress: Square<D> =
                from_fn(|i| from_fn(|j| answer.stress[D * i + j] + share * answer.cofactor[D * i + j]));
            add_forces(&stress, elements.gradients(p), sums);
        });
        contact::relieve(&pushes, elements, &mut internal);
        let resistance = self.resistance(&u);
        Ok(Trial { u, f, averaged, share, pushes, internal, resistance })
    }

    /// Actions of rigid bodies on particles at nodal increments (m).
    fn pushes(&self, u: &[[f64; D]]) -> Result<Vec<Push<D>>, (usize, Fault)> {
        let particles = &self.bodies.particles;
        contact::pushes(self.obstacles, self.elements, particles, &vectors(u))
    }

    /// How much of a correction of the unknowns (m) may be taken from nodal increments `u` (m), for gaps to stay open.
    pub(super) fn open_share(&self, u: &[[f64; D]], correction: &[f64]) -> f64 {
        if self.obstacles.is_empty() {
            return 1.0;
        }
        let mut change = vec![[0.0; D]; u.len()];
        self.unknowns.spread(correction, &mut change);
        let (u, change) = (vectors(u), vectors(&change));
        let particles = &self.bodies.particles;
        contact::open_share(self.obstacles, self.elements, particles, &u, &change)
    }

    /// Forces that are linear in the increments: penalties and inertia.
    fn resistance(&self, u: &[[f64; D]]) -> Vec<SVector<f64, D>> {
        let mut forces = self.penalty_forces(u);
        if let Some(inertia) = self.inertia {
            let products = inertia.mass.times(self.elements, &vectors(u));
            for (force, product) in forces.iter_mut().zip(products) {
                *force += product * inertia.factor;
            }
        }
        forces
    }

    /// Forces of the penalties (N) against increments.
    pub(super) fn penalty_forces(&self, u: &[[f64; D]]) -> Vec<SVector<f64, D>> {
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
    pub(super) fn tangents(&self, trial: &Trial<D>) -> Vec<Tangent<D>> {
        let mut tangents = map(trial.f.len(), LIGHT, |p| {
            let averaged = trial.averaged.get(p).copied();
            let share = trial.share.get(p).copied().unwrap_or(0.0);
            self.particle(p).tangent::<D>(&trial.f[p], averaged, share)
        });
        for push in &trial.pushes {
            tangents[push.particle].held += push.stiffness;
        }
        tangents
    }

    /// The entries of the stiffness matrix, Eq. (5), and of Eq. (11) onto cells; with F̄ onto other functions of what
    /// preconditions it, Eq. (13), where a node's pressure comes after its displacements.
    pub(super) fn stiffness(&self, tangents: &[Tangent<D>], pattern: &Pattern) -> Vec<f64> {
        let mut values = vec![0.0; pattern.entries()];
        let (unknowns, elements, width) = (self.unknowns, self.elements, pattern.width);
        let mut add = |nodes: &[usize], matrix: &DMatrix<f64>| {
            let own = matrix.nrows() / nodes.len();
            let places: Vec<Option<usize>> = nodes.iter().map(|n| unknowns.of(*n)).collect();
            for (j, column) in places.iter().enumerate() {
                let Some(column) = *column else { continue };
                for (i, row) in places.iter().enumerate() {
                    let Some(row) = *row else { continue };
                    // The free columns of a node have the same rows, and its free rows follow one another.
                    let first = |node: usize| (0..width).find(|a| unknowns.is_free(node, *a));
                    let Some((a, b)) = first(row).zip(first(column)) else {
                        continue;
                    };
                    let (row_of, column_of) = (row * width, column * width);
                    let Some(place) = pattern.place(row_of + a, column_of + b) else {
                        continue;
                    };
                    let offset = place - pattern.begin[column_of + b];
                    for b in (0..own).filter(|b| unknowns.is_free(column, *b)) {
                        let begin = pattern.begin[column_of + b] + offset;
                        let rows = (0..own).filter(|a| unknowns.is_free(row, *a));
                        for (place, a) in (begin..).zip(rows) {
                            values[place] += matrix[(i * own + a, j * own + b)];
                        }
                    }
                }
            }
        };
        for first in (0..elements.particles.len()).step_by(BATCH) {
            let batch = first..elements.particles.len().min(first + BATCH);
            let matrices = map(batch.len(), 1, |k| self.of_element(batch.start + k, tangents, width));
            for (element, matrix) in batch.zip(&matrices) {
                add(elements.nodes_of(element), matrix);
            }
        }
        let cells = self.average.map_or(&[][..], |average| &average.cells);
        for batch in cells.chunks(BATCH) {
            let matrices = map(batch.len(), 1, |k| {
                let volume = &self.bodies.particles.volume;
                batch[k].stiffness(elements, volume, tangents, self.unseen())
            });
            for (cell, matrix) in batch.iter().zip(&matrices) {
                add(&cell.node, matrix);
            }
        }
        for Penalty { node, stiffness } in self.penalties {
            add(node, stiffness);
        }
        self.add_lumped(pattern, &mut values);
        self.stand_in(pattern, &mut values);
        values
    }

    /// The share of a field that an average cannot see which it keeps.
    fn unseen(&self) -> f64 {
        self.average.map_or(0.0, Average::unseen)
    }

    /// The lumped share of c M.
    fn add_lumped(&self, pattern: &Pattern, values: &mut [f64]) {
        let Some(inertia) = self.inertia else {
            return;
        };
        let Mass { lumped, node, .. } = &inertia.mass;
        let floor = REGULAR * inertia.mass.heaviest();
        for (k, n) in self.unknowns.node.iter().enumerate() {
            for i in k * pattern.width..k * pattern.width + D {
                if let Some(place) = pattern.place(i, i) {
                    values[place] += inertia.factor * (lumped * node[*n] + floor);
                }
            }
        }
    }

    /// Held unknowns are eliminated, and pressures that no particle resists: what stands for them is of the order of
    /// the others.
    fn stand_in(&self, pattern: &Pattern, values: &mut [f64]) {
        let width = pattern.width;
        let diagonals = (0..self.unknowns.node.len()).flat_map(|k| {
            (0..width).filter_map(move |a| {
                let i = k * width + a;
                Some((k, a, pattern.place(i, i)?))
            })
        });
        let greatest = diagonals
            .clone()
            .filter(|(k, a, _)| self.unknowns.is_free(*k, *a))
            .fold(0.0, |g: f64, (_, _, place)| g.max(values[place]));
        let stand_in = if greatest > 0.0 { greatest } else { 1.0 };
        for (k, a, place) in diagonals {
            if !self.unknowns.is_free(k, a) {
                values[place] = stand_in;
            } else if a == D && values[place] >= 0.0 {
                values[place] = -stand_in;
            }
        }
    }

    /// Σ ∇w · H · ∇w over the particles of an element; with a pressure, what couples it to changes of volume, and its
    /// own.
    fn of_element(&self, element: usize, tangents: &[Tangent<D>], width: usize) -> DMatrix<f64> {
        let size = self.elements.nodes_of(element).len() * width;
        let mut matrix = DMatrix::zeros(size, size);
        let unseen = self.unseen();
        // Onto cells all of Eq. (11).
        let alone = unseen > 0.0 && width == D;
        for p in self.elements.particles[element].clone() {
            let t = &tangents[p];
            let own = unseen.powi(2) * t.pull_by_a;
            let (_, w, dw) = self.elements.seen(p);
            let volume = |g: &[f64; D], b: usize| dot(&t.cofactor[b], g);
            let inertia = self.inertia.map_or(0.0, |i| i.factor * i.mass.shared(p));
            for (j, g) in dw.iter().enumerate() {
                for b in 0..D {
                    let change = volume(g, b);
                    let mut column: Square<D> =
                        from_fn(|a| from_fn(|c| dot(&t.stress_by_f[a][c][b], g) + own * t.cofactor[a][c] * change));
                    if alone {
                        let pull = dot(&t.pull_by_f[b], g);
                        for (a, c) in (0..D * D).map(|k| (k / D, k % D)) {
                            column[a][c] += unseen * (t.stress_by_a[a][c] * change + t.cofactor[a][c] * pull);
                        }
                    }
                    for (i, f) in dw.iter().enumerate() {
                        for a in 0..D {
                            let m = if a == b { inertia } else { 0.0 };
                            let held = (m + t.held[(a, b)]) * w[i] * w[j];
                            matrix[(i * width + a, j * width + b)] += dot(f, &column[a]) + held;
                        }
                    }
                }
            }
            if width == D {
                continue;
            }
            let resistance = t.pull_by_a.max(0.0);
            for (i, w) in w.iter().enumerate() {
                let pressure = i * width + D;
                matrix[(pressure, pressure)] -= w * resistance;
                for (j, g) in dw.iter().enumerate() {
                    for b in 0..D {
                        let change = w * resistance * volume(g, b);
                        matrix[(pressure, j * width + b)] += change;
                        matrix[(j * width + b, pressure)] += change;
                    }
                }
            }
        }
        matrix
    }

    /// K `x` with the exact stiffness of F̄, Eq. (12); `x` is zero at held unknowns, and so is the product.
    pub(super) fn apply(&self, tangents: &[Tangent<D>], x: &[f64], nodes: usize) -> Vec<f64> {
        let elements = self.elements;
        let mut u = vec![[0.0; D]; nodes];
        self.unknowns.spread(x, &mut u);
        let count = tangents.len();
        let change = map(count, LIGHT, |p| elements.gradient(p, &u));
        let averages = self.average.map(|average| {
            let volume = map(count, LIGHT, |p| double(&tangents[p].cofactor, &change[p]));
            let averaged = average.apply(elements, &volume);
            let pull =
                map(count, LIGHT, |p| double(&tangents[p].pull_by_f, &change[p]) + tangents[p].pull_by_a * averaged[p]);
            (averaged, average.transposed(elements, &pull))
        });
        let mut forces = self.resistance(&u);
        elements.scatter(SVector::zeros(), &mut forces, |p, sums| {
            let t = &tangents[p];
            let averages = averages.as_ref();
            let (averaged, share) = averages.map_or((0.0, 0.0), |(a, s)| (a[p], s[p]));
            let stress: Square<D> = from_fn(|i| {
                from_fn(|j| {
                    double(&t.stress_by_f[i][j], &change[p]) + averaged * t.stress_by_a[i][j] + share * t.cofactor[i][j]
                })
            });
            add_forces(&stress, elements.gradients(p), sums);
        });
        let u = vectors(&u);
        for (p, t) in tangents.iter().enumerate() {
            if t.held.iter().any(|k| *k != 0.0) {
                let resisting = t.held * elements.value(p, &u);
                let (nodes, w, _) = elements.seen(p);
                for (node, w) in nodes.iter().zip(w) {
                    forces[*node] += resisting * *w;
                }
            }
        }
        self.free(&forces)
    }

    /// Nodal values at the unknowns, zero at those that are held.
    pub(super) fn free(&self, nodes: &[SVector<f64, D>]) -> Vec<f64> {
        let unknowns = self.unknowns;
        let seen = unknowns.node.iter();
        let all = seen.flat_map(|node| nodes[*node].iter().copied());
        let pairs = all.zip(&unknowns.held);
        pairs.map(|(value, held)| if held.is_some() { 0.0 } else { value }).collect()
    }
}

fn vectors<const D: usize>(u: &[[f64; D]]) -> Vec<SVector<f64, D>> {
    u.iter().map(|u| SVector::from(*u)).collect()
}

/// Adds P ∇w to the forces of an element's nodes.
fn add_forces<const D: usize>(stress: &Square<D>, dw: &[[f64; D]], sums: &mut [SVector<f64, D>]) {
    for (sum, dw) in sums.iter_mut().zip(dw) {
        for i in 0..D {
            for j in 0..D {
                sum[i] += stress[i][j] * dw[j];
            }
        }
    }
}

/// `a` : `b`.
fn double<const D: usize>(a: &Square<D>, b: &SMatrix<f64, D, D>) -> f64 {
    let mut sum = 0.0;
    for i in 0..D {
        for j in 0..D {
            sum += a[i][j] * b[(i, j)];
        }
    }
    sum
}
