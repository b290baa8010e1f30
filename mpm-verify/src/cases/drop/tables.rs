//! The table of its results.

use super::metrics as m;
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, SHORT, fixed, share};
use crate::scheme::{BasisName, RemedyName};

const SET: Label = ("changed", |r| r.set.join(", "));

pub(super) fn all() -> Vec<ResultTable> {
    let columns = [
        Column::metric("energy gain", m::ENERGY_GAIN, SHORT),
        Column::metric("at the end", m::ENERGY_END, share(1)),
        Column::metric("least gap", m::LEAST_GAP, fixed(3)),
        Column::metric("impulse along over μ across", m::FRICTION_RATIO, fixed(3)),
        Column::metric("restitution", m::RESTITUTION, fixed(3)),
        Column::metric("spin", m::SPIN, fixed(3)),
    ];
    let shows = |r: &Record| {
        let few = matches!(r.basis(), BasisName::Gimp | BasisName::Bspline2);
        r.level == "n8" && few && r.remedy() == RemedyName::None
    };
    vec![ResultTable::new("drop", shows, &[SCHEME, SET], columns)]
}
