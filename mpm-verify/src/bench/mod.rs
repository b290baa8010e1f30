//! Speed: what `mpm-bench` measures, with cases as its problems; its tables and pictures.

mod summary;

pub use mpm_bench::{GROUPS, Options, Peers};

use crate::case::find_level;
use crate::cases;
use crate::error::Error;
use crate::files::{make_folder, write_dense_json};
use crate::job::Job;
use crate::parameter::Parameters;
use crate::record::{Machine, Version};
use crate::scheme::Scheme;
use crate::spec::RunSpec;
use mpm_bench::{Measurements, Run};
use mpm_core::{Memory, Spent};
use serde::Serialize;
use std::path::Path;

/// Version of `bench.json`.
const SCHEMA: u32 = 1;

/// The content of `bench.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Bench {
    schema: u32,
    machine: Machine,
    /// Its processor, where the system tells.
    processor: Option<String>,
    version: Version,
    measured: Measurements,
}

/// Measures what the options ask for, writes `bench.json`, the tables and the pictures into `out` and returns the
/// tables. `progress` gets the share that is done.
///
/// # Errors
/// A scene breaks down, a peer can't be started, or a file can't be written.
pub fn measure(options: &Options, out: &Path, progress: &dyn Fn(f64)) -> Result<String, Error> {
    make_folder(out)?;
    let measured = mpm_bench::measure(options, begin, progress);
    let bench = Bench {
        schema: SCHEMA,
        machine: Machine::here(options.threads.iter().copied().max().unwrap_or(1)),
        processor: mpm_bench::processor(),
        version: Version::current(),
        measured: measured.map_err(|e| Error::Input(e.to_string()))?,
    };
    write_dense_json(&out.join("bench.json"), &bench)?;
    summary::write(&bench, out)
}

/// A run of a case with its own parameters.
fn begin(case: &str, level: &str, scheme: Scheme) -> Result<Box<dyn Run>, mpm_bench::Error> {
    let case = cases::find(case)?;
    let spec = RunSpec { scheme, level: find_level(case, level)?, set: Vec::new(), perturbed: false };
    Ok(Box::new(CaseRun((case.begin)(&spec, &Parameters::new(&case.parameters, &spec.set)?)?)))
}

struct CaseRun(Box<dyn Job>);

impl Run for CaseRun {
    fn advance(&mut self) -> Result<(), mpm_bench::Error> {
        self.0.advance()?;
        Ok(())
    }

    fn finished(&self) -> bool {
        self.0.finished()
    }

    fn particles(&self) -> u64 {
        self.0.work().particles
    }

    fn particle_steps(&self) -> u64 {
        self.0.work().particle_steps
    }

    fn newton_iterations(&self) -> u64 {
        self.0.work().newton_iterations
    }

    fn spent(&self) -> Spent {
        self.0.spent()
    }

    fn memory(&self) -> &dyn Memory {
        self.0.as_ref()
    }
}
