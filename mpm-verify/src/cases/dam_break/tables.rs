//! Tables of its results.

use super::metrics as m;
use super::parameters::{CFL, DENSITY, START};
use super::reference::{DEPTH, GRAVITY};
use super::{BASES, LADDER, SHORT};
use crate::record::{Record, Status};
use crate::results::{
    BASIS, CELLS, Column, Label, ResultTable, SCHEME, fixed, is_flip, percent, share,
};
use crate::scheme::RemedyName;

const CHANGED: Label = ("changed", |r| r.set.join(", ").replace('_', " "));
/// Of a run behind its gate.
const AT_REST: [&[&str]; 3] = [&[], &["start=gravity-stage"], LADDER];

pub(super) fn all() -> Vec<ResultTable> {
    vec![overview(), flow(), start(), studies(), sums()]
}

/// The front's error, and the kinetic and potential energy that is left.
fn overview() -> ResultTable {
    const RUNS: [(RemedyName, &str); 6] = [
        (RemedyName::None, "h0.125"),
        (RemedyName::FbarRecursive, "h0.125"),
        (RemedyName::FbarConsistent, "h0.5"),
        (RemedyName::FbarConsistent, "h0.25"),
        (RemedyName::FbarConsistent, "h0.125"),
        (RemedyName::FbarConsistent, "h0.0625"),
    ];
    let text = |r: &Record| {
        let front = fixed(2).unit(" m").text(r.metric(m::FRONT_RMS_ERROR));
        format!("{front}, {}", share(0).text(r.metric(m::MOTION_RATIO_2S)))
    };
    let column = |(remedy, level): (RemedyName, &'static str)| {
        Column::text(format!("{remedy}, {} m", &level[1..]), text)
            .of(move |r| r.remedy() == remedy && r.level == level)
    };
    ResultTable::new(
        "dam-break",
        |r| BASES.contains(&r.basis()) && is_flip(r) && r.set == LADDER,
        &[BASIS],
        RUNS.map(column),
    )
}

fn flow() -> ResultTable {
    let range = |r: &Record| {
        let [least, most] = [m::JACOBIAN_MIN, m::JACOBIAN_MAX].map(|j| fixed(2).text(r.metric(j)));
        format!("{least} … {most}")
    };
    ResultTable::new(
        "dam-break-flow",
        |r| r.set == LADDER,
        &[SCHEME, CELLS],
        [
            Column::metric("front at 0.4 s (m)", m::FRONT_X_EARLY, fixed(2)),
            Column::metric("rms error (m)", m::FRONT_RMS_ERROR, fixed(2)),
            Column::metric("arrival off by (ms)", m::ARRIVAL_ERROR, fixed(0).times(1e3)),
            Column::metric("p rms (kPa)", m::PRESSURE_RMS, fixed(1).times(1e-3)),
            Column::metric("p − Πp (kPa)", m::CHECKERBOARD_RMS, fixed(1).times(1e-3)),
            Column::metric("in tension", m::TENSION_SHARE, share(0)),
            Column::metric("K + P at 2 s", m::MOTION_RATIO_2S, fixed(3)),
            Column::metric("with stress work", m::ENERGY_RATIO_2S, fixed(3)),
            Column::text("J", range),
            Column::cpu(),
        ],
    )
}

fn start() -> ResultTable {
    /// ρ g H (Pa); on the gate ½ H times that.
    fn pressure(r: &Record) -> f64 {
        r.parameters.number(DENSITY) * GRAVITY * DEPTH
    }
    let gate = |r: &Record| r.metric(m::GATE_FORCE) / (0.5 * DEPTH * pressure(r)) - 1.0;
    let floor = |r: &Record| r.metric(m::BASE_PRESSURE) / pressure(r) - 1.0;
    let force = |r: &Record| r.metric(m::BASE_REACTION_RATIO) - 1.0;
    ResultTable::new(
        "dam-break-start",
        |r| r.status == Status::Ok && is_flip(r) && AT_REST.iter().any(|set| r.set == *set),
        &[
            SCHEME,
            CELLS,
            ("start", |r| r.parameters.text(START).replace('-', " ")),
            ("CFL", |r| r.parameters.text(CFL)),
        ],
        [
            Column::value("force on the floor", force, percent(2)),
            Column::value("on the gate", gate, percent(2)),
            Column::value("pressure at the floor", floor, percent(2)),
            Column::metric("profile rms", m::PRESSURE_PROFILE_ERROR, percent(2)),
        ],
    )
}

/// Shares of PIC, walls, start, last bits: at h = 0.25 m.
fn studies() -> ResultTable {
    ResultTable::new(
        "dam-break-studies",
        |r| {
            let ours = r.remedy() == RemedyName::FbarConsistent && BASES.contains(&r.basis());
            let flow = r
                .set
                .iter()
                .all(|set| !set.starts_with("cfl=") && !set.starts_with("duration="));
            ours && flow && is_flip(r) && r.level == "h0.25"
        },
        &[SCHEME, CHANGED],
        [
            Column::metric("front at 0.4 s (m)", m::FRONT_X_EARLY, fixed(3)),
            Column::metric("rms error (m)", m::FRONT_RMS_ERROR, fixed(3)),
            Column::metric("K + P at 2 s", m::MOTION_RATIO_2S, fixed(3)),
            Column::metric("p − Πp (kPa)", m::CHECKERBOARD_RMS, fixed(1).times(1e-3)),
            Column::metric(
                "impulse on the wall (kN s/m)",
                m::WALL_IMPULSE,
                fixed(2).times(1e-3),
            ),
        ],
    )
}

fn sums() -> ResultTable {
    ResultTable::new(
        "dam-break-sums",
        |r| {
            let shown = !r.is_default() || r.remedy() == RemedyName::FbarConsistent;
            let short = r.set == SHORT || r.set == SHORT[1..];
            r.status == Status::Ok && shown && !short
        },
        &[SCHEME, CELLS, CHANGED],
        [
            Column::metric(
                "impulse on the wall (kN s/m)",
                m::WALL_IMPULSE,
                fixed(2).times(1e-3),
            ),
            Column::metric("mean x (m)", m::CENTRE_X_MEAN, fixed(3)),
            Column::metric("mean y (m)", m::CENTRE_Y_MEAN, fixed(3)),
            Column::metric("K + P at 2 s", m::MOTION_RATIO_2S, fixed(3)),
        ],
    )
}
