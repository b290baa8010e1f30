//! Columns that consolidate.

use super::*;
use crate::scenes::with_threads;

/// Two particles in one cell of hats, drained at the upper node, under a load q: with e the strain and p the pressure
/// at the floor, M e − p/2 = −q and e′ = −2 κ p/h² at small strain, of which backward Euler makes e + q/M = (e₀ +
/// q/M)/(1 + 4 κ M Δt/h²).
#[test]
fn one_element_consolidates_as_its_closed_form() {
    let law = Hencky::new(1e5, 0.25).unwrap();
    let modulus = 1.2e5;
    let grid = Grid::new(H, [Axis::bounded(0.0, 4, (Side::Wall, Side::Open))]).unwrap();
    let particles = Particles::new(vec![[0.25 * H], [0.75 * H]], 0.5 * H, 1.0, [0.25 * H]).unwrap();
    let floor = Wall::new(0, End::Lo, WallKind::Roller);
    let scene = Scene::new(grid, Bodies::new(law, particles).unwrap()).constrain(floor);
    let load = 1e-6 * modulus;
    let upper = |x: &[f64; 1]| x[0] > 0.5 * H;
    let face = Face::loaded(&scene.bodies.particles, upper, (0, End::Hi), move |_| [-load]);
    let water = Water::new(POROSITY, Conductivity::Constant(KAPPA)).drained(|x| x[0] > 0.5 * H).face(face);
    let dt = 0.1 * H * H / (KAPPA * modulus);
    let settings = Settings::new(dt).pressure_space(PressureSpace::Equal);
    let mut solver = Solver::<1>::new::<Hats<1>>(scene, water, settings).unwrap();
    let mut lacking = load / modulus;
    for _ in 0..20 {
        solver.step().unwrap();
        lacking /= 1.0 + 4.0 * 0.1;
        let strain = solver.particles().jacobian[0] - 1.0;
        let pressure = 2.0 * modulus * lacking;
        let at_particle = solver.field(Field::PorePressure)[0] / 0.75;
        // At strains of 1e-6 the equations are linear to a few times that.
        let error = (strain + load / modulus - lacking).abs();
        assert!(error < 1e-5 * load / modulus, "{error}");
        let error = (at_particle - pressure).abs();
        assert!(error < 1e-5 * load, "{error}");
    }
}

/// The change of volume equals the outflow, to Newton's tolerance with the exact rate; not with the logarithmic one.
fn imbalance<const D: usize, I: OfHats<D>>(settings: Settings) -> f64 {
    let mut solver = loaded::<D, I>(0.5 * MODULUS, settings);
    solver.advance(10).unwrap();
    let balance = solver.water().copied().unwrap();
    let p = solver.particles();
    let volume = |of: &[f64]| of.iter().sum::<f64>();
    let change = volume(&p.volume) - volume(&p.reference_volume);
    assert!(balance.outflow > 0.05 * volume(&p.reference_volume));
    let difference = change + balance.outflow - balance.imbalance;
    assert!(difference.abs() < 1e-13 * volume(&p.reference_volume));
    (balance.imbalance / balance.outflow).abs()
}

#[test]
fn the_exact_rate_loses_no_water() {
    for pressure_space in SPACES {
        let settings = diffusing(0.05).pressure_space(pressure_space);
        assert!(imbalance::<1, Means<1>>(settings) < 1e-8);
        assert!(imbalance::<2, Means<2>>(settings) < 1e-8);
        let logarithmic = settings.volume_rate(VolumeRate::Logarithmic).tangent(Tangent::Consistent);
        let lost = imbalance::<1, Means<1>>(logarithmic);
        assert!(lost > 1e-4, "{lost}");
    }
}

/// Settlement and pressures of a column are those of a bar, in the plane and in space.
#[test]
fn a_column_is_a_bar_in_any_dimension() {
    fn agree(a: &[f64], b: &[f64]) {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 1e-7 * b.abs(), "{a} {b}");
        }
    }
    fn settled<const D: usize, I: OfHats<D>>(space: PressureSpace) -> Vec<f64> {
        let mut solver = loaded::<D, I>(0.2 * MODULUS, diffusing(0.05).pressure_space(space));
        solver.advance(2).unwrap();
        let pressure = solver.field(Field::PorePressure);
        let p = solver.particles();
        let values = |k: usize| [p.position[k][D - 1], pressure[k], p.jacobian[k]];
        let mut rows: Vec<usize> = (0..p.len()).collect();
        rows.sort_by(|j, k| p.reference[*j][D - 1].total_cmp(&p.reference[*k][D - 1]));
        let across = rows.len() / (2 * HIGH);
        for row in rows.chunks(across) {
            row.iter().for_each(|k| agree(&values(*k), &values(row[0])));
        }
        rows.chunks(across).flat_map(|row| values(row[0])).collect()
    }
    for space in SPACES {
        let bar = settled::<1, Means<1>>(space);
        agree(&settled::<2, Means<2>>(space), &bar);
    }
    let bar = settled::<1, Means<1>>(PressureSpace::TwoGrid);
    agree(&settled::<3, Means<3>>(PressureSpace::TwoGrid), &bar);
}

/// With both matrices the same solution; with the derivative of the equations at Newton's order.
#[test]
fn newton_converges_quadratically() {
    let of = |tangent: Tangent, predictor: Predictor| {
        let settings = Settings { tangent, predictor, tolerance: 1e-11, ..diffusing(0.05) };
        let mut solver = loaded::<2, Means<2>>(0.3 * MODULUS, settings);
        solver.advance(2).unwrap();
        let places = solver.particles().position.iter();
        let settlement: f64 = places.map(|x| x[1]).sum();
        (settlement, solver.convergence().unwrap().residuals.clone())
    };
    let (exact, residuals) = of(Tangent::Consistent, Predictor::Particles);
    let inner: Vec<f64> = residuals.iter().copied().filter(|r| *r > 1e-10).collect();
    let [.., a, b, c] = inner[..] else { panic!("{residuals:?}") };
    let order = (c / b).ln() / (b / a).ln();
    assert!(order > 1.7, "{order} {residuals:?}");
    for (tangent, predictor) in [(Tangent::Symmetric, Predictor::Particles), (Tangent::Consistent, Predictor::Zero)] {
        let (settlement, _) = of(tangent, predictor);
        assert!((settlement / exact - 1.0).abs() < 1e-9);
    }
}

/// Nodes are those of the coarse cells, from the floor up; the water there is under pressure at once.
#[test]
fn pressures_of_nodes_are_at_their_places() {
    let load = 1e-3 * MODULUS;
    let soon = 1e-6 * H * H / (KAPPA * MODULUS);
    let mut solver = loaded::<1, Hats<1>>(load, Settings::new(soon));
    solver.step().unwrap();
    let nodes = solver.pressure_nodes();
    assert_eq!(nodes.len(), HIGH / 2 + 1);
    for (k, ([x], pressure)) in nodes.into_iter().enumerate() {
        assert!((x - 2.0 * H * k as f64).abs() < 1e-12, "{x}");
        assert!(k > 0 || pressure > 0.0, "{pressure}");
    }
}

/// Twenty times the modulus at once, drained: an undamped correction would close the pores.
#[test]
fn pores_stay_open_under_any_load() {
    let mut solver = loaded::<1, Means<1>>(20.0 * MODULUS, diffusing(100.0).tangent(Tangent::Consistent));
    solver.step().unwrap();
    for n in solver.field(Field::Porosity) {
        assert!(n > 0.0 && n < 0.5 * POROSITY, "{n}");
    }
    // So long a step ends near the drained state: the law's stress is the load.
    let p = solver.particles();
    for stress in &p.stress {
        let ratio = stress.xx / (-20.0 * MODULUS);
        assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
    }
}

/// Heavy grains under water settle until the effective stress bears what they weigh more than water.
#[test]
fn grains_settle_under_their_weight_in_water() {
    let heavier = 1600.0 * 10.0 * (1.0 - POROSITY);
    let scene = standing::<1, _>(porous(), straight);
    let top = Face::drained(&scene.bodies.particles, topmost, (0, End::Hi), 1e4 * KAPPA / H);
    let water = water()
        .gravity(Gravity { water: 1000.0, grains: 2600.0, acceleration: [-10.0] })
        .start(|x| 1e4 * (TOP - x[0]))
        .face(top);
    let settings = Settings { growth: 2.0, tangent: Tangent::Consistent, ..diffusing(0.01) };
    let mut solver = Solver::<1>::new::<Means<1>>(scene, water, settings).unwrap();
    solver.advance(14).unwrap();
    let p = solver.particles();
    for k in 0..p.len() {
        let borne = heavier * (TOP - p.reference[k][0]);
        let error = (p.stress[k].xx + borne).abs();
        // Stress is about constant in a cell: of a particle a quarter of it from its middle so much is missing.
        assert!(error < 1.2 * heavier * H / 4.0, "{error} of {borne}");
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let of = |threads: usize| {
        with_threads(threads, || {
            let mut solver = loaded::<2, Means<2>>(0.3 * MODULUS, diffusing(0.05));
            solver.advance(3).unwrap();
            solver.save().unwrap()
        })
    };
    assert_eq!(of(1), of(2));
}

/// A run that is saved and restored goes on as if it had never stopped.
#[test]
fn nothing_is_forgotten() {
    for pressure_space in SPACES {
        let settings = Settings { pressure_space, growth: 1.1, ..diffusing(0.05) };
        let new = || loaded::<2, Means<2>>(0.3 * MODULUS, settings);
        let mut whole = new();
        whole.step().unwrap();
        let saved = whole.save().unwrap();
        whole.step().unwrap();
        let mut resumed = new();
        resumed.restore(&saved).unwrap();
        resumed.step().unwrap();
        assert_eq!(resumed.save().unwrap(), whole.save().unwrap());
        assert_eq!(resumed.pressure_nodes(), whole.pressure_nodes());
        assert!(new().restore(&Saved::of(&1_u8).unwrap()).is_err());
    }
}

/// Both equations are linear in the pressure, so that a first correction finds it from anywhere: Newton's method takes
/// the same iterations in five steps from the particles' pressures and from zero.
#[test]
fn where_newton_begins_does_not_matter() {
    for (share, told) in [(1e-6, 10), (0.3, 18)] {
        for predictor in [Predictor::Particles, Predictor::Zero] {
            let settings = Settings { predictor, tangent: Tangent::Consistent, ..diffusing(0.05) };
            let mut solver = loaded::<2, Means<2>>(share * MODULUS, settings);
            solver.advance(5).unwrap();
            assert_eq!(solver.work().newton_iterations, told, "{predictor:?}");
        }
    }
}
