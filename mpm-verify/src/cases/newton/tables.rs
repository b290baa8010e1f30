//! The table of its results.

use super::metrics as m;
use super::parameters::{STANDS, SUPPORT};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, SHORT, fixed, share};
use crate::scheme::RemedyName;

const SET: Label = ("changed", |r| r.set.join(", "));

fn columns() -> [Column; 6] {
    [
        Column::metric("load carried", m::CARRIED, share(1)),
        Column::metric("that there is", m::BEARABLE, share(1)),
        Column::metric("error", m::EQUILIBRIUM_ERROR, SHORT),
        Column::metric("bound", m::BOUND, SHORT),
        Column::metric("iterations", m::NEWTON_ITERATIONS, fixed(0)),
        Column::metric("most parts of a step", m::PARTS, fixed(0)),
    ]
}

pub(super) fn all() -> Vec<ResultTable> {
    let plain = |r: &Record| r.level == "n8" && r.remedy() == RemedyName::None;
    let hangs = move |r: &Record| plain(r) && !r.parameters.is(SUPPORT, STANDS);
    let stands = move |r: &Record| plain(r) && r.parameters.is(SUPPORT, STANDS);
    vec![
        ResultTable::new("newton-hangs", hangs, &[SCHEME, SET], columns()),
        ResultTable::new("newton-stands", stands, &[SCHEME, SET], columns()),
    ]
}
