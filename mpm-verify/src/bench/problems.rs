//! The four problems, each at a level with a few thousand particles or a few ten thousand, from one observation to the next.

use super::local::{Local, Observations};
use super::{Options, Turn};
use crate::case::{RunSpec, find_level};
use crate::cases;
use crate::error::Error;
use crate::parameter::Parameters;
use crate::scheme::{BasisName, RemedyName, Scheme};

/// Case and level.
const PROBLEMS: [(&str, &str); 4] = [
    ("cook", "h0.5"),
    ("footing", "b10"),
    ("dam-break", "h0.25"),
    ("landslide", "slice-h0.4"),
];

/// Every problem with each basis and remedy, on each number of threads.
pub(super) fn turns(options: &Options) -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    for (case, level) in PROBLEMS {
        for basis in [BasisName::Gimp, BasisName::Bspline2] {
            for remedy in [
                RemedyName::None,
                RemedyName::FbarRecursive,
                RemedyName::FbarConsistent,
            ] {
                let first = turns.len();
                for &threads in &options.threads {
                    let like = (turns.len() > first).then_some(first);
                    turns.push(turn(
                        case,
                        level,
                        Scheme::flip(basis, remedy),
                        threads,
                        like,
                    )?);
                }
            }
        }
    }
    Ok(turns)
}

fn turn(
    case: &str,
    level: &str,
    scheme: Scheme,
    threads: usize,
    like: Option<usize>,
) -> Result<Turn, Error> {
    let case = cases::find(case)?;
    let spec = RunSpec {
        scheme,
        level: find_level(case, level)?,
        set: Vec::new(),
        perturbed: false,
    };
    let parameters = Parameters::new(case.parameters(), &spec.set)?;
    let local = Local::new(threads, || {
        Ok(Observations(case.start(&spec, &parameters)?))
    })?;
    let particles = local.going().particles();
    Ok(Turn {
        group: "problem",
        name: format!("{} {level} {scheme}", case.name()),
        threads,
        particles,
        timed: Box::new(local),
        like,
    })
}
