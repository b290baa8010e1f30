//! A small summary with every outcome, and texts that break what does not escape them.

use crate::night::Night;
use crate::parameter::{Parameter, Parameters};
use crate::record::{Failure, Measured, Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::study::{CaseStudy, Counts, Summary};
use crate::verdict::{Kind, Verdict};

/// Markup, if it is not escaped.
pub(super) const NASTY: &str = "</td><script>\"'&amp;";

/// One run that passes, one with a failed check and changed parameters, one that broke down.
pub(super) fn summary() -> Summary {
    let pass = Verdict::close("at-rest", "at_rest", 1.0, 1.0, 0.0, "");
    let fail = Verdict::at_most("mid-edge", Kind::Truth, "mid_edge_uy", 2.0, 1.0, NASTY);
    let skipped = Verdict::not_applicable("tip", "tip_uy", NASTY);
    let broke = Verdict::close("completes", "run", 0.0, 1.0, 0.0, NASTY).bookkeeping();
    let mut failed = record("h2", vec![pass.clone(), fail]);
    failed.set = vec!["cfl=0.1".to_owned(), NASTY.to_owned()];
    let mut broken = record("h0.5", vec![broke]);
    broken.status = Status::Failed;
    broken.error = Some(Failure {
        kind: "inverted".to_owned(),
        time: 1.0,
        step: 2,
        particle: 3,
        value: None,
        message: NASTY.to_owned(),
    });
    Summary {
        schema: 1,
        tier: NASTY.to_owned(),
        counts: Counts {
            runs: 3,
            broke_down: 1,
            right: 3,
            failed: 1,
            bookkeeping_failed: 1,
            not_judged: 1,
            ..Counts::default()
        },
        cases: vec![CaseStudy {
            verdicts: vec![pass.clone()],
            night: Some(Night {
                date: jiff::civil::date(2026, 1, 2),
                commit: NASTY.to_owned(),
            }),
            ..CaseStudy::new(
                "cook",
                vec![record("h1", vec![pass, skipped]), failed, broken],
            )
        }],
    }
}

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
        let metric = Measured {
            value: Some(*value),
            unit: "-".to_owned(),
        };
        record.metrics.insert((*name).to_owned(), metric);
    }
    record
}

/// The outcomes of a check, in their order.
pub(crate) fn outcomes(verdicts: &[Verdict], check: &str) -> Vec<Option<bool>> {
    let of_check = verdicts.iter().filter(|v| v.check == check);
    of_check.map(|v| v.holds()).collect()
}
