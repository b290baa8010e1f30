//! Failure of a step, and its division into parts that succeed.

use crate::error::{Cause, Error, Fault};
use crate::ledger::Ledger;

/// Why a step has no solution.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Failure {
    /// Iterations done, and the residual over that of the loads after them.
    NoConvergence(u32, f64),
    /// The matrix of this iteration could not be factorised.
    Singular(u32),
    /// A particle was deformed beyond the range of its law.
    Particle(usize, Fault),
    /// Only a part of what acts from outside is carried by the body: name, part and whole.
    Lost(&'static str, f64, f64),
}

impl Failure {
    /// Error of the present step of a run, whose particles have the identities `ids`.
    pub(crate) fn error(self, ledger: &Ledger, ids: &[u32], cause: Cause) -> Error {
        let (time, step) = (ledger.time, ledger.work.steps);
        match self {
            Self::NoConvergence(iteration, residual) => Error::NoConvergence { time, step, iteration, residual, cause },
            Self::Singular(iteration) => Error::Singular { time, step, iteration, cause },
            Self::Particle(index, fault) => ledger.breakdown(ids, index, fault),
            Self::Lost(what, value, whole) => Error::Lost { time, step, what, value, whole },
        }
    }
}

impl From<(usize, Fault)> for Failure {
    fn from((particle, fault): (usize, Fault)) -> Self {
        Self::Particle(particle, fault)
    }
}

/// Performs a step in parts; `part` takes the completed share and the share to do. A part that fails is halved, up to
/// `most_halvings` times; one after a success is twice as long. Returns the number of parts.
pub(crate) fn in_parts(
    most_halvings: u32,
    mut part: impl FnMut(f64, f64) -> Result<(), Failure>,
) -> Result<u32, Failure> {
    let shortest = 0.5_f64.powi(most_halvings as i32);
    let (mut done, mut size, mut parts) = (0.0, 1.0, 0);
    while done < 1.0 {
        match part(done, size) {
            Ok(()) => {
                done += size;
                parts += 1;
                size = (2.0 * size).min(1.0 - done);
            }
            Err(failure) if size <= shortest => return Err(failure),
            Err(_) => size *= 0.5,
        }
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts that fail as often as told, and the shares of a step that are done.
    fn parts(most_halvings: u32, fails: impl Fn(f64, f64) -> bool) -> (Option<u32>, Vec<[f64; 2]>) {
        let mut made = Vec::new();
        let count = in_parts(most_halvings, |done, size| {
            if fails(done, size) {
                return Err(Failure::Singular(0));
            }
            made.push([done, size]);
            Ok(())
        });
        (count.ok(), made)
    }

    #[test]
    fn parts_are_halved_and_doubled_and_make_up_the_step() {
        assert_eq!(parts(3, |_, _| false), (Some(1), vec![[0.0, 1.0]]));
        // Hard at the start alone: the last part ends with the step.
        let (count, made) = parts(3, |done, size| done == 0.0 && size > 0.125);
        let expected = [[0.0, 0.125], [0.125, 0.25], [0.375, 0.5], [0.875, 0.125]];
        assert_eq!((count, made), (Some(4), expected.to_vec()));
        // One halving less than is needed, and as many.
        let hard = |_, size: f64| size > 0.125;
        assert_eq!(parts(2, hard), (None, Vec::new()));
        assert_eq!(parts(3, hard).0, Some(8));
    }
}
