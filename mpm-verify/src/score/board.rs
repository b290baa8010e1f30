//! The board: results of other codes and of ours on the same problems, by one rule.
//!
//! Every run is judged by the checks that bind every code. Known limits of our schemes excuse nobody, ours included.

use super::*;
use crate::results::Column;
use crate::study::judge::outcome_of_run;
use serde::Serialize;
use std::fs;

/// Folders below the one that is named, down to which manifests are looked for.
const DEPTH: usize = 3;
/// Steps from which on a run is one of an explicit solver; the board shows its cost a step.
const EXPLICIT: u64 = 1000;

/// The code of our runs.
pub(crate) const OWN: &str = "this program";

/// How a run, or a method over its levels, stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    /// Right on every level, of which there are two at least.
    RightOnAll,
    /// Right on a level, or on the only one.
    Right,
    /// A check fails.
    Wrong,
    /// It did not finish.
    BrokeDown,
    /// No wanted quantity is judged.
    NotJudged,
    /// The code lacks what the case needs.
    NotPossible,
}

impl Standing {
    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::RightOnAll => "right on all levels",
            Self::Right => "right on some levels",
            Self::Wrong => "wrong",
            Self::BrokeDown => "broke down",
            Self::NotJudged => "not judged",
            Self::NotPossible => "not possible",
        }
    }

    /// That of a method by those of its runs, and whether its runs together fail a check.
    pub(super) fn over(runs: &[Self], together: bool) -> Self {
        let count = |own: Self| runs.iter().filter(|run| **run == own).count();
        match (count(Self::Right), runs.len()) {
            (right, all) if right == all && all > 1 && !together => Self::RightOnAll,
            (0, _) => runs.iter().copied().min().unwrap_or(Self::NotJudged),
            _ => Self::Right,
        }
    }
}

/// A run on a level.
#[derive(Debug, Clone, Serialize)]
pub struct Line {
    /// Level.
    pub level: String,
    /// Parameters that are not the case's own.
    pub set: Vec<String>,
    /// How it stands.
    pub standing: Standing,
    /// Why: checks that fail or are open, or what the code said.
    pub why: String,
    /// The wanted quantity that is nearest to its tolerance or farthest beyond: error over tolerance, and its check.
    pub worst: Option<(f64, String)>,
    /// Headlines on errors of the case that are measured: titles and values.
    pub told: Vec<(String, String)>,
    /// Processor time (s), if it is known.
    pub cpu_s: Option<f64>,
    /// Processor time of a particle and step (ns), of explicit runs.
    pub ns: Option<f64>,
}

/// A method of a code on a case.
#[derive(Debug, Clone, Serialize)]
pub struct Method {
    /// Case.
    pub case: &'static str,
    /// Name of the code.
    pub code: String,
    /// Its version, if it is known.
    pub version: String,
    /// Where it is found, if that is known.
    pub url: String,
    /// The scheme, in the words of whoever ran it.
    pub words: String,
    /// The part of the set-up that is not its authors', if there is one.
    pub note: String,
    /// How it stands over its levels.
    pub standing: Standing,
    /// Observed orders in h of the case's errors.
    pub orders: Vec<(String, f64)>,
    /// Coarsest first.
    pub runs: Vec<Line>,
}

impl Line {
    fn of(case: &Case, record: &Record, ending: Ending) -> Self {
        let standing = match (ending, outcome_of_run(record)) {
            (Ending::NotPossible, _) => Standing::NotPossible,
            (Ending::BrokeDown, _) => Standing::BrokeDown,
            (_, Outcome::Right) => Standing::Right,
            (_, Outcome::NotJudged) => Standing::NotJudged,
            _ => Standing::Wrong,
        };
        let wanted = |v: &&Verdict| v.kind == Kind::Truth && case.wanted.iter().any(|w| w.is_judged_by(&v.check));
        let over = |v: &Verdict| {
            // A bound that is missed counts from the other side.
            let used = v.used()?;
            Some((if v.failed() && used < 1.0 { used.recip() } else { used }, v.check.clone()))
        };
        let worst = record.verdicts.iter().filter(wanted).filter(|v| v.holds().is_some()).filter_map(over);
        let named = |outcome: Outcome| {
            let own = record.verdicts.iter().filter(move |v| v.outcome == outcome && !v.is_wanted());
            crate::distinct(own.map(|v| &*v.check)).join(", ")
        };
        let why = match (&record.error, standing) {
            (Some(failure), _) => failure.message.clone(),
            (None, Standing::Wrong) => named(Outcome::Failed),
            (None, Standing::NotJudged) => named(Outcome::NotJudged),
            _ => String::new(),
        };
        let of_error =
            |m: Metric| m.name.ends_with("_error") || case.quantities.iter().any(|q| q.is_error && q.metric == m);
        let seen = |c: &&Column| c.metric.is_some_and(|m| of_error(m) && record.metric(m).is_finite());
        let known = |x: f64| Some(x).filter(|x| x.is_finite() && *x > 0.0);
        let cpu_s = known(record.time.cpu_s);
        let visited = record.work.steps * record.work.particles;
        Self {
            level: record.level.clone(),
            set: record.set.clone(),
            standing,
            why,
            worst: worst.max_by(|a, b| a.0.total_cmp(&b.0)),
            told: case.headlines.iter().filter(seen).map(|c| (c.title.clone(), c.of_run(record))).collect(),
            cpu_s,
            ns: cpu_s.filter(|_| record.work.steps >= EXPLICIT && visited > 0).map(|cpu| 1e9 * cpu / visited as f64),
        }
    }
}

/// Orders that runs together show.
fn orders(study: &CaseStudy) -> Vec<(String, f64)> {
    let shown = study.convergence.iter().filter(|c| c.is_error);
    shown.filter_map(|c| Some((c.metric.clone(), c.order.as_ref()?.order))).collect()
}

/// The methods in some folders, or in folders below them.
///
/// # Errors
/// A folder can't be read, has no manifest anywhere, or one that is refused; a run does not say the size of its cells.
pub fn read(folders: &[PathBuf]) -> Result<Vec<Method>, Error> {
    let mut methods = Vec::new();
    for folder in folders {
        let found = manifests(folder, DEPTH)?;
        if found.is_empty() {
            return Err(Error::file(folder, format!("no {FILE} in it or in folders below it")));
        }
        for folder in found {
            of_folder(&folder, &mut methods)?;
        }
    }
    Ok(methods)
}

/// Folders with a manifest, by name.
fn manifests(folder: &Path, depth: usize) -> Result<Vec<PathBuf>, Error> {
    if folder.join(FILE).is_file() {
        return Ok(vec![folder.to_owned()]);
    }
    let entries = fs::read_dir(folder).map_err(|e| Error::file(folder, e))?;
    let mut below: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|p| p.is_dir()).collect();
    below.sort();
    let below = below.iter().filter(|_| depth > 0).map(|below| manifests(below, depth - 1));
    Ok(below.collect::<Result<Vec<_>, Error>>()?.concat())
}

fn of_folder(folder: &Path, methods: &mut Vec<Method>) -> Result<(), Error> {
    let scores = Scores::read(folder)?;
    if let Some(run) = scores.runs.iter().find(|run| run.manifest.cell_size_m.is_none()) {
        return Err(run.manifest.refuse(folder, "cell_size_m", "it is missing; the board shows no run without"));
    }
    let methods_of = crate::distinct(scores.runs.iter().map(Scored::method));
    for ((_, study), method) in scores.together.iter().zip(methods_of) {
        let own: Vec<&Scored> = scores.runs.iter().filter(|run| run.method() == method).collect();
        let line = |run: &&Scored| Line::of(scores.case, &run.record, run.manifest.status);
        let told = |line: Option<&manifest::Line>| line.map_or(String::new(), |line| line.0.clone());
        let (words, _, repeat) = method;
        let code = own.first().map(|run| &run.manifest.code);
        methods.push(Method::new(
            (scores.case, study),
            [scores.code.clone(), told(code.and_then(|c| c.version.as_ref())), told(code.and_then(|c| c.url.as_ref()))],
            [Some(words), repeat].into_iter().flatten().map(|line| &*line.0).collect::<Vec<_>>().join(", "),
            told(own.iter().find_map(|run| run.manifest.note.as_ref())),
            own.iter().map(line).collect(),
        ));
    }
    Ok(())
}

impl Method {
    fn new(
        (case, study): (&'static Case, &CaseStudy),
        [code, version, url]: [String; 3],
        words: String,
        note: String,
        mut runs: Vec<Line>,
    ) -> Self {
        let place = |line: &Line| case.levels.iter().position(|level| level.name == line.level);
        runs.sort_by_key(place);
        let each: Vec<Standing> = runs.iter().map(|line| line.standing).collect();
        let standing = Standing::over(&each, study.verdicts.iter().any(Verdict::failed));
        Self { case: case.name, code, version, url, words, note, standing, orders: orders(study), runs }
    }

    /// A run by itself.
    pub(crate) fn alone(scored: &Scored) -> Self {
        let runs = vec![Line::of(scored.case, &scored.record, scored.manifest.status)];
        let study = CaseStudy::new(scored.case.name, Vec::new());
        let [code, words] = [&scored.manifest.code.name, &scored.manifest.scheme].map(|line| line.0.clone());
        Self::new((scored.case, &study), [code, String::new(), String::new()], words, String::new(), runs)
    }

    /// Our runs of a case with one scheme, judged as those of a stranger.
    ///
    /// # Errors
    /// The case judges no other code.
    pub(crate) fn of_ours(name: &str, records: &[&Record]) -> Result<Self, Error> {
        let (case, foreign) = find_scored(name)?;
        let title = records.first().map_or(String::new(), |r| r.scheme().title());
        let alike = |own: &&Record| {
            let scheme = (foreign.judged_as)(own.basis());
            let mut record = Record { scheme, solver: scheme.solver().to_owned(), ..(*own).clone() };
            let asked = |v: &Verdict| foreign.asks(&v.check) && group_of(foreign, v).is_some();
            let lacking = |v: &Verdict| {
                (!record.metrics.contains_key(&v.metric)).then(|| format!("{} is not kept of this run", v.metric))
            };
            let judged = demands(case.verdicts(&record), lacking).filter(asked);
            record.verdicts = settled(&case.wanted, judged.collect());
            record
        };
        let mut study = CaseStudy::new(case.name, records.iter().map(alike).collect());
        if study.records.len() > 1 {
            let own = |v: &Verdict| (!foreign.asks(&v.check)).then(String::new);
            study.verdicts = demands(case.judge_study(&study.records), own).collect();
            study.convergence = convergence(case, &study.records);
        }
        let ending = |r: &Record| if r.status == Status::Ok { Ending::Finished } else { Ending::BrokeDown };
        let runs = study.records.iter().map(|r| Line::of(case, r, ending(r))).collect();
        let ours = [OWN, "", ""].map(str::to_owned);
        Ok(Self::new((case, &study), ours, title, String::new(), runs))
    }
}
