//! A result of another code, beside ours.

use super::describe::{judged, measured, run_line};
use super::document::Document;
use super::document::terminal::{aligned, cut, wrapped};
use super::rows;
use super::tables::RESULTS;
use super::verdicts;
use super::words::{outcome, sentence};
use crate::error::Error;
use crate::files::{make_folder, write_json, write_whole};
use crate::foreign::Asked;
use crate::record::{Record, Status};
use crate::results::fixed;
use crate::score::{Scored, gate::Gate};
use crate::study::judge::outcome_of_run;
use crate::table::Sheet;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Longest name of a code in the table.
const LONGEST: usize = 36;
/// Most names of columns in a note.
const MOST: usize = 20;

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
        let built = || Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(RESULTS);
        let here = PathBuf::from(RESULTS);
        let file = if here.exists() { here } else { built() };
        if !file.exists() {
            let absent = format!("our runs: no {RESULTS} here; a checkout of the project has it");
            return Ok(Self { runs: Vec::new(), absent: Some(absent) });
        }
        let of_case = |row: &rows::Row| row.case == scored.case.name;
        let kept = rows::read(&file)?.into_iter().filter(of_case);
        let kept: Vec<Record> = kept.filter_map(|row| row.record()).collect();
        let asked = &scored.record;
        let own = match asked.is_default() {
            true => (scored.case.own_runs)(&kept),
            false => kept.iter().filter(|r| r.parameters == asked.parameters).collect(),
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

/// Title of the result: code, scheme, case, level, parameters.
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

/// Columns that are missing, and columns that the case does not use.
fn notes(scored: &Scored) -> Vec<String> {
    let name = |c: &Asked| format!("{} of the {}", c.header(), c.part.name());
    let missing: Vec<String> = scored.missing.iter().map(name).collect();
    let told = [("Not given", &missing), ("Not asked for", &scored.unknown)];
    let told = told.into_iter().filter(|(_, names)| !names.is_empty());
    let listed = |names: &[String]| match names.len().checked_sub(MOST) {
        None | Some(0) => names.join(", "),
        Some(more) => format!("{} and {more} more", names[..MOST].join(", ")),
    };
    told.map(|(what, names)| format!("{what}: {}.", listed(names))).collect()
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
    let _ = writeln!(t, "\n{}", aligned(table(scored, ours)));
    if let Some(absent) = &ours.absent {
        t += &wrapped(absent, "", "  ");
    }
    t + &run_line(record)
}

/// As JSON.
#[must_use]
pub fn json(scored: &Scored, ours: &Ours, gate: &Gate) -> Value {
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
        "exit_code": gate.exit_code(scored) as u8,
        "refusal": gate.refusal(scored),
        "outcome": outcome_of_run(record),
        "verdict": sentence(record),
        "metrics": record.metrics,
        "verdicts": record.verdicts,
        "ours": others.collect::<Value>(),
    })
}

/// A text of the user's as it is in Markdown: no link, picture or mark comes of it.
fn inert(text: &str) -> String {
    let escaped = |c: char| if "\\`*[]!".contains(c) { vec!['\\', c] } else { vec![c] };
    text.chars().flat_map(escaped).collect()
}

/// Writes `score.md` and `verdicts.json`.
///
/// # Errors
/// A file can't be written.
pub fn write(scored: &Scored, ours: &Ours, gate: &Gate, folder: &Path) -> Result<(), Error> {
    let record = &scored.record;
    let mut document = Document::new(inert(&title(scored)));
    document.paragraph(sentence(record) + ".");
    gate.refusal(scored).into_iter().for_each(|refusal| document.paragraph(refusal + "."));
    let mut beside = table(scored, ours);
    if let Some(own) = beside.rows.first_mut().and_then(|row| row.first_mut()) {
        *own = inert(own);
    }
    document.table("", beside);
    ours.absent.iter().for_each(|absent| document.paragraph(&**absent));
    document.section("", "Verdicts");
    let verdicts = record.verdicts.iter().map(|v| (None, v));
    document.table("", verdicts::table(verdicts));
    for note in notes(scored) {
        document.paragraph(inert(&note));
    }
    make_folder(folder)?;
    write_json(&folder.join("verdicts.json"), &json(scored, ours, gate))?;
    write_whole(&folder.join("score.md"), document.markdown().as_bytes())
}
