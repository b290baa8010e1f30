//! Tables of its results.

use super::checks::{is_of, is_small, steps};
use super::limit::prandtl;
use super::metrics as m;
use super::parameters::{CONTROL, DIMENSION, GHOST_DISPLACEMENT, GHOST_PRESSURE, STEPS};
use super::reference::is_undrained;
use super::scene::is_plastic;
use super::{CLAY, LEVELS, LIMIT_LOAD, LIMIT_SETTLEMENT, UNIFORM};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed, order, share};
use crate::scheme::SpaceName;

const OF_STEPS: Label = ("steps", |r| r.parameters.text(STEPS));
const OF_WATER: Label = ("water", |r| {
    let words = if is_undrained(&r.parameters) {
        "none flows"
    } else {
        "flows"
    };
    words.to_owned()
});

pub(super) fn all() -> Vec<ResultTable> {
    vec![
        small(),
        large(),
        of_steps(),
        ghosts(),
        limit(),
        uniform(),
        square(),
    ]
}

/// Against finite elements at a small load.
fn small() -> ResultTable {
    let of = |metric, title: &'static str, format: fn(usize) -> crate::results::Format, digits| {
        LEVELS.map(move |(level, n)| {
            let title = format!("{title}, B/h = {n}");
            Column::metric(title, metric, format(digits)).of(move |r| r.level == level)
        })
    };
    let settled = of(m::SETTLEMENT_RATIO, "settlement over theirs", fixed, 4);
    let pressures = of(m::PRESSURE_ERROR, "error of p/q", share, 2);
    let columns = settled.into_iter().chain(pressures);
    ResultTable::new("strip-small", is_small, &[OF_WATER, SCHEME], columns)
}

/// The whole load over the cells.
fn large() -> ResultTable {
    const SOIL: Label = ("soil", |r| r.parameters.text(super::parameters::LAW));
    let settled = LEVELS.map(|(level, n)| {
        let title = format!("settlement/B, B/h = {n}");
        Column::metric(title, m::SETTLEMENT, fixed(4)).of(move |r| r.level == level)
    });
    let rough = LEVELS.map(|(level, n)| {
        let title = format!("roughness, B/h = {n}");
        Column::metric(title, m::ROUGHNESS, share(3)).of(move |r| r.level == level)
    });
    let orders = Column::row("order of roughness", |runs, _| {
        let found = order(runs.iter().copied(), m::ROUGHNESS.name);
        found.map_or_else(|| "–".to_owned(), |o| o.to_string())
    });
    let finest = [
        Column::metric("p/q least", m::LEAST_PRESSURE, fixed(3)),
        Column::metric("q (kPa)", m::LAST_LOAD, fixed(2).times(1e-3)),
    ];
    let finest = finest.map(|column| column.of(|r: &Record| r.level == "b4"));
    let columns = settled
        .into_iter()
        .chain(rough)
        .chain([orders])
        .chain(finest);
    let shows = |r: &Record| r.is_default() || super::checks::is_below(r);
    ResultTable::new("strip-large", shows, &[SOIL, SCHEME], columns)
}

/// One step to forty.
fn of_steps() -> ResultTable {
    const SOIL: Label = ("soil", |r| r.parameters.text(super::parameters::LAW));
    let columns = [
        Column::metric("settlement/B", m::SETTLEMENT, fixed(4)),
        Column::metric("last load (kPa)", m::LAST_LOAD, fixed(2).times(1e-3)),
        Column::metric("Newton iterations", m::NEWTON_ITERATIONS, fixed(0)),
    ];
    let shows = |r: &Record| {
        let elastic = !is_plastic(&r.parameters) && steps(r, &[]);
        is_of(r, SpaceName::TwoGrid) && r.level == "b4" && (elastic || steps(r, CLAY))
    };
    ResultTable::new("strip-steps", shows, &[SOIL, OF_STEPS], columns)
}

/// With and without ghost penalties.
fn ghosts() -> ResultTable {
    const U: Label = ("α_u", |r| r.parameters.text(GHOST_DISPLACEMENT));
    const P: Label = ("α_p", |r| r.parameters.text(GHOST_PRESSURE));
    let columns = [
        Column::metric("settlement/B", m::SETTLEMENT, fixed(4)),
        Column::metric("roughness", m::ROUGHNESS, share(3)),
        Column::metric("p/q least", m::LEAST_PRESSURE, fixed(3)),
        Column::metric("Newton iterations", m::NEWTON_ITERATIONS, fixed(0)),
    ];
    let shows = |r: &Record| {
        let known = [GHOST_DISPLACEMENT.name, GHOST_PRESSURE.name];
        is_of(r, SpaceName::TwoGrid) && r.level == "b4" && r.changes_none_but(&known)
    };
    ResultTable::new("strip-ghosts", shows, &[U, P], columns)
}

/// Limit loads of undrained clay over Prandtl's.
fn limit() -> ResultTable {
    const GIVEN: Label = ("given", |r| r.parameters.text(CONTROL));
    let columns = LEVELS.map(|(level, n)| {
        let over = |r: &Record| format!("{:.4}", r.metric(m::LIMIT_LOAD) / prandtl(&r.parameters));
        Column::text(format!("q/Prandtl's, B/h = {n}"), over).of(move |r| r.level == level)
    });
    let shows = |r: &Record| steps(r, LIMIT_LOAD) || steps(r, LIMIT_SETTLEMENT);
    ResultTable::new("strip-limit", shows, &[GIVEN, OF_STEPS, SCHEME], columns)
}

/// Clay under a load on its whole surface.
fn uniform() -> ResultTable {
    let columns = [Column::metric(
        "error of settlement",
        m::UNIFORM_ERROR,
        share(3),
    )];
    ResultTable::new(
        "strip-uniform",
        |r| steps(r, UNIFORM[0]),
        &[OF_STEPS],
        columns,
    )
}

/// A square.
fn square() -> ResultTable {
    const LOADED: Label = ("load (Pa)", |r| r.parameters.text(super::parameters::LOAD));
    const SIZE: Label = ("B/h", |r| (1.0 / r.discretisation.h).round().to_string());
    let columns = [
        Column::metric("settlement/B", m::SETTLEMENT, fixed(6)),
        Column::metric(
            "over that of finite elements",
            m::SETTLEMENT_RATIO,
            fixed(4),
        ),
        Column::metric("error of p/q", m::PRESSURE_ERROR, share(2)),
        Column::metric("roughness", m::ROUGHNESS, share(3)),
        Column::metric("Newton iterations", m::NEWTON_ITERATIONS, fixed(0)),
        Column::metric(
            "entries of a matrix (10⁶)",
            m::ENTRIES,
            fixed(2).times(1e-6),
        ),
        Column::cpu(),
    ];
    let labels = [LOADED, OF_WATER, SCHEME, SIZE];
    let shows = |r: &Record| r.parameters.number(DIMENSION) == 3.0;
    ResultTable::new("strip-square", shows, &labels, columns)
}
