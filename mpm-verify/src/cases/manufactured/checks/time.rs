//! The order in time: runs of a scheme at a level that differ in the CFL number alone, each half of the one before.

use super::{Gate, STALLED};
use crate::accuracy::richardson;
use crate::cases::manufactured::metrics::DISPLACEMENT_RATIO;
use crate::cases::parameters::{CFL, LUMPED};
use crate::cases::prelude::*;

/// Order in time of symplectic Euler with F updated by I + Δt ∇v.
const EXPLICIT: f64 = 1.0;
/// That of a rule that is symmetric in time, and what the order of a ratio of 4 ± 0.15 may be off.
const SYMMETRIC: f64 = 2.0;
const OFF: f64 = 0.054;

/// The orders in time, and where a lumped mass takes one.
pub(in crate::cases) fn order_in_time() -> [Check; 2] {
    [
        Gate::truth("order-time", "order in Δt at fixed h from differences of displacement_ratio: explicit at least 0.85; midpoint, consistent mass 2 ± 0.054, a ratio of 4 ± 0.15")
            .study(|records| orders(records, of_truth)),
        Gate::known_limit("order-time-lost", "midpoint with a lumped mass, and newmark: order in Δt of the three shortest steps below 2 − 0.15")
            .study(|records| orders(records, of_limit)),
    ]
}

fn of_truth(about: String, last: &Record, order: f64) -> Option<Finding> {
    let lumped = last.parameters.number(LUMPED);
    match last.scheme().rule() {
        None => {
            let why = "symplectic Euler, F updated by I + Δt ∇v: first order";
            Some(Finding::above(about, order, EXPLICIT - SLACK, why))
        }
        Some(RuleName::Midpoint) if lumped == 0.0 => {
            Some(Finding::within(about, order, SYMMETRIC, OFF, "the midpoint rule is symmetric in time"))
        }
        Some(RuleName::Midpoint) if lumped != 1.0 => {
            let why = "a lumped share takes energy in proportion to Δt: between first and second order";
            Some(Finding::not_applicable(about, why))
        }
        Some(_) => None,
    }
}

fn of_limit(about: String, last: &Record, order: f64) -> Option<Finding> {
    let lumped = match last.scheme().rule()? {
        RuleName::Midpoint => last.parameters.number(LUMPED) == 1.0,
        _ => true,
    };
    let why = "½ Δvᵀ (M_l − M_c) Δv of energy a step, Δv ∝ Δt: first order";
    lumped.then(|| Finding::at_most(about, order, STALLED, why))
}

/// Frequency of a vibration of ω (rad/s) with the run's steps, over ω: tan ½ω̃Δt = ½ωΔt with the implicit rules.
/// Explicit steps are shorter than a cell's crossing, and what they do is part of the error of cells.
pub(in crate::cases) fn slowed(r: &Run<()>, omega: f64) -> f64 {
    let phase = omega * r.dt();
    r.rule().map_or(1.0, |_| 2.0 * (0.5 * phase).atan() / phase)
}

/// Findings on the order of the three shortest steps of each family of runs, whose last is given.
fn orders<'a>(records: &'a [Record], found: fn(String, &Record, f64) -> Option<Finding>) -> Vec<Finding> {
    let converges = |r: &&Record| r.remedy() != FbarRecursive && r.changes_none_but(&[CFL.name, LUMPED.name]);
    let family = |r: &'a Record| (&*r.level, r.scheme(), r.changed_beside(&[CFL.name]).collect::<Vec<_>>());
    let families = ladders_over(records.iter().filter(converges), family, |r| r.discretisation.dt);
    let judged = families.into_iter().filter_map(|((level, scheme, others), family)| {
        let [.., a, b, c] = family[..] else { return None };
        let points = [a, b, c].map(|r| (r.discretisation.dt, r.metric(DISPLACEMENT_RATIO)));
        let order = richardson(points).map_or(f64::NAN, |r| r.order);
        let set: String = others.iter().map(|set| format!(" {set}")).collect();
        let metric = DISPLACEMENT_RATIO.name;
        found(format!("order in Δt of {metric} of {scheme} {level}{set}"), c, order)
    });
    judged.collect()
}
