//! Checks over several records.

use super::{is_recursive, m, own_runs, rim};
use crate::check::Finding;
use crate::record::Record;
use std::collections::BTreeMap;

/// Least gain in creep when the time step is halved: √2, less the scatter of the two fits.
const FASTER: f64 = 1.3;
/// Relative difference in displacement that two runs at rest may have: each is within the
/// out-of-balance virtual work of 1e-3 that rest admits.
const REST_NOISE: f64 = 2e-3;

/// How much faster the recursive F̄ creeps with half the time step.
pub(super) fn creep_over_steps(records: &[Record]) -> Vec<Finding> {
    let faster = |slow: &Record| {
        let half = |r: &&Record| r.set == ["cfl=0.15"] && r.scheme() == slow.scheme() && r.level == slow.level;
        let halved = records.iter().find(half)?;
        Some(Finding::above(
            format!("creep_rate of {} {}", slow.scheme(), slow.level),
            halved.metric(m::CREEP_RATE) / slow.metric(m::CREEP_RATE),
            FASTER,
            "the diffusivity of Eq. (26) is ½ s² h²/Δt: twice as fast in the bulk, √2 times where it enters at a boundary",
        ))
    };
    let own = own_runs(records).into_iter();
    own.filter_map(faster).collect()
}

/// The largest ratio of one level's error to that of the level before, for each scheme.
pub(super) fn error_falls(records: &[Record]) -> Vec<Finding> {
    let mut ladders: BTreeMap<_, Vec<&Record>> = BTreeMap::new();
    for record in own_runs(records) {
        if !is_recursive(record) {
            ladders.entry(record.scheme()).or_default().push(record);
        }
    }
    ladders.retain(|_, ladder| ladder.len() >= 2);
    let worst = |(scheme, mut ladder): (_, Vec<&Record>)| {
        ladder.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
        let errors = ladder.iter().map(|r| rim::falling_error(r).abs());
        let errors: Vec<f64> = errors.collect();
        let pairs = errors.windows(2);
        let ratios = pairs.map(|pair| pair[1] / pair[0].max(REST_NOISE));
        // A run that broke down has no error, and must not be lost among the others.
        let worst = if errors.iter().any(|e| e.is_nan()) { f64::NAN } else { ratios.fold(f64::NEG_INFINITY, f64::max) };
        let levels = errors.len();
        Finding::at_most(
            format!("mid-edge error of {scheme} over {levels} levels, largest ratio"),
            worst,
            1.0,
            "a consistent scheme converges; errors below 0.2 % count as that, since rest admits 0.1 % of either run",
        )
    };
    ladders.into_iter().map(worst).collect()
}
