//! The reference: an independent finite-element solution, valid for stated parameters.

use super::geometry::away_from_singularities;
use super::parameters::{LOAD, POISSON_RATIO, YOUNG_MODULUS};
use crate::parameter::Parameters;
use crate::statistics::rms;
use serde::Deserialize;
use std::sync::LazyLock;

const SOLUTIONS: &str = include_str!("../../../references/cook.json");
const FIELD: &str = include_str!("../../../references/cook_mean_stress.csv");

const LARGE_LOADS: &str = include_str!("../../../references/cook_loads.json");

/// Young's modulus (Pa) of the stored solutions; stresses scale with it.
const MODULUS: f64 = 70.0;
/// Spacing of the lattice of the reference field (m); its first point is at half of it.
const LATTICE: f64 = 0.5;

#[derive(Debug, Deserialize)]
struct Document {
    method: String,
    load_over_young_modulus: f64,
    solutions: Vec<Solution>,
    load_inset: Vec<LoadShift>,
}

/// What the displacements (m) change by when the load acts on x = 48 m − h/4 instead of the side.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct LoadShift {
    h: f64,
    pub(super) tip_uy_change: f64,
    pub(super) mid_edge_uy_change: f64,
    pub(super) edge_mean_uy_change: f64,
}

/// A displacement (m).
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct Displacement {
    pub(super) uy: f64,
}

/// Mean normal stress at a material point.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct StressPoint {
    x: f64,
    y: f64,
    pub(super) value: f64,
}

/// The solution at one Poisson's ratio.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Solution {
    pub(super) poisson_ratio: f64,
    pub(super) tip: Displacement,
    pub(super) mid_edge: Displacement,
    pub(super) edge_mean_uy: f64,
    pub(super) uncertainty_displacement: f64,
    mean_stress: Vec<StressPoint>,
    pub(super) uncertainty_mean_stress: f64,
}

impl Solution {
    /// The mean normal stress at a material point (m), where it is known.
    pub(super) fn mean_stress_at(&self, point: [f64; 2]) -> Option<&StressPoint> {
        self.mean_stress.iter().find(|s| [s.x, s.y] == point)
    }
}

fn document() -> Result<&'static Document, String> {
    static DOCUMENT: LazyLock<Option<Document>> = LazyLock::new(|| serde_json::from_str(SOLUTIONS).ok());
    let unreadable = || "the stored reference can't be read".to_owned();
    DOCUMENT.as_ref().ok_or_else(unreadable)
}

/// The change due to the load's place at cell size `h` (m), if it is stored.
pub(super) fn load_shift(h: f64) -> Option<&'static LoadShift> {
    document().ok()?.load_inset.iter().find(|s| s.h == h)
}

/// The solution for `parameters`, if the reference covers them: displacements depend on ν and on
/// load over E alone, so both must be those of a stored solution.
pub(super) fn solution(parameters: &Parameters) -> Result<&'static Solution, String> {
    let document = document()?;
    let ratio = parameters.number(LOAD) / parameters.number(YOUNG_MODULUS);
    let stored = document.load_over_young_modulus;
    if (ratio - stored).abs() > 1e-9 * stored {
        return Err(format!("the reference is for load/E = 1/70, not {ratio}"));
    }
    let nu = parameters.number(POISSON_RATIO);
    document.solutions.iter().find(|s| s.poisson_ratio == nu).ok_or_else(|| format!("no reference at ν = {nu}"))
}

/// Deflections of the right side (m) under a large load.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct LargeLoad {
    load_over_young_modulus: f64,
    /// How far (m) from the right side it acts.
    load_inset: f64,
    pub(super) mid_edge_uy: f64,
    pub(super) edge_mean_uy: f64,
    pub(super) uncertainty: f64,
}

/// The solution under a load of 10 to 50 N that acts `inset` (m) from the side, if it is stored.
pub(super) fn large_load(parameters: &Parameters, inset: f64) -> Option<&'static LargeLoad> {
    #[derive(Debug, Deserialize)]
    struct Document {
        poisson_ratio: f64,
        solutions: Vec<LargeLoad>,
    }
    static DOCUMENT: LazyLock<Option<Document>> = LazyLock::new(|| serde_json::from_str(LARGE_LOADS).ok());
    let document = DOCUMENT.as_ref()?;
    let ratio = parameters.number(LOAD) / parameters.number(YOUNG_MODULUS);
    let same = |s: &&LargeLoad| {
        let load = s.load_over_young_modulus;
        (ratio - load).abs() < 1e-9 * load && (s.load_inset - inset).abs() < 1e-9
    };
    let known = parameters.number(POISSON_RATIO) == document.poisson_ratio;
    document.solutions.iter().find(same).filter(|_| known)
}

/// What the stored stresses are to be multiplied with for `parameters`.
pub(super) fn stress_scale(parameters: &Parameters) -> f64 {
    parameters.number(YOUNG_MODULUS) / MODULUS
}

/// The references in words.
pub(super) fn describe() -> Vec<String> {
    let Ok(document) = document() else {
        return Vec::new();
    };
    let mut lines = vec![document.method.clone()];
    lines.extend(document.solutions.iter().map(|s| {
        format!(
            "ν = {}: u_y tip {:.6}, mid-edge {:.6}, edge mean {:.6} m (± {:.0e} m); mean stress ± {:.0e} Pa",
            s.poisson_ratio,
            s.tip.uy,
            s.mid_edge.uy,
            s.edge_mean_uy,
            s.uncertainty_displacement,
            s.uncertainty_mean_stress
        )
    }));
    lines
}

/// The reference field of mean normal stress at ν = 0.499, on a lattice of material points.
pub(super) struct Field {
    columns: usize,
    rows: usize,
    values: Vec<Option<f64>>,
}

impl Field {
    /// The stored field.
    pub(super) fn stored() -> &'static Self {
        static STORED: LazyLock<Field> = LazyLock::new(|| {
            let (columns, rows) = (96, 120);
            let mut values = vec![None; columns * rows];
            let mut reader = csv::Reader::from_reader(FIELD.as_bytes());
            for (x, y, stress) in reader.deserialize::<(f64, f64, f64)>().flatten() {
                let index = (x / LATTICE) as usize * rows + (y / LATTICE) as usize;
                if let Some(value) = values.get_mut(index) {
                    *value = Some(stress);
                }
            }
            Field { columns, rows, values }
        });
        &STORED
    }

    fn at(&self, i: usize, j: usize) -> Option<f64> {
        (i < self.columns && j < self.rows).then(|| self.values[i * self.rows + j])?
    }

    /// The field at a material point (m), bilinear between the four lattice points around it; `None`
    /// where one of them lies outside the membrane.
    pub(super) fn interpolate(&self, x: [f64; 2]) -> Option<f64> {
        let place = |q: f64| {
            let s = (q / LATTICE - 0.5).max(0.0);
            let i = (s + 1e-9) as usize;
            (i, (s - i as f64).max(0.0))
        };
        let ((i, s), (j, t)) = (place(x[0]), place(x[1]));
        let mut sum = 0.0;
        for (di, ws) in [(0, 1.0 - s), (1, s)] {
            for (dj, wt) in [(0, 1.0 - t), (1, t)] {
                if ws * wt > 1e-9 {
                    sum += ws * wt * self.at(i + di, j + dj)?;
                }
            }
        }
        Some(sum)
    }

    /// Root mean squares of |gradient| (Pa/m) and of the field (Pa) over the lattice points that
    /// count in the stress error.
    pub(super) fn rms_of_gradient_and_value(&self) -> (f64, f64) {
        let counted = (0..self.columns * self.rows).filter_map(|k| {
            let place = |i: usize| (i as f64 + 0.5) * LATTICE;
            let x = [place(k / self.rows), place(k % self.rows)];
            let value = self.values[k].filter(|_| away_from_singularities(&x))?;
            Some((self.gradient(x, LATTICE)?, value))
        });
        let (gradients, values): (Vec<f64>, Vec<f64>) = counted.unzip();
        (rms(gradients), rms(values))
    }

    /// Magnitude of the field's gradient (Pa/m) at a material point, by central differences over
    /// `reach` (m).
    pub(super) fn gradient(&self, x: [f64; 2], reach: f64) -> Option<f64> {
        let along = |dx: f64, dy: f64| {
            let ahead = self.interpolate([x[0] + dx, x[1] + dy])?;
            let behind = self.interpolate([x[0] - dx, x[1] - dy])?;
            Some((ahead - behind) / (2.0 * reach))
        };
        Some(along(reach, 0.0)?.hypot(along(0.0, reach)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stored_solutions_agree_with_the_stored_field() {
        let solution = document().unwrap().solutions.iter().find(|s| s.poisson_ratio == 0.499).unwrap();
        for point in &solution.mean_stress {
            let field = Field::stored().interpolate([point.x, point.y]).unwrap();
            // Bilinear interpolation over 0.5 m: half a lattice step squared over eight, times the
            // curvature of the field, stays below 1e-4 Pa.
            assert!((field - point.value).abs() < 1e-4, "{point:?} {field}");
        }
    }

    #[test]
    fn the_field_covers_the_membrane_and_nothing_else() {
        let field = Field::stored();
        assert_eq!(field.values.iter().flatten().count(), 5776);
        assert!(field.interpolate([24.0, 36.0]).is_some());
        assert!(field.interpolate([24.0, 10.0]).is_none());
        assert!(field.interpolate([500.0, 10.0]).is_none());
    }
}
