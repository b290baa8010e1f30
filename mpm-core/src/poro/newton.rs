//! Newton's method for the displacements and pressures of a step.

use super::step::{Step, Trial};
use crate::implicit::algebra::{dot, norm};
use crate::implicit::failure::Failure;
use crate::implicit::linear::Direct;
use crate::material::Law;
use crate::monitor::Convergence;
use crate::work::{Spent, Work, clocked};
use std::time::Instant;

/// A correction is halved at most so often.
const MOST_CUTS: u32 = 16;
/// The share of its pores that a particle keeps at least in one correction.
const KEPT: f64 = 0.1;

/// A step, and what solves it.
pub(super) struct Newton<'a, const D: usize, M: Law> {
    pub(super) step: Step<'a, D, M>,
    /// Norm of the out-of-balance forces (N) that rounding leaves.
    pub(super) rounding: f64,
    pub(super) direct: &'a mut Direct,
    pub(super) work: &'a mut Work,
    pub(super) spent: &'a mut Spent,
}

impl<const D: usize, M: Law> Newton<'_, D, M> {
    fn trial(&mut self, x: &[f64]) -> Result<Trial<D>, (usize, crate::error::Fault)> {
        let setting = self.step.setting;
        // Deformations and pressures are gathered, forces and volumes scattered.
        self.work.particle_node_pairs += 2 * (setting.solid.pairs() + setting.water.pairs()) as u64;
        clocked(&mut self.spent.forces, || self.step.trial(x))
    }

    /// The greater of the residuals over what the two equations balance; zero where rounding decides, and infinite of
    /// what is no number.
    fn share(&self, residual: &[f64], trial: &Trial<D>) -> f64 {
        let parts = residual.split_at(self.step.setting.unknowns.displacements);
        let mut share: f64 = 0.0;
        for (k, part) in [parts.0, parts.1].into_iter().enumerate() {
            let (size, rounding) = (norm(part), [self.rounding, trial.rounding][k]);
            if !(size.is_finite() && rounding.is_finite()) {
                return f64::INFINITY;
            }
            if size > rounding {
                share = share.max(size / trial.scale[k].max(rounding));
            }
        }
        share
    }

    /// Solves the step from the unknowns `x`.
    ///
    /// # Errors
    /// There is no solution that the method finds.
    pub(super) fn solve(&mut self, mut x: Vec<f64>) -> Result<(Trial<D>, Convergence), Failure> {
        let (tolerance, most) = (
            self.step.settings.tolerance,
            self.step.settings.most_iterations,
        );
        let mut trial = self.trial(&x)?;
        let mut residual = self.step.residual(&trial);
        let mut convergence = Convergence::default();
        let mut last_work = 0.0;
        let mut iteration = 0;
        loop {
            let share = self.share(&residual, &trial);
            convergence.residuals.push(share);
            if share <= tolerance {
                convergence.force_ratio = share;
                convergence.energy_ratio = last_work;
                return Ok((trial, convergence));
            }
            if iteration == most {
                return Err(Failure::NoConvergence(most, share));
            }
            let (correction, scales) = self.correction(&trial, &residual, iteration)?;
            let size = |residual: &[f64]| {
                let scaled = residual.iter().zip(&scales).map(|(r, s)| (r * s).powi(2));
                scaled.sum::<f64>().sqrt()
            };
            let before = size(&residual);
            let mut length = 1.0;
            let mut cuts = 0;
            loop {
                let moved: Vec<f64> = (x.iter().zip(&correction))
                    .map(|(x, c)| x + length * c)
                    .collect();
                let attempt = self.trial(&moved);
                match attempt {
                    Ok(attempt) => {
                        let ahead = self.step.residual(&attempt);
                        let open = |(now, then): (&f64, &f64)| *then >= KEPT * now;
                        let pores = trial.pores.iter().zip(&attempt.pores).all(open);
                        let nearer =
                            size(&ahead) < before || self.share(&ahead, &attempt) <= tolerance;
                        if pores && nearer {
                            last_work = (dot(&ahead, &correction)
                                / dot(&residual, &correction).abs().max(f64::MIN_POSITIVE))
                            .abs();
                            (x, trial, residual) = (moved, attempt, ahead);
                            break;
                        }
                        if cuts == MOST_CUTS {
                            return Err(Failure::NoConvergence(iteration, share));
                        }
                    }
                    Err(fault) if cuts == MOST_CUTS => return Err(fault.into()),
                    Err(_) => {}
                }
                length *= 0.5;
                cuts += 1;
            }
            self.work.newton_iterations += 1;
            iteration += 1;
        }
    }

    /// K⁻¹ `residual`, and what scales the matrix.
    fn correction(
        &mut self,
        trial: &Trial<D>,
        residual: &[f64],
        iteration: u32,
    ) -> Result<(Vec<f64>, Vec<f64>), Failure> {
        let step = &self.step;
        let pattern = &step.setting.pattern;
        let (values, scales) = clocked(&mut self.spent.assembly, || {
            let mut values = step.matrix(trial);
            let scales = step.scales(&values);
            for column in 0..pattern.len() {
                for k in pattern.begin[column]..pattern.begin[column + 1] {
                    values[k] *= scales[pattern.row[k]] * scales[column];
                }
            }
            (values, scales)
        });
        self.work.assemblies += 1;
        self.work.factorisations += 1;
        self.work.linear_iterations += 1;
        self.work.nonzeros += pattern.entries() as u64;
        let direct = &mut self.direct;
        clocked(&mut self.spent.factorisation, || direct.factorise(&values))
            .map_err(|_| Failure::Singular(iteration))?;
        let begun = Instant::now();
        let mut x: Vec<f64> = residual.iter().zip(&scales).map(|(r, s)| r * s).collect();
        self.direct.solve(&mut x);
        for (x, s) in x.iter_mut().zip(&scales) {
            *x *= s;
        }
        self.spent.solution += begun.elapsed().as_secs_f64();
        if x.iter().all(|x| x.is_finite()) {
            Ok((x, scales))
        } else {
            Err(Failure::Singular(iteration))
        }
    }
}
