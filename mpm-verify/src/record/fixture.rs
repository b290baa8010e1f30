//! Records and setups of runs that were never made, for tests.

use super::{Failure, Measured, Record, Status};
use crate::parameter::{Parameter, ParameterSet, Parameters};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::setup::Setup;
use crate::spec::{Level, RunSpec};
use crate::verdict::Verdict;

/// A run of standard MPM with GIMP at the case's own parameters.
pub(crate) fn record(level: &str, verdicts: Vec<Verdict>) -> Record {
    let record = serde_json::json!({
        "schema": 2, "case": "cook", "scheme": "gimp-none-flip", "solver": "explicit",
        "level": level, "set": [], "status": "ok", "error": null, "perturbed": false,
        "discretisation": {"dim": 2, "h": 1.0, "ppc": 4, "dt": 0.001, "wall": "open-knot"},
        "parameters": {}, "metrics": {}, "verdicts": verdicts,
        "work": {
            "particles": 1, "nodes": 2, "steps": 3, "particle_steps": 4,
            "particle_node_pairs": 5, "projections": 6, "sorts": 7
        },
        "time": {"wall_s": 1.0, "cpu_s": 1.0},
        "machine": {"os": "linux", "arch": "x86_64", "cores": 2, "threads": 1},
        "version": {"mpm_verify": "0.1.0", "source": "0123456789ab"},
    });
    serde_json::from_value(record).unwrap()
}

/// A run of a case with FLIP, on cells of size `h` (m), with parameters changed and metrics.
pub(crate) fn run(
    parameters: &[Parameter],
    (basis, remedy): (BasisName, RemedyName),
    (level, h): (&str, f64),
    set: &[&str],
    metrics: &[(&str, f64)],
) -> Record {
    let mut record = record(level, Vec::new());
    record.scheme = Scheme::flip(basis, remedy);
    record.discretisation.h = h;
    record.set = changed(set);
    record.parameters = Parameters::new(parameters, &record.set).unwrap();
    record.measure(metrics);
    record
}

impl Record {
    /// Adds metrics without units.
    pub(crate) fn measure(&mut self, metrics: &[(&str, f64)]) {
        self.metrics.extend(metrics.iter().map(|(name, value)| ((*name).to_owned(), Measured::of(*value, "-"))));
    }

    /// Breaks down at a time (s).
    pub(crate) fn break_down(&mut self, kind: &str, time: f64, message: &str) {
        let (kind, message) = (kind.to_owned(), message.to_owned());
        self.status = Status::Failed;
        self.error = Some(Failure { kind, time, step: 1, particle: 0, value: None, message });
    }
}

/// Changed parameters as a run has them.
pub(crate) fn changed(set: &[&str]) -> Vec<String> {
    set.iter().map(|s| (*s).to_owned()).collect()
}

pub(crate) fn spec(scheme: Scheme, level: Level, set: &[&str]) -> RunSpec {
    RunSpec { scheme, level, set: changed(set), perturbed: false }
}

/// The setup of a run of a case with these parameters.
pub(crate) fn setup<P: ParameterSet>(scheme: Scheme, level: Level, set: &[&str]) -> Setup<P> {
    let spec = spec(scheme, level, set);
    let values = Parameters::new(&P::list(), &spec.set).unwrap();
    Setup::of_spec(&spec, &values).unwrap()
}
