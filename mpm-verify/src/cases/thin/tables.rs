//! Tables of its results.

use super::metrics as m;
use super::parameters::POISSON_RATIO;
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed};

const LEVELS: [(&str, &str); 3] = [("t1", "one cell"), ("t2", "two"), ("t4", "four")];
const RATIO: Label = ("ν", |r| r.parameters.text(POISSON_RATIO));
const SET: Label = ("changed", |r| r.set.join(", "));

pub(super) fn all() -> Vec<ResultTable> {
    let columns = || {
        let of = |metric, title: &'static str| {
            LEVELS.map(|(level, cells)| {
                Column::metric(format!("{title}, {cells}"), metric, fixed(3))
                    .of(move |r| r.level == level)
            })
        };
        let measured = of(m::FREQUENCY_RATIO, "frequency");
        measured
            .into_iter()
            .chain(of(m::PREDICTED_RATIO, "predicted"))
    };
    let own = |r: &Record| r.scheme().rule().is_none();
    let shows = move |r: &Record| own(r) && r.changes_none_but(&[POISSON_RATIO.name]);
    let others = move |r: &Record| !shows(r);
    vec![
        ResultTable::new("thin", shows, &[SCHEME, RATIO], columns()),
        ResultTable::new("thin-others", others, &[SCHEME, SET], columns()),
    ]
}
