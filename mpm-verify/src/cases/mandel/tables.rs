//! Tables of its results.

use super::LEVELS;
use super::checks::is_together;
use super::metrics as m;
use super::parameters::{POISSON_RATIO, STEPS};
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, fixed, order, scientific};

pub(super) fn all() -> Vec<ResultTable> {
    vec![cells(), together(), ratios()]
}

fn order_of(metric: &'static str) -> Column {
    Column::row("order ± (between levels)", move |runs, _| {
        let found = order(runs.iter().copied(), metric);
        found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
    })
}

/// The error of space over the cells, and how far runs are from the difference equations.
fn cells() -> ResultTable {
    let errors = LEVELS.map(|(level, n)| {
        let title = format!("n = {n}");
        let metric = m::CENTRE_PRESSURE_ERROR_SPACE;
        Column::metric(title, metric, scientific(2)).of(move |r| r.level == level)
    });
    let of_n32 = |title: &str, metric, format| {
        Column::metric(title, metric, format).of(|r: &Record| r.level == "n32")
    };
    let others = [
        order_of(m::CENTRE_PRESSURE_ERROR_SPACE.name),
        of_n32(
            "from the difference equations, n = 32",
            m::EQUATIONS_DISTANCE,
            scientific(1),
        ),
        of_n32("entries, n = 32", m::ENTRIES, fixed(0)),
    ];
    let columns = errors.into_iter().chain(others);
    ResultTable::new("mandel-cells", |r| r.is_default(), &[SCHEME], columns)
}

/// The whole error where steps shrink as h².
fn together() -> ResultTable {
    let columns = LEVELS.map(|(level, n)| {
        let title = format!("n = {n}, {} steps", 60.0 * (n / 8.0_f64).powi(2));
        Column::metric(title, m::CENTRE_PRESSURE_ERROR, scientific(2)).of(move |r| r.level == level)
    });
    let columns = columns
        .into_iter()
        .chain([order_of(m::CENTRE_PRESSURE_ERROR.name)]);
    ResultTable::new("mandel-together", is_together, &[SCHEME], columns)
}

/// Error and peak over Poisson's ratio.
fn ratios() -> ResultTable {
    let columns = [0.0, 0.25, 0.4].into_iter().flat_map(|ratio| {
        let own = move |r: &Record| r.parameters.number(POISSON_RATIO) == ratio;
        let column = |title: &str, metric, format| {
            Column::metric(format!("{title}, ν = {ratio}"), metric, format).of(own)
        };
        [
            column("error", m::CENTRE_PRESSURE_ERROR, scientific(2)),
            column("peak", m::PEAK, fixed(4)),
            column("T", m::PEAK_TIME, fixed(4)),
        ]
    });
    let shows = |r: &Record| {
        let others = r.changes_none_but(&[POISSON_RATIO.name, STEPS.name]);
        r.level == "n16" && r.parameters.number(STEPS) == 240.0 && others
    };
    ResultTable::new("mandel-ratios", shows, &[SCHEME], columns)
}
