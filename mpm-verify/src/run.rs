//! One run: a job driven to its end, its outputs and its record.

use crate::case::{Case, Column, Job, RunSpec};
use crate::check::{Kind, Verdict};
use crate::error::Error;
use crate::files::{discard, require_writable, write_csv, write_json};
use crate::parameter::Parameters;
use crate::record::{BREAKS_DOWN, Failure, Machine, Record, SCHEMA, Status, Timing, Version};
use crate::vtu::write_vtu;
use cpu_time::ProcessTime;
use std::path::Path;
use std::time::Instant;

/// Runs `spec` of `case` on `threads` threads. With a folder, the series is written there row by row
/// and, at the end, particles and record; a run that breaks down keeps what it has written and its
/// record says why.
///
/// # Errors
/// The scene can't be built or a file can't be written. A numerical breakdown is not an error here.
pub fn execute(
    case: &dyn Case,
    spec: &RunSpec,
    folder: Option<&Path>,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Record, Error> {
    let parameters = Parameters::new(case.parameters(), &spec.set)?;
    let mut job = case.start(spec, &parameters)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Error::Input(format!("{threads} threads can't be started: {e}")))?;
    pool.install(|| {
        let begun = Instant::now();
        let clock = CpuClock::start(threads);
        let failure = drive(job.as_mut(), folder, progress)?;
        let time = Timing {
            wall_s: begun.elapsed().as_secs_f64(),
            cpu_s: clock.seconds(),
        };
        let mut record = Record {
            schema: SCHEMA,
            case: case.name().to_owned(),
            basis: spec.scheme.basis,
            remedy: spec.scheme.remedy,
            transfer: spec.scheme.transfer,
            level: spec.level.name.to_owned(),
            set: spec.set.clone(),
            perturbed: spec.perturbed,
            status: if failure.is_some() {
                Status::Failed
            } else {
                Status::Ok
            },
            error: failure,
            discretisation: job.discretisation(),
            parameters,
            metrics: Default::default(),
            verdicts: Vec::new(),
            work: job.work(),
            time,
            machine: Machine {
                os: std::env::consts::OS.to_owned(),
                arch: std::env::consts::ARCH.to_owned(),
                cores: std::thread::available_parallelism().map_or(1, usize::from),
                threads,
            },
            version: Version::current(),
        };
        if record.status == Status::Ok {
            record.metrics = job.metrics();
        }
        record.verdicts = judge(case, &record);
        if let Some(folder) = folder {
            write_particles(folder, &job.particles())?;
            write_json(&folder.join("record.json"), &record)?;
        }
        Ok(record)
    })
}

/// All verdicts on one run.
pub fn judge(case: &dyn Case, record: &Record) -> Vec<Verdict> {
    let mut verdicts = vec![match case.breaks_down(record) {
        None => completes(record),
        Some(why) => breaks_down(record, why),
    }];
    if record.status == Status::Ok {
        verdicts.extend(case.judge(record));
    }
    verdicts
}

/// Whether the run came to its end: a check of every case.
fn completes(record: &Record) -> Verdict {
    Verdict::close(
        "completes",
        "run",
        f64::from(u8::from(record.status == Status::Ok)),
        1.0,
        0.0,
        "the equations have a solution",
    )
}

/// Whether a run that is known to break down does.
fn breaks_down(record: &Record, why: &str) -> Verdict {
    Verdict::above(
        BREAKS_DOWN,
        Kind::KnownLimit,
        "run",
        f64::from(u8::from(record.status == Status::Failed)),
        0.0,
        why,
    )
}

/// Processor time: of the calling thread for a run on one thread (others may run beside it), else of
/// the process.
enum CpuClock {
    Thread(cpu_time::ThreadTime),
    Process(ProcessTime),
}

impl CpuClock {
    fn start(threads: usize) -> Self {
        if threads == 1 {
            Self::Thread(cpu_time::ThreadTime::now())
        } else {
            Self::Process(ProcessTime::now())
        }
    }

    fn seconds(&self) -> f64 {
        match self {
            Self::Thread(t) => t.elapsed().as_secs_f64(),
            Self::Process(t) => t.elapsed().as_secs_f64(),
        }
    }
}

fn drive(
    job: &mut dyn Job,
    folder: Option<&Path>,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Option<Failure>, Error> {
    let mut series = match folder {
        Some(folder) => {
            require_writable(folder)?;
            for file in ["record.json", "particles.csv", "particles.vtu"] {
                discard(&folder.join(file))?;
            }
            let path = folder.join("series.csv");
            let mut writer = csv::Writer::from_path(&path).map_err(|e| Error::file(&path, e))?;
            writer
                .write_record(job.series_columns())
                .map_err(|e| Error::file(&path, e))?;
            Some((path, writer))
        }
        None => None,
    };
    while !job.finished() {
        let row = match job.advance() {
            Ok(row) => row,
            Err(error) => return Ok(Some(failure(&error))),
        };
        if let Some((path, writer)) = &mut series {
            writer
                .write_record(row.iter().map(f64::to_string))
                .map_err(|e| Error::file(path, e))?;
            writer.flush().map_err(|e| Error::file(path, e))?;
        }
        progress(job.progress());
    }
    Ok(None)
}

fn failure(error: &mpm_core::Error) -> Failure {
    let message = error.to_string();
    match *error {
        mpm_core::Error::Breakdown {
            time,
            step,
            particle,
            fault,
        } => Failure {
            kind: fault.kind().to_owned(),
            time,
            step,
            particle,
            value: Some(fault.value()).filter(|v| v.is_finite()),
            message,
        },
        mpm_core::Error::Input { value, .. } => Failure {
            kind: "input".to_owned(),
            time: 0.0,
            step: 0,
            particle: 0,
            value: Some(value).filter(|v| v.is_finite()),
            message,
        },
    }
}

fn write_particles(folder: &Path, columns: &[Column]) -> Result<(), Error> {
    let header: Vec<String> = columns
        .iter()
        .map(|c| format!("{} ({})", c.name, c.unit))
        .collect();
    let rows = columns.first().map_or(0, |c| c.values.len());
    write_csv(
        &folder.join("particles.csv"),
        &header,
        (0..rows).map(|k| columns.iter().map(|c| c.values[k].to_string()).collect()),
    )?;
    write_vtu(&folder.join("particles.vtu"), columns)
}
