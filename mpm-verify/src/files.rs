//! Files that are written whole or not at all.

use crate::error::Error;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Folder of a run's snapshots, below its own.
pub(crate) const SNAPSHOTS: &str = "snapshots";

/// File of the snapshot at `time` (s) of the run in `folder`.
#[must_use]
pub fn snapshot_file(folder: &Path, time: f64) -> PathBuf {
    folder.join(SNAPSHOTS).join(format!("{time:07.3}.csv"))
}

/// Makes a folder and its parents.
///
/// # Errors
/// The folder can't be made.
pub fn make_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(|e| Error::file(path, e))
}

/// Checks that files can be written in a folder, making it if need be.
///
/// # Errors
/// They can't.
pub fn require_writable(folder: &Path) -> Result<(), Error> {
    make_folder(folder)?;
    tempfile::NamedTempFile::new_in(folder)
        .map(drop)
        .map_err(|e| Error::file(folder, format!("not writable: {e}")))
}

/// Removes the file of an earlier run, if there is one.
///
/// # Errors
/// It is there and can't be removed.
pub fn discard(path: &Path) -> Result<(), Error> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(Error::file(path, e)),
        _ => Ok(()),
    }
}

/// Removes a folder of an earlier run, if there is one.
///
/// # Errors
/// It is there and can't be removed.
pub fn discard_folder(path: &Path) -> Result<(), Error> {
    match fs::remove_dir_all(path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(Error::file(path, e)),
        _ => Ok(()),
    }
}

/// The files with one of some extensions that lie in a folder, if it is there.
///
/// # Errors
/// The folder can't be read.
pub fn files_in(folder: &Path, extensions: &[&str]) -> Result<Vec<PathBuf>, Error> {
    let mut entries = entries(folder)?;
    entries.retain(|path| {
        let extension = path.extension().and_then(|e| e.to_str());
        path.is_file() && extension.is_some_and(|e| extensions.contains(&e))
    });
    Ok(entries)
}

/// The folders in a folder, if it is there.
///
/// # Errors
/// The folder can't be read.
pub fn folders_in(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut entries = entries(folder)?;
    entries.retain(|path| path.is_dir());
    Ok(entries)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let entries = fs::read_dir(folder).map_err(|e| Error::file(folder, e))?;
    let path = |entry: std::io::Result<fs::DirEntry>| entry.map(|e| e.path());
    let paths: Result<Vec<PathBuf>, _> = entries.map(path).collect();
    paths.map_err(|e| Error::file(folder, e))
}

/// Writes a file by way of a temporary one beside it.
///
/// # Errors
/// The file can't be written.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Error> {
    let folder = path.parent().unwrap_or(Path::new("."));
    make_folder(folder)?;
    let mut draft = readable_draft(folder).map_err(|e| Error::file(path, e))?;
    draft.write_all(content).map_err(|e| Error::file(path, e))?;
    draft.persist(path).map_err(|e| Error::file(path, e))?;
    Ok(())
}

/// Writes a file so that it is there whole or not at all even if the machine fails: by way of `draft`, in the
/// same folder, which one that was killed leaves behind for the next to overwrite.
///
/// # Errors
/// The file can't be written.
pub fn write_durable(path: &Path, draft: &Path, parts: &[&[u8]]) -> Result<(), Error> {
    let write = || {
        let mut file = fs::File::create(draft)?;
        for part in parts {
            file.write_all(part)?;
        }
        file.sync_all()?;
        fs::rename(draft, path)?;
        // The new name is in the folder; elsewhere than on Unix a folder can't be opened.
        #[cfg(unix)]
        fs::File::open(path.parent().unwrap_or(Path::new(".")))?.sync_all()?;
        Ok(())
    };
    write().map_err(|e: std::io::Error| Error::file(path, e))
}

/// A temporary file with the permissions of an ordinary one.
fn readable_draft(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

/// Writes JSON, indented, with a final newline.
///
/// # Errors
/// The file can't be written.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Error> {
    let mut text = serde_json::to_string_pretty(value).map_err(|e| Error::file(path, e))?;
    text.push('\n');
    write_whole(path, text.as_bytes())
}

/// Writes JSON without indentation, for documents of many megabytes.
///
/// # Errors
/// The file can't be written.
pub fn write_dense_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Error> {
    let mut text = serde_json::to_string(value).map_err(|e| Error::file(path, e))?;
    text.push('\n');
    write_whole(path, text.as_bytes())
}

/// Reads a JSON document that names its schema.
///
/// # Errors
/// The file is missing, damaged or of another schema.
pub fn read_versioned<T: DeserializeOwned>(path: &Path, schema: u32) -> Result<T, Error> {
    #[derive(Deserialize)]
    struct Versioned {
        schema: u32,
    }
    let damaged = |e: serde_json::Error| Error::file(path, format!("damaged: {e}"));
    let bytes = fs::read(path).map_err(|e| Error::file(path, e))?;
    let found: Versioned = serde_json::from_slice(&bytes).map_err(damaged)?;
    if found.schema != schema {
        let cause = format!("schema {} where {schema} is expected", found.schema);
        return Err(Error::file(path, cause));
    }
    serde_json::from_slice(&bytes).map_err(damaged)
}

/// Writes a table as CSV.
///
/// # Errors
/// The file can't be written.
pub fn write_csv(
    path: &Path,
    header: &[String],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<(), Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(header)
        .map_err(|e| Error::file(path, e))?;
    for row in rows {
        writer
            .write_record(&row)
            .map_err(|e| Error::file(path, e))?;
    }
    let bytes = writer.into_inner().map_err(|e| Error::file(path, e))?;
    write_whole(path, &bytes)
}
