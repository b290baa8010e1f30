//! Changes of pressure in bodies that move across cells; water that comes from within.

use super::*;

/// Cells of a body along an axis, empty ones before it and on the whole.
const BODY: usize = 4;
const BEFORE: usize = 3;
const ALL: usize = 12;

/// Water at rest in a body that is carried up through the cells keeps its pressure, linear below the top: no increment
/// varies within a cell, or bends from cell to cell.
fn is_carried_along<const D: usize, I: OfHats<D>>(settings: Settings) {
    let particles = block(H, 2, [BEFORE; D], [BEFORE + BODY; D]);
    let top = (BEFORE + BODY) as f64 * H;
    let uppermost = move |x: &[f64; D]| x[D - 1] > top - 0.5 * H;
    let face = Face::drained(&particles, uppermost, (D - 1, End::Hi), 100.0 * KAPPA / H);
    let mut acceleration = [0.0; D];
    acceleration[D - 1] = -10.0;
    let water = water()
        .gravity(Gravity { water: 1000.0, grains: 2600.0, acceleration })
        .start(move |x| 1e4 * (top - x[D - 1]))
        .face(face);
    let grid = Grid::new(H, [Axis::open(0.0, ALL); D]).unwrap();
    let mut velocity = [Some(0.0); D];
    velocity[D - 1] = Some(0.23 * H / settings.dt);
    let all_nodes =
        RigidNodes { extent: [[f64::NEG_INFINITY, f64::INFINITY]; D], velocity, amplitude: Amplitude::Rise(0.0) };
    let scene = Scene::new(grid, Bodies::new(porous(), particles).unwrap()).constrain(all_nodes);
    let mut solver = Solver::<D>::new::<I>(scene, water, settings).unwrap();
    for step in 1..=12 {
        solver.step().unwrap();
        let top = top + 0.23 * H * f64::from(step);
        let pressures = solver.field(Field::PorePressure);
        for (x, pressure) in solver.particles().position.iter().zip(pressures) {
            // Pressures are those of the step, at places of its start.
            let error = pressure - 1e4 * (top - x[D - 1]);
            assert!(error.abs() < 1e-6 * 1e4 * H, "step {step}: {error}");
        }
    }
}

#[test]
fn water_at_rest_is_carried_through_the_cells() {
    let dt = H * H / (KAPPA * MODULUS);
    for pressure_space in SPACES {
        let settings = Settings::new(dt).ghosts(0.1, 0.01).pressure_space(pressure_space);
        is_carried_along::<1, Means<1>>(settings);
        is_carried_along::<2, Means<2>>(settings);
    }
}

/// With no way out, the volume grows by what sources give.
#[test]
fn water_from_within_swells_a_body() {
    for space in SPACES {
        let scene = standing::<2, _>(porous(), straight);
        let volume: f64 = scene.bodies.particles.reference_volume.iter().sum();
        let source = |rate: f64| move |x: &[f64; 2], [begin, end]: [f64; 2]| rate * x[1] * (end - begin);
        let water = water().source(source(3e-3)).source(source(2e-3));
        let settings = Settings::new(2.0).pressure_space(space);
        let mut solver = Solver::<2>::new::<Means<2>>(scene, water, settings).unwrap();
        solver.advance(2).unwrap();
        let balance = solver.water().copied().unwrap();
        // The mean of the height over the body is half of it.
        let given = 4.0 * 5e-3 * 0.5 * TOP * volume;
        let grown: f64 = solver.particles().volume.iter().sum::<f64>() - volume;
        assert!((balance.inflow / given - 1.0).abs() < 1e-12);
        assert!((grown / given - 1.0).abs() < 1e-8, "{grown} {given}");
        assert!(balance.imbalance.abs() < 1e-8 * given && balance.outflow == 0.0);
    }
}
