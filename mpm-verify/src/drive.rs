//! The one job of every case: a simulation that goes from row to row, and what watches it.

use crate::job::{Column, Job, Pulse, Snapshot};
use crate::metric::Metric;
use crate::record::{Discretisation, Measured, WorkDone};
use mpm_core::{Error, Memory, MemoryError, Saved, Simulation, Spent};
use serde::{Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The simulation of now. A run may be made of several, one after the other: a gravity stage, then the flow.
pub struct Stage<const D: usize> {
    /// The simulation.
    pub run: Box<dyn Simulation<D>>,
    /// Work of those before it.
    before: WorkDone,
    pulse: Arc<Pulse>,
}

impl<const D: usize> Stage<D> {
    /// Advances by so many steps.
    ///
    /// # Errors
    /// The computation broke down.
    pub fn steps(&mut self, count: u64) -> Result<(), Error> {
        (0..count).try_for_each(|_| {
            self.run.step()?;
            self.pulse.beat(self.run.time());
            Ok(())
        })
    }

    /// Goes on with another simulation: with its own body, or with that of an earlier one.
    ///
    /// # Errors
    /// The body is not one of the same particles, basis, remedy, transfer and kind of law.
    pub fn enter(
        &mut self,
        mut next: Box<dyn Simulation<D>>,
        body: Option<&Saved>,
    ) -> Result<(), Error> {
        if let Some(body) = body {
            next.take_over(body)?;
        }
        self.before = self.work();
        self.run = next;
        Ok(())
    }

    /// Work so far, of all simulations.
    #[must_use]
    pub fn work(&self) -> WorkDone {
        WorkDone::from(self.run.work()).after(self.before)
    }
}

/// What a case does with its simulation: which scene it is in, what a row is, what is measured. All that changes from
/// row to row is in [`Watch::Seen`].
pub trait Watch<const D: usize>: Send {
    /// What is remembered of the rows so far. It goes into checkpoints.
    type Seen: Serialize + DeserializeOwned + Send;

    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// The simulation, at its start, that a run is in when this has been seen.
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
    /// What is kept of the state after the last row, if it is time to keep something.
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
        let stage = Stage {
            run: watch.scene(&seen)?,
            before: WorkDone::default(),
            pulse: Arc::default(),
        };
        Ok(Self { watch, seen, stage })
    }
}

impl<const D: usize, W: Watch<D>> Drive<D, W> {
    /// What has been seen so far.
    pub(crate) fn seen(&self) -> &W::Seen {
        &self.seen
    }

    /// What a test looks into.
    #[cfg(test)]
    pub(crate) fn parts(&mut self) -> (&W, &mut W::Seen, &mut Stage<D>) {
        (&self.watch, &mut self.seen, &mut self.stage)
    }
}

impl<const D: usize, W: Watch<D>> Memory for Drive<D, W> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(&self.seen, self.stage.before, self.stage.run.save()?))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (seen, before, run): (W::Seen, WorkDone, Saved) = saved.read("a run")?;
        let scene = self.watch.scene(&seen);
        let mut scene = scene.map_err(|e| MemoryError::Scene(e.to_string()))?;
        scene.restore(&run)?;
        (self.stage.run, self.stage.before) = (scene, before);
        self.seen = seen;
        Ok(())
    }
}

impl<const D: usize, W: Watch<D>> Job for Drive<D, W> {
    fn discretisation(&self) -> Discretisation {
        self.watch.discretisation()
    }

    fn series_columns(&self) -> Vec<&'static str> {
        self.watch.columns()
    }

    fn advance(&mut self) -> Result<Vec<f64>, Error> {
        self.watch.row(&mut self.seen, &mut self.stage)
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
        Arc::clone(&self.stage.pulse)
    }

    fn spent(&self) -> Spent {
        self.stage.run.spent()
    }
}

/// A metric as a record has it: what is not finite has no value.
pub(crate) fn measured((metric, value): (Metric, f64)) -> (String, Measured) {
    let measured = Measured {
        value: value.is_finite().then_some(value),
        unit: metric.unit.to_owned(),
    };
    (metric.name.to_owned(), measured)
}
