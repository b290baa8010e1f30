//! Kept results: a row per run, from a record and back.

use super::prelude::*;
use crate::check::Finding;
use crate::files::{read_rows, rows_text};
use crate::record::{BREAKS_DOWN, Discretisation, Failure, Measured, Timing, Version, WorkDone};

/// File of the rows, from the root.
pub(super) const RESULTS: &str = "reports/nightly/results.csv";
/// How the status of a run that broke down begins; the time follows.
const BROKE: &str = "failed at ";
/// Separator between the time and the kind of an error.
const AFTER: &str = " s: ";

/// A run of a night.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) case: String,
    scheme: String,
    pub(super) level: String,
    /// Parameters changed from the case's own, `name=value`, apart by spaces.
    pub(super) set: String,
    /// Cell size (m).
    h: f64,
    /// `ok`, or when it broke down and of what.
    status: String,
    pub(super) right: usize,
    wrong_as_known: usize,
    not_judged: usize,
    pub(super) failed: usize,
    #[serde(default)]
    wanted_not_judged: usize,
    particles: u64,
    steps: u64,
    particle_node_pairs: u64,
    /// Processor time (s).
    cpu_s: f64,
    pub(super) night: Date,
    /// Fingerprint of the sources.
    pub(super) program: String,
    /// [`Row::metrics`] in a file.
    #[serde(rename = "metrics")]
    cells: String,
    /// Those that something cites, to six digits, in the units of the records.
    #[serde(skip)]
    pub(super) metrics: BTreeMap<String, f64>,
}

impl Row {
    pub(super) fn of(record: &Record, night: &Night, cited: &BTreeSet<&str>) -> Self {
        let judged = |v: &&Verdict| v.judges();
        let wanted = |v: &&Verdict| v.is_wanted() && v.outcome == Outcome::NotJudged;
        let count = |outcome| record.verdicts.iter().filter(judged).filter(|v| v.outcome == outcome).count();
        let mut names = cited.clone();
        names.extend(record.verdicts.iter().filter(judged).map(|v| &*v.metric));
        let metrics = names
            .into_iter()
            .map(|name| (name.to_owned(), six_digits(record.value(name))))
            .filter(|(_, value)| value.is_finite());
        let status = match (record.status, &record.error) {
            (Status::Ok, _) => "ok".to_owned(),
            (Status::Failed, Some(e)) => format!("{BROKE}{}{AFTER}{}", written(six_digits(e.time)), e.kind),
            (Status::Failed, None) => "failed".to_owned(),
        };
        Self {
            case: record.case.clone(),
            scheme: record.scheme().to_string(),
            level: record.level.clone(),
            set: record.set.join(" "),
            h: record.discretisation.h,
            status,
            right: count(Outcome::Right),
            wrong_as_known: count(Outcome::WrongAsKnown),
            not_judged: count(Outcome::NotJudged),
            failed: count(Outcome::Failed),
            wanted_not_judged: record.verdicts.iter().filter(wanted).count(),
            particles: record.work.particles,
            steps: record.work.steps,
            particle_node_pairs: record.work.particle_node_pairs,
            cpu_s: (1e3 * record.time.cpu_s).round() / 1e3,
            night: night.date,
            program: record.version.source.clone(),
            cells: String::new(),
            metrics: metrics.collect(),
        }
    }

    /// Its record, as far as it is kept: with counts and metrics that are shown, and a verdict of each outcome that it counts;
    /// `None` if the case no longer has such a run.
    pub(super) fn record(&self) -> Option<Record> {
        let case = cases::find(&self.case).ok()?;
        let scheme = Scheme::parse(&self.scheme).ok()?;
        let set: Vec<String> = self.set.split_whitespace().map(str::to_owned).collect();
        let parameters = Parameters::new(&case.parameters, &set).ok()?;
        let metrics = self.metrics.iter().filter_map(|(name, value)| {
            let unit = case.metrics.iter().find(|m| m.name == name)?.unit;
            Some((name.clone(), Measured::of(*value, unit)))
        });
        let broke = self.status.strip_prefix(BROKE);
        // Rows of former programs have no kind.
        let error = broke.map(|of| of.split_once(AFTER).unwrap_or((of, ""))).map(|(time, kind)| Failure {
            kind: kind.to_owned(),
            time: time.trim_end_matches(" s").parse().unwrap_or(f64::NAN),
            step: self.steps,
            particle: 0,
            value: None,
            message: self.status.clone(),
        });
        let discretisation = Discretisation { dim: 0, h: self.h, ppc: 0, dt: f64::NAN, wall: String::new() };
        let spec = RunSpec { scheme, level: case.levels[0], set, perturbed: false };
        Some(Record {
            level: self.level.clone(),
            status: if self.status == "ok" { Status::Ok } else { Status::Failed },
            error,
            metrics: metrics.collect(),
            verdicts: self.verdicts(),
            work: WorkDone {
                particles: self.particles,
                steps: self.steps,
                particle_node_pairs: self.particle_node_pairs,
                ..WorkDone::default()
            },
            time: Timing { wall_s: f64::NAN, cpu_s: self.cpu_s },
            version: Version { mpm_verify: String::new(), source: self.program.clone() },
            ..Record::blank(&self.case, &spec, &parameters, discretisation, 0)
        })
    }

    /// A verdict of each outcome that it counts. A known limit of a run that broke down is that it does: it has no
    /// other verdict.
    fn verdicts(&self) -> Vec<Verdict> {
        let known = if self.status == "ok" { "" } else { BREAKS_DOWN };
        let counts = [
            (self.right, Kind::Truth, "", Outcome::Right),
            (self.wrong_as_known, Kind::KnownLimit, known, Outcome::WrongAsKnown),
            (self.failed, Kind::Truth, "", Outcome::Failed),
            (self.wanted_not_judged, Kind::Wanted, "", Outcome::NotJudged),
        ];
        let verdict = |&(_, kind, check, outcome): &(usize, Kind, &str, Outcome)| {
            let blank = Finding::not_applicable("", "").verdict(check, kind);
            Verdict { outcome, ..blank }
        };
        counts.iter().filter(|(count, ..)| *count > 0).map(verdict).collect()
    }

    /// Key of the row.
    pub(super) fn run(&self) -> [&str; 4] {
        [&self.case, &self.scheme, &self.level, &self.set]
    }
}

/// A number to six significant digits.
fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A number as short as it can be written.
fn written(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// Names of the metrics of every case in the order in which its rows first have them. In a file only that row names a
/// metric, and those after it have its value at its place: names would be more than half of the file.
#[derive(Default)]
struct Names(BTreeMap<String, Vec<String>>);

impl Names {
    /// The cells of a row of `case`: `1;2;c=3` of `a=1;b=2;c=3`, if `a` and `b` have names already.
    fn cells(&mut self, case: &str, metrics: &BTreeMap<String, f64>) -> String {
        let names = self.0.entry(case.to_owned()).or_default();
        let cell = |name: &String| metrics.get(name).map_or(String::new(), |v| written(*v));
        let mut cells: Vec<String> = names.iter().map(cell).collect();
        for (name, value) in metrics {
            if !names.contains(name) {
                names.push(name.clone());
                cells.push(format!("{name}={}", written(*value)));
            }
        }
        cells.join(";").trim_end_matches(';').to_owned()
    }

    /// The metrics of a row; `None` if a value has no name or is no number.
    fn metrics(&mut self, case: &str, cells: &str) -> Option<BTreeMap<String, f64>> {
        let names = self.0.entry(case.to_owned()).or_default();
        let mut metrics = BTreeMap::new();
        for (place, cell) in cells.split(';').enumerate().filter(|(_, c)| !c.is_empty()) {
            let (name, value) = match cell.split_once('=') {
                Some((name, value)) => (name.to_owned(), value),
                None => (names.get(place)?.clone(), cell),
            };
            if !names.contains(&name) {
                names.push(name.clone());
            }
            metrics.insert(name, value.parse().ok()?);
        }
        Some(metrics)
    }
}

/// Reads rows; none if there is no file.
pub(super) fn read(path: &Path) -> Result<Vec<Row>, Error> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let mut names = Names::default();
    let rows = read_rows::<Row>(path)?.into_iter();
    rows.map(|mut row| {
        let cells = std::mem::take(&mut row.cells);
        let metrics = names
            .metrics(&row.case, &cells)
            .ok_or_else(|| Error::file(path, format!("{}: a metric without a name or number", row.run().join(" "))));
        row.metrics = metrics?;
        Ok(row)
    })
    .collect()
}

/// Rows as CSV.
pub(super) fn text(rows: &[Row]) -> Result<Vec<u8>, Error> {
    let mut names = Names::default();
    let row = |row: &Row| Row { cells: names.cells(&row.case, &row.metrics), ..row.clone() };
    rows_text(rows.iter().map(row)).map_err(|e| Error::Input(format!("rows: {e}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::{changed, record};

    #[test]
    fn numbers_have_six_digits() {
        let told = [1.0, -0.148_699_4, 2.340_791e-5, 1_234_567.0].map(|v| written(six_digits(v)));
        assert_eq!(told, ["1", "-0.148699", "2.34079e-5", "1234570"]);
    }

    #[test]
    fn a_file_names_a_metric_once_a_case() {
        let rows: [(&str, &[(&str, f64)]); 5] = [
            ("bar", &[("a", 1.0), ("c", 3.0)]),
            ("bar", &[("a", 4.0), ("b", 5.0), ("c", 6.5)]),
            ("bar", &[]),
            ("disc", &[("b", 7.0)]),
            ("bar", &[("b", 8.0)]),
        ];
        let rows = rows.map(|(case, metrics)| {
            let metrics = metrics.iter().map(|(name, value)| ((*name).to_owned(), *value));
            (case, metrics.collect::<BTreeMap<_, _>>())
        });
        let (mut out, mut back) = (Names::default(), Names::default());
        let cells = ["a=1;c=3", "4;6.5;b=5", "", "b=7", ";;8"];
        for ((case, metrics), cells) in rows.iter().zip(cells) {
            assert_eq!(out.cells(case, metrics), cells);
            assert_eq!(back.metrics(case, cells).as_ref(), Some(metrics));
        }
        assert_eq!(back.metrics("disc", "1;2"), None);
        assert_eq!(back.metrics("disc", "b=x"), None);
    }

    #[test]
    fn a_row_gives_back_what_it_keeps_of_a_record() {
        let mut run = record("h2", Vec::new());
        run.set = changed(&["cfl=0.2"]);
        run.break_down("off-grid", 1.5, "");
        run.metrics.insert("tip_ux".to_owned(), Measured::of(-0.25, "m"));
        let night = Night::new("2026-01-01", "commit").unwrap();
        let row = Row::of(&run, &night, &BTreeSet::from(["tip_ux"]));
        let again = row.record().unwrap();
        assert_eq!(again.folder(), run.folder());
        assert_eq!(again.metrics, run.metrics);
        assert_eq!(again.status, run.status);
        let error = again.error.as_ref().unwrap();
        assert_eq!((error.time, &*error.kind), (1.5, "off-grid"));
        let unknown = Row { set: "no_such=1".to_owned(), ..row };
        assert!(unknown.record().is_none());
    }
}
