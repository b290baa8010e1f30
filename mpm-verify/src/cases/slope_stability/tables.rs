//! Tables of its results.

use super::{FAILS_AT, STANDS_AT, STRENGTH_REDUCTION_FACTOR};
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, SHORT, fixed, is_flip};
use crate::scheme::RemedyName;

pub(super) fn all() -> Vec<ResultTable> {
    let remedies = [
        RemedyName::None,
        RemedyName::FbarRecursive,
        RemedyName::FbarConsistent,
    ];
    let bounds = |r: &Record| {
        let [stands, fails] = [STANDS_AT, FAILS_AT].map(|at| r.metric(at));
        if !fails.is_finite() {
            return format!("stands at {stands}");
        }
        let factor = r.metric(STRENGTH_REDUCTION_FACTOR);
        format!("{factor:.3} ({stands:.3} … {fails:.3})")
    };
    let levels = [("h0.4", "h = 0.4 m"), ("h0.2", "0.2 m"), ("h0.1", "0.1 m")];
    let of_level =
        levels.map(|(level, title)| Column::text(title, bounds).of(move |r| r.level == level));
    let cpu = levels.map(|(level, title)| {
        let text = |r: &Record| SHORT.text(r.time.cpu_s);
        Column::text(format!("CPU (s), {title}"), text).of(move |r| r.level == level)
    });
    vec![
        ResultTable::by_remedy(
            "slope",
            &remedies,
            |r| r.is_default() && is_flip(r) && r.level == "h0.2",
            |r| fixed(2).text(r.metric(STRENGTH_REDUCTION_FACTOR)),
        ),
        ResultTable::new(
            "slope-stability",
            Record::is_default,
            &[SCHEME],
            of_level.into_iter().chain(cpu),
        ),
    ]
}
