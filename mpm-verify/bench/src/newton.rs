//! Where the time of a Newton iteration goes, load step by load step, on one thread: Cook's membrane of 23,072 particles,
//! and the strip on soil full of water of 6,400.

use crate::local::{Going, Local};
use crate::measured::Sample;
use crate::run::{Begin, Run};
use crate::turn::{Error, Timed, Turn};
use mpm_core::Spent;
use mpm_solvers::scheme::{BasisName, RemedyName, Scheme, SpaceName};
use std::sync::{Arc, Mutex};

/// Load steps of a case.
pub struct Steps {
    /// The case.
    pub case: &'static str,
    level: &'static str,
    /// The scheme.
    pub scheme: Scheme,
}

/// The whole of an iteration; a load step's setting-up is shared out among its own.
pub const WHOLE: &str = "iteration";
/// Time of a part (s).
pub type OfPart = fn(&Spent) -> f64;
/// Its parts.
pub const PARTS: [(&str, OfPart); 4] = [
    ("forces", |s| s.forces),
    ("assembly", |s| s.assembly),
    ("factorisation", |s| s.factorisation),
    ("solution", |s| s.solution),
];

/// Times of the parts of the last slice, and its iterations.
type Told = Arc<Mutex<(Spent, u64)>>;

/// A run, a load step a slice, that begins anew after its last one.
struct LoadSteps<B> {
    begin: B,
    run: Box<dyn Run>,
    told: Told,
}

impl<B: Fn() -> Result<Box<dyn Run>, Error> + Send> Going for LoadSteps<B> {
    fn go_on(&mut self) -> Result<u64, Error> {
        if self.run.finished() {
            self.run = (self.begin)()?;
        }
        let (before, done) = (self.run.spent(), self.run.newton_iterations());
        self.run.advance()?;
        let after = self.run.spent();
        let spent = Spent {
            forces: after.forces - before.forces,
            assembly: after.assembly - before.assembly,
            factorisation: after.factorisation - before.factorisation,
            solution: after.solution - before.solution,
        };
        let iterations = self.run.newton_iterations() - done;
        if let Ok(mut told) = self.told.lock() {
            *told = (spent, iterations);
        }
        Ok(iterations)
    }
}

/// A part of the slice that was run just before.
struct Part {
    told: Told,
    of: OfPart,
}

impl Timed for Part {
    fn slice(&mut self) -> Result<Sample, Error> {
        let told = self.told.lock().map(|told| *told).unwrap_or_default();
        let seconds = (self.of)(&told.0);
        Ok(Sample { updates: told.1, wall_s: seconds, cpu_s: seconds })
    }
}

impl Steps {
    /// The name under which a part of an iteration is measured.
    #[must_use]
    pub fn name(&self, part: &str) -> String {
        format!("{} {part}", self.scheme)
    }
}

/// All that is measured.
#[must_use]
pub fn all() -> Vec<Steps> {
    let cook = |scheme| Steps { case: "cook", level: "h0.5", scheme };
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    let of = |basis| remedies.map(|remedy| cook(Scheme::quasi_static(basis, remedy)));
    let mut all: Vec<Steps> = [BasisName::Gimp, BasisName::Bspline2].into_iter().flat_map(of).collect();
    all.push(Steps { case: "strip", level: "b8", scheme: Scheme::poro(BasisName::Gimp, SpaceName::TwoGrid) });
    all
}

/// Every iteration, and behind it its parts.
pub(crate) fn turns(begin: Begin) -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    for steps in all() {
        let told = Told::default();
        let (case, level, scheme) = (steps.case, steps.level, steps.scheme);
        let local = Local::new(1, || {
            let again = move || begin(case, level, scheme);
            Ok(LoadSteps { run: again()?, begin: again, told: told.clone() })
        })?;
        let particles = local.going().run.particles();
        let mut add = |part: &str, timed: Box<dyn Timed>| {
            turns.push(Turn { group: "newton", name: steps.name(part), threads: 1, particles, timed, like: None });
        };
        add(WHOLE, Box::new(local));
        for (part, of) in PARTS {
            let told = told.clone();
            add(part, Box::new(Part { told, of }));
        }
    }
    Ok(turns)
}
