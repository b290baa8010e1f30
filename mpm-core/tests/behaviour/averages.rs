//! Averages of the remedies: what Π keeps, and how J̄ is formed.

use mpm_core::Particles;
use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_core::eights::{block, matrix_entries, store};
use mpm_core::eights::{blocks, numbers};
use mpm_core::explicit::Remedy;
use mpm_core::explicit::remedy::*;
use mpm_core::grid::{Axis, Grid};
use mpm_core::lattice::Lattice;
use mpm_core::material::{Law, NeoHookean};
use mpm_core::number::Eight;
use mpm_core::number::Lanes;
use mpm_core::order::stencil_order;
use mpm_core::parallel::CHUNK;
use mpm_core::projection::{Space, space};
use mpm_core::space::{determinant, determinant_of_entries, embed};
use mpm_core::tensor::SymmetricTensor;
use nalgebra::SMatrix;
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
        let lattice = Lattice::new(grid, WallTreatment::OpenKnot);
        let (order, slabs) = stencil_order(&lattice, &particles.position, &particles.half_size, true);
        particles.permute(&order);
        Self { lattice, particles, slabs }
    }

    fn averages(&self, onto: Onto) -> Box<dyn Space<D>> {
        let mut space = space::<D, S, B>(self.lattice.grid, WallTreatment::OpenKnot, Some(onto));
        space.find_reach(&self.particles, &self.slabs);
        if let Some(patches) = space.patches_mut() {
            patches.find(&self.lattice.grid, &self.particles, 0..self.particles.len());
        }
        space
    }

    fn average(&self, onto: Onto, field: &[f64]) -> Vec<f64> {
        let mut out = field.to_vec();
        self.averages(onto).average(&self.particles, &mut out);
        out
    }
}

/// The deformation of particles by these ΔF.
fn deformation<const D: usize>(remedy: &dyn Remedy<D>, delta_f: &[SMatrix<f64, D, D>]) -> Deformation<D> {
    let n = delta_f.len();
    let mut deformation = Deformation::of(remedy, &[n]);
    if remedy.averages_onto().is_some() {
        let mut chunk = deformation.chunk();
        for k in 0..blocks(n) {
            let entries = matrix_entries(block(delta_f, k, &mut None));
            let change = determinant_of_entries(&entries);
            chunk.keep(k, &entries, change, &[Eight::ZERO; D]);
        }
    }
    deformation
}

/// The columns that a remedy fills before the forces.
fn forced<const D: usize>(remedy: &dyn Remedy<D>, particles: &Particles<D>, average: &mut dyn Space<D>) -> Columns {
    let mut columns = remedy.columns(particles.len());
    let at_rest = Deformation::default();
    let known = Known::of(particles, &at_rest);
    remedy.force_mean(known, &mut columns.all(), &mut |field| average.average(particles, field));
    columns
}

/// J̄ⁿ⁺¹ after that.
fn next_after<const D: usize>(
    remedy: &dyn Remedy<D>,
    particles: &Particles<D>,
    deformation: &Deformation<D>,
    average: &mut dyn Space<D>,
    mut columns: Columns,
) -> Vec<f64> {
    let known = Known::of(particles, deformation);
    remedy.next_j_bar(known, &mut columns.all(), &mut |field| average.average(particles, field));
    columns.next
}

/// J̄ⁿ⁺¹ where nothing is held.
fn next<const D: usize>(
    remedy: &dyn Remedy<D>,
    particles: &Particles<D>,
    deformation: &Deformation<D>,
    average: &mut dyn Space<D>,
) -> Vec<f64> {
    next_after(remedy, particles, deformation, average, remedy.columns(particles.len()))
}

/// Makes `next` the J̄ of the particles; returns ΔF̄.
fn take(particles: &mut Particles<2>, deformation: &mut Deformation<2>, next: &[f64]) -> Vec<SMatrix<f64, 2, 2>> {
    let chunk = deformation.chunk();
    let mut averaged = vec![SMatrix::zeros(); next.len()];
    for k in 0..blocks(next.len()) {
        let j_bar = numbers(&particles.j_bar, k);
        let delta_f = chunk.averaged(k, j_bar, numbers(next, k));
        store(&mut averaged, k, |l| SMatrix::from_fn(|a, b| delta_f[a][b].part(l)));
    }
    particles.j_bar.copy_from_slice(next);
    averaged
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

/// All functions that Π averages with.
const ONTO: [Onto; 5] = [Onto::Basis, Onto::Hats, Onto::Cells, Onto::Blocks, Onto::Patches];

fn properties<const S: usize, B: Basis<S>>(places: &[[f64; 4]]) {
    let (bench, q) = scattered::<S, B>(places);
    for onto in ONTO {
        properties_of(onto, &bench, &q);
    }
}

fn properties_of<const S: usize, B: Basis<S>>(onto: Onto, bench: &Bench<2, S, B>, q: &[f64]) {
    let ones = bench.average(onto, &vec![1.0; q.len()]);
    assert!(ones.iter().all(|v| (v - 1.0).abs() < ROUNDING), "constants");

    // Symmetry: (r, V Π q) = (q, V Π r); positivity and contraction: 0 ≤ (q, VΠq) ≤ (q, Vq).
    let r: Vec<f64> = q.iter().map(|x| (7.0 * x).sin()).collect();
    let volume = &bench.particles.volume;
    let product = |a: &[f64], b: &[f64]| -> f64 { (0..a.len()).map(|p| volume[p] * a[p] * b[p]).sum() };
    let (pq, pr) = (bench.average(onto, q), bench.average(onto, &r));
    let scale = product(q, q) + product(&r, &r) + 1.0;
    let (small, qq) = (ROUNDING * scale, product(q, q));
    let near = |a: f64, b: f64, what: &str| assert!((a - b).abs() < small, "{what}: {a} {b}");
    near(product(&r, &pq), product(q, &pr), "symmetry");
    assert!((-small..qq + small).contains(&product(q, &pq)), "0 to 1");

    // The volume integral of the field survives.
    let ones = vec![1.0; q.len()];
    near(product(&ones, &pq), product(&ones, q), "integral");
    if !matches!(onto, Onto::Basis | Onto::Hats) {
        near(product(&pq, &pq), product(q, &pq), "a projection");
    }
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

/// Particles that have just been sorted have the patches of their cells, also where a pass goes on to its next piece.
#[test]
fn patches_are_the_cells_of_particles_that_have_just_been_sorted() {
    let places: Vec<[f64; 4]> =
        (0..5000).map(|k| [7.31, 3.77, 5.13, 1.91].map(|f| (f * f64::from(k)).fract())).collect();
    let (bench, q) = scattered::<3, Gimp>(&places);
    assert!(q.len() > 4 * CHUNK);
    let [patches, cells] = [Onto::Patches, Onto::Cells].map(|onto| bench.average(onto, &q));
    for (patch, cell) in patches.iter().zip(cells) {
        assert!((patch - cell).abs() < ROUNDING, "{patch} {cell}");
    }
}

/// The spread s²: on a uniform lattice Π x² = x² + s² h², averaged over the particles of a cell.
fn spread<const S: usize, B: Basis<S>>(per_cell: usize) -> f64 {
    let h = 0.5;
    let cells = 20;
    let grid = Grid::new(h, [Axis::open(0.0, cells)]).unwrap();
    let spacing = h / per_cell as f64;
    let positions: Vec<[f64; 1]> = (0..cells * per_cell).map(|k| [(k as f64 + 0.5) * spacing]).collect();
    let particles = Particles::new(positions, spacing, 1.0, [0.5 * spacing]).unwrap();
    let bench = Bench::<1, S, B>::new(grid, particles);
    let places = bench.particles.position.iter();
    let squares: Vec<f64> = places.map(|x| x[0] * x[0]).collect();
    let averaged = bench.average(Onto::Basis, &squares);
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
        assert!((value - exact).abs() <= tolerance, "{value} for {exact}");
    };
    close(spread::<2, Linear>(many), 1.0 / 3.0, tolerance);
    close(spread::<3, QuadraticBSpline>(many), 0.5, tolerance);
    close(spread::<4, CubicBSpline>(many), 2.0 / 3.0, tolerance);
    for n in [2, 5] {
        let exact = 1.0 / 3.0 + 1.0 / (6.0 * (n * n) as f64);
        // GIMP's weights at lattice particles are cell integrals, exact except for the mean of x² over a particle,
        // which is x² + l²/3: at most 1/(12 n²) of a cell squared.
        close(spread::<3, Gimp>(n), exact, 1.0 / (12.0 * (n * n) as f64));
    }
}

type Gradients = Vec<SMatrix<f64, 2, 2>>;

/// A body of 36 particles with given ΔF; their determinants, the body and ΔF̄ of the last step.
fn small_body(remedy: &mut dyn Remedy<2>, steps: usize) -> (Vec<f64>, Bench<2, 3, Gimp>, Gradients) {
    let grid = Grid::new(1.0, [Axis::open(0.0, 6), Axis::open(0.0, 6)]).unwrap();
    let positions = (0..36).map(|k| [2.25 + 0.3 * f64::from(k % 6), 2.25 + 0.3 * f64::from(k / 6)]).collect();
    let particles = Particles::new(positions, 0.09, 1.0, [0.15; 2]).unwrap();
    let mut bench = Bench::<2, 3, Gimp>::new(grid, particles);
    remedy.attach(&mut bench.particles);
    let (mut raw, mut averaged) = (Vec::new(), Vec::new());
    for step in 0..steps {
        let mut particles = bench.particles.clone();
        let grown = |x: &[f64; 2]| {
            let grow = 0.01 * (x[0] * 5.0 + step as f64).sin() + 0.02 * (x[1] * 3.0).cos();
            SMatrix::<f64, 2, 2>::new(1.0 + grow, 0.1, -0.05, 1.0)
        };
        raw = particles.position.iter().map(grown).collect();
        for (j, f) in particles.jacobian.iter_mut().zip(&raw) {
            *j *= determinant(f);
        }
        let mut deformation = deformation(remedy, &raw);
        let mut projection = bench.averages(Onto::Basis);
        let tried = next(remedy, &particles, &deformation, projection.as_mut());
        let next = next(remedy, &particles, &deformation, projection.as_mut());
        assert_eq!(tried, next, "a step tried again");
        if !next.is_empty() {
            averaged = take(&mut particles, &mut deformation, &next);
        }
        bench.particles = particles;
    }
    let raw = raw.iter().map(determinant).collect();
    (raw, bench, averaged)
}

#[test]
fn standard_changes_nothing_and_keeps_no_column() {
    let (_, bench, averaged) = small_body(&mut Standard, 2);
    assert!(bench.particles.j_bar.is_empty() && averaged.is_empty());
    assert!(Remedy::<2>::averages_onto(&Standard).is_none());
}

#[test]
fn the_family_differs_in_the_averaged_jacobian_alone() {
    // Two steps; the formulas written out with Π applied from outside.
    let expected = |kind: &str| -> Vec<f64> {
        let (first, bench, _) = small_body(&mut Standard, 1);
        let (second, _, _) = small_body(&mut Standard, 2);
        let product = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
        match kind {
            "recursive" => bench.average(Onto::Basis, &product(&bench.average(Onto::Basis, &first), &second)),
            "total" => bench.average(Onto::Basis, &product(&first, &second)),
            _ => product(&bench.average(Onto::Basis, &first), &bench.average(Onto::Basis, &second)),
        }
    };
    let remedies: [(&str, Box<dyn Remedy<2>>); 3] = [
        ("recursive", Box::new(Fbar::new(Form::Recursive))),
        ("total", Box::new(Fbar::new(Form::Total))),
        ("rate", Box::new(Fbar::new(Form::Rate))),
    ];
    for (kind, mut remedy) in remedies {
        let (_, bench, _) = small_body(remedy.as_mut(), 2);
        for (j_bar, exact) in bench.particles.j_bar.iter().zip(expected(kind)) {
            assert!((j_bar - exact).abs() < ROUNDING, "{kind}: {j_bar} {exact}");
        }
    }
}

#[test]
fn the_assumed_gradient_has_the_averaged_volume_and_the_given_shape() {
    let mut remedy = Fbar::new(Form::Total);
    let (_, bench, averaged) = small_body(&mut remedy, 1);
    for (p, assumed) in averaged.iter().enumerate() {
        assert!((determinant(assumed) - bench.particles.j_bar[p]).abs() < ROUNDING);
        // Shape: the ratio of two entries is untouched.
        assert!((assumed[(0, 1)] / assumed[(1, 0)] + 2.0).abs() < ROUNDING);
    }
}

/// Data of a particle in the energy test, beside its position: deviations of J and J̄ from one, and a velocity
/// gradient.
type Carried = ([f64; 2], [f64; 4]);

/// A cloud of particles that have seen different deformations, whose J̄ has parted from J.
fn strained<const S: usize, B: Basis<S>>(
    law: &NeoHookean,
    places: &[[f64; 4]],
    carried: &[Carried],
) -> (Bench<2, S, B>, Vec<SymmetricTensor>, Vec<SMatrix<f64, 2, 2>>) {
    let (mut bench, _) = scattered::<S, B>(places);
    let p = &mut bench.particles;
    let mut states = Vec::new();
    let mut gradients = Vec::new();
    p.j_bar = vec![1.0; p.len()];
    for k in 0..p.len() {
        let ([j, j_bar], l) = carried[p.id[k] as usize % carried.len()];
        p.jacobian[k] = 1.0 + 0.2 * j;
        p.j_bar[k] = 1.0 + 0.2 * j_bar;
        p.reference_volume[k] = p.volume[k] / p.jacobian[k];
        // A shape of its own with the determinant J̄.
        let shape = SMatrix::<f64, 2, 2>::new(1.0 + 0.2 * l[0], 0.3 * l[1], 0.1, 1.0);
        let f_bar = shape * (p.j_bar[k] / determinant(&shape)).sqrt();
        let (stress, state) = law.response(&embed(&f_bar), 1.0, &law.initial_state());
        p.stress[k] = stress;
        states.push(state);
        gradients.push(SMatrix::<f64, 2, 2>::from_row_slice(&l));
    }
    (bench, states, gradients)
}

/// The power that the forces take from the grid, Σ V σ : ∇v with the stress of the force, is the rate of the
/// stored energy Σ V⁰ W(F̄), whatever the velocities, the clouds and the parting of J̄ from J. The rate is
/// a central difference over ±ε: its error is of order ε² of third derivatives plus rounding over ε.
fn power_is_the_rate_of_energy<const S: usize, B: Basis<S>>(places: &[[f64; 4]], carried: &[Carried]) {
    // Pressures are up to a thousand; the last remedy keeps from a hundredth to all of what Π cannot see.
    for onto in ONTO {
        for (form, times) in [(Form::Bbar, 0.0), (Form::Consistent, 0.0), (Form::Consistent, 10.0)] {
            let remedy = Fbar::new(form).onto(onto).relaxing(0.0).holding(times, 5e3).unwrap();
            power_of_remedy_is_the_rate_of_energy::<S, B>(remedy, onto, places, carried);
        }
    }
}

fn power_of_remedy_is_the_rate_of_energy<const S: usize, B: Basis<S>>(
    remedy: Fbar,
    onto: Onto,
    places: &[[f64; 4]],
    carried: &[Carried],
) {
    let law = NeoHookean::new(70.0, 0.49).unwrap();
    let (bench, states, gradients) = strained::<S, B>(&law, places, carried);
    let mut average = bench.averages(onto);
    let loaded = &bench.particles;
    let columns = forced(&remedy, loaded, average.as_mut());
    let mean = &columns.mean;
    let (mut power, mut scale) = (0.0, 0.0);
    for (k, l) in gradients.iter().enumerate() {
        let ratio = loaded.j_bar[k] / loaded.jacobian[k];
        let stress = force_stress::<f64, 2>(&loaded.stress[k], ratio, mean[k]);
        for a in 0..2 {
            for b in 0..2 {
                let share = loaded.volume[k] * stress.get(a, b) * l[(a, b)];
                power += share;
                scale += share.abs();
            }
        }
    }
    let epsilon = 1e-5;
    let mut stored = |sign: f64| -> f64 {
        let mut moved = bench.particles.clone();
        let small = |l: &SMatrix<f64, 2, 2>| SMatrix::identity() + l * (sign * epsilon);
        let delta_f: Gradients = gradients.iter().map(small).collect();
        let mut deformation = deformation(&remedy, &delta_f);
        let next = next_after(&remedy, &moved, &deformation, average.as_mut(), columns.clone());
        let delta_f = take(&mut moved, &mut deformation, &next);
        let energy = |k: usize| law.energy(&law.response(&embed(&delta_f[k]), 1.0, &states[k]).1);
        (0..moved.len()).map(|k| moved.reference_volume[k] * energy(k)).sum()
    };
    let rate = (stored(1.0) - stored(-1.0)) / (2.0 * epsilon);
    assert!((rate - power).abs() < 1e-7 * scale, "{rate} {power} {scale}");
}

/// Strains are held against a pressure: without one no bit changes, and uniform growth has no unseen part.
#[test]
fn holding_does_nothing_without_pressure_or_disorder() {
    let (_, plain, _) = small_body(&mut Fbar::new(Form::Consistent), 2);
    let mut remedy = Fbar::new(Form::Consistent).holding(10.0, 1.0).unwrap();
    let (_, held, _) = small_body(&mut remedy, 2);
    assert_eq!(plain.particles.j_bar, held.particles.j_bar);

    let law = NeoHookean::new(70.0, 0.49).unwrap();
    let places: Vec<[f64; 4]> = (0..60).map(|k| [7.31, 3.77, 5.13, 1.91].map(|f| (f * f64::from(k)).fract())).collect();
    let moved: Vec<Carried> = (places.iter()).map(|[a, b, c, d]| ([a - 0.5, b - 0.5], [*c, *d, *a, *b])).collect();
    let (bench, _, _) = strained::<3, Gimp>(&law, &places, &moved);
    let mut average = bench.averages(Onto::Basis);
    let remedy = Fbar::new(Form::Consistent).holding(10.0, 5e3).unwrap();
    let columns = forced(&remedy, &bench.particles, average.as_mut());
    let grown = vec![SMatrix::<f64, 2, 2>::identity() * 1.1; places.len()];
    let deformation = deformation(&remedy, &grown);
    let next = next_after(&remedy, &bench.particles, &deformation, average.as_mut(), columns);
    for (next, before) in next.iter().zip(&bench.particles.j_bar) {
        // The cloud's J̄ is rough, but nothing shears, so that nothing of it relaxes.
        assert!((next / before - 1.21).abs() < ROUNDING, "{next} {before}");
    }
}

fn carried() -> impl Strategy<Value = Vec<Carried>> {
    let pair = (prop::array::uniform2(-1.0..1.0_f64), prop::array::uniform4(-1.0..1.0_f64));
    prop::collection::vec(pair, 120)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn the_consistent_force_takes_what_is_stored(places in clouds(), carried in carried()) {
        power_is_the_rate_of_energy::<2, Linear>(&places, &carried);
        power_is_the_rate_of_energy::<3, Gimp>(&places, &carried);
        power_is_the_rate_of_energy::<3, QuadraticBSpline>(&places, &carried);
        power_is_the_rate_of_energy::<4, CubicBSpline>(&places, &carried);
    }

    /// Relaxing keeps Σ V J̄ and never adds to Σ V J̄²; without shear nothing is relaxed.
    #[test]
    fn relaxing_keeps_the_volume_and_adds_no_energy(places in clouds(), carried in carried()) {
        let law = NeoHookean::new(70.0, 0.49).unwrap();
        let (bench, _, gradients) = strained::<3, Gimp>(&law, &places, &carried);
        let j_bar_after = |shear: f64| -> Vec<f64> {
            // Without a change of volume, to first order and to second.
            let sheared = |l: &SMatrix<f64, 2, 2>| SMatrix::<f64, 2, 2>::new(1.0, shear * l[(0, 1)], 0.0, 1.0);
            let delta_f: Gradients = gradients.iter().map(sheared).collect();
            let mut average = bench.averages(Onto::Basis);
            let remedy = Fbar::new(Form::Consistent).relaxing(100.0);
            let deformation = deformation(&remedy, &delta_f);
            next(&remedy, &bench.particles, &deformation, average.as_mut())
        };
        let volume = &bench.particles.volume;
        let sum = |j: &[f64], power: i32| -> f64 {
            j.iter().zip(volume).map(|(j, v)| v * j.powi(power)).sum()
        };
        let before = &bench.particles.j_bar;
        for shear in [1e-3, 1e-2, 0.1] {
            let after = j_bar_after(shear);
            prop_assert!((sum(&after, 1) - sum(before, 1)).abs() < ROUNDING * sum(before, 1));
            prop_assert!(sum(&after, 2) < sum(before, 2) * (1.0 + ROUNDING));
        }
        for (after, before) in j_bar_after(0.0).iter().zip(before) {
            prop_assert!((after - before).abs() < ROUNDING);
        }
    }
}
