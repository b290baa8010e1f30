//! Loads on free sides, and factors over time.

use crate::scenes::{DENSITY, block, law};
use mpm_core::basis::Gimp;
use mpm_core::frame::Frame;
use mpm_core::implicit;
use mpm_core::stage::{Amplitude, Dashpots, DeadForce, End, Load, Pressure, Wall, WallKind};
use mpm_core::{Axis, Bodies, Grid, Lattice, Particles, Scene, Simulation};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

const H: f64 = 0.5;

/// Sum of the external forces (N) of a load at a time (s), and how many particles feel it.
fn sum<const D: usize>(load: &dyn Load<D>, time: f64, particles: &mut Particles<D>) -> ([f64; D], usize) {
    particles.external_force.fill([0.0; D]);
    load.add(time, particles);
    let felt = particles.external_force.iter().filter(|force| **force != [0.0; D]).count();
    (std::array::from_fn(|a| particles.external_force.iter().map(|force| force[a]).sum()), felt)
}

/// An L of 4 by 2 and 2 by 2 cells: its upper sides are 2 and 2 cells long, at two heights, its right ones 2 each.
fn bent() -> Particles<2> {
    let [low, high] = [block(H, 2, [0, 0], [4, 2]), block(H, 2, [0, 2], [2, 4])];
    let places = [low.position, high.position].concat();
    Particles::new(places, low.reference_volume[0], DENSITY, low.half_size).unwrap()
}

#[test]
fn a_traction_acts_on_what_nothing_covers() {
    let mut particles = bent();
    for (side, length) in [((1, End::Hi), 2.0), ((1, End::Lo), 2.0), ((0, End::Hi), 2.0), ((0, End::Lo), 2.0)] {
        let load = DeadForce::traction([3.0, -5.0], Amplitude::Rise(0.0), &particles, side, |_| true);
        let (force, felt) = sum(&load, 0.0, &mut particles);
        for (force, exact) in force.iter().zip([3.0 * length, -5.0 * length]) {
            assert!((force - exact).abs() < 1e-12, "{side:?}: {force}");
        }
        assert_eq!((load.total(), felt), ([3.0 * length, -5.0 * length], load.count()));
        // Its moment is that of the side: the force acts at its height.
        let at = |place: f64| {
            particles
                .position
                .iter()
                .zip(&particles.external_force)
                .map(|(x, f)| (x[side.0] - place) * f[0])
                .sum::<f64>()
        };
        let heights: f64 = match side.1 {
            End::Lo => 0.0,
            End::Hi => 0.5 * (1.0 + 2.0),
        };
        assert!(at(heights).abs() < 1e-12, "{side:?}: {}", at(heights));
    }
    // The step in the middle is covered by what stands on it.
    let low = DeadForce::traction([0.0, 1.0], Amplitude::Rise(0.0), &particles, (1, End::Hi), |x| x[1] < 1.0);
    assert!((low.total()[1] - 1.0).abs() < 1e-12 && low.count() == 8);
    // A layer of one particle has none behind.
    let mut thin = Particles::new(vec![[0.25, 0.25]], 0.25, DENSITY, [0.25; 2]).unwrap();
    let load = DeadForce::traction([0.0, 2.0], Amplitude::Rise(0.0), &thin, (1, End::Hi), |_| true);
    assert_eq!(sum(&load, 0.0, &mut thin), ([0.0, 1.0], 1));
}

#[test]
fn dashpots_oppose_what_leaves_and_push_what_comes() {
    let mut particles = block(H, 2, [0, 0], [2, 2]);
    particles.velocity.fill([0.1, 0.2]);
    let amplitude = Amplitude::table(&[[0.0, 0.0], [1.0, 1.0]]).unwrap();
    let dashpots = Dashpots::new(|_| [7.0, 4.0], ([0.5, 1.0], amplitude), &particles, (1, End::Lo), |_| true);
    assert_eq!(dashpots.count(), 4);
    for (time, exact) in [(0.0, [-0.4, -1.4]), (0.5, [1.6, 5.6])] {
        let (force, _) = sum(&dashpots, time, &mut particles);
        assert!(force.iter().zip(exact).all(|(force, exact)| (force - exact).abs() < 1e-12), "{force:?}");
    }
}

/// Sorted, turned and in other units, particles feel the same.
#[test]
fn loads_on_sides_are_the_same_from_elsewhere() {
    let mut own = bent();
    own.velocity.iter_mut().zip(&own.position).for_each(|(v, x)| *v = [0.1 * x[1], -0.2 * x[0]]);
    let amplitude = || Amplitude::Rise(2.0);
    let traction = DeadForce::traction([3.0, -5.0], amplitude(), &own, (1, End::Hi), |_| true);
    let dashpots = Dashpots::new(|_| [7.0, 4.0], ([0.5, 1.0], amplitude()), &own, (0, End::Hi), |_| true);
    let frame = Frame::along([(1, -1.0), (0, 1.0)]).in_units(1e3, 1e-6);
    let [side, corner] = [(1, End::Hi), (0, End::Lo)];
    let pressure = Pressure::new(3.0, amplitude(), &own, side, |_| true);
    let other = Pressure::new(3.0, amplitude(), &own, corner, |x| x[1] < 0.3);
    own.position.iter_mut().for_each(|x| *x = [1.5 * x[0] + 0.3 * x[1] * x[1], 0.8 * x[1] - 0.2 * x[0]]);
    let loads: [Box<dyn Load<2>>; 4] = [Box::new(traction), Box::new(dashpots), Box::new(pressure), Box::new(other)];
    for load in loads {
        own.external_force.fill([0.0; 2]);
        let mut seen = own.seen_from(&frame);
        let order: Vec<u32> = (0..own.len() as u32).rev().collect();
        seen.permute(&order);
        load.add(1.0, &mut own);
        load.seen_from(&frame).add(1.0, &mut seen);
        for (k, force) in seen.external_force.iter().enumerate() {
            let exact = frame.vector(&own.external_force[seen.id[k] as usize], frame.force());
            assert!((0..2).all(|a| (force[a] - exact[a]).abs() < 1e-12 * frame.force()), "{force:?} {exact:?}");
        }
    }
}

/// Force of a pressure on a side that was turned by 60° and stretched: normal to it, and of its area now.
#[test]
fn a_pressure_goes_with_its_sides() {
    let turned = Matrix2::new(0.5, -0.75_f64.sqrt(), 0.75_f64.sqrt(), 0.5) * Matrix2::new(1.5, 0.3, 0.0, 0.8);
    for (side, normal) in [
        ((0, End::Lo), [-1.0, 0.0]),
        ((0, End::Hi), [1.0, 0.0]),
        ((1, End::Lo), [0.0, -1.0]),
        ((1, End::Hi), [0.0, 1.0]),
    ] {
        let mut particles = bent();
        let load = Pressure::new(3.0, Amplitude::Rise(0.0), &particles, side, |_| true);
        particles.position.iter_mut().for_each(|x| *x = (turned * Vector2::from(*x)).into());
        let (force, felt) = sum(&load, 0.0, &mut particles);
        // Nanson's formula: 2 m of J F⁻ᵀ n.
        let area = turned.try_inverse().unwrap().transpose() * Vector2::from(normal) * (2.0 * turned.determinant());
        assert!((Vector2::from(force) + area * 3.0).norm() < 1e-12, "{side:?}: {force:?}");
        assert_eq!((load.count(), felt), (8, 16));
    }
    let mut block = block::<3>(H, 2, [0; 3], [2, 3, 2]);
    let load = Pressure::new(3.0, Amplitude::Rise(0.0), &block, (2, End::Hi), |_| true);
    let turned = Matrix3::new(1.2, 0.3, -0.1, 0.2, 0.9, 0.4, -0.3, 0.1, 1.1);
    block.position.iter_mut().for_each(|x| *x = (turned * Vector3::from(*x)).into());
    let (force, _) = sum(&load, 0.0, &mut block);
    let area = turned.try_inverse().unwrap().transpose() * Vector3::z() * (1.0 * 1.5 * turned.determinant());
    assert!((Vector3::from(force) + area * 3.0).norm() < 1e-12, "{force:?}");
    // A particle alone has the side that it began with.
    let mut one = Particles::new(vec![[0.25, 0.25]], 0.25, DENSITY, [0.25; 2]).unwrap();
    let load = Pressure::new(2.0, Amplitude::Rise(0.0), &one, (1, End::Hi), |_| true);
    assert_eq!(sum(&load, 0.0, &mut one), ([0.0, -1.0], 1));
}

/// Pressed on two sides to a twentieth of its modulus, a block has that pressure as Cauchy's stress, in the mean and up to the
/// square of its strain, by which domains that keep their size overlap. Under a dead load it has more, by the strain.
#[test]
fn a_body_under_a_pressure_has_it_at_any_strain() {
    let pressed = |follows: bool| {
        let pressure = 5.0;
        let grid = Grid::new(H, [Axis::walls(0.0, 6); 2]).unwrap();
        let particles = block(H, 2, [0, 0], [4, 4]);
        let mut scene = Scene::new(grid, Bodies::new(law(), particles).unwrap())
            .constrain_all([0, 1].map(|axis| Wall::new(axis, End::Lo, WallKind::Roller)));
        for axis in [0, 1] {
            let (p, side) = (&scene.bodies.particles, (axis, End::Hi));
            let dead = std::array::from_fn(|a| if a == axis { -pressure } else { 0.0 });
            scene = match follows {
                true => {
                    let load = Pressure::new(pressure, Amplitude::Rise(1.0), p, side, |_| true);
                    scene.load(load)
                }
                false => {
                    let load = DeadForce::traction(dead, Amplitude::Rise(1.0), p, side, |_| true);
                    scene.load(load)
                }
            };
        }
        let mut solver = implicit::Solver::new::<Lattice<2, 3, Gimp>>(scene, implicit::Settings::new(0.1)).unwrap();
        solver.advance(20).unwrap();
        let stress = &solver.particles().stress;
        let off = stress.iter().map(|s| 0.5 * (s.xx + s.yy) / -pressure - 1.0);
        off.sum::<f64>() / stress.len() as f64
    };
    let strain = 0.05_f64;
    assert!(pressed(true).abs() < strain * strain, "{}", pressed(true));
    assert!(pressed(false) > 0.5 * strain, "{}", pressed(false));
}

/// A triangle, then its mirror: 0 at 1 s, 2 at 3 s, −2 at 5 s, −1 at 6 s and after.
fn back_and_forth() -> Amplitude {
    Amplitude::table(&[[1.0, 0.0], [3.0, 2.0], [5.0, -2.0], [6.0, -1.0]]).unwrap()
}

#[test]
fn a_table_is_linear_and_its_integral_exact() {
    let table = back_and_forth();
    for (time, factor, integral) in
        [(0.5, 0.0, 0.0), (2.0, 1.0, 0.5), (3.0, 2.0, 2.0), (4.0, 0.0, 3.0), (5.0, -2.0, 2.0), (8.0, -1.0, -1.5)]
    {
        assert_eq!((table.at(time), table.integral(time)), (factor, integral), "{time}");
    }
    assert_eq!([3.5, 4.5, 6.0, 12.0].map(|time| table.farthest(time)), [2.75, 3.0, 3.0, 5.5]);
    let constant = Amplitude::table(&[[2.0, 3.0]]).unwrap();
    assert_eq!((constant.at(0.5), constant.integral(1.0), constant.integral(4.0)), (3.0, 3.0, 12.0));
}

#[test]
fn a_rise_is_smooth_and_its_integral_exact() {
    let rise = Amplitude::Rise(2.0);
    assert_eq!([0.0, 1.0, 2.0, 9.0].map(|time| rise.at(time)), [0.0, 0.5, 1.0, 1.0]);
    assert_eq!([-1.0, 0.0, 1.0, 2.0, 5.0].map(|time| rise.integral(time)), [0.0, 0.0, 0.1875, 1.0, 4.0]);
    assert_eq!((Amplitude::Rise(0.0).at(0.0), rise.farthest(5.0)), (1.0, 4.0));
}

#[test]
fn tables_that_go_back_in_time_are_refused() {
    for knots in [&[][..], &[[-1.0, 0.0]], &[[1.0, 0.0], [1.0, 1.0]], &[[0.0, f64::NAN]], &[[f64::INFINITY, 0.0]]] {
        assert!(Amplitude::table(knots).is_err(), "{knots:?}");
    }
}
