//! Trends over nights: errors, orders and cost, kept in a table beside the report.

use super::Picture;
use super::plot::{Chart, Scale};
use super::style::{Panel, Panels};
use crate::convergence::Convergence;
use crate::error::Error;
use crate::files::write_whole;
use crate::scheme::Scheme;
use crate::study::{CaseStudy, Summary};
use jiff::civil::Date;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const FILE: &str = "history.csv";
/// How the pictures' names begin.
pub(super) const TRENDS: &str = "trends-";
const COST: &str = "cpu_s";
const PAIRS: &str = "particle_node_pairs";
const ORDER: &str = "order of ";

/// A night and the commit that ran.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Night {
    date: Date,
    commit: String,
}

impl Night {
    /// From a date of the form YYYY-MM-DD and a commit.
    ///
    /// # Errors
    /// The date is not of that form, or the commit is empty.
    pub fn new(date: &str, commit: &str) -> Result<Self, Error> {
        let refuse = |what: String| Err(Error::Input(what));
        match date.parse() {
            Err(e) => refuse(format!("--night \"{date}\": {e}; allowed: YYYY-MM-DD")),
            Ok(_) if commit.trim().is_empty() => refuse("--commit is empty".to_owned()),
            Ok(date) => Ok(Self {
                date,
                commit: commit.to_owned(),
            }),
        }
    }
}

/// A number of a night.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Row {
    night: Date,
    commit: String,
    case: String,
    /// Scheme with level, or scheme alone for an order.
    run: String,
    quantity: String,
    value: f64,
}

impl Row {
    fn scheme(&self) -> Result<Scheme, Error> {
        Scheme::parse(self.run.split('/').next().unwrap_or_default())
    }
}

/// Adds a night to the history in `out` (replacing it if it is there already) and draws the trends of
/// every case.
///
/// # Errors
/// The history is damaged, or a file can't be written.
pub(super) fn add(summary: &Summary, night: &Night, out: &Path) -> Result<Vec<Picture>, Error> {
    let path = out.join(FILE);
    let mut rows = read(&path)?;
    let told = |row: &Row| summary.cases.iter().any(|s| s.case == row.case);
    rows.retain(|row| row.night != night.date || !told(row));
    for study in &summary.cases {
        rows.extend(rows_of(study, night));
    }
    rows.sort_by_key(|row| row.night);
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in &rows {
        writer.serialize(row).map_err(|e| Error::file(&path, e))?;
    }
    let bytes = writer.into_inner().map_err(|e| Error::file(&path, e))?;
    write_whole(&path, &bytes)?;
    let mut pictures = Vec::new();
    for study in &summary.cases {
        pictures.extend(draw(study, &rows, out)?);
    }
    Ok(pictures)
}

fn read(path: &Path) -> Result<Vec<Row>, Error> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let mut reader = csv::Reader::from_path(path).map_err(|e| Error::file(path, e))?;
    let rows = reader.deserialize::<Row>();
    rows.map(|row| row.map_err(|e| Error::file(path, e)))
        .collect()
}

fn rows_of(study: &CaseStudy, night: &Night) -> Vec<Row> {
    let row = |run: String, quantity: String, value: f64| Row {
        night: night.date,
        commit: night.commit.clone(),
        case: study.case.clone(),
        run,
        quantity,
        value,
    };
    let mut rows = Vec::new();
    // Trends are of the case's own parameters.
    let own = |c: &&Convergence| c.is_error && c.set.is_empty();
    for entry in study.convergence.iter().filter(own) {
        let finest = entry.points.last();
        rows.extend(finest.map(|p| {
            let run = format!("{}/{}", entry.scheme, p.level);
            row(run, entry.metric.clone(), p.value.abs())
        }));
        rows.extend(entry.order.iter().map(|order| {
            let quantity = format!("{ORDER}{}", entry.metric);
            row(entry.scheme.to_string(), quantity, order.order)
        }));
    }
    let mut cost: BTreeMap<Scheme, (f64, u64)> = BTreeMap::new();
    for record in &study.records {
        let (seconds, pairs) = cost.entry(record.scheme()).or_default();
        *seconds += record.time.cpu_s;
        *pairs += record.work.particle_node_pairs;
    }
    for (scheme, (seconds, pairs)) in cost {
        rows.push(row(scheme.to_string(), COST.to_owned(), seconds));
        rows.push(row(scheme.to_string(), PAIRS.to_owned(), pairs as f64));
    }
    rows
}

/// What is watched of a quantity: how it is labelled and scaled.
fn axis(quantity: &str) -> (String, Scale) {
    match quantity {
        COST => ("CPU time of all runs (s)".to_owned(), Scale::Log10),
        PAIRS => ("particle–node pairs".to_owned(), Scale::Log10),
        q if q.starts_with(ORDER) => (q.to_owned(), Scale::Linear),
        q => (format!("|{q}|, finest level"), Scale::Log10),
    }
}

/// The errors at the finest level, the orders and the cost of a case, scheme by scheme.
fn draw(study: &CaseStudy, rows: &[Row], out: &Path) -> Result<Option<Picture>, Error> {
    let own: Vec<&Row> = rows.iter().filter(|r| r.case == study.case).collect();
    let Some(first) = own.first().map(|r| r.night) else {
        return Ok(None);
    };
    let mut quantities: Vec<&str> = Vec::new();
    let mut points = Vec::new();
    for row in &own {
        if !quantities.contains(&row.quantity.as_str()) {
            quantities.push(&row.quantity);
        }
        points.push((row.scheme()?, *row));
    }
    quantities.sort_by_key(|q| ([COST, PAIRS].contains(q), q.starts_with(ORDER)));
    let chart = |quantity: &&str, panel: &Panel| {
        let (y_label, y_scale) = axis(quantity);
        let series = panel.curves(|scheme| {
            let of_curve = points
                .iter()
                .filter(|(s, r)| *s == scheme && r.quantity == *quantity);
            of_curve
                // An error of zero has no logarithm.
                .filter(|(_, r)| y_scale == Scale::Linear || r.value > 0.0)
                .map(|(_, r)| (f64::from((r.night - first).get_days()), r.value))
                .collect()
        });
        Chart {
            title: panel.title.clone(),
            x_label: format!("days since {first}"),
            y_label,
            x_scale: Scale::Linear,
            y_scale,
            series,
            reference_lines: Vec::new(),
            slope_triangle: None,
            x_range: None,
            y_range: None,
        }
    };
    let schemes: BTreeSet<Scheme> = points.iter().map(|(scheme, _)| *scheme).collect();
    let file = format!("{TRENDS}{}.png", study.case);
    let drawn = Panels::new(&schemes).draw(&out.join(&file), quantities, chart)?;
    Ok(drawn.then(|| Picture {
        file,
        caption: format!(
            "{}: errors, orders and cost, night by night (data: {FILE}).",
            study.case
        ),
    }))
}
