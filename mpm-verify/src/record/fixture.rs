//! Records of runs that were never made, for tests.

use super::{Measured, Record};
use crate::parameter::{Parameter, Parameters};
use crate::scheme::{BasisName, RemedyName, Scheme};
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
    record.set = set.iter().map(|s| (*s).to_owned()).collect();
    record.parameters = Parameters::new(parameters, &record.set).unwrap();
    for (name, value) in metrics {
        let metric = Measured { value: Some(*value), unit: "-".to_owned() };
        record.metrics.insert((*name).to_owned(), metric);
    }
    record
}
