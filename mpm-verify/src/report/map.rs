//! The map: how the runs of every scheme come out in every case, the worst of each, from their verdicts and what they
//! measured.

#[cfg(test)]
mod tests;

use super::document::{self, Table, Text};
use super::fate::Fate;
use super::prelude::*;
use super::speed::Speed;

/// The kinds of solvers that have a panel of their own.
pub(super) const PANELS: [&str; 3] = ["explicit", "implicit", "poro"];
/// Whose runs find the largest stable CFL number, the metric, the parameters that they change, and what the column is called.
const CRITICAL_STEP: (&str, &str) = ("critical-step", "critical_cfl");
const STEPS: [(&[&str], &str); 3] =
    [(&["dimension=1"], "CFL, 1D"), (&[], "CFL, 2D"), (&["dimension=1", "layout=cut"], "CFL, cut")];
const COST: &str = "cost ÷ least";
/// How the runs of a scheme in a case came out.
pub(super) struct Cell {
    /// A symbol and the marks of errors.
    pub(super) mark: String,
    /// In how many of the runs, unless in all.
    share: String,
    /// How many came out how, in words.
    pub(super) words: String,
    /// The classes that give its colour: one that is `few` is of less than half of the runs.
    pub(super) class: String,
}

impl Cell {
    fn of(runs: &[&Record], errors: &[&str]) -> Option<Self> {
        let fates: Vec<Fate> = runs.iter().map(|r| Fate::of(r)).collect();
        let worst = *fates.iter().max()?;
        let [symbol, _, class] = worst.shown();
        let count = |fate: Fate| fates.iter().filter(|f| **f == fate).count();
        let own = |kind: &str| runs.iter().any(|r| kind_of_error(r) == Some(kind));
        let marks = errors.iter().zip('a'..='z').filter(|(kind, _)| own(kind));
        let (kinds, marks): (Vec<&str>, String) = marks.unzip();
        let there = Fate::ALL.into_iter().filter(|fate| count(*fate) > 0);
        let told = there.map(|fate| format!("{} {}", count(fate), fate.shown()[1]));
        let told = told.chain(kinds.into_iter().map(str::to_owned));
        let (share, few) = match (count(worst), runs.len()) {
            (some, all) if some == all => (String::new(), false),
            (some, all) => (format!(" {some}/{all}"), 2 * some < all),
        };
        Some(Self {
            mark: format!("{symbol}{marks}"),
            share,
            words: told.collect::<Vec<_>>().join(", "),
            class: format!("{class}{}", if few { " few" } else { "" }),
        })
    }
}

/// The kind of error with which a run broke down, where that is kept.
fn kind_of_error(record: &Record) -> Option<&str> {
    let error = record.error.as_ref()?;
    Some(&*error.kind).filter(|kind| !kind.is_empty())
}

/// A scheme, with its numbers and a cell a case, if it has any runs there.
pub(super) struct Line {
    pub(super) scheme: String,
    pub(super) numbers: Vec<String>,
    pub(super) cells: Vec<Option<Cell>>,
}

/// The schemes of a kind of solver.
pub(super) struct Panel<'a> {
    pub(super) name: &'static str,
    pub(super) cases: Vec<&'static str>,
    /// Titles of the numbers.
    pub(super) numbers: Vec<&'static str>,
    pub(super) lines: Vec<Line>,
    /// Kinds of error, in the order of their marks.
    pub(super) errors: Vec<&'a str>,
}

/// A panel for every kind of solver that there are runs of.
pub(super) fn panels<'a>(records: impl IntoIterator<Item = &'a Record>, speed: &Speed) -> Vec<Panel<'a>> {
    let records: Vec<&Record> = records.into_iter().collect();
    let panel = |name| {
        Panel::of(name, &records.iter().filter(|r| panel_of(r.scheme()) == name).copied().collect::<Vec<_>>(), speed)
    };
    PANELS.into_iter().map(panel).filter(|panel| !panel.lines.is_empty()).collect()
}

/// The panel of its kind of solver.
fn panel_of(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Explicit(_) => PANELS[0],
        Scheme::Implicit(_) => PANELS[1],
        Scheme::Poro(_) => PANELS[2],
    }
}

impl<'a> Panel<'a> {
    fn of(name: &'static str, told: &[&'a Record], speed: &Speed) -> Self {
        let has = |case: &&str| told.iter().any(|r| r.case == **case);
        let cases: Vec<&str> = cases::all().iter().map(|case| case.name).filter(has).collect();
        let mut errors = distinct(told.iter().filter_map(|r| kind_of_error(r)));
        errors.sort_unstable();
        let mut schemes = distinct(told.iter().map(|r| r.scheme()));
        schemes.sort_by_key(|s| (s.transfer(), s.rule(), s.basis(), s.remedy(), *s));
        let line = |scheme: &Scheme| {
            let own = || told.iter().copied().filter(|r| r.scheme() == *scheme);
            let cell = |case: &&'static str| {
                let runs: Vec<&Record> = own().filter(|r| r.case == **case).collect();
                Cell::of(&runs, &errors)
            };
            let step = |(set, _): (&[&str], _)| {
                let run = own().find(|r| r.case == CRITICAL_STEP.0 && r.set == set);
                run.map_or_else(String::new, |r| fixed(2).text(r.value(CRITICAL_STEP.1)))
            };
            let numbers = STEPS.map(step).into_iter().chain([speed.median(*scheme)]);
            Line { scheme: scheme.title(), numbers: numbers.collect(), cells: cases.iter().map(cell).collect() }
        };
        let mut lines: Vec<Line> = schemes.iter().map(line).collect();
        let mut numbers: Vec<&str> = STEPS.map(|(_, title)| title).into_iter().chain([COST]).collect();
        for k in (0..numbers.len()).rev() {
            if lines.iter().all(|line| line.numbers[k].is_empty()) {
                numbers.remove(k);
                for line in &mut lines {
                    line.numbers.remove(k);
                }
            }
        }
        Self { name, cases, numbers, lines, errors }
    }

    /// The table, with the cases in columns whose titles `title` links; on a page, cells have links too.
    pub(super) fn table(&self, title: impl Fn(&str) -> Text, is_page: bool) -> Table {
        let number = |text: &str| document::Cell::of(text, "num");
        let first = |name: &str, numbers: Vec<&str>| {
            [document::Cell::head(name)].into_iter().chain(numbers.into_iter().map(number)).collect::<Vec<_>>()
        };
        let cases = self.cases.iter().map(|case| document::Cell::of(title(case), "steep"));
        let cell = |(cell, case): (&Option<Cell>, &&str)| {
            let Some(c) = cell else { return document::Cell::default() };
            let mark = match is_page {
                true => Text::link(&*c.mark, format!("{case}.html")),
                false => Text::from(&*c.mark),
            };
            document::Cell::of(mark, &c.class).titled(&*c.words).aside(&*c.share)
        };
        let row = |line: &Line| {
            let numbers = line.numbers.iter().map(String::as_str).collect();
            first(&line.scheme, numbers).into_iter().chain(line.cells.iter().zip(&self.cases).map(cell)).into()
        };
        Table {
            class: "map",
            head: first("scheme", self.numbers.clone()).into_iter().chain(cases).collect(),
            rows: self.lines.iter().map(row).collect(),
        }
    }

    /// Legend of the marks of errors; empty without marks.
    pub(super) fn marks(&self) -> Text {
        let marks = self.errors.iter().zip('a'..='z');
        let marks = marks.map(|(kind, mark)| Text::from(format!("{mark}: ")).then(Text::code(*kind)));
        if self.errors.is_empty() { Text::default() } else { Text::joined(marks, ", ").then(".") }
    }
}
