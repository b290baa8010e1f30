//! Verdicts as tables: on pages, in the summary and as CSV.

use super::document::{Cell, Row, Table, Text};
use super::prelude::*;
use super::words::{name, quantity};
use crate::study::judge;

const HEAD: [&str; 8] = ["outcome", "kind", "check", "metric", "value", "reference", "tolerance", "source"];

/// A number as it is, which drift may need.
fn exact(value: Option<f64>) -> String {
    value.map_or_else(|| number(None), |x| x.to_string())
}

/// Verdicts with the runs that they are on, if these are named.
pub(super) fn table<'a>(verdicts: impl IntoIterator<Item = (Option<Text>, &'a Verdict)>) -> Table {
    let row = |(run, v): (Option<Text>, &Verdict)| -> Row {
        let shown = if v.kind == Kind::Drift { exact } else { number };
        let cells = [
            Cell::from(Text::badge(v.outcome)),
            Cell::of(kind(v.kind), "tight"),
            Cell::head(&*v.check),
            Cell::from(&*v.metric),
            Cell::of(shown(v.value), "num"),
            Cell::of(shown(v.reference), "num"),
            Cell::of(number(v.tolerance), "num"),
            Cell::of(&*v.source, "wordy"),
        ];
        run.map(Cell::from).into_iter().chain(cells).into()
    };
    let rows: Vec<Row> = verdicts.into_iter().map(row).collect();
    let run = rows.first().is_some_and(|row| row.cells.len() > HEAD.len()).then(|| Cell::from("run"));
    let head = HEAD.map(|title| match title {
        "value" | "reference" | "tolerance" => Cell::of(title, "num"),
        _ => Cell::from(title),
    });
    Table { class: "", head: run.into_iter().chain(head).collect(), rows }
}

/// Differences from the goldens, run by run.
pub(super) fn drift(summary: &Summary) -> Sheet {
    let rows = summary.records().flat_map(|record| {
        record.verdicts.iter().filter(|v| v.drifts()).map(move |v| {
            let difference = v.value.zip(v.reference).map(|(now, golden)| now - golden);
            let what = if difference.is_some() { v.metric.clone() } else { format!("{}: {}", v.metric, v.source) };
            vec![
                format!("{} {}", record.case, record.folder()),
                what,
                exact(v.reference),
                exact(v.value),
                difference.map_or_else(|| number(None), |d| format!("{d:.3e}")),
                number(v.tolerance),
            ]
        })
    });
    Sheet::new(["run", "quantity", "golden", "now", "difference", "allowed"]).with(rows)
}

/// Writes every verdict of a case, those of drift apart, into `verdicts.csv` of its folder.
pub(super) fn write(study: &CaseStudy, out: &Path) -> Result<(), Error> {
    let mut head = HEAD.map(str::to_owned).to_vec();
    head.insert(3, "run".to_owned());
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    let rows = study.all_verdicts().filter(|(_, v)| v.kind != Kind::Drift).map(|(run, v)| {
        let run = run.map_or_else(|| "runs together".to_owned(), Record::folder);
        let words = [outcome(v.outcome), kind(v.kind), &v.check, &run, &v.metric];
        let numbers = [v.value, v.reference, v.tolerance].map(number);
        [&words.map(str::to_owned)[..], &numbers, std::slice::from_ref(&v.source)].concat()
    });
    write_csv(&out.join(&study.case).join("verdicts.csv"), &head, rows)
}

/// The runs that broke down and were not known to, each with the message.
pub(super) fn broken(summary: &Summary) -> impl Iterator<Item = (&CaseStudy, &Record, &str)> {
    summary.cases.iter().flat_map(|study| study.records.iter().map(move |r| (study, r))).filter_map(|(study, r)| {
        let error = r.error.as_ref().filter(|_| r.broke_down())?;
        Some((study, r, &*error.message))
    })
}

/// The tightest margin of a wanted quantity: distance and tolerance or value and bound, with units; the metric; and the run.
pub(super) fn tightest<'a>(case: &Case, study: &'a CaseStudy) -> Option<(String, &'a str, String)> {
    let (run, v) = judge::tightest(case, &study.records)?;
    let unit = case.metrics.iter().find(|m| m.name == v.metric).map_or("-", |m| m.unit);
    let [distance, tolerance] =
        [v.value.map(|x| (x - v.reference.unwrap_or(0.0)).abs()), v.tolerance].map(|x| quantity(x, unit));
    let margin = match v.reference {
        Some(_) => format!("{distance} off, ± {tolerance} allowed"),
        None => format!("{}, bound {tolerance}", quantity(v.value, unit)),
    };
    Some((margin, &v.metric, name(run)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::check::Finding;
    use crate::record::fixture::record;

    #[test]
    fn the_tightest_margin_is_of_a_run_that_is_right() {
        let edge = |distance: f64| {
            Finding::within("fem_edge_mean_error", 1.0 + distance, 1.0, 0.1, "").verdict("edge-mean", Kind::Truth)
        };
        let wrong = Finding::within("at_rest", 0.0, 1.0, 0.0, "").verdict("at-rest", Kind::Truth);
        let runs = vec![
            record("h2", vec![edge(0.05)]),
            record("h1", vec![edge(0.025)]),
            record("h0.5", vec![edge(0.0125), wrong]),
        ];
        let study = CaseStudy::new("cook", runs);
        let found = tightest(cases::find("cook").unwrap(), &study).unwrap();
        assert!(found.2.contains("h2") && found.0.contains("0.05"));
    }
}
