//! Newton's method with a line search, for the equations of any solver.

use super::failure::Failure;
use crate::error::{Error, Fault, require};
use crate::ledger::Ledger;

/// Checks a tolerance of Newton's method: below the least one rounding decides.
pub(crate) fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    let allowed = (1e-13..=1e-2).contains(&tolerance);
    require(allowed, "tolerance of Newton's method", tolerance, "from 1e-13 to 1e-2")
}

/// Values of the unknowns, and what the equations make of them.
pub(crate) struct Point<T> {
    /// Values of the unknowns.
    pub(crate) x: Vec<f64>,
    /// State of the body.
    pub(crate) trial: T,
    /// Residual: the right-hand side of the next correction.
    pub(crate) residual: Vec<f64>,
    /// Norm of the residual over that of the loads.
    pub(crate) share: f64,
}

/// Equations of a step.
pub(crate) trait Equations {
    /// State of the body at some values of the unknowns.
    type Trial;
    /// Maximum number of halvings in the line search.
    const MOST_CUTS: u32;

    /// Evaluates the equations.
    ///
    /// # Errors
    /// The first particle that cannot take these values.
    fn at(&mut self, x: Vec<f64>) -> Result<Point<Self::Trial>, (usize, Fault)>;

    /// Whether a point solves the equations.
    fn solved_by(&self, point: &Point<Self::Trial>) -> bool;

    /// Correction of the unknowns, K⁻¹ times the residual.
    fn correction(&mut self, from: &Point<Self::Trial>, iteration: u32) -> Result<Vec<f64>, Failure>;

    /// Largest share of a correction to try.
    fn largest_share(&self, from: &Point<Self::Trial>, correction: &[f64]) -> f64;

    /// Whether the line search ends at the point `ahead`.
    fn accepts(&self, from: &Point<Self::Trial>, correction: &[f64], ahead: &Point<Self::Trial>) -> bool;

    /// Ledger of the run.
    fn ledger(&mut self) -> &mut Ledger;
}

/// Solution of the equations.
pub(crate) struct Solved<T> {
    pub(crate) point: Point<T>,
    /// Last correction, and the residual before it; zero and empty without one.
    pub(crate) last: (Vec<f64>, Vec<f64>),
    /// Shares of the residual, at the start and after every iteration.
    pub(crate) shares: Vec<f64>,
}

/// Solves `equations` from a point on.
///
/// # Errors
/// No solution after `most_iterations`, or none along a correction; a singular matrix.
pub(crate) fn solve<E: Equations>(
    equations: &mut E,
    mut point: Point<E::Trial>,
    most_iterations: u32,
) -> Result<Solved<E::Trial>, Failure> {
    let mut last = (vec![0.0; point.x.len()], Vec::new());
    let mut shares = Vec::new();
    for iteration in 0.. {
        let share = point.share;
        shares.push(share);
        if equations.solved_by(&point) {
            break;
        }
        if iteration == most_iterations {
            return Err(Failure::NoConvergence(iteration, share));
        }
        let correction = equations.correction(&point, iteration)?;
        let mut length = equations.largest_share(&point, &correction);
        let mut cuts = 0;
        let ahead = loop {
            let pairs = point.x.iter().zip(&correction);
            match equations.at(pairs.map(|(x, c)| x + length * c).collect()) {
                Ok(ahead) if equations.accepts(&point, &correction, &ahead) => break ahead,
                Ok(_) if cuts == E::MOST_CUTS => {
                    return Err(Failure::NoConvergence(iteration, share));
                }
                Err(fault) if cuts == E::MOST_CUTS => return Err(fault.into()),
                _ => {}
            }
            length *= 0.5;
            cuts += 1;
        };
        last = (correction, std::mem::replace(&mut point, ahead).residual);
        equations.ledger().work.newton_iterations += 1;
    }
    Ok(Solved { point, last, shares })
}
