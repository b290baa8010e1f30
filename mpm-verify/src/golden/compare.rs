//! Drift of a run from its golden.

use super::picture::{curves, judged};
use super::*;
use crate::draw::write_small_png;
use std::collections::BTreeMap;

/// Largest distance of a row's time from that of its golden, over the latest time of the series.
const SAME_TIME: f64 = 1e-9;

/// The goldens of all cases.
pub struct Goldens {
    root: PathBuf,
    cases: BTreeMap<&'static str, Result<Golden, String>>,
}

impl Goldens {
    /// Reads the goldens below `root`.
    ///
    /// # Errors
    /// There is no such folder. A file that is missing or damaged is drift of its case.
    pub fn open(root: &Path) -> Result<Self, Error> {
        if !root.is_dir() {
            return Err(Error::file(root, "no folder of goldens: name one with --golden"));
        }
        let read = |name| match file(root, name) {
            path if path.exists() => Golden::read(&path).map_err(|e| e.to_string()),
            _ => Ok(Golden::default()),
        };
        let names = cases::all().iter().map(|case| case.name);
        Ok(Self { root: root.to_path_buf(), cases: names.map(|name| (name, read(name))).collect() })
    }

    /// Puts runs of one case in the place of what is kept of them, and draws its pictures anew. Other runs of the plan
    /// stay; where the file was damaged nothing does. Each run comes with its record and the folder of its outputs.
    ///
    /// # Errors
    /// The case is not known, or a file can't be read or written.
    pub fn bless(&self, new: Vec<(Run, &Record, &Path)>, reason: &str) -> Result<(), Error> {
        let Some((_, first, _)) = new.first() else { return Ok(()) };
        let case = cases::find(&first.case)?;
        let planned = runs(case);
        let mut golden = match self.cases.get(case.name) {
            Some(Ok(golden)) => golden.clone(),
            _ => Golden::default(),
        };
        let has_field = |(run, ..): &&(Run, _, _)| planned.first() == Some(&run.name);
        if let Some(((_, record, folder), view)) = new.iter().find(has_field).zip(case.field) {
            field::bless(&field::files(&self.root, case.name), &view, record, folder)?;
        }
        golden.bless(new.iter().map(|(run, ..)| run.clone()).collect(), &planned, first, reason);
        let shown = golden.shown();
        let is_shown = |(new, ..): &&(Run, _, _)| shown.iter().any(|run| run.name == new.name);
        if let Some((.., folder)) = new.iter().find(is_shown) {
            let picture = curves(&shown, Table::read(&folder.join(series::FILE))?.abscissa())?;
            write_small_png(&picture_file(&self.root, case.name), &picture)?;
        }
        golden.write(&file(&self.root, case.name))
    }

    /// The golden of a run, if there is one.
    pub(crate) fn kept(&self, record: &Record) -> Option<&Run> {
        self.find(record).ok().map(|(run, _)| run)
    }

    /// The golden of a run, and the last line of its file's blessings; or the reason for its absence.
    fn find(&self, record: &Record) -> Result<(&Run, &str), &str> {
        let golden = self.cases.get(&*record.case).ok_or("no such case")?;
        let golden = golden.as_ref().map_err(String::as_str)?;
        let run = golden.run(&record.folder());
        let run = run.ok_or("new: not yet blessed")?;
        Ok((run, golden.blessings.last().map_or("", String::as_str)))
    }

    /// Verdicts on the drift of a run whose outputs lie in `folder`.
    ///
    /// # Errors
    /// The case is not known, the run's series can't be read, or a picture can't be drawn.
    pub fn compare(&self, record: &Record, folder: &Path) -> Result<Vec<Verdict>, Error> {
        if record.broke_down() {
            return Ok(vec![mismatch("run", "the run broke down: nothing to compare")]);
        }
        let case = cases::find(&record.case)?;
        if let Some(why) = why_none(case, record) {
            return Ok(vec![of_drift(Finding::not_applicable("run", why))]);
        }
        let (golden, blessing) = match self.find(record) {
            Ok(found) => found,
            Err(why) => return Ok(vec![mismatch("run", why)]),
        };
        let now = Now::read(record, folder)?;
        let mut verdicts: Vec<Verdict> = golden.columns.iter().map(|c| now.judge(c, blessing)).collect();
        verdicts.extend(self.judge_picture(&now, blessing));
        if let Some(view) = case.field
            && runs(case).first() == Some(&record.folder())
        {
            verdicts.extend(field::judge(&field::files(&self.root, case.name), &view, record, folder, blessing)?);
        }
        Ok(verdicts)
    }

    /// Verdict on the picture of a case, for the first run it shows: whether the picture drawn from the blessed
    /// columns, and from this run's columns without drift, is the kept one.
    fn judge_picture(&self, now: &Now<'_>, blessing: &str) -> Option<Verdict> {
        let mut shown = self.cases.get(&*now.record.case)?.as_ref().ok()?.shown();
        let first = shown.first_mut()?;
        if first.name != now.record.folder() {
            return None;
        }
        *first = now.snapped(first);
        let path = picture_file(&self.root, &now.record.case);
        Some(judged("different pixels of the picture", &path, curves(&shown, now.series.abscissa()), blessing))
    }

    /// The watched columns of a run as they were blessed, and as they are.
    ///
    /// # Errors
    /// The run has no golden or no series, or a picture can't be drawn.
    pub fn pictures(&self, record: &Record, folder: &Path) -> Result<[RgbImage; 2], Error> {
        let (golden, _) = self.find(record).map_err(|why| Error::file(&self.root, why))?;
        let now = Now::read(record, folder)?;
        let [old, new] = [golden.clone(), now.snapped(golden)].map(|run| curves(&[run], now.series.abscissa()));
        Ok([old?, new?])
    }
}

/// Present values of a run.
struct Now<'a> {
    record: &'a Record,
    series: Table,
}

impl<'a> Now<'a> {
    fn read(record: &'a Record, folder: &Path) -> Result<Self, Error> {
        Ok(Self { record, series: Table::read(&folder.join(series::FILE))? })
    }

    /// The number that stands in the place of a golden one.
    fn find(&self, quantity: &str, point: &Point) -> Option<f64> {
        let (kind, name) = quantity.split_once('/')?;
        match kind {
            "metric" => {
                let mut metrics = self.record.metrics.iter();
                let (_, found) = metrics.find(|(n, m)| format!("{n} ({})", m.unit) == name)?;
                found.value
            }
            "work" => {
                let mut counts = self.record.work.counts().into_iter();
                Some(counts.find(|(n, _)| *n == name)?.1 as f64)
            }
            _ => {
                let ((_, times), time) = (self.series.iter().next()?, point.time?);
                let latest = times.last().map_or(0.0, |t| t.abs());
                let near = |t: &f64| (t - time).abs() <= SAME_TIME * latest;
                Some(self.series.get(name)?[times.iter().position(near)?])
            }
        }
    }

    /// The verdict on the point of a column that has moved most: all of a column have one tolerance.
    fn judge(&self, column: &Column, blessing: &str) -> Verdict {
        let label = match column.quantity.split_once('/') {
            Some(("series", name)) => format!("series {name}"),
            Some(("work", name)) => format!("count of {name}"),
            Some((_, name)) => name.to_owned(),
            None => column.quantity.clone(),
        };
        let mut worst = (f64::NEG_INFINITY, mismatch(&label, "the golden has no number"));
        for point in &column.points {
            let place = point.time.map_or(String::new(), |t| format!("at time {t}; "));
            let Some(value) = self.find(&column.quantity, point) else {
                return mismatch(&label, &format!("{place}the run has no such number"));
            };
            let tolerance = column.tolerance(point);
            let difference = (value - point.value).abs();
            // What is not a number exceeds everything.
            if worst.0.total_cmp(&difference).is_lt() {
                let source = format!("{place}blessed {blessing}");
                worst = (difference, of_drift(Finding::within(&*label, value, point.value, tolerance, source)));
            }
        }
        worst.1
    }

    /// The run as its golden has it, with the present number wherever it has drifted.
    fn snapped(&self, golden: &Run) -> Run {
        let mut run = golden.clone();
        for (column, kept) in run.columns.iter_mut().zip(&golden.columns) {
            for (point, old) in column.points.iter_mut().zip(&kept.points) {
                let now = self.find(&kept.quantity, old).unwrap_or(f64::NAN);
                let holds = (now - old.value).abs() <= kept.tolerance(old);
                point.value = if holds { old.value } else { now };
            }
        }
        run
    }
}
