use super::*;
use crate::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use crate::grid::{Axis, Grid};
use crate::lattice::Lattice;
use crate::particles::cell_order;
use crate::projection::{NodalAverage, Projection};
use proptest::prelude::*;

const ROUNDING: f64 = 1e-12;

/// Π on its own.
struct Bench<const D: usize, const S: usize, B> {
    lattice: Lattice<D, S, B>,
    particles: Particles<D>,
    slabs: Vec<std::ops::Range<usize>>,
}

impl<const D: usize, const S: usize, B: Basis<S>> Bench<D, S, B> {
    fn new(grid: Grid<D>, mut particles: Particles<D>) -> Self {
        let (order, slabs) = cell_order(&grid, &particles.position);
        particles.permute(&order);
        Self {
            lattice: Lattice::new(grid, WallTreatment::OpenKnot),
            particles,
            slabs,
        }
    }

    fn average(&self, field: &[f64]) -> Vec<f64> {
        let mut out = field.to_vec();
        Projection {
            lattice: &self.lattice,
            slabs: &self.slabs,
            nodes: &mut vec![NodalAverage::default(); self.lattice.len()],
            count: &mut 0,
        }
        .average(&self.particles, &mut out);
        out
    }
}

/// A square of scattered particles of unequal volume between walls.
fn scattered<const S: usize, B: Basis<S>>(places: &[[f64; 4]]) -> (Bench<2, S, B>, Vec<f64>) {
    let grid = Grid::new(1.0, [Axis::walls(0.0, 20), Axis::periodic(0.0, 6)]).unwrap();
    let positions = places.iter().map(|p| [20.0 * p[0], 6.0 * p[1]]).collect();
    let mut particles = Particles::new(positions, 1.0, 1.0, [0.25; 2]).unwrap();
    for (volume, p) in particles.volume.iter_mut().zip(places) {
        *volume = 0.5 + p[2];
    }
    let field = places.iter().map(|p| p[3]).collect();
    (Bench::new(grid, particles), field)
}

fn properties<const S: usize, B: Basis<S>>(places: &[[f64; 4]]) {
    let (bench, q) = scattered::<S, B>(places);
    let ones = bench.average(&vec![1.0; places.len()]);
    assert!(ones.iter().all(|v| (v - 1.0).abs() < ROUNDING), "constants");

    // Symmetry: (r, V Π q) = (q, V Π r); positivity and contraction: 0 ≤ (q, VΠq) ≤ (q, Vq).
    let r: Vec<f64> = q.iter().map(|x| (7.0 * x).sin()).collect();
    let volume = &bench.particles.volume;
    let product =
        |a: &[f64], b: &[f64]| -> f64 { (0..a.len()).map(|p| volume[p] * a[p] * b[p]).sum() };
    let (pq, pr) = (bench.average(&q), bench.average(&r));
    let scale = product(&q, &q) + product(&r, &r) + 1.0;
    assert!(
        (product(&r, &pq) - product(&q, &pr)).abs() < ROUNDING * scale,
        "symmetry"
    );
    assert!(product(&q, &pq) > -ROUNDING * scale, "positive");
    assert!(
        product(&q, &pq) < product(&q, &q) + ROUNDING * scale,
        "at most one"
    );

    // The volume integral of the field survives.
    let ones = vec![1.0; q.len()];
    assert!(
        (product(&ones, &pq) - product(&ones, &q)).abs() < ROUNDING * scale,
        "integral"
    );
}

fn clouds() -> impl Strategy<Value = Vec<[f64; 4]>> {
    prop::collection::vec(prop::array::uniform4(0.0..1.0_f64), 40..120)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_average_is_symmetric_and_keeps_constants(places in clouds()) {
        properties::<2, Linear>(&places);
        properties::<3, Gimp>(&places);
        properties::<3, QuadraticBSpline>(&places);
        properties::<4, CubicBSpline>(&places);
    }
}

/// The spread s²: on a uniform lattice Π x² = x² + s² h², averaged over the particles of a cell.
fn spread<const S: usize, B: Basis<S>>(per_cell: usize) -> f64 {
    let h = 0.5;
    let cells = 20;
    let grid = Grid::new(h, [Axis::open(0.0, cells)]).unwrap();
    let spacing = h / per_cell as f64;
    let positions: Vec<[f64; 1]> = (0..cells * per_cell)
        .map(|k| [(k as f64 + 0.5) * spacing])
        .collect();
    let particles = Particles::new(positions, spacing, 1.0, [0.5 * spacing]).unwrap();
    let bench = Bench::<1, S, B>::new(grid, particles);
    let squares: Vec<f64> = bench
        .particles
        .position
        .iter()
        .map(|x| x[0] * x[0])
        .collect();
    let averaged = bench.average(&squares);
    let middle = 10 * per_cell..11 * per_cell;
    let mean: f64 = middle.map(|p| averaged[p] - squares[p]).sum::<f64>() / per_cell as f64;
    mean / (h * h)
}

#[test]
fn the_spread_of_the_average_is_as_stated_for_each_basis() {
    // For functions of x alone the particle sums are midpoint rules; with n particles per cell they
    // err by at most 1/n² of a term below ½.
    let many = 50;
    let tolerance = 1.0 / (many * many) as f64;
    let close = |value: f64, exact: f64, tolerance: f64| {
        assert!(
            (value - exact).abs() <= tolerance,
            "{value} instead of {exact}"
        );
    };
    close(spread::<2, Linear>(many), 1.0 / 3.0, tolerance);
    close(spread::<3, QuadraticBSpline>(many), 0.5, tolerance);
    close(spread::<4, CubicBSpline>(many), 2.0 / 3.0, tolerance);
    for n in [2, 5] {
        let exact = 1.0 / 3.0 + 1.0 / (6.0 * (n * n) as f64);
        // GIMP's weights at lattice particles are cell integrals, exact but for the mean of x² over
        // a particle, which is x² + l²/3: at most 1/(12 n²) of a cell squared.
        close(spread::<3, Gimp>(n), exact, 1.0 / (12.0 * (n * n) as f64));
    }
}

/// A body of four particles with given ΔF.
fn small_body(remedy: &mut dyn Remedy<2>, steps: usize) -> (Vec<f64>, Bench<2, 3, Gimp>) {
    let grid = Grid::new(1.0, [Axis::open(0.0, 6), Axis::open(0.0, 6)]).unwrap();
    let positions = (0..36)
        .map(|k| [2.25 + 0.3 * f64::from(k % 6), 2.25 + 0.3 * f64::from(k / 6)])
        .collect();
    let particles = Particles::new(positions, 0.09, 1.0, [0.15; 2]).unwrap();
    let mut bench = Bench::<2, 3, Gimp>::new(grid, particles);
    remedy.attach(&mut bench.particles);
    let mut scaled = Vec::new();
    for step in 0..steps {
        let mut particles = bench.particles.clone();
        for p in 0..particles.len() {
            let x = particles.position[p];
            let grow = 0.01 * (x[0] * 5.0 + step as f64).sin() + 0.02 * (x[1] * 3.0).cos();
            particles.delta_f[p] = nalgebra::SMatrix::<f64, 2, 2>::new(1.0 + grow, 0.1, -0.05, 1.0);
            particles.jacobian[p] *= determinant(&particles.delta_f[p]);
        }
        scaled = particles.delta_f.clone();
        let mut nodes = vec![NodalAverage::default(); bench.lattice.len()];
        let mut count = 0;
        let mut projection = Projection {
            lattice: &bench.lattice,
            slabs: &bench.slabs,
            nodes: &mut nodes,
            count: &mut count,
        };
        remedy.adjust_delta_f(&mut particles, &mut projection);
        bench.particles = particles;
    }
    let raw = scaled.iter().map(determinant).collect();
    (raw, bench)
}

#[test]
fn standard_changes_nothing_and_keeps_no_column() {
    let (raw, bench) = small_body(&mut Standard, 2);
    assert!(bench.particles.j_bar.is_empty());
    let after: Vec<f64> = bench.particles.delta_f.iter().map(determinant).collect();
    assert_eq!(raw, after);
}

#[test]
fn the_family_differs_in_the_averaged_jacobian_alone() {
    // Two steps; the formulas written out with Π applied from outside.
    let expected = |kind: &str| -> Vec<f64> {
        let (first, bench) = small_body(&mut Standard, 1);
        let (second, _) = small_body(&mut Standard, 2);
        let product =
            |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
        match kind {
            "recursive" => bench.average(&product(&bench.average(&first), &second)),
            "total" => bench.average(&product(&first, &second)),
            _ => product(&bench.average(&first), &bench.average(&second)),
        }
    };
    let remedies: [(&str, Box<dyn Remedy<2>>); 3] = [
        ("recursive", Box::new(FbarRecursive::default())),
        ("total", Box::new(FbarTotal::default())),
        ("rate", Box::new(FbarRate::default())),
    ];
    for (kind, mut remedy) in remedies {
        let (_, bench) = small_body(remedy.as_mut(), 2);
        for (j_bar, exact) in bench.particles.j_bar.iter().zip(expected(kind)) {
            assert!((j_bar - exact).abs() < ROUNDING, "{kind}: {j_bar} {exact}");
        }
    }
}

#[test]
fn the_assumed_gradient_has_the_averaged_volume_and_the_given_shape() {
    let mut remedy = FbarTotal::default();
    let (raw, bench) = small_body(&mut remedy, 1);
    for p in 0..raw.len() {
        let assumed = bench.particles.delta_f[p];
        assert!((determinant(&assumed) - bench.particles.j_bar[p]).abs() < ROUNDING);
        // Shape: the ratio of two entries is untouched.
        assert!((assumed[(0, 1)] / assumed[(1, 0)] + 2.0).abs() < ROUNDING);
    }
}
