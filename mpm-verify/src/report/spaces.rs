//! The spaces of the pressure over the cases of solid and water: each against each criterion, with its cost.

use crate::record::Record;
use crate::results::{Column, Label, ResultTable, fixed, order, percent, scientific, share};
use crate::scheme::{BasisName, Scheme};

/// Runs by case, level and changed parameters.
type Runs = (&'static str, &'static str, &'static [&'static str]);

const FIXED: Runs = ("terzaghi", "n40", &[]);
const FIRST_STEP: Runs = ("terzaghi", "n20", &["first_step=0.25", "steps=1"]);
const FINE: Runs = ("terzaghi", "n160", &[]);
const PLATES: Runs = ("mandel", "n16", &[]);
const MOVING: Runs = ("consolidation", "n16", &[]);
const LOADED: Runs = ("consolidation", "n32", &["load=1"]);
const SETTLED: Runs = ("consolidation", "n64", &[]);
const CROSSING: Runs = ("mms-poro", "n32", &["amplitude=0.04"]);
const UNDRAINED: Runs = ("undrained", "n32", &[]);

fn is(r: &Record, (case, level, set): Runs) -> bool {
    r.case == case && r.level == level && r.set == set
}

/// The table.
pub(super) fn table() -> ResultTable {
    let metric = |title: &str, runs: Runs, name: &'static str, format: crate::results::Format| {
        Column::text(title, move |r| format.text(r.value(name))).of(move |r| is(r, runs))
    };
    let orders = |title: &str, case: &'static str, error: &'static str, set: &'static [&str]| {
        Column::row(title, move |own, _| {
            let runs = own.iter().copied();
            let of = order(runs.filter(|r| r.case == case && r.set == set), error);
            of.map_or_else(String::new, |order| order.to_string())
        })
    };
    let cpu = |title: &str, runs: Runs| {
        Column::value(title, |r| r.time.cpu_s, fixed(2)).of(move |r| is(r, runs))
    };
    let (space, settlement) = ("pressure_l2_steps", "settlement_error_steps");
    let columns = [
        metric(
            "terzaghi, n40: error of p/q in space",
            FIXED,
            space,
            scientific(2),
        ),
        orders("… order in h", "terzaghi", space, &[]),
        metric(
            "… overshoot of a first step of c_v Δt/h² = 1/4",
            FIRST_STEP,
            "overshoot_first_step",
            percent(1),
        ),
        metric(
            "mandel, ν = 0.25, n16: error of the pressure at the centre, over p₀",
            PLATES,
            "centre_pressure_error",
            scientific(2),
        ),
        orders(
            "… order in h, without that of steps",
            PLATES.0,
            "centre_pressure_error_space",
            &[],
        ),
        metric(
            "consolidation, 0.3 M₀, n16: error of the settlement",
            MOVING,
            "settlement_error",
            share(2),
        ),
        orders("… order in h", "consolidation", settlement, &[]),
        metric(
            "… 1 M₀, n32: error of the settlement",
            LOADED,
            "settlement_error",
            share(2),
        ),
        metric(
            "mms-poro, A = 0.04 m, n32: error of u (m)",
            CROSSING,
            "displacement_l2",
            scientific(2),
        ),
        orders("… order in h", CROSSING.0, "displacement_l2", CROSSING.2),
        metric("… error of p", CROSSING, "pressure_l2", scientific(2)),
        orders("… order in h", CROSSING.0, "pressure_l2", CROSSING.2),
        metric(
            "undrained, n32: Chapelle and Bathe's β",
            UNDRAINED,
            "inf_sup",
            fixed(3),
        ),
        metric(
            "entries of a matrix, terzaghi n160",
            FINE,
            "matrix_entries",
            fixed(0),
        ),
        metric("… consolidation n64", SETTLED, "matrix_entries", fixed(0)),
        metric("… mms-poro n32", CROSSING, "matrix_entries", fixed(0)),
        cpu("CPU (s), terzaghi n160, 40 steps", FINE),
        cpu("… consolidation n64, 500 steps", SETTLED),
        cpu("… mms-poro n32", CROSSING),
    ];
    const SPACE: Label = ("", |r| match r.scheme() {
        Scheme::Poro(parts) => parts.space.to_string(),
        _ => String::new(),
    });
    let shows = |r: &Record| matches!(r.scheme(), Scheme::Poro(_)) && r.basis() == BasisName::Gimp;
    ResultTable::new("pressure-spaces", shows, &[SPACE], columns).across()
}
