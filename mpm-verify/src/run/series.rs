//! The time series of a run: a table that grows by a row at a time.

use super::*;
use crate::files::Output;
use crate::job::Row;
use crc32fast::Hasher;
use std::fs::File;
use std::io::{self, Read, Write};

/// Name of its file.
pub const FILE: &str = "series.csv";

/// A series that is being written.
pub struct Series {
    path: PathBuf,
    writer: csv::Writer<Tallied>,
}

/// A file, and the tally of what went into it.
struct Tallied {
    file: Output,
    bytes: u64,
    checksum: Hasher,
}

impl Write for Tallied {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        let written = self.file.write(content)?;
        self.bytes += written as u64;
        self.checksum.update(&content[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Series {
    /// Begins a series in `folder`, in place of what is there.
    pub(crate) fn begin(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(FILE);
        discard(&path)?;
        let file = Output::create(&path).map_err(|e| Error::file(&path, e))?;
        Ok(Self::on(path, file, 0, Hasher::new()))
    }

    /// Resumes the series in `folder` from `mark`, cutting off what comes after it; `None` if it does
    /// not begin with what the mark knows.
    ///
    /// # Errors
    /// The file can't be read or written.
    pub fn resume(folder: &Path, mark: Mark) -> Result<Option<Self>, Error> {
        let path = folder.join(FILE);
        let reopen = || -> io::Result<Option<(Output, Hasher)>> {
            if path.is_symlink() {
                return Ok(None);
            }
            let options = File::options().read(true).write(true).open(&path);
            let mut file = match options {
                Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
                other => other?,
            };
            let mut known = Vec::new();
            (&mut file).take(mark.bytes).read_to_end(&mut known)?;
            let mut checksum = Hasher::new();
            checksum.update(&known);
            if known.len() as u64 != mark.bytes || checksum.clone().finalize() != mark.checksum {
                return Ok(None);
            }
            Ok(Some((Output::after(&path, file, mark.bytes)?, checksum)))
        };
        let reopened = reopen().map_err(|e| Error::file(&path, e))?;
        Ok(reopened.map(|(file, checksum)| Self::on(path, file, mark.bytes, checksum)))
    }

    fn on(path: PathBuf, file: Output, bytes: u64, checksum: Hasher) -> Self {
        let tallied = Tallied { file, bytes, checksum };
        let writer = csv::Writer::from_writer(tallied);
        Self { path, writer }
    }

    fn write(&mut self, write: impl FnOnce(&mut csv::Writer<Tallied>) -> csv::Result<()>) -> Result<(), Error> {
        write(&mut self.writer).and_then(|()| Ok(self.writer.flush()?)).map_err(|e| Error::file(&self.path, e))
    }

    /// Adds a row, below the names of its columns if it is the first.
    pub(crate) fn add(&mut self, Row(row): &Row) -> Result<(), Error> {
        let begins = self.writer.get_ref().bytes == 0;
        self.write(|writer| {
            if begins {
                writer.write_record(row.iter().map(|(name, _)| name))?;
            }
            writer.write_record(row.iter().map(|(_, value)| value.to_string()))
        })
    }

    /// How far the series has come; what stands there stays even if the machine fails.
    pub(crate) fn secure(&self) -> Result<Mark, Error> {
        let tallied = self.writer.get_ref();
        tallied.file.sync().map_err(|e| Error::file(&self.path, e))?;
        Ok(Mark { bytes: tallied.bytes, checksum: tallied.checksum.clone().finalize() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_goes_on_from_its_mark_and_from_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE);
        let row = |a, b| Row(vec![("a", a), ("b", b)]);
        let mut series = Series::begin(folder.path()).unwrap();
        series.add(&row(1.0, 2.5)).unwrap();
        let mark = series.secure().unwrap();
        series.add(&row(3.0, 4.0)).unwrap();
        drop(series);
        std::fs::write(&path, "a,b\n1,2.5\n3,4\n5,").unwrap();
        let mut series = Series::resume(folder.path(), mark).unwrap().unwrap();
        series.add(&row(6.0, 7.0)).unwrap();
        let further = series.secure().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "a,b\n1,2.5\n6,7\n");
        assert!(Series::resume(folder.path(), further).unwrap().is_some());
        for other in ["a,b\n1,2.", "a,b\n1,2.6\n6,7\n"] {
            std::fs::write(&path, other).unwrap();
            assert!(Series::resume(folder.path(), mark).unwrap().is_none());
            assert_eq!(std::fs::read_to_string(&path).unwrap(), other);
        }
        std::fs::remove_file(&path).unwrap();
        assert!(Series::resume(folder.path(), mark).unwrap().is_none());
    }
}
