//! Judgements that checks of several cases share.

use crate::prelude::*;
use mpm_core::monitor::Convergence;

/// Rounding that sums over many steps or particles gather, relative; a smaller error is rounding.
pub(super) const ROUNDING: f64 = 1e-9;
/// Least error of what is conserved: less is rounding, which no golden should hold.
pub(super) const LEAST_ERROR: f64 = 1e-12;
/// Largest gain of energy of a rule that conserves it.
pub(super) const NO_GAIN: f64 = 1e-4;
/// Ratio of the swing of an oscillator to its static answer, for a force that acts at once.
pub(super) const SWING: f64 = 2.0;
/// γ H over the undrained shear strength from which ground splashes or flows like water.
pub(super) const SPLASHING: f64 = 40.0;
/// Order of functions that reproduce linear fields.
pub(super) const FORMAL: f64 = 2.0;
/// Largest relative error of a squared frequency over (kh)², quadratic splines with fbar-rate where all of the stress is averaged,
/// rounded up: docs/remedy.md.
pub(super) const DISPERSION: f64 = 0.8;
/// Levels or steps that decide an order.
pub(super) const DECIDING: usize = 3;
/// Roache's factors of safety, of three levels that show the order, and of those that do not (doi:10.1115/1.2910291).
pub(super) const SAFE: [f64; 2] = [1.25, 3.0];

/// Largest contraction from which on Newton's method is near a solution.
const NEAR: f64 = 0.1;

/// Least contraction of the residual in an iteration near the solution of a step, over √(τ/r) of the residual r that such
/// iterations begin from and the τ that ends them, `tolerance` or what rounding leaves; nothing of a step without any.
pub(super) fn newton_rate(of: &Convergence, tolerance: f64) -> Option<f64> {
    let contractions: Vec<f64> = of.residuals.windows(2).map(|r| r[1] / r[0]).collect();
    let begin = contractions.iter().position(|c| *c < NEAR)?;
    let least = contractions[begin..].iter().copied().fold(NEAR, f64::min);
    Some(least * (of.residuals[begin] / tolerance.max(of.force_rounding)).sqrt())
}

/// The check of the largest such rate of a run's steps, whose body is stiffer in one motion than in another by `ratio`.
pub(super) fn quadratic<P: ParameterSet>(largest: Metric, ratio: impl Fn(&Run<P>) -> f64 + Held) -> CheckOf<P> {
    CheckOf::truth("quadratic", "Newton near the solution of every step: some iteration contracts the residual by √(sτ/r) at least, s the ratio of stiffnesses")
        .when(move |r: &Run<P>| r.metric(largest).is_finite())
        .at_most(largest, move |r| ratio(r).sqrt())
}

/// The runs that change the parameter `name`, each with the run that differs from it in nothing else.
pub(super) fn changed<'a, 'r, P>(
    runs: &'a [Run<'r, P>],
    name: &'static str,
) -> impl Iterator<Item = (&'a Run<'r, P>, &'a Run<'r, P>)> {
    runs.iter().filter_map(move |run| {
        let names = [name];
        let others = || run.record.changed_beside(&names);
        let same = |r: &&Run<P>| (r.scheme, &r.level) == (run.scheme, &run.level) && r.set.iter().eq(others());
        let own = (others().count() < run.set.len()).then(|| runs.iter().find(same))??;
        Some((run, own))
    })
}

/// The last [`DECIDING`] of some runs, coarsest first; nothing of fewer.
pub(super) fn finest<T>(runs: &[T]) -> Option<&[T]> {
    runs.get(runs.len().checked_sub(DECIDING)?..)
}

/// Runs by what those of a set have in common, each set coarsest first.
pub(super) fn ladders_by<'a, K: Ord>(
    runs: impl Iterator<Item = &'a Record>,
    key: impl Fn(&'a Record) -> K,
) -> BTreeMap<K, Vec<&'a Record>> {
    ladders_over(runs, key, |r| r.discretisation.h)
}

/// The same, each set with the greatest of the numbers `over` first.
pub(super) fn ladders_over<'a, K: Ord>(
    runs: impl Iterator<Item = &'a Record>,
    key: impl Fn(&'a Record) -> K,
    over: impl Fn(&Record) -> f64,
) -> BTreeMap<K, Vec<&'a Record>> {
    let mut ladders: BTreeMap<K, Vec<&Record>> = BTreeMap::new();
    for r in runs {
        ladders.entry(key(r)).or_default().push(r);
    }
    for ladder in ladders.values_mut() {
        ladder.sort_by(|a, b| over(b).total_cmp(&over(a)));
    }
    ladders
}

/// Orders by name that are to be at least the `formal` one less the slack.
pub(super) fn at_least(orders: Vec<(String, f64)>, formal: f64, why: &str) -> Vec<Finding> {
    orders.into_iter().map(|(name, order)| Finding::above(name, order, formal - SLACK, why)).collect()
}

/// Orders of a metric over the levels from the `coarsest` on of runs that are alike, by the coarsest of each.
pub(super) fn orders_from<'a, 'r, P>(
    runs: &'a [Run<'r, P>],
    judged: impl Fn(&Run<'r, P>) -> bool,
    coarsest: &'static str,
    metric: Metric,
) -> impl Iterator<Item = (&'a Run<'r, P>, Option<f64>)> {
    runs.iter().filter(move |r| r.level == coarsest && judged(r)).filter_map(move |first| {
        let ladder = runs.iter().filter(|r| r.scheme == first.scheme && r.set == first.set);
        let points: Vec<_> = ladder.map(|r| (r.h, r.metric(metric))).collect();
        (points.len() >= DECIDING).then(|| (first, fit_order(&points).map(|o| o.order)))
    })
}

/// Observed order of a metric over the abscissa `over` of some runs, coarsest first; NaN if it follows no power law.
pub(super) fn observed_order(runs: &[&Record], over: impl Fn(&Record) -> f64, metric: Metric) -> f64 {
    let points: Vec<_> = runs.iter().map(|r| (over(r), r.metric(metric))).collect();
    fit_order(&points).map_or(f64::NAN, |o| o.order)
}

/// Roache's grid convergence index.
pub(super) struct Index {
    /// Observed order, at most the theory's.
    pub(super) order: f64,
    /// Factor of safety.
    pub(super) safe: f64,
    /// Bound of the error on the finest level.
    pub(super) bound: f64,
}

/// The index of a value at three levels, each with cells of half the size of the one before, by the order of the `theory`.
/// Differences that do not fall show no order, nor do levels that are not `resolved`.
pub(super) fn index([coarse, middle, fine]: [f64; 3], theory: f64, resolved: bool) -> Index {
    let steps = [coarse - middle, middle - fine];
    let shown = (steps[0] / steps[1]).log2();
    let (order, safe) = if resolved && shown > 0.0 { (shown.min(theory), SAFE[0]) } else { (1.0, SAFE[1]) };
    let bound = safe * steps[1].abs() / (order.exp2() - 1.0);
    Index { order, safe, bound }
}

/// Order in time, which has this `name`, of a metric by runs whose numbers of steps, by `count`, double twice to the `finest`: name
/// and order of each set of runs.
pub(super) fn orders_in_time<'a>(
    name: &str,
    runs: impl Iterator<Item = &'a Record>,
    count: impl Fn(&Record) -> f64,
    finest: u64,
    metric: Metric,
) -> Vec<(String, f64)> {
    let mut ladders: BTreeMap<(Scheme, &str), BTreeMap<u64, f64>> = BTreeMap::new();
    for r in runs.filter(|r| r.status == Status::Ok) {
        ladders.entry((r.scheme(), &*r.level)).or_default().insert(count(r) as u64, r.metric(metric));
    }
    let order = |((scheme, level), by): ((Scheme, &str), BTreeMap<u64, f64>)| {
        let at = |part: u64| by.get(&(finest / part)).copied();
        let order = ((at(4)? - at(2)?) / (at(2)? - at(1)?)).log2();
        Some((format!("order in {name} of {} of {scheme} {level}", metric.name), order))
    };
    ladders.into_iter().filter_map(order).collect()
}
