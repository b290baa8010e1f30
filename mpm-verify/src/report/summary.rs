//! The summary in Markdown.

use super::speed::Speed;
use super::words::{self, bless_commands, kind, local_orders, number, order, outcome};
use super::{map, remedies};
use crate::cases;
use crate::error::Error;
use crate::files::{write_csv, write_whole};
use crate::metric::Metric;
use crate::record::Record;
use crate::study::convergence::Convergence;
use crate::study::summary::{CaseStudy, Summary};
use crate::table::Sheet;
use crate::verdict::{Kind, Verdict};
use std::fmt::Write;
use std::path::Path;

/// Writes `summary.md` into `out`.
pub(super) fn write(summary: &Summary, speed: &Speed, out: &Path) -> Result<(), Error> {
    let path = out.join("summary.md");
    write_whole(&path, text(summary, speed)?.as_bytes())
}

/// What failed and drifted, tables over all cases, and of each case the orders of what its table of results shows, at the
/// parameters that have the most levels.
///
/// # Errors
/// A case that is not known.
fn text(summary: &Summary, speed: &Speed) -> Result<String, Error> {
    let counts = summary.counts.to_string().replace('\n', "  \n");
    let title = format!("tier {}", summary.tier);
    let begin = counts + "\n" + &of_map(summary, speed);
    body(summary, speed, [&title, &begin], &programs(summary))
}

/// The same of rows that are kept, of any night; `nights` says of which.
///
/// # Errors
/// A case that is not known.
pub(super) fn of_rows(studies: Vec<CaseStudy>, nights: &Sheet) -> Result<String, Error> {
    let summary = Summary::new("", studies);
    let speed = Speed::of(&summary.cases);
    // Of its checks a row counts those alone that judge.
    let counts = summary.counts.to_string();
    let counts: Vec<&str> = counts.lines().take(2).collect();
    let begin = counts.join("  \n") + "\n\nThe map of schemes and cases: `docs/hard-cases.md`.\n";
    body(&summary, &speed, ["all runs that are kept", &begin], nights)
}

fn body(
    summary: &Summary,
    speed: &Speed,
    said: [&str; 2],
    programs: &Sheet,
) -> Result<String, Error> {
    let mut t = head(summary, speed, said, programs);
    for study in &summary.cases {
        let case = cases::find(&study.case)?;
        let shown = |c: &&Convergence| {
            let mut headlines = case.headlines.iter();
            let shows = |m: Metric| m.name == c.metric;
            c.set == case.ladder && headlines.any(|h| h.metric.is_some_and(shows))
        };
        orders(&study.case, study.convergence.iter().filter(shown), &mut t);
    }
    Ok(t)
}

/// What is said of all cases together.
fn head(summary: &Summary, speed: &Speed, [title, begin]: [&str; 2], programs: &Sheet) -> String {
    let mut t = format!("# Verification, {title}\n\n{begin}");
    if !speed.is_empty() {
        let (advice, table) = (speed.advice(), speed.table().markdown());
        let _ = write!(t, "\n## Speed against error\n\n{advice}\n\n{table}");
    }
    for command in bless_commands(summary) {
        let _ = writeln!(t, "\nIf the drift is meant, accept it with `{command}`.");
    }
    let _ = write!(t, "\n{}", programs.markdown());
    failures(summary, &mut t);
    for basis in remedies::BASES {
        let records = summary.cases.iter().flat_map(|s| &s.records);
        let (table, _) = remedies::criteria(basis).fill(records);
        if !table.rows.is_empty() {
            let table = table.markdown();
            let _ = writeln!(t, "\n## Remedies against criteria, {basis}\n\n{table}");
        }
    }
    t
}

/// How every scheme comes out in every case.
fn of_map(summary: &Summary, speed: &Speed) -> String {
    let mut t = String::new();
    let records = summary.cases.iter().flat_map(|s| &s.records);
    let panels = map::panels(records, speed);
    if !panels.is_empty() {
        let symbols = map::legend().map(|[symbol, text, _]| format!("{symbol} {text}"));
        let _ = writeln!(t, "\n## Map\n\n{}", symbols.join(", "));
    }
    for panel in panels {
        let table = panel.markdown(str::to_owned);
        let _ = write!(t, "\n### {}\n\n{table}", panel.name);
    }
    t
}

/// What made the runs, case by case.
pub(super) fn programs(summary: &Summary) -> Sheet {
    let row = |study: &CaseStudy| {
        let first = [study.case.clone(), study.records.len().to_string()];
        first.into_iter().chain(words::made_by(study)).collect()
    };
    let head = ["case", "runs", "program", "night", "commit"];
    Sheet::new(head).with(summary.cases.iter().map(row))
}

fn failures(summary: &Summary, t: &mut String) {
    for record in summary.cases.iter().flat_map(|s| &s.records) {
        if let Some(error) = record.error.as_ref().filter(|_| record.broke_down()) {
            let _ = writeln!(
                t,
                "\n**Broke down**: {} {} {}: {}",
                record.case,
                record.scheme(),
                record.level,
                plain(&error.message)
            );
        }
    }
    if summary.failures() > 0 {
        let _ = writeln!(t, "\n## Failed checks\n");
        table(summary, t, Verdict::misses_the_truth);
    }
    if summary.counts.drifted > 0 {
        drift(summary, t);
    }
}

/// Words of a file that Markdown shall show as they are.
fn plain(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

/// What differs from the goldens, run by run.
fn drift(summary: &Summary, t: &mut String) {
    let records = summary.cases.iter().flat_map(|s| &s.records);
    let rows = records.flat_map(|record| {
        let drifting = record.verdicts.iter().filter(|v| v.drifts());
        drifting.map(move |v| {
            let difference = v.value.zip(v.reference).map(|(now, golden)| now - golden);
            let exact = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| x.to_string());
            let what = match difference {
                Some(_) => v.metric.clone(),
                None => plain(&format!("{}: {}", v.metric, v.source)),
            };
            vec![
                format!("{} {}", record.case, record.folder()),
                what,
                exact(v.reference),
                exact(v.value),
                difference.map_or_else(|| "–".to_owned(), |d| format!("{d:.3e}")),
                number(v.tolerance),
            ]
        })
    });
    let head = ["run", "quantity", "golden", "now", "difference", "allowed"];
    let sheet = Sheet::new(head).with(rows);
    let _ = write!(t, "\n## Drift\n\n{}", sheet.markdown());
}

/// The order of every error, if there is one.
fn orders<'a>(case: &str, convergence: impl Iterator<Item = &'a Convergence>, t: &mut String) {
    let row = |c: &Convergence| {
        let levels = match &c.points[..] {
            [] => String::new(),
            [only] => only.level.clone(),
            [coarsest, .., finest] => format!("{}–{}", coarsest.level, finest.level),
        };
        vec![
            c.metric.clone(),
            c.scheme.title(),
            c.set.join(" "),
            levels,
            number(c.points.last().map(|p| p.value)),
            order(c),
            local_orders(c),
        ]
    };
    let head = [
        "quantity",
        "scheme",
        "changed",
        "levels",
        "value at the finest",
        "order ± uncertainty (95 %)",
        "local orders",
    ];
    let sheet = Sheet::new(head).with(convergence.filter(|c| c.is_error).map(row));
    if !sheet.rows.is_empty() {
        let _ = write!(t, "\n## Orders, {case}\n\n{}", sheet.markdown());
    }
}

const VERDICT: [&str; 9] = [
    "outcome",
    "kind",
    "check",
    "run",
    "metric",
    "value",
    "reference",
    "tolerance",
    "source",
];

/// The cells of a verdict: numbers as `shown`.
fn cells(run: Option<&Record>, v: &Verdict, shown: fn(Option<f64>) -> String) -> Vec<String> {
    let run = run.map_or_else(|| "runs together".to_owned(), Record::folder);
    let words = [outcome(v.outcome), kind(v.kind), &v.check, &run, &v.metric].map(str::to_owned);
    let numbers = [v.value, v.reference, v.tolerance].map(shown);
    [&words[..], &numbers, std::slice::from_ref(&v.source)].concat()
}

/// Writes every verdict of a case, those of drift apart, into `verdicts.csv` of its folder.
pub(super) fn write_verdicts(study: &CaseStudy, out: &Path) -> Result<(), Error> {
    let of_runs = study
        .records
        .iter()
        .flat_map(|r| r.verdicts.iter().map(move |v| (Some(r), v)));
    let all = of_runs.chain(study.verdicts.iter().map(|v| (None, v)));
    let exact = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    let told = all.filter(|(_, v)| v.kind != Kind::Drift);
    let rows = told.map(|(run, v)| cells(run, v, exact));
    let path = out.join(&study.case).join("verdicts.csv");
    write_csv(&path, &VERDICT.map(str::to_owned), rows)
}

fn table(summary: &Summary, t: &mut String, keep: impl Fn(&Verdict) -> bool) {
    let shown = summary.verdicts().filter(|(_, _, v)| keep(v));
    let rows = shown.map(|(study, run, v)| {
        let mut cells = cells(run, v, number);
        cells[3] = format!("{} {}", study.case, cells[3]);
        cells
    });
    t.push_str(&Sheet::new(VERDICT).with(rows).markdown());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Measured;
    use crate::record::fixture::record;
    use crate::study::convergence::convergence;

    #[test]
    fn every_error_has_a_row_of_orders() {
        let mut records = Vec::new();
        for set in [&[][..], &["load=2".to_owned()]] {
            for (level, h) in [("h2", 2.0), ("h1", 1.0), ("h0.5", 0.5)] {
                let mut run = record(level, Vec::new());
                run.set = set.to_vec();
                run.discretisation.h = h;
                for (name, value) in [("mean_stress_rms_error", -h * h), ("tip_ux", h)] {
                    let (value, unit) = (Some(value), "-".to_owned());
                    run.metrics
                        .insert(name.to_owned(), Measured { value, unit });
                }
                records.push(run);
            }
        }
        let mut t = String::new();
        let all = convergence(cases::find("cook").unwrap(), &records);
        orders("cook", all.iter(), &mut t);
        let rows: Vec<&str> = t.lines().skip(5).collect();
        let row = |changed: &str| {
            format!(
                "| mean_stress_rms_error | gimp none | {changed} | h2–h0.5 | -0.25 | 2.00 ± 0.00 | 2.00, 2.00 |"
            )
        };
        assert_eq!(rows, [row(""), row("load=2")]);
        let mut none = String::new();
        orders("cook", [].iter(), &mut none);
        assert!(none.is_empty());
    }
}
