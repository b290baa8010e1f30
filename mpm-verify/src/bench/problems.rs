//! The four problems, each at a level with a few thousand particles or a few ten thousand, so many observations a slice.

use super::local::{Local, Observations};
use super::{Options, Turn, on_threads};
use crate::case::find_level;
use crate::cases;
use crate::error::Error;
use crate::parameter::Parameters;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::RunSpec;

/// Case, level and observations of a slice: of the cheapest scheme a third of a second on two threads, so that noise
/// averages out, and no run ends within the usual rounds.
const PROBLEMS: [(&str, &str, usize); 4] = [
    ("cook", "h0.5", 4),
    ("footing", "b10", 45),
    ("dam-break", "h0.25", 12),
    ("landslide", "slice-h0.4", 4),
];

/// Every problem with each basis and remedy, on each number of threads.
pub(super) fn turns(options: &Options) -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    for (case, level, observations) in PROBLEMS {
        for basis in [BasisName::Gimp, BasisName::Bspline2] {
            for remedy in [
                RemedyName::None,
                RemedyName::FbarRecursive,
                RemedyName::FbarConsistent,
            ] {
                let scheme = Scheme::flip(basis, remedy);
                on_threads(options, &mut turns, |threads| {
                    turn(case, level, observations, scheme, threads)
                })?;
            }
        }
    }
    Ok(turns)
}

fn turn(
    case: &str,
    level: &str,
    observations: usize,
    scheme: Scheme,
    threads: usize,
) -> Result<Turn, Error> {
    let case = cases::find(case)?;
    let spec = RunSpec {
        scheme,
        level: find_level(case, level)?,
        set: Vec::new(),
        perturbed: false,
    };
    let parameters = Parameters::new(&case.parameters, &spec.set)?;
    let local = Local::new(threads, || {
        let job = (case.begin)(&spec, &parameters)?;
        Ok(Observations { job, observations })
    })?;
    let particles = local.going().particles();
    Ok(Turn {
        group: "problem",
        name: format!("{} {level} {scheme}", case.name),
        threads,
        particles,
        timed: Box::new(local),
        like: None,
    })
}
