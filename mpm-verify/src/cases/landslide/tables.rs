//! Tables of its results, in plane strain and in three dimensions.

use super::metrics as m;
use crate::cases::family::transfers;
use crate::record::{Record, Status};
use crate::results::{
    CELLS, Column, Label, PAIR, ResultTable, SCHEME, fixed, is_flip, percent, scientific, share,
};
use crate::scheme::RemedyName;

const LEVEL: Label = ("level", |r| {
    let level = r.level.replace("slice-", "slice, ").replace('h', "");
    format!("{level} m")
});
const CHANGED: Label = ("changed", |r| r.set.join(", "));

/// Those of the case in so many dimensions.
pub(super) fn all(dimension: i32) -> Vec<ResultTable> {
    if dimension == 3 {
        return vec![in_space()];
    }
    let toe = |r: &Record| fixed(2).unit(" m").text(r.metric(m::RUNOUT_2_5S));
    vec![
        ResultTable::by_remedy("landslide", &REMEDIES, is_main, runout),
        in_plane(),
        studies(),
        transfers("landslide-transfers", &[PAIR, CELLS], &["3", "4"], toe),
    ]
}

const REMEDIES: [RemedyName; 3] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarConsistent,
];

fn is_main(r: &Record) -> bool {
    is_flip(r) && r.is_default() && r.level == "h0.1"
}

fn fails(r: &Record) -> bool {
    r.metric(m::FAILURE_TIME).is_finite()
}

/// Run-out after 2.5 s and at the end.
fn runout(r: &Record) -> String {
    let of = |metric| fixed(1).unit(" m").text(r.metric(metric));
    match fails(r) {
        true => format!("{}, {}", of(m::RUNOUT_2_5S), of(m::RUNOUT_END)),
        false => "stands".to_owned(),
    }
}

/// Energy not accounted for, over the fallen, of a slope that has failed.
fn lost(r: &Record) -> f64 {
    match r.metric(m::FAILED_SHARE_END) > 0.1 {
        true => -r.metric(m::UNACCOUNTED_ENERGY) / r.metric(m::FALLEN_ENERGY),
        false => f64::NAN,
    }
}

/// Shear bands, and where the rearmost is.
fn bands(r: &Record) -> String {
    let count = fixed(0).text(r.metric(m::SHEAR_BANDS_END));
    match r.metric(m::REARMOST_BAND_END) {
        rear if rear.is_finite() => format!("{count} ({})", fixed(1).text(rear)),
        _ => count,
    }
}

fn in_plane() -> ResultTable {
    let range = |r: &Record| {
        let [least, most] = [m::JACOBIAN_MIN, m::JACOBIAN_MAX].map(|j| fixed(2).text(r.metric(j)));
        format!("{least} … {most}")
    };
    ResultTable::new(
        "landslide-2d",
        |r| r.is_default() && is_flip(r) && r.status == Status::Ok,
        &[SCHEME, CELLS],
        [
            Column::metric("run-out at 2.5 s (m)", m::RUNOUT_2_5S, fixed(2)),
            Column::metric("at 5.5 s (m)", m::RUNOUT_END, fixed(2)),
            Column::metric("of the bulk (m)", m::BULK_RUNOUT_END, fixed(2)),
            Column::metric("settlement (m)", m::SETTLEMENT_END, fixed(2)),
            Column::metric("failed", m::FAILED_SHARE_END, share(0)),
            Column::metric("fails at (s)", m::FAILURE_TIME, fixed(2)),
            Column::metric("retrogression (m)", m::RETROGRESSION_END, fixed(1)),
            Column::text("bands (rearmost, m)", bands),
            Column::metric("σ_m − Πσ_m at rest (γH)", m::CHECKERBOARD_AT_REST, fixed(3)),
            Column::metric("at 2.5 s", m::CHECKERBOARD_2_5S, fixed(3)),
            Column::text("J", range),
            Column::metric("ln(J/J̄) rms", m::LOG_JACOBIAN_GAP, fixed(2)),
            Column::value("lost", lost, share(0)),
            Column::cpu(),
        ],
    )
}

/// The toe at 2.5 s and when it fails, for what may tip the slope.
fn studies() -> ResultTable {
    const SETS: [(&str, &[&str]); 7] = [
        ("no reduction", &["reduction=1", "duration=2.5"]),
        ("1.65", &[]),
        ("half the step", &["cfl=0.175"]),
        ("damped", &["damping=0.7"]),
        ("over 2 s", &["release=2"]),
        ("1.8", &["reduction=1.8"]),
        ("2", &["reduction=2"]),
    ];
    let text = |r: &Record| match fails(r) {
        true => {
            let toe = fixed(2).text(r.metric(m::RUNOUT_2_5S));
            format!("{toe} ({:.2} s)", r.metric(m::FAILURE_TIME))
        }
        false => "–".to_owned(),
    };
    ResultTable::new(
        "landslide-studies",
        is_flip,
        &[SCHEME, CELLS],
        SETS.map(|(title, set)| Column::text(title, text).of(move |r| r.set == set)),
    )
}

fn in_space() -> ResultTable {
    let spread = scientific(0);
    ResultTable::new(
        "landslide-3d",
        |r| r.status == Status::Ok,
        &[SCHEME, LEVEL, CHANGED],
        [
            Column::value("particles", |r| r.work.particles as f64, fixed(0)),
            Column::metric("run-out at 2.5 s (m)", m::RUNOUT_2_5S, fixed(2)),
            Column::metric("at the end (m)", m::RUNOUT_END, fixed(2)),
            Column::metric(
                "against plane strain (m)",
                m::OFF_PLANE_STRAIN_END,
                fixed(2).signed(),
            ),
            Column::metric("fails at (s)", m::FAILURE_TIME, fixed(2)),
            Column::metric(
                "off plane strain at rest",
                m::OFF_PLANE_STRAIN_AT_REST,
                percent(3),
            ),
            Column::metric("at 0.5 s", m::OFF_PLANE_STRAIN_0_5S, percent(3)),
            Column::metric("spread at rest", m::WIDTH_SPREAD_AT_REST, spread),
            Column::metric("at 0.5 s", m::WIDTH_SPREAD_0_5S, spread),
            Column::metric("at the end", m::WIDTH_SPREAD_END, spread),
            Column::cpu(),
        ],
    )
}
