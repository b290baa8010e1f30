//! The four problems, each at a level with a few thousand particles or a few ten thousand, so many observations a slice.

use crate::local::{Local, Observations};
use crate::{Begin, Error, Options, Turn, on_threads};
use mpm_solvers::scheme::{BasisName, RemedyName, Scheme};

/// Case, level and observations of a slice: of the cheapest scheme a third of a second on two threads, so that noise
/// averages out, and no run ends within the usual rounds.
const PROBLEMS: [(&str, &str, usize); 4] = [
    ("cook", "h0.5", 4),
    ("footing", "b10", 45),
    ("dam-break", "h0.25", 12),
    ("landslide", "slice-h0.4", 4),
];

/// Every problem with each basis and remedy, on each number of threads.
pub(super) fn turns(options: &Options, begin: Begin) -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    for (case, level, observations) in PROBLEMS {
        for basis in [BasisName::Gimp, BasisName::Bspline2] {
            for remedy in [
                RemedyName::None,
                RemedyName::FbarRecursive,
                RemedyName::FbarConsistent,
            ] {
                let scheme = Scheme::flip(basis, remedy);
                let name = format!("{case} {level} {scheme}");
                on_threads(options, &mut turns, |threads| {
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
