//! The numbers behind charts of curves.

use crate::draw::Chart;
use crate::error::Error;
use crate::files::write_csv;
use std::path::Path;

/// Writes every point of every curve: chart, quantity, series, abscissa, ordinate.
///
/// # Errors
/// The file can't be written.
pub(super) fn write_curves(file: &Path, charts: &[Chart]) -> Result<(), Error> {
    let abscissa = charts.first().map_or("", |chart| &chart.x_label);
    let header = ["chart", "quantity", "series", abscissa, "value"].map(str::to_owned);
    let rows = charts.iter().flat_map(|chart| {
        chart.series.iter().flat_map(move |s| {
            s.points.iter().map(move |(x, y)| {
                let cells = [chart.title.clone(), chart.y_label.clone(), s.name.clone()];
                let numbers = [format!("{x:.6}"), format!("{y:.6}")];
                [&cells[..], &numbers[..]].concat()
            })
        })
    });
    write_csv(file, &header, rows)
}
