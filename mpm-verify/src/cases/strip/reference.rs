//! Finite elements of Taylor and Hood at small strain: `references/strip_fem.py`.

use super::*;
use std::sync::OnceLock;

const SOLUTIONS: &str = include_str!("../../../references/strip.json");
/// The largest load (Pa) that is small.
const LARGEST: f64 = 1e3;
/// A conductivity (m/s) at which no water flows in a run's time.
const NOTHING: f64 = 1e-12;
/// Unit of the pressures of the file.
const UNIT: f64 = 1e-5;

#[derive(Debug, Deserialize)]
struct Document {
    strip: Solutions,
    square: Solutions,
}

#[derive(Debug, Deserialize)]
struct Solutions {
    drained: Vec<Solution>,
    undrained: Vec<Solution>,
}

/// A solution at the particles of cells of one size, of a square at those next to a plane of symmetry.
#[derive(Debug, Deserialize)]
pub(super) struct Solution {
    h: f64,
    /// Settlement of the particle next to the axis at the surface, times G over the load (m).
    pub(super) settlement: f64,
    pub(super) settlement_uncertainty: f64,
    pressure: Vec<f64>,
}

impl Solution {
    /// Pressure over the load at the particle in column `i` and row `j` of particles `spacing` (m) apart.
    pub(super) fn pressure(&self, i: usize, j: usize) -> f64 {
        let row = (self.pressure.len() as f64).sqrt().round() as usize;
        self.pressure.get(j * row + i).map_or(f64::NAN, |p| UNIT * p)
    }
}

fn document() -> Option<&'static Document> {
    static READ: OnceLock<Option<Document>> = OnceLock::new();
    READ.get_or_init(|| serde_json::from_str(SOLUTIONS).ok()).as_ref()
}

impl Setup<Strip> {
    /// Whether no water flows in a run's time.
    pub(super) fn is_undrained(&self) -> bool {
        self.conductivity <= NOTHING
    }

    /// The solution that a run should have, if there is one.
    pub(super) fn reference(&self) -> Option<&'static Solution> {
        let elastic = self.law == Soil::Elastic && self.half_width == 1.0 && self.poisson_ratio == 0.25;
        let small = self.load <= LARGEST;
        let steps = self.steps == 20 && self.duration == 2000.0 && self.conductivity == 1e-6;
        let moduli = self.young_modulus == 1e6 && self.porosity == 0.4;
        if !(elastic && small && moduli && (self.is_undrained() || steps)) {
            return None;
        }
        let all = document()?;
        let all = if self.dimension == 3 { &all.square } else { &all.strip };
        let of = if self.is_undrained() { &all.undrained } else { &all.drained };
        of.iter().find(|s| (s.h - self.h).abs() < 1e-9 * self.h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_size_has_its_pressures() {
        let all = document().unwrap();
        for (of, levels) in [(&all.strip, 3), (&all.square, 2)] {
            for s in of.drained.iter().chain(&of.undrained) {
                let row = (10.0 / s.h).round() as usize;
                assert_eq!(s.pressure.len(), row * row);
                assert!(s.settlement_uncertainty < 2e-3);
            }
            assert_eq!(of.drained.len(), levels);
        }
    }

    /// The pressure of deep undrained ground is the mean stress in the plane, which under a strip is the angle that it is
    /// seen by over π, Flamant's solution integrated over the strip. The ground ends at five half widths.
    #[test]
    fn undrained_pressure_is_boussinesqs_mean_stress() {
        let all = document().unwrap();
        let fine = &all.strip.undrained[2];
        for row in 60..80 {
            let depth = 5.0 - (row as f64 + 0.5) * 0.0625;
            let x = 0.03125_f64;
            let seen = ((1.0 - x) / depth).atan() + ((1.0 + x) / depth).atan();
            let exact = seen / std::f64::consts::PI;
            assert!((fine.pressure(0, row) - exact).abs() < 0.06, "{depth}");
        }
    }

    /// Below a square the mean stress is the solid angle that it is seen by over 2π. Near a corner of the square a
    /// right-angled part of a by b in the depth z fills atan(ab / (z √(a² + b² + z²))) of it.
    #[test]
    fn undrained_pressure_below_a_square_is_loves_mean_stress() {
        let all = document().unwrap();
        let fine = &all.square.undrained[1];
        for row in 32..40 {
            let depth = 5.0 - (row as f64 + 0.5) * 0.125;
            let sides = [-1.0, 1.0].map(|sign| 1.0 + sign * 0.0625);
            let part = |a: f64, b: f64| (a * b / (depth * (a * a + b * b + depth * depth).sqrt())).atan();
            let seen: f64 = sides.iter().flat_map(|a| sides.map(|b| part(*a, b))).sum();
            let exact = seen / (2.0 * std::f64::consts::PI);
            let found = fine.pressure(0, row);
            assert!((found - exact).abs() < 0.06, "{depth} {found} {exact}");
        }
    }
}
