//! Tables of errors and orders of the motions with an exact solution.

use super::metrics::{
    DISPLACEMENT_L2, DISPLACEMENT_LINF, DISPLACEMENT_SCALE, MEAN_STRESS_L2, STRESS_L2, VELOCITY_L2,
};
use super::{CFL, STEP_POISSON_RATIO};
use crate::cases::parameters::POISSON_RATIO;
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::results::{
    Column, Format, Label, ResultTable, SCHEME, SHORT, fixed, is_flip, order, scientific, share,
};
use crate::scheme::{BasisName, RemedyName};

/// Changed parameters, as records name them.
type Set = &'static [&'static str];

/// A level and changed parameters.
type At = (&'static str, Set);

/// Those of a case.
pub(super) fn of(case: &'static str) -> Vec<ResultTable> {
    const SIX: [(&str, At); 6] = [
        ("n8, ν = 0.499", ("n8", &["poisson_ratio=0.499"])),
        ("n8, 0.4999", ("n8", &[])),
        ("n16, 0.499", ("n16", &["poisson_ratio=0.499"])),
        ("n16, 0.4999", ("n16", &[])),
        ("n32, 0.499", ("n32", &["poisson_ratio=0.499"])),
        ("n32, 0.4999", ("n32", &[])),
    ];
    let mut all = vec![orders(case, "orders", |r| r.is_default() && is_flip(r))];
    all.extend(match case {
        "mms-axis" => of_axis(),
        "mms-wall-pressure" => of_wall_pressure(),
        "mms-vortex-ring" => {
            const LARGE: Set = &["angle=0.7853981633974483"];
            let levels = ["n8", "n16", "n32"].map(|n| (n, (n, LARGE)));
            vec![errors(
                "mms-vortex-ring-large",
                DISPLACEMENT_L2,
                scientific(2),
                levels,
            )]
        }
        "mms-vortex-box" => vec![
            locking("mms-vortex-box-locking", SIX),
            price("mms-vortex-box-price", &LEVELS[..3], &["poisson_ratio=0.3"]),
            pressure("mms-vortex-box-pressure", LEVELS),
            limit("mms-vortex-box-limit"),
            cost("mms-vortex-box-cost", ["n8", "n16", "n32"], |r| {
                let remedies = [RemedyName::None, RemedyName::FbarConsistent];
                remedies.contains(&r.remedy()) && is_smooth(r) && r.changes_none_but(&[CFL.name])
            }),
        ],
        "mms-vortex-pressure" => {
            const RATIOS: [(&str, At); 6] = [
                ("n8, ν = 0.49", ("n8", &["poisson_ratio=0.49"])),
                ("n8, 0.499", ("n8", &[])),
                ("n8, 0.4999", ("n8", &["poisson_ratio=0.4999"])),
                ("n16, 0.49", ("n16", &["poisson_ratio=0.49"])),
                ("n16, 0.499", ("n16", &[])),
                ("n16, 0.4999", ("n16", &["poisson_ratio=0.4999"])),
            ];
            let levels = ["n8", "n16", "n32", "n64"];
            vec![
                locking("mms-vortex-pressure-locking", RATIOS),
                pressure("mms-vortex-pressure-pressure", levels),
            ]
        }
        "mms-double-shear" => vec![
            locking("mms-double-shear-locking", [SIX[1], SIX[3], SIX[5]]),
            pressure("mms-double-shear-pressure", ["n8", "n16", "n32", "n64"]),
        ],
        "mms-swirl" => vec![
            locking(
                "mms-swirl-locking",
                [("n8", ("n8", &[])), ("n16", ("n16", &[]))],
            ),
            pressure("mms-swirl-pressure", ["n8", "n16", "n32"]),
        ],
        _ => Vec::new(),
    });
    all
}

const LEVELS: [&str; 5] = ["n8", "n16", "n32", "n64", "n128"];

fn of_axis() -> Vec<ResultTable> {
    const TWO: Set = &["amplitude=0.02"];
    const FOUR: Set = &["amplitude=0.02", "ppc_per_direction=4"];
    let crossing = [
        ("n8, 2 per direction", ("n8", TWO)),
        ("n16", ("n16", TWO)),
        ("n32", ("n32", TWO)),
        ("n64", ("n64", TWO)),
        ("n8, 4 per direction", ("n8", FOUR)),
        ("n16", ("n16", FOUR)),
        ("n32", ("n32", FOUR)),
        ("n64", ("n64", FOUR)),
    ];
    let particles: [(&str, At); 4] = [
        ("1 per direction", ("n32", &["ppc_per_direction=1"])),
        ("2", ("n32", &[])),
        ("3", ("n32", &["ppc_per_direction=3"])),
        ("4", ("n32", &["ppc_per_direction=4"])),
    ];
    vec![
        orders("mms-axis", "rules", is_of_rule),
        cost("mms-axis-cost", ["n16", "n32", "n64"], |r| {
            r.remedy() == RemedyName::None && is_smooth(r) && r.changes_none_but(&[CFL.name])
        }),
        orders("mms-axis", "transfers", |r| r.is_default() && !is_flip(r)),
        price("mms-axis-price", &LEVELS, &[]),
        errors(
            "mms-axis-crossing",
            DISPLACEMENT_L2,
            scientific(2),
            crossing,
        ),
        errors(
            "mms-axis-particles",
            DISPLACEMENT_L2,
            scientific(2),
            particles,
        ),
    ]
}

fn of_wall_pressure() -> Vec<ResultTable> {
    const LARGE: Set = &["amplitude=0.05", "ppc_per_direction=4"];
    let levels = ["n8", "n16", "n32", "n64"].map(|n| (n, (n, LARGE)));
    vec![
        orders("mms-wall-pressure", "rules", is_of_rule),
        orders("mms-wall-pressure", "wall-line", |r| {
            r.set == ["wall=wall-line"] && is_flip(r)
        }),
        errors(
            "mms-wall-pressure-large",
            DISPLACEMENT_L2,
            scientific(2),
            levels,
        ),
    ]
}

/// Error over the motion, steps and cost at n16 towards incompressibility, at the CFL numbers of the case.
fn limit(name: &str) -> ResultTable {
    let ratios = [0.4999, 0.49999, 0.499999, 0.4999999];
    let relative = |r: &Record| r.metric(DISPLACEMENT_L2) / r.metric(DISPLACEMENT_SCALE);
    let of_ratio = |ratio: f64| {
        let at = move |r: &Record| r.parameters.number(POISSON_RATIO) == ratio;
        [
            Column::value(format!("ν = {ratio}"), relative, share(1)).of(at),
            Column::value("steps", |r| r.work.steps as f64, fixed(0)).of(at),
            Column::value("CPU (s)", |r| r.time.cpu_s, fixed(1)).of(at),
        ]
    };
    let shows = |r: &Record| {
        let set = [POISSON_RATIO.name, STEP_POISSON_RATIO.name, CFL.name];
        let remedies = [
            RemedyName::None,
            RemedyName::FbarRecursive,
            RemedyName::FbarConsistent,
        ];
        let own = is_flip(r) || r.set.iter().any(|s| s == "cfl=50");
        r.level == "n16"
            && r.changes_none_but(&set)
            && own
            && is_smooth(r)
            && remedies.contains(&r.remedy())
    };
    ResultTable::new(
        name,
        shows,
        &[SCHEME],
        ratios.into_iter().flat_map(of_ratio),
    )
}

/// Whether a run is one of an implicit ladder.
fn is_of_rule(r: &Record) -> bool {
    r.scheme().rule().is_some() && r.set == ["cfl=2"]
}

/// Whether functions are smooth, and a run's transfer has no choice or is FLIP.
fn is_smooth(r: &Record) -> bool {
    let judged = is_flip(r) || r.scheme().rule().is_some();
    judged && matches!(r.basis(), BasisName::Gimp | BasisName::Bspline2)
}

/// What errors cost, over solvers and their steps.
fn cost(name: &str, levels: [&'static str; 3], shows: fn(&Record) -> bool) -> ResultTable {
    let of_level = |level: &'static str| {
        let at = move |r: &Record| r.level == level;
        [
            Column::value(format!("{level}: steps"), |r| r.work.steps as f64, fixed(0)).of(at),
            Column::metric("error of u (m)", DISPLACEMENT_L2, scientific(1)).of(at),
            Column::value("CPU (s)", |r| r.time.cpu_s, fixed(2)).of(at),
        ]
    };
    let cfl: Label = ("CFL", |r| r.parameters.text(CFL));
    let columns = levels.into_iter().flat_map(of_level);
    ResultTable::new(name, shows, &[SCHEME, cfl], columns)
}

/// The error of the mean stress (Pa) with the case's own parameters.
fn pressure<const N: usize>(name: &str, levels: [&'static str; N]) -> ResultTable {
    errors(
        name,
        MEAN_STRESS_L2,
        SHORT,
        levels.map(|n| (n, (n, &[] as Set))),
    )
}

/// Errors at the finest level and orders over all levels, of runs that a row has one of at each level.
fn orders(case: &str, name: &str, shows: fn(&Record) -> bool) -> ResultTable {
    let levels = Column::row("levels", |runs, _| match runs {
        [first, .., last] => format!("{}–{}", first.level, last.level),
        runs => runs.iter().map(|r| &*r.level).collect(),
    });
    let columns = [
        levels,
        finest(
            "error of u at the finest (m)",
            DISPLACEMENT_L2,
            scientific(2),
        ),
        slope("order ± (between levels)", DISPLACEMENT_L2, true),
        slope("L∞ of u", DISPLACEMENT_LINF, false),
        slope("v", VELOCITY_L2, false),
        slope("σ", STRESS_L2, false),
        slope("σ_m", MEAN_STRESS_L2, false),
        finest("error of σ_m at the finest (Pa)", MEAN_STRESS_L2, SHORT),
    ];
    ResultTable::new(format!("{case}-{name}"), shows, &[SCHEME], columns)
}

fn finest(title: &str, metric: Metric, format: Format) -> Column {
    Column::row(title, move |runs, _| {
        let error = runs.last().map_or(f64::NAN, |r| r.metric(metric));
        format.text(error)
    })
}

/// The order, with its uncertainty and those between levels if asked for; of a row whose runs all came through.
fn slope(title: &str, metric: Metric, whole: bool) -> Column {
    Column::row(title, move |runs, _| {
        if runs.iter().any(|r| r.status == Status::Failed) {
            return "breaks down".to_owned();
        }
        match order(runs.iter().copied(), metric.name) {
            Some(found) if whole => format!("{found} ({})", found.between()),
            Some(found) => fixed(2).text(found.order),
            None => "–".to_owned(),
        }
    })
}

/// An error with FLIP, at levels and changed parameters, each with its title.
fn errors<const N: usize>(
    name: &str,
    metric: Metric,
    format: Format,
    at: [(&str, At); N],
) -> ResultTable {
    let column = |(title, (level, set)): (&str, At)| {
        Column::metric(title, metric, format).of(move |r| r.level == level && r.set == set)
    };
    ResultTable::new(name, is_flip, &[SCHEME], at.map(column)).least(2)
}

/// The error of u over that at ν = 0.3, with a title each; not of the recursion, which fails otherwise.
fn locking<const N: usize>(name: &str, at: [(&str, At); N]) -> ResultTable {
    let column = |(title, own): (&str, At)| {
        Column::row(title, move |runs, _| {
            let error = |(level, set): At| {
                let run = runs.iter().find(|r| r.level == level && r.set == set);
                run.map(|r| r.metric(DISPLACEMENT_L2))
            };
            match (error(own), error((own.0, &["poisson_ratio=0.3"]))) {
                (Some(error), Some(soft)) => fixed(2).text(error / soft),
                _ => String::new(),
            }
        })
    };
    let shows = |r: &Record| is_flip(r) && r.remedy() != RemedyName::FbarRecursive;
    ResultTable::new(name, shows, &[SCHEME], at.map(column))
}

/// The errors of u and of the mean stress over those of no remedy on the same basis, at levels of a set of parameters.
fn price(name: &str, levels: &[&'static str], set: Set) -> ResultTable {
    let of_level = |level: &'static str| {
        [("u", DISPLACEMENT_L2), ("σ_m", MEAN_STRESS_L2)].map(|(symbol, metric)| {
            Column::row(format!("{level}: {symbol}"), move |runs, all| {
                let here = |r: &&&Record| r.level == level;
                let Some(run) = runs.iter().find(here) else {
                    return String::new();
                };
                let none = |r: &&&Record| here(r) && r.remedy() == RemedyName::None;
                let same = |r: &&&Record| none(r) && r.basis() == run.basis();
                let error = all.iter().find(same).map_or(f64::NAN, |r| r.metric(metric));
                fixed(2).text(run.metric(metric) / error)
            })
        })
    };
    let shows = move |r: &Record| {
        let compared = [
            RemedyName::None,
            RemedyName::FbarRate,
            RemedyName::FbarConsistent,
        ];
        is_flip(r) && r.set == set && compared.contains(&r.remedy())
    };
    let columns: Vec<Column> = levels.iter().flat_map(|level| of_level(level)).collect();
    ResultTable::new(name, shows, &[SCHEME], columns)
}
