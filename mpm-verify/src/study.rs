//! Many runs side by side.

use crate::case::{Case, RunSpec, Tier};
use crate::cases;
use crate::check::{Kind, Verdict};
use crate::convergence::{Convergence, convergence};
use crate::error::{Error, ExitCode};
use crate::files::{require_writable, write_json};
use crate::record::{Record, SCHEMA, Status};
use crate::run::{execute, judge};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Hears of the progress of runs. `run` is the run's place in the plan.
pub trait Listener: Sync {
    /// A share of a run is done (0 to 1).
    fn progress(&self, run: usize, share: f64);
    /// A run has ended.
    fn ended(&self, run: usize, record: &Record);
}

/// The runs of one case and what is said of them together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseStudy {
    /// Case.
    pub case: String,
    /// Records, in the order of the plan.
    pub records: Vec<Record>,
    /// Verdicts on runs together.
    pub verdicts: Vec<Verdict>,
    /// Convergence of the case's quantities.
    pub convergence: Vec<Convergence>,
}

/// Counts over all verdicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Counts {
    /// Runs.
    pub runs: usize,
    /// Runs that broke down.
    pub failed_runs: usize,
    /// Runs without a single applicable check against the truth.
    pub runs_without_truth: usize,
    /// Checks against the truth and of known limits that hold.
    pub passed: usize,
    /// Those that don't.
    pub failed: usize,
    /// Those that don't apply.
    pub not_applicable: usize,
    /// Comparisons with goldens that hold.
    pub undrifted: usize,
    /// Those that don't.
    pub drifted: usize,
}

/// What a verification found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of this format.
    pub schema: u32,
    /// Tier.
    pub tier: String,
    /// Counts.
    pub counts: Counts,
    /// Cases.
    pub cases: Vec<CaseStudy>,
}

impl Summary {
    /// Forms all verdicts and counts from the records.
    fn judge(&mut self) -> Result<(), Error> {
        for study in &mut self.cases {
            let case = cases::find(&study.case)?;
            for record in &mut study.records {
                record.verdicts = judge(case, record);
            }
            study.verdicts = case.judge_study(&study.records);
            study.convergence = convergence(case, &study.records);
        }
        self.counts = count(self);
        Ok(())
    }

    /// How the program should end.
    #[must_use]
    pub fn exit_code(&self) -> ExitCode {
        if self.counts.failed_runs > 0 {
            ExitCode::RunFailed
        } else if self.counts.failed > 0 {
            ExitCode::TruthFailed
        } else if self.counts.drifted > 0 {
            ExitCode::Drift
        } else {
            ExitCode::Good
        }
    }

    /// All verdicts, each with the run it is about (none for those on runs together).
    pub fn verdicts(&self) -> impl Iterator<Item = (&CaseStudy, Option<&Record>, &Verdict)> {
        self.cases.iter().flat_map(|study| {
            let single = study
                .records
                .iter()
                .flat_map(move |r| r.verdicts.iter().map(move |v| (study, Some(r), v)));
            single.chain(study.verdicts.iter().map(move |v| (study, None, v)))
        })
    }
}

/// Folder of a run's outputs.
#[must_use]
pub fn run_folder(out: &Path, case: &str, spec: &RunSpec) -> PathBuf {
    out.join(case).join(spec.folder())
}

/// Runs the plans of `cases` for `tier`, as many side by side as there are `workers`, one thread
/// each, the longest first; writes every run's outputs and `summary.json` below `out`.
///
/// # Errors
/// The folder can't be written, or a planned scene can't be built.
pub fn verify(
    cases: &[&dyn Case],
    tier: Tier,
    out: &Path,
    workers: usize,
    listener: &dyn Listener,
) -> Result<Summary, Error> {
    let plan = plan_of(cases, tier);
    if plan.is_empty() {
        return Err(Error::Input(format!("no case has runs in tier {tier}")));
    }
    require_writable(out)?;
    let records = run_all(&plan, out, workers, listener)?;
    let mut studies: Vec<CaseStudy> = Vec::new();
    for case in cases {
        studies.push(CaseStudy {
            case: case.name().to_owned(),
            records: records
                .iter()
                .filter(|r| r.case == case.name())
                .cloned()
                .collect(),
            verdicts: Vec::new(),
            convergence: Vec::new(),
        });
    }
    let mut summary = Summary {
        schema: SCHEMA,
        tier: tier.to_string(),
        counts: Counts::default(),
        cases: studies,
    };
    summary.judge()?;
    write_json(&out.join("summary.json"), &summary)?;
    Ok(summary)
}

/// Judges the records below `folder` again, by the checks as they are now, and rewrites its summary.
///
/// # Errors
/// The summary is missing, damaged, of another schema, or of a case that is not known.
pub fn judge_again(folder: &Path) -> Result<Summary, Error> {
    let mut summary = read_summary(folder)?;
    summary.judge()?;
    write_json(&folder.join("summary.json"), &summary)?;
    Ok(summary)
}

fn read_summary(folder: &Path) -> Result<Summary, Error> {
    let path = folder.join("summary.json");
    let text = std::fs::read_to_string(&path).map_err(|e| Error::file(&path, e))?;
    let summary: Summary = serde_json::from_str(&text).map_err(|e| Error::file(&path, e))?;
    if summary.schema != SCHEMA {
        let cause = format!("schema {} where {SCHEMA} is expected", summary.schema);
        return Err(Error::file(&path, cause));
    }
    Ok(summary)
}

/// The runs of `tier`, in order.
#[must_use]
pub fn plan_of<'a>(cases: &[&'a dyn Case], tier: Tier) -> Vec<(&'a dyn Case, RunSpec)> {
    cases
        .iter()
        .flat_map(|case| case.plan(tier).into_iter().map(|spec| (*case, spec)))
        .collect()
}

fn count(summary: &Summary) -> Counts {
    let mut counts = Counts::default();
    for study in &summary.cases {
        for record in &study.records {
            counts.runs += 1;
            counts.failed_runs += usize::from(record.status == Status::Failed);
            counts.runs_without_truth += usize::from(!has_truth(record));
        }
    }
    for (_, _, verdict) in summary.verdicts() {
        *match (verdict.kind, verdict.pass) {
            (Kind::Drift, Some(true)) => &mut counts.undrifted,
            (Kind::Drift, _) => &mut counts.drifted,
            (_, Some(true)) => &mut counts.passed,
            (_, Some(false)) => &mut counts.failed,
            (_, None) => &mut counts.not_applicable,
        } += 1;
    }
    counts
}

/// Whether at least one check against the truth, beyond completion, was applied to a run.
#[must_use]
pub fn has_truth(record: &Record) -> bool {
    record
        .verdicts
        .iter()
        .any(|v| v.kind == Kind::Truth && v.pass.is_some() && v.check != "completes")
}

fn run_all(
    plan: &[(&dyn Case, RunSpec)],
    out: &Path,
    workers: usize,
    listener: &dyn Listener,
) -> Result<Vec<Record>, Error> {
    let mut order: Vec<usize> = (0..plan.len()).collect();
    let cost = |k: usize| plan[k].0.cost(&plan[k].1);
    order.sort_by(|&a, &b| cost(a).total_cmp(&cost(b)));
    let queue = Mutex::new(order);
    let results = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..workers.min(plan.len()) {
            scope.spawn(|| {
                while let Some(k) = queue.lock().ok().and_then(|mut q| q.pop()) {
                    let (case, spec) = &plan[k];
                    let folder = run_folder(out, case.name(), spec);
                    let result = execute(*case, spec, Some(&folder), 1, &|share| {
                        listener.progress(k, share);
                    });
                    if let Ok(record) = &result {
                        listener.ended(k, record);
                    }
                    if let Ok(mut results) = results.lock() {
                        results.push((k, result));
                    }
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_default();
    results.sort_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}
