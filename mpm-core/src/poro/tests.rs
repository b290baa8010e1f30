//! Against exact answers, difference quotients and closed forms.

use super::*;
use crate::Particles;
use crate::basis::{Gimp, Linear};
use crate::bodies::Bodies;
use crate::error::Fault;
use crate::fixture::{Affine, filling};
use crate::grid::{Axis, Grid, Side};
use crate::lattice::Lattice;
use crate::material::{ImprovedHencky, Law, shared};
use crate::space::embed;
use crate::stage::{End, Wall, WallKind};
use nalgebra::{SMatrix, SVector};

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
mod outside;
mod response;
mod tangent;

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
    let mut count = [2 * WIDE; D];
    count[D - 1] = 2 * HIGH;
    let particles = filling(count, 0.5 * H, 0.0).deformed(deformed);
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

/// A box between walls, all of whose faces move as an affine field does, is strained by it all through; where water may
/// leave everywhere the effective stress is the law's and the pressure nothing, and where it may not an isochoric field
/// needs no pressure either.
fn reproduces_affine_fields<const D: usize, I: OfHats<D>>(isochoric: bool) {
    let mut gradient =
        SMatrix::<f64, D, D>::from_fn(|i, j| 0.005 * (i as f64 - 0.7 * j as f64) - if i == j { 0.03 } else { 0.0 });
    let mut f = SMatrix::<f64, D, D>::identity() + gradient;
    if isochoric {
        f /= crate::space::determinant(&f).powf(1.0 / D as f64);
        gradient = f - SMatrix::identity();
    }
    let grid = Grid::new(H, [Axis::walls(0.0, HIGH); D]).unwrap();
    let law = porous();
    let body = Bodies::new(law, filling([2 * HIGH; D], 0.5 * H, 0.0)).unwrap();
    let scene = Scene::new(grid, body).constrain(Affine(gradient));
    // One held node fixes a pressure that nothing else does.
    let water = water().drained(move |x| !isochoric || x.iter().all(|x| *x == 0.0));
    let settings = Settings { tolerance: 1e-13, ..Settings::new(1.0).ghosts(0.1, 0.01) };
    let mut solver = Solver::<D>::new::<I>(scene, water, settings).unwrap();
    solver.step().unwrap();
    let exact = law.response(&embed(&f), 1.0, &law.initial_state()).0.to_matrix();
    let p = solver.particles();
    for k in 0..p.len() {
        let error = (p.stress[k].to_matrix() - exact).norm();
        assert!(error < 1e-10 * MODULUS, "{D}: {error}");
        let moved = SVector::from(p.position[k]) - f * SVector::from(p.reference[k]);
        assert!(moved.norm() < 1e-12, "{moved}");
        assert!(solver.pores.pressure[k].abs() < 1e-8 * MODULUS);
    }
    // And has the domains of a body that starts so.
    let begun = p.reference.iter().map(|x| {
        let volume = (0.5 * H).powi(D as i32);
        let particles = Particles::new(vec![*x], volume, 1000.0, [0.25 * H; D]).unwrap();
        let mut body = Bodies::new(law, particles.deformed(|x| ((f * SVector::from(*x)).into(), f))).unwrap();
        start::begin(&I::on(grid).unwrap(), &mut body.particles, 0).unwrap()
    });
    for (begun, stepped) in begun.zip(&solver.pores.half_size) {
        let apart = SVector::from(begun) - SVector::from(*stepped);
        assert!(apart.norm() < 1e-12 * H, "{D}: {apart}");
    }
}

#[test]
fn affine_fields_pass_the_patch_test() {
    for isochoric in [false, true] {
        if !isochoric {
            reproduces_affine_fields::<1, Hats<1>>(isochoric);
            reproduces_affine_fields::<1, Means<1>>(isochoric);
        }
        reproduces_affine_fields::<2, Hats<2>>(isochoric);
        reproduces_affine_fields::<2, Means<2>>(isochoric);
    }
    reproduces_affine_fields::<3, Hats<3>>(true);
}
