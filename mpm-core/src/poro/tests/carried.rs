//! Changes of pressure in bodies that move across cells; water that comes from within.

use super::*;

/// Cells of a body along an axis, empty ones before it and on the whole.
const BODY: usize = 4;
const BEFORE: usize = 3;
const ALL: usize = 12;

/// Water at rest in a body that is carried up through the cells keeps its pressure, linear below the top: no increment
/// varies within a cell, or bends from cell to cell.
fn is_carried_along<const D: usize, I: OfHats<D>>(settings: Settings) {
    let particles = filling([2 * BODY; D], 0.5 * H, BEFORE as f64 * H);
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
    let all_nodes = RigidNodes {
        extent: [[f64::NEG_INFINITY, f64::INFINITY]; D],
        velocity,
        amplitude: crate::stage::Amplitude::Rise(0.0),
    };
    let scene = Scene::new(grid, Bodies::new(porous(), particles).unwrap()).constrain(all_nodes);
    let mut solver = Solver::<D>::new::<I>(scene, water, settings).unwrap();
    for step in 1..=12 {
        solver.step().unwrap();
        let top = top + 0.23 * H * f64::from(step);
        let p = solver.particles();
        for (x, pressure) in p.position.iter().zip(&solver.pores.pressure) {
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

/// A wave around a periodic axis is extrapolated to all nodes, those at its seam too, each by the volumes around it.
#[test]
fn pressures_are_extrapolated_to_the_nearest_image_by_volumes() {
    let grid = Grid::new(H, [Axis::periodic(0.0, HIGH)]).unwrap();
    let scene = Scene::new(grid, Bodies::new(porous(), filling([2 * HIGH], 0.5 * H, 0.0)).unwrap());
    let settings = Settings::new(1.0).pressure_space(PressureSpace::Projected { strength: 1.0 });
    let mut solver = Solver::<1>::new::<Means<1>>(scene, water(), settings).unwrap();
    let k = std::f64::consts::TAU / TOP;
    let places = solver.particles().position.clone();
    solver.pores.pressure = places.iter().map(|x| (k * x[0]).sin()).collect();
    solver.pores.slope = places.iter().map(|x| [k * (k * x[0]).cos()]).collect();
    let setting = solver.setting(1.0, Vec::new()).unwrap();
    let functions = solver.water_space.functions.as_ref();
    let particles = solver.particles();
    let told = unknowns::extrapolated(&setting.water, functions, particles, &solver.pores);
    let mut seen = 0;
    functions.for_each_node(&mut |node, place| {
        if solver.water_space.originals[node] == node {
            seen += 1;
            // From at most 1.25 cells away, half the second derivative times that squared.
            let bound = 0.5 * (k * 1.25 * H).powi(2);
            let error = told[node] - (k * place[0]).sin();
            assert!(error.abs() < bound, "{place:?}: {error} {bound}");
        }
    });
    assert_eq!(seen, HIGH);

    // Particles that differ: hats, whose means over domains in a cell are their values.
    let pressure: Vec<f64> = (0..places.len()).map(|p| (p * p) as f64).collect();
    let volume: Vec<f64> = (0..places.len()).map(|p| H / (1 + p) as f64).collect();
    solver.pores.pressure = pressure.clone();
    solver.pores.slope = vec![[0.0]; places.len()];
    solver.scene.bodies.particles.volume = volume.clone();
    let setting = solver.setting(1.0, Vec::new()).unwrap();
    let functions = solver.water_space.functions.as_ref();
    let told = unknowns::extrapolated(&setting.water, functions, solver.particles(), &solver.pores);
    functions.for_each_node(&mut |node, place| {
        let hat = |x: &[f64; 1]| {
            let apart = (place[0] - x[0]).rem_euclid(TOP);
            (1.0 - apart.min(TOP - apart) / H).max(0.0)
        };
        let sum = |of: &dyn Fn(usize) -> f64| -> f64 { (0..places.len()).map(|p| hat(&places[p]) * of(p)).sum() };
        let mean = sum(&|p| volume[p] * pressure[p]) / sum(&|p| volume[p]);
        if solver.water_space.originals[node] == node {
            let error = told[node] / mean - 1.0;
            assert!(error.abs() < 1e-12, "{place:?}: {error}");
        }
    });
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

/// A dry solver has one lattice, one pass and no extra column; one with water has two lattices and two passes.
#[test]
fn a_dry_body_carries_no_water() {
    let scene = || standing::<2, _>(porous(), straight);
    let settings = crate::implicit::Settings::new(1.0);
    let mut dry = crate::implicit::Solver::<2>::new::<Hats<2>>(scene(), settings).unwrap();
    dry.step().unwrap();
    assert!(dry.water().is_none() && dry.pressure_nodes().is_empty());
    assert!(dry.field(Field::PorePressure).is_empty() && dry.field(Field::Porosity).is_empty());
    let wet = Solver::<2>::new::<Hats<2>>(scene(), water(), Settings::new(1.0)).unwrap();
    let (solid, both) = (wet.solid_space.functions.len() as u64, wet.work().nodes);
    assert_eq!(dry.work().nodes, solid);
    assert_eq!(both, solid + wet.water_space.functions.len() as u64);
    // Deformations are gathered and forces scattered: four functions see a particle.
    let pairs = 2 * 4 * dry.work().particles;
    assert_eq!(dry.work().particle_node_pairs % pairs, 0);
}
