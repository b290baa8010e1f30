//! Pressures that are extrapolated, and bodies without water.

use super::*;

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
