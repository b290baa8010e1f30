//! Tables of its results.

use super::metrics as m;
use super::parameters::{AMPLITUDE, PREDICTOR, SOURCE, STEPS};
use super::{CROSSING, LEVELS, TIGHT};
use crate::metric::Metric;
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, fixed, order, scientific};
use crate::scheme::BasisName;

pub(super) fn all() -> Vec<ResultTable> {
    vec![
        cells("mms-poro", &[], 3),
        cells("mms-poro-one-step", &["steps=1"], 4),
        cells("mms-poro-crossing", CROSSING, 4),
        cells("mms-poro-tight", TIGHT, 3),
        steps(),
        predictors(),
    ]
}

/// Errors of u and p over the cells, of runs that change `set`, at so many `levels`.
fn cells(name: &str, set: &'static [&'static str], levels: usize) -> ResultTable {
    let errors = |metric: Metric, what: &'static str| {
        let of_level = LEVELS[..levels].iter().map(move |&(level, n)| {
            let title = format!("{what}, n = {n}");
            Column::metric(title, metric, scientific(2)).of(move |r| r.level == level)
        });
        let order = Column::row(format!("order of {what}"), move |runs, _| {
            let found = order(runs.iter().copied(), metric.name);
            found.map_or_else(|| "–".to_owned(), |o| o.to_string())
        });
        of_level.chain([order])
    };
    let columns = errors(m::DISPLACEMENT_L2, "u").chain(errors(m::PRESSURE_L2, "p"));
    ResultTable::new(name, move |r| r.set == set, &[SCHEME], columns)
}

/// The error of p over the steps.
fn steps() -> ResultTable {
    let columns = [4.0, 8.0, 16.0].into_iter().map(|count| {
        let at = move |r: &Record| r.parameters.number(STEPS) == count;
        Column::metric(format!("{count} steps"), m::PRESSURE_L2, scientific(2)).of(at)
    });
    let shows = |r: &Record| {
        r.level == "n32"
            && r.set.iter().any(|s| s.starts_with(SOURCE.name))
            && r.changes_none_but(&[SOURCE.name, STEPS.name])
    };
    ResultTable::new("mms-poro-steps", shows, &[SCHEME], columns)
}

/// Newton iterations of the four steps with either predictor, of small and large motions.
fn predictors() -> ResultTable {
    let columns = [0.005, 0.04].into_iter().flat_map(|amplitude| {
        ["particles", "zero"].map(|predictor| {
            let at = move |r: &Record| {
                r.parameters.number(AMPLITUDE) == amplitude && r.parameters.is(PREDICTOR, predictor)
            };
            let title = format!("A = {amplitude} m, from {predictor}");
            Column::metric(title, m::NEWTON_ITERATIONS, fixed(0)).of(at)
        })
    });
    let shows = |r: &Record| {
        r.level == "n16"
            && r.basis() == BasisName::Gimp
            && r.changes_none_but(&[PREDICTOR.name, AMPLITUDE.name])
    };
    ResultTable::new("mms-poro-predictor", shows, &[SCHEME], columns)
}
