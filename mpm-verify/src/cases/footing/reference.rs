//! The references: Prandtl's limit load and an independent finite-element solution.

use super::simulation::{WIDTH, effective_width};
use crate::parameter::Parameters;
use crate::record::Record;
use serde::Deserialize;
use std::sync::OnceLock;

const SOLUTIONS: &str = include_str!("../../../references/footing.json");

/// Prandtl's bearing capacity factor of a strip footing (1920), smooth or rough.
pub(super) const EXACT: f64 = 2.0 + std::f64::consts::PI;

/// Metrics of the curve and the penetrations over B at which they are measured.
pub(super) const CURVE: &[(&str, f64)] = &[
    ("nc_0.0003", 3e-4),
    ("nc_0.0005", 5e-4),
    ("nc_0.001", 1e-3),
    ("nc_0.0015", 1.5e-3),
    ("nc_0.002", 2e-3),
    ("nc_0.003", 3e-3),
];

#[derive(Debug, Deserialize)]
struct Document {
    method: String,
    strength_over_young_modulus: f64,
    poisson_ratio: f64,
    domain: f64,
    settlements: Vec<f64>,
    solutions: Vec<Solution>,
    extrapolated: Extrapolated,
}

/// A finite-element solution.
#[derive(Debug, Deserialize)]
struct Solution {
    cells: f64,
    mesh: String,
    formulation: String,
    contact: String,
    slope: f64,
    limit: Option<f64>,
    pressures: Vec<f64>,
}

/// The limit of vanishing elements.
#[derive(Debug, Deserialize)]
struct Extrapolated {
    slope: f64,
    slope_uncertainty: f64,
    limit: f64,
    limit_uncertainty: f64,
    curve: Vec<Pressure>,
}

#[derive(Debug, Deserialize)]
struct Pressure {
    settlement: f64,
    pressure: f64,
}

/// What a run is held against: pressures over the strength for F/(B/2).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    /// d(q/s_u)/d(s/B) at the start, at the strength of the reference.
    pub(super) slope: f64,
    /// Limit load.
    pub(super) limit: f64,
    /// (s/B, q/s_u).
    pub(super) points: Vec<(f64, f64)>,
    /// What it is.
    pub(super) name: String,
}

impl Curve {
    /// q/s_u at a tabulated penetration over B.
    pub(super) fn at(&self, penetration: f64) -> Option<f64> {
        let near = |s: f64| (s - penetration).abs() < 1e-9;
        self.points
            .iter()
            .find(|(s, _)| near(*s))
            .map(|(_, pressure)| *pressure)
    }
}

fn document() -> Option<&'static Document> {
    static DOCUMENT: OnceLock<Option<Document>> = OnceLock::new();
    DOCUMENT
        .get_or_init(|| serde_json::from_str(SOLUTIONS).ok())
        .as_ref()
}

/// The curve of vanishing elements as (s/B, q/s_u), to be drawn.
pub(crate) fn footing_limit() -> Vec<(f64, f64)> {
    let curve = document().map(|d| &d.extrapolated.curve);
    let points = curve.into_iter().flatten();
    points.map(|p| (p.settlement, p.pressure)).collect()
}

/// Strength over Young's modulus of the reference.
pub(super) fn strength_ratio() -> f64 {
    document().map_or(f64::NAN, |d| d.strength_over_young_modulus)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

/// The finite-element curve for a run: of elements as large as the cells, whose footing acts as wide as that of
/// a scheme with nodes on grid lines; for one that acts as wide as it is, the limit of vanishing elements. The
/// strength is not asked for.
pub(super) fn curve(record: &Record) -> Result<Curve, String> {
    let Some(document) = document() else {
        return Err("the stored reference can't be read".to_owned());
    };
    covers(document, &record.parameters)?;
    let h = record.discretisation.h;
    let rough = record.parameters.boolean("rough");
    if effective_width(record.basis, h) == WIDTH {
        if !rough {
            return Err("the extrapolated reference is that of a rough footing".to_owned());
        }
        let limit = &document.extrapolated;
        return Ok(Curve {
            slope: limit.slope,
            limit: limit.limit,
            points: (limit.curve.iter())
                .map(|p| (p.settlement, p.pressure))
                .collect(),
            name: "finite elements, extrapolated to vanishing size".to_owned(),
        });
    }
    let contact = if rough { "rough" } else { "smooth" };
    let found = document.solutions.iter().find(|s| {
        close(s.cells * h, WIDTH)
            && s.formulation == "mean_dilatation"
            && s.contact == contact
            && s.limit.is_some()
    });
    let Some(solution) = found else {
        return Err(format!("no {contact} reference with elements of {h} m"));
    };
    Ok(Curve {
        slope: solution.slope,
        limit: solution.limit.unwrap_or(f64::NAN),
        points: (document.settlements.iter().copied())
            .zip(solution.pressures.iter().copied())
            .collect(),
        name: format!(
            "B-bar finite elements of the same size, {} mesh",
            solution.mesh
        ),
    })
}

fn covers(document: &Document, parameters: &Parameters) -> Result<(), String> {
    let wanted = [
        ("poisson_ratio", document.poisson_ratio),
        ("domain_width", document.domain),
        ("domain_depth", document.domain),
    ];
    for (name, value) in wanted {
        let own = parameters.number(name);
        if !close(own, value) {
            return Err(format!("the reference is for {name} = {value}, not {own}"));
        }
    }
    Ok(())
}

/// The references in words.
pub(super) fn describe() -> Vec<String> {
    let mut lines = vec![format!(
        "Prandtl (1920): limit load q = (2 + π) s_u = {EXACT:.4} s_u, exact for a rigid, perfectly plastic half-space"
    )];
    let Some(document) = document() else {
        return lines;
    };
    lines.push(document.method.clone());
    let uniform = document.solutions.iter().filter(|s| {
        s.formulation == "mean_dilatation" && s.contact == "rough" && s.mesh == "uniform"
    });
    lines.extend(uniform.filter_map(|s| {
        Some(format!(
            "B/{}: limit load {:.4} s_u by B, {:.4} by B + h; slope {:.0}",
            s.cells,
            s.limit?,
            s.limit? / (1.0 + 1.0 / s.cells),
            s.slope
        ))
    }));
    let e = &document.extrapolated;
    lines.push(format!(
        "extrapolated: limit load {:.4} ± {:.4} s_u, slope {:.0} ± {:.0}",
        e.limit, e.limit_uncertainty, e.slope, e.slope_uncertainty
    ));
    lines
}
