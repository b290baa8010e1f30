//! Bodies that slide: friction, surfaces that meet or pass, and Hertz's contact.

use super::*;

/// The factor of what rises over `rise` (s).
fn risen(time: f64, rise: f64) -> f64 {
    Amplitude::Rise(rise).at(time)
}

/// The particles without those that `out` picks.
fn without(p: Particles<2>, out: impl Fn(&[f64; 2]) -> bool) -> Particles<2> {
    let places = p.position.into_iter().filter(|x| !out(x)).collect();
    Particles::new(places, p.reference_volume[0], DENSITY, p.half_size).unwrap()
}

/// A block on a fixed base under gravity that is tilted: above the angle of friction it accelerates by
/// g (sin θ − μ cos θ), below it stays.
#[test]
fn a_block_slides_above_the_angle_of_friction_only() {
    let theta = 0.5_f64;
    for friction in [0.0, 0.3, 0.6] {
        let axes = [Axis::open(0.0, 40), Axis::bounded(0.0, 12, (Side::Wall, Side::Open))];
        let base = block(H, 2, [2, 0], [38, 3]);
        let upper = block(H, 2, [4, 3], [8, 5]);
        let stiff = NeoHookean::new(2000.0, 0.3).unwrap();
        let bodies = Bodies::new(stiff, base).unwrap().and(stiff, upper).unwrap().sliding(friction).unwrap();
        // Gravity presses first, and pulls once the block rests: what is loaded at once bounces.
        let gravity = move |t: f64| [theta.sin() * risen((t - 2.0).max(0.0), 1.0), -theta.cos() * risen(t, 2.0)];
        let scene = Scene::new(Grid::new(H, axes).unwrap(), bodies)
            .load(Gravity(Box::new(gravity)))
            .constrain(Wall::new(1, End::Lo, WallKind::Fixed));
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings(stiff.wave_speed(DENSITY))).unwrap();
        let momentum =
            |run: &Solver<2, 3, Gimp>| run.scene().bodies.totals_of(run.scene().bodies.each[1].range()).momentum;
        let mut at = [[0.0; 2]; 2];
        for (time, at) in [3.0, 6.0].into_iter().zip(&mut at) {
            while solver.time() < time {
                solver.step().unwrap();
            }
            let mass = DENSITY * 2.0;
            *at = [momentum(&solver)[0] / mass, solver.on(Part::Body(1)).impulse[1] / mass];
        }
        let exact = f64::max(0.0, theta.sin() - friction * theta.cos());
        told(&format!("acceleration with friction {friction} (g)"), (at[1][0] - at[0][0]) / 3.0, exact);
        assert!(((at[1][0] - at[0][0]) / 3.0 - exact).abs() < 0.01, "{friction}");
        assert!(((at[1][1] - at[0][1]) / 3.0 - theta.cos()).abs() < 0.01);
    }
}

/// Discs whose rims pass at a fifth of a cell: functions see both, and nothing happens.
#[test]
fn discs_that_pass_do_not_feel_each_other() {
    let disc = |centre: [f64; 2], v: f64| {
        let mut p = without(block(H, 2, [0, 0], [40, 24]), |x| (x[0] - centre[0]).hypot(x[1] - centre[1]) > 2.0);
        p.velocity.fill([v, 0.0]);
        p
    };
    for offset in [4.3, 4.6] {
        let (left, right) = (disc([5.0, 3.0], 1.0), disc([11.0, 3.0 + offset], -1.0));
        let bodies = Bodies::new(law(), left).unwrap().sliding(0.3).unwrap();
        let bodies = bodies.and(law(), right).unwrap().sliding(0.3).unwrap();
        let grid = Grid::new(H, [Axis::open(0.0, 40), Axis::open(0.0, 24)]).unwrap();
        let mut solver = Solver::<2, 3, QuadraticBSpline>::new(Scene::new(grid, bodies), of_law()).unwrap();
        let whole = solver.totals().kinetic_energy;
        while solver.time() < 6.0 {
            solver.step().unwrap();
        }
        let after = solver.totals();
        let lost = 1.0 - after.kinetic_energy / whole;
        told("energy lost by discs that pass", lost, 0.0);
        assert!(lost.abs() < 1e-12, "{offset}: lost {lost}");
        assert_eq!(solver.on(Part::Body(0)).impulse, [0.0; 3]);
    }
}

/// Blocks that fly at each other meet when their faces do, and not before; they keep momentum and gain no energy.
fn meet_when_faces_do<const D: usize, const S: usize, B: Basis<S> + 'static>() {
    let [left, mut right] = [(); 2].map(|()| block::<D>(H, 2, [2; D], [6; D]));
    right.position.iter_mut().chain(&mut right.reference).for_each(|x| x[0] += 5.0 * H);
    right.velocity.fill(std::array::from_fn(|a| if a == 0 { -0.5 } else { 0.1 }));
    let bodies = Bodies::new(law(), left).unwrap().and(law(), right).unwrap().sliding(0.2).unwrap();
    let mut solver = Solver::<D, S, B>::new(Scene::new(open_grid(H, 16), bodies), of_law()).unwrap();
    let dt = 0.3 * H / law().wave_speed(DENSITY);
    let before = solver.totals();
    while solver.on(Part::Body(1)).impulse[0] == 0.0 {
        solver.step().unwrap();
        assert!(solver.time() < 1.1);
    }
    // The gap of half a metre closes at half a metre a second.
    assert!((solver.time() - 1.0).abs() <= 1.5 * dt, "{}", solver.time());
    solver.advance(100).unwrap();
    let after = solver.totals();
    for (p, q) in before.momentum.iter().zip(after.momentum) {
        assert!((p - q).abs() < 1e-11 * before.mass, "momentum {p} became {q}");
    }
    assert!(after.kinetic_energy + after.stored_energy < before.kinetic_energy);
}

#[test]
fn nothing_acts_before_surfaces_meet_in_any_dimension() {
    meet_when_faces_do::<1, 3, Gimp>();
    meet_when_faces_do::<1, 4, CubicBSpline>();
    meet_when_faces_do::<2, 3, Gimp>();
    meet_when_faces_do::<3, 3, Gimp>();
    meet_when_faces_do::<3, 3, QuadraticBSpline>();
}

/// Particles of a disc on rings, so that its rim is smooth.
fn rings(centre: [f64; 2], radius: f64, spacing: f64) -> Particles<2> {
    let count = (radius / spacing).round() as usize;
    let mut places = Vec::new();
    for ring in 0..count {
        let r = (ring as f64 + 0.5) * spacing;
        let around = (2.0 * PI * (ring as f64 + 0.5)).round() as usize;
        // A particle of every ring on the line of the centres.
        let angle = |k: usize| 2.0 * PI * k as f64 / around as f64;
        places.extend((0..around).map(|k| [centre[0] + r * angle(k).cos(), centre[1] + r * angle(k).sin()]));
    }
    let volume = PI * radius * radius / places.len() as f64;
    Particles::new(places, volume, DENSITY, [0.5 * spacing; 2]).unwrap()
}

/// Two discs that are pressed together: force, width and greatest pressure of the contact by Hertz (1882), of cylinders.
#[test]
fn two_discs_press_each_other_as_hertz_says() {
    let (h, radius, width) = (0.025, 1.0, 0.1);
    let (young, ratio) = (100.0, 0.3);
    let stiff = young / (2.0 * (1.0 - ratio * ratio));
    // a² = 4 P R/(π E) with R/2 of both and E of both.
    let force = width * width * PI * stiff / (4.0 * 0.5 * radius);
    let pull = force / (DENSITY * PI * radius * radius);
    let (left, right) = (rings([1.25, 1.5], radius, 0.5 * h), rings([3.25, 1.5], radius, 0.5 * h));
    let law = NeoHookean::new(young, ratio).unwrap();
    let bodies = Bodies::new(law, left).unwrap().and(law, right).unwrap().sliding(0.0).unwrap();
    let pressed = move |x: &[f64; 2], t: f64| [pull * risen(t, 2.0) * if x[0] < 2.25 { 1.0 } else { -1.0 }, 0.0];
    let grid = Grid::new(h, [Axis::open(0.0, 180), Axis::open(0.0, 120)]).unwrap();
    let scene = Scene::new(grid, bodies).load(BodyForce(Box::new(pressed)));
    let settings = Settings::new(courant_time_step(0.3, h, law.wave_speed(DENSITY)));
    let settings = settings.filter_forces(LocalDamping::new(0.1).unwrap());
    let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
    while solver.time() < 4.0 {
        solver.step().unwrap();
    }
    let before = solver.on(Part::Body(0)).impulse[0];
    let begun = solver.time();
    while solver.time() < 6.0 {
        solver.step().unwrap();
    }
    let mean = -(solver.on(Part::Body(0)).impulse[0] - before) / (solver.time() - begun);
    let p = solver.particles();
    // Pressures of the outermost ring that faces the other disc, and how far from the middle they act.
    let facing = solver.scene().bodies.each[0].range().filter(|k| {
        let x = &p.reference[*k];
        (x[0] - 1.25).hypot(x[1] - 1.5) > radius - 0.5 * h && x[0] > 1.25 + 0.9 * radius
    });
    let (mut sum, mut second, mut most) = (0.0, 0.0, 0.0_f64);
    for k in facing {
        let pressure = -p.stress[k].xx;
        let y = p.position[k][1] - 1.5;
        sum += pressure;
        second += pressure * y * y;
        most = most.max(pressure);
    }
    let found = 2.0 * (second / sum).sqrt();
    let greatest = 2.0 * force / (PI * width);
    told("force of two discs (N/m)", mean, force);
    told("half width of their contact (m)", found, width);
    told("greatest pressure (Pa)", most, greatest);
    // The contact balances the load. Hertz's half-spaces err by the order of a/R; the contact is eight cells wide.
    assert!((mean / force - 1.0).abs() < 0.01, "{mean} of {force}");
    assert!((found / width - 1.0).abs() < width / radius, "{found} of {width}");
    assert!((most / greatest - 1.0).abs() < width / radius, "{most} of {greatest}");
}

/// A block on an incline, both cut from a lattice that is not along it: it slides as on a smooth incline whose angle is
/// known to the size of a particle over the cells that a normal sees.
#[test]
fn a_block_slides_on_steps_as_on_a_smooth_incline() {
    let (h, g) = (0.25, 9.81);
    let stiff = Hencky::new(5e5, 0.3).unwrap();
    let tried = [(10.0_f64, 0.0), (10.0, 0.2), (20.0, 0.0), (20.0, 0.2), (20.0, 0.5), (30.0, 0.0), (30.0, 0.5)];
    // Three cells to either side and the two and a half of a function, with particles of half a cell.
    let known = 0.5 / 8.5;
    for (degrees, friction) in tried {
        let theta = degrees.to_radians();
        let given = |angle: f64| g * f64::max(0.0, angle.sin() - friction * angle.cos());
        let surface = |x: f64| 8.0 - x * theta.tan();
        let base = without(block(h, 2, [0, 0], [40, 32]), |x| x[1] > surface(x[0]));
        // Along the slope from one metre on, and off it.
        let local = |x: &[f64; 2]| {
            let d = [x[0] - 1.0, x[1] - surface(1.0)];
            [d[0] * theta.cos() - d[1] * theta.sin(), d[0] * theta.sin() + d[1] * theta.cos()]
        };
        let upper = without(block(h, 2, [0, 0], [40, 46]), |x| {
            let [along, off] = local(x);
            !(0.0..2.0).contains(&along) || !(0.0..1.0).contains(&off)
        });
        let bodies = Bodies::new(stiff, base).unwrap().and(stiff, upper).unwrap().sliding(friction).unwrap();
        let axes = [Axis::walls(0.0, 40), Axis::bounded(0.0, 50, (Side::Wall, Side::Open))];
        let scene = Scene::new(Grid::new(h, axes).unwrap(), bodies)
            .load(Gravity(Box::new(move |t| [0.0, -g * risen(t, 0.2)])))
            .constrain(Wall::new(1, End::Lo, WallKind::Fixed));
        let settings = Settings::new(courant_time_step(0.3, h, stiff.wave_speed(DENSITY)));
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
        let momentum = |run: &Solver<2, 3, Gimp>| {
            let body = &run.scene().bodies.each[1];
            let all = run.scene().bodies.totals_of(body.range());
            (all.momentum[0] * theta.cos() - all.momentum[1] * theta.sin()) / all.mass
        };
        let mut speeds = [0.0; 2];
        for (time, speed) in [0.3, 1.0].into_iter().zip(&mut speeds) {
            while solver.time() < time {
                solver.step().unwrap();
            }
            *speed = momentum(&solver);
        }
        let exact = given(theta);
        let found = (speeds[1] - speeds[0]) / 0.7;
        told(&format!("acceleration on steps of {degrees}°, friction {friction} (m/s²)"), found, exact);
        // A thousandth of gravity beside it: the block sways on its teeth.
        let [least, most] = [given(theta - known) - 0.01, given(theta + known) + 0.01];
        assert!((least..most).contains(&found), "{found}, not {least} to {most} at {degrees}° with {friction}");
    }
}
