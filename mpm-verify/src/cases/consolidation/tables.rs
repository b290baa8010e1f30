//! Tables of its results.

use super::LEVELS;
use super::metrics as m;
use super::parameters::{DRAIN, GHOST_DISPLACEMENT, GHOST_PRESSURE, LOAD, REFINE, VOLUME_RATE};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, order, scientific, share};
use crate::scheme::BasisName;

const OF_LOAD: Label = ("load", |r| format!("{} M₀", r.parameters.text(LOAD)));

pub(super) fn all() -> Vec<ResultTable> {
    vec![cells(), linear(), drains(), ghosts(), water()]
}

fn is_gimp(r: &Record) -> bool {
    r.basis() == BasisName::Gimp
}

/// The error of space over the cells.
fn cells() -> ResultTable {
    let errors = LEVELS.map(|(level, n)| {
        let title = format!("n = {n}");
        Column::metric(title, m::SETTLEMENT_ERROR_STEPS, share(3)).of(move |r| r.level == level)
    });
    let orders = Column::row("order ± (between levels)", |runs, _| {
        let found = order(runs.iter().copied(), m::SETTLEMENT_ERROR_STEPS.name);
        found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
    });
    let whole = Column::metric("with that of time, n = 16", m::SETTLEMENT_ERROR, share(2))
        .of(|r| r.level == "n16");
    let columns = errors.into_iter().chain([orders, whole]);
    let shows = |r: &Record| is_gimp(r) && (r.is_default() || r.changes_only(LOAD.name));
    ResultTable::new("consolidation-cells", shows, &[OF_LOAD, SCHEME], columns)
}

/// The same of linear functions, where they come to the end.
fn linear() -> ResultTable {
    let errors = LEVELS.map(|(level, n)| {
        let title = format!("n = {n}");
        Column::metric(title, m::SETTLEMENT_ERROR_STEPS, share(3)).of(move |r| r.level == level)
    });
    let shows = |r: &Record| {
        let of_load = r.is_default() || r.changes_only(LOAD.name);
        r.basis() == BasisName::Linear && of_load
    };
    ResultTable::new("consolidation-linear", shows, &[OF_LOAD, SCHEME], errors)
}

/// The error of space over what the drained top lets through.
fn drains() -> ResultTable {
    let columns = [100.0, 1e3, 1e4].into_iter().flat_map(|drain| {
        LEVELS[..3].iter().map(move |(level, n)| {
            let at = move |r: &Record| r.level == *level && r.parameters.number(DRAIN) == drain;
            let title = format!("β h/κ₀ = {drain}, n = {n}");
            Column::metric(title, m::SETTLEMENT_ERROR_STEPS, share(3)).of(at)
        })
    });
    let shows = |r: &Record| is_gimp(r) && (r.is_default() || r.changes_only(DRAIN.name));
    ResultTable::new("consolidation-drain", shows, &[SCHEME], columns).across()
}

/// What ghost penalties cost: the settlement's error of space, and its end.
fn ghosts() -> ResultTable {
    const U: Label = ("α_u", |r| r.parameters.text(GHOST_DISPLACEMENT));
    const P: Label = ("α_p", |r| r.parameters.text(GHOST_PRESSURE));
    let errors = LEVELS[..3].iter().map(|(level, n)| {
        let title = format!("error of settlement, n = {n}");
        Column::metric(title, m::SETTLEMENT_ERROR_STEPS, share(3)).of(move |r| r.level == *level)
    });
    let shows = |r: &Record| {
        let known = [GHOST_DISPLACEMENT.name, GHOST_PRESSURE.name];
        r.scheme().to_string() == "poro-gimp-two-grid" && r.changes_none_but(&known)
    };
    ResultTable::new("consolidation-ghosts", shows, &[U, P], errors)
}

/// What both rates lose.
fn water() -> ResultTable {
    const RATE: Label = ("rate", |r| r.parameters.text(VOLUME_RATE));
    const STEPS: Label = ("steps", |r| {
        format!("{}", 125.0 * r.parameters.number(REFINE))
    });
    let columns = [
        Column::metric("water made", m::MASS_ERROR, scientific(2)),
        Column::metric("½ Σ V (J̃ − 1)²", m::RATE_LOSS, scientific(2)),
        Column::metric("error of settlement", m::SETTLEMENT_ERROR, share(2)),
    ];
    let shows = |r: &Record| {
        let known = [LOAD.name, REFINE.name, VOLUME_RATE.name];
        r.scheme().to_string() == "poro-gimp-two-grid"
            && r.level == "n16"
            && r.changes_none_but(&known)
    };
    ResultTable::new(
        "consolidation-water",
        shows,
        &[OF_LOAD, RATE, STEPS],
        columns,
    )
}
