//! The references: Prandtl's limit load and an independent finite-element solution.

use super::*;

const SOLUTIONS: &str = include_str!("../../../references/footing.json");

/// Prandtl's bearing capacity factor of a strip footing (1920), smooth or rough.
pub(super) const EXACT: f64 = 2.0 + std::f64::consts::PI;

#[derive(Debug, Deserialize)]
struct Document {
    method: String,
    young_modulus: f64,
    poisson_ratio: f64,
    strength: f64,
    domain: f64,
    settlements: Vec<f64>,
    meshes: Vec<Solution>,
    slopes: Vec<Slopes>,
    extrapolated: Extrapolated,
}

#[derive(Debug, Deserialize)]
struct Solution {
    cells: f64,
    mesh: String,
    formulation: String,
    contact: String,
    limit: Option<f64>,
    slope: f64,
    pressures: Vec<f64>,
}

/// Slopes of the curve at its start, of a rough footing, for one Poisson's ratio and domain.
#[derive(Debug, Deserialize)]
struct Slopes {
    poisson_ratio: f64,
    domain: f64,
    meshes: Vec<Slope>,
    slope: f64,
}

#[derive(Debug, Deserialize)]
struct Slope {
    cells: f64,
    slope: f64,
}

#[derive(Debug, Deserialize)]
struct Extrapolated {
    slope: f64,
    slope_uncertainty: f64,
    limit: f64,
    limit_uncertainty: f64,
    curve: Vec<Pressure>,
    mean_stress: Vec<MeanStress>,
}

#[derive(Debug, Deserialize)]
struct Pressure {
    settlement: f64,
    pressure: f64,
}

/// Mean normal stress over the strength at the limit load, at a material point (in B, the surface at zero).
#[derive(Debug, Deserialize)]
pub(super) struct MeanStress {
    x: f64,
    y: f64,
    pub(super) value: f64,
    pub(super) uncertainty: f64,
}

/// Reference curve of a run: pressures over the strength for F/(B/2).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    pub(super) limit: f64,
    /// (s/B, q/s_u).
    points: Vec<(f64, f64)>,
    pub(super) name: String,
}

impl Curve {
    /// q/s_u at a tabulated penetration over B.
    pub(super) fn at(&self, penetration: f64) -> Option<f64> {
        let near = |s: f64| (s - penetration).abs() < 1e-9;
        let mut points = self.points.iter();
        points.find(|(s, _)| near(*s)).map(|(_, q)| *q)
    }
}

fn document() -> Result<&'static Document, String> {
    static DOCUMENT: LazyLock<Option<Document>> = LazyLock::new(|| serde_json::from_str(SOLUTIONS).ok());
    DOCUMENT.as_ref().ok_or_else(|| "the stored reference can't be read".to_owned())
}

/// The curve of vanishing elements as (s/B, q/s_u), to be drawn.
pub(super) fn limit_curve() -> Vec<(f64, f64)> {
    let points = document().ok().map(|d| &d.extrapolated.curve).into_iter().flatten();
    points.map(|p| (p.settlement, p.pressure)).collect()
}

/// Uncertainty of its greatest pressures.
pub(super) fn limit_uncertainty() -> f64 {
    document().map_or(f64::NAN, |d| d.extrapolated.limit_uncertainty)
}

/// Strength over Young's modulus of the reference.
pub(super) fn strength_ratio() -> f64 {
    document().map_or(f64::NAN, |d| d.strength / d.young_modulus)
}

/// The mean normal stress at a material point (in B), where it is known.
pub(super) fn mean_stress_at(point: [f64; 2]) -> Option<&'static MeanStress> {
    let known = &document().ok()?.extrapolated.mean_stress;
    known.iter().find(|s| [s.x, s.y] == point)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

/// The least domain (in B) that leaves Prandtl's mechanism room.
const ROOM: i32 = 3;

impl Setup<Footing> {
    /// Whether elements of vanishing size have a footing that acts as wide as that of the scheme; if not, those as large as cells.
    fn is_of_vanishing(&self) -> Result<bool, String> {
        if self.presses_by_barrier() {
            return Err("no elements press through a barrier: see contacts-agree".to_owned());
        }
        match self.effective_width().0 {
            width if width == WIDTH => Ok(true),
            width if width == WIDTH + self.h => Ok(false),
            _ => Err("no elements act as wide as splines with nodes on grid lines".to_owned()),
        }
    }

    /// Why the ground is too small for the mechanism to spread as in an endless one, if it is.
    pub(super) fn has_room(&self) -> Result<(), String> {
        match self.domain_width.min(self.domain_depth) < ROOM {
            true => Err(format!("the ground is less than {ROOM} B wide or deep")),
            false => Ok(()),
        }
    }

    /// The finite-element curve; that of other parameters has the same limit load.
    pub(super) fn reference_curve(&self) -> Result<Curve, String> {
        let document = document()?;
        self.has_room()?;
        if self.is_of_vanishing()? {
            if !self.rough {
                return Err("the extrapolated reference is that of a rough footing".to_owned());
            }
            return Ok(Curve {
                limit: document.extrapolated.limit,
                points: limit_curve(),
                name: "finite elements of vanishing size".to_owned(),
            });
        }
        let h = self.h;
        let contact = if self.rough { "rough" } else { "smooth" };
        let found = document.meshes.iter().find_map(|s| {
            let same = close(s.cells * h, WIDTH) && s.formulation == "mean_dilatation" && s.contact == contact;
            s.limit.filter(|_| same).map(|limit| (s, limit))
        });
        let Some((solution, limit)) = found else {
            return Err(format!("no {contact} reference with elements of {h} m"));
        };
        Ok(Curve {
            limit,
            points: (document.settlements.iter().copied()).zip(solution.pressures.iter().copied()).collect(),
            name: format!("B-bar finite elements of the same size, {} mesh", solution.mesh),
        })
    }

    /// The finite-element curve if all of it, not its limit load alone, is that of the parameters.
    pub(super) fn whole_reference_curve(&self) -> Result<Curve, String> {
        let (curve, document) = (self.reference_curve()?, document()?);
        let wanted = [
            ("poisson_ratio", self.poisson_ratio, document.poisson_ratio),
            ("domain_width", f64::from(self.domain_width), document.domain),
            ("domain_depth", f64::from(self.domain_depth), document.domain),
        ];
        for (name, own, value) in wanted {
            if !close(own, value) {
                return Err(format!("the curve is for {name} = {value}, not {own}"));
            }
        }
        let (ratio, known) = (self.strength_ratio(), strength_ratio());
        match close(ratio, known) {
            true => Ok(curve),
            false => Err(format!("the curve is for s_u/E = {known}, not {ratio}")),
        }
    }

    /// d(q/E)/d(s/B) of an elastic ground.
    pub(super) fn reference_slope(&self) -> Result<f64, String> {
        let document = document()?;
        if !self.rough {
            return Err("the slopes are those of a rough footing".to_owned());
        }
        let (ratio, h) = (self.poisson_ratio, self.h);
        let found = document.slopes.iter().find(|s| {
            close(s.poisson_ratio, ratio)
                && close(s.domain, f64::from(self.domain_width))
                && close(s.domain, f64::from(self.domain_depth))
        });
        let Some(slopes) = found else { return Err(format!("no slope for ν = {ratio} and this domain")) };
        let slope = if self.is_of_vanishing()? {
            slopes.slope
        } else {
            let same = slopes.meshes.iter().find(|s| close(s.cells * h, WIDTH));
            same.ok_or_else(|| format!("no slope with elements of {h} m"))?.slope
        };
        Ok(slope * strength_ratio())
    }
}

pub(super) fn describe() -> Vec<String> {
    let mut lines = vec![format!(
        "Prandtl (1920): limit load q = (2 + π) s_u = {EXACT:.4} s_u, exact for a rigid, perfectly plastic half-space"
    )];
    let Ok(document) = document() else { return lines };
    lines.push(document.method.clone());
    let rough = document.meshes.iter().filter(|s| s.formulation == "mean_dilatation" && s.contact == "rough");
    lines.extend(rough.filter_map(|s| {
        Some(format!(
            "B/{}, {} mesh: limit load {:.4} s_u by B, {:.4} by B + h; slope {:.0}",
            s.cells,
            s.mesh,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::ParameterSet;
    use crate::record::fixture::run;

    #[test]
    fn the_finite_elements_agree_with_prandtl_and_are_found() {
        let of = |basis, h, set: &[&str]| {
            let record = run(&Footing::list(), (basis, FbarConsistent), ("b20", h), set, &[]);
            Setup::<Footing>::of_record(&record).unwrap()
        };
        let vanishing = of(Bspline2, 0.05, &[]).reference_curve().unwrap();
        assert!((vanishing.limit - EXACT).abs() < 0.003);
        let elements = of(Gimp, 0.05, &[]).reference_curve().unwrap();
        assert!((elements.limit / 1.05 - EXACT).abs() < 0.01 * EXACT);
        for curve in [vanishing, elements] {
            assert!(CURVE.iter().all(|(_, s)| curve.at(*s).is_some()));
            assert_eq!(curve.at(0.0123), None);
        }
        assert!(MEAN_STRESSES.iter().all(|(_, x)| mean_stress_at(*x).is_some()));
        assert!(of(Gimp, 0.03, &[]).reference_curve().is_err());
        let other = of(Gimp, 0.05, &["poisson_ratio=0.3"]);
        assert!(other.reference_curve().is_ok() && other.whole_reference_curve().is_err());
    }
}
