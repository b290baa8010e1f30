//! The job of a case that takes a number of steps and looks at the state now and then.

use crate::drive::{Stage, Watch};
use crate::job::Column;
use crate::metric::Metric;
use crate::record::Discretisation;
use mpm_core::{Error, Simulation};
use serde::{Deserialize, Serialize};

/// What a case does of it.
pub(super) trait Course<const D: usize>: Send {
    /// The discretisation.
    fn discretisation(&self) -> Discretisation;
    /// Steps, and rows of the series.
    fn steps(&self) -> [u64; 2];
    /// The simulation at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    fn begin(&self) -> Result<Box<dyn Simulation<D>>, Error>;
    /// Names (with units) of the columns, time first.
    fn columns(&self) -> Vec<&'static str>;
    /// The row of now, time first.
    fn observe(&self, run: &mut dyn Simulation<D>) -> Vec<f64>;
    /// The particles: positions first.
    fn particles(&self, run: &mut dyn Simulation<D>) -> Vec<Column>;
    /// The metrics of all rows, that of the start first, and of the end.
    fn metrics(&self, rows: &[Vec<f64>], run: &mut dyn Simulation<D>) -> Vec<(Metric, f64)>;
}

/// The rows so far, that of the start first.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Rows(Vec<Vec<f64>>);

/// A course that is watched.
pub(super) struct Watched<C>(pub(super) C);

impl<const D: usize, C: Course<D>> Watch<D> for Watched<C> {
    type Seen = Rows;

    fn discretisation(&self) -> Discretisation {
        self.0.discretisation()
    }

    fn scene(&self, _: &Rows) -> Result<Box<dyn Simulation<D>>, Error> {
        self.0.begin()
    }

    fn columns(&self) -> Vec<&'static str> {
        self.0.columns()
    }

    fn row(&self, seen: &mut Rows, stage: &mut Stage<D>) -> Result<Vec<f64>, Error> {
        if seen.0.is_empty() {
            seen.0.push(self.0.observe(stage.run.as_mut()));
        }
        let [steps, rows] = self.0.steps();
        let to = (seen.0.len() as u64 * steps).div_ceil(rows);
        stage.steps(to - stage.run.work().steps)?;
        let row = self.0.observe(stage.run.as_mut());
        seen.0.push(row.clone());
        Ok(row)
    }

    fn progress(&self, _: &Rows, stage: &Stage<D>) -> f64 {
        let [steps, _] = self.0.steps();
        stage.run.work().steps as f64 / steps as f64
    }

    fn particles(&self, _: &Rows, stage: &mut Stage<D>) -> Vec<Column> {
        self.0.particles(stage.run.as_mut())
    }

    fn metrics(&self, seen: &Rows, stage: &mut Stage<D>) -> Vec<(Metric, f64)> {
        self.0.metrics(&seen.0, stage.run.as_mut())
    }
}
