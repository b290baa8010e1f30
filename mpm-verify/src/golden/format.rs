//! The file of a case's goldens.

use super::{BLUNT, FLOOR, MARGIN};
use crate::error::{Error, is_unfit};
use crate::files::{OTHER_LAYOUT, read_text, write_whole};
use crate::record::Record;
use std::collections::BTreeSet;
use std::path::Path;

/// Version of the format.
const FORMAT: u32 = 2;
const HEADER: [&str; 5] = ["run", "quantity", "time", "value", "response"];
/// Blessings that a file tells of, the last ones.
const BLESSINGS: usize = 5;
/// Largest response of a count, and the same over the count: more than a few rows, sorts or iterations say nothing.
const LOOSE: f64 = 10.0;
const LOOSE_SHARE: f64 = 0.1;
/// Most curves of a picture.
const SHOWN: usize = 6;
/// What stands before the name of a column of the series, and of a count of work.
pub(super) const SERIES: &str = "series/";
pub(super) const WORK: &str = "work/";

/// A golden number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Time of its row in the series (s).
    pub time: Option<f64>,
    /// Value, in the unit of its quantity.
    pub value: f64,
    /// What the perturbed twin differed by, at most until then.
    pub response: f64,
}

/// The golden numbers of one quantity of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// `metric/NAME (UNIT)`, `series/NAME (UNIT)` or `work/NAME`.
    pub quantity: String,
    /// A row of a series each; of a metric or count one without a time.
    pub points: Vec<Point>,
}

impl Column {
    /// The largest of its numbers.
    #[must_use]
    pub fn scale(&self) -> f64 {
        let sizes = self.points.iter().map(|p| p.value.abs());
        sizes.fold(0.0, f64::max)
    }

    /// Whether it counts work.
    #[must_use]
    pub fn is_count(&self) -> bool {
        self.quantity.starts_with(WORK)
    }

    /// Largest admissible difference from a point.
    #[must_use]
    pub fn tolerance(&self, point: &Point) -> f64 {
        match self.is_count() {
            true => MARGIN * point.response,
            // Above ten times any response that is allowed.
            false => FLOOR * self.scale(),
        }
    }

    /// Whether a number answers rounding so strongly that another order of sums would pass for drift.
    #[must_use]
    pub fn is_blunt(&self) -> bool {
        !self.is_count() && self.response() > BLUNT * self.scale()
    }

    /// The largest response that a count may have, if it answers rounding more strongly: then it says nothing.
    pub(super) fn is_loose(&self) -> Option<f64> {
        let most = f64::max(LOOSE, LOOSE_SHARE * self.scale());
        (self.is_count() && self.response() > most).then_some(most)
    }

    /// The largest response of its numbers.
    #[must_use]
    pub fn response(&self) -> f64 {
        self.points.iter().map(|p| p.response).fold(0.0, f64::max)
    }
}

/// The golden numbers of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Its folder below that of its case.
    pub name: String,
    /// Its quantities.
    pub columns: Vec<Column>,
}

impl Run {
    /// Whether a watched column is among its quantities, so that there is something to draw.
    #[must_use]
    pub fn has_series(&self) -> bool {
        self.columns.iter().any(|c| c.quantity.starts_with(SERIES))
    }
}

/// The goldens of a case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Golden {
    /// When, why and by which program the file was blessed, the last time at the end.
    pub blessings: Vec<String>,
    /// Runs, in the order of the plan.
    pub runs: Vec<Run>,
}

impl Golden {
    /// Reads a file of goldens.
    ///
    /// # Errors
    /// It is missing, not UTF-8, of another format, cut, without a blessing; or a cell is not a finite number, a
    /// quantity is there twice, or a response is larger than that of a golden.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = read_text(path)?;
        let golden = Self::parse(&text).map_err(|cause| Error::file(path, cause))?;
        match golden.text() {
            Ok(own) if own == text.as_bytes() => Ok(golden),
            _ => Err(Error::file(path, OTHER_LAYOUT)),
        }
    }

    fn parse(text: &str) -> Result<Self, String> {
        if text.chars().any(|c| c != '\n' && is_unfit(c)) {
            return Err("control characters".to_owned());
        }
        let mut remarks = text.lines().map_while(|line| line.strip_prefix("# "));
        let first = remarks.next().unwrap_or_default();
        let head = first.strip_prefix("format ").and_then(|rest| {
            let (format, rows) = rest.split_once(", ")?;
            let rows: usize = rows.strip_suffix(" rows")?.parse().ok()?;
            Some((format, rows))
        });
        let (format, rows) = head.ok_or("no line \"# format F, N rows\"")?;
        if format != FORMAT.to_string() {
            return Err(format!("format {format} where {FORMAT} is expected"));
        }
        let mut golden = Self {
            blessings: remarks.map(str::to_owned).collect(),
            runs: Vec::new(),
        };
        if golden.blessings.is_empty() {
            return Err("no line of a blessing".to_owned());
        }
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let header = reader.headers().map_err(|e| e.to_string())?;
        if *header != HEADER[..] {
            return Err(format!("columns other than {}", HEADER.join(", ")));
        }
        let mut found = 0;
        for record in reader.records() {
            let record = record.map_err(|e| e.to_string())?;
            found += 1;
            let cells: Vec<&str> = record.iter().collect();
            let [run, quantity, time, value, response] = cells[..] else {
                return Err(format!("row {found}: not {} cells", HEADER.len()));
            };
            let above = golden
                .runs
                .last()
                .and_then(|r| Some((r, r.columns.last()?)));
            let (run, quantity) = match (run, quantity, above) {
                ("", "", Some((r, c))) => (r.name.clone(), c.quantity.clone()),
                ("", quantity, Some((r, _))) => (r.name.clone(), quantity.to_owned()),
                ("", _, None) => return Err(format!("row {found}: no run")),
                (run, quantity, _) => (run.to_owned(), quantity.to_owned()),
            };
            let number = |text: &str| match text.parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(number),
                _ => Err(format!("{run} {quantity}, row {found}: {text}")),
            };
            golden.add(
                &run,
                &quantity,
                Point {
                    time: (!time.is_empty()).then(|| number(time)).transpose()?,
                    value: number(value)?,
                    response: number(response)?,
                },
            );
        }
        if found != rows {
            return Err(format!("{found} rows where {rows} are expected"));
        }
        golden.check()?;
        Ok(golden)
    }

    /// Adds a row to the last quantity of the last run, or begins new ones.
    fn add(&mut self, run: &str, quantity: &str, point: Point) {
        let same_run = self.runs.pop_if(|r| r.name == run);
        let mut last = same_run.unwrap_or_else(|| Run {
            name: run.to_owned(),
            columns: Vec::new(),
        });
        match last.columns.last_mut() {
            Some(column) if column.quantity == quantity && point.time.is_some() => {
                column.points.push(point);
            }
            _ => last.columns.push(Column {
                quantity: quantity.to_owned(),
                points: vec![point],
            }),
        }
        self.runs.push(last);
    }

    /// What must hold of a file that was read.
    fn check(&self) -> Result<(), String> {
        let mut seen = BTreeSet::new();
        for (run, column) in self.columns() {
            let name = format!("{run} {}", column.quantity);
            let rises = |p: &[Point]| p[0].time < p[1].time && p[0].response <= p[1].response;
            if !seen.insert(name.clone()) || !column.points.windows(2).all(rises) {
                return Err(format!("{name} is there twice or not in order"));
            }
            if let Some(most) = column.is_loose() {
                return Err(format!("{name}: a count responds by 0 to {most}"));
            }
            if column.is_blunt() || column.points.iter().any(|p| p.response < 0.0) {
                let scale = column.scale();
                return Err(format!(
                    "{name}: a golden responds by 0 to {BLUNT:.0e} of its scale, {scale:e}"
                ));
            }
        }
        Ok(())
    }

    fn columns(&self) -> impl Iterator<Item = (&str, &Column)> {
        let runs = self.runs.iter();
        runs.flat_map(|run| run.columns.iter().map(move |c| (&*run.name, c)))
    }

    /// The goldens of a run.
    #[must_use]
    pub fn run(&self, name: &str) -> Option<&Run> {
        self.runs.iter().find(|run| run.name == name)
    }

    /// Those that the picture of the case shows: a run of each of the first schemes that have a series, with the level and
    /// parameters that most of them have.
    #[must_use]
    pub fn shown(&self) -> Vec<Run> {
        let all = || self.runs.iter().filter(|run| run.has_series());
        let setting = |run: &Run| {
            run.name
                .split_once('/')
                .map(|(_, setting)| setting.to_owned())
        };
        let count = |run: &&Run| all().filter(|r| setting(r) == setting(run)).count();
        // Of as many, the first.
        let most = all().rev().max_by_key(count).and_then(setting);
        let own = all().filter(|run| setting(run) == most);
        own.take(SHOWN).cloned().collect()
    }

    /// Puts runs in place of those of the same name and keeps the others that are among `planned`, in its order.
    pub fn bless(&mut self, new: Vec<Run>, planned: &[String], record: &Record, reason: &str) {
        self.runs
            .retain(|old| new.iter().all(|r| r.name != old.name));
        self.runs.extend(new);
        self.runs.retain(|run| planned.contains(&run.name));
        let place = |run: &Run| planned.iter().position(|name| *name == run.name);
        self.runs.sort_by_key(place);
        let now = jiff::Timestamp::now().to_string();
        let words: Vec<&str> = reason.split_whitespace().collect();
        self.blessings.push(format!(
            "{}: {} (source {}, {} {})",
            &now[..now.len().min("2026-01-01".len())],
            words.join(" "),
            record.version.source,
            record.machine.os,
            record.machine.arch
        ));
        let surplus = self.blessings.len().saturating_sub(BLESSINGS);
        self.blessings.drain(..surplus);
    }

    /// The file. A run and a quantity stand in their first row alone.
    fn text(&self) -> csv::Result<Vec<u8>> {
        let rows = self.columns().map(|(_, c)| c.points.len()).sum::<usize>();
        let mut text = format!("# format {FORMAT}, {rows} rows\n");
        for blessing in &self.blessings {
            text.push_str(&format!("# {blessing}\n"));
        }
        let mut writer = csv::Writer::from_writer(text.into_bytes());
        writer.write_record(HEADER)?;
        for run in &self.runs {
            let mut name = &*run.name;
            for column in &run.columns {
                let mut quantity = &*column.quantity;
                for point in &column.points {
                    let time = point.time.map(written).unwrap_or_default();
                    let [value, response] = [point.value, point.response].map(written);
                    writer.write_record([name, quantity, &time, &value, &response])?;
                    (name, quantity) = ("", "");
                }
            }
        }
        writer.into_inner().map_err(|e| e.into_error().into())
    }

    /// Writes the file, whole.
    ///
    /// # Errors
    /// It can't be written.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let text = self.text().map_err(|e| Error::file(path, e))?;
        write_whole(path, &text)
    }
}

/// A number as short as it reads back.
fn written(number: f64) -> String {
    let text = format!("{number:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

#[cfg(test)]
mod tests;
