//! Metrics of the beam's free end and of its stresses, for our runs and for other codes, and the finite elements of high order that
//! they are compared with, at one load and three laws.

use super::*;
use crate::exact::cantilever::{self, Solution, Stresses};

/// Particles, column by column, and probes of the stress.
pub(super) struct Edge {
    pub(super) references: Vec<[f64; 2]>,
    /// Particles along the length and the depth.
    counts: [usize; 2],
    stress: Vec<(Metric, [f64; 2], PointProbe)>,
}

impl Edge {
    pub(super) fn new(setup: &Setup<Cantilever>) -> Self {
        let references = setup.seed();
        let probe = |&(metric, at)| Some((metric, at, PointProbe::new(&references, at, setup.h)?));
        let stress = STRESSES.iter().filter_map(probe).collect();
        Self { references, counts: setup.counts(), stress }
    }

    /// A field, in seeding order, extrapolated to the right side at every row of particles, from below.
    fn at_edge(&self, field: &[f64]) -> Vec<f64> {
        let [along, up] = self.counts;
        (0..up)
            .map(|row| {
                let [a, b] = [1, 2].map(|k| (along - k) * up + row);
                let [xa, xb] = [a, b].map(|k| self.references[k][0]);
                field[a] + (field[a] - field[b]) * (LENGTH - xa) / (xa - xb)
            })
            .collect()
    }

    /// Value at the corner of a displacement (m), and mean over the right side.
    pub(super) fn tip(&self, displacement: &[f64]) -> [f64; 2] {
        let edge = self.at_edge(displacement);
        let [y0, y1] = [0, 1].map(|row| self.references[row][1]);
        let corner = edge[0] - (edge[1] - edge[0]) * y0 / (y1 - y0);
        [corner, mean(edge)]
    }

    /// Metrics of the displacements along x and y (m).
    pub(super) fn of_displacement(&self, [ux, uy]: [&[f64]; 2], setup: &Setup<Cantilever>) -> Vec<(Metric, f64)> {
        let ([corner_x, mean_x], [corner_y, mean_y]) = (self.tip(ux), self.tip(uy));
        let mut values =
            vec![(CORNER_UX, corner_x), (CORNER_UY, corner_y), (EDGE_MEAN_UX, mean_x), (EDGE_MEAN_UY, mean_y)];
        if let Ok(truth) = setup.solution() {
            let [_, corner] = truth.bottom_right;
            values.push((CORNER_ERROR, (corner_y / corner - 1.0).abs()));
            if let Some([_, mean]) = truth.right_edge_mean {
                values.push((EDGE_MEAN_ERROR, (mean_y / mean - 1.0).abs()));
            }
        }
        values
    }

    /// Metrics of σ_xx (Pa): extremes, values at the points of the reference, and their error where it is known.
    pub(super) fn of_stress(&self, field: &[f64], setup: &Setup<Cantilever>) -> Vec<(Metric, f64)> {
        let [least, greatest] = extremes(field);
        let mut values = vec![(STRESS_MIN, least), (STRESS_MAX, greatest)];
        let mut squares = [0.0; 2];
        let known = setup.stresses();
        for (metric, at, probe) in &self.stress {
            let value = probe.value(field);
            values.push((*metric, value));
            if let Some(exact) = known.as_ref().ok().and_then(|known| known.at(*at)) {
                squares[0] += (value - exact.value).powi(2);
                squares[1] += exact.value.powi(2);
            }
        }
        if squares[1] > 0.0 {
            values.push((STRESS_ERROR, (squares[0] / squares[1]).sqrt()));
        }
        values
    }
}

pub(super) fn extremes(field: &[f64]) -> [f64; 2] {
    (field.iter()).fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], s| [lo.min(*s), hi.max(*s)])
}

impl Setup<Cantilever> {
    /// The stresses; those of rate laws are not known.
    pub(super) fn stresses(&self) -> Result<&'static Stresses, String> {
        let stored = cantilever::stresses().ok_or("the stored stresses can't be read")?;
        self.solution()?;
        if self.young_modulus != 1e5 {
            return Err("the reference is for E = 100 kPa".to_owned());
        }
        match self.law {
            LawName::Hencky => Ok(&stored.hencky),
            LawName::NeoHookean => Ok(&stored.neo_hookean),
            _ => Err("no reference stresses of Jaumann's law".to_owned()),
        }
    }

    /// The solution: displacements depend on ν and weight over E alone.
    pub(super) fn solution(&self) -> Result<&'static Solution, String> {
        let stored = cantilever::solutions().ok_or("the stored reference can't be read")?;
        let load = self.weight / self.young_modulus;
        if (load - 0.04).abs() > 1e-12 || self.poisson_ratio != 0.0 {
            return Err("the reference is for ν = 0 and weight/E = 0.04/m".to_owned());
        }
        Ok(match self.law {
            LawName::Hencky => &stored.hencky,
            LawName::NeoHookean => &stored.neo_hookean,
            _ => &stored.jaumann,
        })
    }
}
