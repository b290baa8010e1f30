//! Tables over several cases: every remedy against every criterion; transfers and particles per cell.

use crate::record::Record;
use crate::results::{Column, Label, PAIR, ResultTable, SHORT, fixed, is_flip, order};
use crate::scheme::{BasisName, RemedyName, TransferName};

/// The bases that are compared.
pub(super) const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
/// rms ln(J/J̄) beyond which particles have lost their order.
const DISORDER: f64 = 0.1;
/// The error that orders, prices and locking are those of.
const ERROR: &str = "displacement_l2";

/// Runs by case, level and changed parameters.
type Runs = (&'static str, &'static str, &'static [&'static str]);

const COLUMN: Runs = ("column", "h0.25", &["duration=5.04"]);
const AXIS: Runs = ("mms-axis", "n32", &[]);
const CROSSED: Runs = ("mms-axis", "n32", &["amplitude=0.02"]);
const BOX: Runs = ("mms-vortex-box", "n32", &[]);
const SOFT_BOX: Runs = ("mms-vortex-box", "n32", &["poisson_ratio=0.3"]);
const COOK: Runs = ("cook", "h1", &[]);
const WAVE: Runs = ("standing-wave", "n8", &["duration=24"]);

fn is(r: &Record, (case, level, set): Runs) -> bool {
    r.case == case && r.level == level && r.set == set
}

/// Every remedy against every criterion, with a basis.
pub(super) fn criteria(basis: BasisName) -> ResultTable {
    let metric = |title: &str, runs: Runs, name: &'static str| {
        Column::text(title, move |r| SHORT.text(r.value(name))).of(move |r| is(r, runs))
    };
    let orders = |title: &str, case: &'static str, set: &'static [&'static str]| {
        Column::row(title, move |own, _| {
            let runs = own.iter().copied();
            let of = order(runs.filter(|r| r.case == case && r.set == set), ERROR);
            of.map_or_else(String::new, |order| order.to_string())
        })
    };
    // Over runs of the same remedy, or of none.
    let ratio = |title: &str, runs: Runs, over: Runs, same: bool| {
        Column::row(title, move |own, all| {
            let Some(run) = own.iter().find(|r| is(r, runs)) else {
                return String::new();
            };
            let other = |r: &&&Record| match same {
                true => is(r, over) && r.remedy() == run.remedy(),
                false => is(r, over) && r.remedy() == RemedyName::None,
            };
            let other = all.iter().find(other).map_or(f64::NAN, |r| r.value(ERROR));
            SHORT.text(run.value(ERROR) / other)
        })
    };
    let cook = |r: &Record| {
        let error = fixed(2).times(100.0).text(r.value("fem_mid_edge_error"));
        match r.value("at_rest") == 1.0 {
            true => error,
            false => format!("{error}, never at rest"),
        }
    };
    let wave = |r: &Record| match r.value("log_jacobian_gap") > DISORDER {
        true => "in disorder".to_owned(),
        false => format!("frequency × {}", fixed(2).text(r.value("frequency_ratio"))),
    };
    let columns = [
        metric(
            "column, 5·10⁵ steps: drift of J̄ per 10⁵ steps",
            COLUMN,
            "j_drift_per_1e5_steps",
        ),
        metric("… of J", COLUMN, "true_j_drift_per_1e5_steps"),
        metric(
            "… kinetic energy, last third over middle third",
            COLUMN,
            "kinetic_growth",
        ),
        orders("order, mms-axis, Δt ∝ h", "mms-axis", &[]),
        orders("order, mms-axis, Δt ∝ h²", "mms-axis", &["step_scaling=h2"]),
        orders("order, mms-wall-pressure, Δt ∝ h", "mms-wall-pressure", &[]),
        orders(
            "order, mms-wall-pressure, Δt ∝ h²",
            "mms-wall-pressure",
            &["step_scaling=h2"],
        ),
        ratio(
            "price: error over that of none, mms-axis n32",
            AXIS,
            AXIS,
            false,
        ),
        ratio(
            "… with cells crossed (A = 0.02 m, 2 particles per direction)",
            CROSSED,
            CROSSED,
            false,
        ),
        ratio(
            "locking: error at ν = 0.4999 over 0.3, mms-vortex-box n32",
            BOX,
            SOFT_BOX,
            true,
        ),
        metric("spurious pressure there (Pa)", BOX, "mean_stress_l2"),
        Column::text("Cook, h = 1 m: mid-edge error (%)", cook).of(|r| is(r, COOK)),
        Column::text("standing wave, 20 periods, n8", wave).of(|r| is(r, WAVE)),
    ];
    const REMEDY: Label = ("", |r| r.remedy().to_string());
    let shows = move |r: &Record| is_flip(r) && r.basis() == basis;
    ResultTable::new(format!("remedies-{basis}"), shows, &[REMEDY], columns).across()
}

/// The error of u on 32 cells (16 in three dimensions), and by what factor another transfer or number of particles per
/// direction changes it.
fn transfers() -> ResultTable {
    const CASE: Label = ("case", |r| r.case.replace("mms-", ""));
    let own = |r: &Record| r.transfer() == TransferName::Flip && r.is_default();
    let error = |r: &Record| match 1e6 * r.value(ERROR) {
        x if x < 10.0 => fixed(2).text(x),
        x if x < 100.0 => fixed(1).text(x),
        x => fixed(0).text(x),
    };
    let over = move |title: &str, of: fn(&Record) -> bool| {
        Column::row(title, move |runs, _| {
            let first = |of: &dyn Fn(&Record) -> bool| runs.iter().find(|r| of(r));
            let (Some(run), Some(own)) = (first(&of), first(&own)) else {
                return String::new();
            };
            fixed(2).text(run.value(ERROR) / own.value(ERROR))
        })
    };
    let columns = [
        Column::text("FLIP, 2 per direction (µm)", error).of(own),
        over("APIC ×", |r| {
            r.transfer() == TransferName::Apic && r.is_default()
        }),
        over("XPIC(2) ×", |r| {
            r.transfer() == TransferName::Xpic2 && r.is_default()
        }),
        over("3 per direction ×", |r| r.set == ["ppc_per_direction=3"]),
        over("4 ×", |r| r.set == ["ppc_per_direction=4"]),
    ];
    let shows = |r: &Record| {
        let level = if r.case == "mms-swirl" { "n16" } else { "n32" };
        let pair = [RemedyName::None, RemedyName::FbarConsistent].contains(&r.remedy());
        r.case.starts_with("mms-") && r.level == level && pair && BASES.contains(&r.basis())
    };
    ResultTable::new("transfers-and-particles", shows, &[CASE, PAIR], columns)
}

/// All of them.
pub(super) fn all() -> Vec<ResultTable> {
    let criteria = BASES.into_iter().map(criteria);
    criteria.chain([transfers()]).collect()
}
