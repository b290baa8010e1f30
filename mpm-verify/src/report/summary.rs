//! The summary in Markdown.

use super::describe::{self, bless_commands, headline, kind, local_orders, number, order, outcome};
use super::{price, remedies};
use crate::cases;
use crate::error::Error;
use crate::files::write_whole;
use crate::metric::Headline;
use crate::record::Record;
use crate::study::convergence::Convergence;
use crate::study::summary::{CaseStudy, Summary};
use crate::table::Sheet;
use crate::verdict::{Kind, Verdict};
use std::fmt::Write;
use std::path::Path;

/// Writes `summary.md` into `out`.
pub(super) fn write(summary: &Summary, out: &Path) -> Result<(), Error> {
    let path = out.join("summary.md");
    write_whole(&path, text(summary)?.as_bytes())
}

fn text(summary: &Summary) -> Result<String, Error> {
    let mut t = head(summary);
    for study in &summary.cases {
        let _ = writeln!(t, "\n## {}\n", study.case);
        let headlines = &cases::find(&study.case)?.headlines;
        t.push_str(&results(headlines, &study.records).markdown());
        orders(study.convergence.iter(), &mut t);
        t.push_str(&price::table(study).unwrap_or_default());
    }
    for picture in summary.cases.iter().flat_map(|s| &s.pictures) {
        let _ = writeln!(
            t,
            "\n![{}]({})\n\n{}",
            picture.caption, picture.file, picture.caption
        );
    }
    verdicts(summary, &mut t);
    Ok(t)
}

/// What is kept of the summary: without rows of runs and verdicts that hold, and of orders those of what the tables of
/// results show, at the parameters that have the most levels.
///
/// # Errors
/// A case that is not known.
pub(super) fn gist(summary: &Summary) -> Result<String, Error> {
    let mut t = head(summary);
    for study in &summary.cases {
        let case = cases::find(&study.case)?;
        let _ = writeln!(t, "\n## {}", study.case);
        let shown = |c: &&Convergence| {
            let mut headlines = case.headlines.iter();
            c.set == case.ladder && headlines.any(|h| h.metric.name == c.metric)
        };
        orders(study.convergence.iter().filter(shown), &mut t);
        t.push_str(&price::table(study).unwrap_or_default());
    }
    Ok(t)
}

/// What is said of all cases together.
fn head(summary: &Summary) -> String {
    let (tier, counts) = (&summary.tier, summary.counts);
    let mut t = format!("# Verification, tier {tier}\n\n{counts}\n");
    for command in bless_commands(summary) {
        let _ = writeln!(t, "\nIf the drift is meant, accept it with `{command}`.");
    }
    let _ = write!(t, "\n{}", programs(summary).markdown());
    failures(summary, &mut t);
    for basis in remedies::BASES {
        let records = summary.cases.iter().flat_map(|s| &s.records);
        let (table, _) = remedies::criteria(basis).fill(records);
        if !table.rows.is_empty() {
            let table = table.markdown();
            let _ = writeln!(t, "\n## Remedies against criteria, {basis}\n\n{table}");
        }
    }
    t.push_str(&price::overview(&summary.cases));
    t
}

/// What made the runs, case by case.
pub(super) fn programs(summary: &Summary) -> Sheet {
    let row = |study: &CaseStudy| {
        let first = [study.case.clone(), study.records.len().to_string()];
        first.into_iter().chain(describe::made_by(study)).collect()
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
                error.message
            );
        }
    }
    if summary.counts.failed > 0 {
        let _ = writeln!(t, "\n## Failed checks\n");
        table(summary, t, Verdict::misses_the_truth);
    }
    if summary.counts.drifted > 0 {
        drift(summary, t);
    }
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
                None => format!("{}: {}", v.metric, v.source),
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

fn results(headlines: &[Headline], records: &[Record]) -> Sheet {
    let head = ["scheme", "level", "changed", "particles", "steps"];
    let head = head.into_iter().chain(headlines.iter().map(|h| h.heading));
    let row = |r: &Record| {
        let run = [r.scheme().title(), r.level.clone(), r.set.join(" ")];
        let work = [r.work.particles, r.work.steps].map(|n| n.to_string());
        let cells = headlines.iter().map(|h| headline(r, h));
        let cpu = [format!("{:.1}", r.time.cpu_s)];
        run.into_iter()
            .chain(work)
            .chain(cells)
            .chain(cpu)
            .collect()
    };
    Sheet::new(head.chain(["CPU (s)"])).with(records.iter().map(row))
}

/// The order of every error, if there is one.
fn orders<'a>(convergence: impl Iterator<Item = &'a Convergence>, t: &mut String) {
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
        let _ = write!(t, "\n### Orders\n\n{}", sheet.markdown());
    }
}

fn verdicts(summary: &Summary, t: &mut String) {
    let _ = writeln!(t, "\n## All verdicts\n");
    table(summary, t, |v| v.kind != Kind::Drift);
}

fn table(summary: &Summary, t: &mut String, keep: impl Fn(&Verdict) -> bool) {
    let shown = summary.verdicts().filter(|(_, _, v)| keep(v));
    let rows = shown.map(|(study, record, v)| {
        let run = record.map_or_else(
            || study.case.clone(),
            |r| format!("{} {} {}", r.scheme().title(), r.level, r.set.join(" ")),
        );
        vec![
            outcome(v).to_owned(),
            kind(v.kind).to_owned(),
            v.check.clone(),
            run.trim().to_owned(),
            v.metric.clone(),
            number(v.value),
            number(v.reference),
            number(v.tolerance),
            v.source.clone(),
        ]
    });
    let head = [
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
    t.push_str(&Sheet::new(head).with(rows).markdown());
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
        orders(all.iter(), &mut t);
        let rows: Vec<&str> = t.lines().skip(5).collect();
        let row = |changed: &str| {
            format!(
                "| mean_stress_rms_error | gimp none | {changed} | h2–h0.5 | -0.25 | 2.00 ± 0.00 | 2.00, 2.00 |"
            )
        };
        assert_eq!(rows, [row(""), row("load=2")]);
        let mut none = String::new();
        orders([].iter(), &mut none);
        assert!(none.is_empty());
    }
}
