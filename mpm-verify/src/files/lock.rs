//! One writer of a folder at a time.

use super::make_folder;
use crate::error::Error;
use std::fs::{self, File, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// The file that is locked, and that says by whom.
const FILE: &str = ".mpm-verify.lock";
/// Most bytes that are read of it.
const MOST: u64 = 500;

/// A folder that nobody else writes to. It is free again when this is dropped or its process ends, however it ends.
#[derive(Debug)]
pub struct Held {
    file: PathBuf,
    folder: PathBuf,
    made: bool,
    _lock: File,
}

/// Takes a folder, making it if need be.
///
/// # Errors
/// It can't be written, or another process, which the error names, holds it.
pub fn hold(folder: &Path) -> Result<Held, Error> {
    let made = !folder.exists();
    make_folder(folder)?;
    let path = folder.join(FILE);
    if path.is_symlink() {
        return Err(Error::file(&path, "a link, which is not followed"));
    }
    loop {
        let options = File::options().read(true).write(true).create(true).truncate(false).open(&path);
        let mut lock = options.map_err(|e| Error::file(folder, format!("not writable: {e}")))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut holder = Vec::new();
                // Who holds it may not have said so yet.
                let _ = lock.take(MOST).read_to_end(&mut holder);
                let holder = String::from_utf8_lossy(&holder);
                let cause = format!("another process writes to this folder: {holder}");
                return Err(Error::file(folder, cause.trim_end_matches([' ', ':'])));
            }
            Err(TryLockError::Error(e)) => return Err(Error::file(&path, e)),
        }
        // Who held it before has removed the file and not only let go of it.
        if !is_at(&lock, &path) {
            continue;
        }
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        let now = jiff::Timestamp::now();
        let holder = format!("process {}, `{}`, since {now}", std::process::id(), arguments.join(" "));
        lock.set_len(0).and_then(|()| lock.write_all(holder.as_bytes())).map_err(|e| Error::file(&path, e))?;
        return Ok(Held { file: path, folder: folder.to_path_buf(), made, _lock: lock });
    }
}

#[cfg(unix)]
fn is_at(lock: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let of = |about: std::io::Result<fs::Metadata>| about.ok().map(|m| (m.dev(), m.ino()));
    of(lock.metadata()) == of(fs::metadata(path))
}

/// A file that is open can't be removed there.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

impl Drop for Held {
    fn drop(&mut self) {
        // What stays behind harms nobody: the lock is gone with the process.
        let _ = fs::remove_file(&self.file);
        if self.made {
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_held_by_one_until_it_lets_go() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("out");
        let held = hold(&folder).unwrap();
        let error = hold(&folder).unwrap_err().to_string();
        let me = format!("another process writes to this folder: process {}, `", std::process::id());
        assert!(error.contains(&me), "{error}");
        drop(held);
        assert!(!folder.exists(), "a folder that stays empty goes");
        // What one that was killed has left is no lock.
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join(FILE), "process 1").unwrap();
        drop(hold(&folder).unwrap());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
    }
}
