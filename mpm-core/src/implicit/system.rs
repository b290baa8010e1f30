//! The equations of a step for Newton's method.

use super::algebra::{dot, norm};
use super::average::Average;
use super::equilibrium::{Step, Trial};
use super::failure::Failure;
use super::linear::Linear;
use super::newton::{self, Equations, Point, Solved};
use super::response::Tangent;
use super::settings::Settings;
use super::unknowns::Pattern;
use crate::error::Fault;
use crate::ledger::Ledger;
use crate::monitor::Convergence;
use crate::work::clocked;
use nalgebra::SVector;
use std::time::Instant;

/// Maximum number of iterations of conjugate gradients.
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

/// Equations of a step with the loads at its end, and the means to solve them.
pub(super) struct System<'a, const D: usize> {
    pub(super) step: Step<'a, D>,
    pub(super) settings: &'a Settings,
    /// Norm of the residual (N) that rounding of the stresses leaves.
    pub(super) rounding: f64,
    /// External forces on the nodes (N), and in dynamics what the particles bring along.
    pub(super) external: &'a [SVector<f64, D>],
    pub(super) pattern: &'a Pattern,
    pub(super) linear: Linear<'a>,
    /// Whether to factorise again: always for a direct solution; for a preconditioner once it has become poor.
    pub(super) worn: bool,
    /// Norm of the internal forces at the start (N).
    pub(super) start: f64,
}

impl<const D: usize> Equations for System<'_, D> {
    type Trial = Trial<D>;
    const MOST_CUTS: u32 = 12;

    fn at(&mut self, u: Vec<f64>) -> Result<Point<Trial<D>>, (usize, Fault)> {
        let trial = self.trial(&u)?;
        let (residual, loads) = self.residual(&trial);
        let size = norm(&residual);
        Ok(Point { x: u, trial, residual, share: if loads > 0.0 { size / loads } else { size } })
    }

    fn solved_by(&self, point: &Point<Trial<D>>) -> bool {
        point.share <= self.settings.tolerance || norm(&point.residual) <= self.rounding
    }

    fn correction(&mut self, from: &Point<Trial<D>>, iteration: u32) -> Result<Vec<f64>, Failure> {
        let step = &self.step;
        let spent = &mut self.linear.ledger.spent;
        let tangents = clocked(&mut spent.assembly, || step.tangents(&from.trial));
        if self.worn {
            let pattern = self.pattern;
            let values = clocked(&mut spent.assembly, || step.stiffness(&tangents, pattern));
            self.linear.factorise(&values, iteration)?;
        }
        let begun = Instant::now();
        let found = if step.average.is_some_and(Average::spreads) {
            let enough = 0.1 * self.settings.tolerance / from.share;
            let accuracy = from.share.min(COARSE).max(enough).max(1e-12);
            let before = self.linear.ledger.work.linear_iterations;
            let found = self.conjugate_gradients(&tangents, &from.residual, accuracy);
            self.worn = self.linear.ledger.work.linear_iterations - before > MANY_GRADIENTS;
            found
        } else {
            self.linear.ledger.work.linear_iterations += 1;
            Some(self.linear.direct.displacements::<D>(&from.residual))
        };
        self.linear.ledger.spent.solution += begun.elapsed().as_secs_f64();
        let usable = |x: &Vec<f64>| x.iter().all(|x| x.is_finite());
        found.filter(usable).ok_or(Failure::Singular(iteration))
    }

    fn largest_share(&self, from: &Point<Trial<D>>, correction: &[f64]) -> f64 {
        self.step.open_share(&from.trial.u, correction)
    }

    /// Past the least energy along the line by no more than it was before it, or nearer to equilibrium.
    fn accepts(&self, from: &Point<Trial<D>>, correction: &[f64], ahead: &Point<Trial<D>>) -> bool {
        let slope = |point: &Point<Trial<D>>| dot(correction, &point.residual).abs();
        slope(ahead) <= slope(from) || norm(&ahead.residual) <= norm(&from.residual)
    }

    fn ledger(&mut self) -> &mut Ledger {
        self.linear.ledger
    }
}

impl<const D: usize> System<'_, D> {
    /// A trial of these increments.
    fn trial(&mut self, u: &[f64]) -> Result<Trial<D>, (usize, Fault)> {
        let ledger = &mut *self.linear.ledger;
        // Deformations are gathered, forces scattered.
        ledger.work.particle_node_pairs += 2 * self.step.elements.pairs() as u64;
        let nodes = self.external.len();
        clocked(&mut ledger.spent.forces, || self.step.trial(u, nodes))
    }

    /// F_ext − F_int of a trial at the free unknowns (N), and the norm of the loads: of the external forces, of the
    /// internal ones at the start if there are none or if bodies swing, and of reactions, if greater, where a
    /// constraint moves.
    fn residual(&self, trial: &Trial<D>) -> (Vec<f64>, f64) {
        let inner = trial.internal.iter().zip(&trial.resistance);
        let forces = inner.zip(self.external);
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
        let by_internal = external == 0.0 || self.step.inertia.is_some();
        let loads = if by_internal { external.max(self.start) } else { external };
        (residual, loads.max(held.sqrt()))
    }

    /// The point to begin from, of no increments and the `guess`: the one nearer to equilibrium, both with held
    /// components at their values. Functions that hardly see material can have moved far, and are no guide.
    fn beginning(&mut self, guess: Option<Vec<f64>>) -> Result<Point<Trial<D>>, (usize, Fault)> {
        let rest = vec![0.0; self.step.unknowns.len()];
        let mut begin = |u: Vec<f64>| {
            let held = self.step.unknowns.held.iter().zip(u);
            self.at(held.map(|(held, u)| held.unwrap_or(u)).collect())
        };
        let plain = begin(rest);
        let size = |point: &Point<Trial<D>>| norm(&point.residual);
        match guess.map(begin) {
            Some(Ok(guess)) if plain.as_ref().is_ok_and(|p| size(p) <= size(&guess)) => plain,
            Some(Ok(guess)) => Ok(guess),
            _ => plain,
        }
    }

    /// Solves the step, from the increments `guess` of the unknowns (m) if they are nearer to equilibrium than none.
    pub(super) fn solve(&mut self, guess: Option<Vec<f64>>) -> Result<Solution<D>, Failure> {
        let before = self.trial(&vec![0.0; self.step.unknowns.len()])?;
        self.start = norm(&self.step.free(&before.internal));
        let beginning = self.beginning(guess)?;
        let most = self.settings.most_iterations;
        let Solved { point, last, shares } = newton::solve(self, beginning, most)?;
        let external = self.step.free(self.external);
        let scale = norm(&external).max(f64::MIN_POSITIVE);
        let work = dot(&external, &point.x).abs().max(f64::MIN_POSITIVE);
        Ok(Solution {
            convergence: Convergence {
                residuals: shares,
                force_ratio: norm(&point.residual) / scale,
                force_rounding: self.rounding / scale,
                energy_ratio: dot(&point.residual, &last.0).abs() / work,
                ..Convergence::default()
            },
            u: point.x,
            trial: point.trial,
            before,
        })
    }

    /// Conjugate gradients with the exact stiffness of F̄, preconditioned by the factors of Eq. (13). Where the
    /// stiffness is not positive they stop at what they have.
    fn conjugate_gradients(&mut self, tangents: &[Tangent<D>], right: &[f64], accuracy: f64) -> Option<Vec<f64>> {
        let nodes = self.external.len();
        let mut x = vec![0.0; right.len()];
        let mut rest = right.to_vec();
        let mut direction = self.linear.direct.displacements::<D>(&rest);
        let mut product = dot(&rest, &direction);
        let target = accuracy * norm(right);
        for iteration in 0..MOST_GRADIENTS {
            if norm(&rest) <= target {
                return Some(x);
            }
            self.linear.ledger.work.linear_iterations += 1;
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
            let next = self.linear.direct.displacements::<D>(&rest);
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
