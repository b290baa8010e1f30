//! Content, links and size of the pages.

use super::*;
use crate::files::write_whole;
use crate::problem::measured;
use crate::report::fixture::{NASTY, summary};
use quick_xml::escape::unescape;
use quick_xml::events::Event;

fn write_in(folder: &Path, summary: &Summary) {
    write(summary, &Speed::of(&summary.cases), None, folder).unwrap();
}

fn pages(summary: &Summary) -> [String; 2] {
    let folder = tempfile::tempdir().unwrap();
    write_in(folder.path(), summary);
    ["index.html", "cook.html"].map(|file| std::fs::read_to_string(folder.path().join(file)).unwrap())
}

/// Values of an attribute on a page, which must be well formed and without scripts.
fn all(page: &str, wanted: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut reader = quick_xml::Reader::from_str(page);
    loop {
        match reader.read_event().unwrap() {
            Event::Start(e) | Event::Empty(e) => {
                assert_ne!(e.name().as_ref(), "script");
                let own = e.attributes().map(Result::unwrap);
                let own = own.filter(|a| a.key.as_ref() == wanted);
                found.extend(own.map(|a| unescape(&a.value).unwrap().into_owned()));
            }
            Event::Eof => return found,
            _ => {}
        }
    }
}

#[test]
fn no_text_breaks_a_page_and_each_says_what_failed_and_what_made_it() {
    let mut summary = summary();
    summary.cases[0].pictures = vec![Picture { file: "cook/rest.png".to_owned(), caption: NASTY.to_owned() }];
    let [index, case] = pages(&summary);
    for page in [&index, &case] {
        assert!(page.contains("&lt;script&gt;") && !all(page, "class").is_empty());
        assert!(page.contains("✗ FAILED"));
        assert!(page.contains("source 0123456789ab") && page.contains("2026-01-02"));
    }
    assert!(index.contains("⚠ Broke down:") && index.contains("something failed"));
    assert!(case.contains("3 runs: 1 right, 0 wrong as known, 0 not judged, 2 FAILED."));
    assert!(case.contains("broke down at 1 s"));
    summary.cases[0].night = None;
    assert!(pages(&summary).iter().all(|page| !page.contains("2026-01-02")));
}

#[test]
fn every_link_to_a_run_has_its_target_once() {
    let [index, case] = pages(&summary());
    let (targets, ids) = (all(&index, "href"), all(&case, "id"));
    let anchors = targets.iter().filter_map(|t| t.strip_prefix("cook.html#"));
    let anchors: Vec<&str> = anchors.collect();
    assert!(anchors.iter().filter(|a| a.starts_with("run-")).count() > 1);
    for anchor in anchors {
        assert_eq!(ids.iter().filter(|id| *id == anchor).count(), 1, "{anchor}");
    }
}

#[test]
fn a_picture_has_a_link_to_its_svg_where_there_is_one() {
    let mut summary = summary();
    summary.cases[0].pictures = ["cook/chart.png", "cook/field.png"]
        .map(|file| Picture { file: file.to_owned(), caption: String::new() })
        .to_vec();
    let folder = tempfile::tempdir().unwrap();
    write_whole(&folder.path().join("cook/chart.svg"), b"<svg/>").unwrap();
    write_in(folder.path(), &summary);
    let page = std::fs::read_to_string(folder.path().join("cook.html")).unwrap();
    let targets = all(&page, "href");
    let svgs = targets.iter().filter(|t| t.ends_with(".svg"));
    assert_eq!(svgs.collect::<Vec<_>>(), ["cook/chart.svg"]);
}

/// As many runs as any tier has, each with as many words as any has, make no page too large.
#[test]
fn pages_are_small() {
    let mut summary = summary();
    let study = |case: &crate::case::Case| {
        let records = case.runs(crate::case::Tier::Long).into_iter().map(|spec| {
            let check = |c: &crate::check::Check| {
                let numbers = (1.234_5e-5, 1.1e-5, 2e-6);
                let (value, reference, tolerance) = numbers;
                crate::check::Finding::within("displacement_l2", value, reference, tolerance, c.statement)
                    .verdict(c.name, c.kind)
            };
            let verdicts = case.checks.iter().map(check).collect();
            let mut run = crate::record::fixture::record(spec.level.name, verdicts);
            (run.case, run.scheme, run.set) = (case.name.to_owned(), spec.scheme, spec.set);
            run.discretisation.h = spec.level.h;
            for m in &case.metrics {
                run.metrics.extend([measured((*m, -1.234_5e-5))]);
            }
            run
        });
        let mut study = CaseStudy::new(case.name, records.collect());
        study.convergence = crate::study::convergence::convergence(case, &study.records);
        let (file, caption) = (format!("{}/a.png", case.name), "a ".repeat(200));
        study.pictures = vec![Picture { file, caption }; 20];
        study
    };
    summary.cases = cases::all().iter().map(study).collect();
    let folder = tempfile::tempdir().unwrap();
    write_in(folder.path(), &summary);
    let names = cases::all().iter().map(|c| c.name);
    for name in names.chain(["index", "faults"]) {
        let page = folder.path().join(format!("{name}.html"));
        let bytes = std::fs::metadata(page).unwrap().len();
        assert!(bytes < 300_000, "{name}: {bytes} bytes");
    }
    let page = std::fs::read_to_string(folder.path().join("footing.html")).unwrap();
    assert!(page.contains("id=\"tables\"") && page.contains("<code>footing-results</code>"));
}

/// The README's recommendations are schemes, each with what standard MPM does and where it is weak.
#[test]
fn the_readme_names_schemes() {
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md")).unwrap();
    let section =
        readme.split("\n## Which scheme to take\n").nth(1).and_then(|rest| rest.split("\n## ").next()).unwrap();
    let rows: Vec<&str> = section.lines().filter(|line| line.starts_with('|')).skip(2).collect();
    assert!((4..=6).contains(&rows.len()));
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        assert!(cells.len() == 4 && cells.iter().all(|c| !c.is_empty()), "{row}");
        assert!(Scheme::parse(cells[1].trim_matches('`')).is_ok(), "{row}");
    }
}
