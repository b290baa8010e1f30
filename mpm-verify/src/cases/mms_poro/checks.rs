//! The checks of the motion. The bounds are derived in `docs/mms-poro.md`.

use super::*;
use crate::cases::manufactured::checks::ladders;

/// Reason not to judge linear functions once particles have moved.
const MOVED: &str = "displaced particles shift the quadrature of linear functions, whose gradients jump";
/// Least c_v Δt/h² of a run whose water flows: the bound of two grids in docs/poromechanics.md, the largest.
const FLOWS: f64 = 0.75;

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<Motion>;
    vec![
        Check::truth("error-bound", "no error of time, linear functions unmoved: rms errors at most 0.8 (πh)² of u, 0.8 (πh_p)² of p, and the coupling through M")
            .when(|m| m.source == Source::Steps)
            .each([
                Demand::at_most(DISPLACEMENT_L2, |m| bounds(m)[0]).except(|m| m.has_moved(), MOVED),
                Demand::at_most(PRESSURE_L2, |m| bounds(m)[1]).except(|m| m.has_moved(), MOVED),
            ])
            .because("both equations are of second order, and linear in the other field's error"),
        Check::truth("order-space", "no error of time, three finest levels, not linear functions moved: order in h at least 1.85, nearly undrained p 0.85 (equal order: none)")
            .study(|records| {
                of_ladders(records, |metric, runs| {
                    let (name, order) = order(metric, runs);
                    Some(match claim(metric, runs) {
                        Ok((least, why)) => Finding::above(name, order, least - SLACK, why),
                        Err(why) => Finding::not_applicable(name, why),
                    })
                })
            }),
        Check::known_limit("stalls", "linear functions with moved particles: error of u of order below 2 − 0.15")
            .study(|records| {
                of_ladders(records, |metric, runs| {
                    let stalls = metric == DISPLACEMENT_L2 && has_moved(runs[0]);
                    let (name, order) = order(metric, runs);
                    stalls.then(|| Finding::at_most(name, order, 2.0 - SLACK, MOVED))
                })
            }),
        Check::truth("order-time", "source of rates, three finest steps at a level: rms error of p of order in Δt at least 1 − 0.15")
            .study(orders_in_time),
    ]
}

/// Bounds of the errors of u (m) and of p over its rms.
fn bounds(m: &Run<Motion>) -> [f64; 2] {
    let (moved, pressed) = (m.metric(DISPLACEMENT_SCALE), m.metric(PRESSURE_SCALE));
    let stiff = m.oedometric_modulus() * PI;
    let of = |h: f64| DISPERSION * (PI * h).powi(2);
    let pressure_cell = if m.space() == Some(TwoGrid) { 2.0 * m.h } else { m.h };
    let (solid, water) = (of(m.h), of(pressure_cell));
    [solid * moved + water * pressed / stiff, water + solid * stiff * moved / pressed]
}

fn has_moved(r: &Record) -> bool {
    Setup::<Motion>::holds(r, |m| m.has_moved())
}

fn is_of_rates(r: &Record) -> bool {
    Setup::<Motion>::holds(r, |m| m.source == Source::Rates)
}

/// The claimed order of an error, and its source; or the reason why none is claimed.
fn claim(metric: Metric, runs: &[&Record]) -> Result<(f64, &'static str), &'static str> {
    if runs.iter().any(|r| has_moved(r)) {
        return Err(MOVED);
    }
    let flows = |r: &&Record| {
        let diffusivity = Setup::<Motion>::number_of(r, |m| m.kappa() * m.oedometric_modulus());
        diffusivity * r.discretisation.dt / r.discretisation.h.powi(2) >= FLOWS
    };
    if metric != PRESSURE_L2 || runs.iter().all(flows) {
        return Ok((2.0, "linear fields are reproduced on the cells of either space"));
    }
    match runs[0].scheme() {
        Scheme::Poro(parts) if parts.space == Equal => {
            Err("where hardly any water flows nothing holds pressures that no change of volume sees")
        }
        _ => Ok((1.0, "where hardly any water flows p is what gradients of u are")),
    }
}

/// Findings of both metrics on the three finest runs of every ladder without an error of time.
fn of_ladders(records: &[Record], found: impl Fn(Metric, &[&Record]) -> Option<Finding>) -> Vec<Finding> {
    let mut all = Vec::new();
    for (_, runs) in ladders(records) {
        let Some(runs) = finest(&runs).filter(|runs| !is_of_rates(runs[0])) else { continue };
        all.extend([DISPLACEMENT_L2, PRESSURE_L2].into_iter().filter_map(|metric| found(metric, runs)));
    }
    all
}

/// The order of a metric over some runs, coarsest first, by name.
fn order(metric: Metric, runs: &[&Record]) -> (String, f64) {
    let finest = runs[runs.len() - 1];
    let set = finest.set.join(" ");
    let name = format!("order of {} of {} to {} {set}", metric.name, finest.scheme(), finest.level);
    (name.trim_end().to_owned(), observed_order(runs, |r| r.discretisation.h, metric))
}

fn orders_in_time(records: &[Record]) -> Vec<Finding> {
    let own = records.iter().filter(|r| is_of_rates(r) && r.changes_none_but(&["source", "steps"]));
    let dt = |r: &Record| r.discretisation.dt;
    let found = |((scheme, level), runs): ((Scheme, &str), Vec<&Record>)| {
        let order = observed_order(finest(&runs)?, dt, PRESSURE_L2);
        let name = format!("order in Δt of {} of {scheme} {level}", PRESSURE_L2.name);
        Some(Finding::above(name, order, 1.0 - SLACK, "backward Euler's rule"))
    };
    ladders_over(own, |r| (r.scheme(), &*r.level), dt).into_iter().filter_map(found).collect()
}
