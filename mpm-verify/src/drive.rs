//! The one job of every case: a simulation that goes from row to row, and what watches it.

use crate::job::{Column, Job, Pulse, Row, Snapshot};
use crate::metric::Metric;
pub use crate::problem::Phase as Stage;
use crate::record::{Discretisation, Measured, WorkDone};
use mpm_core::{Error, Memory, MemoryError, Saved, Simulation, Spent};
use serde::{Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Observer of a case's simulation: the scene it is in, the rows, the metrics. All that changes from row to row is in
/// [`Watch::Seen`].
pub trait Watch<const D: usize>: Send {
    /// Observed state of the rows so far. It goes into checkpoints.
    type Seen: Serialize + DeserializeOwned + Send;

    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// Initial simulation of the phase recorded in `seen`.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    fn scene(&self, seen: &Self::Seen) -> Result<Box<dyn Simulation<D>>, Error>;
    /// Names (with units) of the columns of the time series.
    fn columns(&self) -> Vec<&'static str>;
    /// Runs to the next time of observation, enters the next simulation if it is time, and returns that row.
    ///
    /// # Errors
    /// The computation broke down.
    fn row(&self, seen: &mut Self::Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, Error>;
    /// Share of the longest possible run that is done; at 1 the run is complete.
    fn progress(&self, seen: &Self::Seen, stage: &Stage<D>) -> f64;
    /// Snapshot to write after the last row, if one is due.
    fn snapshot(&self, _seen: &Self::Seen, _stage: &mut Stage<D>) -> Option<Snapshot> {
        None
    }
    /// The particles as columns in seeding order: positions first (x, y, …).
    fn particles(&self, seen: &Self::Seen, stage: &mut Stage<D>) -> Vec<Column>;
    /// The metrics at the end.
    fn metrics(&self, seen: &Self::Seen, stage: &mut Stage<D>) -> Vec<(Metric, f64)>;
}

/// A run of a [`Watch`].
pub struct Drive<const D: usize, W: Watch<D>> {
    watch: W,
    seen: W::Seen,
    stage: Stage<D>,
}

impl<const D: usize, W: Watch<D>> Drive<D, W> {
    /// A run at its start.
    ///
    /// # Errors
    /// As [`Watch::scene`].
    pub fn new(watch: W, seen: W::Seen) -> Result<Self, Error> {
        let stage = Stage::new(watch.scene(&seen)?);
        Ok(Self { watch, seen, stage })
    }
}

impl<const D: usize, W: Watch<D>> Memory for Drive<D, W> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(&self.seen, self.stage.before(), self.stage.run.save()?))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (seen, before, run): (W::Seen, WorkDone, Saved) = saved.read("a run")?;
        let scene = self.watch.scene(&seen);
        let mut scene = scene.map_err(|e| MemoryError::Scene(e.to_string()))?;
        scene.restore(&run)?;
        self.stage.reset(scene, before);
        self.seen = seen;
        Ok(())
    }
}

impl<const D: usize, W: Watch<D>> Job for Drive<D, W> {
    fn discretisation(&self) -> Discretisation {
        self.watch.discretisation()
    }

    fn advance(&mut self) -> Result<Row, Error> {
        let values = self.watch.row(&mut self.seen, &mut self.stage)?;
        Ok(Row(self.watch.columns().into_iter().zip(values).collect()))
    }

    fn finished(&self) -> bool {
        self.progress() >= 1.0
    }

    fn progress(&self) -> f64 {
        self.watch.progress(&self.seen, &self.stage)
    }

    fn snapshot(&mut self) -> Option<Snapshot> {
        self.watch.snapshot(&self.seen, &mut self.stage)
    }

    fn particles(&mut self) -> Vec<Column> {
        self.watch.particles(&self.seen, &mut self.stage)
    }

    fn metrics(&mut self) -> BTreeMap<String, Measured> {
        let values = self.watch.metrics(&self.seen, &mut self.stage);
        values.into_iter().map(measured).collect()
    }

    fn work(&self) -> WorkDone {
        self.stage.work()
    }

    fn pulse(&self) -> Arc<Pulse> {
        self.stage.pulse()
    }

    fn spent(&self) -> Spent {
        self.stage.run.spent()
    }
}

pub(crate) use crate::problem::measured;
