//! The steps by which a file changes. Each passes a gate, at which tests stop the machine.

use std::fs::File;
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

/// A change of what is on the disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step {
    Create,
    Write,
    Sync,
    Rename,
    SyncFolder,
    Remove,
}

#[cfg(not(test))]
fn pass(_: Step, _: &Path) -> io::Result<()> {
    Ok(())
}
#[cfg(test)]
use fault::pass;

/// Where a file is written before it has its name.
pub(super) fn draft(path: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".part");
    path.with_file_name(name)
}

/// Removes a file, or a link and not what it leads to.
pub(super) fn remove(path: &Path) -> io::Result<()> {
    if !path.is_symlink() && !path.exists() {
        return Ok(());
    }
    pass(Step::Remove, path)?;
    std::fs::remove_file(path)
}

/// A file that is being written.
pub(crate) struct Output {
    file: File,
    path: PathBuf,
}

impl Output {
    /// A new file in the place of what is there, be it a link.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        if path.is_symlink() {
            remove(path)?;
        }
        pass(Step::Create, path)?;
        let file = File::create(path)?;
        let path = path.to_path_buf();
        Ok(Self { file, path })
    }

    /// Resumes an open file after its first bytes, cutting off the others.
    pub(crate) fn after(path: &Path, mut file: File, bytes: u64) -> io::Result<Self> {
        pass(Step::Write, path)?;
        file.set_len(bytes)?;
        file.seek(io::SeekFrom::End(0))?;
        let path = path.to_path_buf();
        Ok(Self { file, path })
    }

    /// Syncs the file, so that its content survives a failure of the machine.
    pub(crate) fn sync(&self) -> io::Result<()> {
        pass(Step::Sync, &self.path)?;
        self.file.sync_all()
    }

    /// Gives the file the name that it is to have, once it is safe.
    pub(crate) fn persist(self, path: &Path) -> io::Result<()> {
        self.sync()?;
        pass(Step::Rename, path)?;
        std::fs::rename(&self.path, path)?;
        // The new name is in the folder; elsewhere than on Unix a folder can't be opened.
        #[cfg(unix)]
        {
            let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
            pass(Step::SyncFolder, path)?;
            File::open(folder.unwrap_or(Path::new(".")))?.sync_all()?;
        }
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        let passed = pass(Step::Write, &self.path);
        #[cfg(test)]
        if passed.as_ref().is_err_and(fault::tears) {
            self.file.write_all(&content[..content.len() / 2])?;
        }
        passed?;
        self.file.write(content)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Machines that fail, for tests.
#[cfg(test)]
pub(crate) mod fault {
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
}
