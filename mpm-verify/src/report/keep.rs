//! Parts of a night's report that are kept: a row a run, and trends. Pages are filled from the rows: `tables`.
//!
//! A night may hold some cases alone. Its rows replace those of the same runs, and the others stay, each with the
//! night and the program that made it.

use super::prelude::*;
use super::rows::{Row, read, text};
use super::{SUMMARY, history};

/// Most bytes of the rows.
const MOST_ROWS: usize = 1_000_000;

/// Takes the night of the report in `report` into `folder`: its runs into `nightly/results.csv` and its trends into
/// `history.csv`. Returns how many rows it has replaced or added.
///
/// # Errors
/// The report is missing, damaged or of no night; a file of `folder` is damaged, can't be written, or would be larger
/// than what is kept may be.
pub fn keep(report: &Path, folder: &Path) -> Result<usize, Error> {
    let path = report.join(SUMMARY);
    let found: Summary = read_versioned(&path, SCHEMA)?;
    let nightly = folder.join("nightly");
    let results = nightly.join("results.csv");
    let former = read(&results)?;
    let mut fresh = Vec::new();
    for study in &found.cases {
        let why = || format!("{} is of no night: --night and --commit of `report`", study.case);
        let night = study.night.as_ref().ok_or_else(|| Error::file(&path, why()))?;
        fresh.extend(rows_of(study, night, &former)?);
    }
    let (count, rows) = (fresh.len(), merge(former, fresh));
    let rows = text(&rows).map_err(|e| Error::file(&results, e))?;
    require_small(&results, rows.len(), MOST_ROWS)?;
    make_folder(&nightly)?;
    history::merge(report, folder)?;
    write_whole(&results, &rows)?;
    Ok(count)
}

/// The rows of a case's runs. Beside what it shows and what is judged, they have the metrics that its former rows have:
/// a page may cite them.
fn rows_of(study: &CaseStudy, night: &Night, former: &[Row]) -> Result<Vec<Row>, Error> {
    let case = cases::find(&study.case)?;
    let columns = case.headlines.iter().chain(case.tables.iter().flat_map(|table| &table.columns));
    let mut cited: BTreeSet<&str> = columns.filter_map(|column| Some(column.metric?.name)).collect();
    cited.extend(case.quantities.iter().map(|q| q.metric.name));
    let former = former.iter().filter(|row| row.case == study.case);
    cited.extend(former.flat_map(|row| row.metrics.keys().map(String::as_str)));
    Ok(study.records.iter().map(|r| Row::of(r, night, &cited)).collect())
}

fn require_small(path: &Path, bytes: usize, most: usize) -> Result<(), Error> {
    if bytes <= most {
        return Ok(());
    }
    Err(Error::file(path, format!("{bytes} bytes where {most} are allowed; nothing is kept")))
}

/// The former rows, those of the same runs replaced, then the new ones, case by case; rows of cases that are known no
/// more are gone.
fn merge(former: Vec<Row>, fresh: Vec<Row>) -> Vec<Row> {
    let key = |row: &Row| row.run().map(str::to_owned);
    let mut again: BTreeMap<[String; 4], Row> = fresh.iter().map(|row| (key(row), row.clone())).collect();
    let former = former.into_iter().filter(|row| cases::find(&row.case).is_ok());
    let mut rows: Vec<Row> = former.map(|row| again.remove(&key(&row)).unwrap_or(row)).collect();
    rows.extend(fresh.into_iter().filter(|row| again.contains_key(&key(row))));
    rows.sort_by_key(|row| cases::place(&row.case));
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Finding;
    use crate::record::fixture::record;
    use crate::verdict::Kind;

    fn study(case: &str, date: &str, levels: &[(&str, f64)]) -> Vec<Row> {
        after(&[], case, date, levels)
    }

    /// Rows of a case that has had the former ones.
    fn after(former: &[Row], case: &str, date: &str, levels: &[(&str, f64)]) -> Vec<Row> {
        let runs = levels.iter().map(|(level, value)| {
            let exact = Finding::within("tip_ux", *value, 1.0, 0.0, "").verdict("tip", Kind::Truth);
            let counted = Finding::within("run", 1.0, 1.0, 0.0, "").verdict("completes", Kind::Bookkeeping);
            let mut run = record(level, vec![exact, counted]);
            run.case = case.to_owned();
            run.measure(&[("tip_ux", *value), ("cited_by_a_page", *value)]);
            run
        });
        let night = Night::new(date, "commit").unwrap();
        rows_of(&CaseStudy::new(case, runs.collect()), &night, former).unwrap()
    }

    #[test]
    fn a_metric_that_a_case_has_had_is_kept() {
        let mut former = study("cook", "2026-01-01", &[("h2", 1.0)]);
        assert!(!former[0].metrics.contains_key("cited_by_a_page"));
        former[0].metrics.insert("cited_by_a_page".to_owned(), 1.0);
        let again = after(&former, "cook", "2026-01-02", &[("h1", 2.0)]);
        assert_eq!(again[0].metrics["cited_by_a_page"], 2.0);
        let other = after(&former, "column", "2026-01-02", &[("h0.5", 2.0)]);
        assert!(!other[0].metrics.contains_key("cited_by_a_page"));
    }

    #[test]
    fn rows_are_replaced_run_by_run_and_the_others_keep_their_night() {
        let former = study("column", "2026-01-01", &[("n8", 1.0)]);
        let former = [former, study("cook", "2026-01-01", &[("h2", 1.0), ("h1", 1.0)])].concat();
        let fresh = study("cook", "2026-01-02", &[("h1", 2.0), ("h0.5", 1.0)]);
        let rows = merge(former, fresh);
        let told: Vec<_> = rows.iter().map(|r| format!("{} {} {} {}", r.case, r.level, r.night, r.failed)).collect();
        let expected =
            ["cook h2 2026-01-01 0", "cook h1 2026-01-02 1", "cook h0.5 2026-01-02 0", "column n8 2026-01-01 0"];
        assert_eq!(told, expected);
        assert!(rows.iter().all(|r| r.right + r.failed == 1), "no bookkeeping");
    }

    #[test]
    fn rows_read_back_and_those_of_unknown_cases_go() {
        let mut rows = study("cook", "2026-01-01", &[("h2", 1.0 / 3.0)]);
        assert_eq!(rows[0].metrics["tip_ux"], 0.333_333);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("results.csv");
        write_whole(&path, &text(&rows).unwrap()).unwrap();
        assert_eq!(read(&path).unwrap(), rows);
        rows[0].case = "bridge".to_owned();
        assert!(merge(rows, Vec::new()).is_empty());
    }

    #[test]
    fn what_is_kept_is_small() {
        let path = Path::new("results.csv");
        assert!(require_small(path, MOST_ROWS, MOST_ROWS).is_ok());
        let error = require_small(path, MOST_ROWS + 1, MOST_ROWS).unwrap_err();
        assert!(error.to_string().contains("1000001 bytes"), "{error}");
    }
}
