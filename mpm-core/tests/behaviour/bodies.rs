//! Several bodies: layers that stick, and bodies that slide on each other.

use crate::scenes::{DENSITY, block, law, open_grid, places, remedies, swirl, with_threads};
use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::remedy::{Fbar, Form};
use mpm_core::explicit::transfer::{Apic, Flip, Musl, Xpic};
use mpm_core::explicit::{Settings, Solver, Transfer, courant_time_step};
use mpm_core::material::{Hencky, NeoHookean, NewtonianFluid};
use mpm_core::memory::Memory;
use mpm_core::simulation::Field;
use mpm_core::stage::{Amplitude, BodyForce, End, Gravity, LocalDamping, Wall, WallKind};
use mpm_core::{
    Axis, Basis, Bodies, Error, Frame, Grid, Lattice, Law, Part, Particles, Scene, Side, Simulation, implicit,
};
use std::f64::consts::PI;

mod stressed;
mod touching;
mod water;

const H: f64 = 0.5;

/// Steps of the CFL number 0.3 for waves of speed `c` (m/s).
fn settings<const D: usize>(c: f64) -> Settings<D> {
    Settings::new(courant_time_step(0.3, H, c))
}

/// The same of bodies of [`law`].
fn of_law<const D: usize>() -> Settings<D> {
    settings(law().wave_speed(DENSITY))
}

/// Tells a result and what is exact, for `docs/bodies.md`.
#[expect(clippy::print_stdout, reason = "what the page shows is read from a test's output")]
fn told(what: &str, found: f64, exact: f64) {
    println!("{what}: {found:.4e}, exact {exact:.4e}");
}

#[test]
fn bodies_of_one_material_that_stick_are_one_body() {
    // Body by body in the sums of nodes: rounding apart, one body.
    let parts = || [block(H, 2, [4, 4], [6, 8]), block(H, 2, [6, 4], [8, 8])];
    let run = |several: bool| {
        let [mut left, mut right] = parts();
        swirl(&mut left, 0.3);
        swirl(&mut right, 0.3);
        let bodies = if several {
            Bodies::new(law(), left).unwrap().and(law(), right).unwrap()
        } else {
            let places = left.position.iter().chain(&right.position).copied().collect();
            let mut all = Particles::new(places, left.volume[0], DENSITY, left.half_size).unwrap();
            swirl(&mut all, 0.3);
            Bodies::new(law(), all).unwrap()
        };
        let mut solver = Solver::<2, 3, Gimp>::new(Scene::new(open_grid(H, 12), bodies), of_law()).unwrap();
        solver.advance(100).unwrap();
        (places(&solver), solver.totals())
    };
    let ((one, of_one), (two, of_two)) = (run(false), run(true));
    for (a, b) in one.iter().zip(two) {
        assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12);
    }
    assert!((of_one.stored_energy - of_two.stored_energy).abs() < 1e-12 * of_one.stored_energy);
}

/// A stiff and a soft body beside each other, and a third that flies at them; with friction, each on its own.
fn three<T>(transfer: T, sliding: bool) -> (Scene<2>, Settings<2, T>) {
    let [mut left, mut right, mut third] =
        [block(H, 2, [3, 2], [9, 10]), block(H, 2, [9, 2], [30, 10]), block(H, 2, [12, 11], [20, 16])];
    swirl(&mut left, 0.2);
    swirl(&mut right, 0.2);
    left.velocity.iter_mut().chain(&mut right.velocity).for_each(|v| v[0] += 1.0);
    third.velocity.fill([1.5, -0.8]);
    let stiff = Hencky::new(200.0, 0.2).unwrap();
    let mut bodies = Bodies::new(law(), left).unwrap().and(stiff, right).unwrap();
    if sliding {
        bodies = bodies.sliding(0.2).unwrap();
    }
    bodies = bodies.and(law(), third).unwrap().without_remedy();
    if sliding {
        bodies = bodies.sliding(0.4).unwrap();
    }
    let scene = Scene::new(Grid::new(H, [Axis::open(0.0, 48), Axis::open(0.0, 20)]).unwrap(), bodies);
    (scene, settings(stiff.wave_speed(DENSITY)).transfer(transfer))
}

/// All that can be seen of a run. Debug writes every bit of a number.
fn seen(run: &mut dyn Simulation<2>) -> String {
    let parts = [0, 1, 2].map(|body| run.on(Part::Body(body)));
    format!("{:?}\n{parts:?}\n{:?}\n{:?}", run.totals(), run.residual(), run.particles().clone())
}

fn same_bits<const S: usize, B: Basis<S> + 'static, T: Transfer<2>>(transfer: &T, sliding: bool, form: Form) {
    let build = || {
        let (scene, mut settings) = three(transfer.clone(), sliding);
        settings.remedy = Box::new(Fbar::new(form));
        Solver::<2, S, B, T>::new(scene, settings).unwrap()
    };
    let run = |threads: usize| {
        with_threads(threads, || {
            let mut solver = build();
            solver.advance(80).unwrap();
            assert!(solver.work().sorts > 1, "the test must cover sorting");
            seen(&mut solver)
        })
    };
    let straight = run(1);
    assert_eq!(straight, run(3));
    let mut first = build();
    first.advance(37).unwrap();
    let mut second = build();
    second.restore(&first.save().unwrap()).unwrap();
    second.advance(43).unwrap();
    assert_eq!(straight, seen(&mut second));
}

#[test]
fn several_bodies_have_the_same_bits_on_any_threads_and_after_a_restart() {
    for sliding in [false, true] {
        same_bits::<3, Gimp, _>(&Flip::default(), sliding, Form::Consistent);
        same_bits::<3, QuadraticBSpline, _>(&Apic, sliding, Form::Bbar);
        same_bits::<4, CubicBSpline, _>(&Xpic::new(3).unwrap(), sliding, Form::Rate);
        same_bits::<2, Linear, _>(&Musl::default(), sliding, Form::Recursive);
    }
}

#[test]
fn several_bodies_move_the_same_seen_along_other_axes() {
    let frame = Frame::along([(1, -1.0), (0, 1.0)]);
    for sliding in [false, true] {
        let run = |seen: bool| {
            let (scene, mut settings) = three(Flip::default(), sliding);
            settings.remedy = Box::new(Fbar::new(Form::Consistent));
            let scene = if seen { scene.seen_from(&frame).unwrap() } else { scene };
            let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
            solver.advance(80).unwrap();
            let touched = solver.on(Part::Body(2)).impulse;
            (places(&solver), [touched[0], touched[1]])
        };
        let ((own, touch), (others, other_touch)) = (run(false), run(true));
        for (x, seen) in own.iter().zip(others) {
            let expected = frame.place(x);
            assert!((seen[0] - expected[0]).abs() < 1e-10 && (seen[1] - expected[1]).abs() < 1e-10);
        }
        let expected = frame.vector(&touch, 1.0);
        assert!((0..2).all(|a| (other_touch[a] - expected[a]).abs() < 1e-9), "{other_touch:?} of {expected:?}");
    }
}

#[test]
fn several_bodies_keep_momentum_and_lose_energy_to_contact_alone() {
    for sliding in [false, true] {
        for remedy in remedies::<2>() {
            let (scene, mut settings) = three(Flip::default(), sliding);
            settings.remedy = remedy;
            let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
            let before = solver.totals();
            solver.advance(150).unwrap();
            let after = solver.totals();
            for (p, q) in before.momentum.iter().zip(after.momentum) {
                assert!((p - q).abs() < 1e-11 * before.mass, "momentum {p} became {q}");
            }
            // Impulses between bodies sum to zero.
            let sum = [0, 1, 2].map(|body| solver.on(Part::Body(body)).impulse);
            for a in 0..2 {
                assert!((sum[0][a] + sum[1][a] + sum[2][a]).abs() < 1e-11 * before.mass);
            }
            assert_eq!(sliding, sum[2][1].abs() > 1e-3 * before.mass);
            // An impact is inelastic on the nodes that it meets, and never gives energy: the step's own error is below.
            let energies = [before, after].map(|t| t.kinetic_energy + t.stored_energy);
            assert!(energies[1] < energies[0] * (1.0 + 1e-3), "{energies:?}");
            assert_eq!(sliding, after.accumulated.constraint_loss > 1e-3 * before.kinetic_energy);
        }
    }
}

#[test]
fn a_remedy_averages_within_a_body_only() {
    // A soft body without volume change above one that is compressed: nothing of the strain below may come into it.
    let still = block(H, 2, [2, 4], [8, 8]);
    let squeezed = block(H, 2, [2, 2], [8, 4]).deformed(|x| {
        let f = nalgebra::SMatrix::<f64, 2, 2>::new(1.0, 0.0, 0.0, 0.98);
        ([x[0], 4.0 * H - 0.98 * (4.0 * H - x[1])], f)
    });
    let scene = || {
        let bodies = Bodies::new(law(), still.clone()).unwrap().and(law(), squeezed.clone()).unwrap();
        Scene::new(open_grid(H, 12), bodies)
    };
    type Splines = Lattice<2, 3, QuadraticBSpline>;
    let mut of_steps = implicit::Solver::<2>::new::<Splines>(scene(), implicit::Settings::new(1.0)).unwrap();
    let averaged = of_steps.field(Field::AveragedMeanStress);
    let (stress, bodies) = (&of_steps.particles().stress, &of_steps.scene().bodies);
    assert!(bodies.each[0].range().all(|k| averaged[k] == 0.0));
    // The strain is uniform, and so is its average.
    assert!(bodies.each[1].range().all(|k| (averaged[k] / stress[k].mean() - 1.0).abs() < 1e-12));
    let mut settings = of_law();
    settings.remedy = Box::new(Fbar::new(Form::Total));
    let scene = scene();
    let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
    let n = solver.particles().len();
    let mut field: Vec<f64> = (0..n).map(|p| solver.particles().jacobian[p]).collect();
    solver.average(&mut field);
    let p = solver.particles();
    for (averaged, j) in field.iter().zip(&p.jacobian) {
        assert!((averaged - j).abs() < 1e-12, "{averaged} of {j}");
    }
}

#[test]
fn a_body_without_remedy_keeps_its_own_jacobian() {
    let [mut left, mut right] = [block(H, 2, [2, 4], [5, 8]), block(H, 2, [7, 4], [10, 8])];
    swirl(&mut left, 0.3);
    swirl(&mut right, 0.3);
    let bodies = Bodies::new(law(), left).unwrap().and(law(), right).unwrap().without_remedy();
    let mut settings = of_law();
    settings.remedy = Box::new(Fbar::new(Form::Total));
    let mut solver = Solver::<2, 3, Gimp>::new(Scene::new(open_grid(H, 12), bodies), settings).unwrap();
    solver.advance(20).unwrap();
    let gaps = [0, 1].map(|body| {
        let bodies = &solver.scene().bodies;
        bodies.totals_of(bodies.each[body].range()).log_jacobian_gap_max
    });
    assert!(gaps[0] > 1e-4 && gaps[1] < 1e-12, "{gaps:?}");
}

/// A soft column beside a stiff one that it does not touch settles as it does alone: a ghost penalty of the stiffest
/// body's modulus would hold its loose rim.
#[test]
fn a_stiff_body_elsewhere_does_not_hold_a_soft_one() {
    let (h, soft) = (0.1, Hencky::new(50.0, 0.25).unwrap());
    let columns = || [[1, 5], [11, 15]].map(|[lo, hi]| block::<2>(h, 2, [lo, 0], [hi, 7]));
    let axes = || [Axis::open(0.0, 16), Axis::bounded(0.05, 12, (Side::Wall, Side::Open))];
    let lifted = |mut p: Particles<2>| {
        p.position.iter_mut().chain(&mut p.reference).for_each(|x| x[1] += 0.05);
        p
    };
    let settle = |bodies: Bodies<2>| {
        let scene = Scene::new(Grid::new(h, axes()).unwrap(), bodies)
            .load(BodyForce(Box::new(|_, _| [0.0, -0.1])))
            .constrain(Wall::new(1, End::Lo, WallKind::Fixed));
        let settings = implicit::Settings::new(1.0).stabilised(implicit::Stabilisation::Ghost(0.1));
        let mut solver = implicit::Solver::<2>::new::<Lattice<2, 3, QuadraticBSpline>>(scene, settings).unwrap();
        solver.step().unwrap();
        let field = solver.field(Field::AveragedMeanStress);
        let p = solver.particles();
        let of_soft = (0..p.len()).filter(|k| p.reference[*k][0] < 0.8);
        of_soft.map(|k| (p.id[k], p.position[k], field[k])).collect::<Vec<_>>()
    };
    let [left, right] = columns().map(lifted);
    let alone = settle(Bodies::new(soft, left.clone()).unwrap());
    let stiff = Hencky::new(5e4, 0.25).unwrap();
    let beside = settle(Bodies::new(soft, left).unwrap().and(stiff, right).unwrap());
    for ((_, a, s), (_, b, t)) in alone.iter().zip(&beside) {
        // Newton's tolerance is one of all forces.
        assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9, "{a:?} and {b:?}");
        assert!((s - t).abs() < 1e-6 * s.abs().max(1.0), "{s} and {t}");
    }
}

/// Waves in two bars of impedances Z = ρ c: amplitudes of velocity go on by 2 Z₁/(Z₁ + Z₂) and come back by
/// (Z₁ − Z₂)/(Z₁ + Z₂), energies by 1 − R² and R².
/// Returns the shares that come back and go on, and the exact ones, with this number of cells a metre.
fn sent_back(per_metre: usize) -> ([f64; 2], [f64; 2]) {
    let h = 1.0 / per_metre as f64;
    let [left, right] = [[1, 11], [11, 21]].map(|ends| {
        let [lo, hi] = ends.map(|x| x * per_metre);
        block::<1>(h, 2, [lo], [hi])
    });
    let mut heavy = right.clone();
    heavy.mass.iter_mut().for_each(|m| *m *= 3.0);
    let stiff = NeoHookean::new(300.0, 0.0).unwrap();
    let (c1, c2) = (law().wave_speed(DENSITY), stiff.wave_speed(3.0 * DENSITY));
    let (z1, z2) = (DENSITY * c1, 3.0 * DENSITY * c2);
    let reflected = (z1 - z2) / (z1 + z2);
    // A pulse that runs to the right, 1.5 m wide: v = −c ε.
    let mut start = left;
    let (middle, width, speed) = (6.0, 1.5, 1e-5);
    let pulse = |x: f64| if (x - middle).abs() < width { 0.5 * (1.0 + (PI * (x - middle) / width).cos()) } else { 0.0 };
    start.velocity = start.position.iter().map(|x| [speed * pulse(x[0])]).collect();
    let strain = |x: f64| -speed / c1 * pulse(x);
    start = start.deformed(|x| {
        // The integral of the strain up to x, of the raised cosine.
        let s = (x[0] - middle).clamp(-width, width);
        let moved = -speed / c1 * 0.5 * (s + width + width / PI * (PI * s / width).sin());
        ([x[0] + moved], nalgebra::SMatrix::from([[1.0 + strain(x[0])]]))
    });
    let end = -speed / c1 * width;
    let heavy = heavy.deformed(|x| ([x[0] + end], nalgebra::SMatrix::identity()));
    let bodies = Bodies::new(law(), start).unwrap().and(stiff, heavy).unwrap();
    let scene = Scene::new(Grid::new(h, [Axis::open(0.0, 22 * per_metre)]).unwrap(), bodies);
    let dt = courant_time_step(0.3, h, c1.max(c2));
    let mut solver = Solver::<1, 3, QuadraticBSpline>::new(scene, Settings::new(dt)).unwrap();
    let energy = |run: &Solver<1, 3, QuadraticBSpline>, body: usize| {
        let of = run.scene().bodies.totals_of(run.scene().bodies.each[body].range());
        of.kinetic_energy + of.stored_energy
    };
    let whole = energy(&solver, 0);
    assert_eq!(energy(&solver, 1), 0.0);
    // Until the pulse has passed the joint, and no end has been met.
    while solver.time() < (11.0 - middle + 2.0 * width) / c1 {
        solver.step().unwrap();
    }
    let square = reflected * reflected;
    ([0, 1].map(|body| energy(&solver, body) / whole), [square, 1.0 - square])
}

#[test]
fn a_wave_passes_from_one_material_to_another_as_its_impedance_says() {
    let errors = [5, 10, 20].map(|per_metre| {
        let ([back, through], [exact, rest]) = sent_back(per_metre);
        told(&format!("energy that a joint sends back, {per_metre} cells a metre"), back, exact);
        told("energy that goes on", through, rest);
        (back - exact).abs().max((through - rest).abs())
    });
    // Sixty cells a pulse: the scheme errs by (2π h/λ)² / 24 a wave length of some 3 m, less than a thousandth.
    assert!(errors[2] < 2e-3, "{errors:?}");
    // Second order in h and Δt at least, as in one body.
    assert!(errors[0] > 4.0 * errors[1] && errors[1] > 4.0 * errors[2], "{errors:?}");
}

/// A column of two layers at rest: every layer bears what lies on it.
#[test]
fn a_layered_column_settles_as_its_moduli_say() {
    let (h, g) = (0.1, 1e-3);
    let grid = Grid::new(h, [Axis::walls(0.0, 4), Axis::bounded(0.0, 24, (Side::Wall, Side::Open))]).unwrap();
    let [below, mut above] = [[0, 10], [10, 20]].map(|[lo, hi]| block::<2>(h, 2, [0, lo], [4, hi]));
    above.mass.iter_mut().for_each(|m| *m *= 2.0);
    let [soft, stiff] = [50.0, 500.0].map(|young| Hencky::new(young, 0.25).unwrap());
    let bodies = Bodies::new(soft, below).unwrap().and(stiff, above).unwrap();
    let mut scene = Scene::new(grid, bodies).load(BodyForce(Box::new(move |_, _| [0.0, -g])));
    for (axis, end) in [(0, End::Lo), (0, End::Hi), (1, End::Lo)] {
        scene = scene.constrain(Wall::new(axis, end, WallKind::Roller));
    }
    let mut solver =
        implicit::Solver::<2>::new::<Lattice<2, 3, QuadraticBSpline>>(scene, implicit::Settings::new(1.0)).unwrap();
    solver.step().unwrap();
    // Oedometric moduli E (1 − ν)/((1 + ν)(1 − 2ν)) = 1.2 E; weights ρ g of the layers, one metre each.
    let [m1, m2] = [60.0, 600.0];
    let [w1, w2] = [DENSITY * g, 2.0 * DENSITY * g];
    let joint = -(w2 + 0.5 * w1) / m1;
    let settled = |y: f64| match y < 1.0 {
        true => -((w2 + w1) * y - 0.5 * w1 * y * y) / m1,
        false => joint - (w2 * (y - 1.0) - 0.5 * w2 * (y - 1.0) * (y - 1.0)) / m2,
    };
    let p = solver.particles();
    let mut squares = 0.0;
    for k in 0..p.len() {
        let y = p.reference[k][1];
        squares += (p.position[k][1] - y - settled(y)).powi(2) / p.len() as f64;
    }
    // The kink at the joint lies in one cell: first order there, h/2 of the jump in strain, over a twentieth of the column.
    let jump = w2 / m1 - w2 / m2;
    told("rms error of layers that settle (m)", squares.sqrt(), 0.0);
    assert!(squares.sqrt() < 0.5 * h * jump);
    let top = p.position.iter().zip(&p.reference).map(|(x, from)| x[1] - from[1]).fold(0.0, f64::min);
    assert!((top - settled(2.0)).abs() < 0.5 * h * jump, "{top}");
}

#[test]
fn what_bodies_cannot_do_is_refused() {
    let two = || {
        let [a, b] = [block::<2>(H, 2, [2, 2], [4, 4]), block::<2>(H, 2, [4, 2], [6, 4])];
        Bodies::new(law(), a).unwrap().and(law(), b).unwrap()
    };
    let refused = |result: Result<(), Error>, what: &str| {
        let said = result.map_or_else(|e| e.to_string(), |()| String::new());
        assert!(said.contains(what), "{said}");
    };
    let coarse = block::<2>(H, 1, [4, 2], [6, 4]);
    let odd = Bodies::new(law(), block::<2>(H, 2, [2, 2], [4, 4])).unwrap().and(law(), coarse);
    refused(odd.map(drop), "half size of the particles of another body");
    refused(two().sliding(-0.1).map(drop), "friction between bodies");
    let implicit = |bodies, remedy| {
        let settings = implicit::Settings { remedy, ..implicit::Settings::new(1.0) };
        implicit::Solver::<2>::new::<Lattice<2, 3, Gimp>>(Scene::new(open_grid(H, 12), bodies), settings).map(drop)
    };
    refused(implicit(two(), implicit::Remedy::FbarConsistent), "variational F-bar");
    refused(implicit(two().sliding(0.1).unwrap(), implicit::Remedy::None), "slide");
    let grid = Grid::new(H, [Axis::periodic(0.0, 12), Axis::open(0.0, 12)]).unwrap();
    let scene = Scene::new(grid, two().sliding(0.1).unwrap());
    refused(Solver::<2, 3, Gimp>::new(scene, of_law()).map(drop), "periodic");
}

/// Water on an elastic floor: hydrostatic pressure, and a floor that gives way as its modulus says.
#[test]
fn water_stands_on_an_elastic_floor() {
    let (h, g, depth) = (0.1, 10.0, 1.0);
    let grid = Grid::new(h, [Axis::walls(0.0, 6), Axis::bounded(0.0, 24, (Side::Wall, Side::Open))]).unwrap();
    let [floor, water] = [[0, 5], [5, 15]].map(|[lo, hi]| block::<2>(h, 2, [0, lo], [6, hi]));
    let fluid = NewtonianFluid { bulk_modulus: 2e4, viscosity: 1.0 };
    let solid = Hencky::new(1e5, 0.25).unwrap();
    let bodies = Bodies::new(solid, floor).unwrap().and(fluid, water).unwrap();
    let mut scene = Scene::new(grid, bodies).load(BodyForce(Box::new(move |_, _| [0.0, -g])));
    for (axis, end) in [(0, End::Lo), (0, End::Hi), (1, End::Lo)] {
        scene = scene.constrain(Wall::new(axis, end, WallKind::Roller));
    }
    let speed = solid.wave_speed(DENSITY);
    let settings = Settings::new(courant_time_step(0.3, h, speed)).filter_forces(LocalDamping::new(0.1).unwrap());
    let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings).unwrap();
    while solver.time() < 3.0 {
        solver.step().unwrap();
    }
    let (p, bodies) = (solver.particles(), &solver.scene().bodies);
    let surface = 0.5 + depth;
    for k in bodies.each[1].range().filter(|k| (0.7..1.3).contains(&p.reference[*k][1])) {
        let exact = DENSITY * g * (surface - p.reference[k][1]);
        // Two per cent of what lies below a column, and a cell's worth of noise.
        assert!((-p.stress[k].mean() - exact).abs() < 0.1 * DENSITY * g * depth, "{} of {exact}", p.stress[k].mean());
    }
    // The top of the floor, on which the water weighs: (ρ g d y + ρ g (0.5 y − y²/2))/M.
    let modulus = 1.2e5;
    let exact = (DENSITY * g * depth * 0.5 + DENSITY * g * 0.125) / modulus;
    let top = bodies.each[0].range().filter(|k| p.reference[*k][1] > 0.45);
    let mean: Vec<f64> = top.map(|k| p.reference[k][1] - p.position[k][1]).collect();
    let mean = mean.iter().sum::<f64>() / mean.len() as f64;
    told("floor below water gives way by (m)", mean, exact);
    assert!((mean / exact - 1.0).abs() < 0.1, "{mean} of {exact}");
}
