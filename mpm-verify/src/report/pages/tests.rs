//! What pages say and link, and how large they are.

use super::*;
use crate::check::Finding;
use crate::record::fixture::record;
use crate::report::fixture::{NASTY, summary};
use quick_xml::escape::unescape;
use quick_xml::events::Event;

fn pages(summary: &Summary) -> [String; 2] {
    let folder = tempfile::tempdir().unwrap();
    let speed = Speed::of(&summary.cases);
    write(summary, &speed, None, folder.path()).unwrap();
    ["index.html", "cook.html"]
        .map(|file| std::fs::read_to_string(folder.path().join(file)).unwrap())
}

/// Names, ids and targets of links of a page, which must be well formed.
fn elements(page: &str) -> (Vec<String>, Vec<String>, Vec<String>) {
    let (mut names, mut ids, mut targets) = (Vec::new(), Vec::new(), Vec::new());
    let mut reader = quick_xml::Reader::from_str(page);
    loop {
        match reader.read_event().unwrap() {
            Event::Start(e) | Event::Empty(e) => {
                names.push(e.name().as_ref().to_owned());
                for attribute in e.attributes() {
                    let attribute = attribute.unwrap();
                    let value = unescape(&attribute.value).unwrap().into_owned();
                    match attribute.key.as_ref() {
                        "id" => ids.push(value),
                        "href" => targets.push(value),
                        _ => {}
                    }
                }
            }
            Event::Eof => return (names, ids, targets),
            _ => {}
        }
    }
}

#[test]
fn no_text_breaks_a_page() {
    let mut summary = summary();
    summary.cases[0].pictures = vec![Picture {
        file: "cook/rest.png".to_owned(),
        caption: NASTY.to_owned(),
    }];
    for page in pages(&summary) {
        assert!(page.contains("&lt;script&gt;"));
        let (names, ..) = elements(&page);
        assert!(!names.iter().any(|n| n == "script"));
    }
}

#[test]
fn every_link_to_a_run_has_its_target_once() {
    let [index, case] = pages(&summary());
    let ((_, _, targets), (_, ids, _)) = (elements(&index), elements(&case));
    let anchors = targets.iter().filter_map(|t| t.strip_prefix("cook.html#"));
    let anchors: Vec<&str> = anchors.collect();
    assert!(anchors.iter().filter(|a| a.starts_with("run-")).count() > 1);
    for anchor in anchors {
        assert_eq!(ids.iter().filter(|id| *id == anchor).count(), 1, "{anchor}");
    }
}

#[test]
fn the_index_counts_outcomes_and_tells_what_failed() {
    let [index, case] = pages(&summary());
    for word in ["⚠ Broke down:", "something failed", "✗ FAILED"] {
        assert!(index.contains(word), "{word}");
    }
    let sentence = "Of 3 runs, 1 right, 0 wrong as known, 0 not judged, 2 FAILED.";
    assert!(case.contains(sentence), "{case}");
    assert!(case.contains("broke down at 1 s"));
}

#[test]
fn the_best_error_is_of_a_run_that_is_right() {
    let edge = |distance: f64| {
        Finding::within("fem_edge_mean_error", 1.0 + distance, 1.0, 0.1, "")
            .verdict("edge", Kind::Truth)
    };
    let wrong = Finding::within("at_rest", 0.0, 1.0, 0.0, "").verdict("at-rest", Kind::Truth);
    let runs = vec![
        record("h2", vec![edge(0.05)]),
        record("h1", vec![edge(0.025)]),
        record("h0.5", vec![edge(0.0125), wrong]),
    ];
    let case = cases::find("cook").unwrap();
    let found = best(case, &CaseStudy::new("cook", runs)).unwrap();
    assert!(found.get_attr("run").unwrap().to_string().contains("h1"));
    assert!(
        found
            .get_attr("error")
            .unwrap()
            .to_string()
            .contains("0.025")
    );
}

/// As many runs as any tier has, each with as many words as any has, make no page too large.
#[test]
fn pages_are_small() {
    let mut summary = summary();
    summary.cases.clear();
    for case in cases::all() {
        let specs = case.runs(crate::case::Tier::Long);
        let records = specs.into_iter().map(|spec| {
            let check = |c: &crate::check::Check| {
                let found = crate::check::Finding::within(
                    "displacement_l2",
                    1.234_5e-5,
                    1.1e-5,
                    2e-6,
                    c.statement,
                );
                found.verdict(c.name, c.kind)
            };
            let mut run = crate::record::fixture::record(
                spec.level.name,
                case.checks.iter().map(check).collect(),
            );
            (run.case, run.scheme, run.set) = (case.name.to_owned(), spec.scheme, spec.set);
            run.discretisation.h = spec.level.h;
            for m in &case.metrics {
                let (value, unit) = (Some(-1.234_5e-5), m.unit.to_owned());
                let measured = crate::record::Measured { value, unit };
                run.metrics.insert(m.name.to_owned(), measured);
            }
            run
        });
        let mut study = CaseStudy::new(case.name, records.collect());
        study.convergence = crate::study::convergence::convergence(case, &study.records);
        study.pictures = vec![
            Picture {
                file: format!("{}/a.png", case.name),
                caption: "a ".repeat(200)
            };
            20
        ];
        summary.cases.push(study);
    }
    let folder = tempfile::tempdir().unwrap();
    write(&summary, &Speed::of(&summary.cases), None, folder.path()).unwrap();
    for name in cases::all()
        .iter()
        .map(|c| c.name)
        .chain(["index", "faults"])
    {
        let page = folder.path().join(format!("{name}.html"));
        let bytes = std::fs::metadata(page).unwrap().len();
        assert!(bytes < 300_000, "{name}: {bytes} bytes");
    }
}

#[test]
fn a_picture_has_a_link_to_its_svg_where_there_is_one() {
    let mut summary = summary();
    summary.cases[0].pictures = ["cook/chart.png", "cook/field.png"]
        .map(|file| Picture {
            file: file.to_owned(),
            caption: String::new(),
        })
        .to_vec();
    let folder = tempfile::tempdir().unwrap();
    write_whole(&folder.path().join("cook/chart.svg"), b"<svg/>").unwrap();
    write(&summary, &Speed::of([]), None, folder.path()).unwrap();
    let page = std::fs::read_to_string(folder.path().join("cook.html")).unwrap();
    let (.., targets) = elements(&page);
    let svgs = targets.iter().filter(|t| t.ends_with(".svg"));
    assert_eq!(svgs.collect::<Vec<_>>(), ["cook/chart.svg"]);
}

#[test]
fn both_pages_tell_what_made_a_case() {
    for page in pages(&summary()) {
        assert!(page.contains("source 0123456789ab") && page.contains("2026-01-02"));
    }
    let mut summary = summary();
    summary.cases[0].night = None;
    for page in pages(&summary) {
        assert!(page.contains("source 0123456789ab") && !page.contains("2026-01-02"));
    }
}
