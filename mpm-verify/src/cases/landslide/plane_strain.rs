//! A slide in three dimensions with the same section in plane strain beside it.

use super::metrics as m;
use super::watch::Slide;
use crate::drive::{Drive, measured};
use crate::error::Error;
use crate::job::{Column, Job, Pulse, Row, Snapshot};
use crate::parameter::Parameters;
use crate::record::{Discretisation, Measured, WorkDone};
use crate::spec::RunSpec;
use mpm_core::memory::{Memory, MemoryError, Saved};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Columns of a slide's series that are shown of the section beside it.
const TOE: usize = 1;
const SETTLEMENT: usize = 3;

/// A slide and its section; work and particles are the slide's.
pub(super) struct Beside {
    slide: Drive<3, Slide<3>>,
    plane: Drive<2, Slide<2>>,
}

impl Beside {
    /// Both at their start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        Ok(Self {
            slide: Slide::<3>::drive(spec, parameters)?,
            plane: Slide::<2>::drive(spec, parameters)?,
        })
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

    fn advance(&mut self) -> Result<Row, mpm_core::Error> {
        let mut row = self.slide.advance()?;
        let plane = self.plane.advance()?.0;
        row.0.extend([
            ("plane_strain_toe (m)", plane[TOE].1),
            ("plane_strain_settlement (m)", plane[SETTLEMENT].1),
        ]);
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
            (m::OFF_PLANE_STRAIN_AT_REST, relative(rest, plane_rest)),
            (m::OFF_PLANE_STRAIN_0_5S, relative(early, plane_early)),
            (m::OFF_PLANE_STRAIN_END, toes[0] - toes[1]),
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
