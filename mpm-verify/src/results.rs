//! Tables of results as data: which runs they show, what the runs of a row have in common, and what the columns say.

use crate::accuracy::{Order, fit_order};
use crate::demand::Held;
use crate::distinct;
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::{RemedyName, Scheme, TransferName};
use crate::table::Sheet;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Notation {
    Fixed,
    Scientific,
    Short,
}

/// How a number is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format {
    factor: f64,
    decimals: usize,
    signed: bool,
    notation: Notation,
    unit: &'static str,
}

/// Format with this number of decimals.
pub(crate) const fn fixed(decimals: usize) -> Format {
    Format { factor: 1.0, decimals, signed: false, notation: Notation::Fixed, unit: "" }
}

/// A difference in per cent, with its sign.
pub(crate) const fn percent(decimals: usize) -> Format {
    Format { signed: true, ..share(decimals) }
}

/// A share in per cent.
pub(crate) const fn share(decimals: usize) -> Format {
    Format { factor: 100.0, unit: " %", ..fixed(decimals) }
}

/// Power of ten, with this number of decimals in the factor.
pub(crate) const fn scientific(decimals: usize) -> Format {
    Format { notation: Notation::Scientific, ..fixed(decimals) }
}

/// With two decimals, or as a power of ten where they would say little or too much.
pub(crate) const SHORT: Format = Format { notation: Notation::Short, ..fixed(2) };

impl Format {
    /// Times a factor: that from the metric's unit to the column's.
    pub(crate) const fn times(self, factor: f64) -> Self {
        Self { factor, ..self }
    }

    /// With its sign.
    pub(crate) const fn signed(self) -> Self {
        Self { signed: true, ..self }
    }

    /// Followed by a unit.
    pub(crate) const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// The number as shown; a dash for NaN.
    pub(crate) fn text(self, value: f64) -> String {
        let value = self.factor * value;
        if !value.is_finite() {
            return "–".to_owned();
        }
        let decimals = self.decimals;
        let large_or_small = value != 0.0 && !(0.01..1e3).contains(&value.abs());
        let text = match self.notation {
            Notation::Short if large_or_small => format!("{value:.1e}"),
            Notation::Scientific => format!("{value:.decimals$e}"),
            _ if self.signed => format!("{value:+.decimals$}"),
            _ => format!("{value:.decimals$}"),
        };
        format!("{}{}", text.replace('-', "−"), self.unit)
    }
}

type Of<T> = Box<dyn Fn(&Record) -> T + Send + Sync>;
type OfRow = Box<dyn Fn(&[&Record], &[&Record]) -> String + Send + Sync>;

enum Cell {
    /// Text of the first run in the row that the column applies to.
    Run(Of<bool>, Of<String>),
    /// Text of all runs of the row, given those of the table; may be empty.
    Row(OfRow),
}

/// A column of a table of results.
pub struct Column {
    /// Title, with unit.
    pub title: String,
    /// The metric that it shows, if it shows one as it is.
    pub metric: Option<Metric>,
    cell: Cell,
}

/// A column by metric, title, factor from the metric's unit to that of the title and decimals; more than five decimals
/// stand for two of a power of ten.
pub(crate) fn headline(metric: Metric, title: &str, factor: f64, decimals: usize) -> Column {
    let format = match decimals {
        0..=5 => fixed(decimals),
        _ => scientific(2),
    };
    Column::metric(title, metric, format.times(factor))
}

impl Column {
    /// Column of a text per run.
    pub(crate) fn text(title: impl Into<String>, text: impl Fn(&Record) -> String + Held) -> Self {
        Self { title: title.into(), metric: None, cell: Cell::Run(Box::new(|_| true), Box::new(text)) }
    }

    pub(crate) fn value(title: impl Into<String>, value: impl Fn(&Record) -> f64 + Held, format: Format) -> Self {
        Self::text(title, move |r| format.text(value(r)))
    }

    pub(crate) fn metric(title: impl Into<String>, metric: Metric, format: Format) -> Self {
        Self { metric: Some(metric), ..Self::value(title, move |r| r.metric(metric), format) }
    }

    /// Column of a text per row, given the runs of the row and of the table; the text may be empty.
    pub(crate) fn row(title: impl Into<String>, text: impl Fn(&[&Record], &[&Record]) -> String + Held) -> Self {
        Self { title: title.into(), metric: None, cell: Cell::Row(Box::new(text)) }
    }

    /// Restricts the column to the first matching run of the row.
    pub(crate) fn of(self, run: impl Fn(&Record) -> bool + Held) -> Self {
        let cell = match self.cell {
            Cell::Run(_, text) => Cell::Run(Box::new(run), text),
            row @ Cell::Row(_) => row,
        };
        Self { cell, ..self }
    }

    /// Restricts the column to the runs at a level.
    pub(crate) fn at(self, level: &'static str) -> Self {
        self.of(move |r| r.level == level)
    }

    /// Text of a run by itself; empty if the column needs several runs.
    pub(crate) fn of_run(&self, run: &Record) -> String {
        match &self.cell {
            Cell::Run(of, text) if of(run) => text(run),
            _ => String::new(),
        }
    }

    /// The observed order of a metric over the runs of the row.
    pub(crate) fn order(metric: Metric) -> Self {
        Self::order_of(metric, |_| true)
    }

    /// The same over those that `converge`.
    pub(crate) fn order_of(metric: Metric, converge: impl Fn(&Record) -> bool + Held) -> Self {
        Self::row("order ± (between levels)", move |runs, _| {
            let found = order(runs.iter().copied().filter(|r| converge(r)), metric.name);
            found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
        })
    }

    /// The observed order of a metric over the runs of the row, without those between levels.
    pub(crate) fn plain_order(title: impl Into<String>, metric: Metric) -> Self {
        Self::row(title, move |runs, _| {
            order(runs.iter().copied(), metric.name).map_or_else(|| "–".to_owned(), |o| o.to_string())
        })
    }

    /// The same with another title.
    pub(crate) fn titled(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    /// A metric at each of `levels`, by name and title.
    pub(crate) fn levels<T: Into<String>>(
        levels: impl IntoIterator<Item = (&'static str, T)>,
        metric: Metric,
        format: Format,
    ) -> Vec<Self> {
        let column = |(level, title)| Self::metric(title, metric, format).at(level);
        levels.into_iter().map(column).collect()
    }

    /// A metric at each of `values` of what `key` reads from a run, by value and title.
    pub(crate) fn over<T: Into<String>>(
        values: impl IntoIterator<Item = (f64, T)>,
        key: impl Fn(&Record) -> f64 + Clone + Held,
        metric: Metric,
        format: Format,
    ) -> Vec<Self> {
        let column = |(value, title): (f64, T)| {
            let key = key.clone();
            Self::metric(title, metric, format).of(move |r| (key(r) - value).abs() < 1e-9)
        };
        values.into_iter().map(column).collect()
    }

    /// Processor time (s).
    pub(crate) fn cpu() -> Self {
        Self::value("CPU (s)", |r| r.time.cpu_s, fixed(0))
    }
}

/// Common property of the runs of a row: its title, and its value for a run.
pub(crate) type Label = (&'static str, fn(&Record) -> String);

/// The scheme of a row.
pub(crate) const SCHEME: Label = ("scheme", |r| r.scheme().title());
/// The scheme of a row without its transfer.
pub(crate) const PAIR: Label = ("scheme", |r| Scheme::flip(r.basis(), r.remedy()).title());
/// The parameters of a row that are not the case's own.
pub(crate) const SET: Label = ("changed", |r| r.set.join(", "));
/// The same, and a dash if there are none.
pub(crate) const CHANGED: Label = ("changed", |r| if r.is_default() { "–".to_owned() } else { r.set.join(", ") });
/// The cell size of a row.
pub(crate) const CELLS: Label = ("h", |r| format!("{} m", r.level.trim_start_matches('h')));
/// The level of a row.
pub(crate) const LEVEL: Label = ("level", |r| r.level.clone());
/// The basis of a row.
pub(crate) const BASIS: Label = ("", |r| r.basis().to_string());

/// The value of a parameter as it was set, or its default.
pub(crate) fn word(r: &Record, name: &str, default: &str) -> String {
    r.set.iter().find_map(|set| set.strip_prefix(name)?.strip_prefix('=')).unwrap_or(default).to_owned()
}

/// Whether a run transfers by FLIP.
pub(crate) fn is_flip(r: &Record) -> bool {
    r.transfer() == TransferName::Flip
}

pub struct ResultTable {
    pub name: String,
    shows: Of<bool>,
    labels: Vec<Label>,
    /// Columns behind the labels.
    pub columns: Vec<Column>,
    least: usize,
    across: bool,
}

impl ResultTable {
    /// Table of the runs that it `shows`, with the labels that the runs of a row share, and the columns.
    pub(crate) fn new(
        name: impl Into<String>,
        shows: impl Fn(&Record) -> bool + Held,
        labels: &[Label],
        columns: impl IntoIterator<Item = Column>,
    ) -> Self {
        Self {
            name: name.into(),
            shows: Box::new(shows),
            labels: labels.to_vec(),
            columns: columns.into_iter().collect(),
            least: 1,
            across: false,
        }
    }

    /// Table of the runs that it `shows`, without labels and columns yet.
    pub(crate) fn of(name: impl Into<String>, shows: impl Fn(&Record) -> bool + Held) -> Self {
        Self::new(name, shows, &[], [])
    }

    /// With the labels that the runs of a row share.
    pub(crate) fn by(self, labels: &[Label]) -> Self {
        Self { labels: labels.to_vec(), ..self }
    }

    pub(crate) fn columns(mut self, columns: impl IntoIterator<Item = Column>) -> Self {
        self.columns.extend(columns);
        self
    }

    pub(crate) fn column(self, column: Column) -> Self {
        self.columns([column])
    }

    pub(crate) fn metric(self, title: impl Into<String>, metric: Metric, format: Format) -> Self {
        self.column(Column::metric(title, metric, format))
    }

    pub(crate) fn value(self, title: impl Into<String>, value: impl Fn(&Record) -> f64 + Held, format: Format) -> Self {
        self.column(Column::value(title, value, format))
    }

    pub(crate) fn text(self, title: impl Into<String>, text: impl Fn(&Record) -> String + Held) -> Self {
        self.column(Column::text(title, text))
    }

    pub(crate) fn cpu(self) -> Self {
        self.column(Column::cpu())
    }

    /// Bases by remedies, of runs that tell no more apart.
    pub(crate) fn by_remedy(
        name: &str,
        remedies: &[RemedyName],
        shows: impl Fn(&Record) -> bool + Held,
        text: fn(&Record) -> String,
    ) -> Self {
        let column = |&remedy: &RemedyName| Column::text(remedy.text(), text).of(move |r| r.remedy() == remedy);
        Self::new(name, shows, &[BASIS], remedies.iter().map(column))
    }

    /// Shows only rows with at least this number of filled cells.
    pub(crate) fn least(self, least: usize) -> Self {
        Self { least, ..self }
    }

    /// Shows rows as columns.
    pub(crate) fn across(self) -> Self {
        Self { across: true, ..self }
    }

    /// The table of some runs, by case, scheme, level and changed parameters. A cell without a run is empty; a breakdown is
    /// shown once per row.
    pub(crate) fn fill<'a>(&self, records: impl IntoIterator<Item = &'a Record>) -> Sheet {
        let mut shown: Vec<&Record> = records.into_iter().filter(|r| (self.shows)(r)).collect();
        let cases = distinct(shown.iter().map(|r| &r.case));
        shown.sort_by(|a, b| {
            let case = |r: &Record| cases.iter().position(|c| **c == r.case);
            let place = |r: &Record| (case(r), r.basis(), r.remedy(), r.transfer());
            let h = |r: &Record| r.discretisation.h;
            place(a).cmp(&place(b)).then(h(b).total_cmp(&h(a))).then_with(|| a.set.cmp(&b.set))
        });
        let label = |r: &Record| -> Vec<String> { self.labels.iter().map(|(_, of)| of(r)).collect() };
        let titles = self.labels.iter().map(|(title, _)| (*title).to_owned());
        let head = titles.chain(self.columns.iter().map(|c| c.title.clone()));
        let mut sheet = Sheet::new(head);
        let says = |cells: &[String]| cells.iter().filter(|c| !c.is_empty()).count();
        for labels in distinct(shown.iter().map(|r| label(r))) {
            let runs = shown.iter().copied().filter(|r| label(r) == labels);
            let cells = self.cells(&runs.collect::<Vec<_>>(), &shown);
            if says(&cells) >= self.least {
                sheet.rows.push([labels, cells].concat());
            }
        }
        if self.across {
            sheet = sheet.transposed();
            sheet.rows.retain(|row| says(&row[1..]) > 0);
        }
        sheet
    }

    /// Cells of the runs of a row.
    fn cells(&self, runs: &[&Record], all: &[&Record]) -> Vec<String> {
        let mut broken = None;
        let cells = self.columns.iter().map(|column| match &column.cell {
            Cell::Row(text) => text(runs, all),
            Cell::Run(of, text) => {
                let Some(run) = runs.iter().copied().find(|r| of(r)) else { return String::new() };
                let Status::Failed = run.status else { return text(run) };
                let again = broken.replace(std::ptr::from_ref(run)) == Some(std::ptr::from_ref(run));
                let time = fixed(2).text(run.error.as_ref().map_or(f64::NAN, |e| e.time));
                if again { String::new() } else { format!("breaks down at {time} s") }
            }
        });
        cells.collect()
    }
}

/// The order of an error over the runs of a row that have it.
pub(crate) fn order<'a>(runs: impl Iterator<Item = &'a Record>, error: &str) -> Option<Order> {
    let points = runs.map(|r| (r.discretisation.h, r.value(error)));
    fit_order(&points.filter(|(_, e)| e.is_finite()).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::record;

    #[test]
    fn numbers_are_shown_as_their_columns_want_them() {
        let shown = [
            fixed(2).text(-1.005),
            percent(1).text(0.0123),
            share(0).text(0.456),
            fixed(1).times(1e3).unit(" mm").text(0.0255),
            scientific(1).text(-0.00123),
            SHORT.text(0.5),
            SHORT.text(1234.0),
            fixed(0).text(f64::NAN),
        ];
        let expected = ["−1.00", "+1.2 %", "46 %", "25.5 mm", "−1.2e−3", "0.50", "1.2e3", "–"];
        assert_eq!(shown, expected);
    }

    #[test]
    fn rows_group_runs_columns_pick_them_and_gaps_stay_empty() {
        let runs = ["h2", "h1"].map(|level| record(level, Vec::new()));
        let particles = |r: &Record| r.work.particles as f64;
        let columns =
            ["h1", "h0.5"].map(|level| Column::value(level, particles, fixed(0)).of(move |r| r.level == level));
        let table = |columns: Vec<Column>| ResultTable::new("t", |_: &Record| true, &[SCHEME], columns);
        let sheet = table(columns.into()).fill(&runs);
        assert_eq!(sheet.markdown(), "| scheme | h1 | h0.5 |\n|---|---|---|\n| gimp none | 1 |  |\n");
        let nothing = [Column::text("", |_| String::new())];
        assert!(table(nothing.into()).least(1).fill(&runs).rows.is_empty());
    }
}
