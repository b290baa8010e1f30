//! Loads that miss a part, and unknowns that a plate ties.

use super::*;

/// A load with a missing part is refused: here the part of a side that the face has and the body lacks.
#[test]
fn the_sum_of_a_load_is_checked_in_every_step() {
    let settings = Settings::new(0.05 / (KAPPA * MODULUS));
    let mut solver = loaded::<2, Means<2>>(0.1 * MODULUS, settings);
    solver.step().unwrap();
    solver.water.faces[0].sides += 1;
    match solver.step() {
        Err(Error::Lost { step: 1, what: "load of a face", value, whole, .. }) => {
            let sides = (2 * WIDE) as f64;
            assert!((whole / value - (1.0 + 1.0 / sides)).abs() < 1e-9);
        }
        other => panic!("{other:?}"),
    }
}

/// A column without its right wall, drained there.
fn slab<I: OfHats<2>>(water: Water<2>, settings: Settings) -> Solver<2> {
    let mut scene = standing::<2, _>(porous(), straight);
    scene.constraints.remove(1);
    let water = water.drained(|x| x[0] > WIDE as f64 * H - 1e-9);
    Solver::new::<I>(scene, water, settings).unwrap()
}

/// All components that a plate ties are one unknown.
#[test]
fn tied_nodes_are_one_unknown() {
    let count = |water: Water<2>| {
        let solver = slab::<Hats<2>>(water, Settings::new(1.0));
        let unknowns = solver.setting(1.0, Vec::new()).unwrap().unknowns;
        (unknowns.displacements, unknowns.count)
    };
    let free = count(water());
    let tied = count(water().plate(Plate::new(1, uppermost, |_| 0.0)));
    assert_eq!((free.0 - tied.0, free.1 - tied.1), (WIDE, WIDE));
}
