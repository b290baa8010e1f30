//! The page of a case: its verdict in a sentence, a picture, errors by scheme and level, what they cost; the rest is
//! folded.

use super::{anchor, pictures, run};
use crate::draw::sketch;
use crate::report::convergence::by_level;
use crate::report::document::{Cell, Document, Row, Table, Text};
use crate::report::faults::{self, Seen};
use crate::report::prelude::*;
use crate::report::price::Prices;
use crate::report::verdicts::{self, tightest};
use crate::report::words::{OUTCOMES, made_by};
use crate::spec::Level;

pub(super) fn page(case: &Case, study: &CaseStudy, seeded: &BTreeMap<String, Seen>, out: &Path) -> Document {
    let mut page = Document::new(case.title);
    let mut lead = Text::from(sentence(study));
    if let Some((margin, metric, run)) = tightest(case, study) {
        lead = lead
            .then(format!(" Tightest margin of a wanted quantity: {margin} ("))
            .then(Text::code(metric))
            .then(format!(", {}).", run));
    }
    page.classed("lead", lead);
    page.paragraph(case.description);
    let failed = study.all_verdicts().filter(|(_, v)| v.failed());
    let failed = verdicts::table(failed.map(|(record, v)| (Some(run(study, record)), v)));
    let has_failed = !failed.rows.is_empty();
    if has_failed {
        page.section("failed", "Failures");
        page.table("Failed checks", failed);
    }
    let mut pictures = pictures(study, out).into_iter();
    if let Some(first) = pictures.next() {
        page.picture(first);
    }
    errors(&mut page, case, study);
    let prices = Prices::of(study);
    if !prices.is_empty() {
        page.section("cost", "Cost of an error");
    }
    for p in prices {
        let (target, label) = (p.aim(), p.label);
        page.paragraph(format!("To reach {target} in {label}, the least error that half of the schemes reach:"));
        page.table(format!("Cost of {label}"), p.table());
    }
    if pictures.len() > 0 {
        page.section("pictures", "Pictures");
    }
    for picture in pictures {
        page.picture(picture);
    }
    page.section("more", "More");
    let tables = case.tables.iter().map(|table| (&*table.name, table.fill(&study.records).dense()));
    let tables: Vec<(&str, Sheet)> = tables.filter(|(_, sheet)| !sheet.rows.is_empty()).collect();
    if !tables.is_empty() {
        page.folded("tables", "Tables", |page| {
            for (name, sheet) in tables {
                page.heading(3, "", Text::code(name));
                page.table(name, sheet);
            }
        });
    }
    let runs = study.records.len();
    page.folded("runs", format!("Runs ({runs}), and what decides their verdicts"), |page| {
        let file = format!("{}/verdicts.csv", case.name);
        page.note(Text::marked(&format!("Every verdict, with its source: [verdicts.csv]({file}).")));
        page.table("Runs", of_runs(case, study));
    });
    page.folded("checks", "Checks, and how often each came out how", |page| {
        page.note(Text::marked(&format!(
            "Faults seen: of {} put into the code on purpose, those that turn the check red ([which](faults.html)).",
            seeded.len()
        )));
        page.table("Checks", checks(case, study, seeded));
    });
    if !study.verdicts.is_empty() {
        let title = "Verdicts on runs together";
        page.folded("together", format!("{title} ({})", study.verdicts.len()), |page| {
            page.table(title, verdicts::table(study.verdicts.iter().map(|v| (None, v))));
        });
        if has_failed {
            page.unfold();
        }
    }
    set_up(&mut page, case);
    page.folded("limits", "What the case does not show", |page| {
        page.list(case.limits.iter().copied());
    });
    page.folded("metrics", "Metrics, and what made the runs", |page| {
        let metrics = case.metrics.iter().map(|m| [m.name, m.unit, m.meaning].map(str::to_owned).into());
        page.table("Metrics", Sheet::new(["metric", "unit", "meaning"]).with(metrics));
        page.facts(["program", "night", "commit"].into_iter().zip(made_by(study)));
    });
    page
}

/// How the runs of a case came out, in a sentence.
fn sentence(study: &CaseStudy) -> String {
    let limits = study.all_verdicts().filter(|(_, v)| v.outcome == Outcome::WrongAsKnown);
    let limits = distinct(limits.map(|(_, v)| &*v.check));
    let seen = match limits.is_empty() {
        true => String::new(),
        false => format!(" Known limits seen: {}.", limits.join(", ")),
    };
    let counts = Summary::new("", vec![study.clone()]).counts.to_string();
    counts.lines().next().unwrap_or_default().to_owned() + &seen
}

/// The quantities of the case, scheme by level; of more than two the others are folded.
fn errors(page: &mut Document, case: &Case, study: &CaseStudy) {
    let tables = case.quantities.iter().filter_map(|q| {
        let own = study.convergence.iter();
        let own: Vec<_> = own.filter(|c| c.set == case.ladder && c.metric == q.metric.name).collect();
        (!own.is_empty()).then(|| (q, by_level(case, &own, ("scheme", |c| c.scheme.to_string()))))
    });
    let mut tables: Vec<(&Quantity, Sheet)> = tables.collect();
    if tables.is_empty() {
        return;
    }
    let changed = if case.ladder.is_empty() { String::new() } else { format!(", {}", case.ladder.join(" ")) };
    page.section("errors", format!("Errors by scheme and level{changed}"));
    let others = tables.split_off(tables.len().min(2));
    let show = |page: &mut Document, tables: Vec<(&Quantity, Sheet)>| {
        for (quantity, table) in tables {
            page.heading(3, "", quantity.label);
            page.table(quantity.label, table);
        }
    };
    show(page, tables);
    if !others.is_empty() {
        page.folded("", format!("{} more", others.len()), |page| show(page, others));
    }
    let name = case.name;
    page.note(Text::marked(&format!(
        "Orders by least squares, with 95 % confidence (Student's t); of a value without a reference, Richardson's. All sets of \
         parameters: [convergence.csv]({name}/convergence.csv), [study.json]({name}/study.json)."
    )));
}

/// Most checks that a line names.
const SHOWN: usize = 2;

/// A run on a line: what decides its verdict, what the case shows of it, what it cost.
fn of_runs(case: &Case, study: &CaseStudy) -> Table {
    let row = |r: &Record| {
        let outcome = outcome_of_run(r);
        let own = r.verdicts.iter().filter(|v| v.outcome == outcome && outcome != Outcome::Right);
        let deciding = distinct(own.filter(|v| v.decides()).map(|v| &*v.check));
        let why = match &r.error {
            Some(e) => format!("broke down at {} s", number(Some(e.time))),
            None if deciding.len() > SHOWN => format!("{}, …", deciding[..SHOWN].join(", ")),
            None => deciding.join(", "),
        };
        let (level, set) = (r.level.clone(), r.set.join(" "));
        let first = [Cell::head(r.scheme().to_string()), level.into(), set.into()];
        let verdict = [Text::badge(outcome).into(), why.into()];
        let values = case.headlines.iter().map(|h| h.of_run(r)).chain([number(Some(r.time.cpu_s))]).map(Cell::from);
        Row { id: anchor(r), cells: first.into_iter().chain(verdict).chain(values).collect() }
    };
    let head = ["scheme", "level", "changed", "verdict", "for"].map(Cell::from);
    let values = case.headlines.iter().map(|h| Cell::from(&*h.title));
    Table {
        class: "numbers",
        head: head.into_iter().chain(values).chain(["CPU (s)".into()]).collect(),
        rows: study.records.iter().map(row).collect(),
    }
}

/// Every check with its outcomes and the number of seeded faults that it sees: those that the case declares, then those that
/// every case has.
fn checks(case: &Case, study: &CaseStudy, seeded: &BTreeMap<String, Seen>) -> Table {
    let all = || study.all_verdicts().map(|(_, v)| v);
    let is_declared = |v: &Verdict| case.checks.iter().any(|c| c.name == v.check);
    let others = all().filter(|v| v.kind != Kind::Drift && !is_declared(v));
    let others = distinct(others.map(|v| (&*v.check, v.kind, &*v.source)));
    let declared = case.checks.iter().map(|c| (c.name, c.kind, c.statement));
    let row = |(name, of, statement): (&str, Kind, &str)| -> Row {
        let count =
            |outcome| Cell::of(all().filter(|v| v.check == name && v.outcome == outcome).count().to_string(), "num");
        let seen = match faults::seen(seeded, case.name, name) {
            0 => String::new(),
            n => n.to_string(),
        };
        let first = [Cell::head(name), Cell::of(kind(of), "tight")];
        let last = [Cell::of(seen, "num"), Cell::of(statement, "wordy")];
        first.into_iter().chain(OUTCOMES.map(count)).chain(last).into()
    };
    let head = ["check", "kind", "right", "wrong as known", "not judged", "FAILED", "faults seen", "statement"];
    Table { class: "", head: head.map(Cell::from).to_vec(), rows: declared.chain(others).map(row).collect() }
}

fn set_up(page: &mut Document, case: &Case) {
    let title = "Set-up: geometry, parameters, schemes, levels, references";
    page.folded("set-up", title, |page| {
        page.drawing(sketch::svg(&case.sketch, case.title), case.sketch.description);
        let parameters = case
            .parameters
            .iter()
            .map(|p| [p.name, p.unit, p.default, &p.domain.to_string(), p.meaning].map(str::to_owned).into());
        page.table("Parameters", Sheet::new(["name", "unit", "default", "allowed", "meaning"]).with(parameters));
        page.heading(3, "", "Schemes");
        page.paragraph(Text::joined(case.schemes().into_iter().map(|s| Text::code(s.to_string())), ", "));
        page.heading(3, "", "Levels");
        let level = |l: &Level| Text::code(l.name).then(format!(": cells of {} m", l.h));
        page.paragraph(Text::joined(case.levels.iter().map(level), ", "));
        page.heading(3, "", "References");
        page.list(case.references.iter().cloned());
    });
}
