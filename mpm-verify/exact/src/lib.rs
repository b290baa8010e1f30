//! Exact solutions: what a particle does at its reference point X and time t, in closed form.
//!
//! The manufactured ones (`mms-…`) hold for the neo-Hookean solid and need a body force; the others are solutions in
//! their own right. One file each; `docs/exact.md` lists them. All motions except the column at rest start undeformed,
//! so that a simulation needs only the initial velocity. [`slope`] is no motion but a limit load.

pub mod axis_aligned;
pub mod cantilever;
#[cfg(test)]
mod check;
pub mod clay;
pub mod common;
pub mod consolidation;
pub mod dam_break;
pub mod double_shear;
pub mod free_beam;
mod free_fall;
pub mod free_flight;
pub mod ground;
pub mod hydrostatic;
pub mod incline;
pub mod lattice;
pub mod mandel;
mod material;
pub mod parameter;
mod patch;
pub mod poro;
mod rigid;
pub mod shock;
pub mod slope;
pub mod stable_step;
pub mod standing_wave;
pub mod stretched_lattice;
pub mod swirl;
pub mod terzaghi;
pub mod transfers;
pub mod twist;
pub mod uniaxial;
pub mod vibrating_bar;
pub mod vortex_box;
pub mod vortex_pressure;
pub mod vortex_ring;
pub mod wall_pressure;

pub use axis_aligned::AxisAligned;
pub use double_shear::DoubleShear;
pub use free_fall::FreeFall;
pub use hydrostatic::Hydrostatic;
pub use incline::Incline;
pub use material::Material;
pub use patch::Patch;
pub use rigid::{Rotation, Translation};
pub use slope::Slope;
pub use standing_wave::StandingWave;
pub use twist::Vortex;
pub use vibrating_bar::VibratingBar;
pub use vortex_pressure::VortexPressure;
pub use wall_pressure::WallPressure;

use nalgebra::{Matrix3, Vector3};
use parameter::{Parameter, Parameters, Value, number, parameter};
use serde::Serialize;
use std::fmt;

/// The root of a falling function between two ends, until no number is left between them.
pub fn root((mut low, mut high): (f64, f64), of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if of(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Invalid request; the text names the valid values.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Error(pub String);

impl Error {
    /// "unknown {kind} "{given}"; allowed: …".
    #[must_use]
    pub fn unknown<'a>(kind: &str, given: &str, allowed: impl IntoIterator<Item = &'a str>) -> Self {
        let allowed: Vec<&str> = allowed.into_iter().collect();
        Self(format!("unknown {kind} \"{given}\"; allowed: {}", allowed.join(", ")))
    }
}

/// An exact solution. Reference points have three components, of which those beyond
/// [`Exact::dimension`] are ignored; a motion in fewer dimensions is one of uniaxial or plane strain.
pub trait Exact: fmt::Debug + Send + Sync {
    /// Dimension of the motion: 1 (uniaxial strain), 2 (plane strain, unless said) or 3.
    fn dimension(&self) -> usize {
        2
    }

    /// Density and moduli.
    fn material(&self) -> Material;

    /// Least and greatest reference coordinate of the body on each axis of the motion (m); a unit cube unless said.
    fn extent(&self) -> [[f64; 2]; 3] {
        [[0.0, 1.0]; 3]
    }

    /// Displacement u = x − X (m).
    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64>;

    /// Velocity v = ∂u/∂t (m/s).
    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64>;

    /// Deformation gradient F = I + ∂u/∂X.
    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64>;

    /// J = det F.
    fn jacobian(&self, x: &Vector3<f64>, t: f64) -> f64 {
        self.deformation_gradient(x, t).determinant()
    }

    /// First Piola–Kirchhoff stress P (Pa); that of the neo-Hookean solid unless said.
    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        self.material().first_piola(&self.deformation_gradient(x, t))
    }

    /// Body force b per unit mass (m/s²), such that ρ₀ ∂²u/∂t² = Div P + ρ₀ b.
    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64>;

    /// Mean Cauchy stress σ_m = tr(P Fᵀ)/(3J) (Pa), tension positive.
    fn mean_stress(&self, x: &Vector3<f64>, t: f64) -> f64 {
        let f = self.deformation_gradient(x, t);
        self.first_piola(x, t).dot(&f) / (3.0 * self.jacobian(x, t))
    }
}

/// A solution by name.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Name.
    pub name: &'static str,
    /// Summary in one line.
    pub summary: &'static str,
    /// Parameters.
    pub parameters: &'static [Parameter],
    /// Makes the solution of some parameters, or says which is not allowed.
    pub build: fn(&Parameters) -> Result<Box<dyn Exact>, Error>,
}

/// All solutions.
#[must_use]
pub fn all() -> &'static [Entry] {
    const ALL: [Entry; 15] = [
        axis_aligned::ENTRY,
        vortex_ring::ENTRY,
        vortex_box::ENTRY,
        vortex_pressure::ENTRY,
        double_shear::ENTRY,
        swirl::ENTRY,
        wall_pressure::ENTRY,
        hydrostatic::ENTRY,
        incline::ENTRY,
        vibrating_bar::ENTRY,
        standing_wave::ENTRY,
        rigid::TRANSLATION,
        rigid::ROTATION,
        patch::ENTRY,
        free_fall::ENTRY,
    ];
    &ALL
}

/// The solution of a name.
///
/// # Errors
/// The name is unknown; the error lists the known names.
pub fn find(name: &str) -> Result<&'static Entry, Error> {
    all()
        .iter()
        .find(|e| e.name == name)
        .ok_or_else(|| Error::unknown("exact solution", name, all().iter().map(|e| e.name)))
}

/// Everything a solution says of a point and time. Vectors have as many components as the motion has
/// dimensions; matrices are 3 × 3, by rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct State {
    /// Displacement (m).
    pub u: Vec<f64>,
    /// Velocity (m/s).
    pub v: Vec<f64>,
    /// Deformation gradient.
    #[serde(rename = "F")]
    pub f: [[f64; 3]; 3],
    /// J = det F.
    #[serde(rename = "J")]
    pub j: f64,
    /// First Piola–Kirchhoff stress (Pa).
    #[serde(rename = "P")]
    pub p: [[f64; 3]; 3],
    /// Body force per unit mass (m/s²).
    pub b: Vec<f64>,
    /// Mean Cauchy stress (Pa).
    pub mean_stress: f64,
}

impl State {
    /// The state of `solution` at the reference point `x` (m) and time `t` (s).
    #[must_use]
    pub fn of(solution: &dyn Exact, x: &Vector3<f64>, t: f64) -> Self {
        let components = |v: Vector3<f64>| v.iter().copied().take(solution.dimension()).collect();
        let rows = |m: Matrix3<f64>| m.transpose().into();
        Self {
            u: components(solution.displacement(x, t)),
            v: components(solution.velocity(x, t)),
            f: rows(solution.deformation_gradient(x, t)),
            j: solution.jacobian(x, t),
            p: rows(solution.first_piola(x, t)),
            b: components(solution.body_force(x, t)),
            mean_stress: solution.mean_stress(x, t),
        }
    }

    /// The state as the command line asks for it: the name of the solution, comma-separated
    /// coordinates (m), the time (s) and parameters as `name=value`.
    ///
    /// # Errors
    /// An unknown name, a parameter that is not allowed, a point off the body, a time that is not finite.
    pub fn ask(name: &str, at: &str, time: &str, set: &[String]) -> Result<Self, Error> {
        let entry = find(name)?;
        let solution = (entry.build)(&Parameters::new(entry.parameters, set)?)?;
        let x = reference_point(solution.as_ref(), at)?;
        let t = read(&parameter("--time", "s", "0", number(-1e6, 1e6, false), ""), time)?;
        Ok(Self::of(solution.as_ref(), &x, t))
    }

    /// The state as one JSON object on a line.
    ///
    /// # Errors
    /// None in practice: numbers can always be written.
    pub fn json(&self) -> Result<String, Error> {
        match serde_json::to_string(self) {
            Ok(text) => Ok(text + "\n"),
            Err(e) => Err(Error(e.to_string())),
        }
    }
}

/// A point of the body from its comma-separated coordinates.
fn reference_point(solution: &dyn Exact, at: &str) -> Result<Vector3<f64>, Error> {
    let names = &["--at x", "--at y", "--at z"][..solution.dimension()];
    let coordinates: Vec<&str> = at.split(',').collect();
    if coordinates.len() != names.len() {
        return Err(Error(format!(
            "--at \"{at}\" has {} coordinates; allowed: {}, separated by commas",
            coordinates.len(),
            names.len()
        )));
    }
    let mut x = Vector3::zeros();
    for (i, text) in coordinates.iter().enumerate() {
        let [least, most] = solution.extent()[i];
        let coordinate = parameter(names[i], "m", "", number(least, most, false), "");
        x[i] = read(&coordinate, text)?;
    }
    Ok(x)
}

fn read(what: &Parameter, text: &str) -> Result<f64, Error> {
    match what.parse(text.trim())? {
        Value::Number(x) => Ok(x),
        _ => Err(Error(format!("{} is not a number", what.name))),
    }
}

/// Refuses the parameter `name` if its size is not below `limit`, with what happens otherwise.
fn require_below([name, unit, otherwise]: [&str; 3], value: f64, limit: f64) -> Result<(), Error> {
    if value.abs() < limit {
        return Ok(());
    }
    Err(Error(format!("parameter {name}: {value} {otherwise}; allowed: a size below {limit} ({unit})")))
}

/// Error if the amplitude of a motion is too large.
const INVERTS: &str = "turns the body inside out (J ≤ 0)";

/// sin ωt with its first and second derivative in time.
fn sine(angular_frequency: f64, t: f64) -> [f64; 3] {
    let (sin, cos) = (angular_frequency * t).sin_cos();
    [sin, angular_frequency * cos, -angular_frequency * angular_frequency * sin]
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;
    use std::collections::BTreeMap;

    /// A record of the reference file: an independent evaluation with sixty digits, P from x(X, t) and its
    /// divergence by differences.
    #[derive(Deserialize)]
    struct Record {
        params: BTreeMap<String, f64>,
        points: Vec<Point>,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Point {
        #[serde(rename = "X")]
        x: Vec<f64>,
        t: f64,
        u: Vec<f64>,
        v: Vec<f64>,
        #[serde(rename = "F")]
        f: Vec<Vec<f64>>,
        #[serde(rename = "J")]
        j: f64,
        #[serde(rename = "P")]
        p: Vec<Vec<f64>>,
        b: Vec<f64>,
    }

    /// The entries of the tables that the dimension of the motion has, as one list.
    fn flat(rows: &[impl AsRef<[f64]>], dimension: usize) -> Vec<f64> {
        let rows = rows.iter().take(dimension);
        rows.flat_map(|row| row.as_ref().iter().copied().take(dimension)).collect()
    }

    /// A state and a point of reference, field by field.
    fn fields(state: &State, point: &Point) -> [(&'static str, Vec<f64>, Vec<f64>); 6] {
        let d = point.x.len();
        [
            ("u", state.u.clone(), point.u.clone()),
            ("v", state.v.clone(), point.v.clone()),
            ("F", flat(&state.f, d), flat(&point.f, d)),
            ("J", vec![state.j], vec![point.j]),
            ("P", flat(&state.p, d), flat(&point.p, d)),
            ("b", state.b.clone(), point.b.clone()),
        ]
    }

    fn size(v: &[f64]) -> f64 {
        v.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    #[test]
    fn the_spot_values_of_the_reference_are_met() {
        let text = include_str!("../../references/mms.json");
        let records: BTreeMap<String, Record> = serde_json::from_str(text).unwrap();
        let solutions = [
            ("axis1D", "mms-axis", "dimension=1"),
            ("axis2D", "mms-axis", "dimension=2"),
            ("axis3D", "mms-axis", "dimension=3"),
            ("vortex_ring", "mms-vortex-ring", "poisson_ratio=0.3"),
            ("vortex_box_nu0.3", "mms-vortex-box", "poisson_ratio=0.3"),
            ("vortex_box_nu0.499", "mms-vortex-box", "poisson_ratio=0.499"),
            ("vortex_box_pressure_nu0.499", "mms-vortex-pressure", "poisson_ratio=0.499"),
            ("double_shear_periodic", "mms-double-shear", "poisson_ratio=0.4999"),
        ];
        assert_eq!(solutions.len(), records.len());
        for (record, name, set) in solutions {
            let Record { params, points } = &records[record];
            let s = check::solution(find(name).unwrap(), &[set]);
            let Material { density, mu, lambda } = s.material();
            assert_eq!(density, params["rho"]);
            assert!((mu / params["mu"] - 1.0).abs() < 1e-12);
            assert!((lambda / params["lam"] - 1.0).abs() < 1e-12);
            let pairs: Vec<_> = points
                .iter()
                .flat_map(|point| {
                    let mut x = Vector3::zeros();
                    x.as_mut_slice()[..point.x.len()].copy_from_slice(&point.x);
                    fields(&State::of(s.as_ref(), &x, point.t), point)
                })
                .collect();
            for (field, found, expected) in &pairs {
                let largest = pairs
                    .iter()
                    .filter(|(other, ..)| other == field)
                    .map(|(_, _, expected)| size(expected))
                    .fold(0.0, f64::max);
                let error: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
                assert!(
                    found.len() == expected.len() && size(&error) <= 1e-12 * largest,
                    "{record} {field}: {found:?} instead of {expected:?}"
                );
            }
        }
    }

    #[test]
    fn every_entry_builds_with_its_defaults_and_starts_undeformed() {
        for entry in all() {
            let s = check::solution(entry, &[]);
            assert!((1..=3).contains(&s.dimension()));
            let x = Vector3::new(0.3, 0.4, 0.6);
            if !["hydrostatic", "incline"].contains(&entry.name) {
                assert!(s.displacement(&x, 0.0).norm() < 1e-15, "{}", entry.name);
            }
            for p in entry.parameters {
                assert!(!p.meaning.is_empty() && p.parse(p.default).is_ok());
            }
        }
        let mut names: Vec<&str> = all().iter().map(|e| e.name).collect();
        names.dedup();
        assert_eq!(names.len(), all().len());
        assert!(find("mms-vortex").is_err());
    }
}
