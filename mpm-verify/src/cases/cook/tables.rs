//! Tables of its results.

use super::metrics as m;
use crate::cases::family::transfers;
use crate::cases::parameters::CFL;
use crate::record::Record;
use crate::results::{CELLS, Column, PAIR, ResultTable, SCHEME, fixed, is_flip, percent};
use crate::scheme::RemedyName;

/// Levels and what they are called.
const LEVELS: [(&str, &str); 4] = [
    ("h2", "h = 2 m"),
    ("h1", "h = 1 m"),
    ("h0.5", "h = ½ m"),
    ("h0.25", "h = ¼ m"),
];

/// The error of the mid-edge deflection; of a run that never rests, when it was measured.
fn mid_edge(r: &Record) -> String {
    let error = percent(2).text(r.metric(m::FEM_MID_EDGE_ERROR));
    match r.metric(m::AT_REST) == 1.0 {
        true => error,
        false => format!("creeping: {error} after {:.0} s", r.metric(m::REST_TIME)),
    }
}

pub(super) fn all() -> Vec<ResultTable> {
    let error = |r: &Record| percent(2).text(r.metric(m::FEM_MID_EDGE_ERROR));
    vec![
        results(),
        transfers("cook-transfers", &[PAIR, CELLS], &["3", "4"], error),
        poisson(),
    ]
}

/// Where no run has the case's own time step one with another stands in: the state of rest hardly depends on it.
fn results() -> ResultTable {
    let errors = LEVELS.map(|(level, title)| {
        Column::text(format!("mid-edge error, {title}"), mid_edge).of(move |r| r.level == level)
    });
    let checkerboards = LEVELS.map(|(level, title)| {
        let title = format!("checkerboard, {title}");
        Column::metric(title, m::CHECKERBOARD_RATIO, fixed(2)).of(move |r| r.level == level)
    });
    ResultTable::new(
        "cook",
        |r| {
            let stands_in = r.changes_only(CFL.name) && r.remedy() != RemedyName::FbarRecursive;
            is_flip(r) && (r.is_default() || stands_in)
        },
        &[SCHEME],
        errors.into_iter().chain(checkerboards),
    )
}

/// Over Poisson's ratios at h = 1 m.
fn poisson() -> ResultTable {
    const RATIOS: [(&str, &[&str]); 4] = [
        ("0.3", &["poisson_ratio=0.3"]),
        ("0.49", &["poisson_ratio=0.49"]),
        ("0.499", &[]),
        ("0.4999", &["poisson_ratio=0.4999"]),
    ];
    let errors = RATIOS.map(|(ratio, set)| {
        Column::text(format!("mid-edge error, ν = {ratio}"), mid_edge).of(move |r| r.set == set)
    });
    let checkerboards = RATIOS.map(|(ratio, set)| {
        let title = format!("checkerboard, ν = {ratio}");
        Column::metric(title, m::CHECKERBOARD_RATIO, fixed(2)).of(move |r| r.set == set)
    });
    ResultTable::new(
        "cook-poisson",
        |r| {
            let own = r.remedy() == RemedyName::None || r.remedy() == RemedyName::FbarRate;
            own && is_flip(r) && r.level == "h1" && RATIOS.iter().any(|(_, set)| r.set == *set)
        },
        &[SCHEME],
        errors.into_iter().chain(checkerboards),
    )
    .least(3)
}
