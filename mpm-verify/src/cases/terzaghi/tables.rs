//! Tables of its results.

use super::LEVELS;
use super::checks::first_step;
use super::metrics as m;
use super::parameters::{FIRST_STEP, STEPS};
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, order, percent, scientific};

pub(super) fn all() -> Vec<ResultTable> {
    vec![cells(), first_steps(), steps()]
}

/// The error of space over the cells.
fn cells() -> ResultTable {
    let errors = LEVELS.map(|(level, n)| {
        let title = format!("n = {n}");
        Column::metric(title, m::PRESSURE_L2_STEPS, scientific(2)).of(move |r| r.level == level)
    });
    let orders = Column::row("order ± (between levels)", |runs, _| {
        let found = order(runs.iter().copied(), m::PRESSURE_L2_STEPS.name);
        found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
    });
    let entries = Column::metric("entries, n = 160", m::ENTRIES, crate::results::fixed(0))
        .of(|r| r.level == "n160");
    let columns = errors.into_iter().chain([orders, entries]);
    ResultTable::new("terzaghi-cells", |r| r.is_default(), &[SCHEME], columns)
}

/// The overshoot of the first step over its share.
fn first_steps() -> ResultTable {
    let shares = [0.05, 0.1, 1.0 / 6.0, 0.25, 0.35, 2.0 / 3.0, 0.75, 1.0];
    let columns = shares.into_iter().map(|share| {
        let at = move |r: &Record| first_step(r).is_some_and(|f| (f.2 - share).abs() < 1e-9);
        let title = format!("r = {share:.3}");
        Column::metric(title, m::OVERSHOOT_FIRST_STEP, percent(2)).of(at)
    });
    let shows = |r: &Record| {
        r.level == "n20"
            && r.parameters.number(STEPS) == 1.0
            && r.changes_none_but(&[STEPS.name, FIRST_STEP.name])
    };
    ResultTable::new("terzaghi-first-step", shows, &[SCHEME], columns)
}

/// The error over the steps.
fn steps() -> ResultTable {
    let columns = [5.0, 10.0, 20.0, 40.0, 80.0].into_iter().map(|count| {
        let at = move |r: &Record| r.parameters.number(STEPS) == count;
        Column::metric(format!("{count} steps"), m::PRESSURE_L2, scientific(2)).of(at)
    });
    let shows = |r: &Record| r.level == "n80" && (r.is_default() || r.changes_only(STEPS.name));
    ResultTable::new("terzaghi-steps", shows, &[SCHEME], columns)
}
