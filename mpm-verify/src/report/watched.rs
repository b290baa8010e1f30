//! The watched columns of a time series, one chart each.

use crate::cases;
use crate::draw::{Chart, Dash, Marker, Scale, Series, draw_charts};
use crate::error::Error;
use crate::table::Table;
use image::RgbImage;

/// Draws the columns of a series that its case wants to be seen.
///
/// # Errors
/// The case is not known, the series lacks a watched column, or the picture can't be drawn.
pub fn draw_watched(case: &str, series: &Table) -> Result<RgbImage, Error> {
    let names = cases::find(case)?.watched;
    let (time, _) = series
        .iter()
        .next()
        .ok_or_else(|| Error::Input(format!("{case}: an empty series can't be drawn")))?;
    let charts: Vec<Chart> = names
        .iter()
        .map(|name| Chart {
            title: String::new(),
            x_label: time.to_owned(),
            y_label: series
                .iter()
                .map(|(header, _)| header)
                .find(|header| bare(header) == *name)
                .unwrap_or(name)
                .to_owned(),
            x_scale: Scale::Linear,
            y_scale: Scale::Linear,
            series: vec![Series {
                name: (*name).to_owned(),
                points: series.points(bare(time), name),
                colour: 0,
                marker: Marker::None,
                dash: Dash::Solid,
            }],
            reference_lines: Vec::new(),
            slope_triangle: None,
            x_range: None,
            y_range: None,
        })
        .collect();
    let folder = tempfile::tempdir().map_err(|e| Error::Input(format!("temporary folder: {e}")))?;
    let path = folder.path().join("watched.png");
    draw_charts(&path, &charts, charts.len())?;
    Ok(image::open(&path)
        .map_err(|e| Error::file(&path, e))?
        .to_rgb8())
}

/// The name of a column without its unit.
fn bare(column: &str) -> &str {
    column.split(" (").next().unwrap_or(column)
}
