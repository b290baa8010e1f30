//! Accepting drift.

use crate::error::Error;
use crate::golden::{BLUNT, Goldens, Run};
use crate::metric::possible;
use crate::record::{Record, Status, Version};
use crate::report::describe::{drift_line, verdict_line};
use crate::run::checkpoint::Saving;
use crate::study::gather::Gathered;
use crate::study::judge::outcome_of_run;
use crate::study::plan::resolve_record;
use crate::study::schedule::{Listener, TWIN, Task, run_all};
use crate::study::summary::CaseStudy;
use crate::verdict::{Outcome, Verdict};
use std::fmt::Write;

/// The runs of a case that have drifted, and what speaks against blessing them.
pub struct Candidates<'a> {
    study: &'a CaseStudy,
    drifted: Vec<&'a Record>,
}

impl<'a> Candidates<'a> {
    /// Blessing of a judged study whose records were made by this very program.
    ///
    /// # Errors
    /// The records were made by another program.
    pub fn of(study: &'a CaseStudy) -> Result<Self, Error> {
        let current = Version::current();
        if let Some(other) = study.records.iter().find(|r| r.version != current) {
            return Err(Error::Input(format!(
                "{} {} was made by source {}, this program is of source {}: run `verify` first",
                other.case,
                other.folder(),
                other.version.source,
                current.source
            )));
        }
        let drifts = |r: &&Record| r.verdicts.iter().any(Verdict::drifts);
        Ok(Self { study, drifted: study.records.iter().filter(drifts).collect() })
    }

    /// Table of drift: one line per run and column, the number of drifted runs, and how many of them no truth judges.
    #[must_use]
    pub fn table(&self) -> String {
        let mut t = String::new();
        for record in &self.drifted {
            for v in record.verdicts.iter().filter(|v| v.drifts()) {
                let _ = writeln!(t, "{} {}  {}", record.case, record.folder(), drift_line(v));
            }
        }
        let untold = self.drifted.iter().filter(|r| outcome_of_run(r) == Outcome::NotJudged).count();
        let _ = writeln!(
            t,
            "{} of {} runs have drifted or have no golden; bookkeeping alone judges {untold} of these",
            self.drifted.len(),
            self.study.records.len()
        );
        t
    }

    /// Why nothing may be blessed, if a check against the truth fails or a run broke down.
    #[must_use]
    pub fn refusal(&self) -> Option<String> {
        let mut t = String::new();
        for record in &self.study.records {
            for verdict in record.verdicts.iter().filter(|v| v.misses_the_truth()) {
                let _ = writeln!(t, "{} {}", record.folder(), verdict_line(verdict));
            }
        }
        for verdict in self.study.verdicts.iter().filter(|v| v.misses_the_truth()) {
            let _ = writeln!(t, "runs together {}", verdict_line(verdict));
        }
        if t.is_empty() {
            return None;
        }
        t.push_str("refused: a golden never stands in for the truth\n");
        Some(t)
    }

    /// Names of the perturbed twins that blessing runs.
    #[must_use]
    pub fn twin_names(&self) -> Vec<String> {
        self.drifted.iter().map(|r| format!("{}/{}/twin", r.case, r.folder())).collect()
    }

    /// Blesses every candidate, running a perturbed twin of each beside the run itself (one that is there already is
    /// kept). Nothing is written before everything is measured, and nothing is if a quantity is doubtful that is not
    /// among the `allowed`.
    ///
    /// # Errors
    /// A file can't be read or written.
    pub fn bless(
        &self,
        gathered: &Gathered,
        goldens: &Goldens,
        (reason, allowed): (&str, &[String]),
        workers: usize,
        listener: &dyn Listener,
    ) -> Result<Blessing, Error> {
        let mut tasks = Vec::new();
        for record in &self.drifted {
            let (case, mut spec) = resolve_record(record)?;
            spec.perturbed = true;
            tasks.push(Task { case, spec, folder: gathered.folder(record)?.join(TWIN) });
        }
        let twins = run_all(&tasks, Saving::resuming(), workers, listener)?;
        let (mut runs, mut doubts) = (Vec::new(), Vec::new());
        for ((record, twin), task) in self.drifted.iter().zip(&twins).zip(&tasks) {
            if let (Status::Failed, Some(error)) = (twin.status, &twin.error) {
                let run = record.folder();
                return Ok(Blessing::Broken(format!("the perturbed twin of {run} broke down: {}\n", error.message)));
            }
            let folder = gathered.folder(record)?;
            let run = Run::of((record, folder), (twin, &task.folder))?;
            doubts.extend(doubts_of(record, goldens.kept(record), &run));
            runs.push((run, *record, folder));
        }
        let told = refusal_of(&doubts, allowed);
        if !told.is_empty() {
            return Ok(Blessing::Doubtful(told));
        }
        goldens.bless(runs, reason)?;
        Ok(Blessing::Done(self.drifted.len()))
    }
}

/// Result of blessing.
pub enum Blessing {
    /// Number of blessed runs.
    Done(usize),
    /// A twin broke down, which the text says.
    Broken(String),
    /// Nothing is blessed: the text names what is doubtful, or what was allowed for nothing.
    Doubtful(String),
}

/// A quantity that is not to be blessed in silence: its name, its run, and why.
type Doubt = (String, String, String);

/// Factor by which the response of a quantity may have grown since its last blessing.
const JUMP: f64 = 100.0;

/// Reasons to doubt a run: counts that contradict each other, an impossible value of a metric, a kept quantity that is
/// now not a number or answers rounding too strongly, a response that has jumped.
fn doubts_of(record: &Record, kept: Option<&Run>, now: &Run) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let mut doubt = |name: &str, why: String| {
        doubts.push((name.to_owned(), record.folder(), why));
    };
    let work = record.work;
    // Particles may be taken from a body, as by an excavation, and none comes: the last step has the fewest.
    let fewest = work.particles.checked_mul(work.steps);
    if fewest.is_none_or(|fewest| work.particle_steps < fewest) {
        let [n, steps, all] = [work.particles, work.steps, work.particle_steps];
        doubt("particle_steps", format!("{all} are fewer than {n} particles times {steps} steps"));
    }
    for (name, value) in record.metrics.iter().filter_map(|(n, m)| Some((n, m.value?))) {
        let possible = possible(name);
        if !possible.contains(&value) {
            let (least, most) = (possible.start(), possible.end());
            doubt(name, format!("{value:e} is not within {least:e} to {most:e}"));
        }
    }
    for old in kept.iter().flat_map(|run| &run.columns) {
        let name = old.quantity.split_once('/').map_or(&*old.quantity, |(_, name)| name);
        let name = name.split(" (").next().unwrap_or(name);
        let Some(new) = now.columns.iter().find(|c| c.quantity == old.quantity) else {
            doubt(name, "was kept, and has no number now or answers rounding too strongly".to_owned());
            continue;
        };
        let least = if old.is_count() { 1.0 } else { BLUNT / JUMP * old.scale() };
        if new.response() > JUMP * old.response().max(least) {
            let responses = [old.response(), new.response()];
            doubt(name, format!("responds by {:e} to rounding, and by {:e} before", responses[1], responses[0]));
        }
    }
    doubts
}

/// Doubts that are not allowed, and allowances without a doubt; empty without either.
fn refusal_of(doubts: &[Doubt], allowed: &[String]) -> String {
    let mut t = String::new();
    for (name, run, why) in doubts.iter().filter(|(name, ..)| !allowed.contains(name)) {
        let _ = writeln!(t, "doubtful: {name} of {run}: {why}");
    }
    for name in allowed.iter().filter(|a| doubts.iter().all(|(name, ..)| name != *a)) {
        let _ = writeln!(t, "--allow {name}: nothing of that name is doubtful");
    }
    if !t.is_empty() {
        t.push_str("refused: --allow with its name blesses what is doubtful\n");
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::record;
    use crate::verdict::{Kind, Outcome};

    #[test]
    fn runs_without_a_truth_are_counted() {
        let found = |kind, outcome| Verdict {
            check: "check".to_owned(),
            kind,
            metric: "tip_ux".to_owned(),
            value: Some(2.0),
            reference: Some(1.0),
            tolerance: Some(0.0),
            outcome,
            source: String::new(),
        };
        let drift = found(Kind::Drift, Outcome::Failed);
        let run = |kind| {
            let mut run = record("h2", vec![found(kind, Outcome::Right), drift.clone()]);
            run.version = Version::current();
            run
        };
        let [truth, count] = [Kind::Truth, Kind::Bookkeeping];
        let kinds = [truth, count, count, count];
        let mut runs: Vec<Record> = kinds.map(run).into();
        runs[3].verdicts.pop();
        let study = CaseStudy::new("cook", runs);
        let told = Candidates::of(&study).unwrap().table();
        let count = "3 of 4 runs have drifted or have no golden; bookkeeping alone judges 2 of these\n";
        assert!(told.ends_with(count), "{told}");
    }
}
