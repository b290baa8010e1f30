//! What is shown: pictures, tables, files for other programs.
//!
//! Everything here is made from records and CSV files on disk, never from a running simulation.

mod convergence;
mod cook;
pub mod describe;
#[cfg(test)]
mod fixture;
mod html;
mod junit;
pub mod plot;
mod sketch;
mod style;
mod summary;
mod table;

use crate::error::Error;
use crate::study::Summary;
use std::path::Path;

/// Writes the pictures of every case, the CSV of everything plotted, `summary.md`, `junit.xml` and the
/// pages: `index.html` and one per case.
///
/// # Errors
/// A record's files can't be read, or a picture can't be written.
pub fn write_report(summary: &Summary, out: &Path) -> Result<(), Error> {
    let mut pictures = Vec::new();
    for study in &summary.cases {
        if study.case == "cook" {
            pictures.extend(cook::draw(study, out)?);
        }
        pictures.extend(convergence::draw(study, out)?);
    }
    summary::write(summary, &pictures, out)?;
    junit::write(summary, out)?;
    html::write(summary, &pictures, out)
}

/// A picture of the report.
struct Picture {
    /// File below the report's folder.
    file: String,
    /// What it shows.
    caption: String,
}
