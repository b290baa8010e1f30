//! Tables of its results.

use super::metrics as m;
use crate::record::Record;
use crate::results::{CELLS, Column, Label, ResultTable, SCHEME, SHORT, fixed, share};
use crate::scheme::RuleName;

pub(super) fn all() -> Vec<ResultTable> {
    vec![equilibria(), collapses(), balances()]
}

const CHANGED: Label = ("changed", |r| match r.set.is_empty() {
    true => "–".to_owned(),
    false => r.set.join(", "),
});

fn is_static(r: &Record) -> bool {
    r.scheme().rule() == Some(RuleName::QuasiStatic)
}

/// Whether a slope stands, in words.
fn stands(r: &Record) -> String {
    let carried = r.metric(m::GRAVITY_CARRIED);
    match [m::STANDS_UNCUT, m::STANDS_CUT].map(|metric| r.metric(metric)) {
        [0.0, _] if carried == 0.0 => "not in one step".to_owned(),
        [uncut, _] if uncut != 1.0 && carried < 1.0 => format!("up to {carried:.3} γ"),
        [0.0, _] => "falls whole".to_owned(),
        [1.0, 1.0] => "stands whole and cut".to_owned(),
        [1.0, 0.0] => "stands whole, falls cut".to_owned(),
        _ => "not told".to_owned(),
    }
}

/// Which slope has an equilibrium.
fn equilibria() -> ResultTable {
    let of = |level: &'static str| move |r: &Record| r.level == level;
    let columns = [
        ("h0.1", "h = 0.1 m"),
        ("h0.05", "0.05 m"),
        ("h0.025", "0.025 m"),
    ]
    .map(|(level, title)| Column::text(title, stands).of(of(level)));
    ResultTable::new(
        "excavation-equilibria",
        is_static,
        &[SCHEME, CHANGED],
        columns,
    )
}

/// What follows the excavation.
fn collapses() -> ResultTable {
    let columns = [
        Column::text("stands", stands),
        Column::metric("run-out (m)", m::RUNOUT_END, fixed(3)),
        Column::metric("crest sinks (m)", m::CREST_DROP, fixed(3)),
        Column::metric("band (m)", m::BAND_WIDTH, fixed(3)),
        Column::metric("E_kin at the end", m::KINETIC_END, share(2)),
        Column::cpu(),
    ];
    let moving = |r: &Record| !is_static(r);
    ResultTable::new(
        "excavation-collapses",
        moving,
        &[SCHEME, CHANGED, CELLS],
        columns,
    )
}

/// What is conserved.
fn balances() -> ResultTable {
    let columns = [
        Column::metric("(37) before the cut", m::FORCE_RATIO_UNCUT, SHORT),
        Column::metric("reaction off by", m::REACTION_ERROR, SHORT),
        Column::metric("energy off by", m::BALANCE_ERROR, SHORT),
        Column::metric("gained", m::ENERGY_GAIN, SHORT),
        Column::metric("momentum off by", m::MOMENTUM_ERROR, SHORT),
    ];
    let moving = |r: &Record| !is_static(r) && r.level == "h0.05";
    ResultTable::new("excavation-balances", moving, &[SCHEME, CHANGED], columns)
}
