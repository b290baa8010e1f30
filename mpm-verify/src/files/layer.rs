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
pub(crate) mod fixture;
#[cfg(test)]
use fixture::pass;

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
        Ok(Self { file, path: path.to_path_buf() })
    }

    /// Resumes an open file after its first bytes, cutting off the others.
    pub(crate) fn after(path: &Path, mut file: File, bytes: u64) -> io::Result<Self> {
        pass(Step::Write, path)?;
        file.set_len(bytes)?;
        file.seek(io::SeekFrom::End(0))?;
        Ok(Self { file, path: path.to_path_buf() })
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
        if passed.as_ref().is_err_and(fixture::tears) {
            self.file.write_all(&content[..content.len() / 2])?;
        }
        passed?;
        self.file.write(content)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
