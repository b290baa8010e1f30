//! The report as a site that needs no server and no script: an index and a page per case.

mod case;
mod faults;

use super::advice::advice;
use super::map::{self, Cell, Line, Panel};
use super::speed::Speed;
use super::summary::programs;
use super::words::{self, kind, number};
use crate::case::Case;
use crate::cases;
use crate::distinct;
use crate::error::Error;
use crate::files::write_whole;
use crate::gallery::Picture;
use crate::record::Record;
use crate::study::judge::outcome_of_run;
use crate::study::summary::{CaseStudy, Summary};
use crate::table::Sheet;
use crate::verdict::{Kind, Outcome, Verdict};
use minijinja::syntax::SyntaxConfig;
use minijinja::{Environment, UndefinedBehavior, Value, context};
use std::env;
use std::path::Path;

const TEMPLATES: [(&str, &str); 7] = [
    ("style.css", include_str!("../../templates/style.css")),
    ("map.css", include_str!("../../templates/map.css")),
    ("page.html", include_str!("../../templates/page.html")),
    ("parts.html", include_str!("../../templates/parts.html")),
    ("index.html", include_str!("../../templates/index.html")),
    ("case.html", include_str!("../../templates/case.html")),
    ("faults.html", include_str!("../../templates/faults.html")),
];

/// Writes `index.html`, `faults.html` and the page of every case into `out`; on the index the picture of speed against error, if there
/// is one.
pub(super) fn write(
    summary: &Summary,
    speed: &Speed,
    picture: Option<Picture>,
    out: &Path,
) -> Result<(), Error> {
    let page = |file: &str, template: &str, context: Value| {
        let path = out.join(file);
        let text = render(template, context).map_err(|e| Error::file(&path, e))?;
        write_whole(&path, text.as_bytes())
    };
    let picture = picture.map(|p| figure(&p, out));
    page(
        "index.html",
        "index.html",
        index(summary, speed, picture, out)?,
    )?;
    let seeded = super::faults::faults();
    page("faults.html", "faults.html", faults::page(&seeded, summary))?;
    for study in &summary.cases {
        let case = cases::find(&study.case)?;
        let context = case::page(case, study, &summary.tier, &seeded, out);
        page(&file_of(study), "case.html", context)?;
    }
    Ok(())
}

fn render(template: &str, context: Value) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_syntax(
        SyntaxConfig::builder()
            .trim_blocks(true)
            .lstrip_blocks(true)
            .build()?,
    );
    for (name, source) in TEMPLATES {
        environment.add_template(name, source)?;
    }
    environment.get_template(template)?.render(context)
}

fn file_of(study: &CaseStudy) -> String {
    format!("{}.html", study.case)
}

/// A picture, with its SVG and, of an animation, its still, if they are there.
fn figure(p: &Picture, out: &Path) -> Value {
    let beside = |file: String| out.join(&file).exists().then_some(file);
    let stem = p.file.rsplit_once('.').map_or(&*p.file, |(stem, _)| stem);
    let [svg, still] = ["svg", "still.png"].map(|e| beside(format!("{stem}.{e}")));
    context! { file => &p.file, caption => &p.caption, svg, still }
}

/// The pictures of a case.
fn figures(study: &CaseStudy, out: &Path) -> Vec<Value> {
    study.pictures.iter().map(|p| figure(p, out)).collect()
}

/// Where the page of a case in `docs` lies: on the server that builds the report, else in the repository.
fn docs(case: &str, study: &CaseStudy) -> Value {
    let file = format!("docs/{case}.md");
    let commit = study.night.as_ref().map_or("HEAD", |night| &night.commit);
    let href = on_server(commit, &file);
    context! { file, href }
}

/// Where a file of the repository lies on the server that builds the report, if one does.
fn on_server(commit: &str, file: &str) -> Option<String> {
    let variable = |name| env::var(name).ok();
    let (server, name) = variable("GITHUB_SERVER_URL").zip(variable("GITHUB_REPOSITORY"))?;
    Some(format!("{server}/{name}/blob/{commit}/{file}"))
}

fn index(
    summary: &Summary,
    speed: &Speed,
    picture: Option<Value>,
    out: &Path,
) -> Result<Value, Error> {
    let records = summary.cases.iter().flat_map(|s| &s.records);
    let machines = records.map(|r| {
        let m = &r.machine;
        format!(
            "{} {}, {} cores, threads per run: {}",
            m.os, m.arch, m.cores, m.threads
        )
    });
    let broken = summary.cases.iter().flat_map(|study| {
        study.records.iter().filter_map(|r| {
            let message = &r.error.as_ref().filter(|_| r.broke_down())?.message;
            let (href, name) = pair(study, r);
            Some(context! { href, name, message })
        })
    });
    let failures = |which: fn(&Verdict) -> bool| {
        let failed = summary.verdicts().filter(move |(.., v)| which(v));
        failed.map(|(study, record, v)| {
            let (href, name) = record.map_or_else(
                || {
                    (
                        format!("{}#together", file_of(study)),
                        "runs together".into(),
                    )
                },
                |r| pair(study, r),
            );
            context! { href, name, verdict => verdict(v) }
        })
    };
    let failures = failures(Verdict::misses_the_truth).chain(failures(Verdict::drifts));
    let panels = map::panels(summary.cases.iter().flat_map(|s| &s.records), speed);
    let cases: Result<Vec<Value>, Error> = summary.cases.iter().map(|s| overview(s, out)).collect();
    Ok(context! {
        tier => &summary.tier,
        failed => summary.exit_code() as u8 != 0,
        counts => summary.counts.to_string().lines().map(str::to_owned).collect::<Vec<_>>(),
        map => panels.iter().map(panel).collect::<Vec<_>>(),
        legend => map::legend().map(|entry| entry.to_vec()).to_vec(),
        advice => advice().map(sheet),
        summed_up => (!speed.is_empty()).then(|| speed.advice()),
        speed => (!speed.is_empty()).then(|| sheet(speed.table())),
        readme => on_server("HEAD", "README.md#which-scheme-to-take"),
        picture,
        machines => distinct(machines),
        programs => sheet(programs(summary)),
        broken => broken.collect::<Vec<_>>(),
        failures => failures.collect::<Vec<_>>(),
        cases => cases?,
    })
}

/// A panel of the map.
fn panel(panel: &Panel) -> Value {
    let cell = |c: &Cell| context! { case => c.case, mark => &c.mark, words => &c.words, class => &c.class };
    let line = |line: &Line| {
        let cells = line.cells.iter().map(|c| c.as_ref().map(cell));
        context! { scheme => &line.scheme, numbers => &line.numbers, cells => cells.collect::<Vec<_>>() }
    };
    let lines: Vec<Value> = panel.lines.iter().map(line).collect();
    let errors: Vec<String> = panel.errors.iter().map(|kind| (*kind).to_owned()).collect();
    let (name, cases, numbers) = (panel.name, panel.cases.clone(), panel.numbers.clone());
    context! { name, cases, numbers, errors, lines }
}

/// A case on the index: how its runs came out, its best error, what it cost.
fn overview(study: &CaseStudy, out: &Path) -> Result<Value, Error> {
    let case = cases::find(&study.case)?;
    let outcomes = [
        Outcome::Right,
        Outcome::WrongAsKnown,
        Outcome::NotJudged,
        Outcome::Failed,
    ];
    let count = |outcome| {
        let runs = study.records.iter();
        let together = study.verdicts.iter().filter(|v| v.failed()).count();
        let of_runs = runs.filter(|r| outcome_of_run(r) == outcome).count();
        of_runs
            + if outcome == Outcome::Failed {
                together
            } else {
                0
            }
    };
    let [pairs, cpu] = study.records.iter().fold([0.0, 0.0], |[pairs, cpu], r| {
        [
            pairs + r.work.particle_node_pairs as f64,
            cpu + r.time.cpu_s,
        ]
    });
    Ok(context! {
        title => case.title,
        name => case.name,
        page => file_of(study),
        docs => docs(case.name, study),
        picture => figures(study, out).first(),
        counts => outcomes.map(count).to_vec(),
        best => best(case, study),
        pairs => format!("{:.2}", 1e-9 * pairs),
        cpu => format!("{cpu:.1}"),
    })
}

/// The value that comes nearest to its reference, in tolerances, of the first error of a case that a check judges, or
/// else of its first check; of runs that are right.
fn best(case: &Case, study: &CaseStudy) -> Option<Value> {
    let right = |r: &&Record| outcome_of_run(r) == Outcome::Right;
    let judged = study.records.iter().filter(right).flat_map(|r| {
        let share = |v: &Verdict| {
            let distance = (v.value? - v.reference.unwrap_or(0.0)).abs();
            let tolerance = v.tolerance.filter(|t| *t > 0.0)?;
            let is_bound_from_below =
                v.reference.is_none() && v.holds() == Some(distance > tolerance);
            let shown = v.kind == Kind::Truth && !is_bound_from_below;
            shown.then_some(distance / tolerance)
        };
        r.verdicts
            .iter()
            .filter_map(move |v| Some((r, v, share(v)?)))
    });
    let judged: Vec<(&Record, &Verdict, f64)> = judged.collect();
    let errors = case
        .quantities
        .iter()
        .filter(|q| q.is_error)
        .map(|q| q.metric.name);
    let metrics = errors.chain(case.metrics.iter().map(|m| m.name));
    let found = metrics.filter_map(|metric| {
        let own = judged.iter().filter(|(_, v, _)| v.metric == metric);
        own.min_by(|a, b| a.2.total_cmp(&b.2))
    });
    let (run, v, _) = found.into_iter().next()?;
    let unit = case
        .metrics
        .iter()
        .find(|m| m.name == v.metric)
        .map_or("-", |m| m.unit);
    let distance = v.value? - v.reference.unwrap_or(0.0);
    Some(context! {
        error => words::quantity(Some(distance.abs()), unit),
        tolerance => words::quantity(v.tolerance, unit),
        metric => &v.metric,
        run => name(run),
    })
}

/// An outcome in words, with a symbol, and a class that gives its colour.
fn badge(outcome: Outcome) -> Value {
    let (class, symbol) = (words::class(outcome), words::symbol(outcome));
    context! { class, symbol, text => words::outcome(outcome) }
}

fn verdict(v: &Verdict) -> Value {
    // A drift may lie beyond the digits that are shown elsewhere.
    let shown = |x: Option<f64>| match (v.kind, x) {
        (Kind::Drift, Some(x)) => x.to_string(),
        _ => number(x),
    };
    context! {
        outcome => badge(v.outcome),
        kind => kind(v.kind),
        check => &v.check,
        metric => &v.metric,
        value => shown(v.value),
        reference => shown(v.reference),
        tolerance => number(v.tolerance),
        source => &v.source,
    }
}

/// A table for its template.
fn sheet(sheet: Sheet) -> Value {
    context! { head => sheet.head, rows => sheet.rows }
}

fn name(record: &Record) -> String {
    let set = record.set.iter().map(|assignment| format!(" {assignment}"));
    format!(
        "{} {}{}",
        record.scheme(),
        record.level,
        set.collect::<String>()
    )
}

/// Where a run stands on the page of its case, and its name.
fn pair(study: &CaseStudy, record: &Record) -> (String, String) {
    let plain = |c: char| match c.is_ascii_alphanumeric() || ".=_".contains(c) {
        true => c,
        false => '-',
    };
    let name = name(record);
    let anchor: String = name.chars().map(plain).collect();
    (format!("{}#run-{anchor}", file_of(study)), name)
}

#[cfg(test)]
mod tests {
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
        let mid_edge = |distance: f64| {
            Finding::within("mid_edge_uy", 1.0 + distance, 1.0, 1.0, "")
                .verdict("mid-edge", Kind::Truth)
        };
        let wrong = Finding::within("at_rest", 0.0, 1.0, 0.0, "").verdict("at-rest", Kind::Truth);
        let runs = vec![
            record("h2", vec![mid_edge(0.5)]),
            record("h1", vec![mid_edge(0.25)]),
            record("h0.5", vec![mid_edge(0.125), wrong]),
        ];
        let case = cases::find("cook").unwrap();
        let found = best(case, &CaseStudy::new("cook", runs)).unwrap();
        assert!(found.get_attr("run").unwrap().to_string().contains("h1"));
        assert!(
            found
                .get_attr("error")
                .unwrap()
                .to_string()
                .contains("0.25")
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
}
