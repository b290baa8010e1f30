//! CSV tables of a report, read back.

use crate::error::Error;
use std::path::Path;

/// A table of numbers with named columns.
pub(super) struct Table {
    header: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a CSV file whose cells are all numbers.
    pub(super) fn read(path: &Path) -> Result<Self, Error> {
        let mut reader = csv::Reader::from_path(path).map_err(|e| Error::file(path, e))?;
        let header: Vec<String> = reader
            .headers()
            .map_err(|e| Error::file(path, e))?
            .iter()
            .map(str::to_owned)
            .collect();
        let mut columns = vec![Vec::new(); header.len()];
        for row in reader.deserialize::<Vec<f64>>() {
            let row = row.map_err(|e| Error::file(path, e))?;
            for (column, value) in columns.iter_mut().zip(row) {
                column.push(value);
            }
        }
        Ok(Self { header, columns })
    }

    /// The column whose name, before its unit, is `name`; empty if there is none.
    pub(super) fn column(&self, name: &str) -> &[f64] {
        self.header
            .iter()
            .position(|h| h.split(" (").next() == Some(name))
            .map_or(&[], |k| &self.columns[k])
    }

    /// Two columns as points.
    pub(super) fn points(&self, x: &str, y: &str) -> Vec<(f64, f64)> {
        let ys = self.column(y).iter().copied();
        self.column(x).iter().copied().zip(ys).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_bad_cells_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        std::fs::write(&path, "time (s),u (m)\n0,1\n0.5,2\n").unwrap();
        let table = Table::read(&path).unwrap();
        assert_eq!(table.points("time", "u"), [(0.0, 1.0), (0.5, 2.0)]);
        assert!(table.column("v").is_empty());
        std::fs::write(&path, "time (s),u (m)\n0,x\n").unwrap();
        assert!(Table::read(&path).is_err());
        std::fs::write(&path, "time (s),u (m)\n0\n").unwrap();
        assert!(Table::read(&path).is_err());
    }
}
