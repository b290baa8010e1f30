//! The pictures of one run by itself.

use super::prelude::*;
use super::{draw_own, own_page, owning};
use crate::draw::{FieldFigure, FieldPanel, SolidFigure, SolidPanel};
use crate::draw::{animate_fields, domains, draw_charts, draw_fields, draw_solids};
use crate::table::Table;

/// Hundredths of a second that a frame of an animation is shown.
const DELAY: u16 = 12;

/// Draws what the case draws of the run in `folder` and, against time, what its readers should see first; and its page. The
/// pictures lie in a folder of the case's name. A scene in the plane is `animated`, if that is asked for.
///
/// # Errors
/// A file of the run is damaged, or a picture can't be written.
pub fn draw(case: &Case, record: &Record, folder: &Path, animated: bool) -> Result<Vec<Picture>, Error> {
    let study = CaseStudy::new(&record.case, vec![record.clone()]);
    let gathered = Gathered::single(record.clone(), folder);
    owning(folder, || {
        let (mut pictures, _) = draw_own(case, &study, &gathered, folder)?;
        pictures.extend(own(case, record, folder, folder)?);
        if animated {
            pictures.extend(motion(case, record, folder)?);
        }
        own_page::write(case, record, &pictures, folder)?;
        Ok(pictures)
    })
}

/// Draws the run in `folder`: its particles, and what it went through.
pub(super) fn own(case: &Case, record: &Record, folder: &Path, out: &Path) -> Result<Vec<Picture>, Error> {
    let mut pictures = fields(case, record, folder, out)?;
    pictures.extend(history(case, record, folder, out)?);
    Ok(pictures)
}

/// Share of the larger end of a range above which the other one, of the other sign, makes it go as far to both sides.
const BOTH: f64 = 0.2;
/// Stress (Pa) from which a colour scale is in kPa.
const MANY: f64 = 1e4;

/// A field of the particles: its name in pictures, its column and its label.
type Field = (&'static str, &'static str, String);

/// The fields of particles that are drawn: what the readers of a case should see first; of a scene also displacement, mean
/// stress and velocity.
fn shown(case: &Case, table: &Table) -> Vec<Field> {
    // Where ground has yielded the mechanism shows.
    let flows = bulk(table.column("plastic_strain")).is_some();
    let first = case.field.map_or(if flows { "plastic_strain" } else { "mean_stress" }, |view| view.value);
    let label = |value: &str| {
        let headers = table.iter().map(|(header, _)| header);
        headers.filter(|h| h.split(" (").next() == Some(value)).last().map(|header| header.replace('_', " "))
    };
    let mut all: Vec<Field> = label(first).map(|label| ("particles", first, label)).into_iter().collect();
    if case.scenery.is_some() {
        all.push(("displacement", "displacement", "displacement (m)".to_owned()));
        if first != "mean_stress" {
            all.extend(label("mean_stress").map(|label| ("mean-stress", "mean_stress", label)));
        }
        all.push(("velocity", "velocity", "velocity (m/s)".to_owned()));
    }
    all
}

/// Values of a column; of a vector its norm; no plastic strain of bodies that have nowhere yielded, which are grey.
fn values(table: &Table, column: &str) -> Vec<f64> {
    match column {
        "displacement" | "velocity" => {
            let parts = ["x", "y", "z"].map(|axis| table.column(&format!("{column}_{axis}")));
            let square = |k: usize| parts.iter().filter_map(|part| part.get(k)).map(|x| x * x).sum::<f64>();
            (0..parts[0].len()).map(|k| square(k).sqrt()).collect()
        }
        "plastic_strain" => {
            let (strain, bodies) = (table.column(column), table.column("body"));
            let body = |k: usize| bodies.get(k).map(|body| body.to_bits());
            let yielded: BTreeSet<_> = (0..strain.len()).filter(|k| strain[*k] > 0.0).map(body).collect();
            (0..strain.len()).map(|k| if yielded.contains(&body(k)) { strain[k] } else { f64::NAN }).collect()
        }
        _ => table.column(column).to_vec(),
    }
}

/// A figure of a field of the particles in a table.
fn figure(
    case: &Case,
    record: &Record,
    table: &Table,
    (_, column, label): &Field,
    range: (f64, f64),
    time: Option<f64>,
) -> FieldFigure {
    let (d, points) = (&record.discretisation, table.points("x", "y"));
    let size = d.h / f64::from(d.ppc).sqrt();
    let moved = table.points("displacement_x", "displacement_y");
    let from: Vec<_> = points.iter().zip(&moved).map(|(at, way)| (at.0 - way.0, at.1 - way.1)).collect();
    let domains = domains(&from, &points[..from.len()], table.column("body"), size);
    let (label, unit) = unit(label, range);
    let values = values(table, column).into_iter().map(|x| unit * x).collect();
    let panel = FieldPanel { title: panel_title(record), points, values, size, outline: Vec::new() };
    let scene = case.scenery.as_ref().zip(time);
    FieldFigure {
        title: scene.map_or(String::new(), |(scene, time)| (scene.heading)(time)),
        window: case.field.map(|view| view.window.into()),
        domains,
        around: scene.map_or(Vec::new(), |(scene, time)| (scene.around)(time)),
        ..FieldFigure::single(panel, label, (unit * range.0, unit * range.1))
    }
}

fn panel_title(record: &Record) -> String {
    format!("{}, h = {} m", record.scheme().title(), number(Some(record.discretisation.h)))
}

/// The label of a colour scale and its unit over that of the column: kilopascals of large stresses.
fn unit(label: &str, range: (f64, f64)) -> (String, f64) {
    let large = range.0.abs().max(range.1.abs()) >= MANY;
    let label = label.replace("mean stress", "mean stress, tension positive");
    if large && label.ends_with("(Pa)") { (label.replace("(Pa)", "(kPa)"), 1e-3) } else { (label, 1.0) }
}

/// A figure of a field of the particles of a scene in space, whose y points up.
fn solid(record: &Record, table: &Table, (_, column, label): &Field, range: (f64, f64), title: String) -> SolidFigure {
    let axes = ["x", "y", "z"].map(|axis| table.column(axis));
    let d = &record.discretisation;
    let size = d.h / f64::from(d.ppc).cbrt();
    let (label, unit) = unit(label, range);
    let reach = |axis: &[f64]| {
        let ends = axis.iter().filter(|x| x.is_finite());
        ends.fold((f64::MAX, f64::MIN), |(lo, hi), x| (lo.min(x - 0.5 * size), hi.max(x + 0.5 * size)))
    };
    let panel = SolidPanel {
        title: panel_title(record),
        points: (0..table.rows()).map(|k| axes.map(|axis| axis[k])).collect(),
        values: values(table, column).into_iter().map(|x| unit * x).collect(),
        size,
    };
    let range = (unit * range.0, unit * range.1);
    SolidFigure { title, panels: vec![panel], columns: 1, range, label, window: axes.map(reach) }
}

/// Draws the particles of a run in `folder` at its end, in the plane, or in space where y points up.
fn fields(case: &Case, record: &Record, folder: &Path, out: &Path) -> Result<Vec<Picture>, Error> {
    let path = folder.join("particles.csv");
    let (dimension, scene) = (record.discretisation.dim, case.scenery.as_ref());
    let stands = dimension == 3 && scene.is_some_and(|scene| scene.up == 1);
    if !path.exists() || !(dimension == 2 || stands) {
        return Ok(Vec::new());
    }
    let table = Table::read(&path)?;
    let time = scene.map(|scene| record.error.as_ref().map_or(scene.end, |failure| failure.time));
    let mut pictures = Vec::new();
    for field in shown(case, &table) {
        let Some(range) = bulk(&values(&table, field.1)) else { continue };
        let file = format!("{}/{}.png", record.case, field.0);
        let heading = scene.zip(time).map_or(String::new(), |(scene, time)| (scene.heading)(time));
        match dimension {
            3 => draw_solids(&out.join(&file), &solid(record, &table, &field, range, heading))?,
            _ => draw_fields(&out.join(&file), &figure(case, record, &table, &field, range, time))?,
        }
        let caption = match case.scenery {
            Some(_) => format!("{} at the end.", sentence_case(&field.2)),
            None => format!("{}: {} at the end.", record.folder(), field.0),
        };
        pictures.push(Picture { file, caption });
    }
    Ok(pictures)
}

/// Draws the snapshots of a scene in the plane one after the other, by the first of its fields.
fn motion(case: &Case, record: &Record, folder: &Path) -> Result<Option<Picture>, Error> {
    let files = files_in(&folder.join(SNAPSHOTS), &["csv"])?;
    let time = |file: &PathBuf| file.file_stem().and_then(|stem| stem.to_str()?.parse::<f64>().ok());
    let (times, files): (Vec<f64>, Vec<PathBuf>) = files.into_iter().filter_map(|f| Some((time(&f)?, f))).unzip();
    let tables = files.iter().map(|file| Table::read(file)).collect::<Result<Vec<_>, _>>()?;
    let Some(field) = tables.last().and_then(|last| shown(case, last).into_iter().next()) else { return Ok(None) };
    let all: Vec<f64> = tables.iter().flat_map(|table| values(table, field.1)).collect();
    let Some(range) = bulk(&all).filter(|_| record.discretisation.dim == 2) else { return Ok(None) };
    let places: Vec<_> = tables.iter().flat_map(|table| table.points("x", "y")).collect();
    let reach = |of: fn(&(f64, f64)) -> f64| {
        let along = || places.iter().map(of).filter(|x| x.is_finite());
        (along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max))
    };
    let window = Some((reach(|at| at.0), reach(|at| at.1)));
    let frame = |(table, time): (&Table, &f64)| FieldFigure {
        window,
        ..figure(case, record, table, &field, range, Some(*time))
    };
    let frames: Vec<FieldFigure> = tables.iter().zip(&times).map(frame).collect();
    let file = format!("{}/motion.png", record.case);
    animate_fields(&folder.join(&file), &frames, DELAY)?;
    Ok(Some(Picture { file, caption: format!("{} in motion.", sentence_case(&field.2)) }))
}

/// With a capital.
fn sentence_case(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The range of all values but those in the lowest and the highest hundredth, and zero.
fn bulk(values: &[f64]) -> Option<(f64, f64)> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted.get(sorted.len() / 100)?, sorted.get(sorted.len() * 99 / 100)?);
    let (most, least) = (low.abs().max(high.abs()), low.abs().min(high.abs()));
    match low * high < 0.0 && least > BOTH * most {
        true => Some((-most, most)),
        false if low < high => Some((low.min(0.0), high.max(0.0))),
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
        let label = label.unwrap_or(name).replace('_', " ");
        Chart::new("", [table.abscissa(), &label], vec![Series::line("", points, 0)])
    };
    let changes = |name: &&&str| table.column(name).iter().any(|x| *x != 0.0);
    let charts: Vec<Chart> = case.watched.iter().filter(changes).map(chart).collect();
    let file = format!("{}/history.png", record.case);
    if !charts.iter().any(Chart::shows_something) {
        return Ok(None);
    }
    draw_charts(&out.join(&file), &charts, charts.len().min(2))?;
    let caption = match case.scenery {
        Some(_) => "The run over time.".to_owned(),
        None => format!("{}: what the run went through.", record.folder()),
    };
    Ok(Some(Picture { file, caption }))
}
