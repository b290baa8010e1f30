//! Newton's method for the equilibrium of a step.

use super::algebra::{dot, norm};
use super::equilibrium::{Step, Trial};
use super::failure::Failure;
use super::linear::Direct;
use super::response::Tangent;
use super::settings::Settings;
use super::unknowns::Pattern;
use crate::error::Fault;
use crate::material::Law;
use crate::monitor::Convergence;
use crate::work::{Spent, Work, clocked};
use nalgebra::SVector;
use std::time::Instant;

/// A correction is halved at most so often.
const MOST_CUTS: u32 = 12;
/// Conjugate gradients take at most so many iterations.
const MOST_GRADIENTS: u64 = 2000;
/// Factors precondition until conjugate gradients take more iterations than this: as many as new ones cost.
const MANY_GRADIENTS: u64 = 40;
/// The least relative accuracy of a linear solution by conjugate gradients; later ones are as good as the step's
/// residual, which keeps Newton's order.
const COARSE: f64 = 1e-2;

/// The solution of a step.
pub(super) struct Solution<const D: usize> {
    /// The increments of the unknowns (m).
    pub(super) u: Vec<f64>,
    pub(super) trial: Trial<D>,
    pub(super) convergence: Convergence,
    /// The trial of no increments.
    pub(super) before: Trial<D>,
}

/// A step with the loads at its end, and what solves it.
pub(super) struct Newton<'a, const D: usize, M: Law> {
    pub(super) step: Step<'a, D, M>,
    pub(super) settings: &'a Settings,
    /// Norm of the residual (N) that rounding of the stresses leaves.
    pub(super) rounding: f64,
    /// Increments of the unknowns (m) to begin from, if they are nearer to equilibrium than none; held ones keep theirs.
    pub(super) guess: Option<Vec<f64>>,
    /// External forces on the nodes (N), and in dynamics what the particles bring along.
    pub(super) external: &'a [SVector<f64, D>],
    pub(super) pattern: &'a Pattern,
    pub(super) direct: &'a mut Direct,
    pub(super) work: &'a mut Work,
    pub(super) spent: &'a mut Spent,
    /// Whether new factors are wanted: of a stiffness always, of what only preconditions it when it does so badly.
    pub(super) worn: bool,
}

impl<const D: usize, M: Law> Newton<'_, D, M> {
    /// A trial of these increments.
    fn trial(&mut self, u: &[f64]) -> Result<Trial<D>, (usize, Fault)> {
        // Deformations are gathered, forces scattered.
        self.work.particle_node_pairs += 2 * self.step.elements.pairs() as u64;
        let nodes = self.external.len();
        clocked(&mut self.spent.forces, || self.step.trial(u, nodes))
    }

    /// F_ext − F_int of a trial at the free unknowns (N), and the norm of the loads: of the external forces, of the
    /// internal ones at the start if there are none or if bodies swing, and of reactions, if greater, where a constraint
    /// moves.
    fn residual(&self, trial: &Trial<D>, start: f64) -> (Vec<f64>, f64) {
        let forces = trial
            .internal
            .iter()
            .zip(&trial.resistance)
            .zip(self.external);
        let out: Vec<SVector<f64, D>> = forces.map(|((f, g), e)| e - f - g).collect();
        let residual = self.step.free(&out);
        let unknowns = self.step.unknowns;
        let moves = unknowns.held.iter().flatten().any(|u| *u != 0.0);
        let mut held = 0.0;
        for (k, node) in unknowns.node.iter().enumerate() {
            for a in 0..D {
                if unknowns.held[k * D + a].is_some() && moves {
                    held += out[*node][a] * out[*node][a];
                }
            }
        }
        let external = norm(&self.step.free(self.external));
        let inner = external == 0.0 || self.step.inertia.is_some();
        let loads = if inner { external.max(start) } else { external };
        (residual, loads.max(held.sqrt()))
    }

    /// The increments to begin from, of those `rest` and the guess, and their trial: what is nearer to equilibrium.
    /// Functions that hardly see material can have moved far, and are no guide.
    fn beginning(
        &mut self,
        rest: Vec<f64>,
        start: f64,
    ) -> Result<(Vec<f64>, Trial<D>), (usize, Fault)> {
        let guess = self.guess.take();
        let mut begin = |u: Vec<f64>| {
            let held = self.step.unknowns.held.iter().zip(u);
            let u: Vec<f64> = held.map(|(held, u)| held.unwrap_or(u)).collect();
            let trial = self.trial(&u)?;
            let size = norm(&self.residual(&trial, start).0);
            Ok((size, u, trial))
        };
        let plain = begin(rest);
        let found = match guess.map(begin) {
            Some(Ok(guess)) if plain.as_ref().is_ok_and(|plain| plain.0 <= guess.0) => plain,
            Some(Ok(guess)) => Ok(guess),
            _ => plain,
        };
        found.map(|(_, u, trial)| (u, trial))
    }

    /// Solves the step.
    ///
    /// # Errors
    /// There is no solution that the method finds.
    pub(super) fn solve(&mut self) -> Result<Solution<D>, Failure> {
        let rest = vec![0.0; self.step.unknowns.len()];
        let at_rest = self.trial(&rest)?;
        let start = norm(&self.step.free(&at_rest.internal));
        let before = at_rest;
        let (mut u, mut trial) = self.beginning(rest, start)?;
        let (mut residual, mut loads) = self.residual(&trial, start);
        let mut convergence = Convergence::default();
        let mut last = vec![0.0; u.len()];
        let external = self.step.free(self.external);
        for iteration in 0..=self.settings.most_iterations {
            let size = norm(&residual);
            let share = if loads > 0.0 { size / loads } else { size };
            convergence.residuals.push(share);
            if share <= self.settings.tolerance || size <= self.rounding {
                let scale = norm(&external).max(f64::MIN_POSITIVE);
                convergence.force_ratio = size / scale;
                convergence.force_rounding = self.rounding / scale;
                let work = dot(&external, &u).abs().max(f64::MIN_POSITIVE);
                convergence.energy_ratio = dot(&residual, &last).abs() / work;
                return Ok(Solution {
                    u,
                    trial,
                    convergence,
                    before,
                });
            }
            if iteration == self.settings.most_iterations {
                break;
            }
            last = self.correction(&trial, &residual, share, iteration)?;
            let slope = dot(&last, &residual).abs();
            let mut length = self.step.open_share(&trial.u, &last);
            let mut cuts = 0;
            loop {
                let moved: Vec<f64> = u.iter().zip(&last).map(|(u, d)| u + length * d).collect();
                let attempt = self.trial(&moved);
                let accepted = attempt.map(|attempt| {
                    let (ahead, loads_ahead) = self.residual(&attempt, start);
                    // Past the least energy along the line by no more than it was before it, or nearer to equilibrium.
                    let close = dot(&last, &ahead).abs() <= slope || norm(&ahead) <= size;
                    close.then_some((attempt, ahead, loads_ahead))
                });
                match accepted {
                    Ok(Some((attempt, ahead, loads_ahead))) => {
                        (u, trial, residual, loads) = (moved, attempt, ahead, loads_ahead);
                        break;
                    }
                    Ok(None) if cuts == MOST_CUTS => {
                        return Err(Failure::NoConvergence(iteration, share));
                    }
                    Err(fault) if cuts == MOST_CUTS => return Err(fault.into()),
                    _ => {}
                }
                length *= 0.5;
                cuts += 1;
            }
            self.work.newton_iterations += 1;
        }
        let share = convergence.residuals.last().copied().unwrap_or(f64::NAN);
        Err(Failure::NoConvergence(self.settings.most_iterations, share))
    }

    /// K⁻¹ `residual`.
    fn correction(
        &mut self,
        trial: &Trial<D>,
        residual: &[f64],
        share: f64,
        iteration: u32,
    ) -> Result<Vec<f64>, Failure> {
        let step = &self.step;
        let tangents = clocked(&mut self.spent.assembly, || step.tangents(trial));
        if self.worn {
            let pattern = self.pattern;
            let values = clocked(&mut self.spent.assembly, || {
                step.stiffness(&tangents, pattern)
            });
            self.work.assemblies += 1;
            self.work.factorisations += 1;
            self.work.nonzeros += pattern.entries() as u64;
            let factorised = clocked(&mut self.spent.factorisation, || {
                self.direct.factorise(&values)
            });
            factorised.map_err(|_| Failure::Singular(iteration))?;
        }
        let begun = Instant::now();
        let found = if step.average.is_some() {
            let enough = 0.1 * self.settings.tolerance / share;
            let accuracy = share.min(COARSE).max(enough).max(1e-12);
            let before = self.work.linear_iterations;
            let found = self.conjugate_gradients(&tangents, residual, accuracy);
            self.worn = self.work.linear_iterations - before > MANY_GRADIENTS;
            found
        } else {
            self.work.linear_iterations += 1;
            Some(self.by_factors(residual))
        };
        self.spent.solution += begun.elapsed().as_secs_f64();
        let usable = |x: &Vec<f64>| x.iter().all(|x| x.is_finite());
        found.filter(usable).ok_or(Failure::Singular(iteration))
    }

    /// The displacements that the factors give for `right`, without forces on what else the matrix has.
    fn by_factors(&mut self, right: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.pattern.len()];
        for (x, r) in x.chunks_exact_mut(self.pattern.width).zip(right.chunks(D)) {
            x[..D].copy_from_slice(r);
        }
        self.direct.solve(&mut x);
        let of_nodes = x.chunks_exact(self.pattern.width);
        of_nodes.flat_map(|x| x[..D].iter().copied()).collect()
    }

    /// Conjugate gradients with the exact stiffness of F̄, preconditioned by the factors of Eq. (13). Where the
    /// stiffness is not positive they stop at what they have.
    fn conjugate_gradients(
        &mut self,
        tangents: &[Tangent<D>],
        right: &[f64],
        accuracy: f64,
    ) -> Option<Vec<f64>> {
        let nodes = self.external.len();
        let mut x = vec![0.0; right.len()];
        let mut rest = right.to_vec();
        let mut direction = self.by_factors(&rest);
        let mut product = dot(&rest, &direction);
        let target = accuracy * norm(right);
        for iteration in 0..MOST_GRADIENTS {
            if norm(&rest) <= target {
                return Some(x);
            }
            self.work.linear_iterations += 1;
            let image = self.step.apply(tangents, &direction, nodes);
            let curvature = dot(&direction, &image);
            if curvature <= 0.0 || product <= 0.0 {
                return (iteration > 0).then_some(x);
            }
            let length = product / curvature;
            for (x, d) in x.iter_mut().zip(&direction) {
                *x += length * d;
            }
            for (r, a) in rest.iter_mut().zip(&image) {
                *r -= length * a;
            }
            let next = self.by_factors(&rest);
            let ahead = dot(&rest, &next);
            let share = ahead / product;
            for (d, z) in direction.iter_mut().zip(&next) {
                *d = z + share * *d;
            }
            product = ahead;
        }
        None
    }
}
