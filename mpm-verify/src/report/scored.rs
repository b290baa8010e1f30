//! A result of another code, beside ours.

use super::describe::{WIDTH, cut, judged, measured, run_line, wrapped};
use super::rows;
use super::tables::RESULTS;
use super::words::{outcome, sentence};
use crate::error::Error;
use crate::files::{make_folder, write_json, write_whole};
use crate::foreign::Asked;
use crate::record::{Record, Status};
use crate::results::fixed;
use crate::score::Scored;
use crate::study::judge::{exit_code, outcome_of_run};
use crate::table::Sheet;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Narrowest column of a table on the terminal, whose titles take several lines.
const NARROW: usize = 9;
/// Blanks before a column.
const GAP: usize = 2;
/// Longest name of a code in the table.
const LONGEST: usize = 36;

/// Our runs of the same level and parameters, from the rows that are kept.
pub struct Ours {
    runs: Vec<Record>,
    /// Why there are none.
    absent: Option<String>,
}

impl Ours {
    /// Those beside which a result is set: from the rows of the working directory, or else of the checkout that the program
    /// was built from.
    ///
    /// # Errors
    /// The file of rows is damaged.
    pub fn beside(scored: &Scored) -> Result<Self, Error> {
        let built = || {
            Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("..")
                .join(RESULTS)
        };
        let here = PathBuf::from(RESULTS);
        let file = if here.exists() { here } else { built() };
        if !file.exists() {
            let absent = format!("our runs: no {RESULTS} here; a checkout of the project has it");
            return Ok(Self {
                runs: Vec::new(),
                absent: Some(absent),
            });
        }
        let of_case = |row: &rows::Row| row.case == scored.case.name;
        let kept = rows::read(&file)?.into_iter().filter(of_case);
        let kept: Vec<Record> = kept.filter_map(|row| row.record()).collect();
        let asked = &scored.record;
        let own = match asked.is_default() {
            true => (scored.case.own_runs)(&kept),
            false => kept
                .iter()
                .filter(|r| r.parameters == asked.parameters)
                .collect(),
        };
        let same = own.into_iter().filter(|r| r.level == asked.level);
        let mut runs: Vec<Record> = same.filter(|r| r.status == Status::Ok).cloned().collect();
        runs.sort_by_key(|r| (r.transfer(), r.basis(), r.remedy()));
        let none = "our runs: none is kept of this level and these parameters";
        let absent = runs.is_empty().then(|| none.to_owned());
        Ok(Self { runs, absent })
    }
}

/// The result and our runs, a row each: what is measured of the result, and what it took.
fn table(scored: &Scored, ours: &Ours) -> Sheet {
    let seen = |m: &str| scored.record.metrics.contains_key(m);
    let columns = || {
        let columns = scored.case.headlines.iter();
        columns.filter(|c| c.metric.is_some_and(|m| seen(m.name)))
    };
    let mut head = vec!["scheme".to_owned()];
    head.extend(columns().map(|c| c.title.clone()));
    head.extend(["CPU (s)", "own verdict"].map(str::to_owned));
    let row = |name: String, r: &Record| {
        let mut row = vec![name];
        row.extend(columns().map(|c| c.of_run(r)));
        row.push(fixed(0).text(r.time.cpu_s));
        row.push(outcome(outcome_of_run(r)).to_owned());
        row
    };
    let own = row(cut(&scored.manifest.code.name.0, LONGEST), &scored.record);
    let others = ours.runs.iter().map(|r| row(r.scheme().title(), r));
    Sheet::new(head).with(std::iter::once(own).chain(others))
}

/// Widths of the columns of a table, whose titles are broken.
fn widths(sheet: &Sheet) -> Vec<usize> {
    let width = |k: usize| {
        let cells = sheet.rows.iter().map(|row| row[k].chars().count());
        cells.max().unwrap_or(0).max(NARROW)
    };
    (0..sheet.head.len()).map(width).collect()
}

/// As many columns as fit the terminal: of those between the first and the last two, the first ones.
fn fitting(mut sheet: Sheet) -> Sheet {
    let whole = |sheet: &Sheet| widths(sheet).iter().map(|width| width + GAP).sum::<usize>();
    while whole(&sheet) > WIDTH && sheet.head.len() > 4 {
        let last = sheet.head.len() - 3;
        sheet.head.remove(last);
        for row in &mut sheet.rows {
            row.remove(last);
        }
    }
    sheet
}

/// A table in columns of blanks.
fn aligned(sheet: &Sheet) -> String {
    let widths = widths(sheet);
    let titles = sheet.head.iter().zip(&widths);
    let titles: Vec<Vec<String>> = titles
        .map(|(title, width)| {
            let lines = textwrap::wrap(title, *width);
            lines.iter().map(ToString::to_string).collect()
        })
        .collect();
    let height = titles.iter().map(Vec::len).max().unwrap_or(0);
    let line = |cells: Vec<&str>| {
        let cells = cells.iter().zip(&widths).enumerate();
        let cells = cells.map(|(k, (cell, width))| match k {
            0 => format!("{:GAP$}{cell:<width$}", ""),
            _ => format!("{:GAP$}{cell:>width$}", ""),
        });
        cells.collect::<String>().trim_end().to_owned() + "\n"
    };
    let head = (0..height).map(|k| {
        let cell = |title: &'_ Vec<String>| (k + title.len()).checked_sub(height);
        let cells = titles
            .iter()
            .map(|t| cell(t).map_or("", |place| &*t[place]));
        line(cells.collect())
    });
    let rows = sheet
        .rows
        .iter()
        .map(|row| line(row.iter().map(String::as_str).collect()));
    head.chain(rows).collect()
}

/// What the result is of: code, scheme, case, level, parameters.
fn title(scored: &Scored) -> String {
    let code = &scored.manifest.code;
    let version = code.version.as_ref().map(|v| format!(" {}", v.0));
    let set = scored.record.set.iter().map(|set| format!(", {set}"));
    format!(
        "{} {}{}: {}{} ({})",
        scored.case.name,
        scored.record.level,
        set.collect::<String>(),
        code.name.0,
        version.unwrap_or_default(),
        scored.manifest.scheme.0
    )
}

/// What is not there, and what is not asked for.
fn notes(scored: &Scored) -> Vec<String> {
    let names = |columns: &[Asked]| {
        let names = columns
            .iter()
            .map(|c| format!("{} of the {}", c.header(), c.part.name()));
        names.collect::<Vec<_>>().join(", ")
    };
    let mut notes = Vec::new();
    if !scored.missing.is_empty() {
        notes.push(format!("Not given: {}.", names(&scored.missing)));
    }
    if !scored.unknown.is_empty() {
        notes.push(format!("Not asked for: {}.", scored.unknown.join(", ")));
    }
    notes
}

/// On the terminal: what is measured, verdicts, our runs, and the verdict in one line.
#[must_use]
pub fn text(scored: &Scored, ours: &Ours) -> String {
    let record = &scored.record;
    let mut t = wrapped(&title(scored), "", "  ") + "\n";
    t += &measured(scored.case, record);
    t += "\n";
    t += &judged(record);
    t.extend(notes(scored).iter().map(|note| wrapped(note, "", "  ")));
    let _ = writeln!(t, "\n{}", aligned(&fitting(table(scored, ours))));
    if let Some(absent) = &ours.absent {
        t += &wrapped(absent, "", "  ");
    }
    t + &run_line(record)
}

/// As JSON.
#[must_use]
pub fn json(scored: &Scored, ours: &Ours) -> Value {
    let record = &scored.record;
    let others = ours.runs.iter();
    let others = others.map(|r| {
        json!({"scheme": r.scheme, "metrics": r.metrics, "cpu_s": r.time.cpu_s,
            "outcome": outcome_of_run(r)})
    });
    json!({
        "code": scored.manifest.code.name.0,
        "scheme": scored.manifest.scheme.0,
        "case": record.case,
        "level": record.level,
        "set": record.set,
        "exit_code": exit_code(record) as u8,
        "outcome": outcome_of_run(record),
        "verdict": sentence(record),
        "metrics": record.metrics,
        "verdicts": record.verdicts,
        "ours": others.collect::<Value>(),
    })
}

/// Writes `score.md` and `verdicts.json`.
///
/// # Errors
/// A file can't be written.
pub fn write(scored: &Scored, ours: &Ours, folder: &Path) -> Result<(), Error> {
    let record = &scored.record;
    let mut t = format!("# {}\n\n{}.\n\n", title(scored), sentence(record));
    t += &table(scored, ours).markdown();
    if let Some(absent) = &ours.absent {
        let _ = writeln!(t, "\n{absent}");
    }
    t += "\n## Verdicts\n\n";
    let number = |x: Option<f64>| super::words::number(x);
    let rows = record.verdicts.iter().map(|v| {
        let numbers = [v.value, v.reference, v.tolerance].map(number);
        let [value, reference, tolerance] = numbers;
        let (check, metric, why) = (v.check.clone(), v.metric.clone(), v.source.clone());
        let found = outcome(v.outcome).to_owned();
        vec![check, found, metric, value, reference, tolerance, why]
    });
    let head = [
        "check",
        "found",
        "of",
        "value",
        "reference",
        "tolerance",
        "why",
    ];
    t += &Sheet::new(head).with(rows).markdown();
    for note in notes(scored) {
        let _ = writeln!(t, "\n{note}");
    }
    make_folder(folder)?;
    write_json(&folder.join("verdicts.json"), &json(scored, ours))?;
    write_whole(&folder.join("score.md"), t.as_bytes())
}
