//! Where the time of a Newton iteration goes, load step by load step, on one thread: Cook's membrane of 23,072 particles,
//! and the strip on soil full of water of 6,400.

use super::local::{Going, Local};
use super::{Options, Sample, Timed, Turn};
use crate::case::{Case, find_level};
use crate::cases;
use crate::error::Error;
use crate::job::Job;
use crate::parameter::Parameters;
use crate::scheme::{BasisName, RemedyName, Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::Spent;
use std::sync::{Arc, Mutex};

/// What is measured: a problem, its level and a scheme.
pub(super) struct Steps {
    pub(super) case: &'static str,
    level: &'static str,
    pub(super) scheme: Scheme,
}

/// The whole of an iteration; a load step's setting-up is shared out among its own.
pub(super) const WHOLE: &str = "iteration";
/// Picks what a part took (s).
type OfPart = fn(&Spent) -> f64;
/// Its parts.
pub(super) const PARTS: [(&str, OfPart); 4] = [
    ("forces", |s| s.forces),
    ("assembly", |s| s.assembly),
    ("factorisation", |s| s.factorisation),
    ("solution", |s| s.solution),
];

/// What the parts of the last slice took, and its iterations.
type Told = Arc<Mutex<(Spent, u64)>>;

/// A run, a load step a slice, that begins anew after its last one.
struct LoadSteps {
    case: &'static Case,
    spec: RunSpec,
    parameters: Parameters,
    job: Box<dyn Job>,
    told: Told,
}

impl LoadSteps {
    fn begin(steps: &Steps, told: Told) -> Result<Self, Error> {
        let case = cases::find(steps.case)?;
        let spec = RunSpec {
            scheme: steps.scheme,
            level: find_level(case, steps.level)?,
            set: Vec::new(),
            perturbed: false,
        };
        let parameters = Parameters::new(&case.parameters, &spec.set)?;
        let job = (case.begin)(&spec, &parameters)?;
        Ok(Self {
            case,
            spec,
            parameters,
            job,
            told,
        })
    }
}

impl Going for LoadSteps {
    fn go_on(&mut self) -> Result<u64, Error> {
        if self.job.finished() {
            self.job = (self.case.begin)(&self.spec, &self.parameters)?;
        }
        let (before, work) = (self.job.spent(), self.job.work());
        self.job.advance()?;
        let after = self.job.spent();
        let spent = Spent {
            forces: after.forces - before.forces,
            assembly: after.assembly - before.assembly,
            factorisation: after.factorisation - before.factorisation,
            solution: after.solution - before.solution,
        };
        let iterations = self.job.work().newton_iterations - work.newton_iterations;
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
        Ok(Sample {
            updates: told.1,
            wall_s: seconds,
            cpu_s: seconds,
        })
    }
}

impl Steps {
    /// The name under which a part of an iteration is measured.
    pub(super) fn name(&self, part: &str) -> String {
        format!("{} {part}", self.scheme)
    }
}

/// All that is measured.
pub(super) fn all() -> Vec<Steps> {
    let cook = |scheme| Steps {
        case: "cook",
        level: "h0.5",
        scheme,
    };
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    let of = |basis| remedies.map(|remedy| cook(Scheme::quasi_static(basis, remedy)));
    let mut all: Vec<Steps> = [BasisName::Gimp, BasisName::Bspline2]
        .into_iter()
        .flat_map(of)
        .collect();
    all.push(Steps {
        case: "strip",
        level: "b8",
        scheme: Scheme::poro(BasisName::Gimp, SpaceName::TwoGrid),
    });
    all
}

/// Every iteration, and behind it its parts.
pub(super) fn turns(_: &Options) -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    for steps in all() {
        let told = Told::default();
        let local = Local::new(1, || LoadSteps::begin(&steps, told.clone()))?;
        let particles = local.going().job.work().particles;
        let mut add = |part: &str, timed: Box<dyn Timed>| {
            turns.push(Turn {
                group: "newton",
                name: steps.name(part),
                threads: 1,
                particles,
                timed,
                like: None,
            });
        };
        add(WHOLE, Box::new(local));
        for (part, of) in PARTS {
            let told = told.clone();
            add(part, Box::new(Part { told, of }));
        }
    }
    Ok(turns)
}
