//! The table of its results.

use super::metrics as m;
use super::parameters::{MACH, QUADRATIC_VISCOSITY, VISCOSITY};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed, percent, share};

const SPEED: Label = ("Mach", |r| r.parameters.text(MACH));
const COEFFICIENTS: Label = ("c₁, c₂", |r| {
    let [linear, quadratic] = VISCOSITY.map(|p| r.parameters.text(p));
    format!("{linear}, {quadratic}")
});

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
    let is_viscous = |r: &Record| {
        let changed = [MACH, VISCOSITY[0], VISCOSITY[1]].map(|p| p.name);
        r.changes_none_but(&changed) && r.parameters.number(QUADRATIC_VISCOSITY) > 0.0
    };
    let on = |level: &'static str, column: Column| column.of(move |r| r.level == level);
    let of_viscous = [
        on(
            "n128",
            Column::metric("speed of the front", m::SHOCK_SPEED_ERROR, percent(2)),
        ),
        on(
            "n64",
            Column::metric("mean stress, 64 cells", m::STRESS_ERROR, percent(2)),
        ),
        on(
            "n128",
            Column::metric("128 cells", m::STRESS_ERROR, percent(2)),
        ),
        on(
            "n256",
            Column::metric("256 cells", m::STRESS_ERROR, percent(2)),
        ),
        on(
            "n128",
            Column::metric("overshoot", m::OVERSHOOT, percent(1)),
        ),
        on("n128", Column::metric("rings", m::RINGING, share(1))),
        on(
            "n128",
            Column::metric("width (m)", m::FRONT_WIDTH, fixed(3)),
        ),
        on(
            "n128",
            Column::metric("predicted", m::PREDICTED_WIDTH, fixed(3)),
        ),
        on(
            "n128",
            Column::metric("rate of loss", m::LOSS_RATE_ERROR, percent(1)),
        ),
        on(
            "n256",
            Column::metric("256 cells", m::LOSS_RATE_ERROR, percent(1)),
        ),
    ];
    vec![
        ResultTable::new("shock", shows, &[SCHEME, SPEED], columns),
        ResultTable::new(
            "shock-viscous",
            is_viscous,
            &[COEFFICIENTS, SCHEME, SPEED],
            of_viscous,
        ),
    ]
}
