//! Axis-aligned displacement in one, two or three dimensions (Wallstedt & Guilkey 2008,
//! doi:10.1016/j.jcp.2008.07.019, with a phase per axis).
//!
//! u_i = A sin(k X_i) T_i, T_i = sin(ωt + φ_i) − sin φ_i, φ = 0, 2π/3, 4π/3 on the cube \[0, 1\]^d. F is
//! diagonal and so is P; u_i = 0 where X_i = 0 or 1: rollers on all sides are exact.

use super::common::{AMPLITUDE, ANGULAR_FREQUENCY, DIMENSION};
use super::{Entry, Exact, INVERTS, Material, require_below};
use crate::Error;
use crate::parameter::{Domain, Parameter, Parameters, parameters};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Axis-aligned displacement.
#[derive(Debug, Clone, Copy)]
pub struct AxisAligned {
    /// Density and moduli.
    pub material: Material,
    /// Dimension d.
    pub dimension: usize,
    /// Amplitude A (m).
    pub amplitude: f64,
    /// Wave number k (1/m), a multiple of π.
    pub wave_number: f64,
    /// Angular frequency ω (rad/s).
    pub angular_frequency: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "mms-axis",
    summary: "axis-aligned displacement, d = 1, 2, 3",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(AxisAligned::new(p)?)),
};

parameters! { pub const:
    HALF_WAVES = "half_waves", "-", "2", Domain::Integer { least: 1, most: 16 },
        "number of half waves m across the body, k = mπ";
}

const PARAMETERS: [Parameter; 7] = Material::parameters(
    ["1e7", "0.3"],
    [
        DIMENSION,
        AMPLITUDE,
        HALF_WAVES,
        // π √(E/ρ₀): one period of 0.02 s.
        ANGULAR_FREQUENCY.with_default("314.1592653589793"),
    ],
);

impl AxisAligned {
    /// The solution of the parameters of `mms-axis`.
    ///
    /// # Errors
    /// An amplitude with which F_ii reaches zero.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let solution = Self {
            material: Material::new(p)?,
            dimension: p.number(DIMENSION) as usize,
            amplitude: p.number(AMPLITUDE),
            wave_number: p.number(HALF_WAVES) * PI,
            angular_frequency: p.number(ANGULAR_FREQUENCY),
        };
        // |T_i| ≤ 1 + |sin φ_i|, and cos kX reaches ±1.
        let largest = (0..solution.dimension).map(|i| 1.0 + phase(i).sin().abs());
        let limit = 1.0 / (solution.wave_number * largest.fold(0.0, f64::max));
        require_below(["amplitude", "m", INVERTS], solution.amplitude, limit)?;
        Ok(solution)
    }

    /// T_i(t) = sin(ωt + φ_i) − sin φ_i.
    fn growth(&self, i: usize, t: f64) -> f64 {
        (self.angular_frequency * t + phase(i)).sin() - phase(i).sin()
    }

    fn stretch(&self, i: usize, x: &Vector3<f64>, t: f64) -> f64 {
        let k = self.wave_number;
        1.0 + self.amplitude * k * (k * x[i]).cos() * self.growth(i, t)
    }

    /// A vector of one expression per axis of the motion.
    fn each(&self, expression: impl Fn(usize) -> f64) -> Vector3<f64> {
        Vector3::from_fn(|i, _| if i < self.dimension { expression(i) } else { 0.0 })
    }
}

/// φ_i = 2πi/3.
fn phase(i: usize) -> f64 {
    TAU * i as f64 / 3.0
}

impl Exact for AxisAligned {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn material(&self) -> Material {
        self.material
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.each(|i| self.amplitude * (self.wave_number * x[i]).sin() * self.growth(i, t))
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let (a, k, w) = (self.amplitude, self.wave_number, self.angular_frequency);
        self.each(|i| a * w * (k * x[i]).sin() * (w * t + phase(i)).cos())
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let mut f = Matrix3::identity();
        for i in 0..self.dimension {
            f[(i, i)] = self.stretch(i, x, t);
        }
        f
    }

    /// b_i = −A ω² sin(kX_i) sin(ωt + φ_i) + (k² u_i/ρ₀) \[μ + (μ + λ (1 − ln J))/F_ii²\].
    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let (a, k, w) = (self.amplitude, self.wave_number, self.angular_frequency);
        let u = self.displacement(x, t);
        let ln_j = self.jacobian(x, t).ln();
        self.each(|i| {
            let tangent = self.material.axial_tangent(self.stretch(i, x, t), ln_j);
            -a * w * w * (k * x[i]).sin() * (w * t + phase(i)).sin() + k * k * u[i] / self.material.density * tangent
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn it_solves_the_equations_between_rollers_in_every_dimension() {
        for d in ["1", "2", "3"] {
            let s = check::solution(&ENTRY, &[&format!("dimension={d}"), "half_waves=3", "amplitude=0.03"]);
            check::solves_as_neo_hookean(s.as_ref(), 0.02, |_| true);
            check::between_rollers(s.as_ref(), 0.02);
        }
    }

    #[test]
    fn the_largest_amplitude_leaves_j_positive() {
        for (d, limit) in [(1, 1.0 / TAU), (2, 1.0 / (TAU * (1.0 + 0.75_f64.sqrt())))] {
            let built = |a: f64| {
                let set = [format!("dimension={d}"), format!("amplitude={a}")];
                AxisAligned::new(&Parameters::new(&PARAMETERS, &set).unwrap())
            };
            let s = built(limit * (1.0 - 1e-9)).unwrap();
            let least = (0..2000)
                .map(|n| s.jacobian(&Vector3::new(0.0, 0.0, 0.0), 1e-5 * f64::from(n)))
                .fold(f64::INFINITY, f64::min);
            assert!(least > 0.0 && least < 0.02, "{least}");
            let text = built(limit * (1.0 + 1e-9)).unwrap_err().to_string();
            assert!(text.contains("amplitude") && text.contains("below"), "{text}");
        }
    }
}
