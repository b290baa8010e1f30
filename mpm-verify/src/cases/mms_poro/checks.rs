//! What is checked of the motion. The bounds are derived in `docs/mms-poro.md`.

use super::metrics::{DISPLACEMENT_L2, DISPLACEMENT_SCALE, PRESSURE_L2, PRESSURE_SCALE};
use super::parameters::{RATES, SOURCE, STEPS};
use super::scene::{kappa, modulus};
use crate::accuracy::fit_order;
use crate::cases::manufactured::checks::ladders;
use crate::check::{Check, Finding, judge, run, study};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, Scheme, SpaceName};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// What orders may lack of the theory's, and levels or steps that decide them.
const SLACK: f64 = 0.15;
const DECIDING: usize = 3;
/// Share of (kh)² by which an equation errs at most: that of the stiffness, docs/modes.md.
const DISPERSION: f64 = 0.8;

/// Why linear functions are not judged once particles have moved.
const MOVED: &str =
    "displaced particles shift the quadrature of linear functions, whose gradients jump";

/// Whether particles of a run with linear functions have moved before its last step.
fn has_moved(r: &Record) -> bool {
    r.basis() == BasisName::Linear && r.parameters.number(STEPS) > 1.0
}

/// Least c_v Δt/h² of a run whose water flows: the bound of two grids in docs/poromechanics.md, the largest.
const FLOWS: f64 = 0.75;

/// The order that is claimed of an error, and why; or why none is.
fn claim(metric: Metric, runs: &[&Record]) -> Result<(f64, &'static str), &'static str> {
    if runs.iter().any(|r| has_moved(r)) {
        return Err(MOVED);
    }
    let flows = |r: &&Record| {
        let diffusivity = kappa(&r.parameters) * modulus(&r.parameters);
        diffusivity * r.discretisation.dt / r.discretisation.h.powi(2) >= FLOWS
    };
    if metric != PRESSURE_L2 || runs.iter().all(flows) {
        return Ok((
            2.0,
            "linear fields are reproduced on the cells of either space",
        ));
    }
    match runs[0].scheme() {
        Scheme::Poro(parts) if parts.space == SpaceName::Equal => Err(
            "where hardly any water flows nothing holds pressures that no change of volume sees",
        ),
        _ => Ok((
            1.0,
            "where hardly any water flows p is what gradients of u are",
        )),
    }
}

fn is_of_rates(r: &Record) -> bool {
    r.parameters.is(SOURCE, RATES)
}

/// Size of a pressure cell (m).
fn pressure_cell(r: &Record) -> f64 {
    match r.scheme() {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => 2.0 * r.discretisation.h,
        _ => r.discretisation.h,
    }
}

/// Bounds of the errors of u (m) and of p over its rms.
fn bounds(r: &Record) -> [f64; 2] {
    let (moved, pressed) = (r.metric(DISPLACEMENT_SCALE), r.metric(PRESSURE_SCALE));
    let stiff = modulus(&r.parameters) * PI;
    let of = |h: f64| DISPERSION * (PI * h).powi(2);
    let (solid, water) = (of(r.discretisation.h), of(pressure_cell(r)));
    [
        solid * moved + water * pressed / stiff,
        water + solid * stiff * moved / pressed,
    ]
}

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "error-bound",
            "without an error of time: rms errors of u and p at most what each equation errs by, 0.8 (πh)² of u and 0.8 (πh_p)² of p, and what the other field's error adds through M; left out of linear functions whose particles have moved",
            run(|r| {
                if is_of_rates(r) {
                    return Vec::new();
                }
                let metrics = [DISPLACEMENT_L2, PRESSURE_L2];
                let found = metrics.into_iter().zip(bounds(r)).map(|(metric, bound)| {
                    if has_moved(r) {
                        return Finding::not_applicable(metric, MOVED);
                    }
                    let why =
                        "both equations are of second order, and linear in the other field's error";
                    judge(r, metric).at_most(bound, why)
                });
                found.collect()
            }),
        ),
        Check::truth(
            "order-space",
            "without an error of time, three finest levels: order in h of the rms errors of u and p at least 2 − 0.15; of p where hardly any water flows 1 − 0.15, of equal none; none of linear functions whose particles have moved",
            study(|records| {
                of_ladders(records, |metric, runs| {
                    let about = about(metric, runs);
                    let finest = &runs[runs.len() - DECIDING..];
                    Some(match claim(metric, finest) {
                        Ok((least, why)) => {
                            Finding::above(about, order(runs, metric), least - SLACK, why)
                        }
                        Err(why) => Finding::not_applicable(about, why),
                    })
                })
            }),
        ),
        Check::known_limit(
            "stalls",
            "linear functions whose particles have moved: order of the error of u below 2 − 0.15",
            study(|records| {
                of_ladders(records, |metric, runs| {
                    let stalls = metric == DISPLACEMENT_L2 && has_moved(runs[0]);
                    let order = order(runs, metric);
                    stalls.then(|| Finding::at_most(about(metric, runs), order, 2.0 - SLACK, MOVED))
                })
            }),
        ),
        Check::truth(
            "order-time",
            "source of rates, three finest steps at a level: order in Δt of the rms error of p at least 1 − 0.15",
            study(|records| {
                let mut ladders: BTreeMap<(Scheme, &str), Vec<&Record>> = BTreeMap::new();
                for r in records
                    .iter()
                    .filter(|r| is_of_rates(r) && r.changes_none_but(&[SOURCE.name, STEPS.name]))
                {
                    ladders.entry((r.scheme(), &r.level)).or_default().push(r);
                }
                let found = ladders
                    .into_iter()
                    .filter_map(|((scheme, level), mut runs)| {
                        runs.sort_by(|a, b| b.discretisation.dt.total_cmp(&a.discretisation.dt));
                        let finest = runs.get(runs.len().checked_sub(DECIDING)?..)?;
                        let points = finest
                            .iter()
                            .map(|r| (r.discretisation.dt, r.metric(PRESSURE_L2)));
                        let order =
                            fit_order(&points.collect::<Vec<_>>()).map_or(f64::NAN, |o| o.order);
                        let metric =
                            format!("order in Δt of {} of {scheme} {level}", PRESSURE_L2.name);
                        Some(Finding::above(
                            metric,
                            order,
                            1.0 - SLACK,
                            "backward Euler's rule",
                        ))
                    });
                found.collect()
            }),
        ),
    ]
}

/// Of every ladder of runs without an error of time, and both metrics, what is found.
fn of_ladders(
    records: &[Record],
    found: impl Fn(Metric, &[&Record]) -> Option<Finding>,
) -> Vec<Finding> {
    let ladders = ladders(records).into_iter().map(|(_, runs)| runs);
    let long = ladders.filter(|runs| runs.len() >= DECIDING && !is_of_rates(runs[0]));
    let each = long.flat_map(|runs| {
        let of = |metric| found(metric, &runs);
        [DISPLACEMENT_L2, PRESSURE_L2].map(of)
    });
    each.flatten().collect()
}

/// The order of the three finest.
fn order(runs: &[&Record], metric: Metric) -> f64 {
    let finest = &runs[runs.len() - DECIDING..];
    let points = finest
        .iter()
        .map(|r| (r.discretisation.h, r.metric(metric)));
    fit_order(&points.collect::<Vec<_>>()).map_or(f64::NAN, |o| o.order)
}

fn about(metric: Metric, runs: &[&Record]) -> String {
    let finest = runs[runs.len() - 1];
    let set = finest.set.join(" ");
    let name = metric.name;
    format!(
        "order of {name} of {} to {} {set}",
        finest.scheme(),
        finest.level
    )
    .trim_end()
    .to_owned()
}
