//! A run: one row.

use super::forms::{Found, Setting, is_fitted};
use super::metrics as m;
use super::parameters::PARTICLES;
use crate::cases::still::{Look, visited};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::{Discretisation, WorkDone};
use crate::spec::RunSpec;

/// A body at one level.
pub(super) struct Undrained {
    spec: RunSpec,
    parameters: Parameters,
    setting: Setting,
}

impl Undrained {
    /// A run at its start.
    ///
    /// # Errors
    /// Parameters or a scheme that make no scene.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        Ok(Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            setting: Setting::new(spec, parameters)?,
        })
    }
}

impl Look for Undrained {
    type Row = Found;

    fn discretisation(&self) -> Discretisation {
        Discretisation {
            dim: 2,
            h: self.spec.level.h,
            ppc: (self.parameters.number(PARTICLES) as u32).pow(2),
            // Nothing moves: any step will do, and a record has one.
            dt: 1.0,
            wall: "open-knot".to_owned(),
        }
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "h (m)",
            "inf_sup (-)",
            "zero_modes (-)",
            "displacement_error (-)",
            "pressure_error (-)",
            "checkerboard_ratio (-)",
        ]
    }

    fn rows(&self) -> usize {
        1
    }

    fn look(&self, _: usize) -> Result<Found, mpm_core::Error> {
        self.setting.find()
    }

    fn numbers(&self, _: usize, found: &Found) -> Vec<f64> {
        let [u, p, c] = self.errors(found);
        vec![self.spec.level.h, found.inf_sup, found.zero_modes, u, p, c]
    }

    fn particles(&self) -> Vec<Column> {
        let places = self.setting.places();
        let column = |name, a: usize| Column {
            name,
            unit: "m",
            values: places.iter().map(|x| x[a]).collect(),
        };
        vec![column("x", 0), column("y", 1)]
    }

    fn metrics(&self, rows: &[Found]) -> Vec<(Metric, f64)> {
        let Some(found) = rows.first() else {
            return Vec::new();
        };
        let mut all = vec![
            (m::INF_SUP, found.inf_sup),
            (m::ZERO_MODES, found.zero_modes),
            (m::UNKNOWNS, found.unknowns[0]),
            (m::PRESSURES, found.unknowns[1]),
        ];
        if is_fitted(&self.parameters) {
            let names = [
                m::DISPLACEMENT_ERROR,
                m::PRESSURE_ERROR,
                m::CHECKERBOARD_RATIO,
            ];
            all.extend(names.into_iter().zip(found.errors));
        }
        all
    }

    fn work(&self, rows: &[Found]) -> WorkDone {
        visited(rows.len(), self.setting.work())
    }
}

impl Undrained {
    /// Zero of the ellipse, whose exact motion is not known.
    fn errors(&self, found: &Found) -> [f64; 3] {
        match is_fitted(&self.parameters) {
            true => found.errors,
            false => [0.0; 3],
        }
    }
}
