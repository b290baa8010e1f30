//! Linear standing gravity wave of an inviscid, incompressible liquid in a box (Lamb 1932,
//! *Hydrodynamics*, §228).
//!
//! With k = nπ/L and ω² = g k tanh kH, in terms of the undisturbed place (X, Y), Y from the floor:
//!
//! η = a cos kX sin ωt,
//! u_x = −a (cosh kY/sinh kH) sin kX sin ωt, u_y = a (sinh kY/sinh kH) cos kX sin ωt,
//! p = ρ g (H − Y) + p′, p′ = ρ g η (cosh kY/cosh kH − sinh kY/sinh kH),
//!
//! p being the pressure of the *particle*: zero on the surface, which it follows, and thus short of
//! Lamb's by ρ g u_y. To first order P = −p cof F = −ρ g (H − Y) (I − ∇uᵀ) − p′ I, with which
//! ρ a = Div P − ρ g e_y holds exactly. Free slip on floor and sides.
//!
//! The wave starts flat. The largest displacement gradient, a k coth kH at the surface, is held below
//! 0.1; in deep water the true frequency is then lower by (ak)²/8 (Tadjbakhsh & Keller 1960, J. Fluid
//! Mech. 8, 442–451), about 0.1 %. J = det F is 1 to first order.

use super::common::{DENSITY, GRAVITY};
use super::{Entry, Exact, Material, require_below, sine};
use crate::Error;
use crate::parameter::{Domain, Parameter, Parameters, number, parameters};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Standing gravity wave, in plane strain.
#[derive(Debug, Clone, Copy)]
pub struct StandingWave {
    /// Density ρ (kg/m³).
    pub density: f64,
    /// Acceleration of gravity g (m/s²).
    pub gravity: f64,
    /// Width L of the box (m).
    pub width: f64,
    /// Depth H of the liquid at rest (m).
    pub depth: f64,
    /// Amplitude a of the surface (m).
    pub amplitude: f64,
    /// Wave number k (1/m).
    pub wave_number: f64,
}

/// This solution by its name.
pub const ENTRY: Entry = Entry {
    name: "standing-wave",
    summary: "linear standing gravity wave in a box",
    parameters: &PARAMETERS,
    build: |p| Ok(Box::new(StandingWave::new(p)?)),
};

parameters! { pub const:
    WIDTH = "width", "m", "1", number(1e-3, 1e3, false), "width L of the box";
    DEPTH = "depth", "m", "0.5", number(1e-3, 1e3, false), "depth H at rest";
    AMPLITUDE = "amplitude", "m", "0.01", number(0.0, 1e2, false), "amplitude a of the surface";
    HALF_WAVES = "half_waves", "-", "1", Domain::Integer { least: 1, most: 16 },
        "number n of half waves across the box, k = nπ/L";
}

const PARAMETERS: [Parameter; 6] = [DENSITY.with_default("997.5"), GRAVITY, WIDTH, DEPTH, AMPLITUDE, HALF_WAVES];

/// The largest displacement gradient for which the linear theory is taken as exact.
const LINEAR: f64 = 0.1;

impl StandingWave {
    /// The solution of the parameters of `standing-wave`.
    ///
    /// # Errors
    /// An amplitude that is too large for linear waves.
    pub fn new(p: &Parameters) -> Result<Self, Error> {
        let wave = Self {
            density: p.number(DENSITY),
            gravity: p.number(GRAVITY),
            width: p.number(WIDTH),
            depth: p.number(DEPTH),
            amplitude: p.number(AMPLITUDE),
            wave_number: p.number(HALF_WAVES) * PI / p.number(WIDTH),
        };
        require_below(
            ["amplitude", "m", "is too large for linear waves"],
            wave.amplitude,
            LINEAR * (wave.wave_number * wave.depth).tanh() / wave.wave_number,
        )?;
        Ok(wave)
    }

    /// ω = √(g k tanh kH) (rad/s).
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        let k = self.wave_number;
        (self.gravity * k * (k * self.depth).tanh()).sqrt()
    }

    /// Elevation η of the surface (m) at `x` (m).
    #[must_use]
    pub fn elevation(&self, x: f64, t: f64) -> f64 {
        self.amplitude * (self.wave_number * x).cos() * sine(self.angular_frequency(), t)[0]
    }

    /// Kinetic energy and the potential one above that of rest, per metre of breadth: ¼ ρ g a² L (J/m).
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.25 * self.density * self.gravity * self.amplitude.powi(2) * self.width
    }

    /// cosh kY/sinh kH and sinh kY/sinh kH, without overflow in deep water.
    fn decay(&self, y: f64) -> (f64, f64) {
        let k = self.wave_number;
        let (down, up) = ((k * (y - self.depth)).exp(), (-k * (y + self.depth)).exp());
        let scale = -(-2.0 * k * self.depth).exp_m1();
        ((down + up) / scale, (down - up) / scale)
    }

    /// Displacement per unit of sin ωt (m).
    fn shape(&self, x: &Vector3<f64>) -> Vector3<f64> {
        let (cosh, sinh) = self.decay(x.y);
        let (sin, cos) = (self.wave_number * x.x).sin_cos();
        self.amplitude * Vector3::new(-cosh * sin, sinh * cos, 0.0)
    }

    /// Displacement gradient ∇u.
    fn gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let (cosh, sinh) = self.decay(x.y);
        let (sin, cos) = (self.wave_number * x.x).sin_cos();
        let scale = self.amplitude * self.wave_number * sine(self.angular_frequency(), t)[0];
        let (stretch, shear) = (cosh * cos, -sinh * sin);
        scale * Matrix3::new(-stretch, shear, 0.0, shear, stretch, 0.0, 0.0, 0.0, 0.0)
    }

    /// ρ g (H − Y) and p′ (Pa).
    fn pressures(&self, x: &Vector3<f64>, t: f64) -> (f64, f64) {
        let weight = self.density * self.gravity;
        let (cosh, sinh) = self.decay(x.y);
        let tanh = (self.wave_number * self.depth).tanh();
        (weight * (self.depth - x.y), weight * self.elevation(x.x, t) * (cosh * tanh - sinh))
    }
}

impl Exact for StandingWave {
    fn material(&self) -> Material {
        Material { density: self.density, mu: 0.0, lambda: f64::INFINITY }
    }

    fn extent(&self) -> [[f64; 2]; 3] {
        [[0.0, self.width], [0.0, self.depth], [0.0; 2]]
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency(), t)[0]
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.shape(x) * sine(self.angular_frequency(), t)[1]
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        Matrix3::identity() + self.gradient(x, t)
    }

    /// P = −ρ g (H − Y) (I − ∇uᵀ) − p′ I.
    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        let (rest, wave) = self.pressures(x, t);
        rest * self.gradient(x, t).transpose() - Matrix3::identity() * (rest + wave)
    }

    fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::new(0.0, -self.gravity, 0.0)
    }

    fn mean_stress(&self, x: &Vector3<f64>, t: f64) -> f64 {
        let (rest, wave) = self.pressures(x, t);
        -(rest + wave)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    fn wave(set: &[&str]) -> StandingWave {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        StandingWave::new(&Parameters::new(&PARAMETERS, &set).unwrap()).unwrap()
    }

    #[test]
    fn it_solves_the_linear_equations_from_shallow_to_deep() {
        for depth in ["depth=0.2", "depth=0.5", "depth=3"] {
            let s = wave(&[depth, "half_waves=2"]);
            check::solves(&s, 2.0 * PI / s.angular_frequency(), |_| true);
        }
    }

    #[test]
    fn the_walls_hold_and_the_surface_is_free() {
        let s = wave(&[]);
        let t = 0.3;
        for y in [0.0, 0.2, 0.5] {
            assert_eq!(s.displacement(&Vector3::new(0.0, y, 0.0), t).x, 0.0);
            assert!(s.displacement(&Vector3::new(1.0, y, 0.0), t).x.abs() < 1e-15);
        }
        for x in [0.0, 0.3, 1.0] {
            assert!(s.displacement(&Vector3::new(x, 0.0, 0.0), t).y.abs() < 1e-15);
            let surface = Vector3::new(x, 0.5, 0.0);
            assert!(s.mean_stress(&surface, t).abs() < 1e-9);
            assert!((s.displacement(&surface, t).y - s.elevation(x, t)).abs() < 1e-15);
        }
    }

    /// Lamb's pressure at a place, ρ g (H − y) + ρ g η cosh ky/cosh kH, seen by the particle that is there.
    #[test]
    fn the_particles_pressure_is_lambs() {
        let s = wave(&[]);
        let (x, t) = (Vector3::new(0.2, 0.3, 0.0), 0.3);
        let k = s.wave_number;
        let height = x.y + s.displacement(&x, t).y;
        let eta = s.elevation(x.x, t);
        let lamb = s.density * s.gravity * (s.depth - height + eta * (k * x.y).cosh() / (k * s.depth).cosh());
        assert!((s.mean_stress(&x, t) + lamb).abs() < 1e-12 * lamb);
    }

    /// −p cof F, the stress of the liquid at finite displacement, halving the amplitude.
    #[test]
    fn what_linearity_neglects_is_of_second_order() {
        let deviation = |amplitude: &str| {
            let s = wave(&[amplitude]);
            let (x, t) = (Vector3::new(0.2, 0.3, 0.0), 0.3);
            let f = s.deformation_gradient(&x, t);
            let cofactor = f.determinant() * f.try_inverse().unwrap().transpose();
            let exact = s.mean_stress(&x, t) * cofactor;
            (s.first_piola(&x, t) - exact).fixed_view::<2, 2>(0, 0).norm()
        };
        let ratio = deviation("amplitude=0.01") / deviation("amplitude=0.005");
        assert!((ratio - 4.0).abs() < 0.05, "{ratio}");
    }

    /// Kinetic energy at t = 0 by quadrature; potential energy ½ ρ g ∫η² at a quarter period, and
    /// both in between.
    #[test]
    fn the_energy_is_constant_and_as_stated() {
        let s = wave(&["width=2", "depth=0.7"]);
        let n = 300;
        let middle = |i: i32, length: f64| (f64::from(i) + 0.5) / f64::from(n) * length;
        for phase in [0.0, 0.5, 1.5] {
            let t = phase / s.angular_frequency();
            let (mut kinetic, mut potential) = (0.0, 0.0);
            for i in 0..n {
                let x = middle(i, s.width);
                potential += 0.5 * s.gravity * s.elevation(x, t).powi(2) / f64::from(n);
                for j in 0..n {
                    let v = s.velocity(&Vector3::new(x, middle(j, s.depth), 0.0), t);
                    kinetic += 0.5 * v.norm_squared() * s.depth / f64::from(n * n);
                }
            }
            let total = s.density * s.width * (kinetic + potential);
            assert!((total - s.energy()).abs() < 1e-4 * s.energy(), "{phase}");
        }
    }

    #[test]
    fn an_amplitude_beyond_linearity_is_refused() {
        let p = Parameters::new(&PARAMETERS, &["amplitude=0.03".to_owned()]).unwrap();
        let text = StandingWave::new(&p).unwrap_err().to_string();
        assert!(text.contains("amplitude") && text.contains("below 0.029"), "{text}");
    }
}
