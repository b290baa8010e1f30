//! Results of another code, beside ours.

use super::convergence::by_level;
use super::describe::{found, run_line, verdict_line, verification, verification_json};
use super::document::Document;
use super::document::terminal::{aligned, wrapped};
use super::prelude::*;
use super::{board, verdicts};
use crate::foreign::Asked;
use crate::score::board::Method;
use crate::score::{Scored, Scores, gate::Gate};

/// Most names of columns in a note.
const MOST: usize = 20;

/// Each run as a line of the board, and ours of the same level and parameters.
///
/// # Errors
/// The file of rows is damaged.
pub fn beside(scores: &Scores) -> Result<Vec<Vec<Method>>, Error> {
    let rows = board::kept()?;
    let of = |scored: &Scored| {
        let asked = &scored.record;
        let same = |r: &Record| {
            let equal = asked.is_default() || r.parameters == asked.parameters;
            r.status == Status::Ok && r.level == asked.level && equal
        };
        let ours = board::ours(scored.case, &rows, asked.is_default(), same)?;
        Ok([vec![Method::alone(scored)], ours].concat())
    };
    scores.runs.iter().map(of).collect()
}

/// Title of a run: code, scheme, case, level, parameters.
fn title(scored: &Scored) -> String {
    let code = &scored.manifest.code;
    let version = code.version.as_ref().map(|v| format!(" {}", v.0));
    let set = scored.record.set.iter().map(|set| format!(", {set}"));
    let words = [Some(&scored.manifest.scheme), scored.manifest.repeat.as_ref()];
    format!(
        "{} {}{}: {}{} ({})",
        scored.case.name,
        scored.name(),
        set.collect::<String>(),
        code.name.0,
        version.unwrap_or_default(),
        words.into_iter().flatten().map(|line| &*line.0).collect::<Vec<_>>().join(", ")
    )
}

/// Columns that are missing, and columns that the case does not use.
fn notes(scored: &Scored) -> Vec<String> {
    let missing: Vec<String> = scored.missing.iter().map(Asked::place).collect();
    let told = [("Not given", &missing), ("Not asked for", &scored.unknown)];
    let told = told.into_iter().filter(|(_, names)| !names.is_empty());
    let listed = |names: &[String]| match names.len().checked_sub(MOST) {
        None | Some(0) => names.join(", "),
        Some(more) => format!("{} and {more} more", names[..MOST].join(", ")),
    };
    told.map(|(what, names)| format!("{what}: {}.", listed(names))).collect()
}

/// The reason why no run of ours stands beside a result, if none does.
fn absent(lines: &[Method]) -> Option<&'static str> {
    (lines.len() < 2).then_some("Our runs: none is kept of this level and these parameters.")
}

/// Names of runs that are judged together, and the case's quantities by level.
fn ladders(scores: &Scores) -> impl Iterator<Item = (String, &CaseStudy, Sheet)> {
    let name = |c: &Convergence| [std::slice::from_ref(&c.metric), &c.set].concat().join(" ");
    scores.together.iter().filter(|(_, study)| study.records.len() > 1).map(move |(runs, study)| {
        let levels = by_level(scores.case, &study.convergence.iter().collect::<Vec<_>>(), ("quantity", name));
        (format!("{runs} together"), study, levels)
    })
}

/// The verdict: of a run in one line; of a list a line a run, failures and counts too.
#[must_use]
pub fn verdict(scores: &Scores) -> String {
    match &scores.runs[..] {
        [run] if !scores.is_list() => run_line(&run.record),
        runs => {
            let line = |run: &Scored| wrapped(&format!("{}: {}", run.name(), sentence(&run.record)), "", "  ");
            runs.iter().map(line).collect::<String>() + &verification(&scores.summary())
        }
    }
}

/// On the terminal: of each run what is measured, verdicts and our runs; of runs together verdicts and orders; the verdict.
#[must_use]
pub fn text(scores: &Scores, lines: &[Vec<Method>]) -> String {
    let runs = scores.runs.iter().zip(lines).map(|(run, lines)| of_run(run, lines));
    let together = ladders(scores).map(|(name, study, levels)| {
        let verdicts: String = study.verdicts.iter().map(verdict_line).collect();
        format!("{}\n{verdicts}\n{}\n", wrapped(&name, "", "  "), aligned(levels))
    });
    runs.chain(together).collect::<String>() + &verdict(scores)
}

fn of_run(scored: &Scored, lines: &[Method]) -> String {
    let record = &scored.record;
    let mut t = wrapped(&title(scored), "", "  ") + "\n";
    t += &found(scored.case, record);
    t.extend(notes(scored).iter().map(|note| wrapped(note, "", "  ")));
    let _ = writeln!(t, "\n{}", aligned(board::lines(lines, false)));
    t.extend(absent(lines).map(|said| wrapped(said, "", "  ")));
    t + if scored.manifest.run > 0 { "\n" } else { "" }
}

/// As JSON: a run, or a list of runs.
#[must_use]
pub fn json(scores: &Scores, lines: &[Vec<Method>], gate: &Gate) -> Value {
    let mut runs: Vec<Value> = scores.runs.iter().zip(lines).map(|(run, lines)| run_json(run, lines)).collect();
    let mut all = if scores.is_list() { verification_json(&scores.summary()) } else { runs.remove(0) };
    if scores.is_list() {
        let together = ladders(scores).map(
            |(name, study, _)| json!({"name": name, "verdicts": study.verdicts, "convergence": study.convergence}),
        );
        all["runs"] = runs.into();
        all["together"] = together.collect();
    }
    all["exit_code"] = json!(gate.exit_code(scores) as u8);
    all["refusal"] = json!(gate.refusal(scores));
    all
}

fn run_json(scored: &Scored, lines: &[Method]) -> Value {
    let record = &scored.record;
    json!({
        "code": scored.manifest.code.name.0,
        "scheme": scored.manifest.scheme.0,
        "case": record.case,
        "level": record.level,
        "set": record.set,
        "outcome": outcome_of_run(record),
        "verdict": sentence(record),
        "metrics": record.metrics,
        "verdicts": record.verdicts,
        "ours": lines.iter().skip(1).collect::<Vec<_>>(),
    })
}

/// Writes `score.md` and `verdicts.json`.
///
/// # Errors
/// A file can't be written.
pub fn write(scores: &Scores, lines: &[Vec<Method>], gate: &Gate, folder: &Path) -> Result<(), Error> {
    let mut document = Document::new(board::inert(&format!("{}: {}", scores.case.title, scores.code)));
    gate.refusal(scores).into_iter().for_each(|refusal| document.paragraph(refusal + "."));
    for (run, lines) in scores.runs.iter().zip(lines) {
        document.section("", board::inert(&title(run)));
        document.paragraph(sentence(&run.record) + ".");
        document.table("", board::lines(lines, false));
        absent(lines).into_iter().for_each(|said| document.paragraph(said));
        document.table("", verdicts::table(run.record.verdicts.iter().map(|v| (None, v))));
        notes(run).iter().for_each(|note| document.paragraph(board::inert(note)));
    }
    for (name, study, levels) in ladders(scores) {
        document.section("", name);
        document.table("", levels);
        document.table("", verdicts::table(study.verdicts.iter().map(|v| (None, v))));
    }
    make_folder(folder)?;
    write_json(&folder.join("verdicts.json"), &json(scores, lines, gate))?;
    write_whole(&folder.join("score.md"), document.markdown().as_bytes())
}
