//! Equations that every solution must satisfy, checked by eighth-order differences independent of its formulas.

use super::{Entry, Exact};
use crate::parameter::Parameters;
use nalgebra::{Matrix3, Vector3};
use std::ops::{Add, Mul, Sub};

/// The solution of an entry with some parameters set.
pub(super) fn solution(entry: &Entry, set: &[&str]) -> Box<dyn Exact> {
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    (entry.build)(&Parameters::new(entry.parameters, &set).unwrap()).unwrap()
}

/// First derivative by central differences of eighth order.
pub(super) fn slope<T>(step: f64, value: impl Fn(f64) -> T) -> T
where
    T: Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let pair = |n: f64| value(n * step) - value(-n * step);
    (pair(1.0) * (4.0 / 5.0) - pair(2.0) * (1.0 / 5.0) + pair(3.0) * (4.0 / 105.0) - pair(4.0) * (1.0 / 280.0))
        * (1.0 / step)
}

/// Second derivative by central differences of eighth order.
fn curvature(step: f64, value: impl Fn(f64) -> Vector3<f64>) -> Vector3<f64> {
    let pair = |n: f64| value(n * step) + value(-n * step);
    (pair(1.0) * (8.0 / 5.0) - pair(2.0) * (1.0 / 5.0) + pair(3.0) * (8.0 / 315.0)
        - pair(4.0) * (1.0 / 560.0)
        - value(0.0) * (205.0 / 72.0))
        / step.powi(2)
}

/// Points of the body and times within two periods, without pattern: the additive recurrence of the
/// golden ratio's relatives (Roberts 2018).
fn samples(s: &dyn Exact, period: f64) -> impl Iterator<Item = (Vector3<f64>, f64)> {
    const STRIDES: [f64; 4] = [0.856_674_9, 0.733_891_9, 0.628_707_9, 0.538_598_5];
    let extent = s.extent();
    let dimension = s.dimension();
    (0..60).map(move |n| {
        let fraction = |i: usize| (0.37 + f64::from(n) * STRIDES[i]).fract();
        let x = Vector3::from_fn(|i, _| {
            if i < dimension { extent[i][0] + fraction(i) * (extent[i][1] - extent[i][0]) } else { 0.0 }
        });
        (x, 2.0 * period * fraction(3))
    })
}

fn unit(i: usize) -> Vector3<f64> {
    Vector3::from_fn(|k, _| f64::from(u8::from(k == i)))
}

/// ∂/∂X_j of a field over the axes of the motion, at `x`.
pub(super) fn gradient<T>(s: &dyn Exact, x: &Vector3<f64>, field: impl Fn(&Vector3<f64>) -> T) -> [T; 3]
where
    T: Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let [least, most] = s.extent()[0];
    let step = 1e-3 * (most - least);
    [0, 1, 2].map(|j| slope(step, |d| field(&(x + d * unit(j)))))
}

fn close<T>(what: &str, found: T, expected: T, scale: f64, size: impl Fn(T) -> f64)
where
    T: Copy + Sub<Output = T> + std::fmt::Debug,
{
    let error = size(found - expected);
    assert!(error <= 5e-9 * scale, "{what}: {found:?} instead of {expected:?}, error {error:.2e} of scale {scale:.2e}");
}

/// F is the gradient of x, J its determinant, v the rate of u, σ_m the mean of J⁻¹ P Fᵀ, and ρ₀ a = Div P + ρ₀ b,
/// at the sampled points that are `smooth`.
pub(super) fn solves(s: &dyn Exact, period: f64, smooth: impl Fn(&Vector3<f64>) -> bool) {
    let step = 4e-3 * period;
    let rho = s.material().density;
    let mut seen = 0;
    for (x, t) in samples(s, period).filter(|(x, _)| smooth(x)) {
        seen += 1;
        let place = format!("{s:?} at {:?}, {t}", x.as_slice());
        let f = Matrix3::identity() + Matrix3::from_columns(&gradient(s, &x, |x| s.displacement(x, t)));
        let f_given = s.deformation_gradient(&x, t);
        close(&format!("F of {place}"), f_given, f, 1.0, |m| m.norm());
        let j = s.jacobian(&x, t);
        close(&format!("J of {place}"), j, f.determinant(), 1.0, f64::abs);
        let v = slope(step, |d| s.displacement(&x, t + d));
        let speed = s.velocity(&x, t);
        let scale = speed.norm() + s.displacement(&x, t).norm() / period;
        close(&format!("v of {place}"), speed, v, scale, |m| m.norm());

        let a = curvature(step, |d| s.displacement(&x, t + d));
        let columns = gradient(s, &x, |x| s.first_piola(x, t));
        let divergence: Vector3<f64> = (0..3).map(|j| columns[j].column(j).into_owned()).sum();
        let b = s.body_force(&x, t);
        let largest = columns.iter().map(Matrix3::norm).fold(0.0, f64::max);
        let scale = a.norm() + b.norm() + largest / rho + s.displacement(&x, t).norm() / period.powi(2);
        close(&format!("b of {place}"), b, a - divergence / rho, scale, |m| m.norm());
    }
    assert!(seen >= 15, "{seen} points of {s:?} are smooth");
}

/// As [`solves`], and P is the neo-Hookean solid's, σ_m is the mean of J⁻¹ P Fᵀ, and b is that of the
/// generic formula.
pub(super) fn solves_as_neo_hookean(s: &dyn Exact, period: f64, smooth: impl Fn(&Vector3<f64>) -> bool) {
    solves(s, period, &smooth);
    let material = s.material();
    for (x, t) in samples(s, period).filter(|(x, _)| smooth(x)) {
        let place = format!("{s:?} at {:?}, {t}", x.as_slice());
        let f = s.deformation_gradient(&x, t);
        let p = s.first_piola(&x, t);
        // ln J of a J that is one to the last bit or so.
        let noise = 1e-6 * material.lambda;
        let scale = p.norm() + material.mu + noise;
        close(&format!("P of {place}"), p, material.first_piola(&f), scale, |m| m.norm());
        let mean = (p * f.transpose()).trace() / (3.0 * f.determinant());
        close(&format!("mean stress of {place}"), s.mean_stress(&x, t), mean, scale, f64::abs);

        let g = gradient(s, &x, |x| s.deformation_gradient(x, t));
        let a = curvature(4e-3 * period, |d| s.displacement(&x, t + d));
        let generic = material.body_force(&f, &g, &a);
        let b = s.body_force(&x, t);
        let bending = g.iter().map(Matrix3::norm).fold(0.0, f64::max);
        let scale = a.norm()
            + b.norm()
            + (material.mu + noise) * bending / material.density
            + s.displacement(&x, t).norm() / period.powi(2);
        close(&format!("generic b of {place}"), b, generic, scale, |m| m.norm());
    }
}

/// Points on each side, with the axis of its normal.
fn sides(s: &dyn Exact, period: f64) -> Vec<(usize, Vector3<f64>, f64)> {
    let mut all = Vec::new();
    for (x, t) in samples(s, period) {
        for axis in 0..s.dimension() {
            for side in s.extent()[axis] {
                let mut x = x;
                x[axis] = side;
                all.push((axis, x, t));
            }
        }
    }
    all
}

/// No motion normal to any side, and no shear traction on it.
pub(super) fn between_rollers(s: &dyn Exact, period: f64) {
    for (axis, x, t) in sides(s, period) {
        assert!(s.displacement(&x, t)[axis].abs() < 1e-14);
        assert!(s.velocity(&x, t)[axis].abs() < 1e-12);
        let p = s.first_piola(&x, t);
        for i in (0..3).filter(|i| *i != axis) {
            assert!(p[(i, axis)].abs() <= 1e-12 * p.norm(), "{p} at {x}");
        }
    }
}

/// No motion on any side.
pub(super) fn fixed_on_all_sides(s: &dyn Exact, period: f64) {
    for (_, x, t) in sides(s, period) {
        assert!(s.displacement(&x, t).norm() < 1e-14, "{s:?} at {x}");
        assert!(s.velocity(&x, t).norm() < 1e-14, "{s:?} at {x}");
    }
}
