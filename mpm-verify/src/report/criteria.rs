//! Tables over several cases: every remedy, and every space of the pressure, against every criterion; transfers and particles
//! per cell.

use super::prelude::*;
use crate::results::{
    Column, Format, Label, PAIR, ResultTable, SHORT, fixed, is_flip, order, percent, scientific, share,
};
use crate::scheme::TransferName;

/// The bases that are compared.
pub(super) const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
/// rms ln(J/J̄) beyond which particles have lost their order.
const DISORDER: f64 = 0.1;
/// The error that orders, prices and locking are those of.
const ERROR: &str = "displacement_l2";

/// Runs by case, level and changed parameters.
#[derive(Clone, Copy)]
struct Runs(&'static str, &'static str, &'static [&'static str]);

impl Runs {
    fn has(self, r: &Record) -> bool {
        r.case == self.0 && r.level == self.1 && r.set == self.2
    }

    /// A metric of them.
    fn shows(self, title: &str, metric: &'static str, format: Format) -> Column {
        Column::value(title, move |r| r.value(metric), format).of(move |r| self.has(r))
    }

    fn says(self, title: &str, text: fn(&Record) -> String) -> Column {
        Column::text(title, text).of(move |r| self.has(r))
    }

    fn cpu(self, title: &str) -> Column {
        Column::value(title, |r| r.time.cpu_s, fixed(2)).of(move |r| self.has(r))
    }

    /// The order of an error over all levels.
    fn order(self, title: &str, error: &'static str) -> Column {
        Column::row(title, move |own, _| {
            let runs = own.iter().filter(|r| r.case == self.0 && r.set == self.2);
            let of = order(runs.copied(), error);
            of.map_or_else(String::new, |order| order.to_string())
        })
    }

    /// The error over that of runs of the remedy that `remedy` gives.
    fn over(self, title: &str, other: Self, remedy: fn(&Record) -> RemedyName) -> Column {
        Column::row(title, move |own, all| {
            let Some(run) = own.iter().find(|r| self.has(r)) else {
                return String::new();
            };
            let is_other = |r: &&&Record| other.has(r) && r.remedy() == remedy(run);
            let other = all.iter().find(is_other).map_or(f64::NAN, |r| r.value(ERROR));
            SHORT.text(run.value(ERROR) / other)
        })
    }
}

/// Every remedy against every criterion, with a basis.
pub(super) fn remedies(basis: BasisName) -> ResultTable {
    const COLUMN: Runs = Runs("column", "h0.25", &["duration=5.04"]);
    const AXIS: Runs = Runs("mms-axis", "n32", &[]);
    const AXIS_H2: Runs = Runs("mms-axis", "n32", &["step_scaling=h2"]);
    const CROSSED: Runs = Runs("mms-axis", "n32", &["amplitude=0.02"]);
    const WALL: Runs = Runs("mms-wall-pressure", "n32", &[]);
    const WALL_H2: Runs = Runs("mms-wall-pressure", "n32", &["step_scaling=h2"]);
    const BOX: Runs = Runs("mms-vortex-box", "n32", &[]);
    const SOFT_BOX: Runs = Runs("mms-vortex-box", "n32", &["poisson_ratio=0.3"]);
    const COOK: Runs = Runs("cook", "h1", &[]);
    const WAVE: Runs = Runs("standing-wave", "n8", &["duration=24"]);
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
    let drift = "column, 5·10⁵ steps: drift of J̄ per 10⁵ steps";
    let growth = "… kinetic energy, last third over middle third";
    let price = "price: error over that of none, mms-axis n32";
    let crossed = "… with cells crossed (A = 0.02 m, 2 particles per direction)";
    let locking = "locking: error at ν = 0.4999 over 0.3, mms-vortex-box n32";
    let none = |_: &Record| RemedyName::None;
    let columns = [
        COLUMN.shows(drift, "j_drift_per_1e5_steps", SHORT),
        COLUMN.shows("… of J", "true_j_drift_per_1e5_steps", SHORT),
        COLUMN.shows(growth, "kinetic_growth", SHORT),
        AXIS.order("order, mms-axis, Δt ∝ h", ERROR),
        AXIS_H2.order("order, mms-axis, Δt ∝ h²", ERROR),
        WALL.order("order, mms-wall-pressure, Δt ∝ h", ERROR),
        WALL_H2.order("order, mms-wall-pressure, Δt ∝ h²", ERROR),
        AXIS.over(price, AXIS, none),
        CROSSED.over(crossed, CROSSED, none),
        BOX.over(locking, SOFT_BOX, Record::remedy),
        BOX.shows("spurious pressure there (Pa)", "mean_stress_l2", SHORT),
        COOK.says("Cook, h = 1 m: mid-edge error (%)", cook),
        WAVE.says("standing wave, 20 periods, n8", wave),
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
        over("APIC ×", |r| r.transfer() == TransferName::Apic && r.is_default()),
        over("XPIC(2) ×", |r| r.transfer() == TransferName::Xpic2 && r.is_default()),
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

/// Every space of the pressure against every criterion, with its cost.
fn spaces() -> ResultTable {
    const FIXED: Runs = Runs("terzaghi", "n40", &[]);
    const FIRST_STEP: Runs = Runs("terzaghi", "n20", &["first_step=0.25", "steps=1"]);
    const FINE: Runs = Runs("terzaghi", "n160", &[]);
    const PLATES: Runs = Runs("mandel", "n16", &[]);
    const MOVING: Runs = Runs("consolidation", "n16", &[]);
    const LOADED: Runs = Runs("consolidation", "n32", &["load=1"]);
    const SETTLED: Runs = Runs("consolidation", "n64", &[]);
    const CROSSING: Runs = Runs("mms-poro", "n32", &["amplitude=0.04"]);
    const UNDRAINED: Runs = Runs("undrained", "n32", &[]);
    let first_step = "… overshoot of a first step of c_v Δt/h² = 1/4";
    let centre = "mandel, ν = 0.25, n16: error of the pressure at the centre, over p₀";
    let (moving, loaded) =
        ("consolidation, 0.3 M₀, n16: error of the settlement", "… 1 M₀, n32: error of the settlement");
    let in_h = "… order in h";
    let short = scientific(2);
    let columns = [
        FIXED.shows("terzaghi, n40: error of p/q in space", "pressure_l2_steps", short),
        FIXED.order(in_h, "pressure_l2_steps"),
        FIRST_STEP.shows(first_step, "overshoot_first_step", percent(1)),
        PLATES.shows(centre, "centre_pressure_error", short),
        PLATES.order("… order in h, without that of steps", "centre_pressure_error_space"),
        MOVING.shows(moving, "settlement_error", share(2)),
        MOVING.order(in_h, "settlement_error_steps"),
        LOADED.shows(loaded, "settlement_error", share(2)),
        CROSSING.shows("mms-poro, A = 0.04 m, n32: error of u (m)", ERROR, short),
        CROSSING.order(in_h, ERROR),
        CROSSING.shows("… error of p", "pressure_l2", short),
        CROSSING.order(in_h, "pressure_l2"),
        UNDRAINED.shows("undrained, n32: Chapelle and Bathe's β", "inf_sup", fixed(3)),
        FINE.shows("entries of a matrix, terzaghi n160", "matrix_entries", fixed(0)),
        SETTLED.shows("… consolidation n64", "matrix_entries", fixed(0)),
        CROSSING.shows("… mms-poro n32", "matrix_entries", fixed(0)),
        FINE.cpu("CPU (s), terzaghi n160, 40 steps"),
        SETTLED.cpu("… consolidation n64, 500 steps"),
        CROSSING.cpu("… mms-poro n32"),
    ];
    const SPACE: Label = ("", |r| match r.scheme() {
        Scheme::Poro(parts) => parts.space.to_string(),
        _ => String::new(),
    });
    let shows = |r: &Record| matches!(r.scheme(), Scheme::Poro(_)) && r.basis() == BasisName::Gimp;
    ResultTable::new("pressure-spaces", shows, &[SPACE], columns).across()
}

/// All of them.
pub(super) fn all() -> Vec<ResultTable> {
    let remedies = BASES.into_iter().map(remedies);
    remedies.chain([transfers(), spaces()]).collect()
}
