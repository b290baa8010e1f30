//! Every check of a single run can fail: over all kept rows, a metric that is moved by twice its tolerance turns it red.

use super::rows::read;
use crate::cases;
use crate::record::Record;
use crate::verdict::{Kind, Outcome, Verdict};
use std::collections::BTreeSet;
use std::path::Path;

/// Values beyond the bound of a verdict by twice its tolerance: above and below the reference, or above and below a bound.
fn beyond(verdict: &Verdict) -> Vec<f64> {
    let Some(tolerance) = verdict.tolerance else {
        return Vec::new();
    };
    let far = |size: f64| 2.0 * size.abs().max(f64::MIN_POSITIVE);
    match verdict.reference {
        Some(reference) => {
            let by = far(tolerance).max(1e-6 * reference.abs());
            vec![reference + by, reference - by]
        }
        None => vec![tolerance + far(tolerance).max(1e-3), tolerance - far(tolerance).max(1e-3)],
    }
}

/// Whether a check is red on a run whose metric has another value: that of the check or, where the check is of a number that
/// follows from the metric, as far from the metric's own as that of the check is from its own.
fn turns_red(record: &Record, verdict: &Verdict, value: f64) -> bool {
    let (Ok(case), Some(own)) = (cases::find(&record.case), record.metrics[&verdict.metric].value) else {
        return false;
    };
    let by = value - verdict.value.unwrap_or(own);
    let same = |v: &Verdict| v.check == verdict.check && v.metric == verdict.metric;
    [value, own + by, own - by].into_iter().any(|moved| {
        let mut record = record.clone();
        if let Some(measured) = record.metrics.get_mut(&verdict.metric) {
            measured.value = Some(moved);
        }
        case.judge(&record).iter().any(|v| same(v) && v.outcome == Outcome::Failed)
    })
}

#[test]
fn every_check_of_a_run_turns_red_beyond_twice_its_tolerance() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../reports/nightly/results.csv");
    let rows = read(&file).unwrap();
    let mut records: Vec<Record> = rows.iter().filter_map(|row| row.record()).collect();
    for record in &mut records {
        record.discretisation.ppc = 4;
    }
    let (mut red, mut green) = (BTreeSet::new(), BTreeSet::new());
    for record in &records {
        let case = cases::find(&record.case).unwrap();
        for verdict in case.judge(record) {
            let name = (record.case.clone(), verdict.check.clone());
            let holds = matches!(verdict.outcome, Outcome::Right | Outcome::WrongAsKnown);
            let of_metric = record.metrics.contains_key(&verdict.metric);
            if !holds || !of_metric || verdict.kind == Kind::Bookkeeping || red.contains(&name) {
                continue;
            }
            let reds = beyond(&verdict).into_iter().any(|value| turns_red(record, &verdict, value));
            if reds {
                green.remove(&name);
                red.insert(name);
            } else {
                green.insert(name);
            }
        }
    }
    assert!(red.len() > 150, "{} checks were tried", red.len());
    assert!(green.is_empty(), "{green:?}");
}
