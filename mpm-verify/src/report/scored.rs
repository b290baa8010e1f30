//! Results of another code, beside ours.

use super::convergence::by_level;
use super::describe::{found, run_line, verdict_line, verification, verification_json};
use super::document::Document;
use super::document::terminal::{aligned, cut, wrapped};
use super::prelude::*;
use super::tables::RESULTS;
use super::{rows, verdicts};
use crate::foreign::Asked;
use crate::score::{Scored, Scores, gate::Gate};

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
    /// Those beside which each run is set: from the rows of the working directory, or else of the checkout that the program
    /// was built from.
    ///
    /// # Errors
    /// The file of rows is damaged.
    pub fn beside(scores: &Scores) -> Result<Vec<Self>, Error> {
        scores.runs.iter().map(Self::of).collect()
    }

    fn of(scored: &Scored) -> Result<Self, Error> {
        let built = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(RESULTS);
        let Some(file) = [PathBuf::from(RESULTS), built].into_iter().find(|file| file.exists()) else {
            let absent = format!("our runs: no {RESULTS} here; a checkout of the project has it");
            return Ok(Self { runs: Vec::new(), absent: Some(absent) });
        };
        let kept = rows::read(&file)?.into_iter().filter(|row| row.case == scored.case.name);
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
    let columns = || scored.case.headlines.iter().filter(|c| c.metric.is_some_and(|m| seen(m.name)));
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
pub fn text(scores: &Scores, ours: &[Ours]) -> String {
    let runs = scores.runs.iter().zip(ours).map(|(run, ours)| of_run(run, ours));
    let together = ladders(scores).map(|(name, study, levels)| {
        let verdicts: String = study.verdicts.iter().map(verdict_line).collect();
        format!("{}\n{verdicts}\n{}\n", wrapped(&name, "", "  "), aligned(levels))
    });
    runs.chain(together).collect::<String>() + &verdict(scores)
}

fn of_run(scored: &Scored, ours: &Ours) -> String {
    let record = &scored.record;
    let mut t = wrapped(&title(scored), "", "  ") + "\n";
    t += &found(scored.case, record);
    t.extend(notes(scored).iter().map(|note| wrapped(note, "", "  ")));
    let _ = writeln!(t, "\n{}", aligned(table(scored, ours)));
    t.extend(ours.absent.iter().map(|absent| wrapped(absent, "", "  ")));
    t + if scored.manifest.run > 0 { "\n" } else { "" }
}

/// As JSON: a run, or a list of runs.
#[must_use]
pub fn json(scores: &Scores, ours: &[Ours], gate: &Gate) -> Value {
    let mut runs: Vec<Value> = scores.runs.iter().zip(ours).map(|(run, ours)| run_json(run, ours)).collect();
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

fn run_json(scored: &Scored, ours: &Ours) -> Value {
    let record = &scored.record;
    let others = ours.runs.iter().map(|r| {
        json!({"scheme": r.scheme, "metrics": r.metrics, "cpu_s": r.time.cpu_s,
            "outcome": outcome_of_run(r)})
    });
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
        "ours": others.collect::<Value>(),
    })
}

/// A text of the user's as it is in Markdown: no link, picture or mark comes of it.
fn inert(text: &str) -> String {
    text.chars().flat_map(|c| if "\\`*[]!".contains(c) { vec!['\\', c] } else { vec![c] }).collect()
}

/// Writes `score.md` and `verdicts.json`.
///
/// # Errors
/// A file can't be written.
pub fn write(scores: &Scores, ours: &[Ours], gate: &Gate, folder: &Path) -> Result<(), Error> {
    let mut document = Document::new(inert(&format!("{}: {}", scores.case.title, scores.code)));
    gate.refusal(scores).into_iter().for_each(|refusal| document.paragraph(refusal + "."));
    for (run, ours) in scores.runs.iter().zip(ours) {
        document.section("", inert(&title(run)));
        document.paragraph(sentence(&run.record) + ".");
        let mut beside = table(run, ours);
        if let Some(own) = beside.rows.first_mut().and_then(|row| row.first_mut()) {
            *own = inert(own);
        }
        document.table("", beside);
        ours.absent.iter().for_each(|absent| document.paragraph(&**absent));
        document.table("", verdicts::table(run.record.verdicts.iter().map(|v| (None, v))));
        notes(run).iter().for_each(|note| document.paragraph(inert(note)));
    }
    for (name, study, levels) in ladders(scores) {
        document.section("", name);
        document.table("", levels);
        document.table("", verdicts::table(study.verdicts.iter().map(|v| (None, v))));
    }
    make_folder(folder)?;
    write_json(&folder.join("verdicts.json"), &json(scores, ours, gate))?;
    write_whole(&folder.join("score.md"), document.markdown().as_bytes())
}
