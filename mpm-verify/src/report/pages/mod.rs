//! The report as a site that needs no server and no script: an index, a page per case, and one of the seeded faults.

mod case;
mod faults;
mod index;

use super::document::{Shown, Text};
use super::faults as seeded;
use super::speed::Speed;
use crate::report::prelude::*;
use std::env;

/// Writes `index.html`, `faults.html` and the page of every case into `out`; on the index the picture of speed against
/// error, if there is one.
pub(super) fn write(summary: &Summary, speed: &Speed, picture: Option<Picture>, out: &Path) -> Result<(), Error> {
    let faults = seeded::faults();
    let title = format!("Verification, tier {}", summary.tier);
    let of = |what: &str| format!("{what}: verification, tier {}", summary.tier);
    let up = Text::link(format!("← {title}"), "index.html");
    let page = index::page(summary, speed, picture, out)?;
    page.write_page(&title, index::links(), &out.join("index.html"))?;
    let page = faults::page(&faults, summary);
    page.write_page(&of("Seeded faults"), vec![up.clone()], &out.join("faults.html"))?;
    for study in &summary.cases {
        let case = cases::find(&study.case)?;
        let page = case::page(case, study, &faults, out);
        page.write_page(&of(case.title), vec![up.clone(), docs(study)], &out.join(file_of(study)))?;
    }
    Ok(())
}

fn file_of(study: &CaseStudy) -> String {
    format!("{}.html", study.case)
}

/// The pictures of a case.
fn pictures(study: &CaseStudy, out: &Path) -> Vec<Shown> {
    study.pictures.iter().map(|p| Shown::of(p, out)).collect()
}

/// The page of a case in `docs`.
fn docs(study: &CaseStudy) -> Text {
    let file = format!("docs/{}.md", study.case);
    let commit = study.night.as_ref().map_or("HEAD", |night| &night.commit);
    in_repository(&file, &file, commit)
}

/// A file of the repository, with a link where a server builds the report.
fn in_repository(name: &str, file: &str, commit: &str) -> Text {
    let variable = |name| env::var(name).ok();
    match variable("GITHUB_SERVER_URL").zip(variable("GITHUB_REPOSITORY")) {
        Some((server, repository)) => Text::link(name, format!("{server}/{repository}/blob/{commit}/{file}")),
        None => Text::code(name),
    }
}

/// Where a run stands on the page of its case.
fn anchor(record: &Record) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || ".=_".contains(c) { c } else { '-' };
    let name: String = words::name(record).chars().map(plain).collect();
    format!("run-{name}")
}

/// A run, or those of a case together, with a link to its place on the page of the case.
fn run(study: &CaseStudy, record: Option<&Record>) -> Text {
    let (name, anchor) = match record {
        Some(record) => (words::name(record), anchor(record)),
        None => ("runs together".to_owned(), "together".to_owned()),
    };
    Text::link(name, format!("{}#{anchor}", file_of(study)))
}

#[cfg(test)]
mod tests;
