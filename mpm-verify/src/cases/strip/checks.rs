//! The checks of the strip. Tolerances are derived in `docs/strip.md`.

use super::*;
use crate::cases::checks::SAFE;

/// Largest contribution of finite strain, over q/G.
const FINITE: f64 = 10.0;

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<Strip>;
    vec![
        Check::truth("water", "the changes of volume and outflow agree within Newton's residual and rounding of J̃")
            .at_most(MASS_ERROR, balance_error)
            .because("the equations of all nodes add up to the balance of the soil"),
        // The rest of the last part of a step that has no solution is no less in balance.
        Check::truth("support", "the reaction of the base equals all loads within Newton's residual")
            .at_most(SUPPORT_ERROR, |s| {
                let unknowns = f64::from(s.dimension) * nodes(s);
                ROUNDING + 2.0 * unknowns.sqrt() * s.tolerance
            })
            .because("the equations of all nodes add up to the balance of forces"),
        Check::truth("taylor-hood", "small load, three levels: the finest settlement agrees with the finite elements within the grid convergence index, their uncertainty and 10 q/G of finite strain")
            .study(settlements),
        Check::truth("pressure", "small load, two grids, three levels: rms distance of the pressure from the finite elements of order in h at least 1 − 0.15")
            .study(|records| {
                let why = "p depends on the angle around the strip's edge: of no order within h, on an area of h²";
                at_least(orders(records, |r| is_small(r) && is_of(r, TwoGrid), PRESSURE_ERROR), 1.0, why)
            }),
        Check::known_limit("equal-order-does-not-converge", "undrained, equal order, three levels: largest distance of p from the finite elements of order in h below 1 − 0.15")
            .study(|records| {
                let why = "nothing holds pressures that no change of volume sees";
                orders(records, |r| r.changes(UNDRAINED) && is_of(r, Equal), PRESSURE_ERROR_LARGEST)
                    .into_iter()
                    .map(|(name, order)| Finding::at_most(name, order, 1.0 - SLACK, why))
                    .collect()
            }),
        Check::truth("square", "square, small load, two levels: finer settlement agrees with finite elements within the first-order index (safety 3), their uncertainty and 10 q/G")
            .study(squares),
        Check::truth("smooth", "two grids, whole load, elastic and Cam clay, three levels: roughness of the pressure of order in h at least 1 − 0.15")
            .study(|records| {
                let why = "neighbours of a pressure with a bounded gradient differ by no more than O(h)";
                let elastic = orders(records, |r| r.is_default() && is_of(r, TwoGrid), ROUGHNESS);
                let clay = orders(records, |r| r.changes(CLAY_BELOW) && is_of(r, TwoGrid), ROUGHNESS);
                at_least([elastic, clay].concat(), 1.0, why)
            }),
        Check::truth("order-time", "elastic, whole load, 10, 20 and 40 steps: order in Δt of the settlement at least 1 − 0.15")
            .study(|records| {
                let own = records.iter().filter(|r| is_set_but_steps(r, ""));
                let orders = orders_in_time("Δt", own, |r| Loaded::number_of(r, |s| f64::from(s.steps)), 40, SETTLEMENT);
                at_least(orders, 1.0, "backward Euler's rule, and ghost penalties on increments")
            }),
        Check::truth("uniform-clay", "Cam clay, freely drained load on the whole surface, 10, 20, 40 steps: settlement error against integrated rates of order in Δt at least 0.85")
            .study(uniform),
        Check::truth("one-limit-load", "Cam clay: 10, 20 and 40 steps end at one limit load, within the least part of a step and the geometry of different settlements")
            .study(one_limit),
        Check::truth("plateau", "undrained clay under a settlement: load growth in the last quarter at most that of a depth factor 1 + s/B")
            .when(|s| s.is_driven() && s.is_plastic())
            .at_most(GROWTH, |s| 0.25 * s.penetration / s.half_width)
            .because("a strip that bears its limit; Hansen's depth factor is 1 + 0.2 s/B"),
        Check::truth("prandtl", "undrained clay under a load and a settlement: limit load of the finest of three levels Prandtl's within the convergence index and the settlement")
            .study(limits),
    ]
}

/// Nodes of the displacement.
fn nodes(s: &Setup<Strip>) -> f64 {
    (SIDE / s.h + 1.0).powi(s.dimension)
}

/// Rest of the balance of water that Newton's method and rounding leave, over the volume that the strip displaces. A node stores
/// and moves at most (1 + 2 n) times that of n cells, over all of them.
fn balance_error(s: &Run<Strip>) -> f64 {
    let cells = SIDE / s.h;
    let left = nodes(s).sqrt() * (1.0 + 2.0 * cells) * s.tolerance * s.metric(TURNOVER);
    // The last bits of J̃ of every particle in every step.
    let [all, displaced] = [SIDE, s.half_width].map(|length| length.powi(s.dimension));
    let swept = s.metric(SETTLEMENT) * displaced;
    let rounding = 4.0 * f64::EPSILON * f64::from(s.steps) * all / swept;
    ROUNDING + left + rounding
}

/// Runs of one scheme that change the same parameters, by these in words, coarsest first, where there are at least `deciding`.
fn ladders(records: &[Record], own: impl Fn(&Record) -> bool, deciding: usize) -> BTreeMap<String, Vec<&Record>> {
    let mut ladders = ladders_by(records.iter().filter(|r| own(r) && r.status == Status::Ok), |r| {
        let set = if r.set.is_empty() { "own parameters".to_owned() } else { r.set.join(" ") };
        format!("{}, {set}", r.scheme())
    });
    ladders.retain(|_, runs| runs.len() >= deciding);
    ladders
}

/// The order of a metric over h by the three finest runs of each kind.
fn orders(records: &[Record], own: impl Fn(&Record) -> bool, metric: Metric) -> Vec<(String, f64)> {
    let order = move |(kind, runs): (String, Vec<&Record>)| {
        let order = observed_order(finest(&runs)?, |r| r.discretisation.h, metric);
        Some((format!("order in h of {} of {kind}", metric.name), order))
    };
    ladders(records, own, DECIDING).into_iter().filter_map(order).collect()
}

/// Allowance for the settlement of a run beside the error of its cells: the reference's uncertainty and finite strain.
fn beside(r: &Record) -> Option<f64> {
    let s = Loaded::of_record(r).ok()?;
    let known = s.reference()?;
    let uncertain = known.settlement_uncertainty / known.settlement;
    Some(uncertain + FINITE * s.load / s.shear_modulus())
}

/// A value of the finest three of some runs.
fn of_finest(runs: &[&Record], value: impl Fn(&Record) -> f64) -> Option<[f64; 3]> {
    let [coarse, middle, fine] = finest(runs)? else { return None };
    Some([coarse, middle, fine].map(|r| value(r)))
}

fn settlements(records: &[Record]) -> Vec<Finding> {
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let ratios = of_finest(&runs, |r| r.metric(SETTLEMENT_RATIO))?;
        let bound = index(ratios, 2.0, true).bound + beside(runs.last()?)?;
        let name = format!("{} of {kind}", SETTLEMENT_RATIO.name);
        let why = "finite elements of Taylor and Hood, and Roache's index of three levels";
        Some(Finding::within(name, ratios[2], 1.0, bound, why))
    };
    ladders(records, is_small, DECIDING).into_iter().filter_map(of).collect()
}

fn squares(records: &[Record]) -> Vec<Finding> {
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let [.., coarse, fine] = runs[..] else { return None };
        let ratio = |r: &Record| r.metric(SETTLEMENT_RATIO);
        let index = SAFE[1] * (ratio(coarse) - ratio(fine)).abs();
        let bound = index + beside(fine)?;
        let name = format!("{} of {kind}", SETTLEMENT_RATIO.name);
        let why = "finite elements of Taylor and Hood, and Roache's index of two levels";
        Some(Finding::within(name, ratio(fine), 1.0, bound, why))
    };
    ladders(records, |r| r.changes(SQUARE) || r.changes(SQUARE_UNDRAINED), 2).into_iter().filter_map(of).collect()
}

fn uniform(records: &[Record]) -> Vec<Finding> {
    let own = records.iter().filter(|r| r.status == Status::Ok && is_set_but_steps(r, UNIFORM));
    let points: Vec<(f64, f64)> = own.map(|r| (r.discretisation.dt, r.metric(UNIFORM_ERROR))).collect();
    if points.len() < DECIDING {
        return Vec::new();
    }
    let order = fit_order(&points).map_or(f64::NAN, |o| o.order);
    let metric = format!("order in Δt of {}", UNIFORM_ERROR.name);
    vec![Finding::above(metric, order, 1.0 - SLACK, "backward Euler's rule of the return to the yield surface")]
}

fn one_limit(records: &[Record]) -> Vec<Finding> {
    let own = records.iter().filter(|r| r.status == Status::Ok && is_set_but_steps(r, CLAY));
    let of = |((scheme, level), runs): ((Scheme, &str), Vec<&Record>)| {
        let most = |of: &dyn Fn(&Record) -> f64| runs.iter().map(|r| of(r)).fold(0.0, f64::max);
        let least = |metric| runs.iter().map(|r| r.metric(metric)).fold(f64::INFINITY, f64::min);
        let largest = most(&|r| r.metric(LAST_LOAD));
        let part = most(&|r| Loaded::number_of(r, |s| s.load / f64::from(s.steps) / 256.0));
        let moved = most(&|r| r.metric(SETTLEMENT)) - least(SETTLEMENT);
        let metric = format!("range of {} of {scheme} {level}", LAST_LOAD.name);
        let why = "parts of a step of the load, and a width that settlement changes";
        let (range, bound) = (largest - least(LAST_LOAD), part + moved * largest);
        (runs.len() >= DECIDING).then(|| Finding::at_most(metric, range, bound, why))
    };
    ladders_by(own, |r| (r.scheme(), &*r.level)).into_iter().filter_map(of).collect()
}

fn limits(records: &[Record]) -> Vec<Finding> {
    let of = |(kind, runs): (String, Vec<&Record>)| {
        let over = of_finest(&runs, |r| r.metric(LIMITING_LOAD) / Loaded::number_of(r, |s| s.exact().prandtl()))?;
        let moved = Loaded::number_of(runs.last()?, |s| s.penetration / s.half_width);
        let metric = format!("{} of {kind} over Prandtl's", LIMITING_LOAD.name);
        let why = "(2 + π) s_u, and Roache's index of three levels";
        let bound = index(over, 1.0, true).bound + moved;
        Some(Finding::within(metric, over[2], 1.0, bound, why))
    };
    let ladders = ladders(records, |r| r.changes(LIMIT_LOAD) || r.changes(LIMIT_SETTLEMENT), DECIDING);
    ladders.into_iter().filter_map(of).collect()
}
