//! The implicit solver against exact answers.

use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::implicit::{Interpolation, Remedy, Settings, Solver, Stabilisation, TimeRule};
use mpm_core::material::{Hencky, HenckyJ2, Hypoelastic, JaumannUpdate, NeoHookean, Strength, shared};
use mpm_core::projection::Onto;
use mpm_core::space::embed;
use mpm_core::stage::{BodyForce, Constraint, End, Wall, WallKind};
use mpm_core::{
    Axis, Bodies, Error, Field, Frame, Grid, Lattice, Law, Memory, Memoryless, Part, Particles, Scene, Side,
    Simulation, SymmetricTensor,
};
use nalgebra::{SMatrix, SVector};

const YOUNG: f64 = 1e5;
const POISSON: f64 = 0.3;
const H: f64 = 0.25;
const CELLS: usize = 4;
const CENTRE: f64 = 0.5 * H * CELLS as f64;

type Hats<const D: usize> = Lattice<D, 2, Linear>;
type Means<const D: usize> = Lattice<D, 3, Gimp>;
type Quadratics<const D: usize> = Lattice<D, 3, QuadraticBSpline>;
type Cubics<const D: usize> = Lattice<D, 4, CubicBSpline>;

/// Calls `$check::<D, I>($argument…)` for every basis.
macro_rules! every_basis {
    ($check:ident, $d:literal $(, $argument:expr)*) => {
        $check::<$d, Hats<$d>, _>($($argument),*);
        $check::<$d, Means<$d>, _>($($argument),*);
        $check::<$d, Quadratics<$d>, _>($($argument),*);
        $check::<$d, Cubics<$d>, _>($($argument),*);
    };
}

// After the macro, which they use.
mod cells;
mod contact;
mod cylinder;
mod dynamics;
mod guess;
mod take_over;

/// Two places in a cell, in shares of it.
#[derive(Clone, Copy)]
enum Places {
    Uniform,
    Gauss,
}

/// A box of `cells` cells along each axis, two particles a cell and axis, that fills a grid between walls.
fn full<const D: usize, M: Law + 'static>(cells: usize, places: Places, law: M) -> Scene<D> {
    filled([Axis::walls(0.0, cells); D], cells, places, law)
}

/// The same on a grid of `axes`.
fn filled<const D: usize, M: Law + 'static>(axes: [Axis; D], cells: usize, places: Places, law: M) -> Scene<D> {
    let grid = Grid::new(H, axes).unwrap();
    let off = match places {
        Places::Uniform => 0.25,
        Places::Gauss => 0.5 - 0.5 / 3.0_f64.sqrt(),
    };
    let at = |k: usize| H * ((k / 2) as f64 + if k.is_multiple_of(2) { off } else { 1.0 - off });
    let along = 2 * cells;
    let positions =
        (0..along.pow(D as u32)).map(|k| std::array::from_fn(|a| at(k / along.pow(a as u32) % along))).collect();
    let volume = (0.5 * H).powi(D as i32);
    let particles = Particles::new(positions, volume, 1000.0, [0.25 * H; D]).unwrap();
    Scene::new(grid, Bodies::new(shared(law), particles).unwrap())
}

/// The box stands on a floor between rollers and is compressed by `weight` (N/m³).
fn standing<const D: usize, M: Law + 'static>(cells: usize, places: Places, law: M, weight: f64) -> Scene<D> {
    let rollers = (0..D).map(|axis| Wall::new(axis, End::Lo, WallKind::Roller));
    let axis = Axis::bounded(0.0, cells + 2, (Side::Wall, Side::Open));
    filled([axis; D], cells, places, law).constrain_all(rollers).load(BodyForce(Box::new(move |_, t| {
        let mut force = [0.0; D];
        force[D - 1] = -weight * t / 1000.0;
        force
    })))
}

fn bits<const D: usize>(solver: &Solver<D>) -> Vec<u64> {
    let p = solver.particles();
    let stress = p.stress.iter().flat_map(|s| [s.xx, s.yy, s.zz, s.xy]);
    let places = p.position.iter().flatten().copied();
    places.chain(stress).map(f64::to_bits).collect()
}

/// Moves the nodes at the faces of the grid, and beyond, as the field u = G (x − c) does.
struct Affine<const D: usize> {
    /// G.
    gradient: SMatrix<f64, D, D>,
    /// Every coordinate of c (m).
    centre: f64,
}

impl<const D: usize> Memoryless for Affine<D> {}

impl<const D: usize> Constraint<D> for Affine<D> {
    fn prescribe(&self, grid: &Grid<D>, position: &[f64; D], axis: usize) -> Option<f64> {
        let on_face = |(x, a): (&f64, &Axis)| *x < a.lo + 1e-9 || *x > a.hi(grid.h) - 1e-9;
        let at_edge = position.iter().zip(&grid.axes).any(on_face);
        let along = |b: usize| self.gradient[(axis, b)] * (position[b] - self.centre);
        at_edge.then(|| (0..D).map(along).sum())
    }

    fn seen_from(self: Box<Self>, _: &Frame<D>) -> Box<dyn Constraint<D>> {
        self
    }
}

fn places_of<I: Interpolation<D>, const D: usize>() -> Places {
    let any = Grid::new(H, [Axis::walls(0.0, 6); D]).unwrap();
    // Domains of means have to tile the body; other functions are integrated exactly by Gauss' rule.
    if I::on(any).unwrap().beyond_wall(1.0) > 0.0 { Places::Uniform } else { Places::Gauss }
}

/// The stresses after one step of the particles that lie within `radius` (m) of the centre, which is affine too.
fn patch<const D: usize, I: Interpolation<D>, M: Law + Clone + 'static>(
    law: &M,
    gradient: SMatrix<f64, D, D>,
    radius: f64,
    stabilisation: Stabilisation,
) -> Vec<SymmetricTensor> {
    let mut scene = full::<D, _>(CELLS, places_of::<I, D>(), law.clone());
    let p = &scene.bodies.particles;
    let from_centre = |x: &[f64; D]| SVector::from(*x).add_scalar(-CENTRE);
    let places = p.position.iter().copied();
    let within = places.filter(|x| from_centre(x).norm() <= radius);
    let volume = p.reference_volume[0];
    let some = Particles::new(within.collect(), volume, 1000.0, p.half_size).unwrap();
    scene.bodies = Bodies::new(shared(law.clone()), some).unwrap();
    let settings = Settings { tolerance: 1e-13, ..Settings::new(1.0).stabilised(stabilisation) };
    let mut solver = Solver::<D>::new::<I>(scene.constrain(Affine { gradient, centre: CENTRE }), settings).unwrap();
    solver.step().unwrap();
    // Parts of an affine motion, one after the other, are another one.
    assert_eq!(solver.convergence().unwrap().parts, 1);
    let p = solver.particles();
    for (x0, x) in p.reference.iter().zip(&p.position) {
        let error = SVector::from(*x) - SVector::from(*x0) - gradient * from_centre(x0);
        assert!(error.norm() < 1e-13, "{error}");
    }
    p.stress.clone()
}

/// An affine field at the boundary is one inside, with the stress of its law everywhere.
fn reproduces_affine_fields<const D: usize, I: Interpolation<D>, M: Law + Clone + 'static>(law: &M) {
    // Shrinks, so that the body stays on the grid.
    let gradient = SMatrix::from_fn(|i, j| 0.01 * (i as f64 - 0.7 * j as f64) - if i == j { 0.08 } else { 0.0 });
    let f = embed(&(SMatrix::<f64, D, D>::identity() + gradient));
    let exact = law.response(&f, 1.0, &law.initial_state()).0.to_matrix();
    for stress in patch::<D, I, M>(law, gradient, f64::INFINITY, Stabilisation::Ghost(0.01)) {
        let error = (stress.to_matrix() - exact).norm();
        assert!(error < 1e-12 * YOUNG, "{error}");
    }
}

#[test]
fn affine_fields_pass_the_patch_test() {
    let law = NeoHookean::new(YOUNG, POISSON).unwrap();
    every_basis!(reproduces_affine_fields, 1, &law);
    every_basis!(reproduces_affine_fields, 2, &law);
    reproduces_affine_fields::<3, Means<3>, _>(&law);
    reproduces_affine_fields::<3, Quadratics<3>, _>(&law);
    let law = Hypoelastic::new(YOUNG, POISSON, JaumannUpdate::Split).unwrap();
    every_basis!(reproduces_affine_fields, 2, &law);
}

/// A turn by a tenth of a radian, in one step.
fn turns_without_stress<const D: usize, I: Interpolation<D>, M: Law + Clone + 'static>(law: &M) {
    let (sin, cos) = 0.1_f64.sin_cos();
    let mut gradient = SMatrix::<f64, D, D>::zeros();
    (gradient[(0, 0)], gradient[(1, 1)]) = (cos - 1.0, cos - 1.0);
    (gradient[(0, 1)], gradient[(1, 0)]) = (-sin, sin);
    for stress in patch::<D, I, M>(law, gradient, CENTRE, Stabilisation::Ghost(0.01)) {
        assert!(stress.norm() < 1e-12 * YOUNG, "{stress:?}");
    }
}

#[test]
fn a_rigid_turn_gives_no_stress() {
    turns_without_stress::<2, Quadratics<2>, _>(&NeoHookean::new(YOUNG, POISSON).unwrap());
    turns_without_stress::<2, Means<2>, _>(&Hencky::new(YOUNG, POISSON).unwrap());
    let split = Hypoelastic::new(YOUNG, POISSON, JaumannUpdate::Split).unwrap();
    turns_without_stress::<2, Quadratics<2>, _>(&split);
    turns_without_stress::<3, Quadratics<3>, _>(&Hencky::new(YOUNG, POISSON).unwrap());
}

/// Near the end an iteration squares the error of Newton's method: of three residuals in a row ln(e₃/e₂)/ln(e₂/e₁)
/// comes to two before rounding ends it.
#[test]
fn newton_converges_quadratically() {
    let settings = Settings { tolerance: 1e-11, ..Settings::new(1.0).stabilised(Stabilisation::Ghost(0.01)) };
    for remedy in [Remedy::None, Remedy::Bbar, Remedy::FbarConsistent] {
        let scene = standing::<2, _>(4, Places::Uniform, NeoHookean::new(YOUNG, POISSON).unwrap(), 1e4);
        let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings.remedy(remedy)).unwrap();
        solver.step().unwrap();
        let convergence = solver.convergence().unwrap();
        assert_eq!(convergence.parts, 1);
        if remedy == Remedy::None {
            // One solution by factors an iteration.
            let work = solver.work();
            assert_eq!(work.linear_iterations, work.newton_iterations);
        }
        let residuals: Vec<f64> = convergence.residuals.clone();
        let near: Vec<f64> = residuals.iter().copied().filter(|r| *r < 0.1).collect();
        let order = |k: usize| (near[k + 2] / near[k + 1]).ln() / (near[k + 1] / near[k]).ln();
        let orders = (0..near.len().saturating_sub(2)).map(order);
        assert!(orders.fold(0.0, f64::max) > 1.7, "{residuals:?}");
        assert!(convergence.force_ratio <= 1e-11 && convergence.energy_ratio < 1e-11);
    }
}

/// Height X of a bar under its weight: P = −w (H − X) = μ (F − 1/F) + λ ln F / F, u = ∫ (F − 1) dX.
fn sinking(x: f64, height: f64, weight: f64, law: &NeoHookean) -> f64 {
    let stretch = |x: f64| {
        // Below the root of a concave function.
        let mut f: f64 = 0.2;
        for _ in 0..50 {
            let stress = law.mu * (f - 1.0 / f) + law.lambda * f.ln() / f;
            let slope = law.mu * (1.0 + 1.0 / (f * f)) + law.lambda * (1.0 - f.ln()) / (f * f);
            f -= (stress + weight * (height - x)) / slope;
        }
        f - 1.0
    };
    let n = 200;
    let step = x / f64::from(n);
    let at = |k: i32| stretch(step * f64::from(k));
    let inner: f64 = (1..n).map(|k| at(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
    step / 3.0 * (at(0) + inner + at(n))
}

/// Root mean square error of the particles' displacement over the greatest displacement.
fn bar_error<I: Interpolation<1>>(cells: usize) -> f64 {
    let law = NeoHookean::new(YOUNG, 0.0).unwrap();
    let (height, weight) = (H * cells as f64, 0.3 * YOUNG / (H * cells as f64));
    let scene = standing::<1, _>(cells, Places::Gauss, law, weight);
    let mut solver = Solver::<1>::new::<I>(scene, Settings::new(1.0)).unwrap();
    solver.step().unwrap();
    assert_eq!(solver.convergence().unwrap().parts, 1);
    let p = solver.particles();
    let error = |(x, x0): (&[f64; 1], &[f64; 1])| (x[0] - x0[0] - sinking(x0[0], height, weight, &law)).powi(2);
    let squares: f64 = p.position.iter().zip(&p.reference).map(error).sum();
    (squares / p.len() as f64).sqrt() / sinking(height, height, weight, &law).abs()
}

/// Second order, as particles stand at Gauss points; at the base the bar is compressed by a quarter.
#[test]
fn a_bar_sinks_under_its_weight_as_exactly() {
    for error in [
        [8, 16, 32].map(bar_error::<Hats<1>>),
        [8, 16, 32].map(bar_error::<Quadratics<1>>),
        [8, 16, 32].map(bar_error::<Cubics<1>>),
    ] {
        let order = (error[1] / error[2]).log2();
        assert!(order > 1.8 && error[2] < 1e-3, "{error:?}");
    }
}

/// Ground between walls that yields.
fn ground() -> Scene<2> {
    let strength = Strength::softening(2e3, 1e3, 1.0).unwrap();
    let law = HenckyJ2::new(YOUNG, POISSON, strength).unwrap();
    let axes = [Axis::walls(0.0, 8), Axis::bounded(0.0, 10, (Side::Wall, Side::Open))];
    let roller = |axis, end| Wall::new(axis, end, WallKind::Roller);
    filled(axes, 8, Places::Uniform, law).constrain_all([roller(0, End::Lo), roller(0, End::Hi), roller(1, End::Lo)])
}

fn in_two_steps(scene: Scene<2>, remedy: Remedy, onto: Onto) -> Solver<2> {
    let settings = Settings::new(0.5).remedy(remedy).onto(onto).stabilised(Stabilisation::Ghost(0.01));
    Solver::new::<Quadratics<2>>(scene, settings).unwrap()
}

/// The ground under its weight.
fn loaded(remedy: Remedy, onto: Onto) -> Solver<2> {
    let weight = BodyForce(Box::new(|_, t| [0.0, -4.0 * t]));
    in_two_steps(ground().load(weight), remedy, onto)
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    for (remedy, onto) in [
        (Remedy::None, Onto::Basis),
        (Remedy::Bbar, Onto::Basis),
        (Remedy::FbarConsistent, Onto::Basis),
        (Remedy::FbarConsistent, Onto::Cells),
    ] {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().unwrap().install(|| {
                let mut solver = loaded(remedy, onto);
                solver.advance(2).unwrap();
                assert!(solver.field(Field::PlasticStrain).iter().any(|e| *e > 0.0));
                (bits(&solver), solver.work())
            })
        };
        assert_eq!(with(1), with(2));
    }
}

#[test]
fn a_run_that_was_stopped_goes_on_as_if_it_had_not() {
    for onto in [Onto::Basis, Onto::Cells] {
        let fresh = || loaded(Remedy::FbarConsistent, onto);
        let mut straight = fresh();
        straight.step().unwrap();
        let saved = straight.save().unwrap();
        straight.step().unwrap();
        let mut resumed = fresh();
        resumed.restore(&saved).unwrap();
        resumed.step().unwrap();
        assert_eq!(bits(&straight), bits(&resumed));
        assert_eq!(straight.time(), resumed.time());
        assert_eq!(straight.totals(), resumed.totals());
    }
}

/// A step whose loads are stored and given: the work of the loads is the energy stored, of a step of dead loads by the
/// trapezoidal rule within its square, and a bar's reaction is its weight.
#[test]
fn reactions_balance_the_weight() {
    let law = NeoHookean::new(YOUNG, POISSON).unwrap();
    let scene = standing::<2, _>(4, Places::Uniform, law, 1e3);
    let mut solver =
        Solver::<2>::new::<Quadratics<2>>(scene, Settings::new(1.0).stabilised(Stabilisation::Ghost(0.01))).unwrap();
    solver.step().unwrap();
    let weight = 1e3 * (4.0 * H).powi(2);
    assert!((solver.on(Part::Constraint(1)).force[1] / -weight - 1.0).abs() < 1e-8);
    assert!(solver.on(Part::Constraint(0)).force[0].abs() < 1e-8 * weight);
    let totals = solver.totals();
    assert!((totals.accumulated.load_work / totals.stored_energy - 1.0).abs() < 0.02);
    let columns = &solver.particles();
    assert!(columns.velocity.is_empty() && columns.affine.is_empty());
    assert!(columns.increment.is_empty() && columns.j_bar.is_empty());
}

#[test]
fn what_is_not_allowed_is_named() {
    let scene = || standing::<2, _>(4, Places::Uniform, Hencky::new(YOUNG, POISSON).unwrap(), 1e3);
    let refused = |settings: Settings, what: &str| {
        let error = Solver::<2>::new::<Means<2>>(scene(), settings).err().unwrap();
        assert!(error.to_string().contains(what), "{error}");
    };
    refused(Settings::new(0.0), "load step");
    refused(Settings { tolerance: 0.5, ..Settings::new(1.0) }, "tolerance");
    refused(Settings::new(1.0).stabilised(Stabilisation::Ghost(-1.0)), "stabilisation");
    refused(Settings::new(1.0).stabilised(Stabilisation::Soft(0.01)), "ghost");
    let wall = Wall::new(0, End::Hi, WallKind::Separable);
    let error = Solver::<2>::new::<Means<2>>(scene().constrain(wall), Settings::new(1.0));
    assert!(error.err().unwrap().to_string().contains("one-sided"));
    let law = Hypoelastic::new(YOUNG, POISSON, JaumannUpdate::Split).unwrap();
    let settings = Settings::new(1.0).remedy(Remedy::FbarConsistent);
    let error = Solver::<2>::new::<Means<2>>(standing::<2, _>(4, Places::Uniform, law, 1e3), settings);
    assert!(error.err().unwrap().to_string().contains("remedy none"));
}

/// A body that hangs on nothing has no equilibrium; what came before is kept.
#[test]
fn no_equilibrium_is_an_error() {
    let law = Hencky::new(YOUNG, POISSON).unwrap();
    let scene = full::<2, _>(4, Places::Uniform, law).load(BodyForce(Box::new(|_, _| [0.0, -1.0])));
    let settings = Settings { most_halvings: 2, ..Settings::new(1.0) };
    let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
    let before = solver.particles().reference.clone();
    let error = solver.step().unwrap_err();
    let known = matches!(error, Error::Singular { .. } | Error::NoConvergence { .. } | Error::Breakdown { .. });
    assert!(known, "{error}");
    let mut at = solver.particles().seeded(|k| solver.particles().position[k]);
    let mut from = before;
    at.sort_by(|a, b| a.partial_cmp(b).unwrap());
    from.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(at, from);
}
