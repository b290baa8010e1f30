//! One run goes on with the body of another: what is excavated is gone, and what rests begins to move.

use super::contact::floor;
use super::dynamics::{NEWMARK, rubber};
use super::*;
use crate::scenes::{block, places};
use mpm_core::Saved;
use mpm_core::stage::Gravity;

const MIDPOINT: TimeRule = TimeRule::Midpoint { lumped: 0.1 };

/// A block between rollers, on a floor if there is one, of `rows` rows of particles.
fn pile(rows: usize, rule: TimeRule, lies: bool) -> Solver<2> {
    let grid = Grid::new(H, [Axis::walls(0.0, CELLS), Axis::open(-2.0 * H, CELLS + 4)]).unwrap();
    let places = block(0.5 * H, 1, [0; 2], [2 * CELLS, rows]).position;
    let particles = Particles::new(places, 0.25 * H * H, 1000.0, [0.25 * H; 2]).unwrap();
    let contact = floor(&particles, 0.1 * H, 125.0);
    let rollers = [End::Lo, End::Hi].map(|end| Wall::new(0, end, WallKind::Roller));
    let scene = Scene::new(grid, Bodies::new(rubber(), particles).unwrap())
        .constrain_all(rollers)
        .load(Gravity(Box::new(|_| [0.0, -1.0])));
    let scene = if lies { scene.contact(contact) } else { scene };
    let settings = Settings::new(1.0).rule(rule).stabilised(Stabilisation::Ghost(0.01));
    Solver::new::<Means<2>>(scene, settings).unwrap()
}

/// Weight (N/m) of the pile.
fn weight(pile: &Solver<2>) -> f64 {
    pile.totals().mass
}

#[test]
fn what_is_excavated_is_gone_and_the_rest_stays_as_it_was() {
    let mut whole = pile(8, TimeRule::Static, true);
    whole.step().unwrap();
    let mut cut = pile(5, TimeRule::Static, true);
    cut.take_over(&whole.body().unwrap()).unwrap();
    let [all, kept] = [whole.particles(), cut.particles()];
    assert_eq!(kept.len(), 40);
    let stress = all.seeded(|k| all.stress[k]);
    assert_eq!(kept.seeded(|k| kept.stress[k]), stress[..40]);
    assert_eq!(kept.seeded(|k| kept.position[k]), all.seeded(|k| all.position[k])[..40]);
    cut.step().unwrap();
    let force = cut.on(Part::Contact(0)).force[1];
    assert!((force / weight(&cut) + 1.0).abs() < 1e-8, "{force}");
    assert!((weight(&cut) / weight(&whole) - 5.0 / 8.0).abs() < 1e-12);
}

/// Missing particles cannot be handed over.
#[test]
fn a_body_of_fewer_particles_is_refused() {
    let few = pile(5, TimeRule::Static, true);
    let mut many = pile(8, TimeRule::Static, true);
    let error = many.take_over(&few.body().unwrap()).unwrap_err();
    assert!(error.to_string().contains("40 in the saved state, 64"), "{error}");
    let hand_over = Saved::of(&(few.scene().bodies.save().unwrap(), 7_u8)).unwrap();
    assert!(many.take_over(&hand_over).is_err());
}

/// Newmark's accelerations are those of the forces in the new scene: without its floor a pile falls.
#[test]
fn accelerations_are_those_of_the_new_scene() {
    let mut lying = pile(8, TimeRule::Static, true);
    lying.step().unwrap();
    let mut falling = pile(8, NEWMARK, false);
    falling.take_over(&lying.body().unwrap()).unwrap();
    let p = falling.particles();
    assert!(p.velocity.iter().all(|v| *v == [0.0; 2]));
    let pairs = p.acceleration.iter().zip(&p.mass);
    let force: f64 = pairs.map(|(a, m)| a[1] * m).sum();
    assert!((force / weight(&falling) + 1.0).abs() < 1e-10, "{force}");
    // And a rule that keeps none forgets them.
    let mut resting = pile(8, TimeRule::Static, true);
    resting.take_over(&falling.body().unwrap()).unwrap();
    let p = resting.particles();
    assert!(p.velocity.is_empty() && p.acceleration.is_empty());
    resting.step().unwrap();
}

/// Clay of the length L = 1 m between a symmetry plane and a free face, which hangs on a smooth plate: gravity is
/// upward.
fn hanging(strength: f64, rule: TimeRule, dt: f64) -> Solver<2> {
    let law = HenckyJ2::new(YOUNG, POISSON, Strength::undrained(strength).unwrap()).unwrap();
    let axes = [Axis::bounded(0.0, CELLS + 4, (Side::Wall, Side::Open)); 2];
    let rollers = [0, 1].map(|axis| Wall::new(axis, End::Lo, WallKind::Roller));
    let rises = rule == TimeRule::Static;
    let gravity = move |time: f64| [0.0, if rises { time } else { 1.0 }];
    let scene = filled(axes, CELLS, Places::Uniform, law).constrain_all(rollers).load(Gravity(Box::new(gravity)));
    let settings = Settings::new(dt).rule(rule).stabilised(Stabilisation::Ghost(0.01));
    Solver::new::<Means<2>>(scene, settings).unwrap()
}

/// Columns that hang alone, σ_y = γ (L − y), bound the share of γ that can be carried by 2c/(γL) from below, and clay
/// that is stretched as a whole by 4c/(γL) from above: its field of velocities is in every space, and what is stretched
/// is thinner. Beyond, the error says so, and the state is the last equilibrium. Clay that flows is driven by a
/// constant force: at twice the time its energy is four times as large; half of that is asked. That of clay which holds
/// would swing.
#[test]
fn clay_beyond_its_strength_is_told_and_moves_on_from_its_last_equilibrium() {
    let strength = 150.0;
    let mut still = hanging(strength, TimeRule::Static, 1.0);
    let error = still.step().unwrap_err();
    assert!(error.to_string().contains("no equilibrium found beyond"), "{error}");
    let (carried, mass) = (still.time(), still.totals().mass);
    let share = carried * 1000.0 / strength;
    assert!(2.0 * 0.99 < share && share < 4.0 * 1.01, "{share}");
    let force = still.on(Part::Constraint(1)).force[1];
    assert!((force / (mass * carried) - 1.0).abs() < 1e-8, "{force}");
    let mut moving = hanging(strength, MIDPOINT, 0.01);
    moving.take_over(&still.body().unwrap()).unwrap();
    assert_eq!(places(&moving), places(&still));
    let mut energy = || {
        moving.advance(20).unwrap();
        moving.totals().kinetic_energy
    };
    let [early, late] = [energy(), energy()];
    assert!(late > 2.0 * early, "{early} {late}");
    // Clay that is strong enough for columns holds.
    let mut strong = hanging(510.0, TimeRule::Static, 1.0);
    strong.step().unwrap();
}
