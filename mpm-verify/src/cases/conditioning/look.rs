//! A run: a row for every place of the body.

use super::forms::{Found, PARTICLES, Setting};
use super::metrics as m;
use crate::cases::still::{Look, visited};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::{Discretisation, WorkDone};
use crate::spec::RunSpec;

/// The half ellipse.
pub(super) struct Cuts {
    h: f64,
    setting: Setting,
}

impl Cuts {
    /// A run at its start.
    ///
    /// # Errors
    /// A scheme that is not solved here.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        Ok(Self {
            h: spec.level.h,
            setting: Setting::new(spec, parameters)?,
        })
    }
}

/// Least, mean and greatest.
fn spread(values: impl Iterator<Item = f64>) -> [f64; 3] {
    let (mut least, mut sum, mut most, mut count) = (f64::INFINITY, 0.0, f64::NEG_INFINITY, 0.0);
    for value in values {
        // What is no number stays none.
        (least, most) = (
            if value < least { value } else { least },
            if value > most { value } else { most },
        );
        (sum, count) = (sum + value, count + 1.0);
    }
    [least, sum / count, most]
}

impl Look for Cuts {
    type Row = Found;

    fn discretisation(&self) -> Discretisation {
        Discretisation {
            dim: 2,
            h: self.h,
            ppc: (PARTICLES * PARTICLES) as u32,
            // Nothing moves: any step will do, and a record has one.
            dt: 1.0,
            wall: "open-knot".to_owned(),
        }
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["shift (h)", "log10_cond_uu (-)", "log10_cond_pp (-)"]
    }

    fn rows(&self) -> usize {
        self.setting.positions()
    }

    fn look(&self, k: usize) -> Result<Found, mpm_core::Error> {
        self.setting.find(k)
    }

    fn numbers(&self, k: usize, found: &Found) -> Vec<f64> {
        vec![self.setting.shift(k), found.own[0], found.own[1]]
    }

    fn particles(&self) -> Vec<Column> {
        let places = self.setting.cloud(0).places;
        let column = |name, a: usize| Column {
            name,
            unit: "m",
            values: places.iter().map(|x| x[a]).collect(),
        };
        vec![column("x", 0), column("y", 1)]
    }

    fn metrics(&self, rows: &[Found]) -> Vec<(Metric, f64)> {
        let of = |k: usize| spread(rows.iter().map(|r| r.own[k]));
        let softest = |k: usize| spread(rows.iter().map(|r| r.softest[k]))[0];
        let whole = |k: usize| spread(rows.iter().filter_map(|r| Some(r.whole?[k])))[2];
        let pairs = rows.iter().zip(rows.iter().rev());
        let apart = spread(pairs.map(|(a, b)| (a.own[0] - b.own[0]).abs()));
        let ([u_least, u_mean, u], [p_least, p_mean, p]) = (of(0), of(1));
        vec![
            (m::COND_UU, u),
            (m::COND_UU_MEAN, u_mean),
            (m::COND_UU_LEAST, u_least),
            (m::COND_PP, p),
            (m::COND_PP_MEAN, p_mean),
            (m::COND_PP_LEAST, p_least),
            (m::COND, whole(0)),
            (m::COND_SCALED, whole(1)),
            (m::SOFTEST_UU, softest(0)),
            (m::SOFTEST_PP, softest(1)),
            (m::MIRROR_ERROR, apart[2]),
            (
                m::DEFLECTION_CHANGE,
                self.setting.deflection_change().unwrap_or(f64::NAN),
            ),
        ]
    }

    fn work(&self, rows: &[Found]) -> WorkDone {
        let particles = self.setting.cloud(0).places.len() as u64;
        visited(rows.len(), [particles, self.setting.pairs()])
    }
}
