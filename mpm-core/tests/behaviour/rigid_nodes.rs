//! A body pressed by nodes that move with a rigid one.

use crate::scenes::{block, law, scene};
use mpm_core::basis::{Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::Solver;
use mpm_core::stage::{Amplitude, Constraint, End, MovingNodes, RigidNodes, Wall, WallKind};
use mpm_core::{Axis, Basis, Grid, Part, Side, Simulation};

const H: f64 = 0.5;
const CELLS: usize = 8;
const HEIGHT: f64 = 6.0 * H;
/// Speed of the press (m/s), a hundred-thousandth of that of sound.
const SPEED: f64 = 1e-4;
/// Time (s) in which it starts.
const RAMP: f64 = 6.0;

/// A block six cells high and eight wide, on rollers at the sides, on a roller or fixed at the base, under
/// `press`.
fn pressed<const S: usize, B: Basis<S> + 'static>(base: WallKind, press: RigidNodes<2>) -> Solver<2, S, B> {
    let upright = Axis::bounded(0.0, CELLS, (Side::Wall, Side::Open));
    let grid = Grid::new(H, [Axis::walls(0.0, CELLS), upright]).unwrap();
    let (scene, settings) = scene(grid, block(H, 2, [0, 0], [CELLS, 6]));
    let scene = scene
        .constrain(Wall::new(1, End::Lo, base))
        .constrain(Wall::new(0, End::Lo, WallKind::Roller))
        .constrain(Wall::new(0, End::Hi, WallKind::Roller))
        .constrain(press);
    Solver::new(scene, settings).unwrap()
}

/// A press on the whole top, from half a cell below it for splines, whose functions there are not
/// interpolatory.
fn press(velocity: [Option<f64>; 2]) -> RigidNodes<2> {
    RigidNodes {
        extent: [[f64::NEG_INFINITY, f64::INFINITY], [HEIGHT - 0.5 * H, f64::INFINITY]],
        velocity,
        amplitude: Amplitude::Rise(RAMP),
    }
}

/// Force on the press over that of the law in uniaxial compression by the stroke, and on the base over it.
fn force_over_that_of_the_law<const S: usize, B: Basis<S> + 'static>() -> [f64; 2] {
    let mut solver = pressed::<S, B>(WallKind::Roller, press([None, Some(-SPEED)]));
    let (end, mut sums, mut count) = (60.0, [0.0; 2], 0.0);
    while solver.time() < end {
        solver.step().unwrap();
        if solver.time() > 0.8 * end {
            sums[0] += solver.on(Part::Constraint(3)).force[1];
            sums[1] -= solver.on(Part::Constraint(0)).force[1];
            count += 1.0;
        }
    }
    let stretch = 1.0 - SPEED * (0.9 * end - 0.5 * RAMP) / HEIGHT;
    let law = law();
    let stress = (law.mu * (stretch * stretch - 1.0) + law.lambda * stretch.ln()) / stretch;
    sums.map(|sum| sum / count / (-stress * CELLS as f64 * H))
}

/// The waves of the start, a ramp of eight periods, leave less than half a percent; the stroke is a hundredth of a
/// cell, a strain of two per mille. Splines whose functions around the surface move as one are rigid down to
/// somewhere in the last half cell.
#[test]
fn a_press_meets_the_force_of_the_law() {
    for ratios in [force_over_that_of_the_law::<2, Linear>(), force_over_that_of_the_law::<3, Gimp>()] {
        assert!(ratios.iter().all(|r| (r - 1.0).abs() < 0.005), "{ratios:?}");
    }
    let ratios = force_over_that_of_the_law::<3, QuadraticBSpline>();
    let stiffest = HEIGHT / (HEIGHT - 0.5 * H);
    assert!(ratios.iter().all(|r| (1.0..stiffest).contains(r)), "{ratios:?}");
}

#[test]
fn a_constraint_that_does_not_exist_has_no_force() {
    let solver = pressed::<3, Gimp>(WallKind::Roller, press([None, Some(-SPEED)]));
    assert!(solver.on(Part::Constraint(9)).force[0].is_nan());
}

/// A narrow press on a fixed body: a rough one holds the material under it, a smooth one does not; nodes beside it
/// are free.
#[test]
fn a_rough_press_holds_and_a_smooth_one_lets_slide() {
    let narrow =
        |across| RigidNodes { extent: [[0.0, 2.0 * H], [HEIGHT, f64::INFINITY]], ..press([across, Some(-SPEED)]) };
    let slipped = |across| {
        let mut solver = pressed::<3, Gimp>(WallKind::Fixed, narrow(across));
        while solver.time() < 30.0 {
            solver.step().unwrap();
        }
        let p = solver.particles();
        let under: Vec<usize> =
            (0..p.len()).filter(|&k| p.reference[k][1] > HEIGHT - 0.5 * H && p.reference[k][0] < 1.5 * H).collect();
        let most = |f: &dyn Fn(usize) -> f64| under.iter().map(|&k| f(k).abs()).fold(0.0, f64::max);
        let stroke = SPEED * (30.0 - 0.5 * RAMP);
        let down = most(&|k| p.position[k][1] - p.reference[k][1]) / stroke;
        assert!((0.9..1.05).contains(&down), "{down}");
        let beside = (0..p.len()).filter(|&k| p.reference[k][0] > 6.0 * H);
        let sunk = beside.map(|k| p.reference[k][1] - p.position[k][1]).fold(0.0, f64::max);
        assert!(sunk < 0.5 * stroke, "{sunk}");
        most(&|k| p.position[k][0] - p.reference[k][0]) / stroke
    };
    let (rough, smooth) = (slipped(Some(0.0)), slipped(None));
    assert!(rough < 0.5 * smooth, "{rough} {smooth}");
}

/// The stroke is the integral of the ramp: the uppermost particles, 0.125 m below the top of 3 m,
/// have made 23/24 of it. A press that started at once would be 30 % ahead after twice the ramp.
#[test]
fn the_ramp_is_followed() {
    let mut solver = pressed::<3, Gimp>(WallKind::Roller, press([None, Some(-SPEED)]));
    while solver.time() < 2.0 * RAMP {
        solver.step().unwrap();
    }
    let p = solver.particles();
    let sunk =
        (0..p.len()).filter(|&k| p.reference[k][1] > HEIGHT - 0.4 * H).map(|k| p.reference[k][1] - p.position[k][1]);
    let stroke = SPEED * (solver.time() - 0.5 * RAMP);
    for sunk in sunk {
        let share = sunk / stroke * 24.0 / 23.0;
        assert!((share - 1.0).abs() < 0.03, "{share}");
    }
}

#[test]
fn a_box_that_moves_goes_on_to_the_nodes_nearest_to_where_it_went() {
    let grid = Grid::new(0.5, [Axis::open(0.0, 8); 2]).unwrap();
    let nodes =
        RigidNodes { extent: [[1.0, 1.2], [0.0, 4.0]], velocity: [Some(-1.0), None], amplitude: Amplitude::Rise(0.0) };
    for (time, cells) in [(0.0, 0.0), (0.24, 0.0), (0.26, -1.0), (0.74, -1.0), (0.76, -2.0)] {
        let shift = |from: f64| MovingNodes { nodes: nodes.clone(), from: [from, 0.0] }.shift(&grid, time);
        assert_eq!((shift(0.0), shift(1.0)), ([cells, 0.0], [cells + 2.0, 0.0]), "{time}");
    }
}
