//! The pictures of the column, beside Figures 5 and 6 of the paper.

use super::checks::first_step;
use super::metrics::OVERSHOOT_FIRST_STEP;
use super::parameters::{LOAD, STEPS, TIME_END};
use super::scene::{HEIGHT, projection, steps};
use crate::draw::style::{history, series};
use crate::draw::{Chart, Dash, Series, draw_charts};
use crate::error::Error;
use crate::exact::terzaghi::{self, FirstStep};
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, Scheme, SpaceName};

/// Points of a curve.
const POINTS: u32 = 100;

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    figures(gallery)?;
    overshoots(gallery)
}

fn is_linear(r: &Record) -> bool {
    r.basis() == BasisName::Linear && r.status == Status::Ok
}

fn is_single(r: &Record) -> bool {
    is_linear(r) && r.parameters.number(STEPS) == 1.0
}

/// Hangs charts, if there are any.
fn hang(gallery: &mut Gallery, name: &str, charts: &[Chart], caption: &str) -> Result<(), Error> {
    if charts.is_empty() {
        return Ok(());
    }
    gallery.write_curves(&format!("{name}.csv"), charts)?;
    let file = format!("{name}.png");
    draw_charts(&gallery.place(&file), charts, charts.len())?;
    gallery.hang(&file, caption);
    Ok(())
}

/// p after a first step of T = 4·10⁻⁵, and how long its overshoot lasts.
fn figures(gallery: &mut Gallery) -> Result<(), Error> {
    let mut charts = profiles(gallery)?;
    charts.extend(persistence(gallery)?);
    hang(
        gallery,
        "figures",
        &charts,
        "Pressure at the particles after one step of T = 4·10⁻⁵, c_v Δt/h² = 0.016 and 1.02, and how its overshoot fades in \
         growing steps; the paper's Figures 5 and 6.",
    )
}

/// p over the depth after a first step of T = 4·10⁻⁵, on coarse and on fine cells: Figure 5.
fn profiles(gallery: &Gallery) -> Result<Vec<Chart>, Error> {
    let mut charts = Vec::new();
    for (level, title) in [("n20", "20 cells"), ("n160", "160 cells")] {
        let own = |r: &&Record| {
            let t = steps(r.discretisation.h, &r.parameters).0;
            is_single(r) && r.level == level && (t - 4e-5).abs() < 1e-12
        };
        let mut curves = Vec::new();
        for record in gallery.records.iter().filter(own) {
            let table = gallery.table(record, "particles.csv")?;
            let load = record.parameters.number(LOAD);
            let points = table.points("reference_x", "pore_pressure").into_iter();
            let points = points.map(|(x, p)| (HEIGHT - x, p / load)).collect();
            curves.push(series(record.scheme(), points));
        }
        if curves.is_empty() {
            continue;
        }
        let exact = (0..=POINTS).map(|k| {
            let z = 0.25 * f64::from(k) / f64::from(POINTS);
            (z, terzaghi::pressure(z, 4e-5))
        });
        curves.push(Series {
            name: "exact".to_owned(),
            colour: 6,
            dash: Dash::Dotted,
            ..history(
                Scheme::poro(BasisName::Linear, SpaceName::TwoGrid),
                exact.collect(),
            )
        });
        charts.push(Chart {
            title: title.to_owned(),
            x_range: Some((0.0, 0.25)),
            ..Chart::new("", ["depth (m)", "p/q"], curves)
        });
    }
    Ok(charts)
}

/// How long the overshoot of that step lasts: the magnification of Figure 6.
fn persistence(gallery: &Gallery) -> Result<Option<Chart>, Error> {
    let own =
        |r: &&Record| is_linear(r) && r.level == "n20" && r.parameters.number(TIME_END) == 1.0;
    let mut curves = Vec::new();
    for record in gallery.records.iter().filter(own) {
        let table = gallery.table(record, "series.csv")?;
        let points = table.points("time_factor", "overshoot").into_iter();
        let points = points.map(|(t, o)| (t.log10(), 100.0 * o)).collect();
        curves.push(history(record.scheme(), points));
    }
    if curves.is_empty() {
        return Ok(None);
    }
    Ok(Some(Chart {
        title: "20 cells, growing steps".to_owned(),
        ..Chart::new("", ["log₁₀ T", "largest p/q − 1 (%)"], curves)
    }))
}

/// The overshoot over the first step: runs on the closed forms.
fn overshoots(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| is_single(r) && r.level == "n20";
    let runs: Vec<&Record> = gallery.records.iter().filter(own).collect();
    let mut curves = Vec::new();
    for space in [SpaceName::TwoGrid, SpaceName::Equal, SpaceName::Ppp] {
        let scheme = Scheme::poro(BasisName::Linear, space);
        let of = |r: &&&Record| r.scheme() == scheme;
        let Some(first) = runs.iter().find(of) else {
            continue;
        };
        let points = runs.iter().filter(of).filter_map(|r| {
            let (_, _, share) = first_step(r)?;
            Some((share, 100.0 * r.metric(OVERSHOOT_FIRST_STEP)))
        });
        let mut points: Vec<(f64, f64)> = points.collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let cells = (HEIGHT / first.discretisation.h).round() as u32;
        let strength = projection(scheme, &first.parameters);
        let closed = (0..=POINTS).map(|k| {
            let share = f64::from(k) / f64::from(POINTS);
            let overshoot = match space {
                SpaceName::TwoGrid => FirstStep::two_grid(share).overshoot(cells / 2),
                _ => FirstStep::same_cells(share, strength).overshoot(cells),
            };
            (share, 100.0 * overshoot)
        });
        curves.push(Series {
            name: format!("{space}, closed form"),
            ..history(scheme, closed.collect())
        });
        curves.push(Series {
            name: space.to_string(),
            dash: Dash::Dotted,
            ..series(scheme, points)
        });
    }
    if curves.is_empty() {
        return Ok(());
    }
    let charts = [Chart::new("", ["c_v Δt/h²", "largest p/q − 1 (%)"], curves)];
    hang(
        gallery,
        "overshoot",
        &charts,
        "Overshoot of the first step on 20 cells, and its closed form.",
    )
}
