//! The particle field of a case's first run, kept as precisely as its picture shows it.

use super::measure::rounded;
use super::picture::{WIDTH, judged, small};
use super::*;
use crate::case::FieldView;
use crate::draw::{FieldFigure, FieldPanel, draw_fields, write_small_png};
use crate::files::snapshot_file;

/// Number of distinguishable pixels along the window and steps of the colour scale: half of one is the tolerance.
const PIXELS: f64 = 240.0;
const COLOURS: f64 = 16.0;
/// Columns of the file.
const COLUMNS: [&str; 4] = ["particle", "x (m)", "y (m)", "value"];

/// Files of the field and of its picture.
pub(super) fn files(root: &Path, case: &str) -> [PathBuf; 2] {
    ["csv", "png"].map(|e| root.join(format!("{case}-field.{e}")))
}

/// The table of a run in `folder` that has the field.
pub(super) fn table(view: &FieldView, folder: &Path) -> PathBuf {
    view.time.map_or_else(|| folder.join("particles.csv"), |time| snapshot_file(folder, time))
}

/// The particles of a run in the window: number in seeding order, position and value.
fn particles(view: &FieldView, folder: &Path) -> Result<Vec<[f64; 4]>, Error> {
    let path = table(view, folder);
    let table = Table::read(&path)?;
    let [xs, ys, values] = ["x", "y", view.value].map(|name| table.column(name));
    if values.len() != table.rows() {
        return Err(Error::file(&path, format!("no column {}", view.value)));
    }
    Ok((0..values.len()).map(|k| [k as f64, xs[k], ys[k], values[k]]).collect())
}

fn read(path: &Path) -> Result<Vec<[f64; 4]>, Error> {
    let table = Table::read_own(path)?;
    let columns = COLUMNS.map(|name| table.get(name).unwrap_or_default());
    if table.rows() == 0 || columns.iter().any(|c| c.len() != table.rows()) {
        return Err(Error::file(path, format!("not columns {COLUMNS:?}")));
    }
    Ok((0..table.rows()).map(|k| columns.map(|c| c[k])).collect())
}

/// Keeps the field of a run, whose outputs lie in `folder`, and its picture.
pub(super) fn bless(
    [file, picture]: &[PathBuf; 2],
    view: &FieldView,
    record: &Record,
    folder: &Path,
) -> Result<(), Error> {
    let [(left, right), (low, high)] = view.window;
    let shown = |p: &[f64; 4]| (left..=right).contains(&p[1]) && (low..=high).contains(&p[2]);
    let mut rows = particles(view, folder)?;
    rows.retain(shown);
    let column = |k: usize| {
        let digits = if k == 0 { 10 } else { 4 };
        (COLUMNS[k], rows.iter().map(|row| rounded(row[k], digits)).collect())
    };
    Table::of_columns([0, 1, 2, 3].map(column)).write(file)?;
    Ok(write_small_png(picture, &draw(view, record, &read(file)?)?)?)
}

/// Verdicts on the field of a run: each particle, and the picture, drawn from those that have not moved as they were kept.
pub(super) fn judge(
    [file, picture]: &[PathBuf; 2],
    view: &FieldView,
    record: &Record,
    folder: &Path,
    blessing: &str,
) -> Result<Vec<Verdict>, Error> {
    let metric = "particles of the field that differ";
    let mut rows = match read(file) {
        Ok(rows) => rows,
        Err(error) => return Ok(vec![mismatch(metric, &error.to_string())]),
    };
    let now = particles(view, folder)?;
    let [(left, right), (low, high)] = view.window;
    let pixel = f64::max(right - left, high - low) / PIXELS;
    let colour = (view.range.1 - view.range.0) / COLOURS;
    let mut moved = 0;
    for row in &mut rows {
        let found = now.get(row[0] as usize).copied().unwrap_or([row[0], f64::NAN, f64::NAN, f64::NAN]);
        let near = |k: usize, step: f64| (found[k] - row[k]).abs() <= step / 2.0;
        if !(near(1, pixel) && near(2, pixel) && near(3, colour)) {
            *row = found;
            moved += 1;
        }
    }
    let differ = of_drift(Finding::within(metric, f64::from(moved), 0.0, 0.0, blessing));
    Ok(vec![differ, judged("different pixels of the field", picture, draw(view, record, &rows), blessing)])
}

fn draw(view: &FieldView, record: &Record, rows: &[[f64; 4]]) -> Result<RgbImage, Error> {
    let grid = &record.discretisation;
    let panel = FieldPanel {
        title: String::new(),
        points: rows.iter().map(|row| (row[1], row[2])).collect(),
        values: rows.iter().map(|row| row[3]).collect(),
        size: grid.h / f64::from(grid.ppc).powf(1.0 / grid.dim as f64),
        outline: Vec::new(),
    };
    let window = Some((view.window[0], view.window[1]));
    let figure = FieldFigure { window, ..FieldFigure::single(panel, view.label.to_owned(), view.range) };
    small(WIDTH, |path| draw_fields(path, &figure))
}
