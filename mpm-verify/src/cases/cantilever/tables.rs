//! Tables of its results.

use super::metrics as m;
use super::parameters::{LAW, LOAD_STEPS, STABILISATION, STABILISATION_FACTOR};
use super::reference::solution;
use crate::record::{Record, Status};
use crate::results::{BASIS, Column, Label, ResultTable, fixed, percent};
use crate::scheme::BasisName;

/// Levels and what they are called.
const LEVELS: [(&str, &str); 4] = [
    ("h0.1", "h = 0.1 m"),
    ("h0.05", "0.05"),
    ("h0.025", "0.025"),
    ("h0.0125", "0.0125"),
];

/// The error of the corner's u_y; of a run that broke down, that it did.
fn error(r: &Record) -> String {
    if r.status == Status::Failed {
        return "breaks down".to_owned();
    }
    let exact = solution(&r.parameters).map_or(f64::NAN, |s| s.bottom_right[1]);
    percent(2).text(r.metric(m::CORNER_UY) / exact - 1.0)
}

fn changed(r: &Record) -> String {
    if r.set.is_empty() {
        "–".to_owned()
    } else {
        r.set.join(", ")
    }
}

pub(super) fn all() -> Vec<ResultTable> {
    vec![cells(), steps(), choices(), strengths(), papers()]
}

/// Over the cells, by basis and stabilisation.
fn cells() -> ResultTable {
    let columns =
        LEVELS.map(|(level, title)| Column::text(title, error).of(move |r| r.level == level));
    ResultTable::new(
        "cantilever-cells",
        |r| r.changes_none_but(&[STABILISATION.name]),
        &[
            BASIS,
            ("stabilisation", |r| r.parameters.text(STABILISATION)),
        ],
        columns,
    )
}

/// Over the load steps at h = 0.05 m, by law.
fn steps() -> ResultTable {
    let columns = [5.0, 10.0, 20.0, 40.0, 80.0, 160.0].map(|steps| {
        Column::text(format!("{steps} steps"), error)
            .of(move |r| r.parameters.number(LOAD_STEPS) == steps)
    });
    ResultTable::new(
        "cantilever-steps",
        |r| {
            let splines = r.basis() == BasisName::Bspline2 && r.level == "h0.05";
            splines && r.changes_none_but(&[LOAD_STEPS.name, LAW.name])
        },
        &[("law", |r| r.parameters.text(LAW))],
        columns,
    )
}

/// Quadratic splines at h = 0.05 m with one thing changed.
fn choices() -> ResultTable {
    ResultTable::new(
        "cantilever-choices",
        |r| {
            let splines = r.basis() == BasisName::Bspline2 && r.level == "h0.05";
            splines
                && r.set
                    .iter()
                    .all(|s| !s.starts_with("law") && !s.starts_with("load"))
        },
        &[("changed", changed)],
        columns(),
    )
}

/// GIMP over the strength of its ghost penalty, as a share of G = E/2.
fn strengths() -> ResultTable {
    const ALPHA: Label = ("α_u", |r| {
        format!("{}", 2.0 * r.parameters.number(STABILISATION_FACTOR))
    });
    let errors = LEVELS[..3].iter().map(|(level, title)| {
        Column::text(format!("error of u_y, {title}"), error).of(move |r| r.level == *level)
    });
    let condition = Column::metric("log₁₀ condition, 0.05", m::LOG10_CONDITION, fixed(1))
        .of(|r: &Record| r.level == "h0.05");
    ResultTable::new(
        "cantilever-ghosts",
        |r| {
            let gimp = r.basis() == BasisName::Gimp;
            gimp && r.changes_none_but(&[STABILISATION_FACTOR.name])
        },
        &[ALPHA],
        errors.chain([condition]),
    )
}

/// The paper's elements and choices at h = 0.1 m.
fn papers() -> ResultTable {
    ResultTable::new(
        "cantilever-paper",
        |r| r.basis() == BasisName::Q8 && r.level == "h0.1" && r.set.len() > 2,
        &[("changed", |r| {
            let own = super::PAPER;
            let more = r.set.iter().filter(|s| !own.contains(&s.as_str()));
            let more: Vec<&str> = more.map(String::as_str).collect();
            if more.is_empty() {
                "–".to_owned()
            } else {
                more.join(", ")
            }
        })],
        [
            Column::metric("corner u_x (m)", m::CORNER_UX, fixed(3)),
            Column::metric("corner u_y (m)", m::CORNER_UY, fixed(3)),
            Column::metric("edge mean u_y (m)", m::EDGE_MEAN_UY, fixed(3)),
        ]
        .into_iter()
        .chain(columns()),
    )
}

fn columns() -> [Column; 5] {
    let kilo = fixed(1).times(1e-3);
    [
        Column::text("error of u_y", error),
        Column::metric("σ_xx from (kPa)", m::STRESS_MIN, kilo),
        Column::metric("to (kPa)", m::STRESS_MAX, kilo),
        Column::metric("iterations", m::NEWTON_ITERATIONS, fixed(0)),
        Column::metric("log₁₀ condition", m::LOG10_CONDITION, fixed(1)),
    ]
}
