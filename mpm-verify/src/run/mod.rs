//! One run: a job driven to its end, its outputs and its record.

pub mod checkpoint;
pub mod series;
pub mod size;
pub(crate) mod slim;
pub(crate) mod vtu;

use crate::case::Case;
use crate::error::Error;
use crate::files::{
    Mark, SNAPSHOTS, TABLE, discard, files_in, make_folder, read, require_inside, snapshot_file, write_csv, write_json,
};
use crate::job::{Column, Job, Snapshot};
use crate::parameter::Parameters;
use crate::record::{Failure, LIMIT_LOAD, Record, Status, Timing};
use crate::spec::RunSpec;
use crate::verdict::Verdict;
use checkpoint::{Checkpoint, Identity, Keeper, Refusal, Saving};
use cpu_time::ProcessTime;
use mpm_core::error::Cause;
use series::Series;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};
use vtu::{write_pvd, write_vtu};

/// File of a run's record.
pub const RECORD: &str = "record.json";
/// File of its particles at the end.
const PARTICLES: &str = "particles.csv";

/// Time from one look at a run to the next.
const BEAT: Duration = Duration::from_secs(1);

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Share of the longest possible run that was done at the last row, 0 to 1.
    pub share: f64,
    /// Steps since the run began or was resumed.
    pub steps: u64,
    /// Simulated time (s); zero before the first step.
    pub time: f64,
}

/// Runs `spec` of `case` on `threads` threads. With a folder, the series is written there row by row,
/// checkpoints now and then and, at the end, particles and record; a run that breaks down keeps what it
/// has written and its record says why. `progress` hears of it after every row, and every second.
///
/// # Errors
/// The scene can't be built or has no particle, a file can't be written, or the checkpoint to resume from is refused
/// ([`Error::Checkpoint`], and nothing in the folder has changed). A numerical breakdown is not an error here.
pub fn execute(
    case: &Case,
    spec: &RunSpec,
    place: Option<(&Path, Saving)>,
    threads: usize,
    judge: &(dyn Fn(&Record) -> Vec<Verdict> + Sync),
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Record, Error> {
    let parameters = Parameters::new(&case.parameters, &spec.set)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Error::Input(format!("{threads} threads can't be started: {e}")))?;
    // The scene as well is built by no more threads.
    let begun = pool.install(|| (case.begin)(spec, &parameters));
    let mut job = begun.and_then(size::require_particles).map_err(|e| size::given(e, spec))?;
    let mut journal = None;
    let mut before = Timing::default();
    if let Some((folder, saving)) = place {
        let identity = Identity::of(case, spec, &parameters);
        let (begun, taken) = Journal::open(folder, saving, identity, job.as_mut())?;
        (journal, before) = (Some(begun), taken);
    }
    let (pulse, share) = (job.pulse(), AtomicU64::new(0));
    let look = || {
        progress(Progress { share: f64::from_bits(share.load(Relaxed)), steps: pulse.steps(), time: pulse.time() });
    };
    let come = |done: f64| {
        share.store(done.to_bits(), Relaxed);
        look();
    };
    let run = || {
        let clock = Clock::start(threads, before);
        let failure = drive(job.as_mut(), journal.as_mut(), &clock, &come)?;
        let time = clock.time();
        let discretisation = job.discretisation();
        let blank = Record::blank(case.name, spec, &parameters, discretisation, threads);
        let mut record = Record { work: job.work(), time, ..blank };
        match failure {
            Some(failure) => {
                record.status = Status::Failed;
                record.error = Some(failure);
            }
            None => record.metrics = job.metrics(),
        }
        record.verdicts = judge(&record);
        if let Some(journal) = journal {
            let particles = job.particles();
            write_columns(&journal.folder.join(PARTICLES), &particles)?;
            write_vtu(&journal.folder.join("particles.vtu"), &particles)?;
            record.files = journal.written()?;
            write_json(&journal.folder.join(RECORD), &record)?;
            journal.keeper.end()?;
        }
        Ok(record)
    };
    watched(&pool, run, look)
}

/// Does `work` in the pool, and looks at it from outside every second until it has ended.
fn watched(
    pool: &rayon::ThreadPool,
    work: impl FnOnce() -> Result<Record, Error> + Send,
    look: impl Fn() + Send,
) -> Result<Record, Error> {
    let (tell, ended) = mpsc::channel();
    pool.in_place_scope(|scope| {
        // Who waits for it is there until it has ended.
        scope.spawn(move |_| drop(tell.send(work())));
        loop {
            match ended.recv_timeout(BEAT) {
                Ok(result) => return result,
                Err(RecvTimeoutError::Timeout) => look(),
                Err(e) => return Err(Error::Input(format!("the run has stopped: {e}"))),
            }
        }
    })
}

/// Processor time: of the calling thread for a run on one thread (others may run beside it), else of
/// the process.
enum CpuClock {
    Thread(cpu_time::ThreadTime),
    Process(ProcessTime),
}

impl CpuClock {
    fn start(threads: usize) -> Self {
        if threads == 1 { Self::Thread(cpu_time::ThreadTime::now()) } else { Self::Process(ProcessTime::now()) }
    }

    fn seconds(&self) -> f64 {
        match self {
            Self::Thread(t) => t.elapsed().as_secs_f64(),
            Self::Process(t) => t.elapsed().as_secs_f64(),
        }
    }
}

/// The time that a run takes, from what it took before it was resumed.
struct Clock {
    before: Timing,
    begun: Instant,
    processor: CpuClock,
}

impl Clock {
    fn start(threads: usize, before: Timing) -> Self {
        Self { before, begun: Instant::now(), processor: CpuClock::start(threads) }
    }

    fn time(&self) -> Timing {
        Timing {
            wall_s: self.before.wall_s + self.begun.elapsed().as_secs_f64(),
            cpu_s: self.before.cpu_s + self.processor.seconds(),
        }
    }
}

/// Files of a run in progress.
struct Journal {
    folder: PathBuf,
    series: Series,
    keeper: Keeper,
}

impl Journal {
    /// Resumes from the checkpoint, if there is one and it is requested, or begins; and the time taken before.
    fn open(folder: &Path, saving: Saving, identity: Identity, job: &mut dyn Job) -> Result<(Self, Timing), Error> {
        make_folder(folder)?;
        require_inside(folder, Path::new(SNAPSHOTS))?;
        let found = if saving.resume { Checkpoint::read(folder, &identity)? } else { None };
        let resumed = match found {
            None => None,
            Some(checkpoint) => {
                let refused = |refusal: Refusal| refusal.of(&folder.join(checkpoint::FILE));
                job.restore(&checkpoint.memory).map_err(|e| refused(e.into()))?;
                let series = Series::resume(folder, checkpoint.series)?;
                let series = series.ok_or_else(|| refused(Refusal::Series))?;
                Some((series, checkpoint.time))
            }
        };
        for file in [RECORD, PARTICLES, "particles.vtu"] {
            discard(&folder.join(file))?;
        }
        let (series, before) = match resumed {
            Some(resumed) => resumed,
            None => {
                discard_run(folder)?;
                let series = Series::begin(folder)?;
                (series, Timing::default())
            }
        };
        let journal =
            Self { folder: folder.to_path_buf(), series, keeper: Keeper::new(folder, identity, saving.every) };
        Ok((journal, before))
    }

    /// The tables that the run has written. What a run before this one has left of the same is among them.
    fn written(&self) -> Result<BTreeMap<String, Mark>, Error> {
        let mut written = BTreeMap::from([(series::FILE.to_owned(), self.series.secure()?)]);
        for name in tables(&self.folder)? {
            if name != series::FILE {
                let mark = Mark::of(&read(&self.folder.join(&name), TABLE)?);
                written.insert(name, mark);
            }
        }
        Ok(written)
    }

    /// Writes a checkpoint if it is time.
    fn keep(&mut self, job: &dyn Job, clock: &Clock) -> Result<(), Error> {
        if !self.keeper.due() {
            return Ok(());
        }
        let memory = job.save();
        let memory = memory.map_err(|e| Refusal::from(e).of(&self.folder.join(checkpoint::FILE)))?;
        self.keeper.keep(&Checkpoint { series: self.series.secure()?, time: clock.time(), memory })
    }
}

/// The tables of a run that are in its folder.
fn tables(folder: &Path) -> Result<Vec<String>, Error> {
    let single = [series::FILE, PARTICLES].map(str::to_owned).into_iter();
    let mut names: Vec<String> = single.filter(|name| folder.join(name).exists()).collect();
    for file in files_in(&folder.join(SNAPSHOTS), &["csv"])? {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        names.push(format!("{SNAPSHOTS}/{name}"));
    }
    Ok(names)
}

/// Checks that the tables beside a record of this program are those that the run wrote.
///
/// # Errors
/// One is missing, changed or was not written by the run, which the error names.
pub fn require_tables(record: &Record, folder: &Path) -> Result<(), Error> {
    require_inside(folder, Path::new(SNAPSHOTS))?;
    let there = tables(folder)?;
    let needed = series::FILE.to_owned();
    let names: BTreeSet<&String> = record.files.keys().chain(&there).chain([&needed]).collect();
    for name in names {
        let found = if there.contains(name) { Some(Mark::of(&read(&folder.join(name), TABLE)?)) } else { None };
        let recorded = record.files.get(name).copied();
        if found != recorded || found.is_none() {
            let told = |mark: Option<Mark>| {
                let of = |m: Mark| format!("{} bytes of checksum {:08x}", m.bytes, m.checksum);
                mark.map_or("nothing".to_owned(), of)
            };
            return Err(Refusal::File(name.clone(), told(found), told(recorded)).of(&folder.join(RECORD)));
        }
    }
    Ok(())
}

/// Removes what a run has left in its folder, and nothing else.
///
/// # Errors
/// A file can't be removed.
pub fn discard_run(folder: &Path) -> Result<(), Error> {
    require_inside(folder, Path::new(SNAPSHOTS))?;
    checkpoint::discard(folder)?;
    for name in [RECORD, PARTICLES, "particles.vtu", series::FILE, COLLECTION] {
        discard(&folder.join(name))?;
    }
    let place = folder.join(SNAPSHOTS);
    for file in files_in(&place, &["csv", "vtu", "part"])? {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with(|c: char| c == '.' || c.is_ascii_digit()) {
            discard(&file)?;
        }
    }
    // Stays if anything else is there.
    let _ = std::fs::remove_dir(&place);
    Ok(())
}

fn drive(
    job: &mut dyn Job,
    mut journal: Option<&mut Journal>,
    clock: &Clock,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Option<Failure>, Error> {
    if let Some(journal) = journal.as_mut().filter(|_| job.work().steps == 0)
        && let Some(snapshot) = job.snapshot()
    {
        write_snapshot(&journal.folder, &snapshot)?;
    }
    while !job.finished() {
        if let Some(journal) = &mut journal {
            journal.keep(job, clock)?;
        }
        let row = match job.advance() {
            Ok(row) => row,
            // A later phase that refuses its parameters is wrong input, and no breakdown.
            Err(error @ mpm_core::Error::Input { .. }) => return Err(Error::Input(error.to_string())),
            Err(error) => {
                let ((before, phase), failure) = (job.before(), failure(&error));
                let message = phase + &failure.message;
                return Ok(Some(Failure { time: before + failure.time, message, ..failure }));
            }
        };
        if let Some(journal) = &mut journal {
            journal.series.add(&row)?;
            if let Some(snapshot) = job.snapshot() {
                write_snapshot(&journal.folder, &snapshot)?;
            }
        }
        progress(job.progress());
    }
    Ok(None)
}

fn failure(error: &mpm_core::Error) -> Failure {
    let message = error.to_string();
    let before_any_step = |kind: &str, value: Option<f64>| {
        let (kind, message) = (kind.to_owned(), message.clone());
        Failure { kind, time: 0.0, step: 0, particle: 0, value, message }
    };
    let finite = |value: f64| Some(value).filter(|v| v.is_finite());
    let stopped = |cause, other| if matches!(cause, Cause::GivesWay(..)) { LIMIT_LOAD } else { other };
    match *error {
        mpm_core::Error::Breakdown { time, step, particle, fault } => {
            Failure { kind: fault.kind().to_owned(), time, step, particle, value: finite(fault.value()), message }
        }
        mpm_core::Error::NoConvergence { time, step, residual, cause, .. } => {
            Failure { time, step, ..before_any_step(stopped(cause, "no-convergence"), finite(residual)) }
        }
        mpm_core::Error::Singular { time, step, cause, .. } => {
            Failure { time, step, ..before_any_step(stopped(cause, "singular"), None) }
        }
        mpm_core::Error::Lost { time, step, value, .. } => {
            Failure { time, step, ..before_any_step("lost-share", finite(value)) }
        }
        mpm_core::Error::Input { value, .. } => before_any_step("input", finite(value)),
        mpm_core::Error::Memory(_) => before_any_step("memory", None),
    }
}

/// File that names the snapshots of a run for ParaView, with their times.
const COLLECTION: &str = "snapshots.pvd";

/// Writes a snapshot as CSV and for ParaView, and then the collection with it.
fn write_snapshot(folder: &Path, snapshot: &Snapshot) -> Result<(), Error> {
    let file = snapshot_file(folder, snapshot.time);
    write_columns(&file, &snapshot.columns)?;
    write_vtu(&file.with_extension("vtu"), &snapshot.columns)?;
    write_pvd(&folder.join(COLLECTION), &snapshots_for_paraview(folder)?)
}

/// The snapshots that a run has kept so far, also before it was resumed: time (s) and path from its folder, in order
/// of time. What is there tells, so that a run goes on without remembering them.
fn snapshots_for_paraview(folder: &Path) -> Result<Vec<(f64, String)>, Error> {
    let place = folder.join(SNAPSHOTS);
    let entries = std::fs::read_dir(&place).map_err(|e| Error::file(&place, e))?;
    let mut found = Vec::new();
    for entry in entries {
        let name = entry.map_err(|e| Error::file(&place, e))?.file_name();
        let name = name.to_string_lossy();
        if let Some(Ok(time)) = name.strip_suffix(".vtu").map(str::parse::<f64>) {
            found.push((time, format!("{SNAPSHOTS}/{name}")));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(found)
}

fn write_columns(file: &Path, columns: &[Column]) -> Result<(), Error> {
    let header: Vec<String> = columns.iter().map(|c| format!("{} ({})", c.name, c.unit)).collect();
    let rows = columns.first().map_or(0, |c| c.values.len());
    write_csv(file, &header, (0..rows).map(|k| columns.iter().map(|c| c.values[k].to_string()).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;

    /// Between rows as well.
    #[test]
    fn a_run_is_looked_at_every_second() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let looks = AtomicUsize::new(0);
        let work = || {
            std::thread::sleep(BEAT.mul_f64(1.5));
            Err(Error::Input("the end".to_owned()))
        };
        let look = || {
            looks.fetch_add(1, Relaxed);
        };
        let ended = watched(&pool.unwrap(), work, look).unwrap_err();
        assert_eq!(ended.to_string(), "the end");
        assert_eq!(looks.load(Relaxed), 1);
    }
}
