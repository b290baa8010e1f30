//! Tables of its results.

use super::ELASTIC;
use super::metrics as m;
use super::parameters::{BARRIER, CONTACT, PENETRATION_RATE, UNDRAINED_STRENGTH, YOUNG_MODULUS};
use super::reference::{EXACT, elastic_slope, mean_stress_at, strength_ratio};
use crate::cases::family::{REMEDIES, transfers};
use crate::record::Record;
use crate::results::{Column, Label, PAIR, ResultTable, SCHEME, fixed, is_flip, order, percent};
use crate::scheme::{BasisName, RemedyName};

const CELLS: Label = ("h", cells);
const CHANGED: Label = ("changed", changed);

fn cells(r: &Record) -> String {
    r.level.replace('b', "B/")
}

fn changed(r: &Record) -> String {
    let word = |set: &String| {
        match &**set {
            "contact=barrier" => "barrier",
            "ppc_per_direction=4" => "4 × 4",
            "rough=false" => "smooth",
            "domain_width=3" => "3B × 3B",
            "domain_depth=3" => "",
            "penetration=0.0025" => "to 0.0025",
            "load_steps=40" => "40 steps",
            other => other,
        }
        .to_owned()
    };
    let words = r.set.iter().map(word).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join(", ")
}

/// N_c by its own width, which a barrier does not let know.
fn own(r: &Record) -> f64 {
    match r.parameters.is(CONTACT, BARRIER) {
        true => f64::NAN,
        false => r.metric(m::NC_EFFECTIVE),
    }
}

fn from_exact(r: &Record) -> f64 {
    own(r) / EXACT - 1.0
}

/// rms ln(J/J̄) of a remedy that makes J̄.
fn gap(r: &Record) -> f64 {
    match r.remedy() {
        RemedyName::None => f64::NAN,
        _ => r.metric(m::LOG_JACOBIAN_GAP),
    }
}

const COMPARED: [RemedyName; 4] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

fn is_main(r: &Record) -> bool {
    r.basis() != BasisName::Bspline3 && is_flip(r) && r.is_default() && r.level == "b20"
}

pub(super) fn all() -> Vec<ResultTable> {
    vec![
        ResultTable::by_remedy("footing", &COMPARED, is_main, |r| fixed(3).text(own(r))),
        results(),
        mean_stress(),
        rates(),
        slopes(),
        transfers("footing-transfers", &[PAIR, CELLS], &["4"], |r| {
            percent(2).text(from_exact(r))
        }),
        orders(),
    ]
}

fn results() -> ResultTable {
    ResultTable::new(
        "footing-results",
        |r| r.set != ELASTIC && !r.changes_only(PENETRATION_RATE.name),
        &[SCHEME, CELLS, CHANGED],
        [
            Column::metric("N_c by B", m::NC_B, fixed(3)),
            Column::metric("by B + h", m::NC_B_PLUS_H, fixed(3)),
            Column::value("by its own width", own, fixed(3)),
            Column::value("from 2 + π", from_exact, percent(1)),
            Column::metric("rise per 10⁻³", m::PLATEAU_RISE, percent(1)),
            Column::metric("mechanism (B)", m::MECHANISM_WIDTH, fixed(2)),
            Column::metric("heave", m::HEAVE, fixed(2)),
            Column::metric("checkerboard", m::CHECKERBOARD_RATIO, fixed(2)),
            Column::value("ln(J/J̄) rms (10⁻⁴)", gap, fixed(1).times(1e4)),
            Column::cpu(),
        ],
    )
}

fn mean_stress() -> ResultTable {
    let column = |(metric, point): (_, [f64; 2])| {
        let elements = mean_stress_at(point).map_or(String::new(), |s| {
            let value = fixed(2).text(s.value);
            format!("; elements: {value} ± {:.2}", s.uncertainty)
        });
        let title = format!("({}, {}) B{elements}", point[0], -point[1]);
        Column::metric(title, metric, fixed(2))
    };
    ResultTable::new(
        "footing-mean-stress",
        |r| is_flip(r) && r.is_default() && ["b20", "b40"].contains(&&*r.level),
        &[PAIR, CELLS],
        m::MEAN_STRESSES.iter().copied().map(column),
    )
}

/// Half and twice the case's own rate beside it.
fn rates() -> ResultTable {
    let rates = [("4", 4e-3), ("2", 2e-3), ("1", 1e-3)];
    let of = |rate: f64| move |r: &Record| r.parameters.number(PENETRATION_RATE) == rate;
    let load = rates.map(|(name, rate)| {
        let title = format!("{name}·10⁻³ m/s");
        Column::metric(title, m::NC_B, fixed(3)).of(of(rate))
    });
    let imbalance = rates.map(|(name, rate)| {
        let title = format!("imbalance of forces at {name}");
        Column::metric(title, m::FORCE_IMBALANCE, percent(1)).of(of(rate))
    });
    ResultTable::new(
        "footing-rates",
        |r| {
            let compared = [RemedyName::FbarRecursive, RemedyName::FbarConsistent];
            let own = r.is_default() || r.changes_only(PENETRATION_RATE.name);
            let main = r.basis() != BasisName::Bspline3 && compared.contains(&r.remedy());
            own && main && is_flip(r) && r.level == "b10"
        },
        &[("scheme, B/10", SCHEME.1)],
        load.into_iter().chain(imbalance),
    )
}

fn slopes() -> ResultTable {
    /// From q/s_u of a strength beyond reach to that of the reference.
    fn scale(r: &Record) -> f64 {
        let number = |p| r.parameters.number(p);
        number(UNDRAINED_STRENGTH) / number(YOUNG_MODULUS) / strength_ratio()
    }
    let found = |r: &Record| scale(r) * r.metric(m::ELASTIC_SLOPE);
    let expected = |r: &Record| elastic_slope(r).map_or(f64::NAN, |s| s / strength_ratio());
    ResultTable::new(
        "footing-slopes",
        |r| r.set == ELASTIC,
        &[SCHEME, CELLS],
        [
            Column::value("slope d(q/s_u)/d(s/B)", found, fixed(0)),
            Column::value("finite elements that act as wide", expected, fixed(0)),
            Column::value(
                "difference",
                move |r| found(r) / expected(r) - 1.0,
                percent(1),
            ),
        ],
    )
}

fn orders() -> ResultTable {
    // Errors on splines with F̄ are too small to fall with an order.
    let text = |runs: &[&Record], _: &[&Record]| {
        let gimp = runs
            .iter()
            .copied()
            .filter(|r| r.basis() == BasisName::Gimp);
        let found = order(gimp, m::PRANDTL_ERROR.name);
        found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
    };
    let levels = ["b10", "b20", "b40"].map(|level| {
        let title = level.replace('b', "B/");
        Column::metric(title, m::PRANDTL_ERROR, percent(1)).of(move |r| r.level == level)
    });
    let order = Column::row("order (between levels)", text);
    ResultTable::new(
        "footing-orders",
        |r| {
            let main = r.basis() != BasisName::Bspline3 && REMEDIES[1..].contains(&r.remedy());
            main && is_flip(r) && r.is_default()
        },
        &[SCHEME],
        levels.into_iter().chain([order]),
    )
}
