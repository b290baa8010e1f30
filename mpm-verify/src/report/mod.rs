//! What is shown: pictures, tables, files for other programs.
//!
//! Everything here is made from records and CSV files on disk, never from a running simulation.

mod convergence;
mod cook;
pub mod describe;
pub mod diff;
mod drift;
#[cfg(test)]
mod fixture;
pub mod history;
mod html;
mod junit;
pub mod plot;
mod sketch;
mod style;
mod summary;
mod triptych;
pub mod watched;

use crate::error::Error;
use crate::files::write_json;
use crate::study::{Gathered, Summary};
use history::Night;
use std::path::Path;

/// Writes the pictures of every case, the CSV of everything plotted, `summary.json`, `summary.md`,
/// `junit.xml` and the pages: `index.html` and one per case; what has drifted from its golden below
/// `golden` is drawn beside it. With a night, it enters the history, and the trends are drawn.
///
/// # Errors
/// A record's files can't be read, or a picture can't be written.
pub fn write_report(
    gathered: &Gathered,
    summary: &Summary,
    golden: &Path,
    night: Option<&Night>,
    out: &Path,
) -> Result<(), Error> {
    let mut pictures = drift::draw(gathered, summary, golden, out)?;
    for study in &summary.cases {
        if study.case == "cook" {
            pictures.extend(cook::draw(study, gathered, out)?);
        }
        pictures.extend(convergence::draw(study, out)?);
    }
    if let Some(night) = night {
        pictures.extend(history::add(summary, night, out)?);
    }
    write_json(&out.join("summary.json"), summary)?;
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
