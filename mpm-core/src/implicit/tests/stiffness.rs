//! The stiffness against difference quotients of the forces, and its symmetry.

use super::*;
use crate::fixture::{apart, multiply, noise, slope};
use nalgebra::DMatrix;

/// Remedies with the functions that they average with.
pub(super) const REMEDIES: [(Remedy, Onto); 6] = [
    (Remedy::None, Onto::Basis),
    (Remedy::FbarConsistent, Onto::Basis),
    (Remedy::Bbar, Onto::Basis),
    (Remedy::Bbar, Onto::Hats),
    (Remedy::Bbar, Onto::Cells),
    (Remedy::FbarConsistent, Onto::Cells),
];

/// A strained body with free faces, held at one end, on a trial of random increments.
pub(super) fn strained<const D: usize, I: Interpolation<D>, M: Law + 'static>(
    law: M,
    (remedy, onto): (Remedy, Onto),
) -> Solver<D> {
    let f = SMatrix::<f64, D, D>::from_fn(|i, j| f64::from(u8::from(i == j)) + 0.04 * noise(3 * i + j + 1));
    let mut scene = full::<D, _>(CELLS, law);
    scene.bodies.particles = scene.bodies.particles.deformed(|x| (*x, f));
    scene.bodies = Bodies::new(scene.bodies.each[0].law.clone(), scene.bodies.particles).unwrap();
    let wall = Wall::new(0, End::Lo, WallKind::Fixed);
    let settings = Settings::new(1.0).remedy(remedy).onto(onto).stabilised(Stabilisation::Ghost(0.01));
    let mut solver = Solver::new::<I>(scene.constrain(wall), settings).unwrap();
    solver.sort();
    solver
}

fn random_values(held: &[Option<f64>], size: f64, seed: usize) -> Vec<f64> {
    let pairs = held.iter().enumerate();
    pairs.map(|(k, held)| if held.is_some() { 0.0 } else { size * noise(seed + k) }).collect()
}

/// K x is what central differences of the forces along x extrapolate to, and the matrix times x where it is assembled.
fn tangent_is_the_slope_of_the_forces<const D: usize, I: Interpolation<D>, M: Law + 'static>(
    law: M,
    remedy: (Remedy, Onto),
) {
    slope_of_the_forces(&strained::<D, I, M>(law, remedy));
}

/// The same of a solver.
pub(super) fn slope_of_the_forces<const D: usize>(solver: &Solver<D>) {
    let setting = solver.setting(1.0);
    let step = setting.step(&solver.scene.bodies, 1.0);
    let nodes = solver.functions.len();
    let held = &setting.unknowns.held;
    let (u, x) = (random_values(held, 0.02 * H, 7), random_values(held, H, 1000));
    let forces = |s: f64| {
        let at: Vec<f64> = u.iter().zip(&x).map(|(u, x)| u + s * x).collect();
        let trial = step.trial(&at, nodes).unwrap();
        let pairs = trial.internal.iter().zip(&trial.resistance);
        step.free(&pairs.map(|(f, g)| f + g).collect::<Vec<_>>())
    };
    let (exact, known) = slope(forces);
    let trial = step.trial(&u, nodes).unwrap();
    let tangents = step.tangents(&trial);
    let product = step.apply(&tangents, &x, nodes);
    // Rounding of the forces over the least step.
    let rounding = 100.0 * f64::EPSILON * algebra::norm(&product) / 1e-3;
    let (error, known) = (apart(&product, &exact), algebra::norm(&known));
    assert!(error <= known + rounding, "{error} {known}");
    if !setting.average.as_ref().is_some_and(Average::spreads) {
        let values = step.stiffness(&tangents, &setting.pattern);
        let assembled = multiply(&setting.pattern, &values, &x);
        assert!(apart(&assembled, &product) < 1e-12 * algebra::norm(&product));
    }
}

fn ground() -> HenckyJ2 {
    // Yields at the strains of the start.
    HenckyJ2::new(YOUNG, POISSON, Strength::softening(2e2, 1e2, 1.0).unwrap()).unwrap()
}

#[test]
fn stiffness_is_the_slope_of_the_forces() {
    for remedy in REMEDIES {
        every_basis!(tangent_is_the_slope_of_the_forces, 1, NeoHookean::new(YOUNG, POISSON).unwrap(), remedy);
        every_basis!(tangent_is_the_slope_of_the_forces, 2, NeoHookean::new(YOUNG, 0.49).unwrap(), remedy);
        every_basis!(tangent_is_the_slope_of_the_forces, 2, Hencky::new(YOUNG, POISSON).unwrap(), remedy);
        tangent_is_the_slope_of_the_forces::<2, Quadratics<2>, _>(ground(), remedy);
        tangent_is_the_slope_of_the_forces::<3, Means<3>, _>(Hencky::new(YOUNG, POISSON).unwrap(), remedy);
    }
    for update in [JaumannUpdate::Split, JaumannUpdate::Linear] {
        let law = Hypoelastic::new(YOUNG, POISSON, update).unwrap();
        every_basis!(tangent_is_the_slope_of_the_forces, 2, law, REMEDIES[0]);
    }
}

/// max |K − Kᵀ| over max |K|.
fn asymmetry<const D: usize, I: Interpolation<D>, M: Law + 'static>(law: M, remedy: (Remedy, Onto)) -> f64 {
    let solver = strained::<D, I, M>(law, remedy);
    let setting = solver.setting(1.0);
    let step = setting.step(&solver.scene.bodies, 1.0);
    let nodes = solver.functions.len();
    let count = setting.unknowns.len();
    let trial = step.trial(&random_values(&setting.unknowns.held, 0.02 * H, 7), nodes).unwrap();
    let tangents = step.tangents(&trial);
    let mut matrix = DMatrix::zeros(count, count);
    for j in (0..count).filter(|j| setting.unknowns.held[*j].is_none()) {
        let mut unit = vec![0.0; count];
        unit[j] = 1.0;
        let column = step.apply(&tangents, &unit, nodes);
        matrix.set_column(j, &nalgebra::DVector::from_vec(column));
    }
    (&matrix - matrix.transpose()).amax() / matrix.amax()
}

#[test]
fn stiffness_is_symmetric_where_there_is_a_potential() {
    for remedy in REMEDIES {
        let found = [
            asymmetry::<2, Quadratics<2>, _>(NeoHookean::new(YOUNG, POISSON).unwrap(), remedy),
            asymmetry::<2, Means<2>, _>(Hencky::new(YOUNG, POISSON).unwrap(), remedy),
            asymmetry::<2, Quadratics<2>, _>(ground(), remedy),
        ];
        assert!(found.iter().all(|a| *a < 1e-13), "{found:?}");
    }
    let law = Hypoelastic::new(YOUNG, POISSON, JaumannUpdate::Split).unwrap();
    assert!(asymmetry::<2, Quadratics<2>, _>(law, REMEDIES[0]) > 1e-4);
}

/// Pressures of nodes that are eliminated from what preconditions, Eq. (13), resist a strain that is alike everywhere
/// as the average does, except for the share that is kept where averages see nothing.
fn eliminated_pressures_resist_as_averages_do<const D: usize, I: Interpolation<D>>() {
    let scene = full::<D, _>(CELLS, NeoHookean::new(YOUNG, 0.49).unwrap());
    let wall = Wall::new(0, End::Lo, WallKind::Fixed);
    let settings = Settings::new(1.0).remedy(Remedy::FbarConsistent);
    let solver = Solver::<D>::new::<I>(scene.constrain(wall), settings).unwrap();
    let setting = solver.setting(1.0);
    let step = setting.step(&solver.scene.bodies, 1.0);
    let (nodes, unknowns) = (solver.functions.len(), &setting.unknowns);
    let mut x = vec![0.0; unknowns.len()];
    solver.functions.for_each_node(&mut |node, place| {
        if let Some(k) = unknowns.of(node) {
            x[k * D] = place[0];
        }
    });
    let trial = step.trial(&vec![0.0; x.len()], nodes).unwrap();
    let tangents = step.tangents(&trial);
    let energy = |product: &[f64]| product.iter().zip(&x).map(|(a, b)| a * b).sum::<f64>();
    let exact = energy(&step.apply(&tangents, &x, nodes));

    let (pattern, width) = (&setting.pattern, D + 1);
    assert_eq!(pattern.width, width);
    let values = step.stiffness(&tangents, pattern);
    let count = unknowns.len() / D;
    let with_pressures = |pressures: &[f64]| -> Vec<f64> {
        (0..count * width)
            .map(|i| match i % width {
                a if a < D => x[i / width * D + a],
                _ => pressures[i / width],
            })
            .collect()
    };
    let product = multiply(pattern, &values, &with_pressures(&vec![0.0; count]));
    let pressures: Vec<f64> = (0..count)
        .map(|k| {
            let i = k * width + D;
            -product[i] / values[pattern.place(i, i).unwrap()]
        })
        .collect();
    let product = multiply(pattern, &values, &with_pressures(&pressures));
    let forces: Vec<f64> = (0..x.len()).map(|k| product[k / D * width + k % D]).collect();
    let excess = energy(&forces) / exact - 1.0;
    let kept = setting.average.as_ref().unwrap().unseen().powi(2) * (1.0 + 1e-9);
    assert!((-1e-9..=kept).contains(&excess), "{excess}");
}

#[test]
fn what_preconditions_is_exact_of_a_uniform_strain() {
    eliminated_pressures_resist_as_averages_do::<1, Hats<1>>();
    eliminated_pressures_resist_as_averages_do::<2, Hats<2>>();
    eliminated_pressures_resist_as_averages_do::<2, Means<2>>();
}
