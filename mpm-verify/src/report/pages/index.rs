//! The index: the result and cost of every scheme in every case, and the cases.

use super::{docs, file_of, in_repository, pictures, run};
use crate::report::document::{Cell, Document, Row, Shown, Table, Text, prose};
use crate::report::fate::Fate;
use crate::report::prelude::*;
use crate::report::speed::Speed;
use crate::report::summary::programs;
use crate::report::verdicts::{self, tightest};
use crate::report::{map, words::OUTCOMES, words::made_by};

/// The sections and the other files of a report.
pub(super) fn links() -> Vec<Text> {
    let sections = [
        ("Map", "#map"),
        ("Speed against error", "#speed"),
        ("Cases", "#cases"),
        ("Legend", "#legend"),
        ("Failures", "#failed"),
        ("Programs", "#programs"),
        ("Seeded faults", "faults.html"),
    ];
    let files = ["summary.md", "summary.json", "junit.xml"].map(|file| (file, file));
    sections.into_iter().chain(files).map(|(name, to)| Text::link(name, to)).collect()
}

pub(super) fn page(summary: &Summary, speed: &Speed, picture: Option<Picture>, out: &Path) -> Result<Document, Error> {
    let mut page = Document::new(Text::from("Verification, tier ").then(Text::code(&*summary.tier)));
    let counts = summary.counts.to_string();
    let result = match summary.exit_code() as u8 {
        0 => Text::mark("✓ nothing failed", "pass"),
        _ => Text::mark("✗", "fail").then(" ").then(Text::link("something failed", "#failed")),
    };
    let about = "The locking-free material point method against exact solutions, independent references and published results. ";
    let readme = in_repository("which scheme to take", "README.md#which-scheme-to-take", "HEAD");
    let about = Text::from(about).then("The README says ").then(readme).then(". ");
    page.paragraph(about.then(result).then_below(counts.lines().next().unwrap_or_default()));
    page.note(origin(summary));
    of_map(&mut page, summary, speed);
    price(&mut page, summary, speed, picture.map(|p| Shown::of(&p, out)));
    page.section("cases", "Cases");
    page.table("Cases", of_cases(summary, out)?);
    for line in counts.lines() {
        page.note(line);
    }
    page.note(Text::marked("Definition, known results and tolerances of a case: `docs/CASE.md`."));
    legend(&mut page);
    failed(&mut page, summary);
    page.section("programs", "Programs");
    page.table("Programs", programs(summary));
    Ok(page)
}

/// Program, night, commit and machines of the runs.
fn origin(summary: &Summary) -> Text {
    let machines = summary.records().map(|r| {
        let m = &r.machine;
        format!("{} {}, {} cores, threads per run: {}", m.os, m.arch, m.cores, m.threads)
    });
    let machines = distinct(machines).join("; ");
    match &distinct(summary.cases.iter().map(made_by))[..] {
        [[program, night, _]] if night == "–" => format!("{program}; {machines}.").into(),
        [[program, night, commit]] => format!("{program}; night {night}, commit {commit}; {machines}.").into(),
        _ => Text::link("Several programs", "#programs").then(format!("; {machines}.")),
    }
}

fn of_map(page: &mut Document, summary: &Summary, speed: &Speed) {
    page.section("map", "Map: result of every scheme in every case");
    let panels = map::panels(summary.records(), speed);
    if panels.is_empty() {
        return page.paragraph("No runs.");
    }
    let key = |[symbol, text, class]: [&str; 3]| Text::mark(symbol, &format!("key {class}")).then(format!(" {text}"));
    page.paragraph(Text::joined(Fate::ALL.map(Fate::shown).map(key), " · "));
    prose("map").for_each(|text| page.note(text));
    for panel in panels {
        page.heading(3, "", panel.name);
        let title = |case: &str| Text::link(case, format!("{case}.html"));
        page.table(format!("Map, {}", panel.name), panel.table(title, true));
        if !panel.errors.is_empty() {
            page.note(Text::from("Errors of runs that broke down: ").then(panel.marks()));
        }
    }
}

fn price(page: &mut Document, summary: &Summary, speed: &Speed, picture: Option<Shown>) {
    page.section("speed", "Speed against error: cost of accuracy");
    if speed.is_empty() {
        return prose("too-few-levels").for_each(|text| page.paragraph(text));
    }
    match ["nightly", "long"].contains(&&*summary.tier) {
        true => page.classed("lead", speed.advice()),
        false => prose("few-runs").for_each(|text| page.paragraph(text)),
    }
    if let Some(picture) = picture {
        page.picture(picture);
    }
    page.table("Speed against error", speed.table());
    prose("speed").for_each(|text| page.note(text));
}

/// The cases: how their runs came out, their tightest margins, what they cost.
fn of_cases(summary: &Summary, out: &Path) -> Result<Table, Error> {
    let row = |study: &CaseStudy| -> Result<Row, Error> {
        let case = cases::find(&study.case)?;
        let name = Text::link(case.title, file_of(study));
        let name = name.then_below(Text::code(case.name)).then(" · ").then(docs(study));
        let thumb = pictures(study, out).into_iter().next().map(|p| {
            let still = if p.still.is_empty() { p.file } else { p.still };
            Text::thumb(p.caption, still)
        });
        let best = tightest(case, study).map_or_else(
            || Text::from("–"),
            |(margin, metric, run)| Text::from(margin).then_below(Text::mark(format!("{metric}, {run}"), "note")),
        );
        let together = study.verdicts.iter().filter(|v| v.failed()).count();
        let counts = OUTCOMES.map(|outcome| {
            let runs = study.records.iter().filter(|r| outcome_of_run(r) == outcome).count();
            match (outcome, runs + together) {
                (Outcome::Failed, n) if n > 0 => Text::mark(format!("✗ {n}"), "fail"),
                _ => runs.to_string().into(),
            }
        });
        let sum = |of: fn(&Record) -> f64| study.records.iter().fold(0.0, |sum, r| sum + of(r));
        let pairs = format!("{:.2}", 1e-9 * sum(|r| r.work.particle_node_pairs as f64));
        let numbers = counts.into_iter().chain([pairs.into(), format!("{:.1}", sum(|r| r.time.cpu_s)).into()]);
        let first = [Cell::head(name), thumb.unwrap_or_default().into(), best.into()];
        Ok(first.into_iter().chain(numbers.map(|n| Cell::of(n, "num"))).into())
    };
    let head = ["case", "", "tightest margin of a wanted quantity among right runs"].map(Cell::from);
    let numbers = ["right", "wrong as known", "not judged", "FAILED", "10⁹ pairs", "CPU (s)"];
    let numbers = numbers.map(|title| Cell::of(title, "num"));
    Ok(Table {
        class: "",
        head: head.into_iter().chain(numbers).collect(),
        rows: summary.cases.iter().map(row).collect::<Result<_, Error>>()?,
    })
}

fn legend(page: &mut Document) {
    page.section("legend", "Legend");
    page.list(OUTCOMES.into_iter().zip(prose("outcomes")).map(|(outcome, says)| Text::badge(outcome).then(says)));
    prose("schemes").for_each(|text| page.paragraph(text));
    page.list(prose("names"));
}

fn failed(page: &mut Document, summary: &Summary) {
    page.section("failed", "Failures");
    let broken = verdicts::broken(summary).map(|(study, record, message)| {
        Text::marked("**⚠ Broke down:** ").then(run(study, Some(record))).then(format!(": {message}"))
    });
    let broken: Vec<Text> = broken.collect();
    let failures = |which: fn(&Verdict) -> bool| {
        summary.verdicts().filter(move |(.., v)| which(v)).map(|(study, record, v)| (Some(run(study, record)), v))
    };
    let table = verdicts::table(failures(Verdict::misses_the_truth).chain(failures(Verdict::drifts)));
    if broken.is_empty() && table.rows.is_empty() {
        page.paragraph("Nothing.");
    }
    for text in broken {
        page.classed("error", text);
    }
    if !table.rows.is_empty() {
        page.table("Failed checks", table);
    }
}
