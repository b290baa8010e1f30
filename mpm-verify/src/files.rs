//! Files: read within bounds, written whole or not at all, by one at a time.

mod layer;
pub mod lock;

pub(crate) use layer::Output;
#[cfg(test)]
pub(crate) use layer::fixture as fault;

use crate::error::{Error, is_unfit};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::{Component, Path, PathBuf};

/// Folder of a run's snapshots, below its own.
pub(crate) const SNAPSHOTS: &str = "snapshots";
/// Most bytes of a document that is read: a record, plan, summary or picture.
pub(crate) const DOCUMENT: u64 = 1 << 27;
/// Most bytes of a table that is read.
pub(crate) const TABLE: u64 = 1 << 30;

/// Message for a file of this program's content in other bytes.
pub(crate) const OTHER_LAYOUT: &str = "not laid out as this program writes it";

/// Size of a file and checksum of its bytes, by which one that was changed is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Mark {
    /// Bytes.
    pub bytes: u64,
    /// Their CRC-32.
    pub checksum: u32,
}

impl Mark {
    /// Mark of these bytes.
    #[must_use]
    pub fn of(content: &[u8]) -> Self {
        Self { bytes: content.len() as u64, checksum: crc32fast::hash(content) }
    }
}

/// File of the snapshot at `time` (s) of the run in `folder`.
pub(crate) fn snapshot_file(folder: &Path, time: f64) -> PathBuf {
    folder.join(SNAPSHOTS).join(format!("{time:07.3}.csv"))
}

/// Reads a file of at most `most` bytes.
///
/// # Errors
/// It is missing, a link, no plain file (a pipe would be waited for), or larger.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    let about = fs::symlink_metadata(path).map_err(|e| Error::file(path, e))?;
    if about.is_symlink() {
        return Err(Error::file(path, "a link, which is not followed"));
    }
    if !about.is_file() {
        return Err(Error::file(path, "not a plain file"));
    }
    if about.len() > most {
        return Err(Error::file(path, format!("{} bytes where {most} are allowed", about.len())));
    }
    fs::read(path).map_err(|e| Error::file(path, e))
}

/// Reads a text in UTF-8 of a bounded size.
///
/// # Errors
/// Those of [`read`], or it is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, Error> {
    String::from_utf8(read(path, DOCUMENT)?).map_err(|_| Error::file(path, "not UTF-8"))
}

/// Reads a picture.
///
/// # Errors
/// Those of [`read`], or it is no picture.
pub fn read_picture(path: &Path) -> Result<image::RgbImage, Error> {
    Ok(image::load_from_memory(&read(path, DOCUMENT)?).map_err(|e| Error::file(path, e))?.to_rgb8())
}

/// Checks that a place below `root` is reached by names alone.
///
/// # Errors
/// A part of it is `..` or leads elsewhere by a link.
pub(crate) fn require_inside(root: &Path, place: &Path) -> Result<(), Error> {
    let mut path = root.to_path_buf();
    for part in place.components() {
        let Component::Normal(name) = part else {
            return Err(Error::file(place, "not a place below a folder"));
        };
        path.push(name);
        if path.is_symlink() {
            return Err(Error::file(&path, "a link, which is not followed"));
        }
    }
    Ok(())
}

/// Makes a folder and its parents.
pub(crate) fn make_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(|e| Error::file(path, e))
}

/// Removes the file of an earlier run and what was being written in its place, as far as they are there.
///
/// # Errors
/// One is there and can't be removed.
pub(crate) fn discard(path: &Path) -> Result<(), Error> {
    for path in [path, &layer::draft(path)] {
        match layer::remove(path) {
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(Error::file(path, e)),
            _ => {}
        }
    }
    Ok(())
}

/// The files with one of some extensions that lie in a folder, if it is there, by name.
pub(crate) fn files_in(folder: &Path, extensions: &[&str]) -> Result<Vec<PathBuf>, Error> {
    let mut entries = entries(folder)?;
    entries.retain(|path| {
        let extension = path.extension().and_then(|e| e.to_str());
        !path.is_dir() && extension.is_some_and(|e| extensions.contains(&e))
    });
    Ok(entries)
}

/// The folders in a folder, if it is there, by name; links are none.
pub(crate) fn folders_in(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut entries = entries(folder)?;
    entries.retain(|path| path.is_dir() && !path.is_symlink());
    Ok(entries)
}

/// The paths in a folder, if it is there, by name.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let entries = fs::read_dir(folder).map_err(|e| Error::file(folder, e))?;
    let paths: Result<Vec<PathBuf>, _> = entries.map(|entry| entry.map(|e| e.path())).collect();
    let mut paths = paths.map_err(|e| Error::file(folder, e))?;
    paths.sort();
    Ok(paths)
}

/// Writes a file so that it is there whole or not at all even if the machine fails: beside it, safely on the disk, then
/// renamed. What one that was killed leaves beside it, the next overwrites.
///
/// # Errors
/// The file can't be written.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Error> {
    write_parts(path, &[content])
}

/// [`write_whole`] of several parts.
pub(crate) fn write_parts(path: &Path, parts: &[&[u8]]) -> Result<(), Error> {
    make_folder(path.parent().unwrap_or(Path::new(".")))?;
    let write = || {
        let mut draft = Output::create(&layer::draft(path))?;
        parts.iter().try_for_each(|part| draft.write_all(part))?;
        draft.persist(path)
    };
    write().map_err(|e: std::io::Error| Error::file(path, e))
}

/// Writes JSON, indented, with a final newline.
pub(crate) fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Error> {
    write_text(path, serde_json::to_string_pretty(value))
}

/// Writes JSON without indentation, for documents of many megabytes.
pub(crate) fn write_dense_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Error> {
    write_text(path, serde_json::to_string(value))
}

fn write_text(path: &Path, text: serde_json::Result<String>) -> Result<(), Error> {
    let text = text.map_err(|e| Error::file(path, e))? + "\n";
    write_whole(path, text.as_bytes())
}

/// Reads a JSON document that names its schema.
///
/// # Errors
/// Those of [`read`], or it is damaged, of another schema, or has text that is not of one line.
pub fn read_versioned<T: DeserializeOwned>(path: &Path, schema: u32) -> Result<T, Error> {
    let damaged = |e: serde_json::Error| Error::file(path, format!("damaged: {e}"));
    let bytes = read(path, DOCUMENT)?;
    let found: Value = serde_json::from_slice(&bytes).map_err(damaged)?;
    match found.get("schema").and_then(Value::as_u64) {
        Some(of) if of == u64::from(schema) => {}
        Some(of) => {
            return Err(Error::file(path, format!("schema {of} where {schema} is expected")));
        }
        None => return Err(Error::file(path, "damaged: no schema")),
    }
    if let Some(text) = unfit(&found) {
        return Err(Error::file(path, format!("damaged: control characters in \"{text}\"")));
    }
    serde_json::from_slice(&bytes).map_err(damaged)
}

/// A text of a document that is not of one line.
fn unfit(value: &Value) -> Option<&str> {
    let unfit_text = |text: &str| text.chars().any(is_unfit);
    match value {
        Value::String(text) => Some(&**text).filter(|t| unfit_text(t)),
        Value::Array(values) => values.iter().find_map(unfit),
        Value::Object(fields) => fields.iter().find_map(|(name, value)| match unfit_text(name) {
            true => Some(&**name),
            false => unfit(value),
        }),
        _ => None,
    }
}

/// Reads CSV whose rows are of one type.
///
/// # Errors
/// Those of [`read`], or a row is not of that type.
pub(crate) fn read_rows<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, Error> {
    let bytes = read(path, DOCUMENT)?;
    let rows = csv::Reader::from_reader(&bytes[..]).into_deserialize();
    let rows: csv::Result<Vec<T>> = rows.collect();
    rows.map_err(|e| Error::file(path, e))
}

pub(crate) fn rows_text<T: Serialize>(rows: impl IntoIterator<Item = T>) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    writer.into_inner().map_err(|e| e.into_error().into())
}

pub(crate) fn csv_text(header: &[String], rows: impl IntoIterator<Item = Vec<String>>) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(&row)?;
    }
    writer.into_inner().map_err(|e| e.into_error().into())
}

/// Writes a table as CSV.
pub(crate) fn write_csv(
    path: &Path,
    header: &[String],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<(), Error> {
    write_whole(path, &csv_text(header, rows).map_err(|e| Error::file(path, e))?)
}
