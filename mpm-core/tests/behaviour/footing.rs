//! A rough strip footing on clay, through the barrier.

use mpm_core::basis::Gimp;
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::explicit::remedy::{Fbar, Form};
use mpm_core::explicit::{Settings, Solver, contact_cfl};
use mpm_core::material::{HenckyJ2, Law, Strength};
use mpm_core::stage::{Amplitude, End, Wall, WallKind};
use mpm_core::{Axis, Bodies, Grid, Part, Particles, Scene, Side, Simulation};
use std::f64::consts::PI;

const H: f64 = 0.05;
const HALF_WIDTH: f64 = 0.5;
const CELLS: [usize; 2] = [30, 15];
const DENSITY: f64 = 1000.0;
const STRENGTH: f64 = 100.0;
const DT: f64 = 1.5e-4;
const SPEED: f64 = 1e-3;
const RAMP: f64 = 0.3;
/// Pressure (Pa) that the barrier is made for: a little more than (2 + π) s_u.
const PRESSURE: f64 = 550.0;
const DISTANCE: f64 = 0.25 * H;
/// Share of d̂ by which the barrier gives way under that pressure.
const LOSS: f64 = 0.002;

fn footing(per_cell: usize) -> (RigidFace<2>, Barrier, Solver<2, 3, Gimp>) {
    let law = HenckyJ2::new(1e6, 0.49, Strength::undrained(STRENGTH).unwrap()).unwrap();
    let spacing = H / per_cell as f64;
    let rows = CELLS[1] * per_cell;
    let positions =
        (0..CELLS[0] * per_cell * rows).map(|k| [k / rows, k % rows].map(|i| (i as f64 + 0.5) * spacing)).collect();
    let particles = Particles::new(positions, spacing * spacing, DENSITY, [0.5 * spacing; 2]).unwrap();
    let barrier = Barrier::carrying_at(PRESSURE * spacing, (1.0 - LOSS) * DISTANCE, DISTANCE).unwrap();
    let stick = barrier.stiffness((1.0 - LOSS) * DISTANCE);
    let face = RigidFace::half_space(1, End::Hi, 0.0)
        .unwrap()
        .within([[0.0, HALF_WIDTH], [0.0; 2]])
        .touching(&particles, DISTANCE)
        .moving([0.0, -SPEED], Amplitude::Rise(RAMP))
        .unwrap();
    // The contact hardly shortens the step, even under four times the pressure.
    let wave = law.wave_speed(DENSITY) * DT / H;
    let stiffest = barrier.stiffness(barrier.gap(4.0 * PRESSURE * spacing));
    let ratio = stiffest / particles.mass[0];
    assert!(contact_cfl(wave, ratio, DT) < 1.15 * wave);
    let friction = Friction::rough(stick).unwrap();
    let upright = Axis::bounded(0.0, CELLS[1] + 3, (Side::Wall, Side::Open));
    let wall = |axis, end, kind| Wall::new(axis, end, kind);
    let grid = Grid::new(H, [Axis::walls(0.0, CELLS[0]), upright]).unwrap();
    let scene = Scene::new(grid, Bodies::new(law, particles).unwrap())
        .constrain(wall(1, End::Lo, WallKind::Fixed))
        .constrain(wall(0, End::Lo, WallKind::Roller))
        .constrain(wall(0, End::Hi, WallKind::Roller))
        .contact(RigidContact::new(face.clone(), barrier).with_friction(friction));
    let settings = Settings::new(DT).remedy(Box::new(Fbar::new(Form::Rate)));
    (face, barrier, Solver::new(scene, settings).unwrap())
}

/// Gaps of the uppermost particles under the footing (m), and how far they have moved along it at most (m).
fn under(face: &RigidFace<2>, solver: &dyn Simulation<2>, per_cell: usize) -> (Vec<f64>, f64) {
    let (p, moved) = (solver.particles(), face.displacement(solver.time()));
    let top = CELLS[1] as f64 * H - H / per_cell as f64;
    let (mut gaps, mut slip) = (Vec::new(), 0.0_f64);
    for (x, reference) in p.position.iter().zip(&p.reference) {
        if reference[1] > top && reference[0] < HALF_WIDTH {
            let now = std::array::from_fn(|a| x[a] - moved[a]);
            gaps.push(face.gap(&now).unwrap());
            slip = slip.max((x[0] - reference[0]).abs());
        }
    }
    (gaps, slip)
}

/// The clay yields under the footing: Prandtl's pressure is (2 + π) s_u, and a coarse grid is above it, by less than a
/// tenth. Since the force of the barrier is convex, the mean gap is at least that of the mean force; it is known from
/// the reaction to a tenth of the loss. The rough contact does not slide: by less than a hundredth of the footing's
/// stroke.
#[test]
fn a_rough_footing_sinks_into_clay_with_a_known_loss() {
    let (face, barrier, mut solver) = footing(2);
    let mut slips = [0.0; 2];
    for (slip, until) in slips.iter_mut().zip([0.45, 0.6]) {
        while solver.time() < until {
            solver.step().unwrap();
        }
        let (gaps, now) = under(&face, &solver, 2);
        *slip = now;
        assert!(gaps.iter().all(|&gap| gap > 0.99 * DISTANCE && gap < DISTANCE));
        let reaction = solver.on(Part::Contact(0)).force[1];
        let known = barrier.gap(reaction / gaps.len() as f64);
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        assert!(mean >= known && mean - known < 0.1 * (DISTANCE - known), "{mean} {known}");
        let pressure = reaction / HALF_WIDTH / STRENGTH / (2.0 + PI);
        assert!((1.0..1.1).contains(&pressure), "{pressure}");
    }
    assert!((slips[1] - slips[0]).abs() < 0.01 * SPEED * 0.15, "{slips:?}");
}

/// Four particles per cell and direction: the second layer is at the distance d̂ from the first, so the face touches
/// one layer only.
#[test]
fn a_footing_on_small_particles_touches_one_layer() {
    let (face, _, mut solver) = footing(4);
    while solver.time() < 0.12 {
        solver.step().unwrap();
    }
    let (gaps, _) = under(&face, &solver, 4);
    let touched = (solver.particles().external_force.iter()).filter(|f| f[1] < 0.0);
    assert_eq!(touched.count(), gaps.len());
}
