//! The matrix against difference quotients of the residual, and its symmetry.

use super::*;
use crate::fixture::{apart, multiply, noise, slope};
use crate::implicit::algebra::norm;

/// A strained column with all that a scene can have, shorter along every axis: no domain leaves the cells it was in.
fn strained<const D: usize, I: OfHats<D>>(settings: Settings) -> Solver<D> {
    let f = SMatrix::<f64, D, D>::from_fn(|i, j| {
        let strain = 0.04 * noise(3 * i + j + 1);
        if i == j { 1.0 - strain.abs() } else { strain }
    });
    let scene = standing::<D, _>(porous(), |x| (*x, f));
    let particles = &scene.bodies.particles;
    let top = (D - 1, End::Hi);
    let mut acceleration = [0.3; D];
    acceleration[D - 1] = -10.0;
    let water = water()
        .gravity(Gravity { water: 1000.0, grains: 2600.0, acceleration })
        .face(Face::drained(particles, topmost, top, 100.0 * KAPPA / H))
        .plate(Plate::new(D - 1, uppermost, |_| -1e3));
    let mut solver = Solver::new::<I>(scene, water, settings).unwrap();
    solver.sort();
    solver
}

/// Displacements and pressures of random size.
fn random<const D: usize>(setting: &Setting<D>, seed: usize) -> Vec<f64> {
    let size = |k: usize| if k < setting.unknowns.displacements { 0.02 * H } else { 0.1 * MODULUS };
    (0..setting.unknowns.count).map(|k| size(k) * noise(seed + k)).collect()
}

/// K x is what central differences of the residual along x extrapolate to, of both equations.
fn matrix_is_the_slope<const D: usize, I: OfHats<D>>(settings: Settings) {
    let solver = strained::<D, I>(settings);
    // The pressures that flow drives are as large as those of compression.
    let dt = H * H / (KAPPA * MODULUS);
    let setting = solver.setting(dt, Vec::new()).unwrap();
    let step = solver.equations(&setting, dt);
    let (at, x) = (random(&setting, 7), random(&setting, 1000));
    let residual = |s: f64| {
        let moved: Vec<f64> = at.iter().zip(&x).map(|(u, x)| u + s * x).collect();
        step.residual(&step.trial(&moved).unwrap())
    };
    let (exact, known) = slope(|s| residual(-s));
    let values = step.matrix(&step.trial(&at).unwrap());
    let product = multiply(&setting.pattern, &values, &x);
    let displacements = setting.unknowns.displacements;
    for part in [0..displacements, displacements..setting.unknowns.count] {
        // Rounding of forces and volumes over the least step.
        let rounding = 200.0 * f64::EPSILON * norm(&residual(0.0)[part.clone()]) / 1e-3;
        let error = apart(&product[part.clone()], &exact[part.clone()]);
        let (known, size) = (norm(&known[part.clone()]), norm(&product[part]));
        assert!(size > 0.0);
        assert!(
            error <= known + rounding + 1e-12 * size,
            "off by {error} of {size}, known to {known}, rounding {rounding}"
        );
    }
}

#[test]
fn the_matrix_is_the_slope_of_the_residual() {
    let consistent = Settings::new(1.0).ghosts(0.1, 0.01).tangent(Tangent::Consistent);
    for pressure_space in SPACES {
        for volume_rate in [VolumeRate::Exact, VolumeRate::Logarithmic] {
            let settings = consistent.pressure_space(pressure_space).volume_rate(volume_rate);
            matrix_is_the_slope::<1, Hats<1>>(settings);
            matrix_is_the_slope::<1, Means<1>>(settings);
            matrix_is_the_slope::<2, Hats<2>>(settings);
            matrix_is_the_slope::<2, Means<2>>(settings);
        }
    }
    matrix_is_the_slope::<3, Means<3>>(consistent);
}

/// The largest difference between entries and their mirrors, over the largest entry, of the matrix that is scaled to a
/// diagonal of ones.
fn asymmetry(settings: Settings) -> f64 {
    let solver = strained::<2, Means<2>>(settings);
    let dt = H * H / (KAPPA * MODULUS);
    let setting = solver.setting(dt, Vec::new()).unwrap();
    let step = solver.equations(&setting, dt);
    let trial = step.trial(&random(&setting, 7)).unwrap();
    let values = step.matrix(&trial);
    let scales = step.scales(&values);
    let pattern = &setting.pattern;
    let mut most: f64 = 0.0;
    for column in 0..pattern.len() {
        for k in pattern.begin[column]..pattern.begin[column + 1] {
            let row = pattern.row[k];
            let mirror = pattern.place(column, row).unwrap();
            most = most.max((values[k] - values[mirror]).abs() * scales[row] * scales[column]);
        }
    }
    most
}

/// With the exact rate all is the derivative of one functional but what conductivity and weight change by; with the
/// logarithmic one the coupling is not.
#[test]
fn the_exact_rate_makes_a_symmetric_matrix() {
    let symmetric = Settings::new(1.0).ghosts(0.1, 0.01);
    assert!(asymmetry(symmetric) < 1e-13);
    let consistent = symmetric.tangent(Tangent::Consistent);
    assert!(asymmetry(consistent) > 1e-4);
    let logarithmic = consistent.volume_rate(VolumeRate::Logarithmic);
    assert!(asymmetry(logarithmic) > 1e-2, "{}", asymmetry(logarithmic));
}
