//! Derivatives, penalties, contact and the cause of a failure, against exact answers and difference quotients.

use super::*;
use crate::Particles;
use crate::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use crate::fixture::filling;
use crate::grid::{Axis, Grid, Side};
use crate::lattice::Lattice;
use crate::material::{Hencky, HenckyJ2, Hypoelastic, JaumannUpdate, NeoHookean, Strength};
use crate::material::{Law, shared};
use crate::memory::Memory;
use crate::projection::Onto;
use crate::stage::{BodyForce, End, Wall, WallKind};
use nalgebra::SMatrix;

const YOUNG: f64 = 1e5;
const POISSON: f64 = 0.3;
const H: f64 = 0.25;
const CELLS: usize = 4;

type Hats<const D: usize> = Lattice<D, 2, Linear>;
type Means<const D: usize> = Lattice<D, 3, Gimp>;
type Quadratics<const D: usize> = Lattice<D, 3, QuadraticBSpline>;
type Cubics<const D: usize> = Lattice<D, 4, CubicBSpline>;

/// Calls `$check::<D, I>($argument…)` for every basis.
macro_rules! every_basis {
    ($check:ident, $d:literal $(, $argument:expr)*) => {
        $check::<$d, Hats<$d>, _>($($argument),*);
        $check::<$d, Means<$d>, _>($($argument),*);
        $check::<$d, Quadratics<$d>, _>($($argument),*);
        $check::<$d, Cubics<$d>, _>($($argument),*);
    };
}

// After the macro, which it uses.
mod cause;
mod contact;
mod friction;
mod stiffness;
mod surface;
mod take_over;

/// A box of `cells` cells along each axis, two particles a cell and axis, that fills a grid between walls.
fn full<const D: usize, M: Law + 'static>(cells: usize, law: M) -> Scene<D> {
    filled([Axis::walls(0.0, cells); D], cells, law)
}

/// The same on a grid of `axes`.
fn filled<const D: usize, M: Law + 'static>(axes: [Axis; D], cells: usize, law: M) -> Scene<D> {
    let particles = filling([2 * cells; D], 0.5 * H, 0.0);
    Scene::new(Grid::new(H, axes).unwrap(), Bodies::new(shared(law), particles).unwrap())
}

/// The box stands on a floor between rollers and is compressed by `weight` (N/m³).
fn standing<const D: usize, M: Law + 'static>(cells: usize, law: M, weight: f64) -> Scene<D> {
    let rollers = (0..D).map(|axis| Wall::new(axis, End::Lo, WallKind::Roller));
    let axis = Axis::bounded(0.0, cells + 2, (Side::Wall, Side::Open));
    filled([axis; D], cells, law).constrain_all(rollers).load(BodyForce(Box::new(move |_, t| {
        let mut force = [0.0; D];
        force[D - 1] = -weight * t / 1000.0;
        force
    })))
}

/// A body with one more particle in a cell of its own, the only one that six unknowns see.
fn with_a_loner() -> Scene<2> {
    let law = Hencky::new(YOUNG, POISSON).unwrap();
    let axis = Axis::bounded(0.0, CELLS + 2, (Side::Wall, Side::Open));
    let mut scene = filled([axis; 2], CELLS, law);
    let p = &scene.bodies.particles;
    let mut positions = p.position.clone();
    positions.push([H * (CELLS as f64 + 0.1), H * 2.1]);
    let more = Particles::new(positions, p.reference_volume[0], 1000.0, p.half_size).unwrap();
    scene.bodies = Bodies::new(law, more).unwrap();
    scene.constrain(Wall::new(0, End::Lo, WallKind::Fixed))
}

fn loner(stabilisation: Stabilisation) -> f64 {
    let settings = Settings::new(1.0).stabilised(stabilisation);
    Solver::<2>::new::<Quadratics<2>>(with_a_loner(), settings).unwrap().condition()
}

#[test]
fn stabilisations_bound_the_condition() {
    let bounded = [Stabilisation::Ghost(GHOST), Stabilisation::Soft(0.01)];
    let found = bounded.map(loner);
    assert!(found.iter().all(|c| *c < 1e6), "{found:?}");
    assert!(loner(Stabilisation::None) > 1e12);
}

/// Clay between walls that yields under its weight below a depth: the penalty is made of what flow keeps.
#[test]
fn a_ghost_penalty_spares_what_flows() {
    let shares = |strength: f64| {
        let law = HenckyJ2::new(YOUNG, POISSON, Strength::undrained(strength).unwrap()).unwrap();
        let axes = [Axis::walls(0.0, CELLS), Axis::bounded(0.0, CELLS + 2, (Side::Wall, Side::Open))];
        let rollers = [(0, End::Lo), (0, End::Hi), (1, End::Lo)];
        let scene = filled(axes, CELLS, law)
            .constrain_all(rollers.map(|(axis, end)| Wall::new(axis, end, WallKind::Roller)))
            .load(BodyForce(Box::new(|_, t| [0.0, -t])));
        let settings = Settings::new(0.1).stabilised(Stabilisation::Ghost(GHOST));
        let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
        (0..9).for_each(|_| solver.step().unwrap());
        solver.kept_stiffness(&solver.averaging().0, 0.1)
    };
    assert!(shares(YOUNG).is_empty());
    let [least, most] = [f64::min, f64::max].map(|of| shares(100.0).into_iter().reduce(of).unwrap());
    assert!(least < 0.01 && most > 0.9, "{least} {most}");
}

#[test]
fn a_penalty_stands_for_all_steps_that_raise_the_load() {
    let loads = |size: f64| [SVector::from([0.0, size]), SVector::from([size, 0.0])];
    for (earlier, later, steps) in
        [(0.0, 1.0, 1.0), (0.9, 1.0, 10.0), (1.0, 1.0, 1.0), (1.0, 0.5, 1.0), (0.9999, 1.0, 100.0)]
    {
        assert!((steps_of_load(&loads(earlier), &loads(later)) - steps).abs() < 1e-9, "{earlier} {later}");
    }
}
