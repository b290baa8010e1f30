//! A running simulation, as the harness drives it.

use crate::record::{Discretisation, Measured, WorkDone};
use mpm_core::{Memory, Spent};
use std::collections::BTreeMap;

/// A named particle column with its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Values in seeding order.
    pub values: Vec<f64>,
}

/// The particles at one time, as columns in seeding order: positions first (x, y, …).
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Time (s).
    pub time: f64,
    /// What is kept of them.
    pub columns: Vec<Column>,
}

/// A running simulation of a case. Its memory is all that it gathers from row to row, with that of what it
/// simulates: a run goes on from a checkpoint by it.
pub trait Job: Memory + Send {
    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// Names (with units) of the columns of the time series.
    fn series_columns(&self) -> Vec<&'static str>;
    /// Runs to the next time of observation and returns that row of the series.
    ///
    /// # Errors
    /// The computation broke down.
    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error>;
    /// Whether the run is complete.
    fn finished(&self) -> bool;
    /// Share of the longest possible run that is done, 0 to 1.
    fn progress(&self) -> f64;
    /// What is kept of the state after the last row, if it is time to keep something.
    fn snapshot(&mut self) -> Option<Snapshot> {
        None
    }
    /// The particles as columns in seeding order: positions first (x, y, …).
    fn particles(&mut self) -> Vec<Column>;
    /// The metrics at the end.
    fn metrics(&mut self) -> BTreeMap<String, Measured>;
    /// Work so far.
    fn work(&self) -> WorkDone;
    /// Where the time of the simulation of now went, as far as it tells.
    fn spent(&self) -> Spent {
        Spent::default()
    }
}
