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
mod tests;
