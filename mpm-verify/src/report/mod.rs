//! Reports: pictures, tables, files for other programs.
//!
//! Everything here is made from records and CSV files on disk, never from a running simulation.

#[cfg(test)]
mod bite;
pub mod board;
mod convergence;
mod criteria;
pub mod describe;
pub mod diff;
mod document;
mod drift;
mod errors;
mod fate;
mod faults;
#[cfg(test)]
mod fixture;
mod history;
pub mod junit;
pub mod keep;
mod map;
mod own_page;
mod pages;
mod prelude;
mod price;
mod rivals;
mod rows;
pub mod scored;
pub mod shown;
pub mod single;
mod solvers;
mod speed;
mod summary;
mod sweep;
pub mod tables;
mod together;
mod values;
mod verdicts;
mod words;

use crate::files::{folders_in, write_dense_json};
use crate::golden::{self, Goldens};
use crate::run::slim::slim;
use prelude::*;
use speed::Speed;

const SUMMARY: &str = "summary.json";

/// Files of runs that stay when their report is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Files {
    /// All.
    All,
    /// Records, and tables that a picture or a golden shows: see `run::slim`.
    Shown,
}

/// Writes the pictures of every case, the CSV of everything plotted, `summary.json`, `summary.md`,
/// `junit.xml` and the pages: `index.html`, `faults.html` and one per case; what has drifted from its golden
/// is drawn beside it. With a night, it enters the history.
///
/// # Errors
/// A record's files can't be read, or a picture can't be written.
pub fn write_report(
    gathered: &Gathered,
    mut judged: Summary,
    goldens: &Goldens,
    night: Option<&Night>,
    (out, files): (&Path, Files),
) -> Result<Summary, Error> {
    owning(out, || {
        for study in &mut judged.cases {
            study.night = night.cloned();
            study.pictures = draw(study, gathered, goldens, (out, files))?;
            verdicts::write(study, out)?;
        }
        let speed = Speed::of(&judged.cases);
        let picture = speed.draw(out)?;
        summary::write(&judged, &speed, out)?;
        junit::write(&judged, out)?;
        pages::write(&judged, &speed, picture, out)?;
        // The sign that the report is whole.
        write_dense_json(&out.join(SUMMARY), &judged)
    })?;
    Ok(judged)
}

/// Draws all pictures of a case; may remove files of its runs that nothing reads.
fn draw(
    study: &CaseStudy,
    gathered: &Gathered,
    goldens: &Goldens,
    (out, files): (&Path, Files),
) -> Result<Vec<Picture>, Error> {
    let case = cases::find(&study.case)?;
    let mut pictures = drift::draw(study, gathered, goldens, out)?;
    let (own, mut shown) = draw_own(case, study, gathered, out)?;
    pictures.extend(own);
    if let [record] = &study.records[..] {
        let folder = gathered.folder(record)?;
        pictures.extend(single::own(case, record, folder, out)?);
        shown.extend(["particles.csv", series::FILE].map(|file| folder.join(file)));
    }
    for record in study.records.iter().filter(|_| files == Files::Shown) {
        let folder = gathered.folder(record)?;
        shown.extend(golden::field_table(case, record, folder));
        slim(folder, &shown)?;
    }
    pictures.extend(convergence::draw(study, out)?);
    pictures.extend(sweep::draw(study, out)?);
    if let Some(night) = &study.night {
        history::add(study, night, out)?;
    }
    Ok(pictures)
}

/// Pictures, and the tables from which they were drawn.
type Drawn = (Vec<Picture>, BTreeSet<PathBuf>);

/// Draws what only this case has.
fn draw_own(case: &Case, study: &CaseStudy, gathered: &Gathered, out: &Path) -> Result<Drawn, Error> {
    let folder = |r: &Record| gathered.folder(r).map(Path::to_path_buf);
    let mut gallery = Gallery::new(&study.case, &study.records, &folder, out);
    (case.pictures)(&mut gallery)?;
    Ok(gallery.done())
}

/// The file that names everything this program has written in a folder: it distinguishes a file of the user, which
/// stays, from one of an earlier report. Its first line alone claims all, which holds while a report is being written,
/// and after a killed one.
const OWN: &str = ".mpm-verify";
const CLAIM: &str = "mpm-verify writes and removes the pages, pictures and tables of this folder.\n";

/// Draws and writes into `out`, in place of what this program wrote there before, and keeps account of it.
fn owning<T>(out: &Path, write: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    discard_report(out)?;
    write_whole(&out.join(OWN), CLAIM.as_bytes())?;
    let written = write()?;
    let account: String = places(out)?.iter().map(|file| format!("{}\n", file.display())).collect();
    write_whole(&out.join(OWN), (CLAIM.to_owned() + &account).as_bytes())?;
    Ok(written)
}

/// Removes an earlier report from `out`; runs, plan and history stay.
///
/// # Errors
/// A page or a picture is there that this program has not written, one can't be removed, or a link leads out of the folder.
pub fn discard_report(out: &Path) -> Result<(), Error> {
    require_inside(out, Path::new(SNAPSHOTS))?;
    let places = places(out)?;
    let path = out.join(OWN);
    let account = if path.exists() { read_text(&path)? } else { String::new() };
    let claimed = account == CLAIM;
    let own: BTreeSet<&str> = account.lines().skip(1).collect();
    if let Some(first) = places.iter().find(|file| !claimed && !own.contains(&*file.display().to_string())) {
        let cause = "in the way, and not of a report of this program: name another folder";
        return Err(Error::file(&out.join(first), cause));
    }
    places.iter().try_for_each(|file| discard(&out.join(file)))
}

/// The files in `out` that have the place and the kind of a report's, of whatever cases: their paths from there.
fn places(out: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = [SUMMARY, "summary.md", "junit.xml", "index.html", "faults.html"].map(PathBuf::from).to_vec();
    files.extend(["png", "svg"].map(|e| PathBuf::from(format!("{}.{e}", speed::NAME))));
    for name in cases::all().iter().map(|case| case.name).chain(["scene"]) {
        let folder = Path::new(name);
        let drift = folder.join("drift");
        require_inside(out, &drift)?;
        files.push(PathBuf::from(format!("{name}.html")));
        files.push(folder.join("study.json"));
        let mut found = files_in(&out.join(folder), &["png", "svg", "csv", "part"])?;
        for scheme in folders_in(&out.join(&drift))? {
            found.extend(files_in(&scheme, &["png", "part"])?);
        }
        files.extend(found.iter().filter_map(|file| file.strip_prefix(out).map(Path::to_path_buf).ok()));
    }
    files.retain(|file| out.join(file).symlink_metadata().is_ok());
    files.sort();
    files.dedup();
    Ok(files)
}
