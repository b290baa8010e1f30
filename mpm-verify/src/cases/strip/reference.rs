//! Finite elements of Taylor and Hood at small strain: `references/strip_fem.py`.

use super::parameters::{
    CONDUCTIVITY, DIMENSION, DURATION, HALF_WIDTH, LAW, LOAD, POISSON_RATIO, POROSITY, STEPS,
    YOUNG_MODULUS,
};
use crate::parameter::Parameters;
use serde::Deserialize;
use std::sync::OnceLock;

const SOLUTIONS: &str = include_str!("../../../references/strip.json");
/// The largest load (Pa) that is small.
const SMALL: f64 = 1e3;
/// A conductivity (m/s) at which no water flows in a run's time.
const NOTHING: f64 = 1e-12;
/// Of the pressures of the file.
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
        let value = self.pressure.get(j * row + i);
        value.map_or(f64::NAN, |p| UNIT * p)
    }
}

fn document() -> Option<&'static Document> {
    static READ: OnceLock<Option<Document>> = OnceLock::new();
    READ.get_or_init(|| serde_json::from_str(SOLUTIONS).ok())
        .as_ref()
}

/// Whether no water flows in a run's time.
pub(super) fn is_undrained(parameters: &Parameters) -> bool {
    parameters.number(CONDUCTIVITY) <= NOTHING
}

/// The solution that a run on cells of size `h` (m) should have, if there is one.
pub(super) fn solution(h: f64, parameters: &Parameters) -> Option<&'static Solution> {
    let is = |p, value: f64| parameters.number(p) == value;
    let elastic = parameters.is(LAW, "elastic") && is(HALF_WIDTH, 1.0) && is(POISSON_RATIO, 0.25);
    let small = parameters.number(LOAD) <= SMALL;
    let undrained = is_undrained(parameters);
    let steps = is(STEPS, 20.0) && is(DURATION, 2000.0) && is(CONDUCTIVITY, 1e-6);
    let moduli = is(YOUNG_MODULUS, 1e6) && is(POROSITY, 0.4);
    if !(elastic && small && moduli && (undrained || steps)) {
        return None;
    }
    let all = document()?;
    let all = if is(DIMENSION, 3.0) {
        &all.square
    } else {
        &all.strip
    };
    let of = if undrained {
        &all.undrained
    } else {
        &all.drained
    };
    of.iter().find(|s| (s.h - h).abs() < 1e-9 * h)
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

    /// Of deep undrained ground the pressure is the mean stress in the plane, which under a strip is the angle that it is
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

    /// Likewise below a square: the mean stress is the solid angle that it is seen by over 2π. Near a corner of the square a
    /// right-angled part of a by b in the depth z fills atan(ab / (z √(a² + b² + z²))) of it.
    #[test]
    fn undrained_pressure_below_a_square_is_loves_mean_stress() {
        let all = document().unwrap();
        let fine = &all.square.undrained[1];
        for row in 32..40 {
            let depth = 5.0 - (row as f64 + 0.5) * 0.125;
            let sides = [-1.0, 1.0].map(|sign| 1.0 + sign * 0.0625);
            let part =
                |a: f64, b: f64| (a * b / (depth * (a * a + b * b + depth * depth).sqrt())).atan();
            let seen: f64 = sides.iter().flat_map(|a| sides.map(|b| part(*a, b))).sum();
            let exact = seen / (2.0 * std::f64::consts::PI);
            let found = fine.pressure(0, row);
            assert!((found - exact).abs() < 0.06, "{depth} {found} {exact}");
        }
    }
}
