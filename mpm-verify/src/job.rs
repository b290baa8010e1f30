//! A running simulation, as the harness drives it.

use crate::record::{Discretisation, Measured, WorkDone};
use mpm_core::{Memory, Spent};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A named particle column with its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    /// Values in seeding order.
    pub(crate) values: Vec<f64>,
}

/// A row of the time series: name with unit, and value, of each column.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Row(pub Vec<(&'static str, f64)>);

/// A [`Row`]: `row! { "time (s)": t, … }`.
macro_rules! row {
    ($($name:literal: $value:expr),* $(,)?) => { $crate::job::Row(vec![$(($name, $value)),*]) };
}
pub(crate) use row;

/// The particles at one time, as columns in seeding order: positions first (x, y, …).
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Time (s).
    pub time: f64,
    /// Columns that are kept.
    pub columns: Vec<Column>,
}

/// How far a job has come since it was begun or restored, step by step, for others to see between its rows.
#[derive(Debug, Default)]
pub struct Pulse {
    steps: AtomicU64,
    time: AtomicU64,
}

impl Pulse {
    /// One more step, which ended at `time` (s).
    pub(crate) fn beat(&self, time: f64) {
        self.time.store(time.to_bits(), Relaxed);
        self.steps.fetch_add(1, Relaxed);
    }

    /// Steps.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps.load(Relaxed)
    }

    /// Simulated time (s).
    #[must_use]
    pub fn time(&self) -> f64 {
        f64::from_bits(self.time.load(Relaxed))
    }
}

/// A running simulation of a case. Its memory is all that it gathers from row to row, with that of what it
/// simulates: a run goes on from a checkpoint by it.
pub trait Job: Memory + Send {
    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// Runs to the next time of observation and returns that row of the series.
    fn advance(&mut self) -> Result<Row, mpm_core::Error>;
    /// Whether the run is complete.
    fn finished(&self) -> bool;
    /// Share of the longest possible run that is done, 0 to 1.
    fn progress(&self) -> f64;
    /// Snapshot to write after the last row, if one is due.
    fn snapshot(&mut self) -> Option<Snapshot> {
        None
    }
    /// The particles as columns in seeding order: positions first (x, y, …).
    fn particles(&mut self) -> Vec<Column>;
    /// Time (s) of the phases before that of now, and words that name it in errors; of a run without phases none.
    fn before(&self) -> (f64, String) {
        Default::default()
    }
    /// The metrics at the end.
    fn metrics(&mut self) -> BTreeMap<String, Measured>;
    /// Work so far.
    fn work(&self) -> WorkDone;
    /// How far it has come between rows; nothing of a job that takes no steps.
    fn pulse(&self) -> Arc<Pulse> {
        Arc::default()
    }
    /// Where the time of the simulation of now went, as far as it tells.
    fn spent(&self) -> Spent {
        Spent::default()
    }
}
