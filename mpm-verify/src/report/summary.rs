//! The summary in Markdown.

use super::describe::{self, bless_commands, headline, kind, local_orders, number, order, outcome};
use super::{price, remedies};
use crate::cases;
use crate::error::Error;
use crate::files::write_whole;
use crate::metric::Headline;
use crate::record::Record;
use crate::study::convergence::Convergence;
use crate::study::summary::Summary;
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
        results(&cases::find(&study.case)?.headlines, &study.records, &mut t);
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
    programs(summary, &mut t);
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
fn programs(summary: &Summary, t: &mut String) {
    let _ = writeln!(
        t,
        "\n| case | runs | program | night | commit |\n|---|---|---|---|---|"
    );
    for study in &summary.cases {
        let made_by = describe::made_by(study).join(" | ");
        let runs = study.records.len();
        let _ = writeln!(t, "| {} | {runs} | {made_by} |", study.case);
    }
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
    let _ = writeln!(
        t,
        "\n## Drift\n\n| run | quantity | golden | now | difference | allowed |\n|---|---|---|---|---|---|"
    );
    for record in summary.cases.iter().flat_map(|s| &s.records) {
        for v in record.verdicts.iter().filter(|v| v.drifts()) {
            let difference = v.value.zip(v.reference).map(|(now, golden)| now - golden);
            let exact = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| x.to_string());
            let what = if difference.is_some() {
                v.metric.clone()
            } else {
                format!("{}: {}", v.metric, v.source.replace('|', "\\|"))
            };
            let _ = writeln!(
                t,
                "| {} {} | {what} | {} | {} | {} | {} |",
                record.case,
                record.folder(),
                exact(v.reference),
                exact(v.value),
                difference.map_or_else(|| "–".to_owned(), |d| format!("{d:.3e}")),
                number(v.tolerance)
            );
        }
    }
}

fn results(headlines: &[Headline], records: &[Record], t: &mut String) {
    let headings: Vec<&str> = headlines.iter().map(|h| h.heading).collect();
    let _ = writeln!(
        t,
        "| scheme | level | changed | particles | steps | {} | CPU (s) |",
        headings.join(" | ")
    );
    let _ = writeln!(t, "|{}", "---|".repeat(headlines.len() + 6));
    for r in records {
        let cells: Vec<String> = headlines.iter().map(|h| headline(r, h)).collect();
        let _ = writeln!(
            t,
            "| {} | {} | {} | {} | {} | {} | {:.1} |",
            r.scheme().title(),
            r.level,
            r.set.join(" "),
            r.work.particles,
            r.work.steps,
            cells.join(" | "),
            r.time.cpu_s
        );
    }
}

/// The order of every error, if there is one.
fn orders<'a>(convergence: impl Iterator<Item = &'a Convergence>, t: &mut String) {
    let mut errors = convergence.filter(|c| c.is_error).peekable();
    if errors.peek().is_none() {
        return;
    }
    let _ = writeln!(
        t,
        "\n### Orders\n\n| quantity | scheme | changed | levels | value at the finest | order ± uncertainty (95 %) | local orders |\n|{}",
        "---|".repeat(7)
    );
    for c in errors {
        let levels = match &c.points[..] {
            [] => String::new(),
            [only] => only.level.clone(),
            [coarsest, .., finest] => format!("{}–{}", coarsest.level, finest.level),
        };
        let _ = writeln!(
            t,
            "| {} | {} | {} | {levels} | {} | {} | {} |",
            c.metric,
            c.scheme.title(),
            c.set.join(" "),
            number(c.points.last().map(|p| p.value)),
            order(c),
            local_orders(c)
        );
    }
}

fn verdicts(summary: &Summary, t: &mut String) {
    let _ = writeln!(t, "\n## All verdicts\n");
    table(summary, t, |v| v.kind != Kind::Drift);
}

fn table(summary: &Summary, t: &mut String, keep: impl Fn(&Verdict) -> bool) {
    let _ = writeln!(
        t,
        "| outcome | kind | check | run | metric | value | reference | tolerance | source |\n|---|---|---|---|---|---|---|---|---|"
    );
    for (study, record, v) in summary.verdicts().filter(|(_, _, v)| keep(v)) {
        let run = record.map_or_else(
            || study.case.clone(),
            |r| {
                let scheme = r.scheme().title();
                format!("{scheme} {} {}", r.level, r.set.join(" "))
            },
        );
        let _ = writeln!(
            t,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            outcome(v),
            kind(v.kind),
            v.check,
            run.trim(),
            v.metric,
            number(v.value),
            number(v.reference),
            number(v.tolerance),
            v.source.replace('|', "\\|")
        );
    }
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
