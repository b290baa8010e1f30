//! Cost of the ghost penalty on the pressure that Pretti et al. have.

use super::*;

/// None, and that of the paper; of displacements both have the same.
fn ghosts(dt: f64) -> [Settings; 2] {
    let settings = Settings::new(dt).tangent(Tangent::Consistent);
    [settings.ghosts(0.1, 0.0), settings.ghosts(0.1, 0.01)]
}

/// A column whose height is this share of that of the cells, under 0.3 of its modulus and drained at its top.
fn unfitted(height: f64, settings: Settings) -> Solver<1> {
    let fitted = standing::<1, _>(porous(), straight);
    let places = &fitted.bodies.particles.position;
    let places = places.iter().map(|x| [x[0] * height]).collect();
    let spacing = 0.5 * H * height;
    let particles = Particles::new(places, spacing, 1000.0, [0.5 * spacing]).unwrap();
    let highest = |x: &[f64; 1]| x[0] > height * (TOP - 0.5 * H);
    let load = Face::loaded(&particles, highest, (0, End::Hi), |_| [-0.3 * MODULUS]);
    let drain = Face::drained(&particles, highest, (0, End::Hi), 100.0 * KAPPA / H);
    let floor = Wall::new(0, End::Lo, WallKind::Roller);
    let body = Bodies::new(porous(), particles).unwrap();
    let scene = Scene::new(fitted.grid, body).constrain(floor);
    Solver::new::<Means<1>>(scene, water().face(load).face(drain), settings).unwrap()
}

/// Settlements over the height after 1, 10 and 40 steps.
fn settlements(settings: Settings) -> [f64; 3] {
    let mut solver = unfitted(0.93, settings);
    let mut steps = 0;
    [1, 10, 40].map(|end| {
        while steps < end {
            solver.step().unwrap();
            steps += 1;
        }
        let p = solver.particles();
        let volume = |of: &[f64]| of.iter().sum::<f64>();
        1.0 - volume(&p.volume) / volume(&p.reference_volume)
    })
}

/// `docs/poromechanics.md` tells these numbers.
#[test]
fn a_column_settles_more_with_a_ghost() {
    let [none, paper] = ghosts(0.005 / (KAPPA * MODULUS)).map(settlements);
    let found = [0, 1, 2].map(|k| paper[k] / none[k] - 1.0);
    for (found, told) in found.into_iter().zip([0.008, 0.008, 0.003]) {
        assert!((found - told).abs() < 0.1 * told + 5e-4, "{found} {told}");
    }
}

/// Condition of the scaled matrix of a column whose top reaches a cell of the displacement and one of the pressure by
/// hardly anything: where water flows it mends it, where none flows it doesn't.
#[test]
fn a_ghost_mends_the_condition_of_small_cuts_where_water_flows() {
    let height = (6.0 + 3e-4) / HIGH as f64;
    let conditions = |flow: f64| {
        let settings = ghosts(flow / (KAPPA * MODULUS));
        settings.map(|s| unfitted(height, s).condition())
    };
    let told = conditions(0.005).into_iter().chain(conditions(5e-8)).zip([236.0, 13.3, 794.0, 779.0]);
    for (found, told) in told {
        assert!((found / told - 1.0_f64).abs() < 0.01, "{found} {told}");
    }
}

/// A top that rounding takes past a grid line touches a cell whose nodes no particle sees: what these are is no
/// unknown, and nothing is held by them.
#[test]
fn a_cell_touched_by_rounding_holds_nothing() {
    let settings = ghosts(0.005 / (KAPPA * MODULUS))[1];
    let settlement = |rounding: f64| {
        let mut solver = unfitted(6.0 / HIGH as f64 * (1.0 + rounding), settings);
        solver.step().unwrap();
        solver.particles().volume.iter().sum::<f64>()
    };
    let [below, above] = [-4e-15, 4e-15].map(settlement);
    assert!((above / below - 1.0).abs() < 1e-9, "{below} {above}");
}
