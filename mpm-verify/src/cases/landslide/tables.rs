//! Tables of the landslide, in plane strain and in three dimensions.

use super::*;

const LEVEL: Label = ("level", |r| {
    let level = r.level.replace("slice-", "slice, ").replace('h', "");
    format!("{level} m")
});

pub(super) fn in_plane() -> Vec<ResultTable> {
    let toe = |r: &Record| fixed(2).unit(" m").text(r.metric(RUNOUT_2_5S));
    let is_main = |r: &Record| is_flip(r) && r.is_default() && r.level == "h0.1";
    vec![
        ResultTable::by_remedy("landslide", &REMEDIES, is_main, runout),
        ResultTable::of("landslide-2d", |r| r.is_default() && is_flip(r) && r.status == Status::Ok)
            .by(&[SCHEME, CELLS])
            .metric("run-out at 2.5 s (m)", RUNOUT_2_5S, fixed(2))
            .metric("at 5.5 s (m)", RUNOUT_END, fixed(2))
            .metric("of the bulk (m)", BULK_RUNOUT_END, fixed(2))
            .metric("settlement (m)", SETTLEMENT_END, fixed(2))
            .metric("failed", FAILED_SHARE_END, share(0))
            .metric("fails at (s)", FAILURE_TIME, fixed(2))
            .metric("retrogression (m)", RETROGRESSION_END, fixed(1))
            .text("bands (rearmost, m)", bands)
            .metric("σ_m − Πσ_m at rest (γH)", CHECKERBOARD_AT_REST, fixed(3))
            .metric("at 2.5 s", CHECKERBOARD_2_5S, fixed(3))
            .text("J", |r| range(r, [JACOBIAN_MIN, JACOBIAN_MAX]))
            .metric("ln(J/J̄) rms", LOG_JACOBIAN_GAP, fixed(2))
            .value("lost", lost, share(0))
            .cpu(),
        studies(),
        transfers("landslide-transfers", &[PAIR, CELLS], &["3", "4"], toe),
    ]
}

fn fails(r: &Record) -> bool {
    r.metric(FAILURE_TIME).is_finite()
}

/// Run-out after 2.5 s and at the end.
fn runout(r: &Record) -> String {
    let of = |metric| fixed(1).unit(" m").text(r.metric(metric));
    if fails(r) { format!("{}, {}", of(RUNOUT_2_5S), of(RUNOUT_END)) } else { "stands".to_owned() }
}

/// Energy not accounted for, over the fallen, of a slope that has failed.
fn lost(r: &Record) -> f64 {
    match r.metric(FAILED_SHARE_END) > 0.1 {
        true => -r.metric(UNACCOUNTED_ENERGY) / r.metric(FALLEN_ENERGY),
        false => f64::NAN,
    }
}

fn bands(r: &Record) -> String {
    let count = fixed(0).text(r.metric(SHEAR_BANDS_END));
    match r.metric(REARMOST_BAND_END) {
        rear if rear.is_finite() => format!("{count} ({})", fixed(1).text(rear)),
        _ => count,
    }
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
            let toe = fixed(2).text(r.metric(RUNOUT_2_5S));
            format!("{toe} ({:.2} s)", r.metric(FAILURE_TIME))
        }
        false => "stands".to_owned(),
    };
    ResultTable::of("landslide-studies", is_flip)
        .by(&[SCHEME, CELLS])
        .columns(SETS.map(|(title, set)| Column::text(title, text).of(move |r| r.set == set)))
}

pub(super) fn in_space() -> ResultTable {
    let spread = scientific(0);
    ResultTable::of("landslide-3d", |r| r.status == Status::Ok)
        .by(&[SCHEME, LEVEL, SET])
        .value("particles", |r| r.work.particles as f64, fixed(0))
        .metric("run-out at 2.5 s (m)", RUNOUT_2_5S, fixed(2))
        .metric("at the end (m)", RUNOUT_END, fixed(2))
        .metric("against plane strain (m)", OFF_PLANE_STRAIN_END, fixed(2).signed())
        .metric("fails at (s)", FAILURE_TIME, fixed(2))
        .metric("off plane strain at rest", OFF_PLANE_STRAIN_AT_REST, percent(3))
        .metric("at 0.5 s", OFF_PLANE_STRAIN_0_5S, percent(3))
        .metric("spread at rest", WIDTH_SPREAD_AT_REST, spread)
        .metric("at 0.5 s", WIDTH_SPREAD_0_5S, spread)
        .metric("at the end", WIDTH_SPREAD_END, spread)
        .cpu()
}
