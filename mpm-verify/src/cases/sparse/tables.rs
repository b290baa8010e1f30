//! Tables of its results.

use super::metrics as m;
use super::parameters::{LAYOUT, PPC_PER_DIRECTION};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed, share};

const LAYOUTS: Label = ("layout", |r| r.parameters.text(LAYOUT));
const NUMBER: Label = ("a cell", |r| {
    format!("{}", r.parameters.number(PPC_PER_DIRECTION).powi(2))
});

fn columns() -> [Column; 5] {
    [
        Column::metric("error of u, median", m::ERROR_MEDIAN, share(1)),
        Column::metric("nine in ten below", m::ERROR_HIGH, share(1)),
        Column::metric("error of σ, median", m::STRESS_MEDIAN, share(1)),
        Column::metric("softening", m::SOFTENING, share(1).signed()),
        Column::metric("break down", m::BROKEN, share(0)),
    ]
}

pub(super) fn all() -> Vec<ResultTable> {
    let splines =
        |r: &Record| r.level == "n16" && r.scheme().to_string() == "quasi-static-bspline2-none";
    let ones = |r: &Record| r.level == "n16" && r.is_default();
    let order = ["n8", "n16", "n32"].map(|level| {
        Column::metric(level, m::ERROR_MEDIAN, fixed(4)).of(move |r| r.level == level)
    });
    let four = |r: &Record| {
        r.changes_none_but(&[LAYOUT.name, PPC_PER_DIRECTION.name])
            && r.parameters.number(PPC_PER_DIRECTION) == 2.0
    };
    vec![
        ResultTable::new("sparse-layouts", splines, &[LAYOUTS, NUMBER], columns()),
        ResultTable::new("sparse-one", ones, &[SCHEME], columns()),
        ResultTable::new("sparse-levels", four, &[SCHEME, LAYOUTS], order).least(2),
    ]
}
