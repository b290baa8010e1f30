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
pub mod single;
mod solvers;
mod speed;
mod summary;
mod sweep;
pub mod tables;
mod values;
mod words;

use crate::cases;
use crate::error::Error;
use crate::files::{discard, files_in, folders_in, write_dense_json, write_whole};
use crate::gallery::{Gallery, Picture};
use crate::golden::Goldens;
use crate::night::Night;
use crate::record::Record;
use crate::study::gather::Gathered;
use crate::study::summary::{CaseStudy, Summary};
use speed::Speed;
use std::path::{Path, PathBuf};

const SUMMARY: &str = "summary.json";

/// Writes the pictures of every case, the CSV of everything plotted, `summary.json`, `summary.md`,
/// `junit.xml` and the pages: `index.html` and one per case; what has drifted from its golden
/// is drawn beside it. With a night, it enters the history.
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
    write_whole(&out.join(OWN), OWN_TEXT.as_bytes())?;
    for study in &mut judged.cases {
        study.night = night.cloned();
        study.pictures = draw(study, gathered, goldens, out)?;
        summary::write_verdicts(study, out)?;
    }
    let speed = Speed::of(&judged.cases);
    let picture = speed.draw(out)?;
    summary::write(&judged, &speed, out)?;
    junit::write(&judged, out)?;
    html::write(&judged, &speed, picture, out)?;
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
    if let [record] = &study.records[..] {
        pictures.extend(single::own(record, gathered.folder(record)?, out)?);
    }
    pictures.extend(convergence::draw(study, out)?);
    pictures.extend(sweep::draw(study, out)?);
    if let Some(night) = &study.night {
        history::add(study, night, out)?;
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

/// What tells that a folder is this program's own, beside what earlier versions have written there.
const OWN: &str = ".mpm-verify";
const SIGNS: [&str; 4] = [OWN, "plan.json", SUMMARY, "record.json"];

/// Removes an earlier report from `out` and takes the folder for the next; runs, plan and history stay.
///
/// # Errors
/// A page or a picture is there and nothing tells that this program has written it, or it can't be removed.
pub fn discard_report(out: &Path) -> Result<(), Error> {
    let earlier = earlier(out)?;
    if let Some(first) = earlier.first() {
        if !SIGNS.iter().any(|sign| out.join(sign).exists()) {
            let cause = "in the way, and not of a report of this program: name another folder";
            return Err(Error::file(first, cause));
        }
        write_whole(&out.join(OWN), OWN_TEXT.as_bytes())?;
    }
    earlier.iter().try_for_each(|file| discard(file))
}

const OWN_TEXT: &str =
    "mpm-verify writes and removes the pages, pictures and tables of this folder.\n";

/// The files of an earlier report in `out`, of whatever cases.
fn earlier(out: &Path) -> Result<Vec<PathBuf>, Error> {
    let pages = [SUMMARY, "summary.md", "junit.xml", "index.html"].map(|file| out.join(file));
    let mut files = pages.to_vec();
    files.extend(["png", "svg"].map(|e| out.join(format!("{}.{e}", speed::NAME))));
    for case in cases::all() {
        let (name, folder) = (case.name, out.join(case.name));
        files.push(out.join(format!("{name}.html")));
        files.push(folder.join("study.json"));
        files.extend(files_in(&folder, &["png", "svg", "csv"])?);
        for scheme in folders_in(&folder.join("drift"))? {
            files.extend(files_in(&scheme, &["png"])?);
        }
    }
    files.retain(|file| file.exists());
    Ok(files)
}
