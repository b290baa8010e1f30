//! References: finite elements of high order, at one load and three laws.

use super::{Cantilever, LawName};
use crate::setup::Setup;
use serde::Deserialize;
use std::sync::OnceLock;

const SOLUTIONS: &str = include_str!("../../../references/cantilever.json");
const STRESSES: &str = include_str!("../../../references/cantilever_stress.json");

#[derive(Debug, Deserialize)]
struct Document {
    method: String,
    #[serde(rename = "at_4_kN_per_m3")]
    solutions: Solutions,
}

#[derive(Debug, Deserialize)]
struct Solutions {
    hencky: Solution,
    neo_hookean: Solution,
    jaumann: Solution,
}

/// Displacements (m).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub(super) struct Solution {
    /// Displacement of the corner (1, 0) m.
    pub(super) bottom_right: [f64; 2],
    /// Mean over the right side, if it was kept.
    pub(super) right_edge_mean: Option<[f64; 2]>,
    /// Uncertainty.
    pub(super) uncertainty: f64,
}

/// σ_xx at material points under 4 kN/m³.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Stresses {
    stress_xx: Vec<Stress>,
    /// Uncertainty (Pa).
    pub(super) uncertainty_stress: f64,
}

/// σ_xx (Pa) and its gradient (Pa/m) at a material point (m).
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct Stress {
    x: f64,
    y: f64,
    pub(super) value: f64,
    pub(super) gradient: f64,
}

impl Stresses {
    /// At a point (m), where it is known.
    pub(super) fn at(&self, point: [f64; 2]) -> Option<&Stress> {
        self.stress_xx.iter().find(|s| [s.x, s.y] == point)
    }
}

/// The stresses of a setup; those of rate laws are not known.
pub(super) fn stresses(setup: &Setup<Cantilever>) -> Result<&'static Stresses, String> {
    #[derive(Debug, Deserialize)]
    struct Document {
        hencky: Stresses,
        neo_hookean: Stresses,
    }
    static DOCUMENT: OnceLock<Option<Document>> = OnceLock::new();
    let stored = DOCUMENT.get_or_init(|| serde_json::from_str(STRESSES).ok());
    let stored = stored.as_ref().ok_or("the stored stresses can't be read")?;
    solution(setup)?;
    if setup.young_modulus != 1e5 {
        return Err("the reference is for E = 100 kPa".to_owned());
    }
    match setup.law {
        LawName::Hencky => Ok(&stored.hencky),
        LawName::NeoHookean => Ok(&stored.neo_hookean),
        _ => Err("no reference stresses of Jaumann's law".to_owned()),
    }
}

fn document() -> Option<&'static Document> {
    static DOCUMENT: OnceLock<Option<Document>> = OnceLock::new();
    DOCUMENT.get_or_init(|| serde_json::from_str(SOLUTIONS).ok()).as_ref()
}

/// The solution of a setup: displacements depend on ν and weight over E alone.
pub(super) fn solution(setup: &Setup<Cantilever>) -> Result<&'static Solution, String> {
    let stored = &document().ok_or("the stored reference can't be read")?.solutions;
    let load = setup.weight / setup.young_modulus;
    if (load - 0.04).abs() > 1e-12 || setup.poisson_ratio != 0.0 {
        return Err("the reference is for ν = 0 and weight/E = 0.04/m".to_owned());
    }
    Ok(match setup.law {
        LawName::Hencky => &stored.hencky,
        LawName::NeoHookean => &stored.neo_hookean,
        _ => &stored.jaumann,
    })
}

/// The references in words.
pub(super) fn describe() -> Vec<String> {
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
