//! The equations of a step, for displacements and pressures at once, for Newton's method.

use super::step::{Step, Trial};
use crate::error::Fault;
use crate::implicit::algebra::{dot, norm};
use crate::implicit::failure::Failure;
use crate::implicit::linear::Linear;
use crate::implicit::newton::{self, Equations, Point};
use crate::ledger::Ledger;
use crate::monitor::Convergence;
use crate::work::clocked;
use std::time::Instant;

/// Minimum share of its pores that a particle keeps in one correction.
const KEPT: f64 = 0.1;

/// Equations of a step, and the means to solve them.
pub(super) struct System<'a, const D: usize> {
    pub(super) step: Step<'a, D>,
    /// Norm of the out-of-balance forces (N) that rounding leaves.
    pub(super) rounding: f64,
    pub(super) linear: Linear<'a>,
    /// Factors by which the last matrix was scaled.
    pub(super) scales: Vec<f64>,
}

impl<const D: usize> Equations for System<'_, D> {
    type Trial = Trial<D>;
    const MOST_CUTS: u32 = 16;

    fn at(&mut self, x: Vec<f64>) -> Result<Point<Trial<D>>, (usize, Fault)> {
        let (setting, ledger) = (self.step.setting, &mut *self.linear.ledger);
        // Deformations and pressures are gathered, forces and volumes scattered.
        ledger.work.particle_node_pairs += 2 * (setting.solid.pairs() + setting.water.pairs()) as u64;
        let trial = clocked(&mut ledger.spent.forces, || self.step.trial(&x))?;
        let residual = self.step.residual(&trial);
        Ok(Point { share: self.share(&residual, &trial), x, trial, residual })
    }

    fn solved_by(&self, point: &Point<Trial<D>>) -> bool {
        point.share <= self.step.settings.tolerance
    }

    fn correction(&mut self, from: &Point<Trial<D>>, iteration: u32) -> Result<Vec<f64>, Failure> {
        let step = &self.step;
        let pattern = &step.setting.pattern;
        let (values, scales) = clocked(&mut self.linear.ledger.spent.assembly, || {
            let mut values = step.matrix(&from.trial);
            let scales = step.scales(&values);
            for column in 0..pattern.len() {
                for k in pattern.begin[column]..pattern.begin[column + 1] {
                    values[k] *= scales[pattern.row[k]] * scales[column];
                }
            }
            (values, scales)
        });
        self.linear.ledger.work.linear_iterations += 1;
        self.linear.factorise(&values, iteration)?;
        let begun = Instant::now();
        let scaled = from.residual.iter().zip(&scales);
        let mut x: Vec<f64> = scaled.map(|(r, s)| r * s).collect();
        self.linear.direct.solve(&mut x);
        for (x, s) in x.iter_mut().zip(&scales) {
            *x *= s;
        }
        self.scales = scales;
        self.linear.ledger.spent.solution += begun.elapsed().as_secs_f64();
        if x.iter().all(|x| x.is_finite()) { Ok(x) } else { Err(Failure::Singular(iteration)) }
    }

    fn largest_share(&self, _from: &Point<Trial<D>>, _correction: &[f64]) -> f64 {
        1.0
    }

    /// Nearer to the solution in the norm of the scaled equations, without closing the pores of a particle.
    fn accepts(&self, from: &Point<Trial<D>>, _correction: &[f64], ahead: &Point<Trial<D>>) -> bool {
        let size = |point: &Point<Trial<D>>| {
            let scaled = point.residual.iter().zip(&self.scales);
            scaled.map(|(r, s)| (r * s).powi(2)).sum::<f64>().sqrt()
        };
        let open = |(now, then): (&f64, &f64)| *then >= KEPT * now;
        let pores = from.trial.pores.iter().zip(&ahead.trial.pores);
        pores.into_iter().all(open) && (size(ahead) < size(from) || self.solved_by(ahead))
    }

    fn ledger(&mut self) -> &mut Ledger {
        self.linear.ledger
    }
}

impl<const D: usize> System<'_, D> {
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
    pub(super) fn solve(&mut self, x: Vec<f64>) -> Result<(Trial<D>, Convergence), Failure> {
        let beginning = self.at(x)?;
        let most = self.step.settings.most_iterations;
        let solved = newton::solve(self, beginning, most)?;
        let (point, (correction, before)) = (solved.point, solved.last);
        let then = dot(&before, &correction).abs().max(f64::MIN_POSITIVE);
        let convergence = Convergence {
            residuals: solved.shares,
            force_ratio: point.share,
            energy_ratio: (dot(&point.residual, &correction) / then).abs(),
            ..Convergence::default()
        };
        Ok((point.trial, convergence))
    }
}
