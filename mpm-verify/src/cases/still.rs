//! The job of a case in which nothing moves: row by row, it looks at what the discretisation is worth.

use crate::job::{Column, Job};
use crate::metric::Metric;
use crate::record::{Discretisation, Measured, WorkDone};
use mpm_core::{Error, Memory, MemoryError, Saved};
use serde::{Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;

/// What a case looks at.
pub(super) trait Look: Send {
    /// What is found of a row.
    type Row: Serialize + DeserializeOwned + Send;

    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// Names (with units) of the columns of the series.
    fn columns(&self) -> Vec<&'static str>;
    /// How many rows there are.
    fn rows(&self) -> usize;
    /// Finds the `k`-th row.
    ///
    /// # Errors
    /// A matrix has no factors.
    fn look(&self, k: usize) -> Result<Self::Row, Error>;
    /// The `k`-th row of the series.
    fn numbers(&self, k: usize, row: &Self::Row) -> Vec<f64>;
    /// The particles: positions first.
    fn particles(&self) -> Vec<Column>;
    /// The metrics of all rows.
    fn metrics(&self, rows: &[Self::Row]) -> Vec<(Metric, f64)>;
    /// What the rows took.
    fn work(&self, rows: &[Self::Row]) -> WorkDone;
}

/// What rows took that each visit `pairs` of their `particles` with functions.
pub(super) fn visited(rows: usize, [particles, pairs]: [u64; 2]) -> WorkDone {
    let steps = rows as u64;
    WorkDone {
        particles,
        steps,
        particle_steps: steps * particles,
        particle_node_pairs: steps * pairs,
        ..WorkDone::default()
    }
}

/// A run of a [`Look`].
pub(super) struct Still<L: Look> {
    look: L,
    found: Vec<L::Row>,
}

impl<L: Look> Still<L> {
    /// A run that has found nothing yet.
    pub(super) fn new(look: L) -> Self {
        Self {
            look,
            found: Vec::new(),
        }
    }
}

impl<L: Look> Memory for Still<L> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&self.found)
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        self.found = saved.read("a case in which nothing moves")?;
        Ok(())
    }
}

impl<L: Look> Job for Still<L> {
    fn discretisation(&self) -> Discretisation {
        self.look.discretisation()
    }

    fn advance(&mut self) -> Result<crate::job::Row, Error> {
        let k = self.found.len();
        let row = self.look.look(k)?;
        let numbers = self.look.numbers(k, &row);
        self.found.push(row);
        Ok(crate::job::Row(
            self.look.columns().into_iter().zip(numbers).collect(),
        ))
    }

    fn finished(&self) -> bool {
        self.found.len() >= self.look.rows()
    }

    fn progress(&self) -> f64 {
        self.found.len() as f64 / self.look.rows() as f64
    }

    fn particles(&mut self) -> Vec<Column> {
        self.look.particles()
    }

    fn metrics(&mut self) -> BTreeMap<String, Measured> {
        let values = self.look.metrics(&self.found);
        values.into_iter().map(crate::drive::measured).collect()
    }

    fn work(&self) -> WorkDone {
        self.look.work(&self.found)
    }
}
