//! Where the membrane is probed, and what is measured there of its displacements and stresses, whoever computed them.

use super::geometry::{LEFT_HEIGHT, LENGTH, RIGHT_HEIGHT, away_from_singularities};
use super::metrics::{self as m, MEAN_STRESSES};
use super::reference::{Field as Reference, solution, stress_scale};
use crate::error::Error;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::probe::{PointProbe, nearest};
use crate::statistics::rms;

/// Points on the right side whose mean is `edge_mean_uy`.
const EDGE_POINTS: usize = 8;

/// Where the membrane is probed.
pub(super) struct Probes {
    pub(super) mid_edge: PointProbe,
    pub(super) tip: PointProbe,
    edge: Vec<PointProbe>,
    stress: Vec<(Metric, PointProbe)>,
    tip_particle: usize,
}

impl Probes {
    /// In particles at `references` (m), each within `radius` (m).
    ///
    /// # Errors
    /// Too few particles.
    pub(super) fn new(references: &[[f64; 2]], radius: f64) -> Result<Self, Error> {
        let at = |x: f64, y: f64| {
            PointProbe::new(references, [x, y], radius)
                .ok_or_else(|| Error::Input(format!("no particles near ({x}, {y}) m to probe")))
        };
        let tip = LEFT_HEIGHT + RIGHT_HEIGHT;
        let share = |k: usize| (k as f64 + 0.5) / EDGE_POINTS as f64;
        Ok(Self {
            mid_edge: at(LENGTH, LEFT_HEIGHT + 0.5 * RIGHT_HEIGHT)?,
            tip: at(LENGTH, tip)?,
            edge: (0..EDGE_POINTS)
                .map(|k| at(LENGTH, LEFT_HEIGHT + RIGHT_HEIGHT * share(k)))
                .collect::<Result<_, _>>()?,
            stress: MEAN_STRESSES
                .iter()
                .map(|(metric, [x, y])| Ok((*metric, at(*x, *y)?)))
                .collect::<Result<_, Error>>()?,
            tip_particle: nearest(references, [LENGTH, tip]),
        })
    }

    fn edge_mean(&self, uy: &[f64]) -> f64 {
        self.edge.iter().map(|p| p.value(uy)).sum::<f64>() / EDGE_POINTS as f64
    }

    /// What is measured of displacements along x and y (m).
    pub(super) fn of_displacement(&self, [ux, uy]: [&[f64]; 2], parameters: &Parameters) -> Vec<(Metric, f64)> {
        let mid_edge = self.mid_edge.value(uy);
        let edge_mean = self.edge_mean(uy);
        let tip = self.tip.value(uy);
        let mut values = vec![
            (m::MID_EDGE_UY, mid_edge),
            (m::EDGE_MEAN_UY, edge_mean),
            (m::TIP_UY, tip),
            (m::TIP_UY_NEAREST, uy[self.tip_particle]),
            (m::TIP_UX, self.tip.value(ux)),
        ];
        if let Ok(reference) = solution(parameters) {
            let errors = [
                (m::FEM_MID_EDGE_ERROR, mid_edge / reference.mid_edge.uy),
                (m::FEM_EDGE_MEAN_ERROR, edge_mean / reference.edge_mean_uy),
                (m::FEM_TIP_ERROR, tip / reference.tip.uy),
            ];
            values.extend(errors.map(|(metric, ratio)| (metric, ratio - 1.0)));
        }
        values
    }

    /// What is measured of the mean normal stress (Pa) of particles at `references` (m).
    pub(super) fn of_stress(
        &self,
        references: &[[f64; 2]],
        mean_stress: &[f64],
        parameters: &Parameters,
    ) -> Vec<(Metric, f64)> {
        let error = stress_error(references, parameters, mean_stress);
        let mut values =
            vec![(m::MEAN_STRESS_RMS_ERROR, error), (m::MEAN_STRESS_RMS, rms(mean_stress.iter().copied()))];
        let probed = self.stress.iter();
        values.extend(probed.map(|(metric, probe)| (*metric, probe.value(mean_stress))));
        values
    }
}

/// Rms over the particles at `references` (m) of the mean stress (Pa) less the reference, where that is known.
fn stress_error(references: &[[f64; 2]], parameters: &Parameters, mean_stress: &[f64]) -> f64 {
    if !solution(parameters).is_ok_and(|s| s.poisson_ratio == 0.499) {
        return f64::NAN;
    }
    let (field, scale) = (Reference::stored(), stress_scale(parameters));
    let counted = references.iter().zip(mean_stress);
    let off = counted
        .filter(|(x, _)| away_from_singularities(x))
        .filter_map(|(x, s)| Some(s - scale * field.interpolate(*x)?));
    rms(off)
}
