//! Checks over several records.

use super::{WIDTH, effective_width, is_elastic, is_free_of_locking, m};
use crate::accuracy::fit_order;
use crate::cases::footing::parameters::{CONTACT, PENETRATION, PENETRATION_RATE};
use crate::check::{Finding, judge};
use crate::record::Record;
use crate::scheme::RemedyName;

/// Largest relative change of the limit load when the rate is halved.
const RATE: f64 = 0.005;
/// The order of the contact pressure's error: of its leading part, the width of the footing, less how the
/// elements' own error lowers it.
const ORDER: (f64, f64) = (0.85, 1.1);

/// The same run at half the rate.
fn halved<'a>(records: &'a [Record], run: &Record) -> Option<&'a Record> {
    let rate = |r: &Record| r.parameters.number(PENETRATION_RATE);
    records.iter().find(|r| {
        let others = |r: &Record| {
            let mut set = r.set.clone();
            set.retain(|s| !s.starts_with("penetration_rate="));
            set
        };
        r.scheme() == run.scheme()
            && r.level == run.level
            && others(r) == others(run)
            && (rate(r) / rate(run) - 0.5).abs() < 1e-9
    })
}

/// What halving the rate does to the limit load of a remedy: relative change, and what was run. Faster runs than the
/// case's own ring: they are there to show it.
fn rates(
    records: &[Record],
    remedy: RemedyName,
    found: impl Fn(f64, String) -> Finding,
) -> Vec<Finding> {
    let own = |r: &&Record| r.is_default() && r.remedy() == remedy && !is_elastic(r);
    let change = |run: &Record| {
        let slower = halved(records, run)?;
        let change = (slower.metric(m::NC_B) / run.metric(m::NC_B) - 1.0).abs();
        let rate = run.parameters.number(PENETRATION_RATE);
        let (scheme, level) = (run.scheme(), &run.level);
        let what = format!("{scheme} {level} from {rate} m/s to half of it");
        Some(found(change, what))
    };
    records.iter().filter(own).filter_map(change).collect()
}

pub(super) fn rate_independence(records: &[Record]) -> Vec<Finding> {
    rates(records, RemedyName::FbarConsistent, |change, what| {
        let why = format!("a rate-independent law, pressed slowly: {what}");
        Finding::at_most(m::NC_B, change, RATE, why)
    })
}

pub(super) fn rate_dependence(records: &[Record]) -> Vec<Finding> {
    rates(records, RemedyName::FbarRecursive, |change, what| {
        let why = format!("Eq. (26) averages the average and so diffuses J̄ in time: {what}");
        Finding::above(m::NC_B, change, RATE, why)
    })
}

/// What the barrier changes against held nodes.
pub(super) fn contacts(records: &[Record]) -> Vec<Finding> {
    let found = |run: &Record| {
        let same =
            |r: &&Record| r.is_default() && r.scheme() == run.scheme() && r.level == run.level;
        let held = records.iter().find(same)?.metric(m::NC_B);
        let (scheme, level) = (run.scheme(), &run.level);
        Some(judge(run, m::NC_B).within(held, 2.0 * run.discretisation.h / WIDTH * held, format!(
                "{scheme} {level}: a barrier on particles and held nodes; the edges of either are known to half a cell"
            )))
    };
    let through_barrier = records.iter().filter(|r| r.changes_only(CONTACT.name));
    through_barrier.filter_map(found).collect()
}

/// The order of the contact pressure's error by B, over runs of the case's own parameters; when they end changes nothing.
pub(super) fn orders(records: &[Record]) -> Vec<Finding> {
    let mut found = Vec::new();
    for scheme in crate::distinct(records.iter().map(Record::scheme)) {
        let mut points: Vec<(f64, f64)> = records
            .iter()
            .filter(|r| r.scheme() == scheme && is_free_of_locking(r))
            .filter(|r| r.is_default() || r.changes_only(PENETRATION.name))
            .filter(|r| effective_width(r.basis(), r.discretisation.h).0 > WIDTH)
            .map(|r| (r.discretisation.h, r.metric(m::PRANDTL_ERROR)))
            .collect();
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        if points.len() < 3 {
            continue;
        }
        let (least, most) = ORDER;
        found.push(Finding::within(
            m::PRANDTL_ERROR,
            fit_order(&points).map_or(f64::NAN, |o| o.order),
            0.5 * (least + most),
            0.5 * (most - least),
            format!("{scheme}: the error is the footing's excess width h/B, to first order"),
        ));
    }
    found
}
