//! What is shown: pictures, tables, files for other programs.
//!
//! Everything here is made from records and CSV files on disk, never from a running simulation.

mod column;
mod convergence;
mod cook;
pub mod describe;
pub mod diff;
mod drift;
#[cfg(test)]
pub(crate) mod fixture;
mod footing;
pub mod history;
mod html;
mod junit;
pub mod plot;
mod remedies;
mod sketch;
mod style;
mod summary;
mod sweep;
pub(crate) mod triptych;
pub mod watched;

use crate::cases;
use crate::error::Error;
use crate::files::{discard, discard_all, discard_folder, write_dense_json};
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
    discard_report(out)?;
    let mut pictures = drift::draw(gathered, summary, golden, out)?;
    for study in &summary.cases {
        match study.case.as_str() {
            "column" => pictures.extend(column::draw(study, gathered, out)?),
            "cook" => pictures.extend(cook::draw(study, gathered, out)?),
            "footing" => pictures.extend(footing::draw(study, gathered, out)?),
            _ => {}
        }
        pictures.extend(convergence::draw(study, out)?);
        pictures.extend(sweep::draw(study, out)?);
    }
    if let Some(night) = night {
        pictures.extend(history::add(summary, night, out)?);
    }
    summary::write(summary, &pictures, out)?;
    junit::write(summary, out)?;
    html::write(summary, &pictures, out)?;
    // The sign that the report is whole.
    write_dense_json(&out.join("summary.json"), summary)
}

/// Removes an earlier report from `out`; runs, plan and history stay.
///
/// # Errors
/// A file is there and can't be removed.
pub fn discard_report(out: &Path) -> Result<(), Error> {
    for file in ["summary.json", "summary.md", "junit.xml", "index.html"] {
        discard(&out.join(file))?;
    }
    for case in cases::all() {
        let name = case.name();
        discard(&out.join(format!("{name}.html")))?;
        discard(&out.join(format!("{}{name}.png", history::TRENDS)))?;
        let folder = out.join(name);
        discard_folder(&folder.join("drift"))?;
        discard(&folder.join("study.json"))?;
        discard_all(&folder, &["png", "csv"])?;
    }
    Ok(())
}

/// A picture of the report.
struct Picture {
    /// File below the report's folder.
    file: String,
    /// What it shows.
    caption: String,
}
