//! A motion of solid and water that a body force and a source of water make: quasi-static, at finite strain, in one, two
//! or three dimensions, with gravity along the last axis.
//!
//! On the unit cube, with S = sin, C = cos of πX and cross sections that bulge,
//!
//! u_a = A sin(ωt) S(X_a) Π_{b≠a} C(X_b),
//! p = ρ_w g (1 − x_d) + P (1 − cos ωt) cos(πX_d/2) Π_{b≠d} (1 + ½ C(X_b)),  x = X + u.
//!
//! On every side u has no normal component and F is diagonal: rollers are exact. There p varies along the normal as ρ_w
//! g·x does, so that no water passes; at the top, X_d = 1, p = 0 instead. At t = 0 nothing is strained and the water is
//! at rest. Per undeformed volume equilibrium and the balance of water are
//!
//! Div P + m g + ρ b = 0,  P = (σ′ − p I) cof F,  m = ρ_s (1 − n₀) + ρ_w (J − 1 + n₀),
//! ∂J/∂t + Div Q = s,  Q = −κ(n) cof Fᵀ (F⁻ᵀ ∇p − ρ_w g),  n = 1 − (1 − n₀)/J.
//!
//! F and ∇p are written out; the divergences and ∂J/∂t, which b and s are made of, are derivatives on dual numbers.
//! Law, logarithm and conductivity are written here once more, by the papers and not by the solver, whose own would err
//! along with it. Tests compare all with differences of a P and a Q that know neither.

use mpm_core::number::{Dual, Real};
use nalgebra::Matrix3;
use std::f64::consts::PI;

/// Three coordinates and the time.
type Number = Dual<4>;

/// Gauss's rule of ten points on (−1, 1), half of it: places and weights (Abramowitz & Stegun, Table 25.4).
const GAUSS: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_2, 0.295_524_224_714_752_9],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_4],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_1],
];

/// The motion.
#[derive(Debug, Clone, Copy)]
pub struct SolidAndWater {
    /// Dimension d, 1 to 3.
    pub dimension: usize,
    /// Bulk parameter K and shear modulus G of the solid (Pa): improved Hencky.
    pub moduli: [f64; 2],
    /// Porosity n₀ of undeformed material.
    pub porosity: f64,
    /// κ of undeformed material (m²/(Pa s)).
    pub kappa: f64,
    /// Whether κ changes with the porosity as n³/(1 − n)², after Kozeny and Carman.
    pub kozeny_carman: bool,
    /// Densities of water and grains (kg/m³).
    pub densities: [f64; 2],
    /// Acceleration of gravity g (m/s²), against the last axis.
    pub gravity: f64,
    /// Amplitude A of the displacement (m).
    pub amplitude: f64,
    /// Amplitude P of the pressure beside that of the water's weight (Pa).
    pub pressure: f64,
    /// Angular frequency ω (rad/s).
    pub angular_frequency: f64,
}

/// State of the solution at a reference point and time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Displacement (m).
    pub displacement: [f64; 3],
    /// F, by rows.
    pub deformation_gradient: Matrix3<f64>,
    /// J.
    pub jacobian: f64,
    /// Pore pressure p (Pa), compression positive.
    pub pressure: f64,
    /// Effective Cauchy stress σ′ (Pa).
    pub stress: Matrix3<f64>,
    /// P (Pa).
    pub first_piola: Matrix3<f64>,
    /// Q (m/s).
    pub flux: [f64; 3],
    /// b, per unit of the mass of dry grains, ρ = ρ_s (1 − n₀) (m/s²).
    pub body_force: [f64; 3],
    /// ∂J/∂t (1/s).
    pub rate: f64,
    /// Div Q (1/s).
    pub outflow: f64,
}

fn sine(x: Number) -> Number {
    let (sin, cos) = x.value.sin_cos();
    Dual { value: sin, slope: x.slope.map(|slope| cos * slope) }
}

fn cosine(x: Number) -> Number {
    sine(x + Dual::splat(0.5 * PI))
}

fn product(of: impl Fn(usize) -> Number) -> Number {
    of(0) + of(1) + of(2)
}

fn identity() -> Matrix3<Number> {
    Matrix3::from_fn(|i, k| Number::splat(f64::from(u8::from(i == k))))
}

fn cofactors(f: &Matrix3<Number>) -> Matrix3<Number> {
    Matrix3::from_fn(|i, k| {
        let (a, b, c, e) = ((i + 1) % 3, (i + 2) % 3, (k + 1) % 3, (k + 2) % 3);
        f[(a, c)] * f[(b, e)] - f[(a, e)] * f[(b, c)]
    })
}

/// det F by its cofactors.
fn determinant(f: &Matrix3<Number>, cofactors: &Matrix3<Number>) -> Number {
    product(|k| f[(0, k)] * cofactors[(0, k)])
}

/// ln b = ∫₀¹ (b − I)(I + t (b − I))⁻¹ dt of a symmetric b. The rule errs by less than 10⁻¹⁵ where stretches are from 0.7
/// to 1.4: by ((λ − 1)/(λ + 1))²⁰.
fn logarithm(b: &Matrix3<Number>) -> Matrix3<Number> {
    let excess = b.zip_map(&identity(), |b, one| b - one);
    let mut sum = Matrix3::from_element(Number::default());
    for ([place, weight], sign) in GAUSS.into_iter().flat_map(|of| [(of, -0.5), (of, 0.5)]) {
        let between = identity().zip_map(&excess, |one, e| one + Number::splat(0.5 + sign * place) * e);
        let inverse = cofactors(&between);
        let share = Number::splat(0.5 * weight) / determinant(&between, &inverse);
        sum = Matrix3::from_fn(|i, k| sum[(i, k)] + share * product(|m| excess[(i, m)] * inverse[(m, k)]));
    }
    sum
}

impl SolidAndWater {
    /// Kirchhoff's effective stress τ = 2G dev h + [K v/n − K v² (1 − n)/(2n²)] I (Pa), h = ½ ln FFᵀ, v = tr h: improved
    /// Hencky of Pretti et al. (2024), doi:10.1016/j.mechmat.2024.104958, ψ = G ‖dev h‖² + K v²/(2n) with dn/dv = 1 − n.
    fn kirchhoff(&self, f: &Matrix3<Number>, n: Number) -> Matrix3<Number> {
        let [bulk, shear] = self.moduli.map(Number::splat);
        let half = Number::splat(0.5);
        let b = Matrix3::from_fn(|i, k| product(|m| f[(i, m)] * f[(k, m)]));
        let h = logarithm(&b).map(|l| half * l);
        let v = product(|a| h[(a, a)]);
        let mean = bulk * v / n - half * bulk * v * v * (Number::splat(1.0) - n) / (n * n);
        let rest = mean - Number::splat(2.0 / 3.0) * shear * v;
        Matrix3::from_fn(|i, k| (shear + shear) * h[(i, k)] + if i == k { rest } else { Number::default() })
    }

    /// κ (m²/(Pa s)) at the porosity `n`, as a multiple of that of undeformed material.
    fn conductivity(&self, n: Number) -> Number {
        if !self.kozeny_carman {
            return Number::splat(self.kappa);
        }
        let (pores, solid) =
            (n / Number::splat(self.porosity), (Number::splat(1.0) - n) / Number::splat(1.0 - self.porosity));
        Number::splat(self.kappa) * pores * pores * pores / (solid * solid)
    }

    /// Mass of dry grains in undeformed volume, ρ (kg/m³).
    #[must_use]
    pub fn dry_density(&self) -> f64 {
        self.densities[1] * (1.0 - self.porosity)
    }

    /// State at the reference point `x` (m), of whose components the first `dimension` count, and the time `t` (s).
    #[must_use]
    pub fn at(&self, x: [f64; 3], t: f64) -> Moment {
        let (d, number) = (self.dimension, Number::splat);
        let zero = Number::default();
        let time = number(self.angular_frequency) * Dual::variable(t, 3);
        let phase = |a: usize| number(PI) * Dual::variable(x[a], a);
        let along = |a: usize, of: fn(Number) -> Number, beyond: f64| {
            if a < d { of(phase(a)) } else { number(beyond) }
        };
        let s: [Number; 3] = [0, 1, 2].map(|a| along(a, sine, 0.0));
        let c: [Number; 3] = [0, 1, 2].map(|a| along(a, cosine, 1.0));
        let without = |of: &dyn Fn(usize) -> Number, out: [usize; 2]| {
            let rest = (0..3).filter(|b| !out.contains(b));
            rest.fold(number(1.0), |product, b| product * of(b))
        };
        let grown = number(self.amplitude) * sine(time);
        let displacement = |a: usize| grown * s[a] * without(&|b| c[b], [a, a]);
        let f = Matrix3::from_fn(|a, b| {
            let slope = match (a < d && b < d, a == b) {
                (false, _) => zero,
                (true, true) => grown * c[a] * without(&|b| c[b], [a, a]),
                (true, false) => -(grown * s[a] * s[b]) * without(&|b| c[b], [a, b]),
            };
            number(PI) * slope + number(f64::from(u8::from(a == b)))
        });

        let top = d - 1;
        let weight = self.densities[0] * self.gravity;
        let depth = number(1.0) - Dual::variable(x[top], top) - displacement(top);
        let half = number(0.5);
        let bulge = |b: usize| {
            if b < d { number(1.0) + half * c[b] } else { number(1.0) }
        };
        let excess = number(self.pressure) * (number(1.0) - cosine(time));
        let (upright, across) = (half * phase(top), without(&bulge, [top, top]));
        let p = number(weight) * depth + excess * cosine(upright) * across;
        let slope: [Number; 3] = [0, 1, 2].map(|i| {
            let shape = match (i < d, i == top) {
                (false, _) => zero,
                (true, true) => -(half * sine(upright) * across),
                (true, false) => -(half * s[i] * cosine(upright)) * without(&bulge, [top, i]),
            };
            number(PI) * excess * shape - number(weight) * f[(top, i)]
        });

        let cofactor = cofactors(&f);
        let j = determinant(&f, &cofactor);
        let n = number(1.0) - number(1.0 - self.porosity) / j;
        let effective = self.kirchhoff(&f, n).map(|tau| tau / j);
        let piola = Matrix3::from_fn(|i, k| {
            let total = |m: usize| effective[(i, m)] - if i == m { p } else { zero };
            product(|m| total(m) * cofactor[(m, k)])
        });
        let conductivity = self.conductivity(n);
        let head: [Number; 3] = [0, 1, 2].map(|i| {
            let pushed = product(|k| cofactor[(i, k)] * slope[k]) / j;
            pushed + number(if i == top { weight } else { 0.0 })
        });
        let flux: [Number; 3] = [0, 1, 2].map(|k| -(conductivity * product(|i| cofactor[(i, k)] * head[i])));

        let mass = self.dry_density() + self.densities[0] * (j.value - 1.0 + self.porosity);
        let body_force = [0, 1, 2].map(|i| {
            let divergence: f64 = (0..d).map(|k| piola[(i, k)].slope[k]).sum();
            let pull = if i == top { -self.gravity * mass } else { 0.0 };
            -(divergence + pull) / self.dry_density()
        });
        Moment {
            displacement: [0, 1, 2].map(|a| displacement(a).value),
            deformation_gradient: f.map(|f| f.value),
            jacobian: j.value,
            pressure: p.value,
            stress: effective.map(|s| s.value),
            first_piola: piola.map(|p| p.value),
            flux: flux.map(|q| q.value),
            body_force,
            rate: j.slope[3],
            outflow: (0..d).map(|k| flux[k].slope[k]).sum(),
        }
    }

    /// Water that comes in at the reference point `x` (m) between two times (s), over the undeformed volume: what one
    /// step of backward Euler needs for the rates at its end, s Δt, or with `whole` for what J changes by and the flux
    /// at its end, whose solution is the exact one at the ends of all steps.
    #[must_use]
    pub fn inflow(&self, x: [f64; 3], [begin, end]: [f64; 2], whole: bool) -> f64 {
        let last = self.at(x, end);
        let dt = end - begin;
        let stored = if whole { last.jacobian - self.at(x, begin).jacobian } else { dt * last.rate };
        stored + dt * last.outflow
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::slope;
    use super::*;
    use nalgebra::Vector3;

    const POROSITY: f64 = 0.4;
    const BULK: f64 = 2.5e4;
    const SHEAR: f64 = 4e4;

    fn motion(dimension: usize) -> SolidAndWater {
        SolidAndWater {
            dimension,
            moduli: [BULK, SHEAR],
            porosity: POROSITY,
            kappa: 5e-8 * POROSITY.powi(3) / (1.0 - POROSITY).powi(2),
            kozeny_carman: true,
            densities: [1000.0, 2600.0],
            gravity: 10.0,
            amplitude: 0.04,
            pressure: 2e4,
            angular_frequency: 0.02,
        }
    }

    /// Points of the body and times without pattern.
    fn samples() -> impl Iterator<Item = ([f64; 3], f64)> {
        let part = |n: usize, stride: f64| (0.37 + n as f64 * stride).fract();
        (0..20).map(move |n| {
            let x = [0.856_674_9, 0.733_891_9, 0.628_707_9].map(|s| part(n, s));
            (x, 80.0 * part(n, 0.538_598_5))
        })
    }

    /// Kirchhoff stress of the law by principal stretches, total P by F⁻¹, and Q by the flux in space.
    fn of_space(s: &SolidAndWater, x: [f64; 3], t: f64) -> (Matrix3<f64>, Vector3<f64>) {
        let step = 1e-3;
        let moved = |y: [f64; 3]| Vector3::from(y) + Vector3::from(s.at(y, t).displacement);
        let shifted = |k: usize, e: f64| std::array::from_fn(|a| x[a] + if a == k { e } else { 0.0 });
        let axis = |k: usize| {
            if k < s.dimension { slope(step, |e| moved(shifted(k, e))) } else { Vector3::ith(k, 1.0) }
        };
        let f = Matrix3::from_columns(&[axis(0), axis(1), axis(2)]);
        let inverse = f.try_inverse().unwrap();
        let j = f.determinant();
        let stretches = (f * f.transpose()).symmetric_eigen();
        let h = stretches.eigenvalues.map(|l| 0.5 * l.ln());
        let v = j.ln();
        let n = 1.0 - (1.0 - POROSITY) / j;
        let mean = BULK * v / n - BULK * v * v * (1.0 - n) / (2.0 * n * n);
        let principal = h.map(|h| 2.0 * SHEAR * (h - v / 3.0) + mean);
        let directions = stretches.eigenvectors;
        let kirchhoff = directions * Matrix3::from_diagonal(&principal) * directions.transpose();
        let p = s.at(x, t).pressure;
        let total = kirchhoff - Matrix3::identity() * (j * p);
        let gradient =
            Vector3::from_fn(
                |k, _| {
                    if k < s.dimension { slope(step, |e| s.at(shifted(k, e), t).pressure) } else { 0.0 }
                },
            );
        let mut weight = Vector3::zeros();
        weight[s.dimension - 1] = -s.densities[0] * s.gravity;
        let kappa = 5e-8 * n.powi(3) / (1.0 - n).powi(2);
        let flux = -(inverse.transpose() * gradient - weight) * kappa;
        (total * inverse.transpose(), inverse * flux * j)
    }

    #[test]
    fn stress_and_flux_are_those_of_space() {
        for d in 1..=3 {
            let s = motion(d);
            for (x, t) in samples() {
                let (piola, flux) = of_space(&s, x, t);
                let own = s.at(x, t);
                let error = (own.first_piola - piola).norm();
                assert!(error < 1e-7 * piola.norm(), "{d}: {error}");
                // Differences of pressures of 10⁴ Pa over 10⁻³ m have twelve digits.
                let error = (Vector3::from(own.flux) - flux).norm();
                assert!(error < 1e-8 * flux.norm() + 1e-14, "{d}: {error} {flux}");
            }
        }
    }

    #[test]
    fn the_balances_hold() {
        for d in 1..=3 {
            let s = motion(d);
            let g = Vector3::ith(d - 1, -s.gravity);
            for (x, t) in samples() {
                let shifted = |k: usize, e: f64| std::array::from_fn(|a| x[a] + if a == k { e } else { 0.0 });
                let own = s.at(x, t);
                let forces: Vector3<f64> =
                    (0..d).map(|k| slope(1e-3, |e| s.at(shifted(k, e), t).first_piola.column(k).into_owned())).sum();
                let outflow: f64 = (0..d).map(|k| slope(1e-3, |e| s.at(shifted(k, e), t).flux[k])).sum();
                let rate = slope(0.1, |e| s.at(x, t + e).jacobian);
                let mass = 2600.0 * 0.6 + 1000.0 * (own.jacobian - 0.6);
                let lacking = forces + g * mass + Vector3::from(own.body_force) * 1560.0;
                assert!(lacking.norm() < 1e-7 * own.first_piola.norm(), "{d}: {lacking}");
                assert!((rate - own.rate).abs() < 1e-12, "{rate} {}", own.rate);
                assert!((outflow - own.outflow).abs() < 1e-12 + 1e-8 * outflow.abs());
                let span = [t - 1e-3, t];
                let balance = rate + outflow;
                assert!((s.inflow(x, span, false) / 1e-3 - balance).abs() < 1e-9 + 1e-7 * balance.abs());
                let change = own.jacobian - s.at(x, span[0]).jacobian;
                let whole = s.inflow(x, span, true) - change;
                assert!((whole / 1e-3 - outflow).abs() < 1e-9 + 1e-7 * outflow.abs());
            }
        }
    }

    #[test]
    fn sides_are_rollers_that_no_water_passes_but_the_top() {
        for d in 1..=3 {
            let s = motion(d);
            for (x, t) in samples() {
                for (axis, side) in (0..d).flat_map(|a| [(a, 0.0), (a, 1.0)]) {
                    let mut x = x;
                    x[axis] = side;
                    let own = s.at(x, t);
                    assert!(own.displacement[axis].abs() < 1e-15);
                    for i in (0..3).filter(|i| *i != axis) {
                        assert!(own.first_piola[(i, axis)].abs() < 1e-10);
                    }
                    if (axis, side) == (d - 1, 1.0) {
                        assert!(own.pressure.abs() < 1e-10, "{}", own.pressure);
                    } else {
                        assert!(own.flux[axis].abs() < 1e-18, "{:?}", own.flux);
                    }
                }
                let start = s.at(x, 0.0);
                assert_eq!(start.displacement, [0.0; 3]);
                assert!((start.pressure - 1e4 * (1.0 - x[d - 1])).abs() < 1e-10);
            }
        }
    }
}
