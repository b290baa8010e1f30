//! The table of its results.

use super::metrics as m;
use super::parameters::MACH;
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, percent, share};

const SPEED: Label = ("Mach", |r| r.parameters.text(MACH));

pub(super) fn all() -> Vec<ResultTable> {
    let columns = [
        Column::metric("speed of the front", m::SHOCK_SPEED_ERROR, percent(2)),
        Column::metric("mean stress", m::STRESS_ERROR, percent(2)),
        Column::metric("force on the wall", m::WALL_FORCE_ERROR, percent(2)),
        Column::metric("overshoot", m::OVERSHOOT, percent(0)),
        Column::metric("rings", m::RINGING, share(1)),
        Column::metric(
            "energy lost, over the exact",
            m::ENERGY_LOSS_ERROR,
            percent(0),
        ),
    ];
    // One grid: the page is to be read.
    let shows = |r: &Record| r.changes_none_but(&[MACH.name]) && r.level == "n128";
    vec![ResultTable::new("shock", shows, &[SCHEME, SPEED], columns)]
}
