//! Runs made side by side, the longest first.

use super::found::record_in;
use super::judge::judged_run;
use super::plan::Plan;
use super::*;
use crate::files::lock::hold;
use crate::run::size::require_together;
use crate::size::Size;
use std::sync::{Mutex, PoisonError};

/// Hears of the progress of runs. `run` is the run's place in the plan.
pub trait Listener: Sync {
    /// A run can't resume from its checkpoint and begins again.
    fn begins_again(&self, run: usize, why: &Error);
    /// A run has ended.
    fn ended(&self, run: usize, record: &Record);
}

/// Folder of a run's perturbed twin, below its own.
pub const TWIN: &str = "twin";

/// Makes the runs of a plan's own shard below `out`, as many side by side as there are `workers`, one
/// thread each, the longest first. To resume is to keep a run that has a record of this very program and to go
/// on with one that has a checkpoint of it.
///
/// # Errors
/// The folder can't be written or, to be resumed, holds another plan; or a scene can't be built.
pub fn make_runs(
    plan: &Plan,
    out: &Path,
    saving: Saving,
    workers: usize,
    listener: &dyn Listener,
) -> Result<Vec<Record>, Error> {
    if saving.resume && out.join("plan.json").exists() {
        let begun = Plan::read(out)?;
        if begun != *plan {
            return Err(Error::Input(format!(
                "{}: holds another plan (tier {}, shard {}); nothing to resume",
                out.display(),
                begun.tier,
                begun.shard
            )));
        }
    }
    let mut tasks = Vec::new();
    for run in plan.own() {
        let (case, spec) = run.resolve()?;
        let folder = out.join(run.folder());
        require_inside(out, &run.folder().join(TWIN))?;
        if !saving.resume {
            discard_run(&folder)?;
            discard_run(&folder.join(TWIN))?;
        }
        tasks.push(Task { case, spec, folder });
    }
    plan.write(out)?;
    run_all(&tasks, saving, workers, listener)
}

/// Checks that `memory` (bytes) holds the scenes of a plan's own shard, as many side by side as there are `workers`.
///
/// # Errors
/// It does not, or a scene can't be built.
pub fn require_memory(plan: &Plan, memory: f64, workers: usize) -> Result<(), Error> {
    let mut sizes = Vec::new();
    for run in plan.own() {
        let (case, spec) = run.resolve()?;
        let size = Size::of(case, &spec)?;
        let held = size.require(Some(memory), &spec);
        held.map_err(|why| Error::Input(format!("{}: {why}", run.folder().display())))?;
        sizes.push(size);
    }
    require_together(&sizes, memory, workers)
}

/// A run to be made in a folder.
pub struct Task {
    pub(crate) case: &'static Case,
    /// Run of the case.
    pub(crate) spec: RunSpec,
    /// Where its outputs go.
    pub(crate) folder: PathBuf,
}

impl Task {
    /// The record that a run of this very program has left, if its tables are those that it wrote.
    fn made(&self) -> Result<Option<Record>, Error> {
        let found = record_in(&self.folder, self.case, &self.spec)?;
        Ok(found.filter(|r| r.set == self.spec.set && r.version == Version::current()))
    }

    /// Makes the run, or keeps an existing one if that is requested.
    fn make(&self, k: usize, saving: Saving, listener: &dyn Listener) -> Result<Record, Error> {
        let _held = hold(&self.folder)?;
        match self.made() {
            _ if !saving.resume => {}
            Ok(None) => {}
            Ok(Some(record)) => return Ok(record),
            Err(why) => listener.begins_again(k, &why),
        }
        let run = |saving| judged_run(self.case, &self.spec, Some((self.folder.as_path(), saving)), 1, &|_| {});
        match run(saving) {
            Err(why @ Error::Checkpoint { .. }) => {
                listener.begins_again(k, &why);
                run(Saving { resume: false, ..saving })
            }
            other => other,
        }
    }
}

/// Runs tasks side by side, the longest first; the records come back in the order of the tasks.
///
/// # Errors
/// A folder can't be written, or a scene can't be built.
pub fn run_all(tasks: &[Task], saving: Saving, workers: usize, listener: &dyn Listener) -> Result<Vec<Record>, Error> {
    let mut order: Vec<usize> = (0..tasks.len()).collect();
    let cost = |k: usize| (tasks[k].case.cost)(&tasks[k].spec);
    order.sort_by(|&a, &b| cost(b).total_cmp(&cost(a)));
    let results = side_by_side(order, workers, |k| {
        let result = tasks[k].make(k, saving, listener);
        if let Ok(record) = &result {
            listener.ended(k, record);
        }
        result
    });
    results.into_iter().collect()
}

/// Does `work` for every number of `order`, begun in that order, at most `workers` at a time; the results
/// come back by rising number.
fn side_by_side<T: Send>(order: Vec<usize>, workers: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let workers = workers.min(order.len());
    let queue = Mutex::new(order.into_iter());
    let results = Mutex::new(Vec::new());
    // The lock must be gone before the work begins, or there is one at a time.
    let next = || unpoisoned(queue.lock()).next();
    let worker = || {
        while let Some(k) = next() {
            let result = work(k);
            unpoisoned(results.lock()).push((k, result));
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..workers {
            // Where no more threads are to be had, fewer do it.
            let _ = std::thread::Builder::new().spawn_scoped(scope, worker);
        }
        worker();
    });
    let mut results = unpoisoned(results.into_inner());
    results.sort_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Guarded value of a lock, whole even if another thread has panicked: queue and results change in one go.
fn unpoisoned<T>(guarded: Result<T, PoisonError<T>>) -> T {
    guarded.unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    #[test]
    fn two_workers_work_at_a_time() {
        let (to_first, of_first) = channel();
        let (to_second, of_second) = channel();
        let ends = [(to_second, of_first), (to_first, of_second)].map(Mutex::new);
        let met = side_by_side(vec![1, 0], 2, |k| {
            let (mine, theirs) = &*unpoisoned(ends[k].lock());
            mine.send(()).unwrap();
            theirs.recv_timeout(Duration::from_secs(20)).is_ok()
        });
        assert_eq!(met, [true, true]);
    }

    #[test]
    fn results_come_back_by_number_whatever_the_order() {
        assert_eq!(side_by_side(vec![2, 0, 1], 1, |k| 10 * k), [0, 10, 20]);
        assert!(side_by_side(Vec::new(), 4, |k| k).is_empty());
    }
}
