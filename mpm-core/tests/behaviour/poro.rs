//! Bodies with water in their pores, against exact answers and closed forms.

use crate::scenes::block;
use mpm_core::basis::{Gimp, Linear};
use mpm_core::implicit::OfHats;
use mpm_core::material::{Hencky, ImprovedHencky, shared};
use mpm_core::poro::{
    Conductivity, Face, Gravity, Plate, Predictor, PressureSpace, Settings, Solver, Tangent, VolumeRate, Water,
};
use mpm_core::stage::{Amplitude, End, RigidNodes, Wall, WallKind};
use mpm_core::{
    Axis, Bodies, Error, Fault, Field, Grid, Lattice, Law, Memory, Part, Particles, Saved, Scene, Side, Simulation,
};
use nalgebra::SMatrix;

const H: f64 = 0.125;
/// Cells of a column along its height, and across it.
const HIGH: usize = 8;
const WIDE: usize = 8;
const POROSITY: f64 = 0.4;
/// Oedometric modulus (Pa) and conductivity (m²/(Pa s)) of undeformed material.
const MODULUS: f64 = 1e5 + 4.0 / 3.0 * 6e4;
const KAPPA: f64 = 1e-8;

type Hats<const D: usize> = Lattice<D, 2, Linear>;
type Means<const D: usize> = Lattice<D, 3, Gimp>;

const SPACES: [PressureSpace; 3] =
    [PressureSpace::TwoGrid, PressureSpace::Equal, PressureSpace::Projected { strength: 0.5 / 6e4 }];

mod carried;
mod column;
mod ghosts;
mod outside;

fn porous() -> ImprovedHencky {
    ImprovedHencky::new(1e5 * POROSITY, 6e4, POROSITY).unwrap()
}

fn kozeny_carman() -> Conductivity {
    let solid: f64 = 1.0 - POROSITY;
    Conductivity::KozenyCarman(KAPPA * solid * solid / POROSITY.powi(3))
}

/// A column of two particles a cell and axis on a floor, between rollers, with room above; the last axis is upright.
fn standing<const D: usize, M: Law + 'static>(
    law: M,
    deformed: impl Fn(&[f64; D]) -> ([f64; D], SMatrix<f64, D, D>),
) -> Scene<D> {
    let mut axes = [Axis::walls(0.0, WIDE); D];
    axes[D - 1] = Axis::bounded(0.0, HIGH + 2, (Side::Wall, Side::Open));
    let grid = Grid::new(H, axes).unwrap();
    let mut count = [WIDE; D];
    count[D - 1] = HIGH;
    let particles = block(H, 2, [0; D], count).deformed(deformed);
    let rollers = (0..D).flat_map(|axis| {
        let wall = move |end| Wall::new(axis, end, WallKind::Roller);
        let both = axis + 1 < D;
        [Some(wall(End::Lo)), both.then(|| wall(End::Hi))]
    });
    Scene::new(grid, Bodies::new(shared(law), particles).unwrap()).constrain_all(rollers.flatten())
}

fn water<const D: usize>() -> Water<D> {
    Water::new(POROSITY, kozeny_carman())
}

/// Ghost penalties, and steps in which pressures diffuse over this `area` (m²).
fn diffusing(area: f64) -> Settings {
    Settings::new(area / (KAPPA * MODULUS)).ghosts(0.1, 0.01)
}

fn straight<const D: usize>(x: &[f64; D]) -> ([f64; D], SMatrix<f64, D, D>) {
    (*x, SMatrix::identity())
}

const TOP: f64 = H * HIGH as f64;

/// Whether a reference place is in the row of particles at the top.
fn topmost<const D: usize>(x: &[f64; D]) -> bool {
    x[D - 1] > TOP - 0.5 * H
}

/// Whether a node is at the top or above.
fn uppermost<const D: usize>(x: &[f64; D]) -> bool {
    x[D - 1] > TOP - 1e-9
}

/// A column under a traction on its top, through which its water leaves by a penalty.
fn loaded<const D: usize, I: OfHats<D>>(traction: f64, settings: Settings) -> Solver<D> {
    let scene = standing::<D, _>(porous(), straight);
    let particles = &scene.bodies.particles;
    let top = (D - 1, End::Hi);
    let mut force = [0.0; D];
    force[D - 1] = -traction;
    let water = water().face(Face::loaded(particles, topmost, top, move |_| force)).face(Face::drained(
        particles,
        topmost,
        top,
        100.0 * KAPPA / H,
    ));
    Solver::new::<I>(scene, water, settings).unwrap()
}

/// Grains as heavy as water in water at rest: the pressure that there was stays, linear in depth, and nothing moves.
fn stays_at_rest<const D: usize, I: OfHats<D>>(space: PressureSpace) {
    let mut acceleration = [0.0; D];
    acceleration[D - 1] = -10.0;
    let depth = |x: &[f64; D]| 1e4 * (TOP - x[D - 1]);
    for tangent in [Tangent::Symmetric, Tangent::Consistent] {
        let water = water()
            .gravity(Gravity { water: 1000.0, grains: 1000.0, acceleration })
            .start(depth)
            .drained(|x| x[D - 1] > TOP - 1e-9);
        let scene = standing::<D, _>(porous(), straight);
        let settings = Settings::new(1.0).pressure_space(space).tangent(tangent);
        let mut solver = Solver::<D>::new::<I>(scene, water, settings).unwrap();
        solver.advance(2).unwrap();
        let pressure = solver.field(Field::PorePressure);
        let p = solver.particles();
        for k in 0..p.len() {
            let error = pressure[k] - depth(&p.position[k]);
            assert!(error.abs() < 1e-5, "{error}");
            assert!((p.position[k][D - 1] - p.reference[k][D - 1]).abs() < 1e-10);
        }
    }
}

#[test]
fn hydrostatic_water_stays_at_rest() {
    for space in SPACES {
        stays_at_rest::<1, Hats<1>>(space);
        stays_at_rest::<1, Means<1>>(space);
        stays_at_rest::<2, Hats<2>>(space);
        stays_at_rest::<2, Means<2>>(space);
    }
}

#[test]
fn what_is_not_allowed_is_refused_by_name() {
    let column = || standing::<1, _>(porous(), straight);
    let refused = |water: Water<1>, settings: Settings, what: &str| {
        let error = Solver::<1>::new::<Means<1>>(column(), water, settings).err().unwrap();
        assert!(error.to_string().contains(what), "{error}");
    };
    let some = Conductivity::Constant(KAPPA);
    let settings = Settings::new(1.0);
    for n in [0.0, 1.0, -0.1, f64::NAN] {
        refused(Water::new(n, some), settings, "porosity");
    }
    let dry = Conductivity::Constant(0.0);
    refused(Water::new(POROSITY, dry).drained(|_| true), settings, "conductivity of a body that drains");
    let face = Face::drained(&column().bodies.particles, topmost, (0, End::Hi), 1.0);
    refused(Water::new(POROSITY, dry).face(face), settings, "conductivity of a body that drains");
    assert!(Solver::<1>::new::<Means<1>>(column(), Water::new(POROSITY, dry), settings).is_ok());
    let other = "porosity of the water = 0.3 is not allowed: that of the solid's law";
    refused(Water::new(0.3, some), settings, other);
    let negative = Conductivity::KozenyCarman(-1.0);
    refused(Water::new(POROSITY, negative), settings, "conductivity");
    let logarithmic = settings.volume_rate(VolumeRate::Logarithmic);
    refused(Water::new(POROSITY, some), logarithmic, "consistent");
    refused(Water::new(POROSITY, some), Settings::new(0.0), "time step");
    let ghost = settings.ghosts(-1.0, 0.0);
    refused(Water::new(POROSITY, some), ghost, "ghost penalty");
    let none = PressureSpace::Projected { strength: 0.0 };
    let settings = settings.pressure_space(none);
    refused(Water::new(POROSITY, some), settings, "projection");
}

#[test]
fn a_cell_of_the_pressure_holds_two_of_the_displacement() {
    let mut scene = standing::<1, _>(porous(), straight);
    scene.grid = Grid::new(H, [Axis::bounded(0.0, HIGH + 3, (Side::Wall, Side::Open))]).unwrap();
    let water = || Water::new(POROSITY, Conductivity::Constant(KAPPA));
    let equal = Settings::new(1.0).pressure_space(PressureSpace::Equal);
    let refused = Solver::<1>::new::<Hats<1>>(scene, water(), Settings::new(1.0));
    assert!(refused.err().unwrap().to_string().contains("even"));
    let mut scene = standing::<1, _>(porous(), straight);
    scene.grid = Grid::new(H, [Axis::bounded(0.0, HIGH + 3, (Side::Wall, Side::Open))]).unwrap();
    assert!(Solver::<1>::new::<Hats<1>>(scene, water(), equal).is_ok());
}
