//! Goldens: blessed results, so that drift is seen. They never stand in for the truth.
//!
//! `golden/<case>/<scheme>/<level>/` holds the metrics, some forty rows of the time series, a picture
//! drawn from those rows, a tolerance for each column, the work that was done, and when and why they were
//! blessed. A tolerance is ten times the measured response of its column to a last-bit perturbation of the
//! starting positions; a column that did not respond must not change at all, and neither must a count of work.

use crate::case::Case;
use crate::cases;
use crate::error::Error;
use crate::files::{make_folder, read_versioned, write_json, write_whole};
use crate::record::{Measured, Record, Version, WorkDone};
use crate::report::triptych::different_pixels;
use crate::report::watched::draw_watched;
use crate::spec::RunSpec;
use crate::table::Table;
use crate::verdict::{Kind, Outcome, Verdict};
use image::RgbImage;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

const METRICS: &str = "metrics.csv";
const SERIES: &str = "series.csv";
const TOLERANCES: &str = "tolerances.csv";
const WORK: &str = "work.csv";
const PICTURE: &str = "series.png";
const BLESSING: &str = "blessed.json";
/// Version of the blessing's format.
const SCHEMA: u32 = 1;
/// Rows of a series that are kept, about.
const ROWS: usize = 40;
/// Tolerance over response.
pub const MARGIN: f64 = 10.0;
/// Runs of more particle steps than this (some minutes) have no golden: each would be run twice.
const MOST_STEPS: u64 = 2_000_000_000;
/// The metric of the verdict on a golden's picture.
pub const PIXELS: &str = "different pixels of the picture";
/// What stands before the name of a count in the metric of its verdict.
const COUNT: &str = "count of ";
/// The count that is told where none has changed.
const PAIRS: &str = "particle_node_pairs";
/// Name of the check.
const CHECK: &str = "golden";

/// The tolerance of a column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// The table, without its extension.
    pub table: String,
    /// The column, with its unit.
    pub column: String,
    /// Rows of the table.
    pub rows: usize,
    /// Largest admissible difference in any row, in the column's unit.
    pub tolerance: f64,
    /// Largest difference between the run and its perturbed twin.
    pub response: f64,
}

/// When and why a golden was blessed, and by which program.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Blessing {
    /// Version of this format.
    pub schema: u32,
    /// Date (UTC).
    pub date: String,
    /// Why.
    pub reason: String,
    /// Date and reason of a later blessing of the same numbers, if only their picture or the work has changed.
    pub redrawn: Option<[String; 2]>,
    /// The program that ran.
    pub version: Version,
    /// Operating system and architecture it ran on.
    pub machine: String,
}

/// A golden.
#[derive(Debug, Clone)]
pub struct Golden {
    metrics: Table,
    series: Table,
    tolerances: Vec<Tolerance>,
    work: WorkDone,
    blessing: Blessing,
    picture: RgbImage,
}

/// Folder of the golden of a run.
#[must_use]
pub fn home(root: &Path, record: &Record) -> PathBuf {
    root.join(&record.case).join(record.folder())
}

/// Why no golden is kept of a run, if none is.
#[must_use]
pub fn why_none(case: &Case, record: &Record) -> Option<String> {
    let tier = case.golden_tier;
    let carries = |spec: &RunSpec| spec.folder() == record.folder();
    if record.work.particle_steps > MOST_STEPS {
        Some(format!(
            "no golden is kept of more than {MOST_STEPS:e} particle steps"
        ))
    } else if (case.breaks_down)(record).is_some() {
        Some("the run breaks down as it is known to: nothing to compare".to_owned())
    } else if !case.runs(tier).iter().any(carries) {
        Some(format!("goldens are kept of the runs of tier {tier} only"))
    } else {
        None
    }
}

/// Verdicts on the drift of a run, whose outputs lie in `folder`, from its golden below `root`.
///
/// # Errors
/// The run's own series can't be read, or a picture can't be drawn.
pub fn compare(root: &Path, record: &Record, folder: &Path) -> Result<Vec<Verdict>, Error> {
    if record.broke_down() {
        let why = "the run broke down: nothing to compare";
        return Ok(vec![mismatch("run", why.to_owned())]);
    }
    if !home(root, record).exists()
        && let Some(why) = why_none(cases::find(&record.case)?, record)
    {
        let verdict = Verdict::not_applicable(CHECK, "run", why);
        return Ok(vec![Verdict {
            kind: Kind::Drift,
            ..verdict
        }]);
    }
    match Golden::read(&home(root, record)) {
        Ok(golden) => golden.compare(record, folder),
        Err(error) => Ok(vec![mismatch("run", error.to_string())]),
    }
}

/// A failed comparison that has no numbers.
fn mismatch(metric: &str, why: String) -> Verdict {
    Verdict {
        check: CHECK.to_owned(),
        kind: Kind::Drift,
        metric: metric.to_owned(),
        value: None,
        reference: None,
        tolerance: None,
        outcome: Outcome::Failed,
        source: why,
    }
}

fn with_unit(name: &str, metric: &Measured) -> String {
    format!("{name} ({})", metric.unit)
}

/// Whether a drift leaves metrics and series alone, so that their tolerances stay what they are.
#[must_use]
pub fn leaves_numbers(drift: &Verdict) -> bool {
    drift.metric == PIXELS || drift.metric.starts_with(COUNT)
}

/// The metrics of a record that have a value, as a table of one row.
fn metrics_of(record: &Record) -> Table {
    let cells = record.metrics.iter();
    Table::of_row(
        cells
            .filter_map(|(name, m)| Some((with_unit(name, m), m.value?)))
            .collect(),
    )
}

impl Golden {
    /// Reads a golden.
    ///
    /// # Errors
    /// A file that is missing or damaged, a cell that is not finite, a column without a tolerance, a
    /// number of rows that is not the recorded one, or a tolerance that the response does not justify.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        if !folder.exists() {
            return Err(Error::file(folder, "no golden"));
        }
        let path = folder.join(TOLERANCES);
        let mut tolerances = Vec::new();
        let mut reader = csv::Reader::from_path(&path).map_err(|e| Error::file(&path, e))?;
        for row in reader.deserialize::<Tolerance>() {
            let row = row.map_err(|e| Error::file(&path, e))?;
            if !(row.response >= 0.0
                && row.tolerance >= row.response
                && row.tolerance <= MARGIN * row.response)
            {
                let cause = format!(
                    "{} {}: tolerance {:e} for a response of {:e}; allowed: 1 to {MARGIN} times the response",
                    row.table, row.column, row.tolerance, row.response
                );
                return Err(Error::file(&path, cause));
            }
            if tolerances
                .iter()
                .any(|t: &Tolerance| t.table == row.table && t.column == row.column)
            {
                let cause = format!("{} {} is there twice", row.table, row.column);
                return Err(Error::file(&path, cause));
            }
            tolerances.push(row);
        }
        let path = folder.join(WORK);
        let mut reader = csv::Reader::from_path(&path).map_err(|e| Error::file(&path, e))?;
        let work = reader.deserialize().next();
        let work = work.ok_or_else(|| Error::file(&path, "no rows"))?;
        let picture = folder.join(PICTURE);
        let golden = Self {
            metrics: Table::read_finite(&folder.join(METRICS))?,
            series: Table::read_finite(&folder.join(SERIES))?,
            blessing: read_versioned(&folder.join(BLESSING), SCHEMA)?,
            picture: image::open(&picture)
                .map_err(|e| Error::file(&picture, e))?
                .to_rgb8(),
            work: work.map_err(|e| Error::file(&path, e))?,
            tolerances,
        };
        for (name, table) in [("metrics", &golden.metrics), ("series", &golden.series)] {
            golden.check_shape(name, table, folder)?;
        }
        Ok(golden)
    }

    /// Whether a table has the columns and rows that tolerances are stored for.
    fn check_shape(&self, name: &str, table: &Table, folder: &Path) -> Result<(), Error> {
        let path = folder.join(format!("{name}.csv"));
        for t in self.tolerances.iter().filter(|t| t.table == name) {
            match table.get(&t.column) {
                None => return Err(Error::file(&path, format!("no column {}", t.column))),
                Some(values) if values.len() != t.rows => {
                    let cause = format!("{} rows where {} are expected", values.len(), t.rows);
                    return Err(Error::file(&path, cause));
                }
                Some(_) => {}
            }
        }
        match table
            .iter()
            .find(|(column, _)| self.tolerance(name, column).is_none())
        {
            Some((column, _)) => Err(Error::file(
                &folder.join(TOLERANCES),
                format!("no tolerance for {name} {column}"),
            )),
            None if table.rows() == 0 => Err(Error::file(&path, "no rows")),
            None => Ok(()),
        }
    }

    fn tolerance(&self, table: &str, column: &str) -> Option<&Tolerance> {
        self.tolerances
            .iter()
            .find(|t| t.table == table && t.column == column)
    }

    /// The tolerances.
    #[must_use]
    pub fn tolerances(&self) -> &[Tolerance] {
        &self.tolerances
    }

    fn source(&self) -> String {
        format!("blessed {}: {}", self.blessing.date, self.blessing.reason)
    }

    fn compare(&self, record: &Record, folder: &Path) -> Result<Vec<Verdict>, Error> {
        let mut verdicts = self.compare_metrics(record);
        let series = Table::read(&folder.join(SERIES))?;
        verdicts.extend(self.compare_series(&series));
        verdicts.extend(self.compare_work(record));
        verdicts.push(self.compare_picture(record)?);
        Ok(verdicts)
    }

    fn compare_metrics(&self, record: &Record) -> Vec<Verdict> {
        let now = metrics_of(record);
        let mut verdicts: Vec<Verdict> = self
            .metrics
            .iter()
            .map(|(column, values)| match now.get(column) {
                None => mismatch(column, "the run has no such metric".to_owned()),
                Some(found) => self.verdict("metrics", column, column, found[0], values[0]),
            })
            .collect();
        for (column, _) in now.iter() {
            if self.metrics.get(column).is_none() {
                verdicts.push(mismatch(column, "the golden has no such metric".to_owned()));
            }
        }
        verdicts
    }

    /// A verdict for each column of the series that drifts; if none does, for the nearest to it.
    fn compare_series(&self, series: &Table) -> Vec<Verdict> {
        let Some((key, times)) = self.series.iter().next() else {
            return Vec::new();
        };
        let now = match series.at(times) {
            Ok(rows) => rows,
            Err(time) => {
                let why = format!("the run's series has no row at {key} = {time}");
                return vec![mismatch("series", why)];
            }
        };
        let mut verdicts = Vec::new();
        for (column, values) in self.series.iter() {
            let label = format!("series {column}");
            let Some(found) = now.get(column) else {
                verdicts.push(mismatch(&label, "the run has no such column".to_owned()));
                continue;
            };
            let distance = |k: &usize| (found[*k] - values[*k]).abs();
            let worst = (0..values.len())
                .max_by(|a, b| distance(a).total_cmp(&distance(b)))
                .unwrap_or(0);
            let mut verdict = self.verdict("series", column, &label, found[worst], values[worst]);
            verdict.source = format!("at {key} = {}; {}", times[worst], verdict.source);
            verdicts.push(verdict);
        }
        for (column, _) in now.iter() {
            if self.series.get(column).is_none() {
                let why = "the golden has no such column".to_owned();
                verdicts.push(mismatch(&format!("series {column}"), why));
            }
        }
        if verdicts.iter().any(Verdict::drifts) {
            verdicts.retain(Verdict::drifts);
        } else {
            let nearest = verdicts
                .into_iter()
                .max_by(|a, b| share_used(a).total_cmp(&share_used(b)));
            verdicts = nearest.into_iter().collect();
        }
        verdicts
    }

    /// A verdict for each count of work that has changed; if none has, for the particle–node pairs.
    fn compare_work(&self, record: &Record) -> Vec<Verdict> {
        let counts = record.work.counts().into_iter().zip(self.work.counts());
        let mut verdicts: Vec<Verdict> = counts
            .map(|((name, now), (_, before))| {
                self.of_numbers(&format!("{COUNT}{name}"), now as f64, before as f64, 0.0)
            })
            .collect();
        let drifts = verdicts.iter().any(Verdict::drifts);
        verdicts.retain(|v| v.drifts() || (!drifts && v.metric.ends_with(PAIRS)));
        verdicts
    }

    /// Whether the picture of the golden's own numbers is drawn as it was.
    fn compare_picture(&self, record: &Record) -> Result<Verdict, Error> {
        let drawn = draw_watched(&record.case, &self.series)?;
        let different = different_pixels(&self.picture, &drawn);
        Ok(self.of_numbers(PIXELS, different as f64, 0.0, 0.0))
    }

    fn verdict(
        &self,
        table: &str,
        column: &str,
        label: &str,
        value: f64,
        reference: f64,
    ) -> Verdict {
        let tolerance = self.tolerance(table, column).map_or(0.0, |t| t.tolerance);
        self.of_numbers(label, value, reference, tolerance)
    }

    fn of_numbers(&self, label: &str, value: f64, reference: f64, tolerance: f64) -> Verdict {
        let close = Verdict::close(CHECK, label, value, reference, tolerance, self.source());
        Verdict {
            kind: Kind::Drift,
            ..close
        }
    }

    /// The golden of a run whose outputs lie in `folder` and those of its perturbed twin in `twin`.
    ///
    /// # Errors
    /// The runs' files can't be read, or a metric of one is missing in the other.
    pub fn of_run(
        record: &Record,
        folder: &Path,
        twin: &Record,
        twin_folder: &Path,
        reason: &str,
    ) -> Result<Self, Error> {
        let metrics = metrics_of(record);
        let series = Table::read_finite(&folder.join(SERIES))?;
        let twin_series = Table::read_finite(&twin_folder.join(SERIES))?;
        let times = series.iter().next().map_or(&[][..], |(_, times)| times);
        let step = times.len().div_ceil(ROWS).max(1);
        let sampled = times.iter().skip(step - 1).step_by(step).copied();
        // A twin may come to rest an observation sooner and then lacks the last row.
        let mut kept: Vec<f64> = sampled.collect();
        if kept.last().is_some_and(|t| twin_series.at(&[*t]).is_err()) {
            kept.pop();
        }
        let missing = |t: f64| Error::file(folder, format!("no row at time {t}"));
        let series = series.at(&kept).map_err(missing)?;
        let twin_series = twin_series.at(&kept).map_err(missing)?;
        let mut tolerances = responses("metrics", &metrics, &metrics_of(twin), folder)?;
        tolerances.extend(responses("series", &series, &twin_series, folder)?);
        Ok(Self {
            picture: draw_watched(&record.case, &series)?,
            metrics,
            series,
            tolerances,
            work: record.work,
            blessing: Blessing::now(record, reason),
        })
    }

    /// The same numbers with the picture as it is drawn and the work as it is done now.
    ///
    /// # Errors
    /// The picture can't be drawn.
    pub fn renewed(&self, record: &Record, reason: &str) -> Result<Self, Error> {
        Ok(Self {
            picture: draw_watched(&record.case, &self.series)?,
            work: record.work,
            blessing: Blessing {
                redrawn: Some([today(), reason.to_owned()]),
                ..self.blessing.clone()
            },
            ..self.clone()
        })
    }

    /// Writes the golden into its folder, whole: the old one stays until the new one is complete.
    ///
    /// # Errors
    /// A file can't be written.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        let parent = folder.parent().unwrap_or(Path::new("."));
        make_folder(parent)?;
        let draft = tempfile::tempdir_in(parent).map_err(|e| Error::file(parent, e))?;
        let at = |name: &str| draft.path().join(name);
        self.metrics.write(&at(METRICS))?;
        self.series.write(&at(SERIES))?;
        write_json(&at(BLESSING), &self.blessing)?;
        write_whole(&at(PICTURE), &small_png(&self.picture, &at(PICTURE))?)?;
        write_rows(&at(TOLERANCES), &self.tolerances)?;
        write_rows(&at(WORK), &[self.work])?;
        let failed = |e: std::io::Error| Error::file(folder, e);
        let old = tempfile::tempdir_in(parent).map_err(failed)?;
        if folder.exists() {
            fs::rename(folder, old.path().join("golden")).map_err(failed)?;
        }
        let draft = draft.keep();
        readable(&draft)?;
        fs::rename(&draft, folder).map_err(failed)
    }

    /// The picture that was blessed, and that of a run's series drawn at the same times.
    ///
    /// # Errors
    /// The series can't be read or has no such rows.
    pub fn pictures(&self, record: &Record, folder: &Path) -> Result<(RgbImage, RgbImage), Error> {
        let path = folder.join(SERIES);
        let times = self.series.iter().next().map_or(&[][..], |(_, t)| t);
        let now = Table::read(&path)?
            .at(times)
            .map_err(|t| Error::file(&path, format!("no row at time {t}")))?;
        Ok((self.picture.clone(), draw_watched(&record.case, &now)?))
    }
}

impl Blessing {
    fn now(record: &Record, reason: &str) -> Self {
        Self {
            schema: SCHEMA,
            date: today(),
            reason: reason.to_owned(),
            redrawn: None,
            version: record.version.clone(),
            machine: format!("{} {}", record.machine.os, record.machine.arch),
        }
    }
}

/// The date (UTC), as YYYY-MM-DD.
fn today() -> String {
    let now = jiff::Timestamp::now().to_string();
    now.chars().take("2026-01-01".len()).collect()
}

/// How much of its tolerance a verdict uses.
fn share_used(verdict: &Verdict) -> f64 {
    match (verdict.value, verdict.reference, verdict.tolerance) {
        (Some(value), Some(reference), Some(tolerance)) if tolerance > 0.0 => {
            (value - reference).abs() / tolerance
        }
        _ => 0.0,
    }
}

/// The tolerance of every column, from the response to the perturbation.
fn responses(
    name: &str,
    table: &Table,
    twin: &Table,
    folder: &Path,
) -> Result<Vec<Tolerance>, Error> {
    table
        .iter()
        .map(|(column, values)| {
            let others = twin.get(column).ok_or_else(|| {
                let cause = format!("{name} {column} is missing in the perturbed twin");
                Error::file(folder, cause)
            })?;
            let pairs = values.iter().zip(others);
            let response = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            Ok(Tolerance {
                table: name.to_owned(),
                column: column.to_owned(),
                rows: values.len(),
                tolerance: MARGIN * response,
                response,
            })
        })
        .collect()
}

/// Writes a table with a column for each field.
fn write_rows<T: Serialize>(path: &Path, rows: &[T]) -> Result<(), Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).map_err(|e| Error::file(path, e))?;
    }
    let bytes = writer.into_inner().map_err(|e| Error::file(path, e))?;
    write_whole(path, &bytes)
}

/// A PNG file as small as it gets: goldens are kept for ever.
fn small_png(picture: &RgbImage, path: &Path) -> Result<Vec<u8>, Error> {
    use image::codecs::png::{CompressionType, FilterType, PngEncoder};
    let mut bytes = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    picture
        .write_with_encoder(encoder)
        .map_err(|e| Error::file(path, e))?;
    Ok(bytes)
}

/// A temporary folder is its owner's alone; one that stays is not.
fn readable(folder: &Path) -> Result<(), Error> {
    #[cfg(unix)]
    fs::set_permissions(folder, std::os::unix::fs::PermissionsExt::from_mode(0o755))
        .map_err(|e| Error::file(folder, e))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::record;

    #[test]
    fn goldens_are_kept_of_runs_of_their_tier_that_are_not_too_long() {
        let case = cases::find("cook").unwrap();
        let mut run = record("h1", Vec::new());
        assert_eq!(why_none(case, &run), None);
        run.work.particle_steps = MOST_STEPS + 1;
        assert!(why_none(case, &run).unwrap().contains("particle steps"));
        run.work.particle_steps = MOST_STEPS;
        run.set = vec!["load=2".to_owned()];
        assert!(why_none(case, &run).unwrap().contains("tier nightly"));
        let verdicts = compare(Path::new("no goldens"), &run, Path::new("")).unwrap();
        assert!(verdicts[0].kind == Kind::Drift && verdicts[0].holds().is_none());
    }
}
