//! What is checked of the column. Tolerances are derived in `docs/consolidation.md`.

use super::errors::of_steps;
use super::metrics::{
    BASE_PRESSURE_ERROR, BASE_PRESSURE_ERROR_STEPS, MASS_ERROR, RATE_LOSS, SETTLEMENT_EARLY,
    SETTLEMENT_END, SETTLEMENT_ERROR, SETTLEMENT_ERROR_STEPS, VOLUME_STEP,
};
use super::parameters::{
    GHOST_DISPLACEMENT, GHOST_PRESSURE, LOAD, LOGARITHMIC, REFINE, TOLERANCE, VOLUME_RATE,
};
use super::reference::{layer, solution};
use super::scene::{HEIGHT, count};
use super::watch::ROUNDING;
use crate::accuracy::fit_order;
use crate::check::{Check, Finding, judge, run, study};
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, Scheme, SpaceName};
use std::collections::BTreeMap;

/// The order in h that theory gives.
const THEORY: f64 = 2.0;
/// What orders may lack of the theory's, one-sided as every order of this bench that a theory gives; and levels or steps
/// that decide them.
const SLACK: f64 = 0.15;
const DECIDING: usize = 3;
/// Cells of the pressure in the layer at the drained top from which on an order is asymptotic.
const RESOLVING: f64 = 2.0;
/// Roache's factors of safety, of three levels that show the order, and of two (doi:10.1115/1.2910291).
const SAFE: [f64; 2] = [1.25, 3.0];
/// The load at which no particle crosses a cell.
const SMALL: f64 = 0.003;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "water",
            "exact rate: volume and outflow change together but for what Newton's method and rounding of J̃ leave",
            run(|r| {
                let why = "the equations of all nodes add up to the balance of the column";
                (!is_logarithmic(r)).then(|| judge(r, MASS_ERROR).at_most(left(r), why))
            }),
        ),
        Check::known_limit(
            "logarithm-loses-water",
            "logarithmic rate: every step makes ½ V (J̃ − 1)² of water, to within the next term of the series",
            run(|r| {
                let why = "V (J̃ ln J̃ − J̃ + 1), docs/poromechanics.md; |J̃ − 1|/3 of it and more is the next term";
                let (loss, change) = (r.metric(RATE_LOSS), r.metric(VOLUME_STEP));
                let next = loss * change / (1.0 - change) / 3.0;
                is_logarithmic(r).then(|| judge(r, MASS_ERROR).within(loss, next + left(r), why))
            }),
        ),
        Check::truth(
            "settlement",
            "without ghost penalties: the settlement at the tabulated T from 0.1 on is that of the exact solution within h/H, a column of a cell more or less, and what the steps are off by",
            run(|r| [against_exact(r, SETTLEMENT_ERROR, 0)]),
        ),
        Check::truth(
            "base-pressure",
            "likewise: the pressure at the base over the load, as 2 T |dp/dT| is at most 8/(π e) = 0.94",
            run(|r| [against_exact(r, BASE_PRESSURE_ERROR, 1)]),
        ),
        Check::truth(
            "order-space",
            "GIMP, finest three levels where two cells of the pressure and more are in the layer at the top: order in h of settlement and base pressure at least 2 − 0.15",
            study(orders),
        ),
        Check::truth(
            "richardson",
            "GIMP: the settlement at T = 0.1 of the finest level is within the grid convergence index of the exact solution in space of the same steps",
            study(richardson),
        ),
        Check::truth(
            "order-time",
            "order in the number of steps of the settlement at T = 2, of three refinements each twice the one before, at least 1 − 0.15",
            study(order_in_time),
        ),
        Check::truth(
            "small-load",
            "0.003 M₀, where no particle crosses a cell: linear functions and GIMP of the same run differ by no more than 2 q/M₀: what domains see of the next cell",
            study(functions_agree),
        ),
    ]
}

fn is_logarithmic(r: &Record) -> bool {
    r.parameters.is(VOLUME_RATE, LOGARITHMIC)
}

/// An error against the exact solution. On cells of h it is not known to less than h where the column ends: T = c_v t/H²
/// then changes by 2 h/H, a settlement over H by h/H at most. Backward Euler's own error is known where its steps are.
fn against_exact(r: &Record, metric: Metric, which: usize) -> Finding {
    if solution(r.parameters.number(LOAD), None).is_empty() {
        return Finding::not_applicable(metric, "no reference of this load");
    }
    if [GHOST_DISPLACEMENT, GHOST_PRESSURE]
        .iter()
        .any(|p| r.parameters.number(*p) > 0.0)
    {
        let why = "ghost penalties are there to show what they cost";
        return Finding::not_applicable(metric, why);
    }
    let bound = r.discretisation.h / HEIGHT + of_steps(&r.parameters)[which];
    let why =
        "exact solution; a column that is a cell longer or shorter, and backward Euler's steps";
    judge(r, metric).at_most(bound, why)
}

/// What Newton's method and rounding leave of the balance, over the outflow. A node balances at most three times what
/// leaves in a step (the fluxes of its two cells, and what they store), so that the norm over n + 1 nodes is at most
/// 3 √(n + 1) of it, and their sum √(n + 1) times the norm of what is left.
fn left(r: &Record) -> f64 {
    let nodes = HEIGHT / r.discretisation.h + 1.0;
    // The last bits of J̃ in every step, over all that has left. What is measured is never less than its floor.
    let rounding = 8.0 * f64::EPSILON * count(&r.parameters) / r.metric(SETTLEMENT_END);
    (3.0 * nodes * r.parameters.number(TOLERANCE) + rounding).max(ROUNDING)
}

/// The cells of the pressure of a run (m).
fn cells(r: &Record) -> f64 {
    match r.scheme() {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => 2.0 * r.discretisation.h,
        _ => r.discretisation.h,
    }
}

/// Whether the layer is resolved by a run.
fn resolves(r: &Record) -> bool {
    layer(r.parameters.number(LOAD)).is_some_and(|layer| RESOLVING * cells(r) <= layer)
}

/// GIMP's runs at loads and levels alone, by load and scheme, coarsest first.
fn ladders(records: &[Record]) -> BTreeMap<(String, Scheme), Vec<&Record>> {
    let mut ladders: BTreeMap<_, Vec<&Record>> = BTreeMap::new();
    let own = |r: &&Record| {
        r.basis() == BasisName::Gimp
            && r.status == Status::Ok
            && (r.is_default() || r.changes_only(LOAD.name))
    };
    for r in records.iter().filter(own) {
        let key = (r.parameters.text(LOAD), r.scheme());
        ladders.entry(key).or_default().push(r);
    }
    for runs in ladders.values_mut() {
        runs.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
    }
    ladders
}

fn orders(records: &[Record]) -> Vec<Finding> {
    let of = |((load, scheme), runs): ((String, Scheme), Vec<&Record>)| {
        let finest = runs.get(runs.len().checked_sub(DECIDING)?..)?;
        if !finest.iter().all(|r| resolves(r)) {
            return None;
        }
        let found = [SETTLEMENT_ERROR_STEPS, BASE_PRESSURE_ERROR_STEPS].map(|error| {
            let points = finest.iter().map(|r| (r.discretisation.h, r.metric(error)));
            let order = fit_order(&points.collect::<Vec<_>>()).map_or(f64::NAN, |o| o.order);
            let name = format!("order of {} of {scheme} at {load} M₀", error.name);
            let why = "displacements and pressures are linear in a cell, stresses and fluxes means over domains";
            Finding::above(name, order, THEORY - SLACK, why)
        });
        Some(found)
    };
    ladders(records)
        .into_iter()
        .filter_map(of)
        .flatten()
        .collect()
}

/// The distance of the finest level's settlement at T = 0.1 from the exact solution in space of the same steps, against
/// what the two finest differ by over 2^p − 1, p the observed order, the
/// theory's at most, times the factor of safety.
fn richardson(records: &[Record]) -> Vec<Finding> {
    let of = |((load, scheme), runs): ((String, Scheme), Vec<&Record>)| {
        let [coarse, middle, fine] = runs.get(runs.len().checked_sub(DECIDING)?..)? else {
            return None;
        };
        let steps = fine.parameters.number(REFINE);
        let exact = solution(fine.parameters.number(LOAD), Some(steps));
        let exact = exact.first()?.settlement;
        let settled = [coarse, middle, fine].map(|r| r.metric(SETTLEMENT_EARLY));
        let steps = [settled[0] - settled[1], settled[1] - settled[2]];
        let shown = (steps[0] / steps[1]).log2();
        // Of differences that do not fall, or of a layer that is not resolved, nothing is shown.
        let (order, safe) = match resolves(coarse) && shown > 0.0 {
            true => (shown.min(THEORY), SAFE[0]),
            false => (1.0, SAFE[1]),
        };
        let bound = safe * steps[1].abs() / (order.exp2() - 1.0);
        let metric = format!(
            "error of {} of {scheme} at {load} M₀",
            SETTLEMENT_EARLY.name
        );
        let why = format!("Roache's index of the two finest, order {order:.2}, factor {safe}");
        Some(Finding::at_most(
            metric,
            (settled[2] - exact).abs(),
            bound,
            why,
        ))
    };
    ladders(records).into_iter().filter_map(of).collect()
}

fn order_in_time(records: &[Record]) -> Vec<Finding> {
    let mut runs: BTreeMap<(Scheme, &str), BTreeMap<u64, f64>> = BTreeMap::new();
    for r in records {
        if r.status == Status::Ok && (r.is_default() || r.changes_only(REFINE.name)) {
            let refine = r.parameters.number(REFINE) as u64;
            let of = runs.entry((r.scheme(), &*r.level)).or_default();
            of.insert(refine, r.metric(SETTLEMENT_END));
        }
    }
    let of = |((scheme, level), by): (&(Scheme, &str), &BTreeMap<u64, f64>)| {
        let at = |refine: u64| by.get(&refine).copied();
        let order = ((at(1)? - at(2)?) / (at(2)? - at(4)?)).log2();
        let metric = format!(
            "order in time of {} of {scheme} {level}",
            SETTLEMENT_END.name
        );
        Some(Finding::above(
            metric,
            order,
            1.0 - SLACK,
            "backward Euler's rule",
        ))
    };
    runs.iter().filter_map(of).collect()
}

/// A domain of h/2 that sinks by s ≤ S has the share 2 s/h in the next cell, whose strain is another by h ε′: settlements
/// S differ by 2 ∫ s ε′ dz, at most 2 S q/M₀.
fn functions_agree(records: &[Record]) -> Vec<Finding> {
    let linear = records.iter().filter(|r| {
        r.basis() == BasisName::Linear
            && r.status == Status::Ok
            && r.parameters.number(LOAD) == SMALL
    });
    let found = |r: &Record| {
        let scheme = r.scheme().with(BasisName::Gimp, r.remedy());
        let same = |q: &&Record| q.scheme() == scheme && q.level == r.level && q.set == r.set;
        let other = records.iter().find(same)?;
        let of = |r: &Record| r.metric(SETTLEMENT_ERROR);
        let bound = 2.0 * SMALL;
        let metric = format!(
            "difference of {} of {} {} and gimp",
            SETTLEMENT_ERROR.name,
            r.scheme(),
            r.level
        );
        let why = "a mean of a hat over a domain within its cell is the hat at the middle";
        Some(Finding::at_most(
            metric,
            (of(r) - of(other)).abs(),
            bound,
            why,
        ))
    };
    linear.filter_map(found).collect()
}

/// Why a run of this kind is known to break down: at large strain linear functions see the load's corner leave the cells
/// that hold particles.
pub(super) fn breaks_down(r: &Record) -> Option<&'static str> {
    let large = r.parameters.number(LOAD) >= 0.3;
    (r.basis() == BasisName::Linear && large).then_some(
        "linear functions: particles that cross cells leave the one above empty, and the top stands on a node that bears nothing",
    )
}
