//! What is checked of the half ellipse. The bounds are derived in `docs/conditioning.md`.

use super::metrics::{
    COND_PP, COND_PP_LEAST, COND_UU, COND_UU_LEAST, DEFLECTION_CHANGE, MIRROR_ERROR, SOFTEST_PP,
    SOFTEST_UU,
};
use super::parameters::{GHOST, POSITIONS};
use crate::check::{Check, Finding, judge, run, study};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::BasisName;
use std::collections::BTreeMap;

/// Unknowns of the displacement, at most.
const UNKNOWNS: f64 = 500.0;
/// Rounding of what two runs have in common.
const ROUNDING: f64 = 1e-9;
/// Places from which a spread is told.
const PLACES: f64 = 40.0;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "mirror",
            "condition numbers of a place and of its mirror image agree to rounding: n ε times the condition number",
            run(|r| {
                let condition = 10.0_f64.powf(r.metric(COND_UU));
                let bound = UNKNOWNS * f64::EPSILON * condition;
                let why =
                    "ellipse, particles and both grids are symmetric, and so is the set of places";
                Some(judge(r, MIRROR_ERROR).at_most(bound, why))
            }),
        ),
        Check::truth(
            "no-eigenvalue-falls",
            "the least eigenvalues of displacement and pressure, over all places, do not fall as α grows",
            study(|records| {
                let why = "a penalty is positive semidefinite";
                let of = |metric: Metric| {
                    over_strength(records, metric, |name, [before, after]| {
                        Finding::above(name, after / before, 1.0 - ROUNDING, why)
                    })
                };
                [SOFTEST_UU, SOFTEST_PP].into_iter().flat_map(of).collect()
            }),
        ),
        Check::truth(
            "no-body-bends-more",
            "the cantilever's deflection changes by nothing without a penalty and by less than nothing with one",
            run(|r| {
                let bound = if r.parameters.number(GHOST) > 0.0 {
                    -ROUNDING
                } else {
                    ROUNDING
                };
                let why = "the work of a load falls as stiffness grows";
                Some(judge(r, DEFLECTION_CHANGE).at_most(bound, why))
            }),
        ),
        Check::truth(
            "deflection-falls-with-strength",
            "the cantilever's deflection falls as α grows",
            study(|records| {
                let why = "the work of a load falls as stiffness grows";
                over_strength(records, DEFLECTION_CHANGE, |name, [before, after]| {
                    Finding::at_most(name, after - before, ROUNDING, why)
                })
            }),
        ),
        Check::known_limit(
            "cuts-spoil-matrices",
            "GIMP without penalties, forty places: the displacement's condition number varies by more than a decade",
            run(|r| {
                let here = r.basis() == BasisName::Gimp && r.parameters.number(GHOST) == 0.0;
                let why = "a function that hardly sees the body has hardly a stiffness";
                (here && is_told(r)).then(|| {
                    let varies = r.metric(COND_UU) - r.metric(COND_UU_LEAST);
                    Finding::above("spread of log10_cond_uu", varies, 1.0, why)
                })
            }),
        ),
        Check::regression(
            "flat",
            "α = 0.1, forty places: log10 of the condition numbers varies by at most 0.3 (uu) and 0.4 (pp)",
            run(|r| {
                let here = r.parameters.number(GHOST) == 0.1 && is_told(r);
                let pairs = [(COND_UU, COND_UU_LEAST, 0.3), (COND_PP, COND_PP_LEAST, 0.4)];
                let why = "as observed";
                let of = |(most, least, bound): (Metric, Metric, f64)| {
                    let varies = r.metric(most) - r.metric(least);
                    Finding::at_most(format!("spread of {}", most.name), varies, bound, why)
                };
                let pairs = pairs.into_iter().filter(|_| here);
                pairs.map(of).collect::<Vec<_>>()
            }),
        ),
    ]
}

fn is_told(r: &Record) -> bool {
    r.parameters.number(POSITIONS) >= PLACES
}

/// What is found of a metric at two strengths next to each other, of every scheme and number of places.
fn over_strength(
    records: &[Record],
    metric: Metric,
    found: impl Fn(String, [f64; 2]) -> Finding,
) -> Vec<Finding> {
    let mut ladders: BTreeMap<(String, u64), Vec<(f64, f64)>> = BTreeMap::new();
    let judged = records
        .iter()
        .filter(|r| r.changes_none_but(&[GHOST.name, POSITIONS.name]));
    for r in judged {
        let key = (
            r.scheme().to_string(),
            r.parameters.number(POSITIONS) as u64,
        );
        let point = (r.parameters.number(GHOST), r.metric(metric));
        ladders.entry(key).or_default().push(point);
    }
    let mut all = Vec::new();
    for ((scheme, places), mut points) in ladders {
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in points.windows(2) {
            let name = format!(
                "{} of {scheme} at {places} places, α from {} to {}",
                metric.name, pair[0].0, pair[1].0
            );
            all.push(found(name, [pair[0].1, pair[1].1]));
        }
    }
    all
}
