//! Numbers of nights: errors, orders and cost, kept in a table beside the report.

use super::prelude::*;
use crate::error::is_unfit;
use crate::files::{read_rows, rows_text};

const FILE: &str = "history.csv";
const COST: &str = "cpu_s";
const PAIRS: &str = "particle_node_pairs";
const ORDER: &str = "order of ";

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

/// Adds a night of a case to the history in `out` (replacing that case's rows if the night is there
/// already).
pub(super) fn add(study: &CaseStudy, night: &Night, out: &Path) -> Result<(), Error> {
    let path = out.join(FILE);
    let mut rows = read(&path)?;
    rows.retain(|row| row.night != night.date || row.case != study.case);
    rows.extend(rows_of(study, cases::find(&study.case)?.ladder, night));
    write(&mut rows, &path)
}

/// Takes the nights of the history in `from` into that in `into`, case by case; other nights stay.
pub(super) fn merge(from: &Path, into: &Path) -> Result<(), Error> {
    let (from, path) = (read(&from.join(FILE))?, into.join(FILE));
    let told: BTreeSet<(Date, &str)> = from.iter().map(|r| (r.night, &*r.case)).collect();
    let mut rows = read(&path)?;
    rows.retain(|r| !told.contains(&(r.night, &*r.case)));
    rows.extend(from.iter().cloned());
    write(&mut rows, &path)
}

/// Writes rows in the order of time and cases.
fn write(rows: &mut [Row], path: &Path) -> Result<(), Error> {
    rows.sort_by_key(|row| (row.night, cases::place(&row.case)));
    write_whole(path, &rows_text(rows.iter()).map_err(|e| Error::file(path, e))?)
}

fn read(path: &Path) -> Result<Vec<Row>, Error> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let sound = |row: Row| {
        // What stands here is shown and written again.
        Night::new(&row.night.to_string(), &row.commit).map_err(|e| Error::file(path, e))?;
        let acts = |cell: &String| cell.starts_with(['=', '+', '-', '@']) || cell.contains(is_unfit);
        if [&row.case, &row.run, &row.quantity].into_iter().any(acts) {
            return Err(Error::file(path, "damaged: a cell that a spreadsheet or a terminal acts on"));
        }
        Ok(row)
    };
    read_rows(path)?.into_iter().map(sound).collect()
}

fn rows_of(study: &CaseStudy, ladder: &[&str], night: &Night) -> Vec<Row> {
    let row = |run: String, quantity: String, value: f64| Row {
        night: night.date,
        commit: night.commit.clone(),
        case: study.case.clone(),
        run,
        quantity,
        value,
    };
    let mut rows = Vec::new();
    for entry in study.convergence.iter().filter(|c| c.is_error && c.set == ladder) {
        let (scheme, metric) = (entry.scheme, &entry.metric);
        let finest = entry.points.last();
        rows.extend(finest.map(|p| row(format!("{scheme}/{}", p.level), metric.clone(), p.value.abs())));
        let order = entry.order.as_ref();
        rows.extend(order.map(|o| row(scheme.to_string(), format!("{ORDER}{metric}"), o.order)));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::record;

    /// Found by damaging files.
    #[test]
    fn a_cell_that_a_spreadsheet_computes_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE);
        for (run, sound) in [("gimp-none-flip", true), ("=1+1", false), ("@a", false), ("a\u{1b}", false)] {
            let row = format!("2026-01-01,c,cook,{run},cpu_s,1.5\n");
            write_whole(&path, format!("night,commit,case,run,quantity,value\n{row}").as_bytes()).unwrap();
            assert_eq!(read(&path).is_ok(), sound, "{run}");
        }
    }

    #[test]
    fn a_night_of_one_case_leaves_the_rows_of_the_others() {
        let folder = tempfile::tempdir().unwrap();
        let add = |case: &str, date: &str, commit: &str| {
            let mut run = record("h2", Vec::new());
            run.case = case.to_owned();
            let study = CaseStudy::new(case, vec![run]);
            let night = Night::new(date, commit).unwrap();
            add(&study, &night, folder.path()).unwrap();
        };
        add("column", "2026-01-02", "a");
        add("cook", "2026-01-02", "a");
        add("cook", "2026-01-01", "b");
        add("cook", "2026-01-02", "c");
        let rows = read(&folder.path().join(FILE)).unwrap();
        let told = rows.iter().map(|r| format!("{} {} {}", r.night, r.commit, r.case));
        // In the order of time and cases; the time taken and the pairs visited are one row each.
        let expected = ["2026-01-01 b cook", "2026-01-02 c cook", "2026-01-02 a column"];
        assert_eq!(told.collect::<Vec<_>>(), expected.map(|t| [t, t]).concat());
    }
}
