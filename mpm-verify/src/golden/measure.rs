//! The golden numbers of a run, from its files and those of its perturbed twin.

use super::format::{Column, Point, Run, SERIES, WORK};
use super::*;

/// Rows of a series that are kept of each watched column.
const ROWS: usize = 8;

impl Run {
    /// Golden of a run whose outputs lie in `folder`, and its perturbed twin.
    ///
    /// # Errors
    /// The case is not known, or a series can't be read.
    pub fn of((record, folder): (&Record, &Path), (twin, twin_folder): (&Record, &Path)) -> Result<Self, Error> {
        let mut columns = metrics(record, twin);
        let [of_run, of_twin] = [folder, twin_folder].map(|f| Table::read(&f.join(series::FILE)));
        let (of_run, of_twin) = (of_run?, of_twin?);
        for (header, values) in of_run.iter() {
            if cases::find(&record.case)?.watched.contains(&bare(header)) {
                let others = of_twin.get(header).unwrap_or_default();
                columns.extend(rows(header, [&of_run, &of_twin].map(first), [values, others]));
            }
        }
        columns.extend(counts(record, twin));
        Ok(Self { name: record.folder(), columns })
    }
}

fn first(table: &Table) -> &[f64] {
    table.iter().next().map_or(&[], |(_, times)| times)
}

/// The metrics that both have.
fn metrics(record: &Record, twin: &Record) -> Vec<Column> {
    let both = record.metrics.iter().filter_map(|(name, metric)| {
        let value = metric.value?;
        let response = (value - twin.metrics.get(name)?.value?).abs();
        Some(Column::single(format!("metric/{name} ({})", metric.unit), rounded(value, 10), rounded(response, 2)))
    });
    both.filter(|column| !column.is_blunt()).collect()
}

/// Counts of work: a run that ends by a criterion may take a row more than its twin. Those that differ by more are left out.
fn counts(record: &Record, twin: &Record) -> Vec<Column> {
    let counts = record.work.counts().into_iter().zip(twin.work.counts()).map(|((name, count), (_, of_twin))| {
        Column::single(format!("{WORK}{name}"), count as f64, count.abs_diff(of_twin) as f64)
    });
    counts.filter(|c| c.is_loose().is_none()).collect()
}

/// Evenly spaced rows of a column and the last, as far as none of them responds too strongly. What a row responds by is
/// the most of all rows up to it, the kept ones and the others: a difference may pass through zero. A row is found by its
/// time, so that of several at one time, as static steps are, none is kept but the first.
fn rows(header: &str, times: [&[f64]; 2], values: [&[f64]; 2]) -> Option<Column> {
    let total = values[0].len();
    let mut kept: Vec<usize> = (1..=ROWS).map(|k| (k * total).div_ceil(ROWS)).collect();
    kept.dedup();
    let mut response: f64 = 0.0;
    let mut points = Vec::new();
    let mut twin = values[1].iter().zip(times[1]);
    for k in 0..total {
        // A slim run lacks rows that its twin has.
        let same = twin.find(|(_, time)| **time >= times[0][k]).filter(|(_, time)| **time == times[0][k]);
        let difference = same.map_or(f64::NAN, |(value, _)| (values[0][k] - value).abs());
        if !difference.is_finite() {
            break;
        }
        response = response.max(difference);
        let is_later = k == 0 || times[0][k] > times[0][k - 1];
        if kept.contains(&(k + 1)) && is_later {
            points.push(Point {
                time: Some(rounded(times[0][k], 10)),
                value: rounded(values[0][k], 10),
                response: rounded(response, 2),
            });
        }
    }
    let mut column = Column { quantity: format!("{SERIES}{header}"), points };
    while column.is_blunt() {
        column.points.pop();
    }
    (!column.points.is_empty()).then_some(column)
}

/// A number to `digits` significant digits: the rest is far below any tolerance.
pub(super) fn rounded(number: f64, digits: usize) -> f64 {
    format!("{number:.*e}", digits - 1).parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::record;

    #[test]
    fn of_rows_at_one_time_the_first_is_kept() {
        let times = [&[0.0, 0.0, 0.5, 1.0][..]; 2];
        let values = [&[1.0, 2.0, 3.0, 4.0][..]; 2];
        let kept = rows("moved (m)", times, values).unwrap();
        let kept: Vec<_> = kept.points.iter().map(|p| (p.time, p.value)).collect();
        assert_eq!(kept, [(Some(0.0), 1.0), (Some(0.5), 3.0), (Some(1.0), 4.0)]);
    }

    #[test]
    fn numbers_are_kept_to_so_many_digits() {
        assert_eq!(rounded(1.234_56, 3), 1.23);
        assert_eq!(rounded(-9.996e-9, 3), -1e-8);
    }

    #[test]
    fn rows_end_where_the_twin_parts_from_the_run() {
        let kept = |times: [f64; 2], values: [f64; 2]| {
            let (a, b) = ([0.0, 1.0, 2.0], [0.0, 1.0, 2.0]);
            let (twin, of_twin) = ([0.0, times[0], times[1]], [0.0, values[0], values[1]]);
            let column = rows("moved (m)", [&a, &twin], [&b, &of_twin]).unwrap();
            column.points.iter().map(|p| p.value).collect::<Vec<_>>()
        };
        assert_eq!(kept([1.0, 2.0], [1.0, 2.0]), [0.0, 1.0, 2.0]);
        assert_eq!(kept([1.5, 2.0], [1.0, 2.0]), [0.0]);
        assert_eq!(kept([1.0, 2.0], [1.0, f64::NAN]), [0.0, 1.0]);
        // A row that answers rounding strongly is left out, and what is behind it.
        assert_eq!(kept([1.0, 2.0], [1.0 + 1e-7, 2.0]), [0.0]);
        let shorter = rows("moved (m)", [&[0.0, 1.0], &[0.0]], [&[3.0, 4.0], &[3.0]]).unwrap();
        assert_eq!(shorter.points.len(), 1);
        assert!(rows("moved (m)", [&[0.0], &[1.0]], [&[3.0], &[3.0]]).is_none());
    }

    #[test]
    fn a_count_that_answers_rounding_strongly_is_no_golden() {
        let [mut run, mut twin] = [(); 2].map(|()| record("n8", Vec::new()));
        let known = |run: &Record, twin: &Record| -> Vec<String> {
            counts(run, twin).into_iter().map(|c| c.quantity).collect()
        };
        (run.work.sorts, twin.work.sorts) = (195, 813);
        (run.work.steps, twin.work.steps) = (6667, 6668);
        let names = known(&run, &twin);
        assert!(!names.contains(&"work/sorts".to_owned()), "{names:?}");
        assert!(names.contains(&"work/steps".to_owned()), "{names:?}");
        twin.work.sorts = 200;
        assert!(known(&run, &twin).contains(&"work/sorts".to_owned()));
    }
}
