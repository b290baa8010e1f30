//! How far a column's settlement and base pressure are from the reference, whoever computed them.

use super::metrics as m;
use super::parameters::{LOAD, REFINE};
use super::reference::{At, between, solution};
use crate::metric::Metric;
use crate::parameter::Parameters;

/// The largest of a difference from `exact`, at its times; none where there is no exact one.
fn largest(seen: &[At], exact: &[At], of: impl Fn(&At, &At) -> f64) -> f64 {
    let distances = exact.iter().map(|exact| {
        let own = between(seen, exact.t);
        own.map_or(f64::NAN, |own| of(&own, exact).abs())
    });
    let greater = |most: f64, d: f64| if d > most || d.is_nan() { d } else { most };
    distances.reduce(greater).unwrap_or(f64::NAN)
}

/// The exact solution, and that of the same steps.
fn exact(parameters: &Parameters) -> [Vec<At>; 2] {
    let [load, refine] = [LOAD, REFINE].map(|p| parameters.number(p));
    [solution(load, None), solution(load, Some(refine))]
}

/// What the settlement of a column is off by, and what it is.
pub(super) fn of_settlement(at: &[At], parameters: &Parameters) -> Vec<(Metric, f64)> {
    let [whole, of_steps] = exact(parameters);
    let off = |own: &At, exact: &At| own.settlement / exact.settlement - 1.0;
    let [early, end] =
        [between(at, 0.1), at.last().copied()].map(|at| at.map_or(f64::NAN, |at| at.settlement));
    vec![
        (m::SETTLEMENT_ERROR, largest(at, &whole, off)),
        (m::SETTLEMENT_ERROR_STEPS, largest(at, &of_steps, off)),
        (m::SETTLEMENT_EARLY, early),
        (m::SETTLEMENT_END, end),
    ]
}

/// What the pressure at its base is off by.
pub(super) fn of_base_pressure(at: &[At], parameters: &Parameters) -> Vec<(Metric, f64)> {
    let [whole, of_steps] = exact(parameters);
    let off = |own: &At, exact: &At| own.base - exact.base;
    vec![
        (m::BASE_PRESSURE_ERROR, largest(at, &whole, off)),
        (m::BASE_PRESSURE_ERROR_STEPS, largest(at, &of_steps, off)),
    ]
}

/// By how much (relative) the settlement that is exact in space, of the steps of a run, differs from the exact one, and
/// the base pressure over the load; zero where those steps have no reference.
pub(super) fn of_steps(parameters: &Parameters) -> [f64; 2] {
    let [whole, of_steps] = exact(parameters);
    let pairs = || of_steps.iter().zip(&whole);
    let settlement = pairs().map(|(own, exact)| (own.settlement / exact.settlement - 1.0).abs());
    let base = pairs().map(|(own, exact)| (own.base - exact.base).abs());
    [settlement.fold(0.0, f64::max), base.fold(0.0, f64::max)]
}
