//! Tables: of numbers, as files hold them, and of text, as they are shown.

use crate::error::Error;
use crate::files::{OTHER_LAYOUT, TABLE, csv_text, read, write_csv};
use std::path::Path;

/// A table as it is shown: text in cells. Terminal and pages in Markdown have it as it is here, HTML by a template.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sheet {
    /// Titles of the columns.
    pub head: Vec<String>,
    /// Rows, each with a cell per column.
    pub rows: Vec<Vec<String>>,
}

impl Sheet {
    /// Without rows.
    pub(crate) fn new(head: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { head: head.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    pub(crate) fn with(mut self, rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        self.rows.extend(rows);
        self
    }

    /// Rows as columns: the first column is the head.
    pub(crate) fn transposed(&self) -> Self {
        let lines = || std::iter::once(&self.head).chain(&self.rows);
        let column = |k: usize| lines().map(|line| line[k].clone()).collect::<Vec<_>>();
        Self::new(column(0)).with((1..self.head.len()).map(column))
    }

    /// Without columns whose cells are all empty.
    pub(crate) fn dense(&self) -> Self {
        let says = |k: &usize| self.rows.iter().any(|row| !["", "–"].contains(&&*row[*k]));
        let kept: Vec<usize> = (0..self.head.len()).filter(says).collect();
        let of = |line: &Vec<String>| kept.iter().map(|k| line[*k].clone()).collect();
        Self { head: of(&self.head), rows: self.rows.iter().map(of).collect() }
    }

    pub(crate) fn markdown(&self) -> String {
        let line = |cells: &Vec<String>| {
            let cells: Vec<String> = cells.iter().map(|c| c.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rows: String = self.rows.iter().map(line).collect();
        format!("{}|{}\n{rows}", line(&self.head), "---|".repeat(self.head.len()))
    }
}

/// A table of numbers with named columns, all of the same length.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    header: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl Table {
    /// A table of columns of the same length, with their names.
    pub(crate) fn of_columns(columns: impl IntoIterator<Item = (impl Into<String>, Vec<f64>)>) -> Self {
        let (header, columns) = columns.into_iter().map(|(name, values)| (name.into(), values)).unzip();
        Self { header, columns }
    }

    /// Reads a CSV file whose cells are all numbers.
    ///
    /// # Errors
    /// The file is missing, not UTF-8, has rows of different lengths or a cell that is no number.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = read(path, TABLE)?;
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        let header: Vec<String> =
            reader.headers().map_err(|e| Error::file(path, e))?.iter().map(str::to_owned).collect();
        let mut columns = vec![Vec::new(); header.len()];
        for row in reader.deserialize::<Vec<f64>>() {
            let row = row.map_err(|e| Error::file(path, e))?;
            for (column, value) in columns.iter_mut().zip(row) {
                column.push(value);
            }
        }
        Ok(Self { header, columns })
    }

    /// Reads a table whose numbers must all be finite.
    ///
    /// # Errors
    /// Those of [`Table::read`], a column that is there twice, and a cell that is NaN or infinite.
    pub fn read_finite(path: &Path) -> Result<Self, Error> {
        let table = Self::read(path)?;
        table.require_finite("column", "row").map_err(|said| Error::file(path, said))?;
        Ok(table)
    }

    /// Checks its names and numbers, of what is called so.
    pub(crate) fn require_finite(&self, column: &str, row: &str) -> Result<(), String> {
        let mut known = std::collections::HashSet::new();
        for (name, values) in self.iter() {
            if !known.insert(name) {
                return Err(format!("{column} {name:?} is there twice"));
            }
            if let Some(k) = values.iter().position(|v| !v.is_finite()) {
                return Err(format!("{column} {name:?}, {row} {}: {}", k + 1, values[k]));
            }
        }
        Ok(())
    }

    /// Writes the table as CSV; every number reads back as it was.
    ///
    /// # Errors
    /// The file can't be written.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        write_csv(path, &self.header, self.lines())
    }

    fn lines(&self) -> impl Iterator<Item = Vec<String>> {
        let row = |k: usize| self.columns.iter().map(|c| c[k].to_string()).collect();
        (0..self.rows()).map(row)
    }

    /// Reads a table that [`Table::write`] has written: byte for byte, and nothing beside it.
    ///
    /// # Errors
    /// Those of [`Table::read_finite`], or it is laid out otherwise.
    pub fn read_own(path: &Path) -> Result<Self, Error> {
        let table = Self::read_finite(path)?;
        let own = csv_text(&table.header, table.lines()).map_err(|e| Error::file(path, e))?;
        if read(path, TABLE)? == own { Ok(table) } else { Err(Error::file(path, OTHER_LAYOUT)) }
    }

    pub(crate) fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// With this number of rows at most: evenly spaced ones, the last among them.
    pub(crate) fn thinned(self, most: usize) -> Self {
        let total = self.rows();
        if total <= most {
            return self;
        }
        let thin = |c: Vec<f64>| (1..=most).map(|k| c[(k * total).div_ceil(most) - 1]).collect();
        Self { columns: self.columns.into_iter().map(thin).collect(), ..self }
    }

    /// The columns with their names and units.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.header.iter().map(String::as_str).zip(self.columns.iter().map(Vec::as_slice))
    }

    /// The column named `header`, unit included.
    pub(crate) fn get(&self, header: &str) -> Option<&[f64]> {
        self.iter().find(|(h, _)| *h == header).map(|(_, v)| v)
    }

    /// The column whose name, before its unit, is `name`; empty without such a column.
    pub(crate) fn column(&self, name: &str) -> &[f64] {
        self.iter().find(|(h, _)| h.split(" (").next() == Some(name)).map_or(&[], |(_, values)| values)
    }

    /// Header of the first column, by which the rows are ordered: time, or what is tried one after another.
    pub(crate) fn abscissa(&self) -> &str {
        self.header.first().map_or("", String::as_str)
    }

    /// Two columns as points.
    pub(crate) fn points(&self, x: &str, y: &str) -> Vec<(f64, f64)> {
        self.column(x).iter().copied().zip(self.column(y).iter().copied()).collect()
    }

    /// Two columns as points, each of which `map` changes.
    pub(crate) fn pairs(&self, [x, y]: [&str; 2], map: impl Fn(f64, f64) -> (f64, f64)) -> Vec<(f64, f64)> {
        self.points(x, y).into_iter().map(|(x, y)| map(x, y)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &[u8]) -> tempfile::NamedTempFile {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        file
    }

    #[test]
    fn columns_are_found_by_name_and_bad_cells_are_errors() {
        let good = file(b"time (s),u (m)\n0,1\n0.5,2\n");
        let table = Table::read(good.path()).unwrap();
        assert_eq!(table.points("time", "u"), [(0.0, 1.0), (0.5, 2.0)]);
        assert!(table.column("v").is_empty());
        for bad in [&b"time (s),u (m)\n0,x\n"[..], b"time (s),u (m)\n0\n"] {
            assert!(Table::read(file(bad).path()).is_err());
        }
    }

    #[test]
    fn every_defect_of_a_table_that_must_be_finite_is_named() {
        for (text, needle) in [
            (&b"t,u\n0,NaN\n"[..], "column \"u\", row 1: NaN"),
            (b"t,u\n0,1\n1,inf\n", "column \"u\", row 2: inf"),
            (b"t,t\n0,1\n", "\"t\" is there twice"),
            (b"t,u\n0,\xff\n", "UTF-8"),
            (b"t,\xff\n0,1\n", "UTF-8"),
            (b"t,u\n0,1\n2\n", "found record with 1 fields"),
        ] {
            let error = Table::read_finite(file(text).path()).unwrap_err().to_string();
            assert!(error.to_lowercase().contains(&needle.to_lowercase()), "{error}");
        }
    }
}
