//! The report as a site that needs no server and no script: an index and a page per case.

mod parts;

use super::describe::{kind, made_by};
use super::price::Prices;
use super::summary::programs;
use crate::case::Case;
use crate::cases;
use crate::distinct;
use crate::draw::sketch;
use crate::error::Error;
use crate::files::write_whole;
use crate::gallery::Picture;
use crate::record::Record;
use crate::scheme::Scheme;
use crate::study::summary::{CaseStudy, Summary};
use crate::table::Sheet;
use crate::verdict::{Kind, Verdict};
use minijinja::syntax::SyntaxConfig;
use minijinja::{Environment, UndefinedBehavior, Value, context};
use parts::{Tally, link, name, outcome_of, outcome_of_run, prices, quantity, run, sheet, verdict};
use std::path::Path;

const TEMPLATES: [(&str, &str); 5] = [
    ("style.css", include_str!("../../templates/style.css")),
    ("page.html", include_str!("../../templates/page.html")),
    ("parts.html", include_str!("../../templates/parts.html")),
    ("index.html", include_str!("../../templates/index.html")),
    ("case.html", include_str!("../../templates/case.html")),
];

/// Writes `index.html` and the page of every case into `out`.
pub(super) fn write(summary: &Summary, out: &Path) -> Result<(), Error> {
    let page = |file: &str, template: &str, context: Value| {
        let path = out.join(file);
        let text = render(template, context).map_err(|e| Error::file(&path, e))?;
        write_whole(&path, text.as_bytes())
    };
    page("index.html", "index.html", index(summary, out)?)?;
    for study in &summary.cases {
        let context = case_page(cases::find(&study.case)?, study, &summary.tier, out);
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

/// Pictures of some cases whose file lies in `folder` of `out`, or, without one, in none. Each has its SVG, if there is
/// one.
fn pictures_in(studies: &[CaseStudy], folder: Option<&str>, out: &Path) -> Vec<Value> {
    let lies = |p: &&Picture| p.file.split_once('/').map(|(first, _)| first) == folder;
    let value = |p: &Picture| {
        let svg = Path::new(&p.file).with_extension("svg");
        let svg = out.join(&svg).exists().then(|| svg.display().to_string());
        context! { file => &p.file, caption => &p.caption, svg }
    };
    let pictures = studies.iter().flat_map(|s| &s.pictures);
    pictures.filter(lies).map(value).collect()
}

fn index(summary: &Summary, out: &Path) -> Result<Value, Error> {
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
            Some(context! { href => link(study, r), name => name(r), message })
        })
    });
    let failures = |which: fn(&Verdict) -> bool| {
        summary
            .verdicts()
            .filter(move |(.., v)| which(v))
            .map(|(study, record, v)| {
                let (href, name) = match record {
                    Some(r) => (link(study, r), name(r)),
                    None => (
                        format!("{}#together", file_of(study)),
                        "runs together".into(),
                    ),
                };
                context! { href, name, verdict => verdict(v) }
            })
    };
    let failures = failures(Verdict::misses_the_truth).chain(failures(Verdict::drifts));
    let cases: Result<Vec<Value>, Error> = summary.cases.iter().map(overview).collect();
    let c = summary.counts;
    Ok(context! {
        tier => &summary.tier,
        outcome => Tally {
            broken: c.broke_down,
            failed: c.failed + c.bookkeeping_failed,
            drifted: c.drifted,
            known: c.wrong_as_known,
            right: c.right,
            held: c.bookkeeping_right + c.undrifted,
        }
        .worst(),
        counts => context! {
            runs => c.runs,
            broke_down => c.broke_down,
            broke_down_as_known => c.broke_down_as_known,
            not_judged_runs => c.not_judged_runs,
            right => c.right,
            wrong_as_known => c.wrong_as_known,
            not_judged => c.not_judged,
            failed => c.failed,
            bookkeeping_right => c.bookkeeping_right,
            bookkeeping_failed => c.bookkeeping_failed,
            undrifted => c.undrifted,
            drifted => c.drifted,
        },
        machines => distinct(machines),
        programs => sheet(programs(summary)),
        broken => broken.collect::<Vec<_>>(),
        failures => failures.collect::<Vec<_>>(),
        cases => cases?,
        pictures => pictures_in(&summary.cases, None, out),
    })
}

/// A case on the index: schemes over levels, at its own parameters and at others.
fn overview(study: &CaseStudy) -> Result<Value, Error> {
    let case = cases::find(&study.case)?;
    let own = case.levels.iter().map(|l| (l.name, &[][..])).collect();
    let changed = || study.records.iter().filter(|r| !r.is_default());
    let all = case.schemes();
    let some = |s: &&Scheme| changed().any(|r| r.scheme() == **s);
    let schemes: Vec<Scheme> = all.iter().filter(some).copied().collect();
    let mut columns = distinct(changed().map(|r| (&*r.level, &*r.set)));
    columns.sort_by_key(|(level, _)| case.levels.iter().position(|l| l.name == *level));
    Ok(context! {
        name => case.name,
        title => case.title,
        page => file_of(study),
        own => matrix(study, &all, own),
        changed => matrix(study, &schemes, columns),
        together => (!study.verdicts.is_empty()).then(|| outcome_of(&study.verdicts, 0)),
    })
}

/// The outcome of every scheme at every level with its changed parameters; nothing if there are none.
fn matrix(study: &CaseStudy, schemes: &[Scheme], columns: Vec<(&str, &[String])>) -> Value {
    let cell = |scheme: Scheme, (level, set): &(&str, &[String])| {
        let same = |r: &&Record| r.scheme() == scheme && r.level == *level && r.set == *set;
        study.records.iter().find(same).map(|r| {
            context! { href => link(study, r), outcome => outcome_of_run(r) }
        })
    };
    let row = |scheme: &Scheme| {
        let cells: Vec<_> = columns.iter().map(|c| cell(*scheme, c)).collect();
        context! { scheme => scheme.to_string(), cells }
    };
    let head = |(level, set): &(&str, &[String])| context! { level => *level, set => set.to_vec() };
    context! {
        columns => columns.iter().map(head).collect::<Vec<_>>(),
        rows => schemes.iter().map(row).collect::<Vec<_>>(),
    }
}

fn case_page(case: &Case, study: &CaseStudy, tier: &str, out: &Path) -> Value {
    let sketch = &case.sketch;
    let parameters = case.parameters.iter().map(|p| {
        let allowed = p.domain.to_string();
        [p.name, p.unit, p.default, &allowed, p.meaning]
            .map(str::to_owned)
            .into()
    });
    let parameters = Sheet::new(["name", "unit", "default", "allowed", "meaning"]).with(parameters);
    let levels = case
        .levels
        .iter()
        .map(|l| context! { name => l.name, h => l.h.to_string() });
    let metrics = case.metrics.iter();
    let metrics = metrics.map(|m| [m.name, m.unit, m.meaning].map(str::to_owned).into());
    let metrics = Sheet::new(["metric", "unit", "what it measures"]).with(metrics);
    let known_limits = case.checks.iter().filter(|c| c.kind == Kind::KnownLimit);
    let known_limits = known_limits.map(|c| context! { name => c.name, statement => c.statement });
    let sets = distinct(study.convergence.iter().map(|c| &c.set[..]));
    let ladders = sets.iter().map(|set| {
        let of_set = || study.convergence.iter().filter(|c| c.set == *set);
        let quantities = case.quantities.iter().map(|q| quantity(q, of_set()));
        context! { set => set.join(" "), quantities => quantities.flatten().collect::<Vec<_>>() }
    });
    context! {
        tier,
        name => case.name,
        title => case.title,
        description => case.description,
        sketch => Value::from_safe_string(sketch::svg(sketch, case.title)),
        sketch_caption => sketch.description,
        parameters => sheet(parameters),
        schemes => case.schemes().iter().map(ToString::to_string).collect::<Vec<_>>(),
        levels => levels.collect::<Vec<_>>(),
        references => case.references.clone(),
        made_by => made_by(study).to_vec(),
        pictures => pictures_in(std::slice::from_ref(study), Some(case.name), out),
        headings => case.headlines.iter().map(|h| h.heading).collect::<Vec<_>>(),
        runs => study.records.iter().map(|r| run(case, r)).collect::<Vec<_>>(),
        ladders => ladders.collect::<Vec<_>>(),
        prices => Prices::of(study).as_ref().map(prices),
        checks => checks(case, study),
        together => study.verdicts.iter().map(verdict).collect::<Vec<_>>(),
        limits => case.limits.to_vec(),
        known_limits => known_limits.collect::<Vec<_>>(),
        metrics => sheet(metrics),
    }
}

/// Every check with its outcomes: those that the case declares, then those that every case has.
fn checks(case: &Case, study: &CaseStudy) -> Vec<Value> {
    let of_runs = study.records.iter().flat_map(|r| &r.verdicts);
    let undeclared = of_runs
        .chain(&study.verdicts)
        .filter(|v| v.kind != Kind::Drift && !case.checks.iter().any(|c| c.name == v.check));
    let undeclared = distinct(undeclared.map(|v| (&*v.check, v.kind, &*v.source)));
    let declared = case.checks.iter().map(|c| (c.name, c.kind, c.statement));
    let row = |(name, of, statement): (&str, Kind, &str)| {
        let mut counts = [0, 0, 0];
        let mut count = |verdicts: &[&Verdict]| {
            let any = |pass| verdicts.iter().any(|v| v.holds() == pass);
            let worst = [Some(false), Some(true), None].into_iter().position(any);
            if let Some(k) = worst {
                counts[k] += 1;
            }
        };
        let named = |v: &&Verdict| v.check == name;
        for record in &study.records {
            count(&record.verdicts.iter().filter(named).collect::<Vec<_>>());
        }
        for verdict in study.verdicts.iter().filter(named) {
            count(&[verdict]);
        }
        let [fail, pass, none] = counts;
        context! { name, kind => kind(of), statement, pass, fail, none }
    };
    declared.chain(undeclared).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{NASTY, summary};
    use crate::study::convergence::Convergence;
    use quick_xml::escape::unescape;
    use quick_xml::events::Event;

    fn pages(summary: &Summary) -> [String; 2] {
        let folder = tempfile::tempdir().unwrap();
        write(summary, folder.path()).unwrap();
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
            file: "trends.png".to_owned(),
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
        let ((_, _, targets), (_, ids, own)) = (elements(&index), elements(&case));
        let anchors = targets.iter().filter_map(|t| t.strip_prefix("cook.html#"));
        let anchors: Vec<&str> = anchors
            .chain(own.iter().filter_map(|t| t.strip_prefix('#')))
            .collect();
        assert!(anchors.iter().filter(|a| a.starts_with("run-")).count() > 4);
        for anchor in anchors {
            assert_eq!(ids.iter().filter(|id| *id == anchor).count(), 1, "{anchor}");
        }
    }

    #[test]
    fn the_matrix_tells_what_broke_what_failed_and_what_was_not_run() {
        let [index, case] = pages(&summary());
        for word in ["⚠ broke down", "✗ 1 failed", "not run"] {
            assert!(index.contains(word), "{word}");
        }
        assert_eq!(case.matches("<details open=\"\">").count(), 2);
        assert_eq!(case.matches("<details>").count(), 1);
    }

    #[test]
    fn each_set_of_parameters_has_its_own_orders_and_only_the_case_s_own_are_open() {
        let entry = |set: &[&str]| Convergence {
            set: set.iter().map(|s| (*s).to_owned()).collect(),
            scheme: cases::find("cook").unwrap().schemes()[0],
            metric: "tip_ux".to_owned(),
            is_error: false,
            points: Vec::new(),
            order: None,
            extrapolation: None,
            remark: None,
        };
        let mut summary = summary();
        let [_, before] = pages(&summary);
        summary.cases[0].convergence = vec![entry(&[]), entry(&["load=2", NASTY])];
        let [_, case] = pages(&summary);
        let more = |tag: &str| case.matches(tag).count() - before.matches(tag).count();
        assert_eq!((more("<details open=\"\">"), more("<details>")), (1, 1));
        assert!(case.contains("load=2 &lt;"));
        elements(&case);
    }

    #[test]
    fn pictures_lie_on_the_page_of_their_case() {
        let picture = |file: &str| Picture {
            file: file.to_owned(),
            caption: String::new(),
        };
        let mut summary = summary();
        summary.cases[0].pictures = vec![picture("trends.png"), picture("cook/rest.png")];
        let [index, case] = pages(&summary);
        assert!(index.contains("trends.png") && !index.contains("rest.png"));
        assert!(case.contains("rest.png") && !case.contains("trends.png"));
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
        write(&summary, folder.path()).unwrap();
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
