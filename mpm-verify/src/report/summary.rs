//! The summary in Markdown.

use super::document::{Document, Table, Text};
use super::fate::Fate;
use super::prelude::*;
use super::speed::Speed;
use super::{criteria, map, verdicts};
use crate::metric::Metric;

/// Writes `summary.md` into `out`: what failed and drifted, tables over all cases, and of each case the orders of what its
/// table of results shows, at the parameters that have the most levels.
pub(super) fn write(summary: &Summary, speed: &Speed, out: &Path) -> Result<(), Error> {
    let mut document = Document::new(format!("Verification, tier {}", summary.tier));
    document.paragraph(lines(&summary.counts.to_string(), 4));
    let panels = map::panels(summary.records(), speed);
    if !panels.is_empty() {
        document.section("", "Map");
        document.paragraph(Fate::ALL.map(Fate::shown).map(|[symbol, text, _]| format!("{symbol} {text}")).join(", "));
    }
    for panel in panels {
        document.heading(3, "", panel.name);
        document.table("", panel.table(|case| case.into(), false));
        if !panel.errors.is_empty() {
            document.paragraph(panel.marks());
        }
    }
    body(&mut document, summary, speed, &programs(summary))?;
    write_whole(&out.join("summary.md"), document.markdown().as_bytes())
}

/// The same of rows that are kept, of any night; `nights` says of which.
pub(super) fn of_rows(studies: Vec<CaseStudy>, nights: &Sheet) -> Result<String, Error> {
    let summary = Summary::new("", studies);
    let mut document = Document::new("Verification, all kept runs");
    // A row counts only checks that judge.
    document.paragraph(lines(&summary.counts.to_string(), 2));
    document.paragraph(Text::marked("The map of schemes and cases: `docs/notes/tables.md`."));
    body(&mut document, &summary, &Speed::of(&summary.cases), nights)?;
    Ok(document.markdown())
}

fn lines(text: &str, most: usize) -> Text {
    text.lines().take(most).map(Text::from).reduce(Text::then_below).unwrap_or_default()
}

fn body(document: &mut Document, summary: &Summary, speed: &Speed, programs: &Sheet) -> Result<(), Error> {
    if !speed.is_empty() {
        document.section("", "Speed against error");
        document.paragraph(speed.advice());
        document.table("", speed.table());
    }
    for command in bless_commands(summary) {
        let text = Text::from("If the drift is meant, accept it with ");
        document.paragraph(text.then(Text::code(command)).then("."));
    }
    document.table("", programs.clone());
    failures(document, summary);
    for basis in criteria::BASES {
        let table = criteria::remedies(basis).fill(summary.records());
        section(document, format!("Remedies against criteria, {basis}"), table);
    }
    for study in &summary.cases {
        let case = cases::find(&study.case)?;
        let shown = |c: &&Convergence| {
            let mut headlines = case.headlines.iter();
            let shows = |m: Metric| m.name == c.metric;
            c.set == case.ladder && headlines.any(|h| h.metric.is_some_and(shows))
        };
        section(document, format!("Orders, {}", study.case), orders(study.convergence.iter().filter(shown)));
    }
    Ok(())
}

/// Adds a section with a table, unless that is empty.
fn section(document: &mut Document, title: impl Into<Text>, table: impl Into<Table>) {
    let table = table.into();
    if !table.rows.is_empty() {
        document.section("", title);
        document.table("", table);
    }
}

/// Programs that made the runs, case by case.
pub(super) fn programs(summary: &Summary) -> Sheet {
    let row = |study: &CaseStudy| {
        [study.case.clone(), study.records.len().to_string()].into_iter().chain(words::made_by(study)).collect()
    };
    Sheet::new(["case", "runs", "program", "night", "commit"]).with(summary.cases.iter().map(row))
}

fn failures(document: &mut Document, summary: &Summary) {
    for (_, record, message) in verdicts::broken(summary) {
        let run = format!(": {} {} {}: {message}", record.case, record.scheme(), record.level);
        document.paragraph(Text::marked("**Broke down**").then(run));
    }
    let failed = summary.verdicts().filter(|(.., v)| v.misses_the_truth());
    let failed = failed.map(|(study, run, v)| {
        let run = run.map_or_else(|| "runs together".to_owned(), Record::folder);
        (Some(format!("{} {run}", study.case).into()), v)
    });
    section(document, "Failed checks", verdicts::table(failed));
    section(document, "Drift", verdicts::drift(summary));
}

/// The order of every error, if there is one.
fn orders<'a>(convergence: impl Iterator<Item = &'a Convergence>) -> Sheet {
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
    Sheet::new(head).with(convergence.filter(|c| c.is_error).map(row))
}

#[cfg(test)]
mod tests {
    use super::*;
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
                run.measure(&[("mean_stress_rms_error", -h * h), ("tip_ux", h)]);
                records.push(run);
            }
        }
        let all = convergence(cases::find("cook").unwrap(), &records);
        let text = orders(all.iter()).markdown();
        let rows: Vec<&str> = text.lines().skip(2).collect();
        let row = |changed: &str| {
            format!("| mean_stress_rms_error | gimp none | {changed} | h2–h0.5 | -0.25 | 2.00 ± 0.00 | 2.00, 2.00 |")
        };
        assert_eq!(rows, [row(""), row("load=2")]);
    }
}
