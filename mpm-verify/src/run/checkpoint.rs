//! Checkpoints: a run on disk, from which it resumes bit for bit.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `MPMCHECK` |
//! | 4 | version of the format |
//! | 8 | number of bytes after the checksum |
//! | 4 | their checksum, CRC-32 |
//! | … | whose checkpoint it is (JSON); the mark of the series and the time taken; the memory of the job |
//!
//! Numbers are little-endian; what follows the checksum is written by serde in the format of `postcard`.

use super::*;
use crate::files;
use crate::record::Version;
use crc32fast::Hasher;
use mpm_core::{MemoryError, Saved};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Name of its file.
pub const FILE: &str = "checkpoint.bin";
/// Default interval between checkpoints (s).
pub const EVERY_S: u64 = 60;
/// How the file begins.
const MAGIC: [u8; 8] = *b"MPMCHECK";
/// Version of the format.
const FORMAT: u32 = 1;

/// Interval of checkpoints, and whether the run resumes from one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Saving {
    /// Time by the clock from one checkpoint to the next, which comes with the next row of the series.
    pub every: Duration,
    /// Whether to resume from the checkpoint in the run's folder, if there is one.
    pub resume: bool,
}

impl Saving {
    /// The default interval, resuming from an existing checkpoint.
    pub(crate) fn resuming() -> Self {
        Self { every: Duration::from_secs(EVERY_S), resume: true }
    }
}

/// Reason why a run can't resume from the files in its folder.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Refusal {
    /// The file begins with something else.
    #[error("not a checkpoint")]
    NotACheckpoint,
    /// Another version of the format.
    #[error("a checkpoint of format {0} where {FORMAT} is expected")]
    Format(u32),
    /// The end is missing: bytes there are, and there should be.
    #[error("truncated: {0} bytes where {1} are expected")]
    Truncated(u64, u64),
    /// Some bytes have changed: checksum of what is there, and of what was written.
    #[error("damaged: checksum {0:08x} where {1:08x} is expected")]
    Damaged(u32, u32),
    /// Sound bytes that mean nothing.
    #[error("can't be read: {0}")]
    Content(String),
    /// Another case, scheme, level or twin: the run there, and the one asked for.
    #[error("of another run: {0}, not {1}")]
    Run(String, String),
    /// The same run at another value of a parameter: its name, its value there, and the one asked for.
    #[error("of other parameters: {0} = {1}, not {2}")]
    Parameter(String, String, String),
    /// Other sources: the fingerprint there, and that of this program.
    #[error("of another program: source {0}, not {1}")]
    Program(String, String),
    /// The series is not the one that the checkpoint was written beside.
    #[error("{} is not the series that it was written with", crate::run::series::FILE)]
    Series,
    /// A file beside the record differs from the one the run wrote: its name, its mark, and the mark as written.
    #[error("{0} is {1}, not the {2} that the run has written")]
    File(String, String, String),
    /// The job is not one of this memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

impl Refusal {
    /// As an error about a file.
    #[must_use]
    pub fn of(self, path: &Path) -> Error {
        Error::Checkpoint { path: path.to_path_buf(), refusal: Box::new(self) }
    }
}

/// Whose results a file holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    program: Version,
    /// Case, scheme, level, and whether it is the perturbed twin.
    run: String,
    parameters: Parameters,
}

impl Identity {
    /// Identity of a run by this program.
    #[must_use]
    pub fn of(case: &Case, spec: &RunSpec, parameters: &Parameters) -> Self {
        Self {
            program: Version::current(),
            run: run(case.name, spec.scheme, spec.level.name, spec.perturbed),
            parameters: parameters.clone(),
        }
    }

    /// Identity of the run that left a record.
    #[must_use]
    pub fn of_record(record: &Record) -> Self {
        Self {
            program: record.version.clone(),
            run: run(&record.case, record.scheme(), &record.level, record.perturbed),
            parameters: record.parameters.clone(),
        }
    }

    /// Checks that what was found is of this run.
    ///
    /// # Errors
    /// The first difference: run, parameters, program.
    pub fn require(&self, found: &Self) -> Result<(), Refusal> {
        if found.run != self.run {
            return Err(Refusal::Run(found.run.clone(), self.run.clone()));
        }
        let differences = found.parameters.differences(&self.parameters);
        if let Some((name, found, asked)) = differences.into_iter().next() {
            return Err(Refusal::Parameter(name, found, asked));
        }
        if found.program != self.program {
            return Err(Refusal::Program(found.program.source.clone(), self.program.source.clone()));
        }
        Ok(())
    }
}

fn run(case: &str, scheme: crate::scheme::Scheme, level: &str, perturbed: bool) -> String {
    let twin = if perturbed { " (perturbed)" } else { "" };
    format!("{case} {scheme}/{level}{twin}")
}

/// A run as it was after a row of its series.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    /// How far the series had come.
    pub series: Mark,
    /// Time taken.
    pub time: Timing,
    /// Memory of the job.
    pub memory: Saved,
}

impl Checkpoint {
    /// Reads the checkpoint in a folder; `None` for a folder without one.
    ///
    /// # Errors
    /// It is truncated, damaged, of another format, run or program, of other parameters, or can't be read.
    pub fn read(folder: &Path, identity: &Identity) -> Result<Option<Self>, Error> {
        let path = folder.join(FILE);
        if !path.exists() {
            return Ok(None);
        }
        let bytes = files::read(&path, TABLE)?;
        Self::decode(&bytes, identity).map(Some).map_err(|refusal| refusal.of(&path))
    }

    fn decode(bytes: &[u8], identity: &Identity) -> Result<Self, Refusal> {
        let content = sound_content(bytes)?;
        let unreadable = |e: &dyn ToString| Refusal::Content(e.to_string());
        let (json, rest) = postcard::take_from_bytes::<&str>(content).map_err(|e| unreadable(&e))?;
        let found = serde_json::from_str(json).map_err(|e| unreadable(&e))?;
        identity.require(&found)?;
        let ((series, time), memory) = postcard::take_from_bytes(rest).map_err(|e| unreadable(&e))?;
        Ok(Self { series, time, memory: Saved::from_bytes(memory.to_vec()) })
    }

    /// Writes it, whole or not at all.
    fn write(&self, folder: &Path, identity: &Identity) -> Result<(), Error> {
        let path = folder.join(FILE);
        let json = serde_json::to_string(identity).map_err(|e| Error::file(&path, e))?;
        let about = postcard::to_stdvec(&(json, (self.series, self.time))).map_err(|e| Error::file(&path, e))?;
        let memory = self.memory.bytes();
        let mut checksum = Hasher::new();
        checksum.update(&about);
        checksum.update(memory);
        let length = (about.len() + memory.len()) as u64;
        let parts = [
            &MAGIC[..],
            &FORMAT.to_le_bytes(),
            &length.to_le_bytes(),
            &checksum.finalize().to_le_bytes(),
            &about,
            memory,
        ];
        files::write_parts(&path, &parts)
    }
}

/// The content after the checksum, if that is right.
fn sound_content(bytes: &[u8]) -> Result<&[u8], Refusal> {
    let Some(rest) = bytes.strip_prefix(&MAGIC) else { return Err(Refusal::NotACheckpoint) };
    let missing = |expected| Refusal::Truncated(bytes.len() as u64, expected);
    let head = |size: usize| missing((MAGIC.len() + size) as u64);
    let (format, rest) = rest.split_first_chunk().ok_or_else(|| head(4))?;
    if u32::from_le_bytes(*format) != FORMAT {
        return Err(Refusal::Format(u32::from_le_bytes(*format)));
    }
    let (length, rest) = rest.split_first_chunk().ok_or_else(|| head(12))?;
    let (checksum, content) = rest.split_first_chunk().ok_or_else(|| head(16))?;
    let length = u64::from_le_bytes(*length);
    let found = content.len() as u64;
    if found < length {
        return Err(missing((bytes.len() as u64 - found).saturating_add(length)));
    }
    let checksum = u32::from_le_bytes(*checksum);
    match crc32fast::hash(content) {
        found if found == checksum => Ok(content),
        found => Err(Refusal::Damaged(found, checksum)),
    }
}

/// Removes the checkpoint of a folder, if there is one.
///
/// # Errors
/// It is there and can't be removed.
pub fn discard(folder: &Path) -> Result<(), Error> {
    files::discard(&folder.join(FILE))
}

/// Keeps the checkpoint of a run up to date.
#[derive(Debug)]
pub struct Keeper {
    folder: PathBuf,
    identity: Identity,
    every: Duration,
    last: Instant,
}

impl Keeper {
    /// Writer of checkpoints for a run in `folder` that begins, or resumes, now.
    #[must_use]
    pub fn new(folder: &Path, identity: Identity, every: Duration) -> Self {
        Self { folder: folder.to_path_buf(), identity, every, last: Instant::now() }
    }

    /// Whether it is time for the next checkpoint.
    pub(crate) fn due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Writes a checkpoint in place of the last.
    ///
    /// # Errors
    /// The file can't be written.
    pub fn keep(&mut self, checkpoint: &Checkpoint) -> Result<(), Error> {
        checkpoint.write(&self.folder, &self.identity)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Ends: a run that has its record needs no checkpoint.
    pub(crate) fn end(self) -> Result<(), Error> {
        discard(&self.folder)
    }
}
