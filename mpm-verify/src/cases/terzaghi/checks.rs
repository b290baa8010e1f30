//! What is checked of the column. The bounds are derived in `docs/poromechanics.md` and `docs/terzaghi.md`.

use super::metrics::{
    ENTRIES, MASS_ERROR, OVERSHOOT_FIRST_STEP, PRESSURE_L2, PRESSURE_L2_STEPS, SETTLEMENT_ERROR,
};
use super::parameters::{FIRST_STEP, LOAD, STEPS, TOLERANCE};
use super::scene::{HEIGHT, SMALL, durations, moduli, projection, steps};
use crate::accuracy::fit_order;
use crate::check::{Check, Finding, judge, run, study};
use crate::exact::terzaghi::{FirstStep, settlement, settlement_of_equations};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, Scheme, SpaceName};
use std::collections::BTreeMap;

/// What orders may lack of the theory's, one-sided as every order of this bench that a theory gives; and levels or steps
/// that decide them.
const SLACK: f64 = 0.15;
const DECIDING: usize = 3;
/// What is finite of the strain, q/M ≤ 10⁻⁶, and what Newton's method leaves, may add to an overshoot.
const FINITE: f64 = 10.0 * SMALL;

/// The equations of a step of a run, by its share c_v Δt/h², and cells of the pressure.
fn equations(r: &Record) -> Option<(impl Fn(f64) -> FirstStep, u32)> {
    let Scheme::Poro(parts) = r.scheme() else {
        return None;
    };
    let cells = (HEIGHT / r.discretisation.h).round() as u32;
    let (two, own) = (
        parts.space == SpaceName::TwoGrid,
        projection(r.scheme(), &r.parameters),
    );
    let of = move |share| match two {
        true => FirstStep::two_grid(share),
        false => FirstStep::same_cells(share, own),
    };
    Some((of, if two { cells / 2 } else { cells }))
}

/// The equations of a run's first step, and cells of the pressure; r = c_v Δt/h².
pub(super) fn first_step(r: &Record) -> Option<(FirstStep, u32, f64)> {
    let h = r.discretisation.h;
    let share = steps(h, &r.parameters).0 * (HEIGHT / h).powi(2);
    let (of, cells) = equations(r)?;
    Some((of(share), cells, share))
}

/// By how much the settlement of a run's equations differs at its end from Terzaghi's.
fn settlement_distance(r: &Record) -> Option<f64> {
    let h = r.discretisation.h;
    let durations = durations(h, &r.parameters);
    let shares = durations.iter().map(|t| t * (HEIGHT / h).powi(2));
    let (of, cells) = equations(r)?;
    let settled = settlement_of_equations(of, cells as usize, &shares.collect::<Vec<_>>());
    Some((settled - settlement(durations.iter().sum())).abs())
}

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "water",
            "volume and outflow change together but for what Newton's method and rounding of J̃ leave in every step",
            run(|r| {
                let count = r.parameters.number(STEPS);
                let nodes = HEIGHT / r.discretisation.h;
                // Where the flux is linear in height: √(4/3) of what a cell balances, of n cells.
                let left = 1.2 * nodes * r.parameters.number(TOLERANCE);
                // Water that leaves, of which backward Euler has at least a half.
                let outflow = 0.5 * HEIGHT * strain(r) * settlement(end(r));
                let rounding = 4.0 * f64::EPSILON * count * HEIGHT / outflow;
                let why =
                    "exact rate: the equations of all nodes add up to the balance of the column";
                Some(judge(r, MASS_ERROR).at_most(left + rounding, why))
            }),
        ),
        Check::truth(
            "overshoot",
            "the largest nodal pressure of the first step exceeds q by what the closed form of the discrete equations says, zero where it is monotone",
            run(|r| {
                let (equations, cells, _) = first_step(r)?;
                let why = "closed form, docs/poromechanics.md; q/M ≤ 10⁻⁶ is finite";
                let exact = equations.overshoot(cells);
                let found = judge(r, OVERSHOOT_FIRST_STEP).within(exact, FINITE, why);
                // It is in shares of the load.
                Some(found.of_scale(1.0))
            }),
        ),
        Check::truth(
            "settlement",
            "the distance at the end from Terzaghi's degree of consolidation is that of the discrete equations, solved node by node",
            run(|r| {
                let why = "Terzaghi's series, and the equations of docs/poromechanics.md step by step; q/M ≤ 10⁻⁶ is finite, and J̃ rounded";
                let distance = settlement_distance(r)?;
                // The last bits of J̃ in every step, over the strain.
                let rounding = 4.0 * f64::EPSILON * r.parameters.number(STEPS) / strain(r);
                let bound = FINITE + rounding;
                Some(judge(r, SETTLEMENT_ERROR).within(distance, bound, why))
            }),
        ),
        Check::known_limit(
            "a-sixth-is-not-enough",
            "two grids at c_v Δt/h² = 1/6, Vermeer and Verruijt's bound: p exceeds q by more than a fifth",
            run(|r| {
                let (_, _, share) = first_step(r)?;
                let here = is_of(r, SpaceName::TwoGrid) && (share - 1.0 / 6.0).abs() < 1e-9;
                let why = "the bound of these elements is 3/4";
                here.then(|| judge(r, OVERSHOOT_FIRST_STEP).above(0.2, why))
            }),
        ),
        Check::truth(
            "order-space",
            "default parameters, three finest levels: order in h of the error of space alone at least 2 − 0.15",
            study(|records| {
                let own = records.iter().filter(|r| r.is_default());
                let ladders = ladders(own, |r| r.discretisation.h, PRESSURE_L2_STEPS);
                let found = |(scheme, points): (Scheme, Vec<(f64, f64)>)| {
                    let why = "pressures are linear, and strains averaged, in a cell";
                    let metric = format!("order of {} of {scheme}", PRESSURE_L2_STEPS.name);
                    Some(Finding::above(metric, order(&points)?, 2.0 - SLACK, why))
                };
                ladders.into_iter().filter_map(found).collect()
            }),
        ),
        Check::truth(
            "order-time",
            "n80, three finest steps: order in Δt of the error of p at least 1 − 0.15",
            study(|records| {
                let own = records
                    .iter()
                    .filter(|r| r.level == "n80" && (r.is_default() || r.changes_only(STEPS.name)));
                let ladders = ladders(own, |r| r.discretisation.dt, PRESSURE_L2);
                let found = |(scheme, points): (Scheme, Vec<(f64, f64)>)| {
                    let why = "backward Euler's rule";
                    let metric = format!("order in Δt of {} of {scheme}", PRESSURE_L2.name);
                    Some(Finding::above(metric, order(&points)?, 1.0 - SLACK, why))
                };
                ladders.into_iter().filter_map(found).collect()
            }),
        ),
        Check::truth(
            "functions-agree",
            "linear functions and GIMP of the same run differ by no more than what domains see of the next cell, into which they sink by q H/M: 2 (q/M)/√(πT)",
            study(functions_agree),
        ),
        Check::bookkeeping(
            "fewer-entries",
            "matrices of two grids have fewer entries than those of one",
            study(fewer_entries),
        ),
    ]
}

/// q/M of a run.
fn strain(r: &Record) -> f64 {
    r.parameters.number(LOAD) / moduli(&r.parameters)[0]
}

/// T at its end.
fn end(r: &Record) -> f64 {
    durations(r.discretisation.h, &r.parameters).iter().sum()
}

fn is_of(r: &Record, space: SpaceName) -> bool {
    matches!(r.scheme(), Scheme::Poro(parts) if parts.space == space)
}

/// Of every scheme a metric over what it depends on, coarsest first.
fn ladders<'a>(
    runs: impl Iterator<Item = &'a Record>,
    over: impl Fn(&Record) -> f64,
    metric: Metric,
) -> BTreeMap<Scheme, Vec<(f64, f64)>> {
    let mut ladders: BTreeMap<Scheme, Vec<(f64, f64)>> = BTreeMap::new();
    for r in runs {
        let points = ladders.entry(r.scheme()).or_default();
        points.push((over(r), r.metric(metric)));
    }
    for points in ladders.values_mut() {
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
    }
    ladders
}

/// The order of the three finest.
fn order(points: &[(f64, f64)]) -> Option<f64> {
    let finest = points.get(points.len().checked_sub(DECIDING)?..)?;
    Some(fit_order(finest).map_or(f64::NAN, |o| o.order))
}

/// The run that differs from `r` in its functions alone.
fn twin<'a>(records: &'a [Record], r: &Record, basis: BasisName) -> Option<&'a Record> {
    let scheme = r.scheme().with(basis, r.remedy());
    let same = |q: &&Record| q.scheme() == scheme && q.level == r.level && q.set == r.set;
    records.iter().find(same)
}

fn functions_agree(records: &[Record]) -> Vec<Finding> {
    let linear = records.iter().filter(|r| r.basis() == BasisName::Linear);
    let found = |r: &Record| {
        let other = twin(records, r, BasisName::Gimp)?;
        let error = r.metric(PRESSURE_L2_STEPS);
        let apart = (error - other.metric(PRESSURE_L2_STEPS)).abs();
        let metric = format!(
            "difference of {} of {} {} and gimp",
            PRESSURE_L2_STEPS.name,
            r.scheme(),
            r.level
        );
        // A domain of h/2 has the share 2 q H/(M h) in a cell whose strain is another by h ε′ ≤ h/(H √(πT)) of q/M.
        let bound = 2.0 * strain(r) / (std::f64::consts::PI * end(r)).sqrt();
        let why = "a mean of a hat over a domain within its cell is the hat at the middle";
        Some(Finding::at_most(metric, apart, bound, why))
    };
    linear.filter_map(found).collect()
}

fn fewer_entries(records: &[Record]) -> Vec<Finding> {
    let coarse = records
        .iter()
        .filter(|r| is_of(r, SpaceName::TwoGrid) && r.parameters.number(FIRST_STEP) == 0.0);
    let found = |r: &Record| {
        let equal = Scheme::poro(r.basis(), SpaceName::Equal);
        let same = |q: &&Record| q.scheme() == equal && q.level == r.level && q.set == r.set;
        let other = records.iter().find(same)?;
        let metric = format!("entries of {} {} over those of equal", r.scheme(), r.level);
        let ratio = r.metric(ENTRIES) / other.metric(ENTRIES);
        Some(Finding::at_most(
            metric,
            ratio,
            1.0,
            "half as many pressures along every axis",
        ))
    };
    coarse.filter_map(found).collect()
}
