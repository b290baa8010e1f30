//! Tables of errors and orders, and a picture, that several motions show.

use super::metrics::{DISPLACEMENT_L2, DISPLACEMENT_LINF, DISPLACEMENT_SCALE, MEAN_STRESS_L2, STRESS_L2, VELOCITY_L2};
use super::{CFL, COMPARED};
use crate::cases::prelude::*;

/// Title of a column, level of its run, and changed parameters, apart by spaces.
type At = (&'static str, &'static str, &'static str);

fn is_at(r: &Record, (_, level, set): At) -> bool {
    r.level == level && r.changes(set)
}

/// Error of u over the motion.
pub(in crate::cases) fn relative_error(r: &Record) -> f64 {
    r.metric(DISPLACEMENT_L2) / r.metric(DISPLACEMENT_SCALE)
}

/// Whether a run is one of an implicit ladder.
pub(in crate::cases) fn is_of_rule(r: &Record) -> bool {
    r.scheme().rule().is_some() && r.set == ["cfl=2"]
}

/// Whether functions are smooth, and a run's transfer has no choice or is FLIP.
pub(in crate::cases) fn is_smooth(r: &Record) -> bool {
    let judged = is_flip(r) || r.scheme().rule().is_some();
    judged && matches!(r.basis(), Gimp | Bspline2)
}

/// Errors at the finest level and orders over all levels, of runs that a row has one of at each level.
pub(in crate::cases) fn orders(name: &str, shows: fn(&Record) -> bool) -> ResultTable {
    let finest = |title, metric, format: Format| {
        Column::row(title, move |runs, _| format.text(runs.last().map_or(f64::NAN, |r| r.metric(metric))))
    };
    let levels = Column::row("levels", |runs, _| match runs {
        [first, .., last] => format!("{}–{}", first.level, last.level),
        runs => runs.iter().map(|r| &*r.level).collect(),
    });
    let columns = [
        levels,
        finest("error of u at the finest (m)", DISPLACEMENT_L2, scientific(2)),
        slope("order ± (between levels)", DISPLACEMENT_L2, true),
        slope("L∞ of u", DISPLACEMENT_LINF, false),
        slope("v", VELOCITY_L2, false),
        slope("σ", STRESS_L2, false),
        slope("σ_m", MEAN_STRESS_L2, false),
        finest("error of σ_m at the finest (Pa)", MEAN_STRESS_L2, SHORT),
    ];
    ResultTable::new(name, shows, &[SCHEME], columns)
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

/// The error of u with FLIP.
pub(in crate::cases) fn errors<const N: usize>(name: &str, at: [At; N]) -> ResultTable {
    at_places(name, DISPLACEMENT_L2, scientific(2), at)
}

/// The error of the mean stress (Pa) with FLIP and the case's own parameters.
pub(in crate::cases) fn pressure<const N: usize>(name: &str, levels: [&'static str; N]) -> ResultTable {
    at_places(name, MEAN_STRESS_L2, SHORT, levels.map(|n| (n, n, "")))
}

fn at_places<const N: usize>(name: &str, metric: Metric, format: Format, places: [At; N]) -> ResultTable {
    let column = |at: At| Column::metric(at.0, metric, format).of(move |r| is_at(r, at));
    ResultTable::new(name, is_flip, &[SCHEME], places.map(column)).least(2)
}

/// The error of u over that at ν = 0.3; not of the recursion, which fails otherwise.
pub(in crate::cases) fn locking<const N: usize>(name: &str, places: [At; N]) -> ResultTable {
    let column = |at: At| {
        Column::row(at.0, move |runs, _| {
            let error = |at| runs.iter().find(|r| is_at(r, at)).map(|r| r.metric(DISPLACEMENT_L2));
            match (error(at), error(("", at.1, "poisson_ratio=0.3"))) {
                (Some(error), Some(soft)) => fixed(2).text(error / soft),
                _ => String::new(),
            }
        })
    };
    ResultTable::new(name, |r| is_flip(r) && r.remedy() != FbarRecursive, &[SCHEME], places.map(column))
}

/// The errors of u and of the mean stress over those of no remedy on the same basis, at levels of a set of parameters.
pub(in crate::cases) fn price<const N: usize>(name: &str, levels: [&'static str; N], set: &'static str) -> ResultTable {
    let of_level = |level: &'static str| {
        [("u", DISPLACEMENT_L2), ("σ_m", MEAN_STRESS_L2)].map(|(symbol, metric)| {
            Column::row(format!("{level}: {symbol}"), move |runs, all| {
                let here = |r: &&&Record| r.level == level;
                let Some(run) = runs.iter().find(here) else { return String::new() };
                let none = |r: &&&Record| here(r) && r.remedy() == RemedyName::None;
                let same = |r: &&&Record| none(r) && r.basis() == run.basis();
                let error = all.iter().find(same).map_or(f64::NAN, |r| r.metric(metric));
                fixed(2).text(run.metric(metric) / error)
            })
        })
    };
    let shows = move |r: &Record| {
        let compared = [RemedyName::None, FbarRate, FbarConsistent];
        is_flip(r) && r.changes(set) && compared.contains(&r.remedy())
    };
    ResultTable::new(name, shows, &[SCHEME], levels.into_iter().flat_map(of_level))
}

/// Errors and what they cost, over solvers and their steps.
pub(in crate::cases) fn cost(name: &str, levels: [&'static str; 3], shows: fn(&Record) -> bool) -> ResultTable {
    let of_level = |level: &'static str| {
        let at = move |r: &Record| r.level == level;
        [
            Column::value(format!("{level}: steps"), |r| r.work.steps as f64, fixed(0)).of(at),
            Column::metric("error of u (m)", DISPLACEMENT_L2, scientific(1)).of(at),
            Column::value("CPU (s)", |r| r.time.cpu_s, fixed(2)).of(at),
        ]
    };
    let cfl: Label = ("CFL", |r| r.parameters.text(CFL));
    ResultTable::new(name, shows, &[SCHEME, cfl], levels.into_iter().flat_map(of_level))
}

/// Mean stress at the end of runs of one level in the plane, on a scale of ± `most` (Pa): standard, by rates, and ours.
pub(in crate::cases) fn mean_stress(gallery: &mut Gallery, level: &str, most: f64) -> Result<(), Error> {
    let mut panels = Vec::new();
    for scheme in pairs(&SMOOTH, &COMPARED) {
        let run = gallery
            .records
            .iter()
            .find(|r| r.level == level && r.is_default() && r.scheme() == scheme && r.status == Status::Ok);
        let Some(run) = run else { continue };
        panels.push(field_panel(run, &gallery.table(run, "particles.csv")?, scheme.title(), "mean_stress"));
    }
    let caption = format!("Mean stress of the particles at the end, at level {level}.");
    Fields::new(panels, "mean stress (Pa)", (-most, most)).columns(3).draw(gallery, "mean-stress", caption)
}
