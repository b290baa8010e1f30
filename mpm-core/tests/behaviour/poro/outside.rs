//! Faces and plates: what they carry, and what of them is refused.

use super::*;

fn refused<const D: usize>(scene: Scene<D>, water: Water<D>, what: &str) {
    match Solver::<D>::new::<Hats<D>>(scene, water, Settings::new(1.0)).err() {
        Some(error @ Error::Input { .. }) => {
            assert!(error.to_string().contains(what), "{error}");
        }
        other => panic!("{other:?}"),
    }
}

/// A body whose corners at the top lie in the cell above, which is empty.
fn jutting() -> Scene<1> {
    let mut scene = standing::<1, _>(porous(), straight);
    scene.bodies.particles.half_size = [0.5 * H];
    scene
}

#[test]
fn faces_that_the_body_does_not_bear_are_refused() {
    let top = (0, End::Hi);
    let face = |select: fn(&[f64; 1]) -> bool| {
        let scene = standing::<1, _>(porous(), straight);
        Face::loaded(&scene.bodies.particles, select, top, |_| [-1.0])
    };
    let column = || standing::<1, _>(porous(), straight);
    refused(column(), water().face(face(|_| false)), "particles of a loaded or drained face");
    refused(jutting(), water().face(face(topmost)), "in an empty cell");
    let particles = column().bodies.particles;
    let drained = |penalty| Face::drained(&particles, topmost, top, penalty);
    refused(jutting(), water().face(drained(1.0)), "in an empty cell");
    for penalty in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(column(), water().face(drained(penalty)), "penalty of a drained face");
    }
    let nobody = Face::drained(&particles, |_| false, top, 1.0);
    refused(column(), water().face(nobody), "particles of a loaded or drained face");
    let aside = Face::drained(&particles, topmost, (1, End::Hi), 1.0);
    refused(column(), water().face(aside), "axis of a face");
    let force = Face::loaded(&particles, topmost, top, |_| [f64::NAN]);
    refused(column(), water().face(force), "traction");
    let few = Particles::new(vec![[0.9]], 0.5 * H, 1.0, [0.25 * H]).unwrap();
    let foreign = Face::drained(&few, |_| true, top, 1.0);
    refused(column(), water().face(foreign), "chosen from");
}

/// A face that a pull takes into an empty cell breaks the run, as there it would lose a part of its load.
#[test]
fn a_face_that_comes_into_an_empty_cell_breaks_the_run() {
    let mut solver = loaded::<1, Hats<1>>(-0.03 * MODULUS, Settings::new(0.05 / (KAPPA * MODULUS)));
    let broken = (0..9).find_map(|_| solver.step().err());
    match broken {
        Some(Error::Breakdown { step: 1.., fault: Fault::EmptyCell(share), .. }) => assert!(share > 1e-4, "{share}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_face_may_bear_no_load() {
    let settings = Settings::new(0.05 / (KAPPA * MODULUS));
    let mut solver = loaded::<1, Hats<1>>(0.0, settings);
    solver.step().unwrap();
    assert_eq!(solver.totals().accumulated.load_work, 0.0);
}

/// A column without its right wall, drained there.
fn slab<I: OfHats<2>>(water: Water<2>, settings: Settings) -> Solver<2> {
    let mut scene = standing::<2, _>(porous(), straight);
    scene.constraints.remove(1);
    let water = water.drained(|x| x[0] > WIDE as f64 * H - 1e-9);
    Solver::new::<I>(scene, water, settings).unwrap()
}

/// How much of the most the displacements of the uppermost particles differ by, after a step.
fn unevenness(solver: &mut Solver<2>) -> f64 {
    solver.step().unwrap();
    let p = solver.particles();
    let upper = (0..p.len()).filter(|k| topmost(&p.reference[*k]));
    let moved: Vec<f64> = upper.map(|k| p.position[k][1] - p.reference[k][1]).collect();
    let [lo, hi] = [f64::min, f64::max].map(|f| moved.iter().copied().reduce(f).unwrap());
    (hi - lo) / hi.abs().max(lo.abs())
}

/// Under a plate the top stays flat though the pressure is not even; a traction of the same sum bends it. The floor
/// bears the plate's force, which works on what the plate moves by, and is all that is out of balance to Newton's
/// tolerance. (A pull: the side comes in, and leaves no grid.)
fn carries_its_force<I: OfHats<2>>(pressure_space: PressureSpace) {
    let force = 0.02 * MODULUS;
    let settings = Settings::new(0.02 / (KAPPA * MODULUS)).pressure_space(pressure_space);
    let plate = Plate::new(1, uppermost, move |_| force);
    let mut tied = slab::<I>(water().plate(plate), settings);
    assert!(unevenness(&mut tied) < 1e-9);
    let p = tied.particles();
    let highest = (0..p.len()).find(|k| topmost(&p.reference[*k])).unwrap();
    let stretch = p.position[highest][1] / p.reference[highest][1] - 1.0;
    let work = tied.totals().accumulated.load_work;
    assert!((work / (force * stretch * TOP) - 1.0).abs() < 1e-9);
    let floor = Part::Constraint(1);
    assert!((tied.on(floor).force[1] / force - 1.0).abs() < 1e-8);
    assert!(tied.residual().free_force < 1e-8 * force);

    let particles = standing::<2, _>(porous(), straight).bodies.particles;
    let traction = force / (WIDE as f64 * H);
    let face = Face::loaded(&particles, topmost, (1, End::Hi), move |_| [0.0, traction]);
    let bent = unevenness(&mut slab::<Means<2>>(water().face(face), settings));
    assert!(bent > 1e-2, "{bent}");
}

#[test]
fn a_plate_stays_flat_and_carries_its_force() {
    for space in SPACES {
        carries_its_force::<Hats<2>>(space);
        carries_its_force::<Means<2>>(space);
    }
}

#[test]
fn plates_that_are_none_are_refused() {
    let column = || standing::<2, _>(porous(), straight);
    let plate = |axis, takes: fn(&[f64; 2]) -> bool| Plate::new(axis, takes, |_| -1.0);
    refused(column(), water().plate(plate(2, uppermost)), "axis of a plate");
    refused(column(), water().plate(plate(1, |_| false)), "nodes of a plate");
    // Nodes in the empty cells above the body alone.
    refused(column(), water().plate(plate(1, |x| x[1] > TOP + 0.5 * H)), "force of a plate");
    let another = "a constraint or another plate";
    refused(column(), water().plate(plate(1, |x| x[1] < 0.5 * H)), another);
    let twice = water().plate(plate(1, uppermost)).plate(plate(1, |x| x[0] < 0.5 * H && uppermost(x)));
    refused(column(), twice, another);
}
