//! Probes of the membrane, and the metrics of its displacements and stresses, from any solver.

use super::reference::{LEFT_HEIGHT, Measure, RIGHT_HEIGHT};
use super::*;
use crate::probe::nearest;

/// Points on the right side whose mean is `edge_mean_uy`.
const EDGE_POINTS: usize = 8;

pub(super) struct Probes {
    /// Initial positions (m) of the particles.
    references: Vec<[f64; 2]>,
    pub(super) mid_edge: PointProbe,
    pub(super) tip: PointProbe,
    edge: Vec<PointProbe>,
    stress: Vec<(Metric, PointProbe)>,
    tip_particle: usize,
}

impl Probes {
    pub(super) fn new(references: Vec<[f64; 2]>, h: f64) -> Result<Self, Error> {
        let at = |[x, y]: [f64; 2]| {
            PointProbe::new(&references, [x, y], 2.0 * h)
                .ok_or_else(|| Error::Input(format!("no particles near ({x}, {y}) m to probe")))
        };
        let share = |k: usize| (k as f64 + 0.5) / EDGE_POINTS as f64;
        let on_edge = |k| at([LENGTH, LEFT_HEIGHT + RIGHT_HEIGHT * share(k)]);
        let stress = MEAN_STRESSES.iter().map(|(metric, place)| Ok((*metric, at(*place)?)));
        Ok(Self {
            mid_edge: at(MID_EDGE)?,
            tip: at(TIP)?,
            edge: (0..EDGE_POINTS).map(on_edge).collect::<Result<_, _>>()?,
            stress: stress.collect::<Result<_, Error>>()?,
            tip_particle: nearest(&references, TIP),
            references,
        })
    }

    /// Metrics of displacements along x and y (m).
    pub(super) fn of_displacement(&self, [ux, uy]: [&[f64]; 2], setup: &Setup<Cook>) -> Vec<(Metric, f64)> {
        let edge_mean = self.edge.iter().map(|p| p.value(uy)).sum::<f64>() / EDGE_POINTS as f64;
        let of = |measure: Measure| measure.of([self.mid_edge.value(uy), edge_mean, self.tip.value(uy)]);
        let mut values = vec![(TIP_UY_NEAREST, uy[self.tip_particle]), (TIP_UX, self.tip.value(ux))];
        for measure in Measure::ALL {
            let [metric, error] = measure.metrics();
            values.push((metric, of(measure)));
            if let Ok(reference) = setup.solution() {
                values.push((error, of(measure) / reference.of(measure) - 1.0));
            }
        }
        values
    }

    /// Metrics of the mean normal stress (Pa).
    pub(super) fn of_stress(&self, mean_stress: &[f64], setup: &Setup<Cook>) -> Vec<(Metric, f64)> {
        let error = setup.stress_error(&self.references, mean_stress);
        let mut values = vec![(MEAN_STRESS_RMS_ERROR, error), (MEAN_STRESS_RMS, rms(mean_stress.iter().copied()))];
        values.extend(self.stress.iter().map(|(metric, probe)| (*metric, probe.value(mean_stress))));
        values
    }
}
