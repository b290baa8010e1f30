//! The record of a run: stable, versioned, in SI units.

#[cfg(test)]
pub(crate) mod fixture;

use crate::files::Mark;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::spec::{RunSpec, run_folder};
use crate::verdict::{Outcome, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Version of the record's format.
pub const SCHEMA: u32 = 2;
/// Name of the check that a run breaks down as it is known to.
pub const BREAKS_DOWN: &str = "breaks-down";

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// As planned.
    Ok,
    /// It broke down.
    Failed,
}

/// Kind of a step without equilibrium in which the body gives way.
pub(crate) const LIMIT_LOAD: &str = "limit-load";

/// Where and why a run broke down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// Kind of fault, such as `limit-load`.
    pub(crate) kind: String,
    /// Time (s).
    pub(crate) time: f64,
    /// Completed steps.
    pub(crate) step: u64,
    /// Particle, in seeding order.
    pub(crate) particle: u32,
    /// The offending value (null where it is not finite).
    pub(crate) value: Option<f64>,
    /// In words.
    pub(crate) message: String,
}

impl Failure {
    /// The failure that another code reports of its own run.
    pub(crate) fn told(message: String) -> Self {
        Self { kind: "told".to_owned(), time: f64::NAN, step: 0, particle: 0, value: None, message }
    }
}

/// The discretisation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Discretisation {
    /// Dimension.
    pub(crate) dim: usize,
    /// Cell size (m).
    pub(crate) h: f64,
    /// Particles per cell.
    pub(crate) ppc: u32,
    /// Time step (s).
    pub(crate) dt: f64,
    /// How B-splines meet walls.
    pub(crate) wall: String,
}

/// A measured quantity; null where it could not be measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Value.
    pub value: Option<f64>,
    pub(crate) unit: String,
}

impl Measured {
    /// A value with its unit; one that is not finite is missing.
    pub(crate) fn of(value: f64, unit: &str) -> Self {
        Self { value: Some(value).filter(|v| v.is_finite()), unit: unit.to_owned() }
    }
}

/// Exact counts by the names of those of `mpm_core::Work`: what a body has now, what adds up, and what adds up of Newton's
/// method.
macro_rules! counts {
    ($($own:ident),*; $($sum:ident),*; $($newton:ident),*) => {
        /// Exact counts of what was done.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
        #[allow(missing_docs, reason = "the names are those of mpm_core::Work")]
        pub struct WorkDone {
            $(pub $own: u64,)*
            $(pub $sum: u64,)*
            $(#[serde(default)] pub $newton: u64,)*
        }

        impl WorkDone {
            /// The work of a body, this after `earlier`.
            pub(crate) fn after(self, earlier: Self) -> Self {
                Self {
                    $($own: self.$own,)*
                    $($sum: self.$sum + earlier.$sum,)*
                    $($newton: self.$newton + earlier.$newton,)*
                }
            }

            /// The counts by name; those of Newton's method where there are any.
            pub(crate) fn counts(&self) -> Vec<(&'static str, u64)> {
                let of_all = [$((stringify!($own), self.$own),)* $((stringify!($sum), self.$sum),)*];
                let of_newton = [$((stringify!($newton), self.$newton)),*];
                of_all.into_iter().chain(of_newton.into_iter().filter(|_| self.newton_iterations > 0)).collect()
            }
        }

        impl From<mpm_core::Work> for WorkDone {
            fn from(w: mpm_core::Work) -> Self {
                Self { $($own: w.$own,)* $($sum: w.$sum,)* $($newton: w.$newton,)* }
            }
        }
    };
}
counts!(
    particles, nodes;
    steps, particle_steps, particle_node_pairs, projections, sorts;
    newton_iterations, linear_iterations, assemblies, factorisations, analyses, nonzeros
);

/// Time taken, over all pieces of a run that was resumed.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Timing {
    /// By the clock (s).
    pub wall_s: f64,
    /// By the processor, over all threads (s).
    pub cpu_s: f64,
}

/// The machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Operating system.
    pub(crate) os: String,
    /// Architecture.
    pub(crate) arch: String,
    pub(crate) cores: usize,
    /// Threads of the run.
    pub(crate) threads: usize,
}

impl Machine {
    /// This machine, with `threads` threads.
    pub(crate) fn here(threads: usize) -> Self {
        Self {
            os: std::env::consts::OS.to_owned(),
            arch: std::env::consts::ARCH.to_owned(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            threads,
        }
    }
}

/// Version of the program that made a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Version {
    /// Version of this program.
    pub mpm_verify: String,
    /// Fingerprint of the sources that determine the numbers: see `build.rs`.
    pub source: String,
}

impl Version {
    /// Version of this program.
    #[must_use]
    pub fn current() -> Self {
        Self { mpm_verify: env!("CARGO_PKG_VERSION").to_owned(), source: env!("MPM_SOURCE_FINGERPRINT").to_owned() }
    }
}

/// The record of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Version of this format.
    pub(crate) schema: u32,
    /// Case.
    pub case: String,
    /// Scheme.
    pub scheme: Scheme,
    /// Kind of solver.
    pub solver: String,
    pub(crate) level: String,
    /// Parameters changed from their defaults by the plan or the user, as `name=value`.
    pub set: Vec<String>,
    /// Whether it is the perturbed twin of a run.
    pub(crate) perturbed: bool,
    /// How it ended.
    pub(crate) status: Status,
    /// Why it failed.
    pub(crate) error: Option<Failure>,
    pub(crate) discretisation: Discretisation,
    /// All parameters.
    pub parameters: Parameters,
    /// Metrics.
    pub metrics: BTreeMap<String, Measured>,
    /// Verdicts.
    pub verdicts: Vec<Verdict>,
    /// Work.
    pub work: WorkDone,
    /// Time taken.
    pub time: Timing,
    pub(crate) machine: Machine,
    pub(crate) version: Version,
    /// The tables that the run has written, by their names below its folder; of earlier programs none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) files: BTreeMap<String, Mark>,
}

impl Record {
    /// A record without results, of a run by this program on a number of threads.
    pub(crate) fn blank(
        case: &str,
        spec: &RunSpec,
        parameters: &Parameters,
        discretisation: Discretisation,
        threads: usize,
    ) -> Self {
        Self {
            schema: SCHEMA,
            case: case.to_owned(),
            scheme: spec.scheme,
            solver: spec.scheme.solver().to_owned(),
            level: spec.level.name.to_owned(),
            set: spec.set.clone(),
            perturbed: spec.perturbed,
            status: Status::Ok,
            error: None,
            discretisation,
            parameters: parameters.clone(),
            metrics: BTreeMap::new(),
            verdicts: Vec::new(),
            work: WorkDone::default(),
            time: Timing::default(),
            machine: Machine::here(threads),
            version: Version::current(),
            files: BTreeMap::new(),
        }
    }

    /// The scheme.
    #[must_use]
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    pub(crate) fn basis(&self) -> BasisName {
        self.scheme.basis()
    }

    pub(crate) fn remedy(&self) -> RemedyName {
        self.scheme.remedy()
    }

    pub(crate) fn transfer(&self) -> TransferName {
        self.scheme.transfer()
    }

    /// Name of the run, which is also its folder below that of its case.
    #[must_use]
    pub fn folder(&self) -> String {
        run_folder(self.scheme(), &self.level, &self.set)
    }

    /// Whether the run broke down and was not known to.
    pub(crate) fn broke_down(&self) -> bool {
        let known = |v: &Verdict| v.check == BREAKS_DOWN && v.outcome == Outcome::WrongAsKnown;
        self.status == Status::Failed && !self.verdicts.iter().any(known)
    }

    /// A metric's value; NaN if it is missing.
    pub(crate) fn metric(&self, of: Metric) -> f64 {
        self.value(of.name)
    }

    /// The value of a metric named in data; NaN if it is missing.
    #[must_use]
    pub fn value(&self, name: &str) -> f64 {
        self.metrics.get(name).and_then(|m| m.value).unwrap_or(f64::NAN)
    }

    /// Whether the run was of the case's own parameters.
    pub(crate) fn is_default(&self) -> bool {
        self.set.is_empty()
    }

    /// Whether exactly these parameters were changed, as `name=value` apart by spaces.
    pub(crate) fn changes(&self, set: &str) -> bool {
        self.set.join(" ") == set
    }

    /// Whether `name` is the only parameter that was changed.
    pub(crate) fn changes_only(&self, name: &str) -> bool {
        !self.set.is_empty() && self.changes_none_but(&[name])
    }

    /// Whether no other parameters than those of these names were changed.
    pub(crate) fn changes_none_but(&self, names: &[&str]) -> bool {
        self.changed_beside(names).next().is_none()
    }

    /// The assignments that changed other parameters than those of these names.
    pub(crate) fn changed_beside(&self, names: &[&str]) -> impl Iterator<Item = &String> {
        self.set.iter().filter(|set| !set.split('=').next().is_some_and(|name| names.contains(&name)))
    }
}

/// The records of runs at the case's own parameters.
pub(crate) fn of_defaults(records: &[Record]) -> Vec<&Record> {
    records.iter().filter(|r| r.is_default()).collect()
}
