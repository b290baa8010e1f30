//! The four problems, each at a level with a few thousand particles or a few ten thousand, with a fixed number of observations a slice.

use crate::local::{Going, Local, checksum};
use crate::run::{Begin, Run};
use crate::turn::{Error, Outcome, Turn, on_threads};
use mpm_solvers::scheme::{BasisName, RemedyName, Scheme};

/// Case, level and observations of a slice: of the cheapest scheme a third of a second on two threads, so that noise
/// averages out, and no run ends within the usual rounds.
const PROBLEMS: [(&str, &str, usize); 4] =
    [("cook", "h0.5", 4), ("footing", "b10", 45), ("dam-break", "h0.25", 12), ("landslide", "slice-h0.4", 4)];

/// A run of a case; a slice is a number of times of observation.
struct Observations {
    run: Box<dyn Run>,
    observations: usize,
}

impl Observations {
    fn particles(&self) -> u64 {
        self.run.particles()
    }
}

impl Going for Observations {
    fn go_on(&mut self) -> Result<u64, Error> {
        let before = self.run.particle_steps();
        for _ in 0..self.observations {
            self.run.advance()?;
        }
        Ok(self.run.particle_steps() - before)
    }

    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        Ok(Some(Outcome { bits: Some(checksum(self.run.memory())?), ..Outcome::default() }))
    }
}

/// Every problem with each basis and remedy, on each number of threads.
pub(super) fn turns(threads: &[usize], begin: Begin) -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    for (case, level, observations) in PROBLEMS {
        for basis in [BasisName::Gimp, BasisName::Bspline2] {
            for remedy in [RemedyName::None, RemedyName::FbarRecursive, RemedyName::FbarConsistent] {
                let scheme = Scheme::flip(basis, remedy);
                let name = format!("{case} {level} {scheme}");
                on_threads(threads, &mut turns, |threads| {
                    let local = Local::new(threads, || {
                        let run = begin(case, level, scheme)?;
                        Ok(Observations { run, observations })
                    })?;
                    Ok(Turn {
                        group: "problem",
                        name: name.clone(),
                        threads,
                        particles: local.going().particles(),
                        timed: Box::new(local),
                        like: None,
                    })
                })?;
            }
        }
    }
    Ok(turns)
}
