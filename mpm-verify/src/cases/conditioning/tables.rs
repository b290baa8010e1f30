//! Tables of its results.

use super::metrics as m;
use super::parameters::{GHOST, MOBILITY, PRESSURE_GHOST};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed, percent};

const ALPHA: Label = ("α", |r| r.parameters.text(GHOST));
const WATER: Label = ("κ Δt G/h_p²", |r| r.parameters.text(MOBILITY));
const OVER: Label = ("ghost of p over", |r| r.parameters.text(PRESSURE_GHOST));

pub(super) fn all() -> Vec<ResultTable> {
    let strengths = [
        ("uu least", m::COND_UU_LEAST),
        ("mean", m::COND_UU_MEAN),
        ("most", m::COND_UU),
        ("pp least", m::COND_PP_LEAST),
        ("mean", m::COND_PP_MEAN),
        ("most", m::COND_PP),
    ];
    let numbers = strengths.map(|(title, metric)| Column::metric(title, metric, fixed(2)));
    let price = Column::metric("deflection", m::DEFLECTION_CHANGE, percent(2));
    let shows = |r: &Record| r.changes_none_but(&[GHOST.name]);
    let whole = [("raw", m::COND), ("scaled", m::COND_SCALED)]
        .map(|(title, metric)| Column::metric(title, metric, fixed(1)));
    vec![
        ResultTable::new(
            "conditioning-alpha",
            shows,
            &[SCHEME, ALPHA],
            numbers.into_iter().chain([price]),
        ),
        ResultTable::new(
            "conditioning-whole",
            |r| r.changes_none_but(&[GHOST.name, MOBILITY.name, PRESSURE_GHOST.name]),
            &[SCHEME, WATER, ALPHA, OVER],
            whole,
        ),
    ]
}
