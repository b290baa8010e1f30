//! What is checked of the spaces. The bounds are derived in `docs/undrained.md`.

use super::forms::is_fitted;
use super::metrics::{CHECKERBOARD_RATIO, DISPLACEMENT_ERROR, INF_SUP, PRESSURE_ERROR, ZERO_MODES};
use crate::accuracy::fit_order;
use crate::check::{Check, Finding, judge, run, study};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{Scheme, SpaceName};
use std::collections::BTreeMap;

/// What orders may lack of the theory's, and levels that decide them.
const SLACK: f64 = 0.15;
const DECIDING: usize = 3;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "inf-sup-bounded",
            "two grids, three levels: β falls by no power of h: an order of at most 0.15",
            study(|records| {
                let why = "a stable pair has a bound that no mesh changes";
                orders(records, INF_SUP, SpaceName::TwoGrid, |metric, order| {
                    Finding::at_most(metric, order, SLACK, why)
                })
            }),
        ),
        Check::known_limit(
            "equal-order-is-unstable",
            "equal order on the square, three levels: β falls as h, by an order of at least 1 − 0.15",
            study(|records| {
                let why = "bilinear pressures on the cells of the displacement are not stable";
                let fitted: Vec<Record> = (records.iter())
                    .filter(|r| is_fitted(&r.parameters))
                    .cloned()
                    .collect();
                orders(&fitted, INF_SUP, SpaceName::Equal, |metric, order| {
                    Finding::above(metric, order, 1.0 - SLACK, why)
                })
            }),
        ),
        Check::truth(
            "one-constant",
            "two grids on the square: one pressure has no effect, the constant one",
            run(|r| {
                let here = is_fitted(&r.parameters) && is_of(r.scheme(), SpaceName::TwoGrid);
                let why = "the particles' sums of ∂N/∂x are exact integrals, zero of what is held all around";
                here.then(|| judge(r, ZERO_MODES).within(1.0, 0.0, why))
            }),
        ),
        Check::known_limit(
            "equal-order-has-checkerboards",
            "equal order on the square: more pressures than the constant one have no effect",
            run(|r| {
                let here = is_fitted(&r.parameters) && is_of(r.scheme(), SpaceName::Equal);
                let why = "checkerboards of bilinear functions";
                here.then(|| judge(r, ZERO_MODES).above(1.0, why))
            }),
        ),
        Check::known_limit(
            "equal-order-loses-the-pressure",
            "equal order on the square: the pressure's error is larger than the pressure",
            run(|r| {
                let here = is_fitted(&r.parameters) && is_of(r.scheme(), SpaceName::Equal);
                let why = "pressures of small β answer to hardly any motion";
                here.then(|| judge(r, PRESSURE_ERROR).above(1.0, why))
            }),
        ),
        Check::truth(
            "no-locking",
            "two grids on the square, three levels: order in h of the displacement's error at least 2 − 0.15",
            study(|records| {
                let why = "a stable pair locks no motion: second order in the mean";
                orders(
                    records,
                    DISPLACEMENT_ERROR,
                    SpaceName::TwoGrid,
                    |metric, order| Finding::above(metric, order, 2.0 - SLACK, why),
                )
            }),
        ),
        Check::truth(
            "smooth-pressure",
            "two grids on the square, three levels: order in h of the pressure's error, and of its checkerboard, at least 1 − 0.15",
            study(|records| {
                let why = "a stable pair has the pressure's error of the gradient's, first order";
                let both = [PRESSURE_ERROR, CHECKERBOARD_RATIO];
                let of = |metric| {
                    orders(records, metric, SpaceName::TwoGrid, |metric, order| {
                        Finding::above(metric, order, 1.0 - SLACK, why)
                    })
                };
                both.into_iter().flat_map(of).collect()
            }),
        ),
    ]
}

/// A scheme, and what is changed of its body.
type Body<'a> = (Scheme, &'a [String]);

fn is_of(scheme: Scheme, space: SpaceName) -> bool {
    matches!(scheme, Scheme::Poro(parts) if parts.space == space)
}

/// Of every scheme of a space and every body what is found of the order of a metric over three levels.
fn orders(
    records: &[Record],
    metric: Metric,
    space: SpaceName,
    found: impl Fn(String, f64) -> Finding,
) -> Vec<Finding> {
    let mut ladders: BTreeMap<Body, Vec<(f64, f64)>> = BTreeMap::new();
    let judged = records.iter().filter(|r| is_of(r.scheme(), space));
    for r in judged.filter(|r| metric == INF_SUP || is_fitted(&r.parameters)) {
        let points = ladders.entry((r.scheme(), &r.set)).or_default();
        points.push((r.discretisation.h, r.metric(metric)));
    }
    let of = |((scheme, set), mut points): (Body, Vec<(f64, f64)>)| {
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        let finest = points.get(points.len().checked_sub(DECIDING)?..)?;
        let order = fit_order(finest).map_or(f64::NAN, |o| o.order);
        let name = format!("order of {} of {scheme} {}", metric.name, set.join(" "));
        Some(found(name.trim_end().to_owned(), order))
    };
    ladders.into_iter().filter_map(of).collect()
}
