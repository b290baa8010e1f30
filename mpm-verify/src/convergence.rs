//! Convergence and work–precision of a case: every quantity of every scheme over the levels.

use crate::case::{Case, Quantity};
use crate::order::{Order, Richardson, extrapolate, fit_order};
use crate::record::{Record, of_own_parameters};
use crate::scheme::Scheme;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A quantity at one level, and what it cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Level.
    pub level: String,
    /// Parameters of the run that differ from the case's own.
    pub set: Vec<String>,
    /// Cell size (m).
    pub h: f64,
    /// The quantity.
    pub value: f64,
    /// Processor time (s).
    pub cpu_s: f64,
    /// Particle–node pairs visited.
    pub particle_node_pairs: u64,
}

/// A quantity of a scheme over the levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// Scheme.
    pub scheme: Scheme,
    /// The metric.
    pub metric: String,
    /// Whether it is an error, whose exact value is zero.
    pub is_error: bool,
    /// Coarsest first.
    pub points: Vec<Point>,
    /// Of an error: the order by least squares.
    pub order: Option<Order>,
    /// Of a value without a reference: Richardson's extrapolation, in the asymptotic range.
    pub extrapolation: Option<Richardson>,
    /// Why there is neither.
    pub remark: Option<String>,
}

/// The convergence of every quantity of `case`, scheme by scheme, over records at its own parameters.
#[must_use]
pub fn convergence(case: &dyn Case, records: &[Record]) -> Vec<Convergence> {
    let mut ladders: BTreeMap<Scheme, Vec<&Record>> = BTreeMap::new();
    for record in of_own_parameters(records) {
        ladders.entry(record.scheme()).or_default().push(record);
    }
    let mut all = Vec::new();
    for quantity in case.quantities() {
        for (scheme, ladder) in &ladders {
            let mut points: Vec<Point> = ladder
                .iter()
                .map(|r| Point {
                    level: r.level.clone(),
                    set: r.set.clone(),
                    h: r.discretisation.h,
                    value: r.metric(quantity.metric),
                    cpu_s: r.time.cpu_s,
                    particle_node_pairs: r.work.particle_node_pairs,
                })
                .filter(|p| p.value.is_finite())
                .collect();
            points.sort_by(|a, b| b.h.total_cmp(&a.h));
            if !points.is_empty() {
                all.push(study(*scheme, *quantity, points));
            }
        }
    }
    all
}

fn study(scheme: Scheme, quantity: Quantity, points: Vec<Point>) -> Convergence {
    let values: Vec<(f64, f64)> = points.iter().map(|p| (p.h, p.value)).collect();
    let (order, extrapolation, remark) = if quantity.is_error {
        let order = fit_order(&values);
        let why = if values.len() < 3 {
            "fewer than three levels"
        } else {
            "the error changes sign or vanishes: no power law"
        };
        let remark = order.is_none().then(|| why.to_owned());
        (order, None, remark)
    } else {
        match extrapolate(&values) {
            Ok(found) => (None, Some(found), None),
            Err(why) => (None, None, Some(why)),
        }
    };
    Convergence {
        scheme,
        metric: quantity.metric.to_owned(),
        is_error: quantity.is_error,
        points,
        order,
        extrapolation,
        remark,
    }
}
