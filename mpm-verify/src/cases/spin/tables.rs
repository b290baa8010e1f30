//! The table of its results.

use super::metrics as m;
use super::parameters::{FLIP, TURNS};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, SHORT, percent};

const BLEND: Label = ("η", |r| r.parameters.text(FLIP));
const TURNED: Label = ("turns", |r| r.parameters.text(TURNS));
const CELLS: Label = ("level", |r| r.level.clone());

pub(super) fn all() -> Vec<ResultTable> {
    let columns = [
        Column::metric("angular momentum off by", m::ANGULAR_MOMENTUM_ERROR, SHORT),
        Column::metric("energy at the end", m::ENERGY_END, percent(2)),
        Column::metric("gain", m::ENERGY_GAIN, percent(3)),
        Column::metric("stretch, mean", m::STRETCH_MEAN_ERROR, percent(1)),
        Column::metric("largest", m::STRETCH_ERROR, percent(1)),
        Column::metric("angle", m::PHASE_ERROR, percent(2)),
    ];
    let shows = |r: &Record| {
        r.changes_none_but(&[FLIP.name, TURNS.name]) && r.parameters.number(TURNS) >= 10.0
    };
    vec![ResultTable::new(
        "spin",
        shows,
        &[SCHEME, BLEND, TURNED, CELLS],
        columns,
    )]
}
