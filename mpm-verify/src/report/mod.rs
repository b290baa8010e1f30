//! What is shown: pictures, tables, files for other programs.
//!
//! Everything here is made from records and CSV files on disk, never from a running simulation.

mod convergence;
pub mod describe;
pub mod diff;
mod drift;
#[cfg(test)]
mod fixture;
pub mod history;
mod html;
mod junit;
pub mod keep;
mod price;
mod remedies;
mod rows;
pub mod shown;
mod summary;
mod sweep;
pub mod tables;

use crate::cases;
use crate::error::Error;
use crate::files::{discard, discard_all, discard_folder, write_dense_json};
use crate::gallery::{Gallery, Picture};
use crate::golden::Goldens;
use crate::night::Night;
use crate::record::Record;
use crate::study::gather::Gathered;
use crate::study::summary::{CaseStudy, Summary};
use std::path::Path;

const SUMMARY: &str = "summary.json";

/// Writes the pictures of every case, the CSV of everything plotted, `summary.json`, `summary.md`,
/// `junit.xml` and the pages: `index.html` and one per case; what has drifted from its golden
/// is drawn beside it. With a night, it enters the history, and the trends are drawn.
///
/// # Errors
/// A record's files can't be read, or a picture can't be written.
pub fn write_report(
    gathered: &Gathered,
    mut judged: Summary,
    goldens: &Goldens,
    night: Option<&Night>,
    out: &Path,
) -> Result<Summary, Error> {
    discard_report(out)?;
    for study in &mut judged.cases {
        study.night = night.cloned();
        study.pictures = draw(study, gathered, goldens, out)?;
    }
    summary::write(&judged, out)?;
    junit::write(&judged, out)?;
    html::write(&judged, out)?;
    // The sign that the report is whole.
    write_dense_json(&out.join(SUMMARY), &judged)?;
    Ok(judged)
}

/// Draws all pictures of a case.
fn draw(
    study: &CaseStudy,
    gathered: &Gathered,
    goldens: &Goldens,
    out: &Path,
) -> Result<Vec<Picture>, Error> {
    let mut pictures = drift::draw(study, gathered, goldens, out)?;
    pictures.extend(draw_own(study, gathered, out)?);
    pictures.extend(convergence::draw(study, out)?);
    pictures.extend(sweep::draw(study, out)?);
    if let Some(night) = &study.night {
        pictures.extend(history::add(study, night, out)?);
    }
    Ok(pictures)
}

/// Draws what only this case has.
fn draw_own(study: &CaseStudy, gathered: &Gathered, out: &Path) -> Result<Vec<Picture>, Error> {
    let folder = |r: &Record| gathered.folder(r).map(Path::to_path_buf);
    let mut gallery = Gallery::new(&study.case, &study.records, &folder, out);
    (cases::find(&study.case)?.pictures)(&mut gallery)?;
    Ok(gallery.pictures())
}

/// Removes an earlier report from `out`; runs, plan and history stay.
///
/// # Errors
/// A file is there and can't be removed.
pub fn discard_report(out: &Path) -> Result<(), Error> {
    for file in [SUMMARY, "summary.md", "junit.xml", "index.html"] {
        discard(&out.join(file))?;
    }
    for case in cases::all() {
        discard_case(case.name, out)?;
    }
    Ok(())
}

/// Removes from `out` what an earlier report has drawn and written of a case alone.
fn discard_case(name: &str, out: &Path) -> Result<(), Error> {
    discard(&out.join(format!("{name}.html")))?;
    for extension in ["png", "svg"] {
        discard(&out.join(format!("{}{name}.{extension}", history::TRENDS)))?;
    }
    let folder = out.join(name);
    discard_folder(&folder.join("drift"))?;
    discard(&folder.join("study.json"))?;
    discard_all(&folder, &["png", "svg", "csv"])
}
