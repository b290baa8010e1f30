//! The membrane's geometry, and the reference: an independent finite-element solution, valid for stated parameters.

use super::*;

const SOLUTIONS: &str = include_str!("../../../references/cook.json");
const FIELD: &str = include_str!("../../../references/cook_mean_stress.csv");
const LARGE_LOADS: &str = include_str!("../../../references/cook_loads.json");

/// Corners: (0, 0), (48, 44), (48, 60), (0, 44) m.
pub(super) const LENGTH: f64 = 48.0;
pub(super) const LEFT_HEIGHT: f64 = 44.0;
pub(super) const RIGHT_HEIGHT: f64 = 16.0;
/// The upper right corner and the middle of the right side (m).
pub(super) const TIP: [f64; 2] = [LENGTH, LEFT_HEIGHT + RIGHT_HEIGHT];
pub(super) const MID_EDGE: [f64; 2] = [LENGTH, LEFT_HEIGHT + 0.5 * RIGHT_HEIGHT];
/// Excluded from the stress error: x below this (m), and this far around the clamped corners.
const SINGULAR: f64 = 3.0;

/// Young's modulus (Pa) of the stored solutions; stresses scale with it.
const MODULUS: f64 = 70.0;
/// Poisson's ratio of the stored field.
const RATIO: f64 = 0.499;
/// Spacing of the lattice of the reference field (m); its first point is at half of it.
const LATTICE: f64 = 0.5;

/// A displacement u_y that the reference knows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Measure {
    MidEdge,
    EdgeMean,
    Tip,
}

impl Measure {
    pub(super) const ALL: [Self; 3] = [Self::MidEdge, Self::EdgeMean, Self::Tip];

    /// Its metric, and that of its relative error.
    pub(super) fn metrics(self) -> [Metric; 2] {
        self.of([[MID_EDGE_UY, FEM_MID_EDGE_ERROR], [EDGE_MEAN_UY, FEM_EDGE_MEAN_ERROR], [TIP_UY, FEM_TIP_ERROR]])
    }

    /// Its own among what belongs to each, in the order of [`Measure::ALL`].
    pub(super) fn of<T: Copy>(self, each: [T; 3]) -> T {
        each[self as usize]
    }
}

#[derive(Debug, Deserialize)]
struct Document {
    method: String,
    load_over_young_modulus: f64,
    solutions: Vec<Solution>,
    load_inset: Vec<LoadShift>,
}

/// Displacements u_y (m), or by how much they change.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct Deflections {
    #[serde(alias = "mid_edge_uy_change")]
    mid_edge_uy: f64,
    #[serde(alias = "edge_mean_uy_change")]
    edge_mean_uy: f64,
    #[serde(alias = "tip_uy_change")]
    tip_uy: f64,
}

impl Deflections {
    pub(super) fn of(&self, measure: Measure) -> f64 {
        measure.of([self.mid_edge_uy, self.edge_mean_uy, self.tip_uy])
    }
}

/// The change when the load acts on x = 48 m − h/4 instead of the side.
#[derive(Debug, Clone, Copy, Deserialize)]
struct LoadShift {
    poisson_ratio: f64,
    h: f64,
    #[serde(flatten)]
    change: Deflections,
}

/// A displacement (m).
#[derive(Debug, Clone, Copy, Deserialize)]
struct Displacement {
    uy: f64,
}

/// Mean normal stress (Pa) at a material point (m).
#[derive(Debug, Clone, Copy, Deserialize)]
struct StressPoint {
    x: f64,
    y: f64,
    value: f64,
}

/// The solution at one Poisson's ratio.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Solution {
    pub(super) poisson_ratio: f64,
    tip: Displacement,
    mid_edge: Displacement,
    edge_mean_uy: f64,
    /// Uncertainties (m, Pa).
    pub(super) uncertainty_displacement: f64,
    pub(super) uncertainty_mean_stress: f64,
    mean_stress: Vec<StressPoint>,
}

impl Solution {
    /// A displacement (m).
    pub(super) fn of(&self, measure: Measure) -> f64 {
        measure.of([self.mid_edge.uy, self.edge_mean_uy, self.tip.uy])
    }

    /// Whether the field of mean stress is that of this solution.
    pub(super) fn has_field(&self) -> bool {
        self.poisson_ratio == RATIO
    }

    /// The mean normal stress (Pa) at a material point (m), where it is known.
    pub(super) fn mean_stress_at(&self, point: [f64; 2]) -> Option<f64> {
        self.mean_stress.iter().find(|s| [s.x, s.y] == point).map(|s| s.value)
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct LargeLoad {
    load_over_young_modulus: f64,
    /// Distance (m) of the load from the right side.
    load_inset: f64,
    #[serde(flatten)]
    pub(super) deflections: Deflections,
    /// Uncertainty (m).
    pub(super) uncertainty: f64,
}

fn document() -> Result<&'static Document, String> {
    static DOCUMENT: LazyLock<Option<Document>> = LazyLock::new(|| serde_json::from_str(SOLUTIONS).ok());
    DOCUMENT.as_ref().ok_or_else(|| "the stored reference can't be read".to_owned())
}

impl Setup<Cook> {
    /// The solution, if the reference covers the setup: displacements depend on ν and on load over E alone, so both must be
    /// those of a stored solution.
    pub(super) fn solution(&self) -> Result<&'static Solution, String> {
        let document = document()?;
        let ratio = self.load / self.young_modulus;
        let stored = document.load_over_young_modulus;
        if (ratio - stored).abs() > 1e-9 * stored {
            return Err(format!("the reference is for load/E = 1/70, not {ratio}"));
        }
        let nu = self.poisson_ratio;
        document.solutions.iter().find(|s| s.poisson_ratio == nu).ok_or_else(|| format!("no reference at ν = {nu}"))
    }

    /// The change due to the load's place, if it is stored for these cells.
    pub(super) fn load_shift(&self) -> Option<&'static Deflections> {
        let same = |s: &&LoadShift| s.h == self.h && s.poisson_ratio == self.poisson_ratio;
        document().ok()?.load_inset.iter().find(same).map(|s| &s.change)
    }

    /// The solution under a load of 10 to 50 N that acts h/4 from the side, if it is stored.
    pub(super) fn large_load(&self) -> Option<&'static LargeLoad> {
        #[derive(Debug, Deserialize)]
        struct Document {
            poisson_ratio: f64,
            solutions: Vec<LargeLoad>,
        }
        static DOCUMENT: LazyLock<Option<Document>> = LazyLock::new(|| serde_json::from_str(LARGE_LOADS).ok());
        let document = DOCUMENT.as_ref()?;
        let (ratio, inset) = (self.load / self.young_modulus, 0.25 * self.h);
        let same = |s: &&LargeLoad| {
            let load = s.load_over_young_modulus;
            (ratio - load).abs() < 1e-9 * load && (s.load_inset - inset).abs() < 1e-9
        };
        let known = self.poisson_ratio == document.poisson_ratio;
        document.solutions.iter().find(same).filter(|_| known)
    }

    /// Factor of the stored stresses.
    pub(super) fn stress_scale(&self) -> f64 {
        self.young_modulus / MODULUS
    }

    /// Rms over the particles at `references` (m) of the mean stress (Pa) less the reference; NaN where that is not known.
    pub(super) fn stress_error(&self, references: &[[f64; 2]], mean_stress: &[f64]) -> f64 {
        if !self.solution().is_ok_and(Solution::has_field) {
            return f64::NAN;
        }
        let (field, scale) = (StressField::stored(), self.stress_scale());
        let counted = references.iter().zip(mean_stress);
        let off = counted
            .filter(|(x, _)| away_from_singularities(x))
            .filter_map(|(x, s)| Some(s - scale * field.interpolate(*x)?));
        rms(off)
    }
}

pub(super) fn describe() -> Vec<String> {
    let Ok(document) = document() else { return Vec::new() };
    let mut lines = vec![document.method.clone()];
    lines.extend(document.solutions.iter().map(|s| {
        let [mid_edge, edge_mean, tip] = Measure::ALL.map(|measure| s.of(measure));
        format!(
            "ν = {}: u_y tip {tip:.6}, mid-edge {mid_edge:.6}, edge mean {edge_mean:.6} m (± {:.0e} m); mean stress ± {:.0e} Pa",
            s.poisson_ratio, s.uncertainty_displacement, s.uncertainty_mean_stress
        )
    }));
    lines
}

/// Whether a material point counts in the stress error.
fn away_from_singularities(x: &[f64; 2]) -> bool {
    x[0] > SINGULAR && x[0].hypot(x[1]) > SINGULAR && x[0].hypot(x[1] - LEFT_HEIGHT) > SINGULAR
}

/// The reference field of mean normal stress (Pa) at ν = 0.499, on a lattice of material points.
pub(super) struct StressField(BTreeMap<(usize, usize), f64>);

impl StressField {
    pub(super) fn stored() -> &'static Self {
        static STORED: LazyLock<StressField> = LazyLock::new(|| {
            let mut reader = csv::Reader::from_reader(FIELD.as_bytes());
            let place = |x: f64| (x / LATTICE) as usize;
            let points = reader.deserialize::<(f64, f64, f64)>().flatten();
            StressField(points.map(|(x, y, stress)| ((place(x), place(y)), stress)).collect())
        });
        &STORED
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
                    sum += ws * wt * self.0.get(&(i + di, j + dj))?;
                }
            }
        }
        Some(sum)
    }

    /// Root mean squares of |gradient| (Pa/m) and of the field (Pa) over the lattice points that
    /// count in the stress error.
    pub(super) fn rms_of_gradient_and_value(&self) -> (f64, f64) {
        let counted = self.0.iter().filter_map(|((i, j), value)| {
            let x = [i, j].map(|k| (*k as f64 + 0.5) * LATTICE);
            let gradient = away_from_singularities(&x).then(|| self.gradient(x, LATTICE))??;
            Some((gradient, *value))
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
            let field = StressField::stored().interpolate([point.x, point.y]).unwrap();
            // Bilinear interpolation over 0.5 m: half a lattice step squared over eight, times the
            // curvature of the field, stays below 1e-4 Pa.
            assert!((field - point.value).abs() < 1e-4, "{point:?} {field}");
        }
    }

    #[test]
    fn the_field_covers_the_membrane_and_nothing_else() {
        let field = StressField::stored();
        assert_eq!(field.0.len(), 5776);
        assert!(field.interpolate([24.0, 36.0]).is_some());
        assert!(field.interpolate([24.0, 10.0]).is_none());
        assert!(field.interpolate([500.0, 10.0]).is_none());
    }
}
