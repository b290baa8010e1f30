//! What is checked of the strip. Tolerances are derived in `docs/strip.md`.

use super::limit::prandtl;
use super::metrics as m;
use super::parameters::{GHOST_DISPLACEMENT, HALF_WIDTH, LOAD, PENETRATION, STEPS, TOLERANCE};
use super::reference::solution;
use super::scene::{SIDE, is_driven, is_plastic, moduli};
use super::{
    CLAY, CLAY_BELOW, LIMIT_LOAD, LIMIT_SETTLEMENT, SMALL, SQUARE, SQUARE_UNDRAINED, UNDRAINED,
    UNIFORM,
};
use crate::accuracy::fit_order;
use crate::check::{Check, Finding, judge, run, study};
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::{Scheme, SpaceName};
use std::collections::BTreeMap;

/// What orders may lack of the theory's, and levels or steps that decide them.
const SLACK: f64 = 0.15;
const DECIDING: usize = 3;

/// Whether a run is of this space of the pressure.
pub(super) fn is_of(r: &Record, space: SpaceName) -> bool {
    matches!(r.scheme(), Scheme::Poro(parts) if parts.space == space)
}

/// Whether a run changes the parameters of `set`, and beside these at most the number of steps.
pub(super) fn steps(r: &Record, set: &[&str]) -> bool {
    let others = r.set.iter().filter(|s| !s.starts_with("steps="));
    let wanted = set.iter().filter(|s| !s.starts_with("steps="));
    others.map(String::as_str).eq(wanted.copied())
}

/// Whether a run is exactly of `set`.
fn is_set(r: &Record, set: &[&str]) -> bool {
    r.set.iter().map(String::as_str).eq(set.iter().copied())
}

pub(super) fn is_own_clay(r: &Record) -> bool {
    is_set(r, CLAY)
}

pub(super) fn is_below(r: &Record) -> bool {
    is_set(r, CLAY_BELOW)
}

pub(super) fn is_small(r: &Record) -> bool {
    is_set(r, SMALL) || is_set(r, UNDRAINED)
}

/// Whether a run is of a square under a small load.
pub(super) fn is_square_small(r: &Record) -> bool {
    is_set(r, SQUARE) || is_set(r, SQUARE_UNDRAINED)
}

pub(super) fn is_undrained_small(r: &Record) -> bool {
    is_set(r, UNDRAINED)
}

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "water",
            "volume and outflow change together but for what Newton's method and rounding of J̃ leave",
            run(|r| {
                let why = "the equations of all nodes add up to the balance of the soil";
                Some(judge(r, m::MASS_ERROR).at_most(water_left(r), why))
            }),
        ),
        Check::truth(
            "support",
            "the base bears all loads but for what Newton's method leaves",
            run(|r| {
                let unknowns = r.discretisation.dim as f64 * nodes(r);
                let bound = ROUNDING + 2.0 * unknowns.sqrt() * r.parameters.number(TOLERANCE);
                let why = "the equations of all nodes add up to the balance of forces";
                // What a step that has no solution leaves of its last part is no less in balance.
                Some(judge(r, m::SUPPORT_ERROR).at_most(bound, why))
            }),
        ),
        Check::truth(
            "taylor-hood",
            "small load, three levels: the settlement of the finest is that of the finite elements but for the grid convergence index, their uncertainty and 10 q/G of finite strain",
            study(settlements),
        ),
        Check::truth(
            "pressure",
            "small load, two grids, three levels: order in h of the pressure's rms distance from the finite elements at least 1 − 0.15",
            study(|records| {
                let own = records
                    .iter()
                    .filter(|r| is_small(r) && is_of(r, SpaceName::TwoGrid));
                let why = "p depends on the angle around the strip's edge: of no order within h, on an area of h²";
                orders(own, m::PRESSURE_ERROR, |metric, order| {
                    Finding::above(metric, order, 1.0 - SLACK, why)
                })
            }),
        ),
        Check::known_limit(
            "equal-order-does-not-converge",
            "where no water flows, equal order, three levels: the largest distance of p from the finite elements falls by an order below 1 − 0.15",
            study(|records| {
                let own = records
                    .iter()
                    .filter(|r| is_undrained_small(r) && is_of(r, SpaceName::Equal));
                let why = "nothing holds pressures that no change of volume sees";
                orders(own, m::PRESSURE_ERROR_LARGEST, |metric, order| {
                    Finding::at_most(metric, order, 1.0 - SLACK, why)
                })
            }),
        ),
        Check::truth(
            "square",
            "a square, small load, two levels: the settlement of the finer is that of the finite elements but for an index of first order with a safety of 3, their uncertainty and 10 q/G of finite strain",
            study(squares),
        ),
        Check::truth(
            "smooth",
            "two grids, the whole load, elastic and Cam clay, three levels: order in h of the pressure's roughness at least 1 − 0.15",
            study(|records| {
                let why =
                    "neighbours of a pressure with a bounded gradient differ by no more than O(h)";
                let of = |own: fn(&Record) -> bool| {
                    let two = records
                        .iter()
                        .filter(move |r| own(r) && is_of(r, SpaceName::TwoGrid));
                    orders(two, m::ROUGHNESS, |metric, order| {
                        Finding::above(metric, order, 1.0 - SLACK, why)
                    })
                };
                [of(Record::is_default), of(is_below)].concat()
            }),
        ),
        Check::truth(
            "order-time",
            "elastic, the whole load, 10, 20 and 40 steps: order in Δt of the settlement at least 1 − 0.15",
            study(order_in_time),
        ),
        Check::truth(
            "uniform-clay",
            "Cam clay under a load on its whole surface that water leaves freely, 10, 20 and 40 steps: order in Δt of the settlement's distance from the integrated rates at least 1 − 0.15",
            study(uniform),
        ),
        Check::truth(
            "one-limit-load",
            "Cam clay: 10, 20 and 40 steps of the load end at the same one, but for what a step is halved to and the geometry of different settlements",
            study(one_limit),
        ),
        Check::truth(
            "plateau",
            "undrained clay under a settlement: in its last quarter the load grows by no more than a depth factor of 1 + s/B",
            run(|r| {
                let quarter =
                    0.25 * r.parameters.number(PENETRATION) / r.parameters.number(HALF_WIDTH);
                let why = "a strip that bears its limit; Hansen's depth factor is 1 + 0.2 s/B";
                let driven = is_driven(&r.parameters) && is_plastic(&r.parameters);
                driven.then(|| judge(r, m::GROWTH).at_most(quarter, why))
            }),
        ),
        Check::truth(
            "prandtl",
            "undrained clay, three levels, under a load and under a settlement: the limit of the finest is Prandtl's but for the grid convergence index and the settlement",
            study(limits),
        ),
    ]
}

/// What of a balance is rounding.
const ROUNDING: f64 = 1e-9;
/// What is finite of the strain may add so many times q/G.
const FINITE: f64 = 10.0;
/// Roache's factors of safety, of three levels that show the order, and of those that don't (doi:10.1115/1.2910291).
const SAFE: [f64; 2] = [1.25, 3.0];

/// Nodes of the displacement.
fn nodes(r: &Record) -> f64 {
    (SIDE / r.discretisation.h + 1.0).powi(r.discretisation.dim as i32)
}

/// What Newton's method and rounding leave of the water, over what the strip displaces. A node balances what is stored
/// beside it and what moves, at most (1 + 2 n) times that of n cells, over all of them.
fn water_left(r: &Record) -> f64 {
    let cells = SIDE / r.discretisation.h;
    let tolerance = r.parameters.number(TOLERANCE);
    let left = nodes(r).sqrt() * (1.0 + 2.0 * cells) * tolerance * r.metric(m::TURNOVER);
    // The last bits of J̃ of every particle in every step.
    let [all, displaced] = [SIDE, r.parameters.number(HALF_WIDTH)]
        .map(|length| length.powi(r.discretisation.dim as i32));
    let swept = r.metric(m::SETTLEMENT) * displaced;
    let rounding = 4.0 * f64::EPSILON * r.parameters.number(STEPS) * all / swept;
    ROUNDING + left + rounding
}

/// Runs of one kind by what it is called, coarsest first, where there are as many as `deciding`.
fn ladders<'a>(
    runs: impl Iterator<Item = &'a Record>,
    name: impl Fn(&Record) -> String,
    deciding: usize,
) -> BTreeMap<String, Vec<&'a Record>> {
    let mut ladders: BTreeMap<String, Vec<&Record>> = BTreeMap::new();
    for r in runs.filter(|r| r.status == Status::Ok) {
        ladders.entry(name(r)).or_default().push(r);
    }
    for runs in ladders.values_mut() {
        runs.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
    }
    ladders.retain(|_, runs| runs.len() >= deciding);
    ladders
}

/// What runs of a scheme with changed parameters are called.
fn kind(r: &Record) -> String {
    let set = if r.set.is_empty() {
        "own parameters".to_owned()
    } else {
        r.set.join(" ")
    };
    format!("{}, {set}", r.scheme())
}

/// Of every kind of runs the order of a metric over h.
fn orders<'a>(
    runs: impl Iterator<Item = &'a Record>,
    metric: Metric,
    found: impl Fn(String, f64) -> Finding,
) -> Vec<Finding> {
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let finest = &runs[runs.len() - DECIDING..];
        let points = finest
            .iter()
            .map(|r| (r.discretisation.h, r.metric(metric)));
        let order = fit_order(&points.collect::<Vec<_>>()).map_or(f64::NAN, |o| o.order);
        found(format!("order in h of {} of {kind}", metric.name), order)
    };
    ladders(runs, kind, DECIDING).into_iter().map(of).collect()
}

/// Roache's index of a value at three levels, each of half the cells of the one before, that theory gives an order: the
/// observed order, the theory's at most; of differences that do not fall nothing is shown.
fn index([coarse, middle, fine]: [f64; 3], theory: f64) -> f64 {
    let steps = [coarse - middle, middle - fine];
    let shown = (steps[0] / steps[1]).log2();
    let (order, safe) = if shown > 0.0 {
        (shown.min(theory), SAFE[0])
    } else {
        (1.0, SAFE[1])
    };
    safe * steps[1].abs() / (order.exp2() - 1.0)
}

/// What the settlement of a run may be off by beside the error of its cells: the reference's uncertainty and finite strain.
fn beside(r: &Record) -> Option<f64> {
    let known = solution(r.discretisation.h, &r.parameters)?;
    let uncertain = known.settlement_uncertainty / known.settlement;
    let [_, shear] = moduli(&r.parameters);
    Some(uncertain + FINITE * r.parameters.number(LOAD) / shear)
}

/// A value of the finest three of some runs.
fn of_finest(runs: &[&Record], value: impl Fn(&Record) -> f64) -> Option<[f64; 3]> {
    let [coarse, middle, fine] = runs.get(runs.len().checked_sub(DECIDING)?..)? else {
        return None;
    };
    Some([coarse, middle, fine].map(|r| value(r)))
}

fn settlements(records: &[Record]) -> Vec<Finding> {
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let ratios = of_finest(&runs, |r| r.metric(m::SETTLEMENT_RATIO))?;
        let bound = index(ratios, 2.0) + beside(runs.last()?)?;
        let name = format!("{} of {kind}", m::SETTLEMENT_RATIO.name);
        let why = "finite elements of Taylor and Hood, and Roache's index of three levels";
        Some(Finding::within(name, ratios[2], 1.0, bound, why))
    };
    let small = records.iter().filter(|r| is_small(r));
    ladders(small, kind, DECIDING)
        .into_iter()
        .filter_map(of)
        .collect()
}

fn squares(records: &[Record]) -> Vec<Finding> {
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let [.., coarse, fine] = runs[..] else {
            return None;
        };
        let ratio = |r: &Record| r.metric(m::SETTLEMENT_RATIO);
        let index = SAFE[1] * (ratio(coarse) - ratio(fine)).abs();
        let bound = index + beside(fine)?;
        let name = format!("{} of {kind}", m::SETTLEMENT_RATIO.name);
        let why = "finite elements of Taylor and Hood, and Roache's index of two levels";
        Some(Finding::within(name, ratio(fine), 1.0, bound, why))
    };
    let own = records.iter().filter(|r| is_square_small(r));
    ladders(own, kind, 2).into_iter().filter_map(of).collect()
}

fn order_in_time(records: &[Record]) -> Vec<Finding> {
    let mut runs: BTreeMap<(Scheme, &str), BTreeMap<u64, f64>> = BTreeMap::new();
    for r in records
        .iter()
        .filter(|r| r.status == Status::Ok && steps(r, &[]))
    {
        let count = r.parameters.number(STEPS) as u64;
        let of = runs.entry((r.scheme(), &*r.level)).or_default();
        of.insert(count, r.metric(m::SETTLEMENT));
    }
    let of = |((scheme, level), by): (&(Scheme, &str), &BTreeMap<u64, f64>)| {
        let at = |count: u64| by.get(&count).copied();
        let order = ((at(10)? - at(20)?) / (at(20)? - at(40)?)).log2();
        let metric = format!("order in Δt of {} of {scheme} {level}", m::SETTLEMENT.name);
        let why = "backward Euler's rule, and ghost penalties on increments";
        Some(Finding::above(metric, order, 1.0 - SLACK, why))
    };
    runs.iter().filter_map(of).collect()
}

fn uniform(records: &[Record]) -> Vec<Finding> {
    let own = records
        .iter()
        .filter(|r| r.status == Status::Ok && steps(r, UNIFORM[0]));
    let points: Vec<(f64, f64)> = own
        .map(|r| (r.discretisation.dt, r.metric(m::UNIFORM_ERROR)))
        .collect();
    let order =
        (points.len() >= DECIDING).then(|| fit_order(&points).map_or(f64::NAN, |o| o.order));
    let metric = format!("order in Δt of {}", m::UNIFORM_ERROR.name);
    let why = "backward Euler's rule of the return to the yield surface";
    order
        .map(|order| Finding::above(metric, order, 1.0 - SLACK, why))
        .into_iter()
        .collect()
}

fn one_limit(records: &[Record]) -> Vec<Finding> {
    let mut runs: BTreeMap<(Scheme, &str), Vec<&Record>> = BTreeMap::new();
    for r in records
        .iter()
        .filter(|r| r.status == Status::Ok && steps(r, CLAY))
    {
        runs.entry((r.scheme(), &*r.level)).or_default().push(r);
    }
    let of = |((scheme, level), runs): (&(Scheme, &str), &Vec<&Record>)| {
        let limit = |r: &&Record| r.metric(m::LAST_LOAD);
        let least = runs.iter().map(limit).fold(f64::INFINITY, f64::min);
        let most = runs.iter().map(limit).fold(0.0, f64::max);
        let halved = |r: &&Record| r.parameters.number(LOAD) / r.parameters.number(STEPS) / 256.0;
        let part = runs.iter().map(halved).fold(0.0, f64::max);
        let settled = |r: &&Record| r.metric(m::SETTLEMENT);
        let deepest = runs.iter().map(settled).fold(0.0, f64::max);
        let moved = deepest - runs.iter().map(settled).fold(f64::INFINITY, f64::min);
        let metric = format!("range of {} of {scheme} {level}", m::LAST_LOAD.name);
        let why = "parts of a step of the load, and a width that settlement changes";
        let bound = part + moved * most;
        (runs.len() >= DECIDING).then(|| Finding::at_most(metric, most - least, bound, why))
    };
    runs.iter().filter_map(of).collect()
}

fn limits(records: &[Record]) -> Vec<Finding> {
    let own = records
        .iter()
        .filter(|r| is_set(r, LIMIT_LOAD) || is_set(r, LIMIT_SETTLEMENT));
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let over = of_finest(&runs, |r| r.metric(m::LIMIT_LOAD) / prandtl(&r.parameters))?;
        let fine = &runs.last()?.parameters;
        let moved = fine.number(PENETRATION) / fine.number(HALF_WIDTH);
        let metric = format!("{} of {kind} over Prandtl's", m::LIMIT_LOAD.name);
        let why = "(2 + π) s_u, and Roache's index of three levels";
        Some(Finding::within(
            metric,
            over[2],
            1.0,
            index(over, 1.0) + moved,
            why,
        ))
    };
    ladders(own, kind, DECIDING)
        .into_iter()
        .filter_map(of)
        .collect()
}

/// Why a run of this kind is known to break down: without a ghost penalty on displacements small cuts have no stiffness.
pub(super) fn breaks_down(r: &Record) -> Option<&'static str> {
    let none = r.parameters.number(GHOST_DISPLACEMENT) == 0.0;
    none.then_some("no ghost penalty on displacements: cells of which the body has hardly anything turn inside out")
}
