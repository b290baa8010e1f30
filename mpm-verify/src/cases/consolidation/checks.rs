//! The checks of the column. Tolerances are derived in `docs/consolidation.md`.

use super::*;
use crate::exact::consolidation::layer;

/// Cells of the pressure in the layer at the drained top from which on an order is asymptotic.
const RESOLVING: f64 = 2.0;
/// The load at which no particle crosses a cell.
const SMALL: f64 = 0.003;

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<Consolidation>;
    const AGAINST_EXACT: &str = "exact solution; a column that is a cell longer or shorter, and backward Euler's steps";
    // On cells of h the end of the column is not known to less than h: T = c_v t/H² then changes by 2 h/H, a settlement over H by
    // h/H at most. Backward Euler's own error is known where its steps are.
    vec![
        Check::truth("water", "exact rate: the changes of volume and outflow agree within Newton's residual and rounding of J̃")
            .when(|c| c.volume_rate == Rate::Exact)
            .at_most(MASS_ERROR, balance_error)
            .because("the equations of all nodes add up to the balance of the column"),
        Check::known_limit("logarithm-loses-water", "logarithmic rate: every step creates ½ V (J̃ − 1)² of water, within the next term of the series")
            .when(|c| c.volume_rate == Rate::Logarithmic)
            .within(MASS_ERROR, |c| c.metric(RATE_LOSS), |c| {
                let (loss, change) = (c.metric(RATE_LOSS), c.metric(VOLUME_STEP));
                let next = loss * change / (1.0 - change) / 3.0;
                next + balance_error(c)
            })
            .because("V (J̃ ln J̃ − J̃ + 1), docs/poromechanics.md; |J̃ − 1|/3 of it and more is the next term"),
        Check::truth("settlement", "without ghost penalties: settlement at the tabulated T ≥ 0.1 exact within h/H, a cell of the column, and the error of the steps")
            .unless(not_comparable)
            .at_most(SETTLEMENT_ERROR, |c| c.h / HEIGHT + c.errors_of_steps()[0])
            .because(AGAINST_EXACT),
        Check::truth("base-pressure", "without ghost penalties: pressure at the base over the load exact within h/H and the error of the steps")
            .unless(not_comparable)
            .at_most(BASE_PRESSURE_ERROR, |c| c.h / HEIGHT + c.errors_of_steps()[1])
            .because(AGAINST_EXACT),
        Check::truth("order-space", "GIMP, three finest levels with two pressure cells in the top layer: settlement and base pressure of order in h at least 1.85")
            .study(orders),
        Check::truth("richardson", "GIMP: settlement at T = 0.1 of the finest level exact in space within the grid convergence index")
            .study(richardson),
        Check::truth("order-time", "three refinements, each twice the one before: settlement at T = 2 of order in the number of steps at least 1 − 0.15")
            .study(|records| {
                let own = records.iter().filter(|r| r.changes_none_but(&["refine"]));
                let orders = orders_in_time("time", own, |r| Filled::number_of(r, |c| f64::from(c.refine)), 4, SETTLEMENT_END);
                at_least(orders, 1.0, "backward Euler's rule")
            }),
        // A domain of h/2 that sinks by s ≤ S has the share 2 s/h in the next cell, whose strain is another by h ε′: settlements S
        // differ by 2 ∫ s ε′ dz, at most 2 S q/M₀.
        Check::truth("small-load", "0.003 M₀, no particle crosses a cell: linear functions and GIMP differ by at most 2 q/M₀, the reach of domains into the next cell")
            .when(|c| c.basis() == Linear && c.record.status == Status::Ok && c.load == SMALL)
            .pairs(
                |c, other| same_but_scheme(c, other) && other.scheme == c.scheme.with(Gimp, c.remedy()),
                |c, _| format!("difference of {} of {} {} and gimp", SETTLEMENT_ERROR.name, c.scheme, c.level),
                |c, other| (c.metric(SETTLEMENT_ERROR) - other.metric(SETTLEMENT_ERROR)).abs(),
            )
            .at_most(|_| 2.0 * SMALL)
            .because("a mean of a hat over a domain within its cell is the hat at the middle"),
    ]
}

/// Reason why a run has no exact solution to be compared with.
fn not_comparable(c: &Run<Consolidation>) -> Option<String> {
    let ghosts = c.ghost_displacement > 0.0 || c.ghost_pressure > 0.0;
    match solution(c.load, None).is_empty() {
        true => Some("no reference of this load".to_owned()),
        false => ghosts.then(|| "ghost penalties are there to show what they cost".to_owned()),
    }
}

/// Rest of the balance that Newton's method and rounding leave, over the outflow. A node balances at most three times the outflow
/// of a step (the fluxes of its two cells, and their storage), so that the norm over n + 1 nodes is at most 3 √(n + 1) of it, and
/// their sum √(n + 1) times the norm of the rest.
fn balance_error(c: &Run<Consolidation>) -> f64 {
    let nodes = HEIGHT / c.h + 1.0;
    // The last bits of J̃ in every step, over all outflow. The metric is never less than its floor.
    let rounding = 8.0 * f64::EPSILON * c.count() / c.metric(SETTLEMENT_END);
    (3.0 * nodes * c.tolerance + rounding).max(ROUNDING)
}

/// Whether the cells of the pressure resolve the layer.
fn resolves(r: &Record) -> bool {
    Filled::holds(r, |c| {
        let cell = if c.space() == Some(TwoGrid) { 2.0 * c.h } else { c.h };
        layer(c.load).is_some_and(|layer| RESOLVING * cell <= layer)
    })
}

/// GIMP's three finest runs that change the load alone, by load and scheme, coarsest first.
fn ladders(records: &[Record]) -> BTreeMap<(String, Scheme), Vec<&Record>> {
    let own = |r: &&Record| r.basis() == Gimp && r.status == Status::Ok && r.changes_none_but(&["load"]);
    let ladders =
        ladders_by(records.iter().filter(own), |r| (Filled::number_of(r, |c| c.load).to_string(), r.scheme()));
    ladders.into_iter().filter_map(|(key, runs)| Some((key, finest(&runs)?.to_vec()))).collect()
}

fn orders(records: &[Record]) -> Vec<Finding> {
    let mut ladders = ladders(records);
    ladders.retain(|_, runs| runs.iter().all(|r| resolves(r)));
    let of = |((load, scheme), runs): ((String, Scheme), Vec<&Record>)| {
        [SETTLEMENT_ERROR_STEPS, BASE_PRESSURE_ERROR_STEPS].map(|error| {
            let order = observed_order(&runs, |r| r.discretisation.h, error);
            let name = format!("order of {} of {scheme} at {load} M₀", error.name);
            let why = "displacements and pressures are linear in a cell, stresses and fluxes means over domains";
            Finding::above(name, order, FORMAL - SLACK, why)
        })
    };
    ladders.into_iter().flat_map(of).collect()
}

/// The distance of the finest level's settlement at T = 0.1 from the exact solution in space of the same steps, against Roache's
/// index.
fn richardson(records: &[Record]) -> Vec<Finding> {
    let of = |((load, scheme), runs): ((String, Scheme), Vec<&Record>)| {
        let [coarse, middle, fine] = runs[..] else { return None };
        let exact = Filled::of_record(fine).ok()?;
        let exact = solution(exact.load, Some(f64::from(exact.refine)));
        let exact = exact.first()?.settlement;
        let settled = [coarse, middle, fine].map(|r| r.metric(SETTLEMENT_EARLY));
        let index = index(settled, FORMAL, resolves(coarse));
        let metric = format!("error of {} of {scheme} at {load} M₀", SETTLEMENT_EARLY.name);
        let why = format!("Roache's index of the two finest, order {:.2}, factor {}", index.order, index.safe);
        Some(Finding::at_most(metric, (settled[2] - exact).abs(), index.bound, why))
    };
    ladders(records).into_iter().filter_map(of).collect()
}
