//! Standing wave of a linear elastic bar in uniaxial strain (Achenbach 1973, *Wave Propagation in
//! Elastic Solids*, Chapter 1).
//!
//! u = A sin kX sin ωt on \[0, L\], ω = k c, c² = (λ + 2μ)/ρ₀, with k = nπ/L between fixed ends, or
//! k = (n − ½)π/L with the end X = L free. The stress is that of small strain ε = u,X:
//! P_XX = (λ + 2μ) ε, P_YY = P_ZZ = λ ε. No body force acts.
//!
//! A neo-Hookean bar has P_XX = (λ + 2μ) ε − (μ + 3λ/2) ε² + …, so it deviates by about the relative
//! amount ε of the largest strain kA, which is held below 0.01; the deviation of the frequency, an
//! even function of the amplitude, is of order (kA)².

use super::common::AMPLITUDE;
use super::{Entry, Exact, Material, require_below, sine};
use crate::Error;
use crate::parameter::{Domain, Parameter, Parameters, number, parameters};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Standing wave of a bar.
#[derive(Debug, Clone, Copy)]
pub struct VibratingBar {
    /// Density and moduli.
    pub material: Material,
    /// Length L (m).
    pub length: f64,
    /// Amplitude A (m).
    pub amplitude: f64,
    /// Wave number k (1/m).
    pub wave_number: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "vibrating-bar",
    summary: "standing wave of a linear elastic bar between fixed ends or with one free",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(VibratingBar::new(p)?)),
};

parameters! { pub const:
    LENGTH = "length", "m", "1", number(1e-3, 1e3, false), "length L";
    MODE = "mode", "-", "1", Domain::Integer { least: 1, most: 16 }, "number n of the mode";
    ENDS = "ends", "-", "fixed-fixed", Domain::Choice(&["fixed-fixed", "fixed-free"]),
        "what holds the ends X = 0 and X = L";
}

const PARAMETERS: [Parameter; 7] =
    Material::parameters(["1e7", "0.3"], [LENGTH, AMPLITUDE.with_default("1e-4"), MODE, ENDS]);

/// The largest strain kA for which linear elasticity is taken as exact.
const LINEAR: f64 = 0.01;

impl VibratingBar {
    /// The solution of the parameters of `vibrating-bar`.
    ///
    /// # Errors
    /// An amplitude that is too large for linear elasticity.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let half_waves = p.number(MODE) - if p.is(ENDS, "fixed-free") { 0.5 } else { 0.0 };
        let bar = Self {
            material: Material::new(p)?,
            length: p.number(LENGTH),
            amplitude: p.number(AMPLITUDE),
            wave_number: half_waves * PI / p.number(LENGTH),
        };
        require_below(
            ["amplitude", "m", "is too large for linear elasticity"],
            bar.amplitude,
            LINEAR / bar.wave_number,
        )?;
        Ok(bar)
    }

    /// λ + 2μ (Pa).
    fn modulus(&self) -> f64 {
        self.material.lambda + 2.0 * self.material.mu
    }

    /// ω = k √((λ + 2μ)/ρ₀) (rad/s).
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        self.wave_number * (self.modulus() / self.material.density).sqrt()
    }

    /// Kinetic and elastic energy together, per area of the bar's section: ¼ ρ₀ ω² A² L (J/m²).
    #[must_use]
    pub fn energy(&self) -> f64 {
        let speed = self.angular_frequency() * self.amplitude;
        0.25 * self.material.density * speed * speed * self.length
    }

    /// ε.
    fn strain(&self, x: f64, t: f64) -> f64 {
        let k = self.wave_number;
        self.amplitude * k * (k * x).cos() * sine(self.angular_frequency(), t)[0]
    }
}

impl Exact for VibratingBar {
    fn dimension(&self) -> usize {
        1
    }

    fn material(&self) -> Material {
        self.material
    }

    fn extent(&self) -> [[f64; 2]; 3] {
        [[0.0, self.length], [0.0; 2], [0.0; 2]]
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let shape = self.amplitude * (self.wave_number * x.x).sin();
        shape * sine(self.angular_frequency(), t)[0] * Vector3::x()
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        let shape = self.amplitude * (self.wave_number * x.x).sin();
        shape * sine(self.angular_frequency(), t)[1] * Vector3::x()
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        Matrix3::from_diagonal(&Vector3::new(1.0 + self.strain(x.x, t), 1.0, 1.0))
    }

    /// The stress of small strain, to which P and σ are the same.
    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let lambda = self.material.lambda;
        let axial = Vector3::new(self.modulus(), lambda, lambda);
        Matrix3::from_diagonal(&(self.strain(x.x, t) * axial))
    }

    fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn mean_stress(&self, x: &Vector3<f64>, t: f64) -> f64 {
        self.first_piola(x, t).trace() / 3.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    fn bar(ends: &str, amplitude: f64) -> VibratingBar {
        let set = [format!("ends={ends}"), "mode=2".to_owned(), format!("amplitude={amplitude}")];
        VibratingBar::new(&Parameters::new(&PARAMETERS, &set).unwrap()).unwrap()
    }

    #[test]
    fn it_solves_the_linear_equations_and_holds_its_ends() {
        for (ends, free) in [("fixed-fixed", false), ("fixed-free", true)] {
            let s = bar(ends, 1e-3);
            let period = 2.0 * PI / s.angular_frequency();
            check::solves(&s, period, |_| true);
            let (left, right) = (Vector3::zeros(), Vector3::x());
            let t = 0.3 * period;
            assert_eq!(s.displacement(&left, t).x, 0.0);
            let moved = s.displacement(&right, t).x.abs();
            let pulled = s.first_piola(&right, t)[(0, 0)].abs();
            let full = s.first_piola(&left, t)[(0, 0)].abs();
            assert_eq!(moved < 1e-15, !free);
            assert_eq!(pulled < 1e-10 * full, free);
        }
    }

    /// Halving the amplitude quarters what separates the stress from the neo-Hookean one.
    #[test]
    fn what_linearity_neglects_is_of_second_order() {
        let deviation = |amplitude: f64| {
            let s = bar("fixed-fixed", amplitude);
            let x = Vector3::new(0.1, 0.0, 0.0);
            let t = 0.5 * PI / s.angular_frequency();
            let exact = s.material.first_piola(&s.deformation_gradient(&x, t));
            (s.first_piola(&x, t) - exact).norm() / exact.norm()
        };
        let (coarse, fine) = (deviation(1e-3), deviation(5e-4));
        assert!(coarse < 0.01, "{coarse}");
        assert!((coarse / fine - 2.0).abs() < 0.02, "{}", coarse / fine);
    }

    /// The bulk modulus λ + 2μ/3 times the volumetric strain.
    #[test]
    fn the_mean_stress_is_that_of_the_volumetric_strain() {
        let s = bar("fixed-fixed", 1e-3);
        let (x, t) = (Vector3::x() * 0.1, 3e-4);
        let strain = s.jacobian(&x, t) - 1.0;
        let expected = (s.material.lambda + s.material.mu * 2.0 / 3.0) * strain;
        assert!((s.mean_stress(&x, t) - expected).abs() < 1e-10 * expected.abs());
    }

    /// Half ρ₀ v² + half P ε, integrated at several times.
    #[test]
    fn the_energy_is_constant_and_as_stated() {
        for ends in ["fixed-fixed", "fixed-free"] {
            let s = bar(ends, 1e-3);
            for t in [0.0, 3e-4, 1e-3] {
                let n = 1000;
                let total: f64 = (0..n)
                    .map(|i| {
                        let x = Vector3::x() * ((f64::from(i) + 0.5) / f64::from(n));
                        let stretch = s.deformation_gradient(&x, t)[(0, 0)] - 1.0;
                        s.material.density * s.velocity(&x, t).norm_squared() + s.first_piola(&x, t)[(0, 0)] * stretch
                    })
                    .sum::<f64>()
                    / f64::from(n)
                    / 2.0;
                assert!((total - s.energy()).abs() < 1e-9 * s.energy());
            }
        }
    }

    #[test]
    fn an_amplitude_beyond_linearity_is_refused() {
        let p = Parameters::new(&PARAMETERS, &["amplitude=0.01".to_owned()]).unwrap();
        let text = VibratingBar::new(&p).unwrap_err().to_string();
        assert!(text.contains("amplitude") && text.contains("below 0.00318"), "{text}");
    }
}
