//! Sources of a case's pictures: the records of a report, and the output files of the runs.

use crate::draw::Chart;
use crate::error::Error;
use crate::files::{snapshot_file, write_csv};
use crate::record::Record;
use crate::table::Table;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A picture of a report.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    /// File below the report's folder.
    pub file: String,
    pub caption: String,
}

impl Picture {
    /// Pictures in the folder of a case that one caption serves, each after the first as a further part of it.
    pub(crate) fn of_files(case: &str, files: Vec<PathBuf>, caption: &str) -> Vec<Self> {
        let picture = |(k, path): (usize, PathBuf)| Self {
            file: format!("{case}/{}", path.file_name().unwrap_or_default().display()),
            caption: match k {
                0 => caption.to_owned(),
                k => format!("Part {}: {caption}", k + 1),
            },
        };
        files.into_iter().enumerate().map(picture).collect()
    }
}

/// The folder of a run.
pub(crate) type FolderOf<'a> = &'a dyn Fn(&Record) -> Result<PathBuf, Error>;

/// The runs of a case, and the place for its pictures.
pub struct Gallery<'a> {
    /// Name of the case, which is also the folder of its pictures.
    pub case: &'a str,
    /// Records, in the order of the plan.
    pub records: &'a [Record],
    folder: FolderOf<'a>,
    out: &'a Path,
    pictures: Vec<Picture>,
    read: RefCell<BTreeSet<PathBuf>>,
}

impl<'a> Gallery<'a> {
    /// Gallery of runs whose outputs lie in `folder`, for a report in `out`.
    pub(crate) fn new(case: &'a str, records: &'a [Record], folder: FolderOf<'a>, out: &'a Path) -> Self {
        Self { case, records, folder, out, pictures: Vec::new(), read: RefCell::default() }
    }

    /// Reads a table that a run has written.
    ///
    /// # Errors
    /// The run is not of this report, or the file is missing or damaged.
    pub fn table(&self, record: &Record, file: &str) -> Result<Table, Error> {
        self.read((self.folder)(record)?.join(file))
    }

    /// The particles that a run has kept at `time` (s), if it has.
    ///
    /// # Errors
    /// The run is not of this report, or the file is damaged.
    pub fn snapshot(&self, record: &Record, time: f64) -> Result<Option<Table>, Error> {
        let file = snapshot_file(&(self.folder)(record)?, time);
        file.exists().then(|| self.read(file)).transpose()
    }

    fn read(&self, file: PathBuf) -> Result<Table, Error> {
        let table = Table::read(&file);
        self.read.borrow_mut().insert(file);
        table
    }

    /// Where a file of the case's folder goes.
    pub fn place(&self, file: &str) -> PathBuf {
        self.out.join(self.case).join(file)
    }

    /// Writes every point of every curve: chart, quantity, series, abscissa, ordinate.
    pub(crate) fn write_curves(&self, file: &str, charts: &[Chart]) -> Result<(), Error> {
        let abscissa = charts.first().map_or("", |chart| &chart.x_label);
        let header = ["chart", "quantity", "series", abscissa, "value"].map(str::to_owned);
        let rows = charts.iter().flat_map(|chart| {
            chart.series.iter().flat_map(move |s| {
                s.points.iter().map(move |(x, y)| {
                    let cells = [chart.title.clone(), chart.y_label.clone(), s.name.clone()];
                    let numbers = [format!("{x:.6}"), format!("{y:.6}")];
                    [&cells[..], &numbers[..]].concat()
                })
            })
        });
        write_csv(&self.place(file), &header, rows)
    }

    /// Hangs a picture that was drawn at [`Gallery::place`].
    pub fn hang(&mut self, file: &str, caption: impl Into<String>) {
        self.pictures.push(Picture { file: format!("{}/{file}", self.case), caption: caption.into() });
    }

    /// The pictures, in the order they were hung, and the tables from which they were drawn.
    pub(crate) fn done(self) -> (Vec<Picture>, BTreeSet<PathBuf>) {
        (self.pictures, self.read.into_inner())
    }
}
