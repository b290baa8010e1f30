use super::contact::rubber;
use super::*;
use crate::Cause;
use crate::material::{HenckyJ2, Strength};

fn cause_of(scene: Scene<2>, settings: Settings) -> Cause {
    Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap().cause(false)
}

#[test]
fn a_body_that_is_held_is_sound() {
    let scene = standing::<2, _>(4, rubber(), 1.0);
    let cause = cause_of(scene, Settings::new(1.0).stabilised(Stabilisation::Ghost(GHOST)));
    assert!(matches!(cause, Cause::Sound(share) if share > 0.5 && share < 1.5), "{cause:?}");
}

#[test]
fn a_hair_is_told_from_the_body() {
    let cause = cause_of(with_a_loner(), Settings::new(1.0));
    let Cause::Rim(at, seen) = cause else { panic!("{cause:?}") };
    assert!(at[0] > H * (CELLS as f64) && at[2].is_nan() && seen < 0.1, "{cause:?}");
    let text = cause.to_string();
    assert!(text.contains("raise the ghost penalty") && !text.contains("NaN"), "{text}");
}

#[test]
fn a_body_that_nothing_holds_is_loose() {
    let scene = filled([Axis::open(0.0, CELLS + 4); 2], CELLS, rubber());
    let cause = cause_of(scene, Settings::new(1.0).stabilised(Stabilisation::Ghost(GHOST)));
    assert!(matches!(cause, Cause::Loose(_, share) if share == 1.0), "{cause:?}");
    assert!(cause.to_string().contains("add a support"));
}

/// The upper half has moved away by three cells.
#[test]
fn a_part_that_has_come_off_is_named() {
    let axes = [Axis::walls(0.0, 4), Axis::bounded(0.0, 9, (Side::Wall, Side::Open))];
    let mut scene = filled(axes, 4, rubber());
    for x in scene.bodies.particles.position.iter_mut().filter(|x| x[1] > 2.0 * H) {
        x[1] += 3.0 * H;
    }
    let scene =
        scene.constrain(Wall::new(1, End::Lo, WallKind::Fixed)).constrain(Wall::new(0, End::Lo, WallKind::Roller));
    let cause = cause_of(scene, Settings::new(1.0).stabilised(Stabilisation::Ghost(GHOST)));
    let Cause::Loose(at, share) = cause else { panic!("{cause:?}") };
    assert!((share - 0.5).abs() < 1e-9 && (at[1] - 6.0 * H).abs() < 1e-9, "{cause:?}");
    assert!(cause.to_string().contains("50.000 % of the body"));
}

/// A layer on a fixed base under a load along it of up to twice its strength: simple shear changes no geometry.
#[test]
fn a_body_at_its_limit_load_gives_way() {
    let law = HenckyJ2::new(YOUNG, POISSON, Strength::undrained(1e-3 * YOUNG).unwrap()).unwrap();
    let axes = [Axis::periodic(0.0, CELLS), Axis::bounded(0.0, CELLS + 2, (Side::Wall, Side::Open))];
    let limit = 1e-3 * YOUNG / (CELLS as f64 * H * 1000.0);
    let scene = filled(axes, CELLS, law)
        .constrain(Wall::new(1, End::Lo, WallKind::Fixed))
        .load(BodyForce(Box::new(move |_, t| [limit * t, 0.0])));
    let settings = Settings::new(0.1).stabilised(Stabilisation::Ghost(GHOST));
    let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
    let error = (0..20).find_map(|_| solver.step().err()).unwrap();
    let Error::NoConvergence { time, cause, .. } = error else { panic!("{error}") };
    assert!(time > 1.0 && time < 1.1, "{error}");
    assert!(matches!(cause, Cause::GivesWay(_, share) if share < 0.05), "{cause:?}");
    assert!(cause.to_string().contains("at its limit"));
}
