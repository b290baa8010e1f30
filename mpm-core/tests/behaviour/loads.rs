//! Loads on free sides, and factors over time.

use crate::scenes::{DENSITY, block};
use mpm_core::Particles;
use mpm_core::frame::Frame;
use mpm_core::stage::{Amplitude, Dashpots, DeadForce, End, Load};

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
    let loads: [Box<dyn Load<2>>; 2] = [Box::new(traction), Box::new(dashpots)];
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
