//! `results.csv`: a row a run, which is kept of a night when its pictures and series are not.

use crate::cases;
use crate::error::Error;
use crate::files::write_whole;
use crate::record::{Record, Status};
use crate::study::summary::{CaseStudy, Summary};
use crate::verdict::{Kind, Outcome};
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::Path;

pub(super) const FILE: &str = "results.csv";

/// A run: what it was, how it ended, what judges it, what it cost, and the metrics that
/// anything cites, as `name=value;…` to six digits.
#[derive(Debug, Serialize)]
struct Row<'a> {
    case: &'a str,
    scheme: String,
    level: &'a str,
    set: String,
    /// Size of the cells (m).
    h: f64,
    status: Status,
    right: usize,
    wrong_as_known: usize,
    not_judged: usize,
    failed: usize,
    particles: u64,
    steps: u64,
    particle_node_pairs: u64,
    /// Time of the processor (s).
    cpu_s: String,
    night: String,
    /// Fingerprint of the program.
    program: &'a str,
    metrics: String,
}

/// Writes the rows of all runs of a report.
///
/// # Errors
/// The file can't be written.
pub(super) fn write(summary: &Summary, out: &Path) -> Result<(), Error> {
    let path = out.join(FILE);
    let mut writer = csv::Writer::from_writer(Vec::new());
    for study in &summary.cases {
        let night = study.night.as_ref();
        let night = night.map_or_else(String::new, |night| night.date.to_string());
        let cited = cited(study)?;
        for record in &study.records {
            let row = row(record, &night, &cited);
            writer.serialize(row).map_err(|e| Error::file(&path, e))?;
        }
    }
    let bytes = writer.into_inner().map_err(|e| Error::file(&path, e))?;
    write_whole(&path, &bytes)
}

/// The metrics that a case shows and those that a check against the truth judges.
fn cited(study: &CaseStudy) -> Result<BTreeSet<&str>, Error> {
    let case = cases::find(&study.case)?;
    let shown = case.headlines.iter().map(|h| h.metric.name);
    let shown = shown.chain(case.quantities.iter().map(|q| q.metric.name));
    let verdicts = study.records.iter().flat_map(|r| &r.verdicts);
    let verdicts = verdicts.chain(&study.verdicts).filter(|v| truth(v.kind));
    Ok(shown.chain(verdicts.map(|v| v.metric.as_str())).collect())
}

fn truth(kind: Kind) -> bool {
    matches!(kind, Kind::Truth | Kind::KnownLimit)
}

fn row<'a>(record: &'a Record, night: &str, cited: &BTreeSet<&str>) -> Row<'a> {
    let judged = |outcome: Outcome| {
        let verdicts = record.verdicts.iter();
        let these = verdicts.filter(|v| truth(v.kind) && v.outcome == outcome);
        these.count()
    };
    let known = record.metrics.iter();
    let known = known.filter(|(name, _)| cited.contains(name.as_str()));
    let known = known.filter_map(|(name, metric)| Some((name, metric.value?)));
    let metrics = known.map(|(name, value)| format!("{name}={}", six_digits(value)));
    Row {
        case: &record.case,
        scheme: record.scheme().to_string(),
        level: &record.level,
        set: record.set.join(" "),
        h: record.discretisation.h,
        status: record.status,
        right: judged(Outcome::Right),
        wrong_as_known: judged(Outcome::WrongAsKnown),
        not_judged: judged(Outcome::NotJudged),
        failed: judged(Outcome::Failed),
        particles: record.work.particles,
        steps: record.work.steps,
        particle_node_pairs: record.work.particle_node_pairs,
        cpu_s: six_digits(record.time.cpu_s),
        night: night.to_owned(),
        program: &record.version.source,
        metrics: metrics.collect::<Vec<_>>().join(";"),
    }
}

/// A number to six significant digits, without those that say nothing.
fn six_digits(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    let (plain, short) = (format!("{rounded}"), format!("{rounded:e}"));
    if short.len() < plain.len() {
        short
    } else {
        plain
    }
}

#[cfg(test)]
mod tests {
    use super::six_digits;

    #[test]
    fn numbers_are_short() {
        let found = [0.0, 1.0, -0.148_699_4, 2.340_789_9e-5, 1.5e12].map(six_digits);
        assert_eq!(found, ["0", "1", "-0.148699", "2.34079e-5", "1.5e12"]);
    }
}
