//! Tables of its results.

use super::checks::rim;
use super::metrics as m;
use super::parameters::LOAD_STEPS;
use crate::cases::family::transfers;
use crate::cases::parameters::CFL;
use crate::record::Record;
use crate::results::{BASIS, CELLS, Column, PAIR, ResultTable, SCHEME, fixed, is_flip, percent};
use crate::scheme::{RemedyName, TransferName};

/// Levels and what they are called.
const LEVELS: [(&str, &str); 4] = [("h2", "h = 2 m"), ("h1", "h = 1 m"), ("h0.5", "h = ½ m"), ("h0.25", "h = ¼ m")];

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
        statics(),
        rims(),
    ]
}

/// The quasi-static solver over the cells, in four load steps and in one.
fn statics() -> ResultTable {
    let of = |level: &'static str| move |r: &Record| r.level == level;
    let error = |r: &Record| percent(2).text(r.metric(m::FEM_MID_EDGE_ERROR));
    let errors = LEVELS.map(|(level, title)| Column::text(format!("mid-edge error, {title}"), error).of(of(level)));
    let checkerboard = Column::metric("checkerboard, h = 1 m", m::CHECKERBOARD_RATIO, fixed(2)).of(of("h1"));
    let cpu = LEVELS
        .map(|(level, title)| Column::value(format!("CPU (s), {title}"), |r| r.time.cpu_s, fixed(1)).of(of(level)));
    ResultTable::new(
        "cook-static",
        |r| r.transfer() == TransferName::None && r.changes_none_but(&[LOAD_STEPS.name]),
        &[SCHEME, ("load steps", |r| r.parameters.text(LOAD_STEPS))],
        errors.into_iter().chain([checkerboard]).chain(cpu),
    )
}

/// What a rim that is held, one step, and a larger load come to.
fn rims() -> ResultTable {
    let error = |metric| move |r: &Record| percent(2).text(r.metric(metric));
    ResultTable::new(
        "cook-rim",
        |r| r.transfer() == TransferName::None && r.level == "h1",
        &[SCHEME, ("changed", |r| if r.is_default() { "–".to_owned() } else { r.set.join(", ") })],
        [
            Column::text("mid-edge error", error(m::FEM_MID_EDGE_ERROR)),
            Column::value("of the load at its place", rim::mid_edge_error, percent(2)),
            Column::metric("mid-edge u_y (m)", m::MID_EDGE_UY, fixed(4)),
            Column::metric("Newton iterations", m::NEWTON_ITERATIONS, fixed(0)),
            Column::metric("linear iterations", m::LINEAR_ITERATIONS, fixed(0)),
        ],
    )
}

fn results() -> ResultTable {
    let errors = LEVELS
        .map(|(level, title)| Column::text(format!("mid-edge error, {title}"), mid_edge).of(move |r| r.level == level));
    let checkerboards = LEVELS.map(|(level, title)| {
        let title = format!("checkerboard, {title}");
        Column::metric(title, m::CHECKERBOARD_RATIO, fixed(2)).of(move |r| r.level == level)
    });
    ResultTable::new("cook", is_shown, &[SCHEME], errors.into_iter().chain(checkerboards))
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
        Column::text(format!("{remedy}, {h}"), text).of(move |r| r.remedy() == remedy && r.level == level)
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
    let errors = RATIOS
        .map(|(ratio, set)| Column::text(format!("mid-edge error, ν = {ratio}"), mid_edge).of(move |r| r.set == set));
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
