//! Tables of its results.

use super::metrics as m;
use crate::cases::family::transfers;
use crate::cases::parameters::CFL;
use crate::record::Record;
use crate::results::{BASIS, CELLS, Column, PAIR, ResultTable, SCHEME, fixed, is_flip, percent};
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
        overview(),
        transfers("cook-transfers", &[PAIR, CELLS], &["3", "4"], error),
        poisson(),
    ]
}

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
        is_shown,
        &[SCHEME],
        errors.into_iter().chain(checkerboards),
    )
}

/// What is said first: locking, creep and where convergence stops.
fn overview() -> ResultTable {
    const RUNS: [(RemedyName, &str, &str); 6] = [
        (RemedyName::None, "h1", "1 m"),
        (RemedyName::None, "h0.5", "½ m"),
        (RemedyName::FbarRecursive, "h1", "1 m"),
        (RemedyName::FbarConsistent, "h2", "2 m"),
        (RemedyName::FbarConsistent, "h1", "1 m"),
        (RemedyName::FbarConsistent, "h0.5", "½ m"),
    ];
    let text = |r: &Record| {
        let noise = fixed(2).text(r.metric(m::CHECKERBOARD_RATIO));
        format!("{}, {noise}", mid_edge(r))
    };
    let column = |(remedy, level, h): (RemedyName, &'static str, &str)| {
        Column::text(format!("{remedy}, {h}"), text)
            .of(move |r| r.remedy() == remedy && r.level == level)
    };
    ResultTable::new("cook-overview", is_shown, &[BASIS], RUNS.map(column))
}

/// Where no run has the case's own time step one with another stands in: the state of rest hardly depends on it.
fn is_shown(r: &Record) -> bool {
    let stands_in = r.changes_only(CFL.name) && r.remedy() != RemedyName::FbarRecursive;
    is_flip(r) && (r.is_default() || stands_in)
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
