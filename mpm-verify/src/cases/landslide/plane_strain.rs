//! A slide in three dimensions with the same section in plane strain beside it.

use super::*;
use crate::job::{Column, Pulse};
use crate::problem::{Driver, measured};
use crate::record::Measured;
use mpm_core::memory::{Memory, MemoryError, Saved};

/// Columns of a slide's series that are shown of the section beside it.
const TOE: usize = 1;
const SETTLEMENT: usize = 3;

/// A slide and its section; work and particles are the slide's.
pub(super) struct Beside {
    slide: Driver<3, Slide<3>>,
    plane: Driver<2, Slide<2>>,
}

impl Beside {
    pub(super) fn new(spec: &RunSpec, values: &Parameters) -> Result<Self, Error> {
        let setup = Setup::<Landslide>::of_spec(spec, values)?;
        let slide = Driver::new(Slide::new(setup.clone())?)?;
        let plane = Driver::new(Slide::new(setup)?)?;
        Ok(Self { slide, plane })
    }
}

impl Memory for Beside {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.slide.save()?, self.plane.save()?))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (slide, plane): (Saved, Saved) = saved.read("the landslide")?;
        self.slide.restore(&slide)?;
        self.plane.restore(&plane)
    }
}

impl Job for Beside {
    fn discretisation(&self) -> Discretisation {
        self.slide.discretisation()
    }

    fn advance(&mut self) -> Result<Row, Fault> {
        let mut row = self.slide.advance()?;
        let plane = self.plane.advance()?.0;
        row.0.extend([("plane_strain_toe (m)", plane[TOE].1), ("plane_strain_settlement (m)", plane[SETTLEMENT].1)]);
        Ok(row)
    }

    fn finished(&self) -> bool {
        self.slide.finished()
    }

    fn progress(&self) -> f64 {
        self.slide.progress()
    }

    fn snapshot(&mut self) -> Option<Snapshot> {
        self.slide.snapshot()
    }

    fn particles(&mut self) -> Vec<Column> {
        self.slide.particles()
    }

    fn metrics(&mut self) -> BTreeMap<String, Measured> {
        let (slide, plane) = (self.slide.seen(), self.plane.seen());
        let ([rest, early], [plane_rest, plane_early]) = (slide.settlements(), plane.settlements());
        let relative = |a: f64, b: f64| (a - b) / b;
        let toes = [slide, plane].map(|seen| seen.series.rows.last().map_or(f64::NAN, |r| r.toe));
        let off = [
            (OFF_PLANE_STRAIN_AT_REST, relative(rest, plane_rest)),
            (OFF_PLANE_STRAIN_0_5S, relative(early, plane_early)),
            (OFF_PLANE_STRAIN_END, toes[0] - toes[1]),
        ];
        let mut metrics = self.slide.metrics();
        metrics.extend(off.map(measured));
        metrics
    }

    fn work(&self) -> WorkDone {
        self.slide.work()
    }

    fn pulse(&self) -> Arc<Pulse> {
        self.slide.pulse()
    }
}
