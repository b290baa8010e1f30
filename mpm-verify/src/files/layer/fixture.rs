//! Machines that fail, for tests.

pub(crate) use super::Step;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// How a machine fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fault {
    /// No step is done any more, as after a kill: the first may be half of a write.
    Kill,
    /// Nothing more can be created or written.
    Full,
}

struct Machine {
    root: PathBuf,
    fault: Fault,
    /// The first step that fails.
    at: usize,
    log: Vec<(Step, PathBuf)>,
}

static MACHINES: Mutex<Vec<Machine>> = Mutex::new(Vec::new());

fn machines() -> MutexGuard<'static, Vec<Machine>> {
    MACHINES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Does `work` on a machine whose disk is the folder `root` and that fails at its step `at`; the steps that it was
/// asked for, in order.
pub(crate) fn on_machine<T>(
    root: &Path,
    fault: Fault,
    at: usize,
    work: impl FnOnce() -> T,
) -> (T, Vec<(Step, PathBuf)>) {
    let root = root.to_path_buf();
    let log = Vec::new();
    machines().push(Machine { root: root.clone(), fault, at, log });
    let result = work();
    let mut all = machines();
    let place = all.iter().position(|m| m.root == root).unwrap();
    (result, all.swap_remove(place).log)
}

pub(super) fn pass(step: Step, path: &Path) -> io::Result<()> {
    let mut all = machines();
    let Some(machine) = all.iter_mut().find(|m| path.starts_with(&m.root)) else {
        return Ok(());
    };
    let now = machine.log.len();
    machine.log.push((step, path.to_path_buf()));
    let adds = matches!(step, Step::Create | Step::Write);
    match machine.fault {
        Fault::Kill if now > machine.at => Err(io::Error::other("killed")),
        Fault::Kill if now == machine.at => Err(torn("killed")),
        Fault::Full if now >= machine.at && adds => Err(torn("No space left on device")),
        _ => Ok(()),
    }
}

fn torn(what: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::StorageFull, what)
}

/// Whether a write that fails so leaves its first half.
pub(super) fn tears(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::StorageFull
}
