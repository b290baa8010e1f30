//! The pictures of one run by itself.

use super::prelude::*;
use super::words::number;
use super::{draw_own, owning};
use crate::draw::{FieldFigure, FieldPanel, domains, draw_charts, draw_fields};
use crate::record::Status;
use crate::run::series;
use crate::table::Table;

/// Draws what the case draws of the run in `folder` and, against time, what its readers should see first. The pictures
/// lie in a folder of the case's name.
///
/// # Errors
/// A file of the run is damaged, or a picture can't be written.
pub fn draw(case: &Case, record: &Record, folder: &Path) -> Result<Vec<Picture>, Error> {
    let study = CaseStudy::new(&record.case, vec![record.clone()]);
    let gathered = Gathered::single(record.clone(), folder);
    owning(folder, || {
        let (mut pictures, _) = draw_own(case, &study, &gathered, folder)?;
        pictures.extend(own(case, record, folder, folder)?);
        Ok(pictures)
    })
}

/// Draws the run in `folder`: its particles, and what it went through.
pub(super) fn own(case: &Case, record: &Record, folder: &Path, out: &Path) -> Result<Vec<Picture>, Error> {
    let mut pictures = fields(case, record, folder, out)?;
    pictures.extend(history(case, record, folder, out)?);
    Ok(pictures)
}

/// Draws the particles of a plane run in `folder` at its end, coloured by what its readers should see first; a scene also by
/// displacement and mean stress.
fn fields(case: &Case, record: &Record, folder: &Path, out: &Path) -> Result<Vec<Picture>, Error> {
    let path = folder.join("particles.csv");
    if !path.exists() || record.discretisation.dim != 2 {
        return Ok(Vec::new());
    }
    let (view, table) = (case.field, Table::read(&path)?);
    // Where ground has yielded the mechanism shows.
    let flows = bulk(table.column("plastic_strain")).is_some();
    let value = view.map_or(if flows { "plastic_strain" } else { "mean_stress" }, |view| view.value);
    let label = table.iter().map(|(header, _)| header).filter(|h| h.split(" (").next() == Some(value)).last();
    let own = |label: &str| ("particles", label.to_owned(), table.column(value).to_vec());
    let mut shown: Vec<_> = label.map(own).into_iter().collect();
    let moved = table.points("displacement_x", "displacement_y");
    let (d, places) = (&record.discretisation, table.points("x", "y"));
    let size = d.h / f64::from(d.ppc).sqrt();
    let from: Vec<_> = places.iter().zip(&moved).map(|(at, way)| (at.0 - way.0, at.1 - way.1)).collect();
    let domains = domains(&from, &places[..from.len()], table.column("body"), size);
    if !moved.is_empty() {
        let ways = moved.into_iter().map(|(x, y)| x.hypot(y)).collect();
        shown.push(("displacement", "displacement (m)".to_owned(), ways));
        let mean = table.column("mean_stress").to_vec();
        shown.extend((value != "mean_stress").then(|| ("mean-stress", "mean stress (Pa)".to_owned(), mean)));
    }
    let title = format!("{}, h = {} m", record.scheme().title(), number(Some(d.h)));
    // Title and lines belong to the end of a run: one that broke down before has neither.
    let (heading, around) = match record.status {
        Status::Ok => (case.heading.clone(), case.around.clone()),
        Status::Failed => Default::default(),
    };
    let mut pictures = Vec::new();
    for (name, label, values) in shown {
        let Some(range) = bulk(&values) else { continue };
        let panel = FieldPanel { title: title.clone(), points: places.clone(), values, size, outline: Vec::new() };
        let figure = FieldFigure {
            title: heading.clone(),
            window: view.map(|view| view.window.into()),
            domains: domains.clone(),
            around: around.clone(),
            ..FieldFigure::single(panel, label.replace('_', " "), range)
        };
        let file = format!("{}/{name}.png", record.case);
        draw_fields(&out.join(&file), &figure)?;
        pictures.push(Picture { file, caption: format!("{}: {name} at the end.", record.folder()) });
    }
    Ok(pictures)
}

/// The range of all values but those in the lowest and the highest hundredth; about zero where both signs occur.
fn bulk(values: &[f64]) -> Option<(f64, f64)> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted.get(sorted.len() / 100)?, sorted.get(sorted.len() * 99 / 100)?);
    let most = low.abs().max(high.abs());
    match low * high < 0.0 {
        true => Some((-most, most)),
        false if low < high => Some((*low, *high)),
        false => None,
    }
}

/// Draws the columns of the time series of the run in `folder` that its readers should see first, a chart each.
fn history(case: &Case, record: &Record, folder: &Path, out: &Path) -> Result<Option<Picture>, Error> {
    let path = folder.join(series::FILE);
    if !path.exists() || case.watched.is_empty() {
        return Ok(None);
    }
    let table = Table::read(&path)?;
    let chart = |name: &&str| {
        let (at, values) = (table.iter().next(), table.column(name).iter());
        let points = at.map_or(&[][..], |(_, at)| at).iter().copied().zip(values.copied()).collect();
        let label = table.iter().map(|(header, _)| header).filter(|h| h.split(" (").next() == Some(name)).last();
        Chart::new("", [table.abscissa(), label.unwrap_or(name)], vec![Series::line("", points, 0)])
    };
    let charts: Vec<Chart> = case.watched.iter().map(chart).collect();
    let file = format!("{}/history.png", record.case);
    if !charts.iter().any(Chart::shows_something) {
        return Ok(None);
    }
    draw_charts(&out.join(&file), &charts, charts.len().min(2))?;
    Ok(Some(Picture { file, caption: format!("{}: what the run went through.", record.folder()) }))
}
