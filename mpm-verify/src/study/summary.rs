//! Result of a verification: the runs of each case, the verdicts on them and their counts.

use super::convergence::Convergence;
use super::judge::{broke_as_known, outcome_of_run};
use super::*;
use crate::gallery::Picture;
use crate::night::Night;

/// Version of the summary's format.
pub(crate) const SCHEMA: u32 = 4;

/// The runs of one case and what is said of them together.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct CaseStudy {
    pub case: String,
    /// Records, in the order of the plan.
    pub records: Vec<Record>,
    /// Verdicts on runs together.
    pub verdicts: Vec<Verdict>,
    /// Convergence of the case's quantities.
    pub convergence: Vec<Convergence>,
    /// The night that made the runs, if it is known.
    pub night: Option<Night>,
    /// Pictures of the case, in the order they are shown.
    pub pictures: Vec<Picture>,
}

impl CaseStudy {
    /// Records of which nothing is said yet.
    pub(crate) fn new(case: &str, records: Vec<Record>) -> Self {
        Self { case: case.to_owned(), records, ..Self::default() }
    }

    /// The program that made the runs; one made them all.
    pub(crate) fn program(&self) -> Option<&Version> {
        self.records.first().map(|r| &r.version)
    }

    /// The verdicts on the runs, then those on runs together.
    pub(crate) fn all_verdicts(&self) -> impl Iterator<Item = (Option<&Record>, &Verdict)> + Clone {
        let single = self.records.iter().flat_map(|r| r.verdicts.iter().map(move |v| (Some(r), v)));
        single.chain(self.verdicts.iter().map(|v| (None, v)))
    }
}

/// Counts over all runs and verdicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Counts {
    pub runs: usize,
    /// Runs that broke down and were not known to.
    pub broke_down: usize,
    /// Runs that broke down as they are known to.
    pub broke_down_as_known: usize,
    /// Runs that are right.
    #[serde(default)]
    pub right_runs: usize,
    /// Runs that are wrong as known.
    #[serde(default)]
    pub wrong_as_known_runs: usize,
    /// Runs that no check against the truth applies to.
    pub not_judged_runs: usize,
    /// Runs that failed.
    #[serde(default)]
    pub failed_runs: usize,
    /// Checks against the truth that hold.
    pub right: usize,
    /// Known limits that are there.
    pub wrong_as_known: usize,
    /// Checks that do not apply.
    pub not_judged: usize,
    /// Checks against the truth that don't hold, and known limits that have vanished.
    pub failed: usize,
    /// Bookkeeping that holds.
    pub bookkeeping_right: usize,
    /// Bookkeeping that doesn't.
    pub bookkeeping_failed: usize,
    /// Regression checks that hold.
    #[serde(default)]
    pub regression_right: usize,
    /// Those that don't.
    #[serde(default)]
    pub regression_failed: usize,
    /// Comparisons with goldens that hold.
    pub undrifted: usize,
    /// Those that don't.
    pub drifted: usize,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} run{}: {} right, {} wrong as known, {} not judged, {} FAILED.",
            self.runs,
            if self.runs == 1 { "" } else { "s" },
            self.right_runs,
            self.wrong_as_known_runs,
            self.not_judged_runs,
            self.failed_runs
        )?;
        writeln!(f, "Broke down: {} unexpectedly, {} as known.", self.broke_down, self.broke_down_as_known)?;
        writeln!(
            f,
            "Checks: {} right, {} wrong as known, {} not judged, {} FAILED.",
            self.right, self.wrong_as_known, self.not_judged, self.failed
        )?;
        write!(
            f,
            "Beside these: bookkeeping, {} hold, {} FAILED; regression, {} hold, {} FAILED; against goldens, {} hold, {} drift.",
            self.bookkeeping_right,
            self.bookkeeping_failed,
            self.regression_right,
            self.regression_failed,
            self.undrifted,
            self.drifted
        )
    }
}

/// Result of a verification.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of this format.
    pub schema: u32,
    pub tier: String,
    pub counts: Counts,
    pub cases: Vec<CaseStudy>,
}

impl Summary {
    /// Summary of judged cases, in the order of [`cases::all`].
    pub(crate) fn new(tier: &str, mut cases: Vec<CaseStudy>) -> Self {
        cases.sort_by_key(|study| cases::place(&study.case));
        let mut summary = Self { schema: SCHEMA, tier: tier.to_owned(), counts: Counts::default(), cases };
        summary.counts = count(&summary);
        summary
    }

    /// How the program should end.
    #[must_use]
    pub fn exit_code(&self) -> ExitCode {
        if self.counts.broke_down > 0 {
            ExitCode::RunFailed
        } else if self.failures() > 0 {
            ExitCode::TruthFailed
        } else if self.counts.drifted > 0 {
            ExitCode::Drift
        } else {
            ExitCode::Good
        }
    }

    /// Checks that failed, those of drift apart.
    pub(crate) fn failures(&self) -> usize {
        let c = self.counts;
        c.failed + c.bookkeeping_failed + c.regression_failed
    }

    /// The runs of all cases.
    pub fn records(&self) -> impl Iterator<Item = &Record> {
        self.cases.iter().flat_map(|study| &study.records)
    }

    /// All verdicts, each with the run it is about (none for those on runs together).
    pub fn verdicts(&self) -> impl Iterator<Item = (&CaseStudy, Option<&Record>, &Verdict)> {
        self.cases.iter().flat_map(|study| study.all_verdicts().map(move |(run, v)| (study, run, v)))
    }
}

fn count(summary: &Summary) -> Counts {
    let mut counts = Counts::default();
    for record in summary.records() {
        counts.runs += 1;
        counts.broke_down += usize::from(record.broke_down());
        counts.broke_down_as_known += usize::from(broke_as_known(record));
        *match outcome_of_run(record) {
            Outcome::Right => &mut counts.right_runs,
            Outcome::WrongAsKnown => &mut counts.wrong_as_known_runs,
            Outcome::NotJudged => &mut counts.not_judged_runs,
            Outcome::Failed => &mut counts.failed_runs,
        } += 1;
    }
    for (_, _, verdict) in summary.verdicts().filter(|(.., v)| v.kind != Kind::Wanted) {
        *match (verdict.kind, verdict.outcome) {
            (Kind::Drift, Outcome::Failed) => &mut counts.drifted,
            (Kind::Drift, _) => &mut counts.undrifted,
            (_, Outcome::NotJudged) => &mut counts.not_judged,
            (Kind::Regression, Outcome::Failed) => &mut counts.regression_failed,
            (Kind::Regression, _) => &mut counts.regression_right,
            (Kind::Bookkeeping, Outcome::Failed) => &mut counts.bookkeeping_failed,
            (Kind::Bookkeeping, _) => &mut counts.bookkeeping_right,
            (_, Outcome::Right) => &mut counts.right,
            (_, Outcome::WrongAsKnown) => &mut counts.wrong_as_known,
            (_, Outcome::Failed) => &mut counts.failed,
        } += 1;
    }
    counts
}
