//! Tables of its results.

use super::LEVELS;
use super::metrics as m;
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, fixed, order, share};

pub(super) fn all() -> Vec<ResultTable> {
    vec![
        numbers("undrained-square", |r| r.is_default()),
        numbers("undrained-across", |r| r.set == super::ACROSS),
        numbers("undrained-splines", |r| r.set == super::LINEAR_PRESSURE),
        numbers("undrained-ellipse", |r| {
            r.set.first().is_some_and(|s| s == super::ELLIPSE[0])
        }),
        errors(),
    ]
}

/// β over the cells.
fn numbers(name: &str, shows: fn(&Record) -> bool) -> ResultTable {
    let of_levels = LEVELS.map(|(level, n)| {
        Column::metric(format!("β, n = {n}"), m::INF_SUP, fixed(4)).of(move |r| r.level == level)
    });
    let falls = Column::row("order in h (between levels)", |runs, _| {
        let found = order(runs.iter().copied(), m::INF_SUP.name);
        found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
    });
    let zero =
        Column::metric("without effect, n = 16", m::ZERO_MODES, fixed(0)).of(|r| r.level == "n16");
    let columns = of_levels.into_iter().chain([falls, zero]);
    ResultTable::new(name, shows, &[SCHEME], columns)
}

/// Errors of the exact motion over the cells.
fn errors() -> ResultTable {
    let of = |title: &'static str, metric| {
        LEVELS.map(|(level, n)| {
            Column::metric(format!("{title}, n = {n}"), metric, share(2))
                .of(move |r| r.level == level)
        })
    };
    let columns = of("u", m::DISPLACEMENT_ERROR)
        .into_iter()
        .chain(of("p", m::PRESSURE_ERROR))
        .chain(of("checkerboard", m::CHECKERBOARD_RATIO));
    ResultTable::new("undrained-errors", |r| r.is_default(), &[SCHEME], columns)
}
