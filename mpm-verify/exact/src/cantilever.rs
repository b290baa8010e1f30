//! Cantilever under its weight: finite elements of high order, at one load and three laws.

use serde::Deserialize;
use std::sync::OnceLock;

const SOLUTIONS: &str = include_str!("../references/cantilever.json");
const STRESSES: &str = include_str!("../references/cantilever_stress.json");

#[derive(Debug, Deserialize)]
struct Document {
    method: String,
    #[serde(rename = "at_4_kN_per_m3")]
    solutions: Solutions,
}

/// Displacements by law, under 4 kN/m³ at E = 100 kPa.
#[derive(Debug, Deserialize)]
pub struct Solutions {
    /// Hencky's law.
    pub hencky: Solution,
    /// The neo-Hookean law.
    pub neo_hookean: Solution,
    /// Jaumann's rate.
    pub jaumann: Solution,
}

/// Displacements (m).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub struct Solution {
    /// Displacement of the corner (1, 0) m.
    pub bottom_right: [f64; 2],
    /// Mean over the right side, if it was kept.
    pub right_edge_mean: Option<[f64; 2]>,
    /// Uncertainty.
    pub uncertainty: f64,
}

/// Stresses by law.
#[derive(Debug, Deserialize)]
pub struct StressesByLaw {
    /// Hencky's law.
    pub hencky: Stresses,
    /// The neo-Hookean law.
    pub neo_hookean: Stresses,
}

/// σ_xx at material points under 4 kN/m³.
#[derive(Debug, Clone, Deserialize)]
pub struct Stresses {
    stress_xx: Vec<Stress>,
    /// Uncertainty (Pa).
    pub uncertainty_stress: f64,
}

/// σ_xx (Pa) and its gradient (Pa/m) at a material point (m).
#[derive(Debug, Clone, Copy, Deserialize)]
pub struct Stress {
    x: f64,
    y: f64,
    /// σ_xx (Pa).
    pub value: f64,
    /// Magnitude of its gradient (Pa/m).
    pub gradient: f64,
}

impl Stresses {
    /// At a point (m), where it is known.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> Option<&Stress> {
        self.stress_xx.iter().find(|s| [s.x, s.y] == point)
    }
}

/// The stresses; nothing if the stored ones can't be read.
pub fn stresses() -> Option<&'static StressesByLaw> {
    static DOCUMENT: OnceLock<Option<StressesByLaw>> = OnceLock::new();
    DOCUMENT.get_or_init(|| serde_json::from_str(STRESSES).ok()).as_ref()
}

fn document() -> Option<&'static Document> {
    static DOCUMENT: OnceLock<Option<Document>> = OnceLock::new();
    DOCUMENT.get_or_init(|| serde_json::from_str(SOLUTIONS).ok()).as_ref()
}

/// The displacements; nothing if the stored ones can't be read.
pub fn solutions() -> Option<&'static Solutions> {
    document().map(|document| &document.solutions)
}

/// The references in words.
#[must_use]
pub fn describe() -> Vec<String> {
    let Some(document) = document() else {
        return Vec::new();
    };
    let s = &document.solutions;
    let laws = [("Hencky", &s.hencky), ("neo-Hookean", &s.neo_hookean), ("Jaumann", &s.jaumann)];
    let line = |(name, s): (&str, &Solution)| {
        let [ux, uy] = s.bottom_right;
        format!("{name}: corner (1, 0) moves by ({ux:.6}, {uy:.6}) m ± {:.0e} m", s.uncertainty)
    };
    let mut lines = vec![document.method.clone()];
    lines.extend(laws.map(line));
    lines.push("B. Wang, P. J. Vardon, M. A. Hicks & Z. Chen (2016), doi:10.1016/j.compgeo.2015.08.008: (−0.38, −0.61) m, which none of these laws gives".to_owned());
    lines
}
