//! Cases in which nothing moves: a row is an analysis of the discretisation.

use crate::job::Column;
use crate::prelude::*;
use crate::problem::measured;
use crate::record::Measured;
use mpm_core::{Memory, MemoryError};
use serde::de::DeserializeOwned;

/// An analysis of a discretisation in the plane.
pub(super) trait Analysis: Sized + Send {
    type Parameters: ParameterSet;
    /// Findings of a row. They go into checkpoints.
    type Found: Serialize + DeserializeOwned + Send;

    fn new(setup: Setup<Self::Parameters>) -> Result<Self, Error>;
    fn discretisation(&self) -> Discretisation;
    fn rows(&self) -> usize;
    fn analyse(&self, k: usize) -> Result<Self::Found, Fault>;
    fn row(&self, k: usize, found: &Self::Found) -> Row;
    /// Positions (m) of the particles.
    fn places(&self) -> Vec<[f64; 2]>;
    fn metrics(&self, found: &[Self::Found]) -> Vec<(Metric, f64)>;
    fn work(&self, found: &[Self::Found]) -> WorkDone;
}

/// Work of rows that each visit `pairs` of their `particles` with functions.
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

/// A case of the analysis `A` by name, title and metrics, with nothing else.
pub(super) fn case_of<A: Analysis + 'static>(name: &'static str, title: &'static str, metrics: &[Metric]) -> Case {
    Case::begun_by(name, title, metrics, A::Parameters::list(), Box::new(begin::<A>))
}

pub(super) fn begin<A: Analysis + 'static>(spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error> {
    let analysis = A::new(Setup::of_spec(spec, parameters)?)?;
    Ok(Box::new(Run { analysis, found: Vec::new() }))
}

struct Run<A: Analysis> {
    analysis: A,
    found: Vec<A::Found>,
}

impl<A: Analysis> Memory for Run<A> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&self.found)
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        self.found = saved.read("a case in which nothing moves")?;
        Ok(())
    }
}

impl<A: Analysis> Job for Run<A> {
    fn discretisation(&self) -> Discretisation {
        self.analysis.discretisation()
    }

    fn advance(&mut self) -> Result<Row, Fault> {
        let k = self.found.len();
        let found = self.analysis.analyse(k)?;
        let row = self.analysis.row(k, &found);
        self.found.push(found);
        Ok(row)
    }

    fn finished(&self) -> bool {
        self.found.len() >= self.analysis.rows()
    }

    fn progress(&self) -> f64 {
        self.found.len() as f64 / self.analysis.rows() as f64
    }

    fn particles(&mut self) -> Vec<Column> {
        let places = self.analysis.places();
        let column = |(name, a): (&'static str, usize)| Column {
            name,
            unit: "m",
            values: places.iter().map(|x| x[a]).collect(),
        };
        [("x", 0), ("y", 1)].map(column).into()
    }

    fn metrics(&mut self) -> BTreeMap<String, Measured> {
        self.analysis.metrics(&self.found).into_iter().map(measured).collect()
    }

    fn work(&self) -> WorkDone {
        self.analysis.work(&self.found)
    }
}
