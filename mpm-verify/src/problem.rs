//! The problem of a case: what it simulates, observes and measures; and its one driver.

use crate::error::Error;
use crate::exact::common::DIMENSION;
use crate::job::{Column, Job, Pulse, Row, Snapshot};
use crate::metric::Metric;
use crate::parameter::{ParameterSet, Parameters};
use crate::record::{Discretisation, Measured, WorkDone};
use crate::setup::Setup;
use crate::spec::RunSpec;
use mpm_core::{Field, Memory, MemoryError, Particles, Saved, Simulation, Spent};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A simulation at its start, or the reason why it can't begin.
pub(crate) type Begun<const D: usize> = Result<Box<dyn Simulation<D>>, mpm_core::Error>;

/// The current simulation of a run, which may consist of several in sequence: a gravity phase, then the flow.
pub(crate) struct Phase<const D: usize> {
    /// The simulation.
    pub run: Box<dyn Simulation<D>>,
    /// Work of those before it.
    before: WorkDone,
    pulse: Arc<Pulse>,
}

impl<const D: usize> Phase<D> {
    pub(crate) fn new(run: Box<dyn Simulation<D>>) -> Self {
        Self { run, before: WorkDone::default(), pulse: Arc::default() }
    }

    /// Advances by `count` steps.
    ///
    /// # Errors
    /// The computation broke down.
    pub(crate) fn steps(&mut self, count: u64) -> Result<(), mpm_core::Error> {
        (0..count).try_for_each(|_| {
            self.run.step()?;
            self.pulse.beat(self.run.time());
            Ok(())
        })
    }

    /// Advances by `count` steps, and counts the iterations of Newton's method in them.
    ///
    /// # Errors
    /// The computation broke down.
    pub(crate) fn iterate(&mut self, count: u64) -> Result<u64, mpm_core::Error> {
        let before = self.run.work().newton_iterations;
        self.steps(count)?;
        Ok(self.run.work().newton_iterations - before)
    }

    /// Continues with another simulation: with its own body, or with that of an earlier one.
    ///
    /// # Errors
    /// The body is not one of the same particles, basis, remedy, transfer and kind of law.
    pub(crate) fn enter(
        &mut self,
        mut next: Box<dyn Simulation<D>>,
        body: Option<&Saved>,
    ) -> Result<(), mpm_core::Error> {
        if let Some(body) = body {
            next.take_over(body)?;
        }
        self.before = self.work();
        self.run = next;
        Ok(())
    }

    /// Work so far, of all simulations.
    pub(crate) fn work(&self) -> WorkDone {
        WorkDone::from(self.run.work()).after(self.before)
    }

    /// Share of `steps` steps that the current simulation has done.
    pub(crate) fn share_of(&self, steps: u64) -> f64 {
        self.run.work().steps as f64 / steps as f64
    }
}

/// Problem of a case: simulation, observation, metrics. All that changes from row to row is in [`Problem::Seen`].
pub(crate) trait Problem<const D: usize>: Sized + Send {
    type Parameters;
    /// Observations of the rows so far. They go into checkpoints.
    type Seen: Default + Serialize + DeserializeOwned + Send;

    /// The problem of a setup.
    fn new(setup: Setup<Self::Parameters>) -> Result<Self, Error>;
    /// Observations before the first row.
    fn unseen(&self) -> Self::Seen {
        Self::Seen::default()
    }
    fn discretisation(&self) -> Discretisation;
    /// Initial simulation of the phase that `seen` records.
    fn begin(&self, seen: &Self::Seen) -> Begun<D>;
    /// Runs to the next time of observation, enters the next simulation if one is due, and returns the row of the series.
    fn row(&self, seen: &mut Self::Seen, phase: &mut Phase<D>) -> Result<Row, mpm_core::Error>;
    /// Share of the longest possible run that is done; at 1 the run is complete.
    fn progress(&self, seen: &Self::Seen, phase: &Phase<D>) -> f64;
    /// Snapshot to write after the last row, if one is due.
    fn snapshot(&self, _seen: &Self::Seen, _phase: &mut Phase<D>) -> Option<Snapshot> {
        None
    }
    /// A snapshot at a time (s), with what is kept of the particles at the end.
    fn snapshot_at(&self, time: f64, seen: &Self::Seen, phase: &mut Phase<D>) -> Snapshot {
        Snapshot { time, columns: self.particles(seen, Columns::positions(phase.run.as_mut())).done() }
    }
    /// As [`Job::before`].
    fn before(&self, _seen: &Self::Seen) -> (f64, String) {
        Default::default()
    }
    /// Adds what is kept of the particles at the end to the `columns` with their positions.
    fn particles<'a>(&self, _seen: &Self::Seen, columns: Columns<'a, D>) -> Columns<'a, D> {
        columns
    }
    /// The metrics at the end.
    fn metrics(&self, seen: &Self::Seen, phase: &mut Phase<D>) -> Vec<(Metric, f64)>;
}

/// Begins a run of the problem `P` in `D` dimensions.
///
/// # Errors
/// Parameters that make no scene.
pub(crate) fn begin<const D: usize, P: Problem<D> + 'static>(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Job>, Error>
where
    P::Parameters: ParameterSet,
{
    Ok(Box::new(Driver::new(P::new(Setup::of_spec(spec, parameters)?)?)?))
}

/// The same in as many dimensions as the parameter `dimension` says: in `A` of them, or else in `B`.
///
/// # Errors
/// Those of [`begin`].
pub(crate) fn begin_in<const A: usize, const B: usize, P>(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Job>, Error>
where
    P: Problem<A, Parameters: ParameterSet> + Problem<B, Parameters: ParameterSet> + 'static,
{
    match parameters.number(DIMENSION) == A as f64 {
        true => begin::<A, P>(spec, parameters),
        false => begin::<B, P>(spec, parameters),
    }
}

/// A run of a [`Problem`].
pub(crate) struct Driver<const D: usize, P: Problem<D>> {
    problem: P,
    seen: P::Seen,
    phase: Phase<D>,
}

impl<const D: usize, P: Problem<D>> Driver<D, P> {
    /// A run at its start.
    pub(crate) fn new(problem: P) -> Result<Self, Error> {
        let seen = problem.unseen();
        let phase = Phase::new(problem.begin(&seen)?);
        Ok(Self { problem, seen, phase })
    }

    pub(crate) fn seen(&self) -> &P::Seen {
        &self.seen
    }

    /// The parts, for tests.
    #[cfg(test)]
    pub(crate) fn parts(&mut self) -> (&P, &mut P::Seen, &mut Phase<D>) {
        (&self.problem, &mut self.seen, &mut self.phase)
    }
}

impl<const D: usize, P: Problem<D>> Memory for Driver<D, P> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(&self.seen, self.phase.before, self.phase.run.save()?))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (seen, before, run): (P::Seen, WorkDone, Saved) = saved.read("a run")?;
        let scene = self.problem.begin(&seen);
        let mut scene = scene.map_err(|e| MemoryError::Scene(e.to_string()))?;
        scene.restore(&run)?;
        (self.phase.run, self.phase.before) = (scene, before);
        self.seen = seen;
        Ok(())
    }
}

impl<const D: usize, P: Problem<D>> Job for Driver<D, P> {
    fn discretisation(&self) -> Discretisation {
        self.problem.discretisation()
    }

    fn advance(&mut self) -> Result<Row, mpm_core::Error> {
        self.problem.row(&mut self.seen, &mut self.phase)
    }

    fn finished(&self) -> bool {
        self.progress() >= 1.0
    }

    fn progress(&self) -> f64 {
        self.problem.progress(&self.seen, &self.phase)
    }

    fn snapshot(&mut self) -> Option<Snapshot> {
        self.problem.snapshot(&self.seen, &mut self.phase)
    }

    fn particles(&mut self) -> Vec<Column> {
        self.problem.particles(&self.seen, Columns::positions(self.phase.run.as_mut())).done()
    }

    fn before(&self) -> (f64, String) {
        self.problem.before(&self.seen)
    }

    fn metrics(&mut self) -> BTreeMap<String, Measured> {
        self.problem.metrics(&self.seen, &mut self.phase).into_iter().map(measured).collect()
    }

    fn work(&self) -> WorkDone {
        self.phase.work()
    }

    fn pulse(&self) -> Arc<Pulse> {
        Arc::clone(&self.phase.pulse)
    }

    fn spent(&self) -> Spent {
        self.phase.run.spent()
    }
}

/// A metric as a record has it: a value that is not finite is missing.
pub(crate) fn measured((metric, value): (Metric, f64)) -> (String, Measured) {
    (metric.name.to_owned(), Measured::of(value, metric.unit))
}

/// All rows of a run so far, that of the start first: the observations of a problem that is sampled at equal intervals.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct Rows {
    names: Vec<String>,
    values: Vec<Vec<f64>>,
}

impl Rows {
    /// Runs to the next of `rows` equal intervals of `steps` steps, and observes.
    pub(crate) fn sample<const D: usize>(
        &mut self,
        phase: &mut Phase<D>,
        [steps, rows]: [u64; 2],
        observe: impl Fn(&mut dyn Simulation<D>) -> Row,
    ) -> Result<Row, mpm_core::Error> {
        if self.values.is_empty() {
            let Row(first) = observe(phase.run.as_mut());
            self.names = first.iter().map(|(name, _)| (*name).to_owned()).collect();
            self.values.push(first.into_iter().map(|(_, value)| value).collect());
        }
        let to = (self.values.len() as u64 * steps).div_ceil(rows);
        phase.steps(to - phase.run.work().steps)?;
        let row = observe(phase.run.as_mut());
        self.values.push(row.0.iter().map(|(_, value)| *value).collect());
        Ok(row)
    }

    /// Values of the column whose name, before its unit, is `name`, that of the start first; NaN without such a column.
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let own = |full: &String| full.split(" (").next() == Some(name);
        let place = self.names.iter().position(own).unwrap_or(usize::MAX);
        self.values.iter().map(|row| row.get(place).copied().unwrap_or(f64::NAN)).collect()
    }

    /// Two columns as points.
    pub(crate) fn points(&self, [x, y]: [&str; 2]) -> Vec<(f64, f64)> {
        self.column(x).into_iter().zip(self.column(y)).collect()
    }
}

/// The particles of a run as columns in seeding order.
pub(crate) struct Columns<'a, const D: usize> {
    run: &'a mut dyn Simulation<D>,
    columns: Vec<Column>,
}

impl<'a, const D: usize> Columns<'a, D> {
    /// Positions x, y, z (m).
    pub(crate) fn positions(run: &'a mut dyn Simulation<D>) -> Self {
        Self { run, columns: Vec::new() }.axes(["x", "y", "z"], "m", |p, k| p.position[k])
    }

    pub(crate) fn run(&mut self) -> &mut dyn Simulation<D> {
        self.run
    }

    /// Positions in the reference configuration (m).
    pub(crate) fn references(self) -> Self {
        self.axes(["reference_x", "reference_y", "reference_z"], "m", |p, k| p.reference[k])
    }

    /// Displacements (m).
    pub(crate) fn displacements(self) -> Self {
        self.axes(["ux", "uy", "uz"], "m", |p, k| std::array::from_fn(|a| p.position[k][a] - p.reference[k][a]))
    }

    /// Velocities (m/s).
    pub(crate) fn velocities(self) -> Self {
        self.axes(["vx", "vy", "vz"], "m/s", |p, k| p.velocity[k])
    }

    /// A vector, a column an axis.
    pub(crate) fn axes(
        mut self,
        names: [&'static str; 3],
        unit: &'static str,
        of: impl Fn(&Particles<D>, usize) -> [f64; D],
    ) -> Self {
        for (axis, name) in names.into_iter().take(D).enumerate() {
            self = self.each(name, unit, |p, k| of(p, k)[axis]);
        }
        self
    }

    /// A number of each particle.
    pub(crate) fn each(
        mut self,
        name: &'static str,
        unit: &'static str,
        of: impl Fn(&Particles<D>, usize) -> f64,
    ) -> Self {
        let p = self.run.particles();
        self.columns.push(Column { name, unit, values: p.seeded(|k| of(p, k)) });
        self
    }

    pub(crate) fn field(self, name: &'static str, unit: &'static str, field: Field) -> Self {
        let values = self.run.field(field);
        self.each(name, unit, |_, k| values[k])
    }

    /// A component of the Cauchy stress (Pa), as it enters the forces.
    pub(crate) fn stress(self, name: &'static str, [i, j]: [usize; 2]) -> Self {
        let stress = self.run.force_stress();
        self.each(name, "Pa", |_, k| stress[k].get(i, j))
    }

    /// The volume ratio J.
    pub(crate) fn jacobian(self) -> Self {
        self.each("jacobian", "-", |p, k| p.jacobian[k])
    }

    /// A column whose `values` are in seeding order.
    pub(crate) fn seeded(mut self, name: &'static str, unit: &'static str, values: Vec<f64>) -> Self {
        self.columns.push(Column { name, unit, values });
        self
    }

    pub(crate) fn done(self) -> Vec<Column> {
        self.columns
    }
}
